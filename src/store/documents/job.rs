//! The documents of a job that never change: its request, the work resolved from it, and why it failed.

use super::{document, unchanged, versions, whole_document};
use crate::app::model::{self, CreateJob, JobFailure};

whole_document! {
    /// The request, with everything left open filled in.
    Request keeps CreateJob
}
versions! { Request keeps CreateJob, "request", [unchanged] }

whole_document! {
    /// All that a worker needs.
    Work keeps model::Work
}
versions! { Work keeps model::Work, "work", [unchanged] }

document! {
    /// Why a job failed.
    Failure keeps JobFailure {
        code: String,
        message: String,
    }
}
versions! { Failure keeps JobFailure, "failure", [unchanged] }
