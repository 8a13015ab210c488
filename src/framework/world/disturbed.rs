//! A simulated world with an imperfect robot: it deviates from its description, its sensors and joints are noisy, and
//! its observations are late or lost.
//!
//! Invariants: random draws depend only on the seed, and the noise of a trial only on the seed and its pose; slices,
//! resumes and threads do not change a bit. A lost observation is NaN in every feature.

use super::{World, WorldError, WorldSpec, build};
use crate::random::RandomStream;
use crate::range::{OutOfRange, Range};
use crate::robot::Chain;
use crate::trajectory::{JointLimits, late, limits};
use crate::{CellSet, Feature};
use serde::{Deserialize, Serialize};

/// Deviation of the simulated reality from its description.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields, default)]
#[cfg_attr(feature = "schema", schema(as = RealitySpec))]
pub struct DisturbanceSpec {
    /// Maximum relative error of each link's length, uniformly distributed.
    pub link_share: f64,
    /// Distance by which the base is shifted in a random direction, metres.
    pub base_shift_m: f64,
    /// Standard deviation of each observed feature, features' unit.
    pub sensor_noise: f64,
    /// Standard deviation of each joint about its command, degrees.
    pub joint_noise_deg: f64,
    /// Share of the trials whose observation is lost, in [0, 1); such trials still count as evaluations.
    pub lost_share: f64,
    /// Age of an observation on arrival, seconds. It shows the arm where it was `latency_s - settle_s` before it came
    /// to rest, on its fastest motion from the previous pose: the last one re-executed for the trial, or else home.
    #[serde(skip_serializing_if = "is_zero")]
    pub latency_s: f64,
    /// Time for which the arm rests before it is observed, seconds; at the latency or above, observations show the pose
    /// itself.
    #[serde(skip_serializing_if = "is_zero")]
    pub settle_s: f64,
    /// Seed of this robot's links and base: every job with the same number gets the same robot. If absent, the seed of
    /// the run, so that each run gets its own robot. Noise always depends on the seed of the run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
}

/// Deviation of the robot that stands for the real one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SimulatedRobot {
    /// Factor of each link's length: of the translation from each free joint to the next one, and from the last one to
    /// the tool.
    pub link_scales: Vec<f64>,
    /// Shift of the base, metres, base frame.
    pub base_shift_m: [f64; 3],
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde calls it so")]
fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

impl DisturbanceSpec {
    /// Whether links or base are drawn, so that another seed gives another robot.
    #[must_use]
    pub fn is_distorted(&self) -> bool {
        self.link_share > 0.0 || self.base_shift_m > 0.0
    }

    /// The robot that stands for the real one in the run of `seed`.
    #[must_use]
    pub fn robot(&self, chain: &Chain, seed: u64) -> SimulatedRobot {
        let mut random = RandomStream::of_run(self.seed.unwrap_or(seed), 0);
        let mut off = || 2.0 * random.unit() - 1.0;
        let link_scales = (0..chain.link_count()).map(|_| 1.0 + self.link_share * off()).collect();
        let direction = nalgebra::Vector3::new(off(), off(), off());
        let shift = direction.try_normalize(1e-9).unwrap_or_default() * self.base_shift_m;
        SimulatedRobot { link_scales, base_shift_m: shift.into() }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        let up_to = |most: f64| Range::from(0.0..=most);
        up_to(0.9).check("reality.link_share", None, self.link_share)?;
        up_to(1e3).check("reality.base_shift_m", Some("m"), self.base_shift_m)?;
        up_to(1e6).check("reality.sensor_noise", None, self.sensor_noise)?;
        up_to(360.0).check("reality.joint_noise_deg", Some("degrees"), self.joint_noise_deg)?;
        up_to(0.99).check("reality.lost_share", None, self.lost_share)?;
        up_to(3600.0).check("reality.latency_s", Some("s"), self.latency_s)?;
        up_to(3600.0).check("reality.settle_s", Some("s"), self.settle_s)
    }
}

/// Builds the world of `spec` around a robot that deviates from `chain` by `disturbance`; `seed` is that of the run.
///
/// # Errors
/// [`WorldError`] as for [`build`], and for a number of `disturbance` out of range.
pub fn build_disturbed(
    spec: &WorldSpec,
    chain: &Chain,
    disturbance: &DisturbanceSpec,
    seed: u64,
) -> Result<Box<dyn World>, WorldError> {
    disturbance.check()?;
    let SimulatedRobot { link_scales, base_shift_m } = disturbance.robot(chain, seed);
    let inner = build(spec, &chain.distorted(&link_scales, base_shift_m))?;
    Ok(Box::new(Disturbed {
        effect: vec![0.0; inner.features().len()],
        inner,
        disturbance: disturbance.clone(),
        seed,
        limits: limits(chain).0,
        home: chain.home().to_vec(),
        before: chain.home().to_vec(),
        moved: vec![0.0; chain.len()],
        seen: vec![0.0; chain.len()],
    }))
}

struct Disturbed {
    inner: Box<dyn World>,
    disturbance: DisturbanceSpec,
    seed: u64,
    limits: Vec<JointLimits>,
    home: Vec<f64>,
    /// Pose in which the arm rested before the trial.
    before: Vec<f64>,
    /// Pose in which the arm comes to rest.
    moved: Vec<f64>,
    /// Pose in which the arm is observed.
    seen: Vec<f64>,
    /// Scratch space for a commit's observation, which is discarded in favour of that of `seen`.
    effect: Vec<f64>,
}

impl Disturbed {
    /// Computes the pose in which the arm comes to rest and the pose in which it is observed; returns the random stream
    /// of the trial's noise.
    fn act(&mut self, joints: &[f64]) -> RandomStream {
        let mut word = self.seed ^ 0x9E37_79B9_7F4A_7C15;
        for joint in joints {
            word = (word ^ joint.to_bits()).wrapping_mul(0x94D0_49BB_1331_11EB).rotate_left(29);
        }
        let mut random = RandomStream::of_run(word, 0);
        for (moved, joint) in self.moved.iter_mut().zip(joints) {
            *moved = joint + self.disturbance.joint_noise_deg.to_radians() * random.normal();
        }
        let lag_s = self.disturbance.latency_s - self.disturbance.settle_s;
        if lag_s > 0.0 {
            late(&self.limits, &self.before, &self.moved, lag_s, &mut self.seen);
        } else {
            self.seen.copy_from_slice(&self.moved);
        }
        random
    }

    fn sense(&self, mut random: RandomStream, observation: &mut [f64]) {
        for value in observation.iter_mut() {
            *value += self.disturbance.sensor_noise * random.normal();
        }
        if random.unit() < self.disturbance.lost_share {
            observation.fill(f64::NAN);
        }
    }
}

impl World for Disturbed {
    fn features(&self) -> &[Feature] {
        self.inner.features()
    }

    fn reset(&mut self) {
        self.inner.reset();
        self.before.copy_from_slice(&self.home);
    }

    fn observe(&mut self, joints: &[f64], observation: &mut [f64]) {
        let random = self.act(joints);
        self.inner.observe(&self.seen, observation);
        self.sense(random, observation);
    }

    fn commit(&mut self, joints: &[f64], observation: &mut [f64]) {
        let random = self.act(joints);
        self.inner.observe(&self.seen, observation);
        self.inner.commit(&self.moved, &mut self.effect);
        self.before.copy_from_slice(&self.moved);
        self.sense(random, observation);
    }

    fn cells(&self) -> Option<&CellSet> {
        self.inner.cells()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::preset::shipped;
    use crate::robot::RobotModel;
    use crate::trajectory::{PlanSpec, Waypoint, plan};
    use rstest::rstest;

    fn wax() -> (WorldSpec, Chain) {
        let problem = shipped("wax").unwrap().problem;
        let model = RobotModel::from_urdf(&problem.urdf).unwrap();
        (problem.world, Chain::new(&model, &problem.robot).unwrap())
    }

    fn observed(disturbance: &DisturbanceSpec, seed: u64, joints: &[f64]) -> Vec<f64> {
        let (spec, chain) = wax();
        let mut seen = vec![0.0; 3];
        build_disturbed(&spec, &chain, disturbance, seed).unwrap().observe(joints, &mut seen);
        seen
    }

    const POSE: [f64; 3] = [0.4, 0.6, 0.8];

    #[test]
    fn a_late_observation_shows_the_arm_on_its_way_from_home() {
        let (_, chain) = wax();
        let spec = PlanSpec { speed: 1.0, acceleration: 1.0, ..PlanSpec::default() };
        let way = Waypoint::goals(&[POSE.to_vec()]);
        let duration_s = plan(&chain, chain.home(), &way, None, &spec).unwrap().duration_s();
        let late = |latency_s, settle_s| DisturbanceSpec { latency_s, settle_s, ..DisturbanceSpec::default() };
        let exact = observed(&DisturbanceSpec::default(), 1, &POSE);
        assert_eq!(observed(&late(0.2, 0.2), 1, &POSE), exact);
        assert_eq!(observed(&late(1e3, 0.0), 1, &POSE), observed(&DisturbanceSpec::default(), 1, chain.home()));
        let halfway: Vec<f64> = POSE.iter().zip(chain.home()).map(|(q, h)| 0.5 * (q + h)).collect();
        let (found, expected) = (
            observed(&late(0.5 * duration_s + 0.1, 0.1), 1, &POSE),
            observed(&DisturbanceSpec::default(), 1, &halfway),
        );
        assert!(found.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?} is not {expected:?}");
    }

    #[test]
    fn a_late_observation_starts_where_the_prefix_ends_and_the_prefix_is_where_it_was_sent() {
        let (spec, chain) = wax();
        let disturbance = DisturbanceSpec { latency_s: 1e3, ..DisturbanceSpec::default() };
        let mut world = build_disturbed(&spec, &chain, &disturbance, 1).unwrap();
        let (mut before, mut after) = (vec![0.0; 3], vec![0.0; 3]);
        world.commit(&POSE, &mut before);
        world.observe(&[0.0; 3], &mut after);
        assert_eq!(after, observed(&DisturbanceSpec::default(), 1, &POSE));
        world.reset();
        world.observe(&[0.0; 3], &mut after);
        assert_eq!(after, observed(&DisturbanceSpec::default(), 1, chain.home()));
    }

    #[test]
    fn a_robot_of_its_own_is_the_same_in_every_run() {
        let mut disturbance = DisturbanceSpec { link_share: 0.05, base_shift_m: 0.02, ..DisturbanceSpec::default() };
        assert_ne!(observed(&disturbance, 1, &POSE), observed(&disturbance, 2, &POSE));
        disturbance.seed = Some(9);
        assert_eq!(observed(&disturbance, 1, &POSE), observed(&disturbance, 2, &POSE));
        disturbance.sensor_noise = 1.0;
        assert_ne!(observed(&disturbance, 1, &POSE), observed(&disturbance, 2, &POSE));
    }

    #[rstest]
    #[case(DisturbanceSpec { lost_share: 1.0, ..DisturbanceSpec::default() }, "reality.lost_share is 1: give 0 to 0.99")]
    #[case(DisturbanceSpec { latency_s: -0.1, ..DisturbanceSpec::default() }, "latency_s is -0.1")]
    #[case(DisturbanceSpec { sensor_noise: f64::NAN, ..DisturbanceSpec::default() }, "sensor_noise is NaN")]
    fn refuses_numbers_out_of_range(#[case] disturbance: DisturbanceSpec, #[case] told: &str) {
        let (spec, chain) = wax();
        let error = build_disturbed(&spec, &chain, &disturbance, 1).err().unwrap().to_string();
        assert!(error.contains(told), "{error}");
    }
}
