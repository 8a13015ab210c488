//! Every figure is well-formed SVG with named axes, and the same data give the same bytes.

use super::*;
use crate::framework::Feature;
use crate::framework::experiment::Summary;

fn curve(name: &str, slope: f64) -> Accumulation {
    let after = |goal: i32| Summary::of(&[slope * f64::from(goal) * 0.8, slope * f64::from(goal) * 1.2]).unwrap();
    Accumulation { name: name.to_owned(), cumulative: (1..=9).map(after).collect(), raw: Some(slope * 9.3) }
}

fn all() -> Vec<(u8, String, &'static [&'static str])> {
    let panel = |title: &str| AccumulationPanel {
        title: title.to_owned(),
        curves: vec![curve("SST", 1000.0), curve("PSO", 900.0), curve("FI-PSO", 400.0), curve("AFFG-PSO", 550.0)],
    };
    let wave = |shift: f64| (0..60).map(|k| (f64::from(k), 40.0 + shift + 30.0 * (f64::from(k) / 9.0).sin())).collect();
    let generalization = Generalization {
        feature: Feature::new("painted", "%"),
        demonstrations: vec![wave(-5.0), wave(0.0), wave(4.0)],
        curve: wave(1.0),
        goals: (0..12).map(|k| (2.5 + 5.0 * f64::from(k), 40.0)).collect(),
    };
    let goals: Vec<[f64; 3]> =
        (0..9).map(|k| [300.0 + 20.0 * f64::from(k), -600.0 + 9.0 * f64::from(k * k), 300.0]).collect();
    let away = |d: f64| goals.iter().map(|g| [g[0] - d, g[1] + d, g[2] + d]).collect();
    let runs = [("SST", 10.0), ("PSO", -12.0)].map(|(name, d)| Trail { name: name.to_owned(), positions_mm: away(d) });
    let wall = Coverage {
        rows: 4,
        columns: 4,
        done: (0..17).map(|goal| (0..16).map(|cell| cell < goal).collect()).collect(),
        reference: (0..17).map(|goal| f64::from(goal) * 6.25).collect(),
        achieved: (0..17).map(|goal| f64::from(goal) * 6.25).collect(),
    };
    let method = |name: &str, evaluations: f64, discrepancy: f64| Method {
        name: name.to_owned(),
        evaluations: Summary::of(&[evaluations, evaluations * 1.1]).unwrap(),
        discrepancy: Summary::of(&[discrepancy, discrepancy * 1.3]).unwrap(),
    };
    let methods = [method("SST", 9000.0, 240.0), method("model", 14.0, 200.0), method("PSO", 8900.0, 230.0)];
    vec![
        (
            1,
            trade_off("Figure 1", "mm", &methods).unwrap(),
            &["evaluations (count, logarithmic)", "model", "1\u{202f}000"],
        ),
        (
            2,
            demonstrations("Figure 2", &[generalization]).unwrap(),
            &["painted (%)", "mean demonstration (s)", "12 goals"],
        ),
        (4, accumulation("Figure 4", &[panel("wax")]).unwrap(), &["goal", "evaluations so far (count)", "AFFG-PSO"]),
        (5, trails("Figure 5", &goals, &runs).unwrap(), &["x, forward (mm)", "y, to the left (mm)", "z, up (mm)"]),
        (7, coverage("Figure 7", &wall).unwrap(), &["painted (%)", "goal 17: 100 %", "reached 100 %"]),
        (10, accumulation("Figure 10", &[panel("a < b & c"), panel("wax")]).unwrap(), &["a &lt; b &amp; c"]),
    ]
}

#[test]
fn figures_are_svg_with_named_axes() {
    for (number, svg, expected) in all() {
        let document = roxmltree::Document::parse(&svg).unwrap_or_else(|error| panic!("figure {number}: {error}"));
        let root = document.root_element();
        assert_eq!(root.tag_name().name(), "svg");
        assert_eq!(root.first_element_child().unwrap().text(), Some(format!("Figure {number}").as_str()));
        for words in expected {
            assert!(svg.contains(words), "figure {number} lacks {words:?}");
        }
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "figure {number}");
    }
}

#[test]
fn the_same_data_give_the_same_bytes() {
    assert_eq!(all(), all());
}
