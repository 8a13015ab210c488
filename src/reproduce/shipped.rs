//! The shipped presets (`examples/presets`) and the robots and worlds they name.

use crate::framework::preset::{Preset, PresetError, parse};

/// Reason why there is no such shipped preset.
#[derive(Debug, thiserror::Error)]
pub enum ShippedError {
    /// There is no shipped preset of that name.
    #[error("there is no preset {name:?}: use one of {shipped:?}, or the path of a TOML file")]
    Unknown {
        /// Name given.
        name: String,
        /// Names of the shipped presets.
        shipped: Vec<&'static str>,
    },
    /// A shipped file is broken, which a test rules out.
    #[error(transparent)]
    Preset(#[from] PresetError),
}

/// Path as presets name it, and text.
const FILES: [(&str, &str); 5] = [
    ("../robots/seven_joint_arm.urdf", include_str!("../../examples/robots/seven_joint_arm.urdf")),
    ("../robots/teo_left_arm.urdf", include_str!("../../examples/robots/teo_left_arm.urdf")),
    ("../robots/teo_right_arm.urdf", include_str!("../../examples/robots/teo_right_arm.urdf")),
    ("../worlds/paint_wall.toml", include_str!("../../examples/worlds/paint_wall.toml")),
    ("../worlds/tool_position_mm.toml", include_str!("../../examples/worlds/tool_position_mm.toml")),
];

/// Name and text.
const PRESETS: [(&str, &str); 10] = [
    ("wax", include_str!("../../examples/presets/wax.toml")),
    ("wax-reachable", include_str!("../../examples/presets/wax-reachable.toml")),
    ("wax-left", include_str!("../../examples/presets/wax-left.toml")),
    ("polish", include_str!("../../examples/presets/polish.toml")),
    ("polish-left", include_str!("../../examples/presets/polish-left.toml")),
    ("circle-seven-joints", include_str!("../../examples/presets/circle-seven-joints.toml")),
    ("eight-seven-joints", include_str!("../../examples/presets/eight-seven-joints.toml")),
    ("paint", include_str!("../../examples/presets/paint.toml")),
    ("paper-wax", include_str!("../../examples/presets/paper-wax.toml")),
    ("paper-paint", include_str!("../../examples/presets/paper-paint.toml")),
];

/// Names of the shipped presets.
#[must_use]
pub fn names() -> Vec<&'static str> {
    PRESETS.iter().map(|(name, _)| *name).collect()
}

/// The shipped preset of that name.
///
/// # Errors
/// [`ShippedError::Unknown`] lists the names there are.
pub fn preset(name: &str) -> Result<Preset, ShippedError> {
    let unknown = || ShippedError::Unknown { name: name.to_owned(), shipped: names() };
    let (_, text) = PRESETS.iter().find(|(n, _)| *n == name).ok_or_else(unknown)?;
    let file = |wanted: &str| {
        let found = FILES.iter().find(|(path, _)| *path == wanted);
        found.map(|(_, text)| (*text).to_owned()).ok_or_else(|| "it is not shipped".to_owned())
    };
    Ok(parse(name, text, file)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::framework::execution::Iet;
    use crate::framework::method::MethodSpec;

    #[test]
    fn every_shipped_preset_can_be_run() {
        for name in names() {
            let iet = Iet::new(&preset(name).unwrap().problem, 1).unwrap();
            let joints = if name.ends_with("-seven-joints") { 7 } else { 3 };
            assert_eq!(iet.chain().len(), joints, "{name}");
        }
    }

    #[test]
    fn every_method_can_be_chosen_and_the_paper_has_its_own() {
        for name in names() {
            for method in MethodSpec::NAMES {
                let mut preset = preset(name).unwrap();
                assert!(preset.select_method(method), "{name} {method}");
                assert_eq!(preset.problem.execution.method.name(), method);
                let covers = preset.problem.world.properties().surface.is_some();
                let unfit = if covers { ["broyden", "model"] } else { ["particle", "search"] };
                let fits = !unfit.contains(&method);
                assert_eq!(Iet::new(&preset.problem, 1).is_ok(), fits, "{name} {method}");
                let is_default = preset.problem.execution.method == MethodSpec::by_name(method).unwrap();
                let is_published = matches!(method, "sst" | "pso" | "fi_pso" | "affg_pso");
                assert!(
                    !(is_published && name.starts_with("paper-") && is_default),
                    "{name} {method}: the paper's parameters"
                );
            }
        }
    }

    #[test]
    fn the_left_arm_mirrors_the_right() {
        let see = |name: &str, joints: &[f64]| {
            let mut seen = [0.0; 3];
            Iet::new(&preset(name).unwrap().problem, 1).unwrap().world().unwrap().observe(joints, &mut seen);
            seen
        };
        for joints in [[0.0, 0.0, 0.0], [0.3, 1.1, -0.2], [1.6, -0.1, 0.9]] {
            let ([x, y, z], right) = (see("wax-left", &joints), see("wax", &joints));
            assert!((x - right[0]).abs().max((y + right[1]).abs()).max((z - right[2]).abs()) < 1e-9, "{joints:?}");
        }
    }

    #[test]
    fn an_unknown_name_is_told_with_the_known_ones() {
        let error = preset("wash").unwrap_err().to_string();
        assert!(error.contains("\"wash\"") && error.contains("\"paper-wax\""), "{error}");
    }
}
