//! The nearest of equally good poses: of candidates that the model predicts to serve a goal alike, the one with the least
//! joint motion from its neighbours.
//!
//! A kernel of angles is periodic, and a redundant arm serves a goal at many poses: without this choice, which one is
//! taken is chance, and a joint may swing a whole turn between neighbouring goals.

use crate::method::whole_run::space::Space;

/// Predicted distances that differ by less than this share of the tolerance are alike: it is also the smallest improvement
/// worth a trial.
const ALIKE: f64 = 0.25;
/// Motion that is worth giving up the best prediction for, as a share of that pose's motion. Searches that end in one
/// minimum differ by rounding errors; theirs is not.
const LESS_MOTION: f64 = 0.9;

/// The poses next to that of a goal: of the goals before and after it, as far as they were tried or are reached.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Neighbours {
    /// Pose from which the robot comes, or the nearest one known.
    before: Vec<f64>,
    /// Pose to which it goes; `None` if it is not known yet.
    after: Option<Vec<f64>>,
}

impl Neighbours {
    /// The neighbours of goal `index`, given the pose of each goal that is reached or was tried: the one of the nearest goal
    /// before it, or else after it, or else home; and the one of the next goal.
    pub fn of(index: usize, known: &[Option<&[f64]>], space: &Space) -> Self {
        let earlier = known[..index].iter().rev().flatten().next();
        let later = known[index + 1..].iter().flatten().next();
        let next = known.get(index + 1).copied().flatten();
        let before = earlier.or(later).map_or_else(|| space.home(), |pose| pose.to_vec());
        Self { before, after: next.map(<[f64]>::to_vec) }
    }

    /// `pose` with joints that turn brought to the turn nearest to the neighbour before.
    pub fn unwind(&self, space: &Space, pose: &[f64]) -> Vec<f64> {
        space.equivalent(pose, &self.before)
    }

    /// Longest motion between `pose` and a neighbour, seconds at the velocity limits.
    fn motion_s(&self, space: &Space, pose: &[f64]) -> f64 {
        let after = self.after.as_ref().map_or(0.0, |after| space.motion_s(pose, after));
        space.motion_s(&self.before, pose).max(after)
    }

    /// The candidate with the smallest predicted distance (features' unit), or one alike with clearly less motion; `None`
    /// if there are none.
    pub fn choose(&self, space: &Space, candidates: Vec<(f64, Vec<f64>)>, tolerance: f64) -> Option<(f64, Vec<f64>)> {
        let best = candidates.iter().min_by(|a, b| a.0.total_cmp(&b.0))?.clone();
        let (alike, enough) = (best.0 + ALIKE * tolerance, LESS_MOTION * self.motion_s(space, &best.1));
        let nearer = candidates.into_iter().filter(|candidate| candidate.0 <= alike);
        let timed = nearer.map(|candidate| (self.motion_s(space, &candidate.1), candidate));
        let least = timed.filter(|(motion_s, _)| *motion_s < enough).min_by(|a, b| a.0.total_cmp(&b.0));
        Some(least.map_or(best, |(_, candidate)| candidate))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::whole_run::Axis;
    use rstest::rstest;

    fn space() -> Space {
        Space::new(vec![Axis { lower: -6.0, upper: 6.0, home: 0.5, revolute: true }; 1])
    }

    #[test]
    fn the_neighbours_are_known_goals_or_home() {
        let (a, b) = ([1.0], [2.0]);
        assert_eq!(Neighbours::of(0, &[None], &space()).before, [0.5]);
        let known = [None, Some(a.as_slice()), None, Some(b.as_slice()), None];
        let of = |index| {
            let Neighbours { before, after } = Neighbours::of(index, &known, &space());
            (before[0], after.map(|pose| pose[0]))
        };
        assert_eq!(
            [0, 1, 2, 3, 4].map(of),
            [(1.0, Some(1.0)), (2.0, None), (1.0, Some(2.0)), (1.0, None), (2.0, None)]
        );
    }

    #[rstest]
    #[case::alike_and_nearer(&[(2.0, 4.0), (2.2, 1.0), (3.4, 0.6)], 1.0)]
    #[case::nearer_but_worse(&[(2.0, 4.0), (3.1, 1.0)], 4.0)]
    #[case::the_same_but_for_rounding(&[(2.0, 4.0), (2.0 + 1e-12, 4.0 - 1e-6)], 4.0)]
    fn of_poses_alike_the_one_with_clearly_less_motion_is_taken(#[case] candidates: &[(f64, f64)], #[case] taken: f64) {
        let neighbours = Neighbours { before: vec![0.5], after: None };
        let candidates = candidates.iter().map(|(miss, q)| (*miss, vec![*q])).collect();
        assert_eq!(neighbours.choose(&space(), candidates, 4.0).unwrap().1, [taken]);
    }

    #[test]
    fn the_way_on_counts_too() {
        let neighbours = Neighbours { before: vec![0.5], after: Some(vec![5.0]) };
        let taken = neighbours.choose(&space(), vec![(1.0, vec![-2.0]), (1.1, vec![3.0])], 4.0);
        assert_eq!(taken.unwrap().1, [3.0]);
        assert_eq!(neighbours.choose(&space(), Vec::new(), 4.0), None);
    }
}
