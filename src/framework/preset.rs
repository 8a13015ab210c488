//! Presets: a whole problem as TOML, robot and world named by files beside it.
//!
//! Pure: the text of a named file comes from the caller's resolver.

#[cfg(test)]
mod tests;

#[cfg(test)]
pub(crate) use tests::shipped;

use crate::execution::{ExecutionSpec, Problem};
use crate::generalization::Goals;
use crate::method::MethodSpec;
use crate::robot::RobotSpec;
use crate::world::WorldSpec;
use serde::Deserialize;

/// A named problem.
#[derive(Debug, Clone, PartialEq)]
pub struct Preset {
    /// File name without folder and extension.
    pub name: String,
    /// Description in one line.
    pub description: String,
    /// Problem to execute.
    pub problem: Problem,
    /// Further methods, with parameters suited to this problem.
    pub methods: Vec<MethodSpec>,
    /// Discrepancy that a run should reach, features' unit; `None` if there is no such threshold.
    pub threshold: Option<f64>,
}

impl Preset {
    /// Selects the method of that name, with the preset's own parameters for it if it has any, or else with the
    /// method's defaults. Returns whether there is such a method.
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

/// Reasons why a text is not a valid preset.
#[derive(Debug, thiserror::Error)]
pub enum PresetError {
    /// A file that cannot be read.
    #[error("{file:?}, named in preset {preset:?}, cannot be read: {reason}")]
    File {
        /// Name of the preset.
        preset: String,
        /// Path of the file as named in the preset.
        file: String,
        /// Reason given by the resolver.
        reason: String,
    },
    /// The TOML does not have the expected form; the message shows line and column.
    #[error("{file} is not a valid {what}: {source}")]
    Toml {
        /// Path of the file.
        file: String,
        /// `preset` or `world`.
        what: &'static str,
        /// Line, column and description of the defect.
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

/// Robot of a preset: [`RobotSpec`] and the path of the URDF.
#[derive(Deserialize)]
struct RawRobot {
    urdf: String,
    #[serde(flatten)]
    spec: RobotSpec,
}

/// Parses a preset; `resolve` returns the text of a file, given its path relative to the preset.
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

/// Parses a world file.
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
