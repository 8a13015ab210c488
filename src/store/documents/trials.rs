//! The trials of a run; the setting they were made on is a column.

use super::{document, versions};
use crate::framework::CellSet;
use crate::framework::method::whole_run::Trial;
use serde::{Deserialize, Serialize};
use serde_json::json;

/// Trials in the order they were made.
#[derive(Debug, Serialize, Deserialize)]
pub(in crate::store) struct Trials {
    trials: Vec<KeptTrial>,
}
versions! { Trials keeps Vec<Trial>, "trials", [|trials| json!({ "trials": trials })] }

document! {
    /// One executed pose and its observation.
    KeptTrial keeps Trial {
        joints: Vec<f64>,
        observation: Option<Vec<f64>>,
        cells: Option<CellSet>,
        goal: usize,
    }
}

impl From<Vec<Trial>> for Trials {
    fn from(trials: Vec<Trial>) -> Self {
        Self { trials: trials.into_iter().map(Into::into).collect() }
    }
}

impl From<Trials> for Vec<Trial> {
    fn from(document: Trials) -> Self {
        document.trials.into_iter().map(Into::into).collect()
    }
}
