//! Granules: executed particles whose fitness stands for their surroundings, for a while.
//!
//! Symbols: granule with centre c, fitness F, life; width `lambda = omega exp(beta F)`; similarity of a particle x
//! `s = mean_k exp(-(x_k - c_k)^2 / lambda^2)`, 1 at the centre; at most N granules, the smallest life goes first (the
//! oldest on ties).
//!
//! Source: M. Davarynejad, M.-R. Akbarzadeh-T., N. Pariz, "A novel general framework for evolutionary optimization:
//! adaptive fuzzy fitness granulation", CEC 2007, with the paper's parameters and rules.

use super::spec::AffgPsoSpec;
use serde::{Deserialize, Serialize};

/// An executed particle that stands for its surroundings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Granule {
    life: i64,
    fitness: f64,
    centre: Vec<f64>,
}

/// The granules of one goal, oldest first.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub(super) struct Granules(Vec<Granule>);

impl Granules {
    /// A generation begins: every granule is a generation older.
    pub fn age(&mut self) {
        for granule in &mut self.0 {
            granule.life -= 1;
        }
    }

    /// The fitness of the granule most similar to `x`, if its similarity is above `threshold`; its life grows by M.
    pub fn stand_in(&mut self, spec: &AffgPsoSpec, x: &[f64], threshold: f64) -> Option<f64> {
        let mut best: Option<(usize, f64)> = None;
        for (index, granule) in self.0.iter().enumerate() {
            let similarity = granule.similarity(spec, x);
            if best.is_none_or(|(_, most)| similarity > most) {
                best = Some((index, similarity));
            }
        }
        let (index, similarity) = best?;
        if similarity <= threshold {
            return None;
        }
        self.0[index].life += i64::from(spec.life_gain);
        Some(self.0[index].fitness)
    }

    /// `x` was executed with that fitness and becomes a granule.
    pub fn add(&mut self, spec: &AffgPsoSpec, x: &[f64], fitness: f64) {
        self.0.push(Granule { life: 1, fitness, centre: x.to_vec() });
        while self.0.len() > spec.granules as usize {
            let least = self.0.iter().map(|g| g.life).min().unwrap_or_default();
            let first = self.0.iter().position(|g| g.life == least).unwrap_or_default();
            self.0.remove(first);
        }
    }

    /// Whether every centre has that many genes.
    pub fn fit(&self, genes: usize) -> bool {
        self.0.iter().all(|granule| granule.centre.len() == genes)
    }
}

impl Granule {
    fn similarity(&self, spec: &AffgPsoSpec, x: &[f64]) -> f64 {
        if spec.zero_rule && self.fitness == 0.0 {
            return 0.0;
        }
        let width = spec.omega * (spec.beta * self.fitness).exp();
        let near = |(x, c): (&f64, &f64)| (-((x - c) / width).powi(2)).exp();
        x.iter().zip(&self.centre).map(near).sum::<f64>() / x.len() as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn spec() -> AffgPsoSpec {
        AffgPsoSpec { omega: 0.5, granules: 2, life_gain: 3, zero_rule: false, ..AffgPsoSpec::default() }
    }

    fn lives(granules: &Granules) -> Vec<(i64, f64)> {
        granules.0.iter().map(|g| (g.life, g.fitness)).collect()
    }

    #[test]
    fn similarity_is_the_mean_gaussian() {
        let granule = Granule { life: 1, fitness: 2.0, centre: vec![0.0, 1.0] };
        let flat = granule.similarity(&spec(), &[0.5, 1.0]);
        assert!((flat - f64::midpoint((-1.0_f64).exp(), 1.0)).abs() < 1e-15);
        let wider = AffgPsoSpec { beta: 0.5 * 2.0_f64.ln(), ..spec() };
        let similarity = granule.similarity(&wider, &[1.0, 1.0]);
        assert!((similarity - f64::midpoint((-1.0_f64).exp(), 1.0)).abs() < 1e-15, "width 0.5 exp(ln 2) = 1");
    }

    #[test]
    fn the_most_similar_stands_in_and_lives_longer() {
        let mut granules = Granules::default();
        assert_eq!(granules.stand_in(&spec(), &[0.0], 0.0), None);
        granules.add(&spec(), &[0.0], 7.0);
        granules.add(&spec(), &[1.0], 8.0);
        granules.age();
        assert_eq!(granules.stand_in(&spec(), &[0.4], 0.5), Some(7.0));
        assert_eq!(granules.stand_in(&spec(), &[0.4], 0.99), None);
        assert_eq!(granules.stand_in(&spec(), &[0.5], 0.1), Some(7.0), "the first on ties");
        assert_eq!(lives(&granules), [(6, 7.0), (0, 8.0)]);
        granules.add(&spec(), &[2.0], 9.0);
        assert_eq!(lives(&granules), [(6, 7.0), (1, 9.0)], "the smallest life goes");
        granules.add(&spec(), &[3.0], 10.0);
        assert_eq!(lives(&granules), [(6, 7.0), (1, 10.0)], "the oldest of equal lives goes");
    }

    #[test]
    fn the_zero_rule_trusts_no_zero() {
        let mut granules = Granules::default();
        granules.add(&spec(), &[0.0], 0.0);
        assert_eq!(granules.stand_in(&spec(), &[0.0], 0.5), Some(0.0));
        let wary = AffgPsoSpec { zero_rule: true, ..spec() };
        assert_eq!(granules.stand_in(&wary, &[0.0], 0.5), None);
    }

    proptest! {
        #[test]
        fn similarity_lies_between_0_and_1(x in prop::array::uniform3(-2.0..2.0_f64), c in prop::array::uniform3(-2.0..2.0_f64), fitness in 0.0..1e3_f64) {
            let granule = Granule { life: 1, fitness, centre: c.to_vec() };
            prop_assert!((0.0..=1.0).contains(&granule.similarity(&spec(), &x)));
            prop_assert_eq!(granule.similarity(&spec(), &c).to_bits(), 1.0_f64.to_bits());
        }
    }
}
