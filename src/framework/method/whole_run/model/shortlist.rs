//! Search through a belief: starts are spread over the box and around measured poses, and the best few are refined.
//!
//! Means are cheap (n m), variances are not (n^2). A pose's score is at least its squared distance from the goal plus
//! the smallest possible contribution of its variance, so no variance is computed for a pose that cannot be among the
//! best few. The result is the same, to the bit, as without this shortcut.

use super::belief::{Aim, Belief};
use crate::distance::{distance, squared_distance};
use crate::method::whole_run::FeatureMap;
use crate::method::whole_run::refine::{Local, refine};
use crate::method::whole_run::space::Space;
use crate::random::RandomStream;

/// Number of uniform starts, shared by all goals.
const UNIFORM_STARTS: usize = 600;
/// Number of starts around the measured poses closest to a goal.
const LOCAL_STARTS: usize = 300;
/// Number of starts that are refined.
const REFINED: usize = 5;
/// Number of evaluations per refinement.
const REFINE_STEPS: usize = 40;
/// Spread of the local starts, rad.
const LOCAL_SPREAD: f64 = 0.26;

/// Uniform poses with the belief's predictions.
pub(super) struct Starts {
    joints: usize,
    features: usize,
    /// Poses, one row of d values per start.
    poses: Vec<f64>,
    /// Predicted means, one row of m values per start.
    means: Vec<f64>,
    /// Variance per start, once it has been needed.
    variances: Vec<Option<f64>>,
}

impl Starts {
    /// Draws the uniform starts.
    pub fn new(space: &Space, belief: &mut Belief, random: &mut RandomStream) -> Self {
        let (joints, features) = (space.len(), belief.mean.len());
        let mut poses = vec![0.0; joints * UNIFORM_STARTS];
        let mut means = vec![0.0; features * UNIFORM_STARTS];
        for (pose, mean) in poses.chunks_exact_mut(joints).zip(means.chunks_exact_mut(features)) {
            space.uniform(random, pose);
            belief.predict_mean(pose);
            mean.copy_from_slice(&belief.mean);
        }
        Self { joints, features, poses, means, variances: vec![None; UNIFORM_STARTS] }
    }

    /// The best starts for `aim`, these and others around `centres`, refined; only allowed poses.
    pub fn search(
        &mut self,
        space: &Space,
        aim: Aim,
        centres: &[&[f64]],
        belief: &mut Belief,
        random: &mut RandomStream,
    ) -> Vec<Vec<f64>> {
        let mut best = Shortlist::new();
        let weight = aim.caution * aim.goal.len() as f64;
        let least = weight.min(0.0) * belief.largest_variance();
        let rows = self.poses.chunks_exact(self.joints).zip(self.means.chunks_exact(self.features));
        for ((pose, mean), variance) in rows.zip(&mut self.variances) {
            let miss = squared_distance(mean, aim.goal);
            if best.takes(miss + least) {
                let variance = *variance.get_or_insert_with(|| belief.predict(pose));
                best.offer(miss + weight * variance, pose, space);
            }
        }
        let mut pose = space.home();
        for centre in centres.iter().cycle().take(LOCAL_STARTS) {
            space.near(centre, LOCAL_SPREAD, random, &mut pose);
            belief.predict_mean(&pose);
            let miss = squared_distance(&belief.mean, aim.goal);
            if best.takes(miss + least) {
                best.offer(miss + weight * belief.variance_there(), &pose, space);
            }
        }
        refined(best, space, aim, belief)
    }

    /// Refined poses begun at the uniform starts that are `apart` (rad, root mean square over the joints) from `from`.
    pub fn elsewhere(&self, space: &Space, aim: Aim, from: &[f64], apart: f64, belief: &mut Belief) -> Vec<Vec<f64>> {
        let mut best = Shortlist::new();
        let rows = self.poses.chunks_exact(self.joints).zip(self.means.chunks_exact(self.features));
        for (pose, mean) in rows.filter(|(pose, _)| space.apart(pose, from) >= apart) {
            best.offer(squared_distance(mean, aim.goal), pose, space);
        }
        refined(best, space, aim, belief)
    }
}

/// The poses to which the belief leads from those of `best`; joints that turn may be outside their limits.
fn refined(best: Shortlist, space: &Space, aim: Aim, belief: &mut Belief) -> Vec<Vec<f64>> {
    let unwound = space.unwound();
    let refined = best.rows.into_iter().map(|(_, start)| {
        let mut pose = start.clone();
        let mut score = |q: &[f64], bound: f64, local: &mut Local| belief.score_with_slopes(q, aim, bound, local);
        refine(&unwound, &mut pose, REFINE_STEPS, &mut score);
        space.retreat(&start, &mut pose);
        pose
    });
    refined.collect()
}

/// The [`REFINED`] allowed poses with the smallest scores, best first; ties keep the order in which they were offered.
struct Shortlist {
    rows: Vec<(f64, Vec<f64>)>,
}

impl Shortlist {
    fn new() -> Self {
        Self { rows: Vec::with_capacity(REFINED + 1) }
    }

    /// Whether a pose with that score would be among the best.
    fn takes(&self, score: f64) -> bool {
        self.rows.len() < REFINED || self.rows.last().is_none_or(|last| score < last.0)
    }

    fn offer(&mut self, score: f64, pose: &[f64], space: &Space) {
        if self.takes(score) && space.allows(pose) {
            let place = self.rows.partition_point(|row| row.0 <= score);
            self.rows.insert(place, (score, pose.to_vec()));
            self.rows.truncate(REFINED);
        }
    }
}

/// The allowed pose that the prior alone predicts closest to `goal`; without a prior, a pose near home.
pub(super) fn nearest_by_prior(
    space: &Space,
    goal: &[f64],
    prior: Option<&mut (dyn FeatureMap + '_)>,
    has_failed: bool,
    random: &mut RandomStream,
) -> Vec<f64> {
    let mut best = (f64::INFINITY, space.home());
    if has_failed {
        // The previous pose was not observed; another one may be.
        space.near(&space.home(), LOCAL_SPREAD, random, &mut best.1);
    }
    let Some(prior) = prior else { return best.1 };
    let mut seen = vec![0.0; goal.len()];
    let mut pose = space.home();
    for start in 0..4 * UNIFORM_STARTS {
        if start < UNIFORM_STARTS {
            space.uniform(random, &mut pose);
        } else {
            let spread = LOCAL_SPREAD * 0.5_f64.powf((start / 200) as f64 - 3.0);
            space.near(&best.1, spread, random, &mut pose);
        }
        prior.predict(&pose, &mut seen);
        let miss = distance(&seen, goal);
        if miss < best.0 && space.allows(&pose) {
            best.0 = miss;
            best.1.copy_from_slice(&pose);
        }
    }
    best.1
}
