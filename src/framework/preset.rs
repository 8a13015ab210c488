//! Presets: a whole problem as TOML, robot and world named by files beside it.
//!
//! Pure: the text of a named file comes from the caller's resolver.

#[cfg(test)]
mod tests;

#[cfg(test)]
pub(crate) use tests::shipped;

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
    /// A file that cannot be read.
    #[error("{file:?}, which preset {preset:?} names, cannot be read: {reason}")]
    File {
        /// The preset.
        preset: String,
        /// The file it names.
        file: String,
        /// Why, in the resolver's words.
        reason: String,
    },
    /// TOML that does not fit; the message shows line and column.
    #[error("{file} is not a valid {what}: {source}")]
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
