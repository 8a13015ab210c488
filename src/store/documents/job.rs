//! The documents of a job that never change: its request, the work resolved from it, and the reason of its failure.
//!
//! They are types of the store down to the specifications that the core reads: method, constraints, handling, reality,
//! world, robot, cells of an experiment. Those are some sixty types that a copy would only repeat, so they are stored as
//! the core writes them, and saved documents in `tests/fixtures/documents/` pin that form.

use super::{complete, document, unchanged, versions};
use crate::app::model::{
    self, ActionId, CreateJob, DemonstrationId, EarlierRun, ExecutionRequest, ExecutionWork, ExperimentId,
    ExperimentRequest, GeneralizationRequest, JobFailure, PaperTable, RobotId, WorldId,
};
use crate::framework::execution::{ExecutionSpec, Problem};
use crate::framework::experiment::{CellSpec, MatrixSpec};
use crate::framework::generalization::Weighting;
use crate::framework::recognition::Metric;
use crate::framework::trajectory::PlanSpec;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// The request with its defaults filled in.
#[derive(Debug, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub(in crate::store) enum Request {
    Generalization(Generalization),
    Execution(Box<RequestedExecution>),
    Experiment(RequestedExperiment),
}
versions! { Request keeps CreateJob, "request", [unchanged, with_collisions] }

/// Version 1 of the builds that did not check collisions.
fn with_collisions(mut request: Value) -> Value {
    if request["kind"] == "execution" {
        complete(&mut request, "avoid_collisions", false);
    }
    request
}

/// Work for a worker.
#[derive(Debug, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub(in crate::store) enum Work {
    Generalization(Generalization),
    Execution(Box<ResolvedExecution>),
    Experiment { experiment: ExperimentId },
}
versions! { Work keeps model::Work, "work", [unchanged] }

document! {
    /// A generalization, which needs no resolving.
    Generalization keeps GeneralizationRequest {
        name: String,
        demonstrations: Vec<DemonstrationId>,
        t_min_s: f64,
        weighting: Weighting,
        features: Option<Vec<String>>,
        metric: Metric,
    }
}

document! {
    /// An execution as requested.
    RequestedExecution keeps ExecutionRequest {
        name: Option<String>,
        action: ActionId,
        robot: RobotId,
        world: WorldId,
        execution: ExecutionSpec,
        seed: Option<u64>,
        repetitions: u32,
        max_evaluations_per_s: Option<f64>,
        earlier_runs: Option<Vec<EarlierRun>>,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        planning: Option<PlanSpec>,
        avoid_collisions: Option<bool>,
    }
}

document! {
    /// An execution as resolved.
    ResolvedExecution keeps ExecutionWork {
        action: ActionId,
        robot: RobotId,
        world: WorldId,
        problem: Problem,
        #[serde(rename = "setting")]
        setup_key: Option<String>,
        seed: u64,
        repetitions: u32,
        max_evaluations_per_s: Option<f64>,
        #[serde(default, skip_serializing_if = "PlanSpec::is_default")]
        planning: PlanSpec,
    }
}

document! {
    /// An experiment as requested; its plan is stored with the experiment.
    RequestedExperiment keeps ExperimentRequest {
        name: Option<String>,
        seed: Option<u64>,
        repetitions: u32,
        paper_table: Option<PaperTable>,
        cells: Vec<CellSpec>,
        matrix: Option<MatrixSpec>,
    }
}

document! {
    /// The reason of a failure.
    Failure keeps JobFailure {
        code: String,
        message: String,
    }
}
versions! { Failure keeps JobFailure, "failure", [unchanged] }

impl From<CreateJob> for Request {
    fn from(request: CreateJob) -> Self {
        match request {
            CreateJob::Generalization(request) => Self::Generalization(request.into()),
            CreateJob::Execution(request) => Self::Execution(Box::new((*request).into())),
            CreateJob::Experiment(request) => Self::Experiment(request.into()),
        }
    }
}

impl From<Request> for CreateJob {
    fn from(document: Request) -> Self {
        match document {
            Request::Generalization(document) => Self::Generalization(document.into()),
            Request::Execution(document) => Self::Execution(Box::new((*document).into())),
            Request::Experiment(document) => Self::Experiment(document.into()),
        }
    }
}

impl From<model::Work> for Work {
    fn from(work: model::Work) -> Self {
        match work {
            model::Work::Generalization(work) => Self::Generalization(work.into()),
            model::Work::Execution(work) => Self::Execution(Box::new((*work).into())),
            model::Work::Experiment { experiment } => Self::Experiment { experiment },
        }
    }
}

impl From<Work> for model::Work {
    fn from(document: Work) -> Self {
        match document {
            Work::Generalization(document) => Self::Generalization(document.into()),
            Work::Execution(document) => Self::Execution(Box::new((*document).into())),
            Work::Experiment { experiment } => Self::Experiment { experiment },
        }
    }
}
