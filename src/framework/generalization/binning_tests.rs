//! Values known by hand, and properties; `tests/recordings.rs` reproduces the authors' own output.

use super::*;
use proptest::prelude::*;

fn demonstration(name: &str, time_s: &[f64], values: &[f64]) -> Demonstration {
    let stream = Stream::new("tool", vec![Feature::new("x", "mm")], time_s.to_vec(), values.to_vec()).unwrap();
    Demonstration { name: name.to_owned(), streams: vec![stream] }
}

fn column(generalized: &Generalized) -> Vec<f64> {
    generalized.goals.values().to_vec()
}

/// Bins of `long` (4 s): {0, 2}, {4, 6, 8}; of `short` (2 s): {10}, {20, 30}; n = floor(3 / 1.5) = 2.
fn pair() -> Vec<Demonstration> {
    vec![
        demonstration("long", &[0.0, 1.0, 2.0, 3.0, 4.0], &[0.0, 2.0, 4.0, 6.0, 8.0]),
        demonstration("short", &[100.0, 101.0, 102.0], &[10.0, 20.0, 30.0]),
    ]
}

#[test]
fn per_demonstration_is_the_mean_of_means() {
    let found = generalize(&pair(), &GeneralizeSpec::new(1.5)).unwrap();
    assert_eq!(column(&found), [f64::midpoint(1.0, 10.0), f64::midpoint(6.0, 25.0)]);
    assert_eq!(found.durations_s, [4.0, 2.0]);
    assert!((found.spread[0][0] - 9.0 / 2.0_f64.sqrt()).abs() < 1e-12);
    assert_eq!(found.interpolated_bins, 0);
}

#[test]
fn per_sample_weights_samples_alike_and_leaves_out_each_last_one() {
    let spec = GeneralizeSpec { weighting: Weighting::PerSample, ..GeneralizeSpec::new(1.5) };
    let found = generalize(&pair(), &spec).unwrap();
    assert_eq!(column(&found), [(0.0 + 2.0 + 10.0) / 3.0, (4.0 + 6.0 + 20.0) / 3.0]);
}

#[test]
fn durations_are_rounded_before_the_mean_per_sample_only() {
    // 3.2 s and 4.1 s: exact mean 3.65 s; rounded up to whole seconds (4 + 5) / 2 = 4.5, then down to 4.
    let demonstrations =
        [demonstration("a", &[0.0, 1.0, 3.2], &[1.0; 3]), demonstration("b", &[0.0, 1.0, 4.1], &[1.0; 3])];
    let spec = GeneralizeSpec::new(2.0);
    assert_eq!(generalize(&demonstrations, &spec).unwrap().goals.len(), 1);
    let spec = GeneralizeSpec { weighting: Weighting::PerSample, ..spec };
    assert_eq!(generalize(&demonstrations, &spec).unwrap().goals.len(), 2);
}

#[test]
fn an_empty_bin_is_interpolated_in_time_and_counted() {
    let sparse = [demonstration("sparse", &[0.0, 0.5, 4.0], &[0.0, 1.0, 8.0])];
    let found = generalize(&sparse, &GeneralizeSpec::new(1.0)).unwrap();
    assert_eq!(found.goals.len(), 4);
    assert_eq!(found.interpolated_bins, 2);
    assert_eq!(column(&found), [0.5, 3.0, 5.0, 8.0]);
}

#[test]
fn streams_of_other_clocks_are_refused_by_name() {
    let late = Stream::new("late", vec![Feature::new("y", "")], vec![600.0, 602.0], vec![0.0, 1.0]).unwrap();
    let mut demonstrations = vec![demonstration("a", &[0.0, 1.0, 2.0], &[0.0, 1.0, 2.0])];
    demonstrations[0].streams.push(late);
    let error = generalize(&demonstrations, &GeneralizeSpec::new(1.0)).unwrap_err();
    assert!(matches!(&error, GeneralizeError::Uncovered { stream, .. } if stream == "tool"), "{error}");
}

#[test]
fn features_have_to_agree_unless_selected() {
    let mut demonstrations = pair();
    let extra = Stream::new("force", vec![Feature::new("Fx", "N")], vec![0.0, 4.0], vec![0.0, 1.0]).unwrap();
    demonstrations[1].streams.push(extra);
    let error = generalize(&demonstrations, &GeneralizeSpec::new(1.0)).unwrap_err();
    assert!(error.to_string().contains("\"short\" has a feature \"Fx\" that \"long\" lacks"), "{error}");
    demonstrations.reverse();
    let error = generalize(&demonstrations, &GeneralizeSpec::new(1.0)).unwrap_err();
    assert!(matches!(error, GeneralizeError::MissingFeature { .. }), "{error}");

    let other_unit = Stream::new("tool", vec![Feature::new("x", "m")], vec![0.0, 4.0], vec![0.0, 1.0]).unwrap();
    let other = Demonstration { name: "metres".to_owned(), streams: vec![other_unit] };
    let error = generalize(&[pair().remove(0), other], &GeneralizeSpec::new(1.0)).unwrap_err();
    assert!(matches!(error, GeneralizeError::UnitMismatch { .. }), "{error}");
}

#[test]
fn impossible_periods_are_told_with_their_numbers() {
    let error = generalize(&pair(), &GeneralizeSpec::new(3.5)).unwrap_err();
    assert_eq!(error, GeneralizeError::NoGoal { t_min_s: 3.5, mean_duration_s: 3.0 });
    for t_min_s in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(generalize(&pair(), &GeneralizeSpec::new(t_min_s)), Err(GeneralizeError::Period(_))));
    }
    assert!(matches!(generalize(&pair(), &GeneralizeSpec::new(1e-9)), Err(GeneralizeError::TooManyGoals { .. })));
    assert_eq!(generalize(&[], &GeneralizeSpec::new(1.0)), Err(GeneralizeError::NoDemonstration));
}

proptest! {
    #[test]
    fn goals_lie_within_the_values_shown(
        values in proptest::collection::vec(-1e3..1e3_f64, 4..60),
        t_min_s in 0.05..2.0_f64,
        per_sample in proptest::bool::ANY,
    ) {
        let time_s: Vec<f64> = (0..values.len()).map(|i| i as f64 * 0.1).collect();
        let weighting = if per_sample { Weighting::PerSample } else { Weighting::PerDemonstration };
        let spec = GeneralizeSpec { weighting, ..GeneralizeSpec::new(t_min_s) };
        if let Ok(found) = generalize(&[demonstration("a", &time_s, &values)], &spec) {
            let low = values.iter().copied().fold(f64::INFINITY, f64::min);
            let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            for goal in found.goals.values() {
                prop_assert!((low - 1e-9..=high + 1e-9).contains(goal));
            }
        }
    }

    #[test]
    fn shifting_the_clock_changes_nothing_but_rounding(shift_s in -1e6..1e6_f64) {
        let shifted: Vec<Demonstration> = pair()
            .into_iter()
            .map(|d| {
                let stream = &d.streams[0];
                let time_s: Vec<f64> = stream.time_s().iter().map(|t| t + shift_s).collect();
                demonstration(&d.name, &time_s, stream.values())
            })
            .collect();
        let found = generalize(&shifted, &GeneralizeSpec::new(3.0 - 1e-6)).unwrap();
        let expected = generalize(&pair(), &GeneralizeSpec::new(3.0 - 1e-6)).unwrap();
        prop_assert_eq!(found.goals, expected.goals);
    }
}
