//! Conversion of experiment views.

use super::enumeration::Enumeration as _;
use super::{all, time};
use crate::app::model::{ExperimentComparison, ExperimentTable, ExperimentView};
use crate::framework::experiment::{CellResult, PairedComparison, RunId, RunRow, Summary};
use crate::grpc::proto;

impl From<ExperimentView> for proto::Experiment {
    fn from(view: ExperimentView) -> Self {
        let ExperimentView { id, name, job, state, seed, repetitions, cells, runs, finished_runs, created_at } = view;
        Self {
            id: id.into(),
            name,
            job: job.into(),
            state: state.number(),
            seed,
            repetitions,
            cells,
            runs,
            finished_runs,
            created_at: Some(time(created_at)),
        }
    }
}

impl From<ExperimentTable> for proto::ExperimentTable {
    fn from(table: ExperimentTable) -> Self {
        let ExperimentTable { experiment, runs, finished_runs, cells } = table;
        Self { experiment: experiment.into(), runs, finished_runs, cells: all(cells) }
    }
}

impl From<CellResult> for proto::CellResult {
    fn from(cell: CellResult) -> Self {
        let CellResult { table, action, setting, repetitions, invalid, evaluations, discrepancy, painted, cumulative } =
            cell;
        Self {
            table,
            action,
            setting,
            repetitions,
            invalid,
            evaluations: evaluations.map(Into::into),
            discrepancy: discrepancy.map(Into::into),
            painted: painted.map(Into::into),
            cumulative: all(cumulative),
        }
    }
}

impl From<Summary> for proto::Summary {
    fn from(summary: Summary) -> Self {
        let Summary { count, mean, sd, interval_95, median, p90, minimum, maximum } = summary;
        let interval_95 = interval_95.map(Into::into);
        Self { count, mean, sd, interval_95, median, p90, minimum, maximum }
    }
}

impl From<[f64; 2]> for proto::Interval {
    fn from([lower, upper]: [f64; 2]) -> Self {
        Self { lower, upper }
    }
}

impl From<RunRow> for proto::ExperimentRow {
    fn from(row: RunRow) -> Self {
        let RunRow {
            id: RunId { cell, repetition },
            seed,
            evaluations,
            discrepancy,
            true_discrepancy,
            painted_percent,
            invalid,
            evaluations_per_goal,
            provenance,
            digest,
        } = row;
        Self {
            cell,
            repetition,
            seed,
            evaluations,
            discrepancy,
            true_discrepancy,
            painted_percent,
            invalid,
            evaluations_per_goal,
            provenance: Some(provenance.into()),
            digest,
        }
    }
}

impl From<ExperimentComparison> for proto::ExperimentComparison {
    fn from(view: ExperimentComparison) -> Self {
        let ExperimentComparison { experiment, first, second, quantity, sentence, comparison } = view;
        Self {
            experiment: experiment.into(),
            first,
            second,
            quantity: quantity.number(),
            sentence,
            comparison: Some(comparison.into()),
        }
    }
}

impl From<PairedComparison> for proto::PairedComparison {
    fn from(comparison: PairedComparison) -> Self {
        let PairedComparison { pairs, ties, mean_difference, interval_95, w_plus, p_value, rank_biserial } = comparison;
        let interval_95 = interval_95.map(Into::into);
        Self { pairs, ties, mean_difference, interval_95, w_plus, p_value, rank_biserial }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::model::{ExperimentId, JobId, Timestamp};
    use crate::framework::experiment::Quantity;
    use crate::framework::job::State;
    use crate::framework::method::per_goal::Tally;
    use uuid::Uuid;

    fn summary() -> Summary {
        Summary::of(&[1.0, 2.0, 6.0]).unwrap()
    }

    #[test]
    fn a_table_keeps_every_number() {
        let cell = CellResult {
            table: "2".to_owned(),
            action: "wax".to_owned(),
            setting: "fast".to_owned(),
            repetitions: 3,
            invalid: 1,
            evaluations: Some(summary()),
            discrepancy: Some(summary()),
            painted: None,
            cumulative: vec![summary(), summary()],
        };
        let message = proto::CellResult::from(cell);
        assert_eq!((message.repetitions, message.invalid, message.cumulative.len()), (3, 1, 2));
        assert!(message.painted.is_none());
        let numbers = message.evaluations.unwrap();
        assert_eq!((numbers.count, numbers.mean, numbers.median), (3, 3.0, 2.0));
        let interval = numbers.interval_95.unwrap();
        assert_eq!([interval.lower, interval.upper], summary().interval_95.unwrap());
        assert!(proto::Summary::from(Summary::of(&[1.0]).unwrap()).interval_95.is_none());
    }

    #[test]
    fn a_row_names_its_run_and_its_provenance() {
        let row = RunRow {
            id: RunId { cell: 2, repetition: 5 },
            seed: 12,
            evaluations: 30,
            discrepancy: 1.5,
            true_discrepancy: Some(2.5),
            painted_percent: None,
            invalid: true,
            evaluations_per_goal: vec![10, 20],
            provenance: Tally { inherited: 4, ..Tally::default() },
            digest: "d".to_owned(),
        };
        let message = proto::ExperimentRow::from(row);
        assert_eq!((message.cell, message.repetition, message.invalid), (2, 5, true));
        assert_eq!(message.true_discrepancy, Some(2.5));
        assert_eq!(message.provenance.unwrap().inherited, 4);
    }

    #[test]
    fn a_comparison_names_its_quantity_and_an_experiment_its_state() {
        let id = ExperimentId::from_uuid(Uuid::from_u128(1));
        let comparison = crate::framework::experiment::compare(&[1.0, 2.0], &[2.0, 4.0]).unwrap();
        let view = ExperimentComparison {
            experiment: id.clone(),
            first: 0,
            second: 1,
            quantity: Quantity::Painted,
            sentence: "s".to_owned(),
            comparison,
        };
        let message = proto::ExperimentComparison::from(view);
        assert_eq!(message.quantity(), proto::Quantity::Painted);
        assert_eq!(message.comparison.unwrap().mean_difference, 1.5);
        let view = ExperimentView {
            id,
            name: "night".to_owned(),
            job: JobId::from_uuid(Uuid::from_u128(2)),
            state: State::Paused,
            seed: 7,
            repetitions: 3,
            cells: 2,
            runs: 6,
            finished_runs: 4,
            created_at: Timestamp(1_500),
        };
        let message = proto::Experiment::from(view);
        assert_eq!((message.state(), message.finished_runs), (proto::JobState::Paused, 4));
        assert_eq!(message.created_at.unwrap().nanos, 500_000_000);
    }
}
