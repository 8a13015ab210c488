//! Presets: a whole problem as TOML, robot and world named by files beside it.
//!
//! Pure: the text of a named file comes from the caller's resolver. The shipped presets (`examples/presets`) are part
//! of the program, so that they work wherever it is installed.

use crate::execution::{ExecutionSpec, Problem};
use crate::generalization::Goals;
use crate::method::per_goal::MethodSpec;
use crate::robot::RobotSpec;
use crate::world::WorldSpec;
use serde::Deserialize;

/// A named problem.
#[derive(Debug, Clone, PartialEq)]
pub struct Preset {
    /// Name without folder and ending.
    pub name: String,
    /// One line for people.
    pub description: String,
    /// Everything an execution needs.
    pub problem: Problem,
    /// Other methods with the parameters that belong to this problem.
    pub methods: Vec<MethodSpec>,
    /// The discrepancy a run should reach, features' unit.
    pub threshold: Option<f64>,
}

impl Preset {
    /// Searches by the method of that name: with the preset's own parameters where it has some, else with the method's
    /// defaults. Returns whether there is such a method.
    #[must_use]
    pub fn select_method(&mut self, name: &str) -> bool {
        let method = &mut self.problem.execution.method;
        if method.name() == name {
            return true;
        }
        let own = self.methods.iter().find(|m| m.name() == name).cloned();
        let Some(chosen) = own.or_else(|| MethodSpec::by_name(name)) else { return false };
        *method = chosen;
        true
    }
}

/// Why a text is not a preset.
#[derive(Debug, thiserror::Error)]
pub enum PresetError {
    /// No shipped preset has that name.
    #[error("no preset is named {name:?}; shipped are {shipped:?}; a path to a TOML file is taken too")]
    Unknown {
        /// The name given.
        name: String,
        /// Names of the shipped presets.
        shipped: Vec<&'static str>,
    },
    /// A file that cannot be had.
    #[error("{file:?}, which preset {preset:?} names, cannot be read: {reason}")]
    File {
        /// The preset.
        preset: String,
        /// The file it names.
        file: String,
        /// The resolver's word.
        reason: String,
    },
    /// TOML that does not fit; the message shows line and column.
    #[error("{file} is no valid {what}: {source}")]
    Toml {
        /// The file.
        file: String,
        /// `preset` or `world`.
        what: &'static str,
        /// Line, column and what is wrong there.
        #[source]
        source: Box<toml::de::Error>,
    },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawPreset {
    description: String,
    world: String,
    goals: Goals,
    robot: RawRobot,
    execution: ExecutionSpec,
    #[serde(default)]
    methods: Vec<MethodSpec>,
    #[serde(default)]
    threshold: Option<f64>,
}

/// [`RobotSpec`] and the URDF's file.
#[derive(Deserialize)]
struct RawRobot {
    urdf: String,
    #[serde(flatten)]
    spec: RobotSpec,
}

/// The shipped files: path as presets name it, and text.
const FILES: [(&str, &str); 5] = [
    ("../robots/seven_joint_arm.urdf", include_str!("../../../examples/robots/seven_joint_arm.urdf")),
    ("../robots/teo_left_arm.urdf", include_str!("../../../examples/robots/teo_left_arm.urdf")),
    ("../robots/teo_right_arm.urdf", include_str!("../../../examples/robots/teo_right_arm.urdf")),
    ("../worlds/paint_wall.toml", include_str!("../../../examples/worlds/paint_wall.toml")),
    ("../worlds/tool_position_mm.toml", include_str!("../../../examples/worlds/tool_position_mm.toml")),
];

/// The shipped presets: name and text.
const SHIPPED: [(&str, &str); 10] = [
    ("wax", include_str!("../../../examples/presets/wax.toml")),
    ("wax-reachable", include_str!("../../../examples/presets/wax-reachable.toml")),
    ("wax-left", include_str!("../../../examples/presets/wax-left.toml")),
    ("polish", include_str!("../../../examples/presets/polish.toml")),
    ("polish-left", include_str!("../../../examples/presets/polish-left.toml")),
    ("circle-seven-joints", include_str!("../../../examples/presets/circle-seven-joints.toml")),
    ("eight-seven-joints", include_str!("../../../examples/presets/eight-seven-joints.toml")),
    ("paint", include_str!("../../../examples/presets/paint.toml")),
    ("paper-wax", include_str!("../../../examples/presets/paper-wax.toml")),
    ("paper-paint", include_str!("../../../examples/presets/paper-paint.toml")),
];

/// Names of the shipped presets.
#[must_use]
pub fn names() -> Vec<&'static str> {
    SHIPPED.iter().map(|(name, _)| *name).collect()
}

/// The shipped preset of that name.
///
/// # Errors
/// [`PresetError::Unknown`] lists the names there are.
pub fn shipped(name: &str) -> Result<Preset, PresetError> {
    let unknown = || PresetError::Unknown { name: name.to_owned(), shipped: names() };
    let (_, text) = SHIPPED.iter().find(|(n, _)| *n == name).ok_or_else(unknown)?;
    parse(name, text, |file| {
        let found = FILES.iter().find(|(path, _)| *path == file);
        found.map(|(_, text)| (*text).to_owned()).ok_or_else(|| "it is not shipped".to_owned())
    })
}

/// Reads a preset; `resolve` gives the text of a file by its path relative to the preset.
///
/// # Errors
/// [`PresetError`] with file, line and column.
pub fn parse(
    name: &str,
    text: &str,
    mut resolve: impl FnMut(&str) -> Result<String, String>,
) -> Result<Preset, PresetError> {
    let raw: RawPreset = toml::from_str(text).map_err(|source| PresetError::Toml {
        file: name.to_owned(),
        what: "preset",
        source: Box::new(source),
    })?;
    let mut file = |file: &str| {
        resolve(file).map_err(|reason| PresetError::File { preset: name.to_owned(), file: file.to_owned(), reason })
    };
    let urdf = file(&raw.robot.urdf)?;
    let world = parse_world(&raw.world, &file(&raw.world)?)?;
    Ok(Preset {
        name: name.to_owned(),
        description: raw.description,
        problem: Problem {
            goals: raw.goals,
            urdf,
            robot: raw.robot.spec,
            world,
            execution: raw.execution,
            earlier: Vec::new(),
        },
        methods: raw.methods,
        threshold: raw.threshold,
    })
}

/// Reads a world file.
///
/// # Errors
/// [`PresetError::Toml`] with line and column.
pub fn parse_world(file: &str, text: &str) -> Result<WorldSpec, PresetError> {
    toml::from_str(text).map_err(|source| PresetError::Toml {
        file: file.to_owned(),
        what: "world",
        source: Box::new(source),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::execution::Iet;

    #[test]
    fn every_shipped_preset_can_be_run() {
        for name in names() {
            let preset = shipped(name).unwrap();
            let iet = Iet::new(&preset.problem, 1).unwrap();
            let joints = if name.ends_with("-seven-joints") { 7 } else { 3 };
            assert_eq!(iet.chain().len(), joints, "{name}");
        }
    }

    #[test]
    fn every_method_can_be_chosen_and_the_paper_has_its_own() {
        for name in names() {
            for method in MethodSpec::NAMES {
                let mut preset = shipped(name).unwrap();
                assert!(preset.select_method(method), "{name} {method}");
                assert_eq!(preset.problem.execution.method.name(), method);
                let covers = matches!(preset.problem.world, WorldSpec::Coverage(_));
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
        assert!(!shipped("wax").unwrap().select_method("annealing"));
    }

    #[test]
    fn the_left_arm_mirrors_the_right() {
        let see = |name: &str, joints: &[f64]| {
            let mut seen = [0.0; 3];
            Iet::new(&shipped(name).unwrap().problem, 1).unwrap().world().unwrap().observe(joints, &mut seen);
            seen
        };
        for joints in [[0.0, 0.0, 0.0], [0.3, 1.1, -0.2], [1.6, -0.1, 0.9]] {
            let ([x, y, z], right) = (see("wax-left", &joints), see("wax", &joints));
            assert!((x - right[0]).abs().max((y + right[1]).abs()).max((z - right[2]).abs()) < 1e-9, "{joints:?}");
        }
    }

    #[test]
    fn errors_say_where() {
        let error = shipped("wash").unwrap_err().to_string();
        assert!(error.contains("\"wash\"") && error.contains("\"paper-wax\""), "{error}");
        let error = parse("mine", "description = 3", |_| Ok(String::new())).unwrap_err().to_string();
        assert!(error.contains("mine") && error.contains("line 1"), "{error}");
        let text = include_str!("../../../examples/presets/wax.toml");
        let error = parse("mine", text, |_| Err("no such file".into())).unwrap_err().to_string();
        assert!(error.contains("teo_right_arm.urdf") && error.contains("no such file"), "{error}");
        let misspelt = text.replace("free_joints", "free_joint");
        assert!(parse("mine", &misspelt, |_| Ok(String::new())).is_err());
    }
}
