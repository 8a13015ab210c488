//! Movement of a particle.
//!
//! Symbols, per gene: position x, velocity v, own memory p, leader's memory g, inertia w, accelerations c1, c2, R1, R2
//! = U(0, 1), limit V: `v <- clamp(w v + c1 R1 (p - x) + c2 R2 (g - x))`, `x <- x + v`.
//!
//! Sources: J. Kennedy, R. Eberhart, ICNN 1995, DOI 10.1109/ICNN.1995.488968; inertia and the limit: R. C. Eberhart, Y.
//! Shi, CEC 2000, DOI 10.1109/CEC.2000.870279; w = 0.7298, c = 1.49618: M. Clerc, J. Kennedy, IEEE Trans. Evol. Comput.
//! 6 (2002) 58-73, DOI 10.1109/4235.985692.

use super::spec::{SwarmSpec, VelocityClamp};
use crate::method::per_goal::{BoundsRule, SearchSpace};
use crate::random::RandomStream;

/// Points that attract a particle; each has n genes.
pub(super) struct Pull<'a> {
    pub memory: &'a [f64],
    pub leader: &'a [f64],
}

/// Moves one particle; returns the means of c1 R1 and c2 R2 over its genes, the weights of fitness inheritance.
pub(super) fn fly(
    spec: &SwarmSpec,
    space: &SearchSpace,
    pull: &Pull<'_>,
    x: &mut [f64],
    v: &mut [f64],
    rng: &mut RandomStream,
) -> [f64; 2] {
    let mut pair = [spec.cognitive * rng.unit(), spec.social * rng.unit()];
    let mut total = [0.0; 2];
    for gene in 0..x.len() {
        if gene > 0 && !spec.one_random_pair {
            pair = [spec.cognitive * rng.unit(), spec.social * rng.unit()];
        }
        let (lower, upper) = (space.lower[gene], space.upper[gene]);
        let towards = pair[0] * (pull.memory[gene] - x[gene]) + pair[1] * (pull.leader[gene] - x[gene]);
        v[gene] = limited(spec, spec.inertia * v[gene] + towards, upper - lower);
        let moved = x[gene] + v[gene];
        x[gene] = spec.bounds.apply(moved, lower, upper);
        if x[gene].to_bits() != moved.to_bits() {
            v[gene] = match spec.bounds {
                BoundsRule::Reflect => -v[gene],
                BoundsRule::Clamp | BoundsRule::Open => 0.0,
            };
        }
        total = [total[0] + pair[0], total[1] + pair[1]];
    }
    total.map(|sum| sum / x.len() as f64)
}

/// Clamps `velocity` to its limit, for a gene of that range.
pub(super) fn limited(spec: &SwarmSpec, velocity: f64, range: f64) -> f64 {
    let most = spec.max_velocity.unwrap_or(range);
    match spec.velocity_clamp {
        VelocityClamp::Both => velocity.clamp(-most, most),
        VelocityClamp::UpperOnly => velocity.min(most),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn space(genes: usize) -> SearchSpace {
        SearchSpace { lower: vec![-1.0; genes], upper: vec![1.0; genes], features: 1, target: None, near: None }
    }

    #[test]
    fn follows_the_formula() {
        let spec = SwarmSpec { one_random_pair: true, bounds: BoundsRule::Open, ..SwarmSpec::default() };
        let (mut x, mut v) = ([0.1, -0.2], [0.05, 0.0]);
        let pull = Pull { memory: &[0.3, 0.1], leader: &[-0.4, 0.2] };
        let mut same = RandomStream::new(4, 0);
        let (c1, c2) = (1.49618 * same.unit(), 1.49618 * same.unit());
        let known = [0.7298 * 0.05 + c1 * 0.2 - c2 * 0.5, c1 * 0.3 + c2 * 0.4];
        let weights = fly(&spec, &space(2), &pull, &mut x, &mut v, &mut RandomStream::new(4, 0));
        for gene in 0..2 {
            assert!((v[gene] - known[gene]).abs() < 1e-15, "{v:?} {known:?}");
        }
        assert!((x[0] - 0.1 - v[0]).abs() < 1e-15 && (x[1] + 0.2 - v[1]).abs() < 1e-15);
        assert!((weights[0] - c1).abs() < 1e-15 && (weights[1] - c2).abs() < 1e-15);
    }

    proptest! {
        #[test]
        fn stays_in_its_limits(
            seed: u64, start in prop::array::uniform3(-1.0..1.0_f64), memory in prop::array::uniform3(-1.0..1.0_f64),
            speed in 0.01..0.5_f64, reflect: bool,
        ) {
            let bounds = if reflect { BoundsRule::Reflect } else { BoundsRule::Clamp };
            let spec = SwarmSpec { bounds, max_velocity: Some(speed), ..SwarmSpec::default() };
            let (mut x, mut v, mut rng) = (start, [0.4, -0.4, 0.0], RandomStream::new(seed, 0));
            let leader = [1.0, -1.0, 0.0];
            for _ in 0..50 {
                let before = x;
                fly(&spec, &space(3), &Pull { memory: &memory, leader: &leader }, &mut x, &mut v, &mut rng);
                for gene in 0..3 {
                    prop_assert!(v[gene].abs() <= speed);
                    prop_assert!((-1.0..=1.0).contains(&x[gene]));
                    prop_assert!((x[gene] - before[gene]).abs() <= speed + 1e-12);
                }
            }
        }

        #[test]
        fn the_one_sided_clamp_leaves_negative_velocities(velocity in -9.0..9.0_f64) {
            let spec = SwarmSpec { velocity_clamp: VelocityClamp::UpperOnly, ..SwarmSpec::default() };
            let found = limited(&spec, velocity, 1.0);
            prop_assert_eq!(found.to_bits(), velocity.min(1.0).to_bits());
        }
    }
}
