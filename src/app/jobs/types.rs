//! Requests for jobs, and what is shown of them.

use crate::app::experiments::ExperimentRequest;
use crate::app::id::{ActionId, DemonstrationId, ExperimentId, JobId, RobotId, RunId, TrajectoryId, WorldId};
use crate::app::runs::RunGoal;
use crate::app::{FieldError, Timestamp, null_as_infinite};
use crate::framework::execution::{Chosen, ExecutionSpec};
use crate::framework::generalization::Weighting;
use crate::framework::job::State;
use crate::framework::optimizer::StopReason;
use crate::framework::recognition::Metric;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// What a job does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum JobKind {
    /// Makes an action of demonstrations.
    Generalization,
    /// Finds the joint trajectory with which a robot produces an action's effects.
    Execution,
    /// Runs many settings many times and compares them.
    Experiment,
}

impl JobKind {
    /// The name in JSON and in the store.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Generalization => "generalization",
            Self::Execution => "execution",
            Self::Experiment => "experiment",
        }
    }
}

/// A new job; `kind` picks one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum CreateJob {
    /// Makes an action of demonstrations.
    Generalization(GeneralizationRequest),
    /// Executes an action on a robot.
    Execution(Box<ExecutionRequest>),
    /// Runs many settings many times.
    Experiment(ExperimentRequest),
}

/// Which demonstrations become an action, and how.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct GeneralizationRequest {
    /// Name of the action; a taken name makes a new version of it.
    pub name: String,
    /// At least one, each once.
    pub demonstrations: Vec<DemonstrationId>,
    /// Shortest time between goals, seconds (> 0).
    pub t_min_s: f64,
    /// How samples are weighted.
    #[serde(default)]
    pub weighting: Weighting,
    /// Features by name, in the order they shall have; all when absent.
    #[serde(default)]
    pub features: Option<Vec<String>>,
    /// Default metric for recognition.
    #[serde(default)]
    pub metric: Metric,
}

/// Which action is executed on which robot in which world, and how.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct ExecutionRequest {
    /// Display name; made of the names of action and robot when absent.
    #[serde(default)]
    pub name: Option<String>,
    /// The action.
    pub action: ActionId,
    /// The robot.
    pub robot: RobotId,
    /// The world.
    pub world: WorldId,
    /// Method, metric, when a goal ends.
    pub execution: ExecutionSpec,
    /// Seed of the first repetition, below 2^53; drawn and recorded when absent. Repetition r uses seed + r.
    #[serde(default)]
    pub seed: Option<u64>,
    /// Number of runs, 1 to 1000.
    #[serde(default = "one")]
    pub repetitions: u32,
    /// Slows the job down to about so many evaluations a second, to be watched.
    #[serde(default)]
    pub max_evaluations_per_s: Option<f64>,
    /// Runs on the same robot, with the same tool, world and features, whose trials the method `model` begins with,
    /// newest first. When absent they are found, and told here; an empty list is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub earlier_runs: Option<Vec<EarlierRun>>,
}

/// A run whose trials another one begins with.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct EarlierRun {
    /// The run.
    pub run: RunId,
    /// Its job; filled in.
    #[serde(default)]
    pub job: Option<JobId>,
    /// How many of its trials are used, the latest ones; filled in.
    #[serde(default)]
    pub trials: Option<u32>,
}

fn one() -> u32 {
    1
}

/// A job as it stands.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct JobView {
    /// Its id.
    pub id: JobId,
    /// What it does.
    pub kind: JobKind,
    /// Display name.
    pub name: String,
    /// Where it stands.
    pub state: State,
    /// Why, where there is more to say than the state.
    pub state_reason: Option<String>,
    /// Since when.
    pub state_since: Timestamp,
    /// How often a worker claimed it.
    pub attempt: u32,
    /// How far it is.
    pub progress: JobProgress,
    /// The request, with what was left open filled in.
    pub request: CreateJob,
    /// What it made so far.
    pub result: JobResult,
    /// Why it failed.
    pub failure: Option<JobFailure>,
    /// Sequence number of its last event.
    pub last_seq: u64,
    /// When it was submitted.
    pub created_at: Timestamp,
    /// When a worker first started it.
    pub started_at: Option<Timestamp>,
    /// When it ended.
    pub finished_at: Option<Timestamp>,
}

/// How far a job is.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct JobProgress {
    /// Finished share, 0 to 1.
    pub fraction: f64,
    /// Present repetition, from 0.
    pub repetition: u32,
    /// Number of repetitions.
    pub repetitions: u32,
    /// Present goal of the present repetition, from 0.
    pub goal_index: u32,
    /// Number of goals.
    pub goals: u32,
    /// Evaluations of the present repetition.
    pub evaluations: u64,
    /// Evaluations of the present goal.
    pub goal_evaluations: u64,
    /// Evaluations of all repetitions.
    pub total_evaluations: u64,
    /// Best discrepancy of the present goal, features' unit.
    pub discrepancy: Option<f64>,
    /// Finished goals of the present repetition; left out of events, which tell each goal once.
    pub finished_goals: Vec<GoalProgress>,
    /// Trials of the present repetition, where the method remembers each one; left out of events likewise.
    #[serde(default)]
    pub trials: Vec<TrialProgress>,
}

/// One trial of a method that owns the whole run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct TrialProgress {
    /// Repetition, from 0.
    pub repetition: u32,
    /// Trial, from 0.
    pub index: u32,
    /// The goal it was made for, from 0.
    pub goal: u32,
    /// Distance of what was observed from that goal (Euclidean, features' unit); none when the observation was lost.
    pub residual: Option<f64>,
}

/// One finished goal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct GoalProgress {
    /// Repetition, from 0.
    pub repetition: u32,
    /// Goal, from 0.
    pub index: u32,
    /// Evaluations of this goal.
    pub evaluations: u64,
    /// Discrepancy of the observation up to this goal, features' unit.
    #[serde(deserialize_with = "null_as_infinite::number")]
    pub discrepancy: f64,
    /// Why the goal ended.
    pub stop_reason: StopReason,
    /// Free joints, rad or m.
    pub joints: Vec<f64>,
    /// What was observed there.
    #[serde(deserialize_with = "null_as_infinite::numbers")]
    pub observation: Vec<f64>,
    /// Distance of the observation from the goal (Euclidean, features' unit): for a goal out of reach the best found.
    #[serde(default)]
    pub residual: Option<f64>,
}

impl GoalProgress {
    /// The same goal, as the run shows it.
    #[must_use]
    pub fn of_run(repetition: u32, goal: &RunGoal) -> Self {
        Self {
            repetition,
            index: goal.index,
            evaluations: goal.evaluations,
            discrepancy: goal.discrepancy,
            stop_reason: goal.stop_reason,
            joints: goal.joints.clone(),
            observation: goal.observation.clone(),
            residual: goal.residual,
        }
    }
}

/// What a job made.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct JobResult {
    /// The action, of a generalization.
    pub action: Option<ActionId>,
    /// The runs, of an execution, in the order of repetitions.
    pub runs: Vec<RunId>,
    /// The experiment, from its submission on.
    #[serde(default)]
    pub experiment: Option<ExperimentId>,
}

/// Why a job failed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct JobFailure {
    /// Stable code.
    pub code: String,
    /// What happened, with the numbers.
    pub message: String,
}

/// Which jobs.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct JobFilter {
    /// In one of these states; any when empty.
    pub states: Vec<State>,
    /// Of this kind.
    pub kind: Option<JobKind>,
}

/// One event of a job.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct JobEvent {
    /// 1 for the first event of the job, then counted up without gaps.
    pub seq: u64,
    /// The job.
    pub job: JobId,
    /// When.
    pub at: Timestamp,
    /// What.
    #[serde(flatten)]
    pub data: EventData,
}

/// What happened; `type` picks one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum EventData {
    /// The job is in another state.
    State {
        /// The new state.
        state: State,
        /// Why.
        reason: Option<String>,
        /// How often a worker claimed it.
        attempt: u32,
    },
    /// The job went on.
    Progress {
        /// How far it is.
        progress: JobProgress,
    },
    /// Events before this one are not kept or were never there: read the job anew. Sent, never stored.
    Resync,
    /// A goal ended.
    Goal {
        /// The goal.
        goal: GoalProgress,
    },
    /// A method that owns the whole run made a trial.
    Trial {
        /// The trial.
        trial: TrialProgress,
    },
    /// A repetition ended.
    Run {
        /// The run.
        run: RunId,
        /// Its trajectory.
        trajectory: Option<TrajectoryId>,
        /// Repetition, from 0.
        repetition: u32,
        /// Its seed.
        seed: u64,
        /// Evaluations.
        evaluations: u64,
        /// Discrepancy, features' unit.
        #[serde(deserialize_with = "null_as_infinite::number")]
        discrepancy: f64,
        /// Share painted, %.
        painted_percent: Option<f64>,
        /// SHA-256 of the result's bits, hexadecimal.
        digest: String,
    },
}

/// Some events of a job.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct EventPage {
    /// Events in the order of `seq`.
    pub events: Vec<JobEvent>,
    /// The asked position is unknown (too old or of another server): read the job anew and go on after `last_seq`.
    pub resync: bool,
    /// Sequence number of the job's last event.
    pub last_seq: u64,
    /// Whether the job is final and these are its last events.
    pub end: bool,
}

/// The answer of a dry run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Validation {
    /// Whether the job would be accepted.
    pub valid: bool,
    /// What is wrong with it.
    pub errors: Vec<FieldError>,
    /// What it would cost, if it is valid.
    pub estimate: Option<CostEstimate>,
    /// Which method `auto` stands for, and why, if the job asks for it.
    pub chosen: Option<Chosen>,
}

/// What a job will cost, roughly.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct CostEstimate {
    /// Evaluations of all repetitions.
    pub evaluations: u64,
    /// Time on this machine in simulation, seconds.
    pub simulated_s: f64,
    /// Time if each evaluation were a trial on a robot, seconds.
    pub robot_s: f64,
    /// The cost in words, for example `about 16 evaluations; at 15 s each, 4 minutes of robot time`.
    pub text: String,
    /// How the estimate was made.
    pub basis: String,
}
