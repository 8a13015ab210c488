//! SEARCH-IET: for accumulating effects without prior knowledge, by the theory of optimal search.
//!
//! An unaffected place cannot lie inside the capture ball of a past trial: each trial lowers the survival `surv(x)` of
//! the poses around it, gains raise the expectation of nearby poses, and the next trial is the unused pose with the
//! largest expected gain: `sum_x B_z surv num/den / sum_x B_z`.
//!
//! Symbols: Sobol poses x, z; distance |z - x| in degrees; ball `B_z(x) = exp(-(|z-x|/r)^2)`; `k = exp(-d^2 / 2 l^2)`;
//! num and den start at `(1 + 1/3 - u^2) / 4` and 1, where u^2 is the mean square of the joints' positions within their
//! ranges (-1..1), because a robot is mounted so that its work lies in the middle of its ranges. If cells are observed,
//! the expected gain is multiplied by the chance that a pose leads to an unpainted cell
//! ([`super::surface::cell_predictor`]).
//!
//! On a surface of many cells a pose of the pool covers hardly anything, so that most trials are steps from poses that
//! did to poses nearby ([`walk`]), as long as these promise more than the best pose of the pool.
//!
//! Alternatives tried on seeds 1 to 80 (evaluations to 15 of 16 squares; this one takes 77): balls with a flat top,
//! exponent 4 (85); a preference for the middle (68 with it); l and r of 20 and 9 degrees instead of 25 and 10 (58 with
//! it). One scale per joint, more or fewer misses before the balls shrink, and an unknown serial arm inferred by Markov
//! chains did not help.
//!
//! Source: L. Stone, Theory of Optimal Search, Academic Press 1975.

mod walk;

use super::planner::{RunSetup, Trial, WholeRun, WholeRunMethod};
use super::space::{Axis, Space};
use super::surface::CoverSpec;
use super::surface::cell_predictor::CellPredictor;
use super::surface::cover::Ledger;
use super::surface::covering::Covering;
use super::surface::sobol;
use crate::random::RandomStream;
use crate::world::{Surface, WorldError};
use walk::{Step, Walk};

const RADIUS_DEG: f64 = 9.0;
const LENGTH_DEG: f64 = 20.0;
const PRIOR_HITS: f64 = 0.25;
const PRIOR_TRIALS: f64 = 1.0;
/// Squared distance, relative to the radius, beyond which a ball ends.
const FAR: f64 = 4.0;
/// Share of a pose's survival that remains after a gain that was not accepted.
const REFUSED: f64 = 0.2;
const MISSES: u32 = 30;
const SHRINK: f64 = 0.85;

/// Number of cells above which the search also walks from pose to pose.
const FEW_CELLS: usize = 48;
/// The whole pool is looked at again after this many trials of a walk.
const LOOK_AGAIN: usize = 8;

/// How much closer a pose is to the middle of the joint ranges than poses are on average, in -2/3..1/3.
fn amid(space: &Space, pose: &[f64]) -> f64 {
    let square = |(axis, q): (&Axis, &f64)| {
        let width = axis.upper - axis.lower;
        if width > 0.0 { ((2.0 * q - axis.lower - axis.upper) / width).powi(2) } else { 1.0 / 3.0 }
    };
    1.0 / 3.0 - space.axes.iter().zip(pose).map(square).sum::<f64>() / space.len().max(1) as f64
}

/// A run of SEARCH-IET.
pub struct SearchIet {
    ledger: Ledger,
    poses: Vec<Vec<f64>>,
    scale: Vec<f64>,
    used: Vec<bool>,
    surv: Vec<f64>,
    num: Vec<f64>,
    den: Vec<f64>,
    radius: f64,
    misses: u32,
    verdicts: Vec<(usize, bool, bool)>,
    /// Predictor of the cells that poses lead to; `None` if cells are not observed.
    predictor: Option<CellPredictor>,
    space: Space,
    seed: u64,
    /// The walk; `None` on a surface of few cells.
    walk: Option<Walk>,
    /// Whether the next trial was proposed.
    asked: bool,
    /// The step proposed last; `None` if the last proposal came from the pool.
    step: Option<Step>,
    /// The pose of the pool that promised most when it was last looked at, with its expected gain.
    outlook: Option<(f64, usize)>,
    /// For each pose, the poses in its ball, with B.
    near: Vec<Vec<(u32, f64)>>,
}

impl SearchIet {
    /// A run for `goals` (n rows, the share in the first column) on `surface` over `space`.
    #[must_use]
    pub fn new(spec: &CoverSpec, surface: Surface, space: &Space, goals: &[Vec<f64>], seed: u64) -> Self {
        let mut random = RandomStream::of_run(seed, 0);
        let poses = sobol::poses(space, spec.poses as usize, &mut random);
        let count = poses.len();
        let mut run = Self {
            ledger: Ledger::new(spec.max_evaluations, surface, goals),
            scale: space.axes.iter().map(|a| a.scale().to_degrees()).collect(),
            predictor: surface.cells_seen.then(|| CellPredictor::new(surface)),
            used: vec![false; count],
            surv: vec![1.0; count],
            num: poses.iter().map(|pose| PRIOR_HITS * (1.0 + amid(space, pose))).collect(),
            den: vec![PRIOR_TRIALS; count],
            poses,
            radius: RADIUS_DEG,
            misses: 0,
            verdicts: Vec::new(),
            near: Vec::new(),
            space: space.clone(),
            seed,
            walk: (surface.cells() > FEW_CELLS).then(Walk::default),
            asked: false,
            step: None,
            outlook: None,
        };
        run.find_near();
        run
    }

    fn find_near(&mut self) {
        let ball = |z: &Vec<f64>, x: &Vec<f64>| self.ball(self.squared(z, x));
        let row = |z: &Vec<f64>| {
            let all = (0_u32..).zip(&self.poses).map(|(x, pose)| (x, ball(z, pose)));
            all.filter(|(_, b)| *b > 0.0).collect::<Vec<_>>()
        };
        self.near = self.poses.iter().map(row).collect();
    }

    /// The unused pose of the pool with the largest expected gain; `None` if all are used.
    fn outlook(&self) -> Option<(f64, usize)> {
        let mut expected: Vec<f64> = (0..self.poses.len()).map(|i| self.surv[i] * self.num[i] / self.den[i]).collect();
        let chances = self.predictor.as_ref().and_then(|s| s.chances(&self.poses, |a, b| self.squared(a, b)));
        if let Some(chances) = chances {
            expected.iter_mut().zip(chances).for_each(|(e, chance)| *e *= chance);
        }
        let mut best = (f64::NEG_INFINITY, None);
        for z in (0..self.poses.len()).filter(|&z| !self.used[z]) {
            let (mut sum, mut weight) = (0.0, 0.0);
            for &(x, b) in &self.near[z] {
                sum += b * expected[x as usize];
                weight += b;
            }
            if sum / weight > best.0 {
                best = (sum / weight, Some(z));
            }
        }
        best.1.map(|z| (best.0, z))
    }

    fn squared(&self, a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).zip(&self.scale).map(|((x, y), s)| ((x - y) * s).powi(2)).sum()
    }

    fn ball(&self, squared: f64) -> f64 {
        let ratio = squared / (self.radius * self.radius);
        if ratio > FAR { 0.0 } else { (-ratio).exp() }
    }

    fn thin(&mut self, nearest: usize, ball: &[f64], hit: bool, accepted: bool) {
        if hit && !accepted {
            self.surv[nearest] *= REFUSED;
        } else {
            self.surv.iter_mut().zip(ball).for_each(|(s, b)| *s *= 1.0 - b);
        }
    }

    fn rebuild(&mut self) {
        self.find_near();
        self.surv.fill(1.0);
        for (nearest, hit, accepted) in self.verdicts.clone() {
            let centre = self.poses[nearest].clone();
            let ball: Vec<f64> = self.poses.iter().map(|x| self.ball(self.squared(&centre, x))).collect();
            self.thin(nearest, &ball, hit, accepted);
        }
    }
}

impl WholeRunMethod for CoverSpec {
    fn start(&self, run: &RunSetup<'_>) -> Result<Box<dyn WholeRun>, WorldError> {
        let surface = run.world.properties().surface.ok_or(WorldError::NoSurface)?;
        Ok(Box::new(SearchIet::new(self, surface, run.space, &run.targets.goals, run.seed)))
    }

    fn max_step_deg(&self) -> Option<f64> {
        self.max_step_deg
    }
}

impl Covering for SearchIet {
    fn ledger(&self) -> &Ledger {
        &self.ledger
    }

    fn pose(&mut self) -> Option<Vec<f64>> {
        self.asked = true;
        let trials = self.ledger.log.len();
        if self.walk.is_none() || self.step.is_none() || trials.is_multiple_of(LOOK_AGAIN) {
            self.outlook = self.outlook();
        }
        let least = self.outlook.map_or(0.0, |best| best.0);
        let mut random = RandomStream::of_run(self.seed, trials as u64 + 1);
        self.step = self.walk.as_ref().and_then(|walk| walk.propose(least, &self.space, &mut random));
        let step = self.step.as_ref().map(|step| step.joints.clone());
        step.or_else(|| self.outlook.map(|(_, z)| self.poses[z].clone()))
    }

    fn learn(&mut self, trial: Trial) {
        let joints = trial.joints.clone();
        if self.walk.is_some() && !self.asked {
            // A resumed run is told trials it did not propose.
            self.pose();
        }
        self.asked = false;
        let verdict = self.ledger.tell(trial);
        if let Some(walk) = &mut self.walk {
            walk.tell(&joints, verdict.gain.unwrap_or(0.0).max(0.0), self.step.as_ref());
        }
        let squared: Vec<f64> = self.poses.iter().map(|x| self.squared(&joints, x)).collect();
        let nearest = (0..self.poses.len()).min_by(|&a, &b| squared[a].total_cmp(&squared[b]));
        let Some(nearest) = nearest else { return };
        self.used[nearest] = true;
        let Some(gain) = verdict.gain else { return };
        if let (Some(predictor), Some(fresh)) = (&mut self.predictor, &verdict.fresh) {
            predictor.tell(&joints, fresh, verdict.accepted);
        }
        let ball: Vec<f64> = squared.iter().map(|&s| self.ball(s)).collect();
        let total: f64 = ball.iter().sum();
        let available = ball.iter().zip(&self.surv).map(|(b, s)| b * s).sum::<f64>() / total.max(f64::MIN_POSITIVE);
        for (i, s) in squared.iter().enumerate() {
            let k = (-s / (2.0 * LENGTH_DEG * LENGTH_DEG)).exp();
            self.num[i] += gain.max(0.0) * k;
            self.den[i] += available * k;
        }
        let hit = gain > 0.5;
        self.verdicts.push((nearest, hit, verdict.accepted));
        self.thin(nearest, &ball, hit, verdict.accepted);
        self.misses = if hit { 0 } else { self.misses + 1 };
        if self.misses >= MISSES {
            self.misses = 0;
            self.radius *= SHRINK;
            self.rebuild();
        }
    }
}
