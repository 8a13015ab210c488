//! Replay of a finished run: its path is executed once more in the world, as its trajectory will be, and the effect is
//! compared with that which the run claims.
//!
//! The effect is that of the world without noise and delay, around the robot of the run. A claimed observation that is
//! free of them must equal it. A noisy one must come about again with the same noise; the trajectory's poses must then
//! have the same effect as those of the path. Observations of a robot or with a delay show something else by nature:
//! for them only the second part is checked.

use super::error::ProblemError;
use super::path::PathPose;
use super::result::RunResult;
use super::setup::Setup;
use super::spec::Problem;
use crate::method::MethodKind;
use crate::method::per_goal::Provenance;
use crate::recognition::{Metric, discrepancy};
use crate::world::{self, DisturbanceSpec, World};
use crate::{CellSet, Feature};
use serde::{Deserialize, Serialize};

/// Largest difference of two values taken for equal: relative to the claimed value, and absolute below 1.
const ROUNDING: f64 = 1e-6;

/// Samples of a motion between two poses of the path.
pub const SAMPLES_PER_MOVE: usize = 10;

/// Effect of a run when it is executed once more in simulation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Replay {
    /// Discrepancy of the effects at the poses that serve the goals, features' unit.
    pub discrepancy: f64,
    /// Covered share after the last pose, %; absent unless the world is a surface.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub painted_percent: Option<f64>,
    /// Effect along the motion; absent if there is no trajectory.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub along: Option<AlongMotion>,
    /// The largest difference between claim and replay, relative to the claim; absent if they are equal or nothing can
    /// be compared.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub largest_difference: Option<Difference>,
    /// Whether claim and replay agree, up to rounding.
    pub agrees: bool,
}

/// A replay with the cells it covers.
#[derive(Debug, Clone, PartialEq)]
pub struct Replayed {
    /// Figures of the effect.
    pub replay: Replay,
    /// The covered cells after the last pose; `None` unless the world is a surface.
    pub cells: Option<CellSet>,
}

/// Effect along a motion, not only at its poses.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct AlongMotion {
    /// Discrepancy of the effects along the motion from the first goal on, against straight lines between the goals,
    /// features' unit. Both are sampled ten times per move and the sum is divided by ten, so that it compares with the
    /// discrepancy at the poses. Standard borders whatever the run's metric.
    pub discrepancy: f64,
    /// Share that a tool that never lifts covers on its way, %; absent unless the world is a surface.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub painted_percent: Option<f64>,
}

/// A feature that replay shows differently.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Difference {
    /// Index of the pose in the run's path, from 0.
    pub pose: u32,
    /// Index of the first goal that the pose serves, from 0; absent if it serves none.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub goal: Option<u32>,
    /// Name of the feature.
    pub feature: String,
    /// Value that the run claims, feature's unit.
    pub claimed: f64,
    /// Value that the replay shows, feature's unit.
    pub replayed: f64,
}

/// A motion along the path of a run.
#[derive(Debug, Clone, Copy)]
pub struct Moves<'a> {
    /// Poses of the motion, one per pose of the run's path; joints in gene order, rad or m.
    pub poses: &'a [Vec<f64>],
    /// For each pose but the first, [`SAMPLES_PER_MOVE`] poses on the way to it, which end with it; empty if there is
    /// no trajectory.
    pub between: &'a [Vec<Vec<f64>>],
}

/// Executes `moves` in the world of `problem` and compares the effect with the claims of `result`.
///
/// # Errors
/// [`ProblemError`] if `result` does not belong to the problem.
pub fn replay(problem: &Problem, result: &RunResult, moves: Moves<'_>) -> Result<Replayed, ProblemError> {
    let (setup, method) = Setup::of(problem)?;
    if moves.poses.len() != result.path.len() {
        let (found, expected) = (moves.poses.len(), result.path.len());
        return Err(ProblemError::Shape { what: "poses of the motion", found, expected });
    }
    Replayer { setup: &setup, method: &method, result }.run(moves)
}

struct Replayer<'a> {
    setup: &'a Setup,
    method: &'a MethodKind,
    result: &'a RunResult,
}

impl Replayer<'_> {
    fn run(&self, moves: Moves<'_>) -> Result<Replayed, ProblemError> {
        let mut world = self.quiet_world()?;
        let shown = self.effects(world.as_mut(), moves.poses.iter().map(Vec::as_slice));
        let cells = world.cells().cloned();
        let mut differences = Differences::new(&self.result.path, self.setup.goals.features());
        let disturbance = self.setup.spec.reality.as_ref();
        let late = disturbance.is_some_and(|d| d.latency_s > d.settle_s);
        let real = self.result.goals.iter().any(|goal| goal.provenance == Provenance::Real);
        let noisy = disturbance.is_some_and(|d| d.sensor_noise > 0.0 || d.joint_noise_deg > 0.0 || d.lost_share > 0.0);
        if late || real || noisy {
            let executed = self.result.path.iter().map(|pose| pose.joints.as_slice());
            let expected = self.effects(world.as_mut(), executed);
            differences.compare(expected.iter().map(|row| Some(row.as_slice())), &shown);
            if noisy && !late && !real {
                differences.compare(claims(&self.result.path), &self.noisy_again()?);
            }
        } else {
            differences.compare(claims(&self.result.path), &shown);
        }
        let (largest_difference, agrees) = differences.finish();
        let replay = Replay {
            discrepancy: self.discrepancy(&shown),
            painted_percent: self.setup.painted.and(shown.last()).map(|_| share(cells.as_ref(), self.cell_count())),
            along: self.along(world.as_mut(), moves),
            largest_difference,
            agrees,
        };
        Ok(Replayed { replay, cells })
    }

    fn cell_count(&self) -> usize {
        self.setup.world.properties().surface.map_or(0, |surface| surface.cells())
    }

    /// The world around the robot of the run, without noise and delay.
    fn quiet_world(&self) -> Result<Box<dyn World>, ProblemError> {
        let quiet = self.setup.spec.reality.as_ref().map(|disturbance| DisturbanceSpec {
            sensor_noise: 0.0,
            joint_noise_deg: 0.0,
            lost_share: 0.0,
            latency_s: 0.0,
            settle_s: 0.0,
            ..disturbance.clone()
        });
        Ok(world::simulated(&self.setup.world, quiet.as_ref(), &self.setup.chain, self.result.seed)?)
    }

    /// Effects after each of `poses`, in the goals' features; the world is reset first.
    fn effects<'p>(&self, world: &mut dyn World, poses: impl Iterator<Item = &'p [f64]>) -> Vec<Vec<f64>> {
        let mut seen = vec![0.0; self.setup.world_features];
        world.reset();
        let commit = |joints: &[f64]| {
            world.commit(joints, &mut seen);
            self.setup.select.iter().map(|&source| seen[source]).collect()
        };
        poses.map(commit).collect()
    }

    /// The observations of the path once more, with the noise of the run.
    fn noisy_again(&self) -> Result<Vec<Vec<f64>>, ProblemError> {
        let (setup, seed) = (self.setup, self.result.seed);
        let mut world = world::simulated(&setup.world, setup.spec.reality.as_ref(), &setup.chain, seed)?;
        let from_home = matches!(self.method, MethodKind::WholeRun(_)) && setup.painted.is_none();
        let executed = self.result.path.iter().map(|pose| pose.joints.as_slice());
        if !from_home {
            return Ok(self.effects(world.as_mut(), executed));
        }
        Ok(executed.flat_map(|joints| self.effects(world.as_mut(), std::iter::once(joints))).collect())
    }

    /// Discrepancy of the rows that serve the goals.
    fn discrepancy(&self, shown: &[Vec<f64>]) -> f64 {
        let serving = (0..self.setup.goals.len()).filter_map(|goal| {
            self.result.path.iter().position(|pose| pose.goals.contains(&goal)).map(|pose| shown[pose].as_slice())
        });
        let observed: Vec<f64> = serving.flatten().copied().collect();
        discrepancy(self.setup.spec.metric, &observed, self.setup.goals.values(), self.setup.select.len())
    }

    /// Effect along the motion; `None` if there is no trajectory.
    fn along(&self, world: &mut dyn World, moves: Moves<'_>) -> Option<AlongMotion> {
        let first = moves.poses.first()?;
        if moves.between.len() + 1 != moves.poses.len() {
            return None;
        }
        let on_the_way = moves.between.iter().flatten().map(Vec::as_slice);
        let observed = self.effects(world, std::iter::once(first.as_slice()).chain(on_the_way)).concat();
        let metric = match self.setup.spec.metric {
            Metric::SumOfFeatures => Metric::SumOfFeatures,
            Metric::Multivariate | Metric::Aquila => Metric::Multivariate,
        };
        let total = discrepancy(metric, &observed, &self.lines(), self.setup.select.len());
        // The sum over features is a mean over the path already.
        let per_pose = if metric == Metric::SumOfFeatures { 1.0 } else { SAMPLES_PER_MOVE as f64 };
        let count = self.cell_count();
        Some(AlongMotion {
            discrepancy: total / per_pose,
            painted_percent: self.setup.painted.map(|_| share(world.cells(), count)),
        })
    }

    /// Straight lines between the goals, [`SAMPLES_PER_MOVE`] rows per line.
    fn lines(&self) -> Vec<f64> {
        let goals = &self.setup.goals;
        let mut rows = goals.row(0).to_vec();
        for (from, to) in (1..goals.len()).map(|goal| (goals.row(goal - 1), goals.row(goal))) {
            for step in 1..=SAMPLES_PER_MOVE {
                let along = step as f64 / SAMPLES_PER_MOVE as f64;
                rows.extend(from.iter().zip(to).map(|(a, b)| a + (b - a) * along));
            }
        }
        rows
    }
}

/// The observations that a path claims.
fn claims(path: &[PathPose]) -> impl Iterator<Item = Option<&[f64]>> {
    path.iter().map(|pose| pose.observation.as_deref())
}

/// Share of `count` cells that are in `cells`, %.
fn share(cells: Option<&CellSet>, count: usize) -> f64 {
    100.0 * f64::from(cells.map_or(0, CellSet::count)) / count.max(1) as f64
}

/// Search for the largest difference between claimed and replayed rows.
struct Differences<'a> {
    path: &'a [PathPose],
    features: &'a [Feature],
    largest: Option<(f64, Difference)>,
}

impl<'a> Differences<'a> {
    fn new(path: &'a [PathPose], features: &'a [Feature]) -> Self {
        Self { path, features, largest: None }
    }

    fn compare<'r>(&mut self, claimed: impl Iterator<Item = Option<&'r [f64]>>, replayed: &[Vec<f64>]) {
        for (index, (claimed, replayed)) in claimed.zip(replayed).enumerate() {
            let Some(claimed) = claimed else { continue };
            for (feature, (&claimed, &replayed)) in claimed.iter().zip(replayed).enumerate() {
                let size = (claimed - replayed).abs() / claimed.abs().max(1.0);
                let size = if size.is_nan() { f64::INFINITY } else { size };
                if size > self.largest.as_ref().map_or(0.0, |largest| largest.0) {
                    self.largest = Some((size, self.difference(index, feature, claimed, replayed)));
                }
            }
        }
    }

    fn difference(&self, pose: usize, feature: usize, claimed: f64, replayed: f64) -> Difference {
        let small = |index: usize| u32::try_from(index).unwrap_or(u32::MAX);
        Difference {
            pose: small(pose),
            goal: self.path[pose].goals.first().map(|&goal| small(goal)),
            feature: self.features[feature].name.clone(),
            claimed,
            replayed,
        }
    }

    /// The largest difference, and whether it is rounding.
    fn finish(self) -> (Option<Difference>, bool) {
        let agrees = self.largest.as_ref().is_none_or(|(size, _)| *size <= ROUNDING);
        (self.largest.map(|(_, difference)| difference), agrees)
    }
}

impl std::fmt::Display for Difference {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { pose, goal, feature, claimed, replayed } = self;
        let serves = goal.map_or_else(String::new, |goal| format!(" (goal {goal})"));
        write!(f, "at pose {pose}{serves} the run claims {feature} = {claimed}, but its replay shows {replayed}")
    }
}
