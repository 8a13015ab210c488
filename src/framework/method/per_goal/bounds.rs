//! Treatment of a gene outside its limits.

use crate::method::parameters::Choice;
use serde::{Deserialize, Serialize};

/// Treatment of a gene that an operator puts outside its limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum BoundsRule {
    /// The gene is set to the nearest limit: every candidate can be executed.
    #[default]
    Clamp,
    /// The gene is mirrored at the limit it passed, as often as needed: every candidate can be executed.
    Reflect,
    /// The gene stays outside, as in the published runs: the result may be a pose that the robot cannot take.
    Open,
}

impl Choice for BoundsRule {
    const ALL: &'static [Self] = &[Self::Clamp, Self::Reflect, Self::Open];
}

impl BoundsRule {
    /// `value` after the rule, for the limits `lower <= upper`.
    #[inline]
    #[must_use]
    pub fn apply(self, value: f64, lower: f64, upper: f64) -> f64 {
        match self {
            Self::Open => value,
            Self::Clamp => value.clamp(lower, upper),
            Self::Reflect if (lower..=upper).contains(&value) => value,
            Self::Reflect => {
                let width = upper - lower;
                let folded = (value - lower).rem_euclid(2.0 * width);
                let inside = lower + if folded > width { 2.0 * width - folded } else { folded };
                // The width is 0, or rounding left the interval.
                if inside.is_nan() { lower } else { inside.clamp(lower, upper) }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use rstest::rstest;

    #[rstest]
    #[case(1.25, 0.75)]
    #[case(-0.25, 0.25)]
    #[case(2.25, 0.25)]
    #[case(-1.5, 0.5)]
    #[case(1.0, 1.0)]
    fn reflects(#[case] value: f64, #[case] inside: f64) {
        assert!((BoundsRule::Reflect.apply(value, 0.0, 1.0) - inside).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn closed_rules_end_inside_and_leave_the_inside_alone(value in -1e3..1e3_f64, lower in -9.0..9.0_f64, width in 0.0..9.0_f64) {
            let upper = lower + width;
            for rule in [BoundsRule::Clamp, BoundsRule::Reflect] {
                let inside = rule.apply(value, lower, upper);
                prop_assert!((lower..=upper).contains(&inside));
                prop_assert_eq!(rule.apply(inside, lower, upper).to_bits(), inside.to_bits());
            }
            prop_assert_eq!(BoundsRule::Open.apply(value, lower, upper).to_bits(), value.to_bits());
        }
    }
}
