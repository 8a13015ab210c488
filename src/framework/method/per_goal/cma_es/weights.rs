//! Strategy parameters of CMA-ES, which depend only on the dimension n and the number of candidates lambda.
//!
//! Equations are those of N. Hansen, "The CMA Evolution Strategy: A Tutorial", arXiv:1604.00772, table 1.

/// Strategy parameters, named as in the tutorial.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Weights {
    /// Weights `w_i`, best first: mu positive ones that sum to 1, then negative ones.
    pub recombination: Vec<f64>,
    /// Variance-effective selection mass of the positive weights.
    pub mu_eff: f64,
    /// Learning rate of the step-size path.
    pub c_sigma: f64,
    /// Damping of the step size.
    pub d_sigma: f64,
    /// Learning rate of the covariance path.
    pub c_c: f64,
    /// Learning rate of the rank-one update.
    pub c_1: f64,
    /// Learning rate of the rank-mu update.
    pub c_mu: f64,
    /// Expected norm E |N(0, I)|.
    pub chi: f64,
}

impl Weights {
    /// Parameters for `n` dimensions and `lambda` >= 4 candidates.
    pub fn new(n: usize, lambda: usize) -> Self {
        let n = n as f64;
        let raw: Vec<f64> = (1..=lambda).map(|i| f64::midpoint(lambda as f64, 1.0).ln() - (i as f64).ln()).collect();
        let (positive, negative) = raw.split_at(lambda / 2);
        let effective = |w: &[f64]| w.iter().sum::<f64>().powi(2) / w.iter().map(|w| w * w).sum::<f64>();
        let mu_eff = effective(positive);
        let c_1 = 2.0 / ((n + 1.3).powi(2) + mu_eff);
        let c_mu = (2.0 * (0.25 + mu_eff + 1.0 / mu_eff - 2.0) / ((n + 2.0).powi(2) + mu_eff)).min(1.0 - c_1);
        let limits = [
            1.0 + c_1 / c_mu,
            1.0 + 2.0 * effective(negative) / (mu_eff + 2.0),
            (1.0 - c_1 - c_mu).max(0.0) / (n * c_mu),
        ];
        let least = limits.into_iter().fold(f64::INFINITY, f64::min);
        let total = |w: &[f64]| w.iter().map(|w| w.abs()).sum::<f64>();
        let (up, down) = (1.0 / total(positive), least / total(negative));
        let c_sigma = (mu_eff + 2.0) / (n + mu_eff + 5.0);
        Self {
            recombination: raw.iter().enumerate().map(|(i, w)| w * if i < lambda / 2 { up } else { down }).collect(),
            mu_eff,
            c_sigma,
            d_sigma: 1.0 + 2.0 * (((mu_eff - 1.0) / (n + 1.0)).sqrt() - 1.0).max(0.0) + c_sigma,
            c_c: (4.0 + mu_eff / n) / (n + 4.0 + 2.0 * mu_eff / n),
            c_1,
            c_mu,
            chi: n.sqrt() * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n)),
        }
    }

    /// Number of positive weights.
    pub fn mu(&self) -> usize {
        self.recombination.len() / 2
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_dimensions_and_ten_candidates_have_the_reference_values() {
        // ln 5.5 - ln i over its sum 3.736290, from table 1
        let weights = Weights::new(10, 10);
        let expected = [0.456_275_4, 0.270_756_1, 0.162_230_3, 0.085_231_5, 0.025_506_7];
        for (w, e) in weights.recombination.iter().zip(expected) {
            assert!((w - e).abs() < 1e-4, "{w} against {e}");
        }
        assert!((weights.mu_eff - 3.167_299_3).abs() < 1e-4, "{}", weights.mu_eff);
        assert!((weights.chi - 3.084_726_5).abs() < 1e-4, "{}", weights.chi);
    }

    #[test]
    fn weights_keep_their_sums_and_rates_in_every_dimension() {
        for n in 1..40 {
            for lambda in 4..60 {
                let w = Weights::new(n, lambda);
                let (positive, negative) = w.recombination.split_at(w.mu());
                assert!((positive.iter().sum::<f64>() - 1.0).abs() < 1e-12);
                // The decay of the covariance stays positive, so it remains positive definite.
                assert!(negative.iter().all(|w| *w <= 0.0));
                assert!(w.c_1 > 0.0 && w.c_mu > 0.0 && w.c_1 + w.c_mu <= 1.0, "n {n}, lambda {lambda}");
                assert!(1.0 - w.c_1 - w.c_mu * w.recombination.iter().sum::<f64>() > -1e-12);
            }
        }
    }
}
