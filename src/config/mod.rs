//! Configuration from defaults, file, environment (`CGDA_SECTION__KEY`) and flags, in increasing order of precedence.
//! Unknown keys are errors.

mod jobs;
mod limits;
mod log;
mod server;
mod sources;

pub use jobs::JobsConfig;
pub use limits::LimitsConfig;
pub use log::{LogConfig, LogFormat};
pub use server::ServerConfig;
pub use sources::Flags;

use serde::Deserialize;
use std::fmt;
use std::path::{Path, PathBuf};

/// All settings.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Config {
    /// Addresses and access.
    pub server: ServerConfig,
    /// Job runner.
    pub jobs: JobsConfig,
    /// Bounds on sizes and times.
    pub limits: LimitsConfig,
    /// Logging.
    pub log: LogConfig,
}

/// Reasons why a configuration cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum ConfigError {
    /// The named file does not exist.
    #[error("there is no configuration file {path}")]
    NoFile {
        /// Path as given.
        path: PathBuf,
    },
    /// The file cannot be read.
    #[error("the configuration file {path} cannot be read: {source}")]
    Unreadable {
        /// Path of the file.
        path: PathBuf,
        /// Cause.
        source: std::io::Error,
    },
    /// The file is not TOML.
    #[error("invalid configuration: {path}: {source}")]
    NoToml {
        /// Path of the file.
        path: PathBuf,
        /// Place and cause.
        source: Box<toml::de::Error>,
    },
    /// A key is unknown, or its value has the wrong type.
    #[error("invalid configuration: {key}: {reason}{origin}")]
    Key {
        /// Name of the key.
        key: String,
        /// Defect, and what is allowed.
        reason: String,
        /// Source of the value.
        origin: Origin,
    },
    /// A value is out of bounds.
    #[error("invalid configuration: {wrong}{origin}")]
    Bounds {
        /// Key, value and bounds.
        wrong: OutOfBounds,
        /// Source of the value.
        origin: Origin,
    },
    /// The sources cannot be merged.
    #[error("invalid configuration: {0}")]
    Sources(#[from] config::ConfigError),
}

/// The file, environment variable or flag that set a value; `None` if it is a default.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Origin(Option<String>);

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|origin| write!(f, " (set by {origin})"))
    }
}

/// A value out of its bounds.
#[derive(Debug, thiserror::Error)]
#[error("{key} is {value}: give {bounds}")]
pub struct OutOfBounds {
    key: &'static str,
    value: String,
    bounds: &'static str,
}

impl Config {
    /// Reads `file` (by default `cgda.toml` in the working directory, if it exists), the environment and `flags`.
    ///
    /// # Errors
    /// [`ConfigError`] names the key and the source of its value.
    pub fn load(file: Option<&Path>, flags: &Flags) -> Result<Self, ConfigError> {
        let variables =
            std::env::vars_os().filter_map(|(name, text)| Some((name.into_string().ok()?, text.into_string().ok()?)));
        let default = Path::new("cgda.toml");
        match file {
            Some(path) if !path.is_file() => Err(ConfigError::NoFile { path: path.to_owned() }),
            Some(path) => Self::of(Some(path), variables, flags),
            None => Self::of(default.is_file().then_some(default), variables, flags),
        }
    }

    fn of(
        file: Option<&Path>,
        environment: impl Iterator<Item = (String, String)>,
        flags: &Flags,
    ) -> Result<Self, ConfigError> {
        let values = sources::merged(file, environment, flags)?;
        let origin = |key: &str| Origin(sources::origin(&values, key).map(str::to_owned));
        // By way of JSON, for the crate's own values change types silently: "yes" to true, 1.5 to 2.
        let plain: serde_json::Value = values.clone().try_deserialize()?;
        let config: Self = serde_path_to_error::deserialize(plain).map_err(|error| {
            let key = error.path().to_string();
            ConfigError::Key { reason: error.inner().to_string(), origin: origin(&key), key }
        })?;
        config.check().map_err(|wrong| ConfigError::Bounds { origin: origin(wrong.key), wrong })?;
        Ok(config)
    }

    fn check(&self) -> Result<(), OutOfBounds> {
        self.jobs.check()?;
        self.limits.check()
    }
}

/// Checks that a value is within its bounds.
fn within<T: PartialOrd + Copy + fmt::Display>(
    key: &'static str,
    value: T,
    range: &std::ops::RangeInclusive<T>,
    bounds: &'static str,
) -> Result<(), OutOfBounds> {
    if range.contains(&value) {
        return Ok(());
    }
    Err(OutOfBounds { key, value: value.to_string(), bounds })
}

#[cfg(test)]
mod tests;
