//! A simulated *real* world: the robot is not quite as described, sensors and joints are noisy, observations get lost.
//!
//! Invariants: what is drawn depends on the seed, and the noise of a trial on the seed and its pose, alone: slices,
//! resumes and threads change no bit. A lost observation is NaN in every feature.

use super::{World, WorldError, WorldSpec, build};
use crate::framework::Feature;
use crate::framework::robot::Chain;
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use utoipa::ToSchema;

/// How far reality is from its description.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RealitySpec {
    /// Each link's length is off by up to this share, uniformly.
    pub link_share: f64,
    /// The base is off by this distance in a random direction, metres.
    pub base_shift_m: f64,
    /// Standard deviation of each observed feature, features' unit.
    pub sensor_noise: f64,
    /// Standard deviation of each joint about its command, degrees.
    pub joint_noise_deg: f64,
    /// Share of the trials whose observation is lost.
    pub lost_share: f64,
}

/// The world of `spec` around a robot that is off from `chain` as `reality` and `seed` say.
///
/// # Errors
/// [`WorldError`] as [`build`].
pub fn build_real(
    spec: &WorldSpec,
    chain: &Chain,
    reality: &RealitySpec,
    seed: u64,
) -> Result<Box<dyn World>, WorldError> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut off = || 2.0 * random.random::<f64>() - 1.0;
    let scales: Vec<f64> = (0..chain.link_count()).map(|_| 1.0 + reality.link_share * off()).collect();
    let direction = nalgebra::Vector3::new(off(), off(), off());
    let shift = direction.try_normalize(1e-9).unwrap_or_default() * reality.base_shift_m;
    let inner = build(spec, &chain.distorted(&scales, shift.into()))?;
    Ok(Box::new(Real { inner, reality: reality.clone(), seed, moved: vec![0.0; chain.len()] }))
}

struct Real {
    inner: Box<dyn World>,
    reality: RealitySpec,
    seed: u64,
    moved: Vec<f64>,
}

fn gaussian(random: &mut impl Rng) -> f64 {
    let radius = (-2.0 * (1.0 - random.random::<f64>()).ln()).sqrt();
    radius * (2.0 * PI * random.random::<f64>()).cos()
}

impl Real {
    /// Where the joints really go, and the stream of the trial's noise.
    fn act(&mut self, joints: &[f64]) -> ChaCha8Rng {
        let mut word = self.seed ^ 0x9E37_79B9_7F4A_7C15;
        for joint in joints {
            word = (word ^ joint.to_bits()).wrapping_mul(0x94D0_49BB_1331_11EB).rotate_left(29);
        }
        let mut random = ChaCha8Rng::seed_from_u64(word);
        for (moved, joint) in self.moved.iter_mut().zip(joints) {
            *moved = joint + self.reality.joint_noise_deg.to_radians() * gaussian(&mut random);
        }
        random
    }

    fn sense(&self, mut random: ChaCha8Rng, observation: &mut [f64]) {
        for value in observation.iter_mut() {
            *value += self.reality.sensor_noise * gaussian(&mut random);
        }
        if random.random::<f64>() < self.reality.lost_share {
            observation.fill(f64::NAN);
        }
    }
}

impl World for Real {
    fn features(&self) -> &[Feature] {
        self.inner.features()
    }

    fn reset(&mut self) {
        self.inner.reset();
    }

    fn observe(&mut self, joints: &[f64], observation: &mut [f64]) {
        let random = self.act(joints);
        self.inner.observe(&self.moved, observation);
        self.sense(random, observation);
    }

    fn commit(&mut self, joints: &[f64], observation: &mut [f64]) {
        let random = self.act(joints);
        self.inner.commit(&self.moved, observation);
        self.sense(random, observation);
    }

    fn cells(&self) -> Option<&[u64]> {
        self.inner.cells()
    }
}
