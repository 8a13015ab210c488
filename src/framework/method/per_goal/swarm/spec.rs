//! Parameters that the particle swarms share. Lengths are genes: rad (or m).

use crate::method::parameters::{Choice, parameters};
use crate::method::per_goal::BoundsRule;
use crate::range::above;
use serde::{Deserialize, Serialize};

parameters! {
    /// Parameters that every particle swarm shares. Defaults: inertia and acceleration of M. Clerc and J. Kennedy's
    /// constriction (chi = 0.7298, 2.05 chi = 1.49618), global best, velocity within the gene's range.
    pub struct SwarmSpec {
        /// Particles P.
        pub population: u32 = 50, in 2..=100_000;
        /// S: a goal ends after S + 1 generations without strict improvement.
        pub stagnation: u32 = 3;
        /// w: share of the velocity that is kept.
        pub inertia: f64 = 0.7298, in 0.0..=10.0;
        /// c1: pull of the particle's own memory.
        pub cognitive: f64 = 1.49618, in 0.0..=10.0;
        /// c2: pull of the leader's memory.
        pub social: f64 = 1.49618, in 0.0..=10.0;
        /// Largest velocity of a gene in one generation; the gene's range if absent.
        pub max_velocity: Option<f64> = None, in above(0.0), unit "rad or m";
        /// Sides of the velocity that are limited.
        pub velocity_clamp: VelocityClamp = VelocityClamp::Both;
        /// Treatment of genes outside their limits.
        pub bounds: BoundsRule = BoundsRule::Reflect;
        /// Particle that leads the swarm.
        pub leader: Leader = Leader::BestMemory;
        /// One pair of random numbers moves all genes of a particle, as in the published runs, instead of one per gene.
        pub one_random_pair: bool = false;
        /// The remembered position begins uniform in 0 to 1 degree (prismatic joints: 0 to 0.0175 m), far from the
        /// particle, as in the published runs, instead of at the particle.
        pub ecf_memory_quirk: bool = false;
        /// The velocity begins uniform in 0 to 1 degree (prismatic joints: 0 to 0.0175 m), as in the published runs,
        /// instead of leading half way to a random place.
        pub ecf_velocity_quirk: bool = false;
        /// The target discrepancy is looked for only at the end of each generation, as ECF did in the published runs,
        /// instead of after each evaluation.
        pub ecf_target_at_generation_end: bool = false;
    }
}

/// Sides of a velocity that are limited.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum VelocityClamp {
    /// To plus and minus the largest velocity.
    #[default]
    Both,
    /// Only positive velocities: a common slip, kept to measure what it does.
    UpperOnly,
}

/// Particle that leads the swarm.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Leader {
    /// The particle with the best memory: the global best of the literature.
    #[default]
    BestMemory,
    /// The particle whose current fitness is smallest (the last on ties), while the generation is moving, as in the
    /// published runs.
    CurrentBest,
}

impl Choice for VelocityClamp {
    const ALL: &'static [Self] = &[Self::Both, Self::UpperOnly];
}

impl Choice for Leader {
    const ALL: &'static [Self] = &[Self::BestMemory, Self::CurrentBest];
}
