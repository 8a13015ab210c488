//! An experiment from description to table: expansion, resumption, the rules for invalid runs, exports.

use super::*;
use crate::execution::{ExecutionSpec, Problem};
use crate::generalization::Goals;
use crate::method::MethodSpec;
use crate::method::per_goal::{PsoSpec, SstSpec, SwarmSpec, Tally};
use crate::preset::Preset;
use crate::world::{ToolPositionSpec, WorldSpec};
use crate::{Feature, recognition::Metric, robot::RobotSpec};
use proptest::prelude::*;
use serde_json::json;

fn preset(name: &str) -> Option<Preset> {
    let problem = Problem {
        goals: Goals::new(vec![Feature::new("x", "mm")], &[vec![1.0], vec![2.0]]).unwrap(),
        urdf: "<robot/>".to_owned(),
        robot: RobotSpec::default(),
        world: WorldSpec::ToolPosition(ToolPositionSpec { unit: "mm".to_owned() }),
        execution: serde_json::from_value::<ExecutionSpec>(json!({"method": {"name": "sst"}})).unwrap(),
        earlier: Vec::new(),
    };
    let methods = vec![serde_json::from_value(json!({"name": "pso", "swarm": {"population": 9}})).unwrap()];
    (name == "reach").then(|| Preset {
        name: name.to_owned(),
        description: String::new(),
        problem,
        methods,
        threshold: None,
    })
}

fn spec() -> ExperimentSpec {
    let axis = json!([
        {"name": "small", "overrides": {"execution": {"method": {"population": 10}}}},
        {"name": "large"}
    ]);
    let settings = json!([{"name": "aquila", "overrides": {"execution": {"metric": "aquila"}}}]);
    let matrix = json!({"presets": ["reach"], "methods": axis, "settings": settings, "invalid": {"count_as": 843.0}});
    let single = json!([{"action": "reach", "setting": "plain", "preset": "reach"}]);
    let spec = json!({"name": "sizes", "seed": 7, "repetitions": 4, "cells": single, "matrix": matrix});
    serde_json::from_value(spec).unwrap()
}

fn row(id: RunId, seed: u64) -> RunRow {
    let evaluations = 100 * u64::from(id.cell + 1) + seed * seed % 17;
    RunRow {
        id,
        seed,
        evaluations,
        discrepancy: 10.0 / (1.0 + seed as f64) + f64::from(id.cell),
        true_discrepancy: None,
        painted_percent: None,
        invalid: false,
        evaluations_per_goal: vec![evaluations / 3, evaluations - evaluations / 3],
        provenance: Tally { simulated: evaluations, ..Tally::default() },
        digest: format!("{}-{seed}", id.cell),
    }
}

fn run(experiment: &mut Experiment, ids: &[RunId]) {
    for id in ids {
        experiment.record(row(*id, experiment.plan().seed_of(*id))).unwrap();
    }
}

#[test]
fn a_matrix_expands_to_named_cells_with_whole_problems() {
    let plan = spec().plan(preset).unwrap();
    let names: Vec<_> = plan.cells.iter().map(|cell| cell.spec.setting.as_str()).collect();
    assert_eq!(names, ["plain", "small, aquila", "large, aquila"]);
    let small = &plan.cells[1].problem.execution;
    assert_eq!(small.method, MethodSpec::Sst(SstSpec { population: 10, ..SstSpec::default() }));
    assert_eq!((small.metric, plan.cells[0].problem.execution.metric), (Metric::Aquila, Metric::Multivariate));
    assert_eq!(plan.runs(), 12);
}

/// A cell that names a method has the preset's own parameters for it, and its overrides on top.
#[test]
fn a_method_is_taken_with_the_preset_s_parameters() {
    let methods = json!([{"name": "swarm", "method": "pso"}]);
    let settings = json!([
        {"name": "own"},
        {"name": "quick", "overrides": {"execution": {"method": {"swarm": {"stagnation": 1}}}}}
    ]);
    let matrix = json!({"presets": ["reach"], "methods": methods, "settings": settings});
    let mut named: ExperimentSpec =
        serde_json::from_value(json!({"name": "methods", "repetitions": 1, "matrix": matrix})).unwrap();
    let methods: Vec<_> = named.plan(preset).unwrap().cells.into_iter().map(|c| c.problem.execution.method).collect();
    let own = SwarmSpec { population: 9, ..SwarmSpec::default() };
    let quick = SwarmSpec { stagnation: 1, ..own.clone() };
    assert_eq!(methods, [own, quick].map(|swarm| MethodSpec::Pso(PsoSpec { swarm })));
    named.matrix.as_mut().unwrap().methods[0].method = Some("annealing".to_owned());
    let error = named.plan(preset).unwrap_err().to_string();
    assert!(error.contains("method \"annealing\""), "{error}");
}

#[rstest::rstest]
#[case(|s: &mut ExperimentSpec| s.repetitions = 0, "3 cells of 0 repetitions")]
#[case(|s: &mut ExperimentSpec| s.repetitions = u32::MAX, "exceed the limit of 1000000 runs")]
#[case(|s: &mut ExperimentSpec| s.seed = u64::MAX, "seed 18446744073709551615")]
#[case(|s: &mut ExperimentSpec| s.cells[0].preset = "nothing".into(), "preset \"nothing\"")]
#[case(|s: &mut ExperimentSpec| s.cells.push(s.cells[0].clone()), "cells 0 and 1")]
#[case(|s: &mut ExperimentSpec| s.cells[0].overrides = json!({"execution": {"metrics": 1}}), "do not fit preset")]
#[case(|s: &mut ExperimentSpec| s.cells[0].overrides = json!([{}]), "its overrides are not an object")]
#[case(|s: &mut ExperimentSpec| s.cells[0].overrides = json!(true), "its overrides are not an object")]
fn refuses(#[case] spoil: fn(&mut ExperimentSpec), #[case] told: &str) {
    let mut spoilt = spec();
    spoil(&mut spoilt);
    let error = spoilt.plan(preset).unwrap_err().to_string();
    assert!(error.contains(told), "{error}");
}

proptest! {
    /// Killed anywhere, resumed from stored rows in any order, finished in any order: the same table.
    #[test]
    fn the_order_of_runs_cannot_be_seen(
        order in Just((0..12).collect::<Vec<usize>>()).prop_shuffle(), killed in 0..12_usize
    ) {
        let plan = spec().plan(preset).unwrap();
        let mut straight = Experiment::new(plan.clone());
        let ids: Vec<RunId> = straight.pending().collect();
        run(&mut straight, &ids);
        prop_assert!(straight.is_finished());

        let mut first = Experiment::new(plan.clone());
        run(&mut first, &order[..killed].iter().map(|k| ids[*k]).collect::<Vec<_>>());
        let stored = serde_json::to_string(&first.rows().collect::<Vec<_>>()).unwrap();
        let plan: Plan = serde_json::from_str(&serde_json::to_string(&plan).unwrap()).unwrap();
        let rows: Vec<RunRow> = serde_json::from_str(&stored).unwrap();
        let mut second = Experiment::resume(plan, rows.into_iter().rev()).unwrap();
        let left: Vec<RunId> = second.pending().collect();
        prop_assert_eq!(left.len(), 12 - killed);
        run(&mut second, &left);
        prop_assert_eq!(&second, &straight);
        prop_assert_eq!(export::full_csv(&second.table()), export::full_csv(&straight.table()));
    }
}

#[test]
fn a_run_is_recorded_once() {
    let mut experiment = Experiment::new(spec().plan(preset).unwrap());
    let id = RunId { cell: 1, repetition: 2 };
    run(&mut experiment, &[id, id]);
    assert_eq!(experiment.rows().len(), 1);
    let other = RunRow { digest: "other".to_owned(), ..row(id, 9) };
    assert!(matches!(experiment.record(other), Err(RecordError::Conflict { .. })));
    assert!(matches!(experiment.record(row(id, 8)), Err(RecordError::Seed { expected: 9, .. })));
    let outside = RunId { cell: 1, repetition: 4 };
    assert!(matches!(experiment.record(row(outside, 11)), Err(RecordError::Unplanned { repetitions: 4, .. })));
}

#[test]
fn invalid_runs_follow_the_cell_s_rule() {
    let plan = spec().plan(preset).unwrap();
    let rows: Vec<RunRow> = (0..4)
        .map(|repetition| RunRow {
            discrepancy: if repetition == 0 { 10_000.0 } else { 2.0 },
            painted_percent: (repetition != 0).then_some(80.0),
            invalid: repetition == 0,
            ..row(RunId { cell: 0, repetition }, 7 + u64::from(repetition))
        })
        .collect();
    let excluded = CellResult::of(&plan.cells[0], rows.iter());
    assert_eq!((excluded.repetitions, excluded.invalid), (4, 1));
    assert_eq!(excluded.discrepancy.map(|s| (s.count, s.mean)), Some((3, 2.0)));
    assert_eq!(excluded.evaluations.map(|s| s.count), Some(3));
    let mut painting = plan.cells[1].clone();
    painting.problem.world = toml::from_str(include_str!("../../../examples/worlds/paint_wall.toml")).unwrap();
    let counted = CellResult::of(&painting, rows.iter());
    assert_eq!(counted.discrepancy.map(|s| (s.count, s.mean)), Some((4, (843.0 + 6.0) / 4.0)));
    assert_eq!(counted.evaluations.map(|s| s.count), Some(4));
    assert_eq!(counted.painted.map(|s| (s.count, s.mean)), Some((4, 60.0)));
}

#[test]
fn cumulative_evaluations_end_at_the_total() {
    let mut experiment = Experiment::new(spec().plan(preset).unwrap());
    let ids: Vec<_> = experiment.pending().collect();
    run(&mut experiment, &ids);
    for result in experiment.table() {
        assert_eq!(result.cumulative.len(), 2);
        assert_eq!(result.cumulative.last().copied(), result.evaluations);
    }
}

#[test]
fn cells_are_compared_over_the_seeds_both_have() {
    let mut experiment = Experiment::new(spec().plan(preset).unwrap());
    run(&mut experiment, &[0, 1, 3].map(|repetition| RunId { cell: 0, repetition }));
    run(&mut experiment, &[1, 2, 3].map(|repetition| RunId { cell: 2, repetition }));
    let found = experiment.compare(0, 2, Quantity::Discrepancy).unwrap();
    assert_eq!((found.pairs, found.mean_difference), (2, 2.0));
    assert_eq!(experiment.compare(0, 1, Quantity::Discrepancy), None);
    assert_eq!(experiment.compare(0, 9, Quantity::Discrepancy), None);
    let words = export::sentence("plain", "large", "discrepancy", &found);
    assert!(words.contains("+2.0000") && words.contains("2 seeds"), "{words}");
}

#[test]
fn exports_have_their_columns_and_one_line_a_cell() {
    let mut experiment = Experiment::new(spec().plan(preset).unwrap());
    let ids: Vec<_> = experiment.pending().collect();
    run(&mut experiment, &ids);
    let table = experiment.table();
    let csv = export::paper_csv(&table);
    let mut lines = csv.lines();
    assert_eq!(
        lines.next().unwrap(),
        "table,action,setting,evaluations_mean,evaluations_sd,discrepancy_mean,discrepancy_sd,painted_mean,repetitions,invalid"
    );
    assert_eq!(lines.next().unwrap().split(',').nth(2), Some("plain"));
    assert!(lines.next().unwrap().starts_with("sizes,reach,\"small, aquila\","));
    for csv in [csv.as_str(), &export::full_csv(&table)] {
        let mut reader = csv::Reader::from_reader(csv.as_bytes());
        assert_eq!(reader.records().map(|record| record.unwrap().len()).collect::<Vec<_>>().len(), 3);
    }
    let markdown = export::markdown(&table);
    assert_eq!(markdown.lines().count(), 5);
    let widths: Vec<_> = markdown.lines().map(|line| line.chars().count()).collect();
    assert!(widths.iter().all(|width| *width == widths[0]), "{markdown}");
}
