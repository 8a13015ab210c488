//! The verdict on each goal and on a run: decided here, from what was executed, and nowhere else.
//!
//! A goal's verdict depends on the executed observation, not on the reason why its search ended: a search that ended by
//! stagnation may have reached its goal, and one that ended well in its own eyes may have missed it.
//!
//! | verdict | distance of the executed observation | the search |
//! |---|---|---|
//! | `reached` | at most the tolerance | any |
//! | `out_of_reach` | more | expects no pose to come nearer, and a restart from another region agreed |
//! | `stopped_short` | more | anything else |

use super::spec::ExecutionSpec;
use crate::generalization::Goals;
use crate::method::per_goal::StopReason;
use crate::world::WorldProperties;
use serde::{Deserialize, Serialize};

/// Tolerance as a share of the goals' extent, if the problem gives none and the world has no surface.
const TOLERANCE_SHARE: f64 = 0.1;

/// Largest rise between the goals of a surface by which its tolerance is measured, %.
const MOST_RISE: f64 = 5.0;

/// Whether a goal was reached, and if not, whether it can be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The executed observation is within the tolerance of the goal.
    Reached,
    /// It is not; a nearer pose may exist.
    #[default]
    StoppedShort,
    /// It is not, and no pose is expected to come nearer: a restart from another region of the joint space agreed.
    OutOfReach,
}

/// A goal's verdict with its grounds.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Judgement {
    /// Reached, stopped short or out of reach.
    pub verdict: Verdict,
    /// Euclidean distance of the executed observation from the goal, features' unit; absent if the winner was never
    /// executed.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub distance: Option<f64>,
    /// Largest distance that counts as reached, features' unit.
    pub tolerance: f64,
}

impl Judgement {
    /// Judges the `distance` of an executed observation; `None` if nothing was executed.
    #[must_use]
    pub(super) fn new(distance: Option<f64>, tolerance: f64, stop_reason: StopReason) -> Self {
        let verdict = if distance.is_some_and(|distance| distance <= tolerance) {
            Verdict::Reached
        } else if stop_reason == StopReason::OutOfReach {
            Verdict::OutOfReach
        } else {
            Verdict::StoppedShort
        };
        Self { verdict, distance, tolerance }
    }
}

/// Outcome of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum RunOutcome {
    /// Every goal is reached.
    Complete,
    /// Some goals are missed: stopped short or out of reach.
    GoalsMissed,
    /// The joints of some goal violate the constraints, or the replay differs from what the run claims.
    Invalid,
}

/// The verdict on a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct RunVerdict {
    /// Outcome of the run.
    pub outcome: RunOutcome,
    /// Number of goals reached.
    pub reached: u32,
    /// Number of goals stopped short.
    pub stopped_short: u32,
    /// Number of goals out of reach.
    pub out_of_reach: u32,
}

impl RunVerdict {
    /// The verdict on a run, given the verdict on each goal and whether its joints satisfy the constraints.
    #[must_use]
    pub(super) fn of(goals: &[(Verdict, bool)]) -> Self {
        let count = |verdict| goals.iter().filter(|goal| goal.0 == verdict).fold(0, |n, _| n + 1);
        let (stopped_short, out_of_reach) = (count(Verdict::StoppedShort), count(Verdict::OutOfReach));
        let outcome = if goals.iter().any(|(_, feasible)| !feasible) {
            RunOutcome::Invalid
        } else if stopped_short + out_of_reach > 0 {
            RunOutcome::GoalsMissed
        } else {
            RunOutcome::Complete
        };
        Self { outcome, reached: count(Verdict::Reached), stopped_short, out_of_reach }
    }

    /// This verdict, or that the run is invalid because its replay does not `agree` with it.
    #[must_use]
    pub fn replayed(self, agrees: bool) -> Self {
        if agrees { self } else { Self { outcome: RunOutcome::Invalid, ..self } }
    }

    /// Number of goals that are not reached.
    #[must_use]
    pub fn missed(&self) -> u32 {
        self.stopped_short + self.out_of_reach
    }
}

/// The tolerance in use, features' unit: that of the problem, or else on a surface half a cell or half of the smallest rise
/// between goals, whichever is larger, the latter up to 2.5 %; or else a tenth of the goals' extent.
pub(super) fn tolerance(spec: &ExecutionSpec, world: &WorldProperties, goals: &Goals) -> f64 {
    if let Some(tolerance) = spec.tolerance {
        return tolerance;
    }
    let Some(surface) = world.surface else { return TOLERANCE_SHARE * extent(goals) };
    let shares: Vec<f64> = goals.rows().map(|row| row[0]).collect();
    let rises = shares.windows(2).map(|pair| pair[1] - pair[0]).filter(|rise| *rise > 1e-9);
    let smallest = rises.fold(f64::INFINITY, f64::min);
    let cell = 100.0 / surface.cells() as f64;
    0.5 * if smallest.is_finite() { smallest.min(MOST_RISE).max(cell) } else { cell }
}

/// Diagonal of the box around the goals, features' unit; 1 if all goals are equal.
fn extent(goals: &Goals) -> f64 {
    let side = |k: usize| {
        let column = || goals.rows().map(|row| row[k]);
        column().fold(f64::NEG_INFINITY, f64::max) - column().fold(f64::INFINITY, f64::min)
    };
    let diagonal = (0..goals.features().len()).map(|k| side(k).powi(2)).sum::<f64>().sqrt();
    if diagonal > 0.0 { diagonal } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::Verdict::{OutOfReach, Reached, StoppedShort};
    use super::*;
    use crate::execution::run;
    use crate::preset::shipped;
    use rstest::rstest;

    #[rstest]
    #[case(Some(5.0), StopReason::Stagnation, Verdict::Reached)]
    #[case(Some(5.0), StopReason::OutOfReach, Verdict::Reached)]
    #[case(Some(5.1), StopReason::Tolerance, Verdict::StoppedShort)]
    #[case(Some(5.1), StopReason::Stagnation, Verdict::StoppedShort)]
    #[case(Some(5.1), StopReason::NoImprovement, Verdict::StoppedShort)]
    #[case(Some(5.1), StopReason::OutOfReach, Verdict::OutOfReach)]
    #[case(None, StopReason::Target, Verdict::StoppedShort)]
    #[case(Some(f64::NAN), StopReason::Target, Verdict::StoppedShort)]
    fn the_observation_decides_and_the_reason_only_why_it_was_missed(
        #[case] distance: Option<f64>,
        #[case] reason: StopReason,
        #[case] verdict: Verdict,
    ) {
        assert_eq!(Judgement::new(distance, 5.0, reason).verdict, verdict);
    }

    #[test]
    fn a_run_is_complete_or_says_how_many_goals_it_missed_or_is_invalid() {
        let mut result = run(&shipped("paper-wax").unwrap().problem, 1).unwrap();
        let mut judged = |verdicts: [Verdict; 3], feasible: bool| {
            result.goals.truncate(3);
            for (goal, verdict) in result.goals.iter_mut().zip(verdicts) {
                goal.judgement.verdict = verdict;
            }
            result.goals[1].feasible = feasible;
            result.verdict()
        };
        let complete = judged([Reached; 3], true);
        assert_eq!((complete.outcome, complete.reached, complete.missed()), (RunOutcome::Complete, 3, 0));
        let missed = judged([Reached, OutOfReach, StoppedShort], true);
        assert_eq!((missed.outcome, missed.reached, missed.missed()), (RunOutcome::GoalsMissed, 1, 2));
        assert_eq!((missed.stopped_short, missed.out_of_reach), (1, 1));
        assert_eq!(judged([Reached; 3], false).outcome, RunOutcome::Invalid);
    }

    #[test]
    fn the_tolerance_is_the_problem_s_or_follows_from_goals_and_surface() {
        let of = |preset: &str, given: Option<f64>| {
            let problem = shipped(preset).unwrap().problem;
            let spec = ExecutionSpec { tolerance: given, ..problem.execution };
            tolerance(&spec, &problem.world.properties(), &problem.goals)
        };
        assert_eq!(of("wax", Some(2.5)), 2.5);
        // Wax spans 228, 185 and 14 mm.
        assert!((of("wax", None) - 29.4).abs() < 0.1, "{}", of("wax", None));
        // 16 cells of 6.25 %, one per goal.
        assert_eq!(of("paint", None), 3.125);
        let mut finer = shipped("paint").unwrap().problem;
        let rows: Vec<Vec<f64>> = [0.0, 1.3, 9.4, 17.1].iter().map(|share| vec![*share]).collect();
        finer.goals = Goals::new(finer.goals.features().to_vec(), &rows).unwrap();
        assert_eq!(tolerance(&finer.execution, &finer.world.properties(), &finer.goals), 3.125);
    }
}
