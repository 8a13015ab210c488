//! Restarts: a hopeless goal is tried once more from another region of the joint space before it is called out of reach. The
//! restart agrees if the goal stays hopeless and the model foretold what was seen there.
//!
//! The log alone tells how often that happened, so that a resumed run proposes the same: a trial made for the goal counts
//! if its pose lies in another region than the goal's best one. A simulator as prior is part of the belief in which the
//! other region is searched, at no cost; what is proposed there is executed all the same.

use super::belief::{Aim, Belief};
use super::shortlist::Starts;
use super::{LATE_CAUTION, ModelIet, Open};
use crate::distance::distance;
use crate::method::whole_run::{FeatureMap, Trial};

/// Root mean square over the joints (rad, pi per stroke) at which two poses lie in different regions: 30 degrees, twice the
/// spread of the starts around measured poses.
const APART: f64 = 0.52;

impl ModelIet {
    /// A pose in another region for the first hopeless goal that is owed a restart, and that goal; `None` if none is.
    pub(super) fn restart(
        &self,
        identification: usize,
        open: &[Open],
        starts: &Starts,
        belief: &mut Belief,
    ) -> Option<(Vec<f64>, usize)> {
        let owed = open.iter().filter(|goal| self.restarts(identification, goal.index).len() < self.spec.restarts());
        let poses = owed.filter_map(|goal| Some((self.elsewhere(goal, starts, belief)?, goal.index)));
        poses.into_iter().next()
    }

    /// The pose that the belief expects nearest to the goal among those in another region than its best one.
    fn elsewhere(&self, goal: &Open, starts: &Starts, belief: &mut Belief) -> Option<Vec<f64>> {
        let best = &self.log[self.nearest_trial(goal.index)?].joints;
        let aim = Aim { goal: &self.goals[goal.index], caution: LATE_CAUTION };
        let poses = starts.elsewhere(&self.space, aim, best, APART, belief).into_iter();
        let poses = poses.map(|pose| goal.neighbours.unwind(&self.space, &pose));
        let scored =
            poses.filter(|pose| self.space.apart(pose, best) >= APART).map(|pose| (belief.score(&pose, aim), pose));
        scored.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, pose)| pose)
    }

    /// Trials made for the goal in another region than its best pose, by index.
    fn restarts(&self, identification: usize, goal: usize) -> Vec<usize> {
        let Some(best) = self.nearest_trial(goal).map(|trial| &self.log[trial].joints) else { return Vec::new() };
        let own = self.log.iter().enumerate().skip(identification);
        let own = own.filter(|(_, trial)| trial.goal == goal && trial.observation.is_some());
        own.filter(|(_, trial)| self.space.apart(&trial.joints, best) >= APART).map(|(index, _)| index).collect()
    }

    /// Whether the goal's restarts were made and agreed that it is out of reach: the belief before each of them foretold
    /// what was then seen more closely than the goal was missed by. A belief that errs by more cannot tell.
    pub(super) fn have_restarts_agreed(&mut self, identification: usize, goal: usize) -> bool {
        let restarts = self.restarts(identification, goal);
        let Some(best) = self.nearest_trial(goal).and_then(|trial| self.log[trial].observation.as_ref()) else {
            return false;
        };
        let missed_by = distance(best, &self.goals[goal]) - self.tolerance;
        let enough = self.spec.restarts() > 0 && restarts.len() >= self.spec.restarts();
        enough && restarts.iter().all(|&trial| self.surprise(trial).is_some_and(|surprise| surprise <= missed_by))
    }

    /// Distance of what was seen at a trial from what the trials before it led to expect; `None` if nothing was.
    fn surprise(&mut self, trial: usize) -> Option<f64> {
        let mut prior = self.prior.take();
        let logs = [self.earlier.as_slice(), &self.log[..trial]];
        let map = prior.as_deref_mut().map(|p| p as &mut dyn FeatureMap);
        let belief = Belief::fit(&self.space, logs, &self.goals, map, self.spec.noise);
        let Trial { joints, observation, .. } = &self.log[trial];
        let surprise = belief.zip(observation.as_ref()).map(|(mut belief, seen)| {
            belief.predict_mean(joints);
            distance(&belief.mean, seen)
        });
        self.prior = prior;
        surprise
    }

    /// The trial observed nearest to the goal.
    fn nearest_trial(&self, goal: usize) -> Option<usize> {
        let observed = self.log.iter().enumerate().filter_map(|(index, t)| Some((index, t.observation.as_deref()?)));
        let misses = observed.map(|(index, seen)| (index, distance(seen, &self.goals[goal])));
        misses.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
    }
}
