//! The trials of a run; the setting they were made on is a column.

use super::versions;
use crate::framework::method::whole_run::Trial;
use serde::{Deserialize, Serialize};
use serde_json::json;

/// In the order they were made.
#[derive(Debug, Serialize, Deserialize)]
pub(in crate::store) struct Trials {
    trials: Vec<Trial>,
}
versions! { Trials keeps Vec<Trial>, "trials", [|trials| json!({ "trials": trials })] }

impl From<Vec<Trial>> for Trials {
    fn from(trials: Vec<Trial>) -> Self {
        Self { trials }
    }
}

impl From<Trials> for Vec<Trial> {
    fn from(document: Trials) -> Self {
        document.trials
    }
}
