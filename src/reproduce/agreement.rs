//! Agreement of our tables with the authors' raw logs: cell by cell within bands, and all means together.

use super::paper::PaperCell;
use crate::framework::experiment::{CellResult, Summary};
use statrs::distribution::{ChiSquared, ContinuousCDF};

impl PaperCell {
    /// Deviations of `result` from the raw numbers beyond the tolerance; empty if it agrees.
    #[must_use]
    pub fn disagreements(&self, result: &CellResult) -> Vec<Disagreement> {
        let sd_share = if self.action == "wax" { 0.25 } else { 0.35 };
        let (evaluations, discrepancy) = (result.evaluations, result.discrepancy);
        let share = |expected: Option<f64>, share: f64| expected.map(|expected| (expected, expected * share));
        let checks = [
            ("evaluations", evaluations.map(|s| s.mean), share(Some(self.raw.evaluations), self.tolerance.evaluations)),
            ("discrepancy", discrepancy.map(|s| s.mean), share(Some(self.raw.discrepancy), self.tolerance.discrepancy)),
            ("evaluations sd", evaluations.and_then(|s| s.sd), share(self.raw.evaluations_sd, sd_share)),
            ("discrepancy sd", discrepancy.and_then(|s| s.sd), share(self.raw.discrepancy_sd, sd_share)),
            (
                "painted",
                result.painted.map(|s| s.mean),
                self.published.painted_percent.map(|expected| (expected, self.tolerance.painted_points)),
            ),
        ];
        let judge = |(quantity, found, band): (&'static str, Option<f64>, Option<(f64, f64)>)| {
            let (expected, allowed) = band?;
            let agrees = found.is_some_and(|found| (found - expected).abs() <= allowed);
            (!agrees).then_some(Disagreement { quantity, found, expected, allowed })
        };
        checks.into_iter().filter_map(judge).collect()
    }
}

/// A number outside its band.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disagreement {
    /// Quantity compared.
    pub quantity: &'static str,
    /// Our number; `None` if no run counts.
    pub found: Option<f64>,
    /// The raw number (for the painted share, the published one).
    pub expected: f64,
    /// Largest allowed difference.
    pub allowed: f64,
}

/// Joint test over all means of evaluations and discrepancy, each difference in units of its own uncertainty.
///
/// Symbols: our mean o of R runs with sd s, the raw mean r of N runs; `z = (o - r) / sqrt(t^2 / N + s^2 / R)`, where t
/// is the raw sd if it is known, else s. If only chance separates ours from theirs, the sum of z^2 over k means is
/// distributed approximately as chi-squared with k degrees of freedom (the two means of a cell are not quite
/// independent).
#[derive(Debug, Clone, PartialEq)]
pub struct Agreement {
    /// Number of means k.
    pub means: usize,
    /// Sum of z^2.
    pub sum_of_squares: f64,
    /// Probability of a sum this large by chance alone.
    pub p_value: f64,
    /// Largest difference: index of its cell, quantity, z.
    pub largest: (usize, &'static str, f64),
}

/// Tests `results` against the raw logs behind `cells`, one result per cell; `None` if no cell has two runs.
#[must_use]
pub fn agreement(cells: &[PaperCell], results: &[CellResult]) -> Option<Agreement> {
    let standardised = |ours: Option<Summary>, mean: f64, sd: Option<f64>, runs: u32| {
        let ours = ours?;
        let own = ours.sd?;
        let variance = sd.unwrap_or(own).powi(2) / f64::from(runs) + own.powi(2) / ours.count as f64;
        (variance > 0.0).then(|| (ours.mean - mean) / variance.sqrt())
    };
    let differences = cells.iter().zip(results).enumerate().flat_map(|(index, (cell, result))| {
        let raw = cell.raw;
        let evaluations = standardised(result.evaluations, raw.evaluations, raw.evaluations_sd, cell.runs);
        let discrepancy = standardised(result.discrepancy, raw.discrepancy, raw.discrepancy_sd, cell.runs);
        [evaluations.map(|z| (index, "evaluations", z)), discrepancy.map(|z| (index, "discrepancy", z))]
    });
    let differences: Vec<_> = differences.flatten().collect();
    let sum_of_squares = differences.iter().map(|(.., z)| z * z).sum();
    let largest = differences.iter().copied().max_by(|a, b| a.2.abs().total_cmp(&b.2.abs()))?;
    let chance = ChiSquared::new(differences.len() as f64).ok()?;
    Some(Agreement { means: differences.len(), sum_of_squares, p_value: chance.sf(sum_of_squares), largest })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::paper::PaperTables;

    /// A result that exceeds the raw means by that many sds (raw if known, else 1), with two runs spread like the raw
    /// sd.
    fn beyond(cell: &PaperCell, sds: f64) -> CellResult {
        let of = |mean: f64, sd: Option<f64>| {
            let sd = sd.unwrap_or(1.0);
            let half = sd / 2.0_f64.sqrt();
            Summary::of(&[mean + sds * sd - half, mean + sds * sd + half])
        };
        CellResult {
            table: cell.table.to_string(),
            action: cell.action.clone(),
            setting: cell.setting.clone(),
            repetitions: 2,
            invalid: 0,
            evaluations: of(cell.raw.evaluations, cell.raw.evaluations_sd),
            discrepancy: of(cell.raw.discrepancy, cell.raw.discrepancy_sd),
            painted: None,
            cumulative: Vec::new(),
        }
    }

    #[test]
    fn differences_are_weighed_by_their_uncertainty() {
        let cells = PaperTables::shipped().unwrap().cells;
        let same: Vec<CellResult> = cells.iter().map(|cell| beyond(cell, 0.0)).collect();
        let found = agreement(&cells, &same).unwrap();
        assert_eq!(found.means, 56);
        assert!(found.sum_of_squares < 1e-12 && found.p_value > 0.999, "{found:?}");
        let far: Vec<CellResult> = cells.iter().map(|cell| beyond(cell, 1.0)).collect();
        let found = agreement(&cells, &far).unwrap();
        // z^2 = 1 / (1 / N + 1 / 2)
        let known: f64 = cells.iter().map(|cell| 2.0 / (1.0 / f64::from(cell.runs) + 0.5)).sum();
        assert!((found.sum_of_squares - known).abs() < 1e-6, "{found:?} {known}");
        assert!(found.p_value < 1e-3 && found.largest.2 > 1.3, "{found:?}");
        assert_eq!(agreement(&cells, &[]), None);
    }
}
