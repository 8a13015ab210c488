//! Estimate of the true discrepancy of a run whose observations are noisy: that of the winners' undisturbed effects.
//!
//! A winner is the pose that *looked* best, so its observed discrepancy flatters or slanders it by the noise of one trial. A
//! method that models the features knows more: its posterior at the winners' poses rests on all trials. Seeded draws from
//! that posterior (features independent, goals independent) are pushed through the discrepancy; their median is the
//! estimate, their 2.5 % and 97.5 % quantiles are the interval.

use super::discrepancy::PartialDiscrepancy;
use crate::method::whole_run::Believed;
use crate::random::RandomStream;
use serde::{Deserialize, Serialize};

/// Number of draws: the quantiles of the interval vary by about 1 % of its width.
const DRAWS: usize = 4000;
/// Number of the random stream of the draws; trials are numbered from 0.
const STREAM: u64 = u64::MAX;

/// True discrepancy as far as a noisy run knows it, features' unit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct DiscrepancyEstimate {
    /// Median of what is believed of the true discrepancy.
    pub value: f64,
    /// Lower end of the interval that contains it with a probability of 95 %.
    pub lower: f64,
    /// Upper end of that interval.
    pub upper: f64,
}

impl DiscrepancyEstimate {
    /// The estimate from what is `believed` of the winners' features, goal by goal; `measure` has observed nothing yet.
    pub(super) fn of(believed: &[Believed], measure: &PartialDiscrepancy, seed: u64) -> Self {
        let mut random = RandomStream::of_run(seed, STREAM);
        let mut draw = || {
            let mut measure = measure.clone();
            let mut discrepancy = 0.0;
            for goal in believed {
                let deviation = goal.variance.max(0.0).sqrt();
                let drawn: Vec<f64> = goal.mean.iter().map(|mean| mean + deviation * random.normal()).collect();
                discrepancy = measure.of(&drawn);
                measure.append(&drawn);
            }
            discrepancy
        };
        let mut drawn: Vec<f64> = (0..DRAWS).map(|_| draw()).collect();
        drawn.sort_by(f64::total_cmp);
        let quantile = |per_mille: usize| drawn[(DRAWS - 1) * per_mille / 1000];
        Self { value: quantile(500), lower: quantile(25), upper: quantile(975) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Feature;
    use crate::generalization::Goals;
    use crate::recognition::Metric;

    fn estimate(variance: f64) -> DiscrepancyEstimate {
        let goals = Goals::new(vec![Feature::new("x", "mm")], &[vec![10.0]]).unwrap();
        let measure = PartialDiscrepancy::new(&goals, Metric::Multivariate);
        DiscrepancyEstimate::of(&[Believed { mean: vec![40.0], variance }], &measure, 3)
    }

    #[test]
    fn of_one_goal_it_is_the_normal_distribution_about_its_distance() {
        let DiscrepancyEstimate { value, lower, upper } = estimate(4.0);
        assert!((value - 30.0).abs() < 0.15, "{value}");
        assert!((lower - (30.0 - 1.96 * 2.0)).abs() < 0.3 && (upper - (30.0 + 1.96 * 2.0)).abs() < 0.3);
        assert_eq!(estimate(4.0), estimate(4.0));
    }

    #[test]
    fn of_what_is_certain_the_interval_is_a_point() {
        assert_eq!(estimate(0.0), DiscrepancyEstimate { value: 30.0, lower: 30.0, upper: 30.0 });
    }
}
