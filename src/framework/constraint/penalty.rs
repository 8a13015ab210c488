//! Penalties: how much an executed infeasible candidate's discrepancy is increased before the optimiser sees it.
//!
//! Symbols: discrepancy f (features' unit, >= 0), violations v_k (m or rad), generation t (0 is the initial
//! population), penalty p >= 0 with p = 0 exactly if every v_k is 0. The optimiser sees f + p (paper eq. 7) or f (1 +
//! p) (eq. 8).
//!
//! Sources: survey by O. Yeniay, Math. Comput. Appl. 10 (2005) 45-56, DOI 10.3390/mca10010045; static: A. Homaifar, C.
//! X. Qi, S. H. Lai, Simulation 62 (1994) 242-253, DOI 10.1177/003754979406200405 (one level of violation); dynamic: J.
//! A. Joines, C. R. Houck, IEEE ICEC 1994, DOI 10.1109/ICEC.1994.349995; adaptive: J. C. Bean, A. B. Hadj-Alouane, "A
//! dual genetic algorithm for bounded integer programs", TR 92-53, University of Michigan (1992); annealing: Z.
//! Michalewicz, N. Attia, "Evolutionary optimization of constrained problems", 3rd Conf. Evolutionary Programming
//! (1994); all as reviewed by Z. Michalewicz, M. Schoenauer, Evolutionary Computation 4 (1996) 1-32, DOI
//! 10.1162/evco.1996.4.1.1.

use super::error::ConstraintError;
use super::spec::{PenaltyForm, PenaltyKind, PenaltySpec};
use crate::range::above;
use serde::{Deserialize, Serialize};

/// State of a penalty between generations.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct PenaltyState {
    /// Factor lambda of the adaptive penalty.
    lambda: f64,
    /// Number of consecutive generations whose best was feasible (positive) or infeasible (negative).
    streak: i64,
}

impl PenaltyState {
    pub fn new(kind: &PenaltyKind) -> Self {
        let lambda = if let PenaltyKind::Adaptive { weight, .. } = *kind { weight } else { 0.0 };
        Self { lambda, streak: 0 }
    }

    /// Records that a generation ended with a feasible or infeasible best candidate.
    pub fn generation_ended(&mut self, kind: &PenaltyKind, best_is_feasible: bool) {
        let PenaltyKind::Adaptive { window, relax, tighten, .. } = *kind else { return };
        let before = self.streak;
        self.streak = if best_is_feasible { before.max(0) + 1 } else { before.min(0) - 1 };
        if self.streak.unsigned_abs() < u64::from(window) {
            return;
        }
        let moved = if best_is_feasible { self.lambda / relax } else { self.lambda * tighten };
        self.lambda = moved.clamp(1e-9, 1e15);
        self.streak = 0;
    }
}

/// Discrepancy reported for an executed candidate: `fitness` itself if feasible, else a finite, strictly larger value
/// (unless `fitness` is the largest float).
pub(super) fn penalised(
    spec: &PenaltySpec,
    state: &PenaltyState,
    generation: u64,
    fitness: f64,
    violations: impl Iterator<Item = f64>,
) -> f64 {
    let violated = violations.filter(|violation| *violation > 0.0);
    let t = generation as f64;
    let sum = |exponent: f64| violated.map(|violation| violation.powf(exponent)).reduce(|a, b| a + b);
    let size = match spec.penalty {
        PenaltyKind::Death { .. } => None,
        PenaltyKind::Static { weight, exponent } => sum(exponent).map(|s| weight * s),
        PenaltyKind::Dynamic { weight, growth, exponent } => {
            sum(exponent).map(|s| (weight * (t + 1.0)).powf(growth) * s)
        }
        PenaltyKind::Adaptive { .. } => sum(2.0).map(|s| state.lambda * s),
        PenaltyKind::Annealing { temperature, cooling, frozen } => {
            sum(2.0).map(|s| s / (2.0 * (temperature * cooling.powf(t)).max(frozen)))
        }
    };
    let Some(size) = size else { return fitness };
    let worse = match spec.form {
        PenaltyForm::Additive => fitness + size,
        PenaltyForm::Multiplicative => fitness * (1.0 + size),
    };
    worse.max(fitness.next_up()).min(f64::MAX)
}

/// Checks the parameters.
///
/// # Errors
/// [`ConstraintError`] with the parameter, its value and its range.
pub(super) fn check(spec: &PenaltySpec) -> Result<(), ConstraintError> {
    let positive = |parameter, value| above(0.0).check(parameter, None, value);
    match spec.penalty {
        PenaltyKind::Death { value } => positive("value", value)?,
        PenaltyKind::Static { weight, exponent } => positive("weight", weight).and(positive("exponent", exponent))?,
        PenaltyKind::Dynamic { weight, growth, exponent } => {
            positive("weight", weight).and(positive("growth", growth)).and(positive("exponent", exponent))?;
        }
        PenaltyKind::Adaptive { weight, window, relax, tighten } => {
            positive("weight", weight)?;
            positive("window", f64::from(window))?;
            above(1.0).check("relax", None, relax)?;
            above(1.0).check("tighten", None, tighten)?;
            if (relax - tighten).abs() < f64::EPSILON {
                return Err(ConstraintError::EqualFactors { value: tighten });
            }
        }
        PenaltyKind::Annealing { temperature, cooling, frozen } => {
            positive("temperature", temperature)?;
            positive("frozen", frozen)?;
            if !(cooling > 0.0 && cooling < 1.0) {
                return Err(ConstraintError::Cooling { value: cooling });
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use rstest::rstest;

    const ADAPTIVE: PenaltyKind = PenaltyKind::Adaptive { weight: 100.0, window: 2, relax: 2.0, tighten: 3.0 };

    fn told(penalty: PenaltyKind, form: PenaltyForm, generation: u64, fitness: f64, violations: &[f64]) -> f64 {
        let spec = PenaltySpec { form, penalty };
        penalised(&spec, &PenaltyState::new(&penalty), generation, fitness, violations.iter().copied())
    }

    #[rstest]
    #[case(PenaltyKind::Static { weight: 100.0, exponent: 2.0 }, 0, 5.0)] // 100 (0.1^2 + 0.2^2)
    #[case(PenaltyKind::Static { weight: 100.0, exponent: 2.0 }, 9, 5.0)]
    #[case(PenaltyKind::Dynamic { weight: 0.5, growth: 2.0, exponent: 1.0 }, 3, 1.2)] // (0.5 x 4)^2 x 0.3
    #[case(PenaltyKind::Annealing { temperature: 0.5, cooling: 0.5, frozen: 0.01 }, 0, 0.05)] // 0.05 / (2 x 0.5)
    #[case(PenaltyKind::Annealing { temperature: 0.5, cooling: 0.5, frozen: 0.01 }, 2, 0.2)] // tau = 0.125
    #[case(PenaltyKind::Annealing { temperature: 0.5, cooling: 0.5, frozen: 0.01 }, 99, 2.5)] // tau = 0.01
    #[case(ADAPTIVE, 7, 5.0)]
    fn known_values(#[case] penalty: PenaltyKind, #[case] generation: u64, #[case] size: f64) {
        let violations = [0.1, 0.0, 0.2];
        let added = told(penalty, PenaltyForm::Additive, generation, 10.0, &violations);
        assert!((added - 10.0 - size).abs() < 1e-12, "{added}");
        let multiplied = told(penalty, PenaltyForm::Multiplicative, generation, 10.0, &violations);
        assert!((multiplied - 10.0 * (1.0 + size)).abs() < 1e-9, "{multiplied}");
    }

    #[test]
    fn adapts_to_where_the_best_is() {
        let mut state = PenaltyState::new(&ADAPTIVE);
        for (feasible, lambda) in
            [(false, 100.0), (true, 100.0), (true, 50.0), (false, 50.0), (false, 150.0), (true, 150.0)]
        {
            state.generation_ended(&ADAPTIVE, feasible);
            assert!((state.lambda - lambda).abs() < 1e-9, "{state:?}");
        }
    }

    #[rstest]
    #[case(PenaltyKind::Death { value: 0.0 }, "value")]
    #[case(PenaltyKind::Static { weight: f64::NAN, exponent: 2.0 }, "weight")]
    #[case(PenaltyKind::Dynamic { weight: 1.0, growth: -1.0, exponent: 2.0 }, "growth")]
    #[case(PenaltyKind::Adaptive { weight: 1.0, window: 0, relax: 2.0, tighten: 3.0 }, "window")]
    #[case(PenaltyKind::Adaptive { weight: 1.0, window: 3, relax: 2.0, tighten: 2.0 }, "tighten")]
    #[case(PenaltyKind::Annealing { temperature: 1.0, cooling: 1.5, frozen: 0.1 }, "cooling")]
    #[case(PenaltyKind::Annealing { temperature: 1.0, cooling: 1e308, frozen: 0.1 }, "cooling is 1e308: give")]
    fn parameters_out_of_range_are_named(#[case] penalty: PenaltyKind, #[case] field: &str) {
        let message = check(&PenaltySpec { form: PenaltyForm::Additive, penalty }).unwrap_err().to_string();
        assert!(message.contains(field), "{message}");
    }

    proptest! {
        #[test]
        fn infeasible_is_always_worse_and_finite(
            fitness in 0.0..1e9_f64, violation in 1e-12..1e3_f64, generation in 0_u64..10_000, which in 0_usize..4,
            multiplicative: bool,
        ) {
            let penalty = [
                PenaltyKind::Static { weight: 1e3, exponent: 2.0 },
                PenaltyKind::Dynamic { weight: 0.5, growth: 2.0, exponent: 2.0 },
                ADAPTIVE,
                PenaltyKind::Annealing { temperature: 1.0, cooling: 0.5, frozen: 1e-9 },
            ][which];
            let form = if multiplicative { PenaltyForm::Multiplicative } else { PenaltyForm::Additive };
            let worse = told(penalty, form, generation, fitness, &[0.0, violation]);
            prop_assert!(worse > fitness && worse.is_finite());
            prop_assert!(told(penalty, form, generation, fitness, &[0.0, 2.0 * violation]) >= worse);
            prop_assert_eq!(told(penalty, form, generation, fitness, &[0.0, 0.0]).to_bits(), fitness.to_bits());
        }
    }
}
