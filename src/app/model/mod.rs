//! The vocabulary of the service: ids, pages, times, errors, and the requests and views of each resource.
//!
//! # Architecture Invariants
//! - The ground floor of `app`: imports the framework only. Ports import the model, use-cases import both.
//! - The request and view types are the REST bodies.

mod action;
mod demonstration;
mod error;
mod execution_work;
mod experiment;
mod export;
mod id;
mod job;
mod job_cost;
mod job_event;
mod job_kind;
mod job_progress;
pub mod limits;
mod method;
mod page;
mod recognition;
mod robot;
mod run;
mod samples;
mod time;
mod trajectory;
mod upload;
mod world;

pub use action::{ActionGoals, ActionView, Interpolation};
pub use demonstration::{DemonstrationReport, DemonstrationView, PatchDemonstration, StreamView};
pub use error::{AppError, ErrorKind, FieldError};
pub use execution_work::ExecutionWork;
pub use experiment::{
    EveryTable, ExperimentComparison, ExperimentRequest, ExperimentTable, ExperimentView, PaperTable, RowFilter,
};
pub use export::Export;
pub use id::{ActionId, DemonstrationId, ExperimentId, IdError, JobId, RobotId, RunId, TrajectoryId, WorldId};
pub use job::{JobFailure, JobFilter, JobResult, JobView};
pub use job_cost::{CostEstimate, Validation};
pub use job_event::{EventData, EventPage, JobEvent};
pub use job_kind::{CreateJob, EarlierRun, ExecutionRequest, GeneralizationRequest, JobKind, Work};
pub use job_progress::{GoalProgress, JobProgress, TrialProgress};
pub use method::{MethodList, MethodView, ParameterType, ParameterView};
pub use page::{Keyset, Page, PageQuery};
pub use recognition::{IncomparableCandidate, Observed, RecognitionCandidate, RecognitionView, RecognizeRequest};
pub use robot::{CreateRobot, RobotView};
pub use run::{Convergence, ConvergencePoint, PathPose, RunFilter, RunGoal, RunGoals, RunTrials, RunView};
pub use samples::{SamplesQuery, SamplesView, Series};
pub use time::Timestamp;
pub use trajectory::{TrajectoryPoint, TrajectoryView};
pub use upload::{UploadDemonstration, UploadFile, UploadOptions};
pub use world::{CreateWorld, WorldView};
