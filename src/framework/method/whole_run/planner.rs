//! The contract of a search for all goals at once, by ask and tell, and of a method that begins one.

use super::space::Space;
use super::steps::Targets;
use crate::CellSet;
use crate::method::per_goal::StopReason;
use crate::robot::Chain;
use crate::world::{WorldError, WorldSpec};
use serde::{Deserialize, Serialize};

/// A map from joints to features: a simulated world, right or wrong, as a prior mean.
pub trait FeatureMap: Send {
    /// Writes the m features expected at `joints` (rad or m).
    fn predict(&mut self, joints: &[f64], features: &mut [f64]);
}

impl<F: FnMut(&[f64], &mut [f64]) + Send> FeatureMap for F {
    fn predict(&mut self, joints: &[f64], features: &mut [f64]) {
        self(joints, features);
    }
}

/// One executed pose and what was seen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Trial {
    /// Joints as commanded, rad or m.
    pub joints: Vec<f64>,
    /// The m features seen; null if the observation was lost.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub observation: Option<Vec<f64>>,
    /// The cells seen affected after it, 64 per word, row-major, lowest bit first; null if cells are not seen.
    #[cfg_attr(feature = "schema", schema(value_type = Option<Vec<u64>>, required = true))]
    pub cells: Option<CellSet>,
    /// The goal the pose was tried for.
    pub goal: usize,
}

/// Next step of a run.
#[derive(Debug, Clone, PartialEq)]
pub enum NextTrial {
    /// Execute this pose.
    Execute {
        /// Joints, rad or m.
        joints: Vec<f64>,
        /// The goal it is meant for.
        goal: usize,
    },
    /// No pose is expected to improve any goal.
    Finished,
}

/// The result for one goal.
#[derive(Debug, Clone, PartialEq)]
pub struct GoalOutcome {
    /// Index of the trial whose pose serves the goal best; `None` if the start does, before any trial, or if nothing was
    /// observed.
    pub trial: Option<usize>,
    /// Its distance from the goal, features' unit (with noise: of the model's mean there); infinite if nothing was
    /// observed.
    pub distance: f64,
}

/// Knowledge of the undisturbed features at a pose.
#[derive(Debug, Clone, PartialEq)]
pub struct Believed {
    /// Their m means, features' unit.
    pub mean: Vec<f64>,
    /// Variance of each of them, features' unit squared.
    pub variance: f64,
}

/// A search for all goals at once. Its state is its configuration and its log: to resume, tell a fresh one the log.
pub trait WholeRun: Send {
    /// The next pose, a function of configuration, seed and log alone.
    fn ask(&mut self) -> NextTrial;

    /// Appends a trial and learns from it.
    fn tell(&mut self, trial: Trial);

    /// The trials so far.
    fn log(&self) -> &[Trial];

    /// Indices of the trials whose effect stays: they are executed again before each trial if the world was put back.
    fn accepted(&self) -> &[usize] {
        &[]
    }

    /// The best own trial of each goal.
    fn outcomes(&mut self) -> Vec<GoalOutcome>;

    /// Whether the goal ended because its trials were used up, with hope left.
    fn is_used_up(&self, goal: usize) -> bool;

    /// Whether a restart from another region of the joint space has agreed that no pose comes nearer to the goal.
    fn has_restarted(&mut self, goal: usize) -> bool {
        let _ = goal;
        false
    }

    /// Knowledge of the undisturbed features at `poses`; `None` unless the method models them and knows their noise.
    fn believed(&mut self, poses: &[&[f64]]) -> Option<Vec<Believed>> {
        let _ = poses;
        None
    }

    /// Reason why the search for a goal ended that it did not come within the tolerance of.
    fn ended_by(&mut self, goal: usize) -> StopReason {
        if self.is_used_up(goal) {
            StopReason::MaxEvaluations
        } else if self.has_restarted(goal) {
            StopReason::OutOfReach
        } else {
            StopReason::NoImprovement
        }
    }
}

/// Input of a method that plans the whole run.
#[derive(Debug, Clone, Copy)]
pub struct RunSetup<'a> {
    /// The poses that may be executed.
    pub space: &'a Space,
    /// The goals, and when one is reached.
    pub targets: &'a Targets,
    /// The seed of the run.
    pub seed: u64,
    /// Most trials of a goal's own; `None` if there is no limit but the method's.
    pub max_evaluations_per_goal: Option<u64>,
    /// Trials of earlier runs on the same robot.
    pub earlier: &'a [Trial],
    /// The world, as described.
    pub world: &'a WorldSpec,
    /// The robot, as described.
    pub chain: &'a Chain,
    /// For each feature of the goals, its index among the world's.
    pub select: &'a [usize],
}

/// A method that begins one search for the whole run.
pub trait WholeRunMethod: Send + Sync {
    /// A fresh search; to resume, tell it the log.
    ///
    /// # Errors
    /// [`WorldError`] if a simulator is needed and the world cannot be built.
    fn start(&self, run: &RunSetup<'_>) -> Result<Box<dyn WholeRun>, WorldError>;

    /// Whether `max_evaluations_per_goal` is kept.
    fn keeps_goal_limits(&self) -> bool {
        false
    }

    /// Largest step of a joint from one trial to the next, degrees (of 180 per stroke for prismatic joints); `None` if
    /// any step will do.
    fn max_step_deg(&self) -> Option<f64> {
        None
    }
}
