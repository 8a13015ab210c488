//! Configuration from defaults, file, environment (`CGDA_SECTION__KEY`) and flags, in increasing order of precedence.
//! Unknown keys are errors.

mod jobs;
mod limits;
mod log;
mod server;

pub use jobs::JobsConfig;
pub use limits::LimitsConfig;
pub use log::{LogConfig, LogFormat};
pub use server::ServerConfig;

use figment::Figment;
use figment::providers::{Env, Format as _, Serialized, Toml};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// All settings.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
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
    /// A key or value is invalid.
    #[error("invalid configuration: {0}")]
    Wrong(#[from] Box<figment::Error>),
    /// A value is out of bounds.
    #[error("invalid configuration: {key} is {value}: give {bounds}")]
    Bounds {
        /// Name of the key.
        key: &'static str,
        /// Value given.
        value: String,
        /// Allowed values.
        bounds: &'static str,
    },
}

/// Values given as flags, as nested keys.
pub type Flags = figment::value::Dict;

impl Config {
    /// Reads `file` (by default `cgda.toml` in the working directory, if it exists), the environment and `flags`.
    ///
    /// # Errors
    /// [`ConfigError`] names the key.
    pub fn load(file: Option<&Path>, flags: &Flags) -> Result<Self, ConfigError> {
        let path = match file {
            Some(path) if !path.is_file() => return Err(ConfigError::NoFile { path: path.to_owned() }),
            Some(path) => path,
            None => Path::new("cgda.toml"),
        };
        let defaults = Figment::from(Serialized::defaults(Self::default()));
        let with_file = if path.is_file() { defaults.merge(Toml::file_exact(path)) } else { defaults };
        let config: Self = with_file
            .merge(Env::prefixed("CGDA_").split("__").filter(|key| key.as_str().contains('.')))
            .merge(Serialized::defaults(flags))
            .extract()
            .map_err(Box::new)?;
        config.check()?;
        Ok(config)
    }

    fn check(&self) -> Result<(), ConfigError> {
        self.jobs.check()?;
        self.limits.check()
    }
}

/// Checks that a value is within its bounds.
fn within<T: PartialOrd + Copy + std::fmt::Display>(
    key: &'static str,
    value: T,
    range: &std::ops::RangeInclusive<T>,
    bounds: &'static str,
) -> Result<(), ConfigError> {
    if range.contains(&value) {
        return Ok(());
    }
    Err(ConfigError::Bounds { key, value: value.to_string(), bounds })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn load(toml: &str) -> Result<Config, ConfigError> {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("cgda.toml");
        std::fs::write(&path, toml).unwrap();
        Config::load(Some(&path), &Flags::new())
    }

    #[test]
    fn a_file_changes_what_it_names_only() {
        let config = load("[jobs]\nworkers = 7\n").unwrap();
        assert_eq!(
            config,
            Config { jobs: JobsConfig { workers: Some(7), ..JobsConfig::default() }, ..Config::default() }
        );
    }

    #[test]
    fn unknown_keys_are_refused_by_name() {
        for (toml, name) in [("[jobs]\nworker = 7\n", "worker"), ("[job]\nworkers = 7\n", "job"), ("x = 1", "x")] {
            let text = load(toml).unwrap_err().to_string();
            assert!(text.contains(&format!("`{name}`")), "{text}");
        }
    }

    #[test]
    fn flags_win_over_the_file() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("cgda.toml");
        std::fs::write(&path, "[server]\nlisten = \"127.0.0.1:1\"\n").unwrap();
        let server = Flags::from([("listen".to_owned(), "127.0.0.1:2".into())]);
        let flags = Flags::from([("server".to_owned(), server.into())]);
        let config = Config::load(Some(&path), &flags).unwrap();
        assert_eq!(config.server.listen.port(), 2);
    }

    #[test]
    fn values_out_of_bounds_are_refused_with_the_bounds() {
        let text = load("[jobs]\nlease_ms = 10\n").unwrap_err().to_string();
        assert!(text.contains("jobs.lease_ms is 10"), "{text}");
    }
}
