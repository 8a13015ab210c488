//! Sources of values: the file, the environment, the flags. Each value keeps its source, so that an error can name it.

use super::ConfigError;
use config::{ConfigError as SourceError, Map, Source, Value};
use std::path::Path;

/// Begins the name of every environment variable that sets a key.
const PREFIX: &str = "cgda_";
/// Stands between section and key in the name of an environment variable.
const SEPARATOR: &str = "__";

/// Values of flags that were given.
#[derive(Debug, Clone, Default)]
pub struct Flags(Vec<(&'static str, Value)>);

impl Flags {
    /// Adds the value of `flag` (`--workers`) for `key` (`jobs.workers`), if it was given.
    #[must_use]
    pub fn with<T: Into<toml::Value>>(mut self, key: &'static str, flag: &str, value: Option<T>) -> Self {
        self.0.extend(value.map(|value| (key, from_toml(value.into(), flag))));
        self
    }
}

/// Values of one source by key; a key may be a path such as `jobs.workers`.
#[derive(Debug, Clone, Default)]
struct Layer(Map<String, Value>);

impl Source for Layer {
    fn clone_into_box(&self) -> Box<dyn Source + Send + Sync> {
        Box::new(self.clone())
    }

    fn collect(&self) -> Result<Map<String, Value>, SourceError> {
        Ok(self.0.clone())
    }
}

/// The values of all sources; the later source wins.
pub(super) fn merged(
    file: Option<&Path>,
    environment: impl Iterator<Item = (String, String)>,
    flags: &Flags,
) -> Result<Value, ConfigError> {
    let file = file.map_or_else(|| Ok(Layer::default()), read)?;
    let mut builder = config::Config::builder().add_source(file).add_source(Layer(environment_values(environment)));
    for (key, value) in &flags.0 {
        builder = builder.set_override(*key, value.clone())?;
    }
    Ok(builder.build()?.cache)
}

/// The source of the value at `path` (`jobs.workers`), or of anything in it.
pub(super) fn origin<'a>(values: &'a Value, path: &str) -> Option<&'a str> {
    let mut at = values;
    for key in path.split('.') {
        let key = key.split('[').next().unwrap_or(key);
        match &at.kind {
            config::ValueKind::Table(table) => at = table.get(key)?,
            _ => break,
        }
    }
    any_origin(at)
}

fn any_origin(value: &Value) -> Option<&str> {
    value.origin().or_else(|| match &value.kind {
        config::ValueKind::Table(table) => table.values().find_map(any_origin),
        _ => None,
    })
}

fn read(path: &Path) -> Result<Layer, ConfigError> {
    let text =
        std::fs::read_to_string(path).map_err(|source| ConfigError::Unreadable { path: path.to_owned(), source })?;
    let table: toml::Table =
        text.parse().map_err(|source| ConfigError::NoToml { path: path.to_owned(), source: Box::new(source) })?;
    let origin = path.display().to_string();
    Ok(Layer(table.into_iter().map(|(key, value)| (key, from_toml(value, &origin))).collect()))
}

/// Values of the variables `CGDA_SECTION__KEY`; names are read in any case.
fn environment_values(variables: impl Iterator<Item = (String, String)>) -> Map<String, Value> {
    let keyed = variables.filter_map(|(name, text)| {
        let lower = name.to_ascii_lowercase();
        let key = lower.strip_prefix(PREFIX).filter(|key| key.contains(SEPARATOR))?;
        Some((key.replace(SEPARATOR, "."), from_toml(from_text(&text), &name)))
    });
    keyed.collect()
}

/// A TOML value if `text` is one (`7`, `true`, `["a", "b"]`), else plain text; the strings of a list need no quotes.
fn from_text(text: &str) -> toml::Value {
    let document = format!("value = {text}").parse::<toml::Table>();
    if let Ok(mut table) = document
        && table.len() == 1
        && let Some(value) = table.remove("value")
    {
        return value;
    }
    let list = text.trim().strip_prefix('[').and_then(|rest| rest.strip_suffix(']'));
    let Some(list) = list else { return text.into() };
    list.split(',').map(str::trim).filter(|item| !item.is_empty()).map(toml::Value::from).collect::<Vec<_>>().into()
}

fn from_toml(value: toml::Value, origin: &str) -> Value {
    let named = origin.to_owned();
    let new = |kind: config::ValueKind| Value::new(Some(&named), kind);
    match value {
        toml::Value::String(text) => new(text.into()),
        toml::Value::Integer(number) => new(number.into()),
        toml::Value::Float(number) => new(number.into()),
        toml::Value::Boolean(truth) => new(truth.into()),
        toml::Value::Datetime(time) => new(time.to_string().into()),
        toml::Value::Array(items) => {
            new(items.into_iter().map(|item| from_toml(item, origin)).collect::<Vec<_>>().into())
        }
        toml::Value::Table(table) => {
            new(table.into_iter().map(|(key, item)| (key, from_toml(item, origin))).collect::<Map<_, _>>().into())
        }
    }
}
