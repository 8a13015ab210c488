//! Summary of many runs of one problem: mean, median and p90 of each figure, and the share of runs below a threshold.

use super::Delivered;
use crate::framework::experiment::Summary;
use serde::Serialize;

/// One statistic over all runs, for each figure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Statistic {
    pub evaluations: f64,
    pub discrepancy: f64,
    pub painted_percent: Option<f64>,
}

/// Share of the runs below a discrepancy threshold.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Reached {
    pub discrepancy: f64,
    /// Share of the runs, 0 to 1.
    pub share: f64,
}

/// All statistics over a set of runs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Figures {
    pub mean: Statistic,
    pub median: Statistic,
    pub p90: Statistic,
    pub threshold: Option<Reached>,
}

impl Figures {
    /// Statistics of `runs`, `None` if there are none; `threshold` is in the features' unit.
    pub(super) fn of(runs: &[Delivered], threshold: Option<f64>) -> Option<Self> {
        let over = |value: fn(&Delivered) -> f64| Summary::of(&runs.iter().map(value).collect::<Vec<f64>>());
        let evaluations = over(|r| r.result.evaluations as f64)?;
        let discrepancy = over(|r| r.result.discrepancy)?;
        let painted: Option<Vec<f64>> = runs.iter().map(|r| r.motion.replay.painted_percent).collect();
        let painted = painted.and_then(|values| Summary::of(&values));
        let statistic = |pick: fn(&Summary) -> f64| Statistic {
            evaluations: pick(&evaluations),
            discrepancy: pick(&discrepancy),
            painted_percent: painted.as_ref().map(pick),
        };
        let share = |limit| runs.iter().filter(|r| r.result.discrepancy <= limit).count() as f64 / runs.len() as f64;
        Some(Self {
            mean: statistic(|s| s.mean),
            median: statistic(|s| s.median),
            p90: statistic(|s| s.p90),
            threshold: threshold.map(|limit| Reached { discrepancy: limit, share: share(limit) }),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::framework::execution::{RunResult, run};
    use crate::framework::motion::deliver;
    use crate::framework::trajectory::PlanSpec;
    use crate::reproduce::shipped;

    #[test]
    fn all_runs_count_alike() {
        let mut preset = shipped::preset("polish").unwrap();
        assert!(preset.select_method("model"));
        let one = run(&preset.problem, 1).unwrap();
        let motion = deliver(&preset.problem, &one, &PlanSpec::default()).unwrap();
        let runs: Vec<Delivered> = (1..=5)
            .map(|k| Delivered {
                result: RunResult { evaluations: 10 * k, discrepancy: k as f64, ..one.clone() },
                motion: motion.clone(),
                simulated_robot: None,
            })
            .collect();
        let figures = Figures::of(&runs, Some(4.0)).unwrap();
        assert_eq!((figures.mean.evaluations, figures.median.discrepancy), (30.0, 3.0));
        assert!((figures.p90.evaluations - 46.0).abs() < 1e-9);
        assert_eq!(figures.threshold, Some(Reached { discrepancy: 4.0, share: 0.8 }));
        assert_eq!(figures.mean.painted_percent, None);
        assert_eq!(Figures::of(&[], None), None);
    }
}
