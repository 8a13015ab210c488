//! A feature: one scalar measured over time (an object's x; % of a wall painted; a force).

use serde::{Deserialize, Serialize};

/// Name and unit of one scalar feature.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct Feature {
    /// Unique within its demonstration or action, for example `x` or `painted`.
    pub name: String,
    /// Unit symbol, for example `m`, `mm`, `%`, `N`; empty if unknown.
    #[serde(default)]
    pub unit: String,
}

impl Feature {
    /// Creates a feature from its name and unit.
    pub fn new(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { name: name.into(), unit: unit.into() }
    }

    /// Parses a column header: `x [mm]`, `x (mm)` or `x`.
    #[must_use]
    pub fn from_header(header: &str) -> Self {
        let header = header.trim();
        for (open, close) in [('[', ']'), ('(', ')')] {
            if let Some((name, unit)) = header.strip_suffix(close).and_then(|rest| rest.rsplit_once(open)) {
                return Self::new(name.trim(), unit.trim());
            }
        }
        Self::new(header, "")
    }

    /// Column header `x [mm]`, or `x` if it has no unit.
    #[must_use]
    pub fn header(&self) -> String {
        if self.unit.is_empty() { self.name.clone() } else { format!("{} [{}]", self.name, self.unit) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn header_holds_name_and_unit() {
        for feature in [Feature::new("x", "mm"), Feature::new("Tx", "N m"), Feature::new("score", "")] {
            assert_eq!(Feature::from_header(&feature.header()), feature);
        }
        assert_eq!(Feature::from_header(" painted (%) "), Feature::new("painted", "%"));
    }
}
