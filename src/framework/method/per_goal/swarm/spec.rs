//! Parameters of the particle swarms as users write them. Lengths are genes: rad (or m).

use crate::method::per_goal::{BoundsRule, OptimizerError};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Parameters that every particle swarm shares. Defaults: inertia and acceleration of M. Clerc and J. Kennedy's
/// constriction (chi = 0.7298, 2.05 chi = 1.49618), global best, velocity within the gene's range.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, default)]
#[expect(clippy::struct_excessive_bools, reason = "each is a named peculiarity of the published runs")]
pub struct SwarmSpec {
    /// Particles P (at least 2).
    pub population: u32,
    /// S: a goal ends after S + 1 generations without strict improvement.
    pub stagnation: u32,
    /// w: share of the velocity that is kept.
    pub inertia: f64,
    /// c1: pull of the particle's own memory.
    pub cognitive: f64,
    /// c2: pull of the leader's memory.
    pub social: f64,
    /// Largest velocity of a gene in one generation, rad (or m); the gene's range when absent.
    pub max_velocity: Option<f64>,
    /// Which sides of the velocity are limited.
    pub velocity_clamp: VelocityClamp,
    /// What happens to genes outside their limits.
    pub bounds: BoundsRule,
    /// Who leads the swarm.
    pub leader: Leader,
    /// One pair of random numbers moves all genes of a particle, as in the published runs, instead of one a gene.
    pub one_random_pair: bool,
    /// The remembered position begins uniform in 0 to 1 degree (prismatic joints: 0 to 0.0175 m), far from the particle,
    /// as in the published runs, instead of at the particle.
    pub ecf_memory_quirk: bool,
    /// The velocity begins uniform in 0 to 1 degree (prismatic joints: 0 to 0.0175 m), as in the published runs, instead
    /// of leading half way to a random place.
    pub ecf_velocity_quirk: bool,
    /// The target discrepancy is looked for only at the end of each generation, as ECF did in the published runs,
    /// instead of after each evaluation.
    pub ecf_target_at_generation_end: bool,
}

impl Default for SwarmSpec {
    fn default() -> Self {
        Self {
            population: 50,
            stagnation: 3,
            inertia: 0.7298,
            cognitive: 1.49618,
            social: 1.49618,
            max_velocity: None,
            velocity_clamp: VelocityClamp::Both,
            bounds: BoundsRule::Reflect,
            leader: Leader::BestMemory,
            one_random_pair: false,
            ecf_memory_quirk: false,
            ecf_velocity_quirk: false,
            ecf_target_at_generation_end: false,
        }
    }
}

/// Which sides of a velocity are limited.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum VelocityClamp {
    /// To plus and minus the largest velocity.
    #[default]
    Both,
    /// Only positive velocities: a common slip, kept to measure what it does.
    UpperOnly,
}

/// Who leads the swarm.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Leader {
    /// The particle with the best memory: the global best of the literature.
    #[default]
    BestMemory,
    /// The particle whose current fitness is smallest (the last on ties), while the generation is moving, as in the
    /// published runs.
    CurrentBest,
}

impl SwarmSpec {
    /// # Errors
    /// [`OptimizerError::Parameter`] with the parameter, its value and its range.
    pub(in crate::method::per_goal) fn check(&self, method: &'static str) -> Result<(), OptimizerError> {
        let out = |parameter, value, expected| Err(OptimizerError::Parameter { method, parameter, value, expected });
        if !(2..=100_000).contains(&self.population) {
            return out("population", f64::from(self.population), "2 to 100000 are allowed");
        }
        for (name, value) in [("inertia", self.inertia), ("cognitive", self.cognitive), ("social", self.social)] {
            if !(0.0..=10.0).contains(&value) {
                return out(name, value, "0 to 10 are allowed");
            }
        }
        match self.max_velocity {
            Some(value) if !(value.is_finite() && value > 0.0) => {
                out("max_velocity", value, "a finite number above 0 is needed")
            }
            _ => Ok(()),
        }
    }
}

/// PSO, particle swarm optimisation.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PsoSpec {
    /// The swarm.
    pub swarm: SwarmSpec,
}

/// FI-PSO: a particle swarm whose particles inherit some of their fitness.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FiPsoSpec {
    /// The swarm.
    pub swarm: SwarmSpec,
    /// Probability that a moved particle inherits its fitness instead of being executed.
    pub inheritance_probability: f64,
    /// A particle whose fitness was inherited may be a goal's result, as in the published runs.
    pub unexecuted_may_win: bool,
}

impl Default for FiPsoSpec {
    fn default() -> Self {
        Self { swarm: SwarmSpec::default(), inheritance_probability: 0.55, unexecuted_may_win: false }
    }
}

/// AFFG-PSO: a particle swarm with adaptive fuzzy fitness granulation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AffgPsoSpec {
    /// The swarm.
    pub swarm: SwarmSpec,
    /// alpha: threshold T = alpha mean(f) / min(f) of the swarm.
    pub alpha: f64,
    /// beta: a granule's width grows with its fitness, omega exp(beta f).
    pub beta: f64,
    /// omega: width of a granule of fitness 0, rad (or m).
    pub omega: f64,
    /// M: generations a granule lives longer each time it is used.
    pub life_gain: u32,
    /// N: granules kept.
    pub granules: u32,
    /// A granule of fitness 0 is similar to nothing, so that a goal is never taken for reached without executing.
    pub zero_rule: bool,
    /// A particle whose fitness was taken from a granule may be a goal's result, as in the published runs.
    pub unexecuted_may_win: bool,
}

impl Default for AffgPsoSpec {
    fn default() -> Self {
        Self {
            swarm: SwarmSpec::default(),
            alpha: 0.2,
            beta: 0.0,
            omega: 5.0_f64.to_radians(),
            life_gain: 1,
            granules: 3,
            zero_rule: true,
            unexecuted_may_win: false,
        }
    }
}
