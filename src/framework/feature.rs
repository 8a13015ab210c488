//! A feature: one scalar that is measured over time (an object's x; % of a wall painted; a force).

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Name and unit of one scalar feature.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct Feature {
    /// Unique within its demonstration or action, for example `x` or `painted`.
    pub name: String,
    /// Unit symbol, for example `m`, `mm`, `%`, `N`; empty where unknown.
    #[serde(default)]
    pub unit: String,
}

impl Feature {
    /// A feature of that name and unit.
    pub fn new(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { name: name.into(), unit: unit.into() }
    }
}
