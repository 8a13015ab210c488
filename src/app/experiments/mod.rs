//! Experiments: many runs of many settings as one durable job, with a table available at any time.
//!
//! # Architecture Invariants
//! - The stored data are those of [`crate::framework::experiment::Experiment`]: the plan, resolved at submission, and
//!   one row per finished run. Every table, comparison and export is computed from these and therefore never stale.

mod plan;
#[cfg(test)]
mod tests;

use crate::app::model::{
    AppError, CreateJob, ErrorKind, ExperimentComparison, ExperimentId, ExperimentRequest, ExperimentTable,
    ExperimentView, Export, JobView, Keyset, Page, PageQuery, RowFilter,
};
use crate::app::{UseCases, compute, out_of_bounds, unknown_format};
use crate::framework::experiment::{Experiment, Quantity, RunId, RunRow, export};

impl UseCases {
    /// Submits an experiment; the job's result names it immediately.
    ///
    /// # Errors
    /// As for [`UseCases::create_job`].
    pub async fn create_experiment(
        &self,
        request: ExperimentRequest,
        idempotency_key: Option<String>,
    ) -> Result<JobView, AppError> {
        self.create_job(CreateJob::Experiment(request), idempotency_key).await
    }

    /// Lists experiments, newest first.
    ///
    /// # Errors
    /// `Malformed` page.
    pub async fn list_experiments(&self, page: PageQuery) -> Result<Page<ExperimentView>, AppError> {
        let keyset = Keyset::new(&page, "experiments")?;
        let experiments = self.ports.store.experiments(&keyset).await?;
        Ok(keyset.page(experiments, |experiment| experiment.id.to_string()))
    }

    /// Reads one experiment.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn get_experiment(&self, id: &ExperimentId) -> Result<ExperimentView, AppError> {
        Ok(self.ports.store.experiment(id).await?)
    }

    /// Statistics of each cell over the finished runs.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn experiment_table(&self, id: &ExperimentId) -> Result<ExperimentTable, AppError> {
        let experiment = self.load(id).await?;
        let id = id.clone();
        let table = move || ExperimentTable {
            experiment: id,
            runs: experiment.plan().runs(),
            finished_runs: experiment.rows().len() as u64,
            cells: experiment.table(),
        };
        compute(table).await
    }

    /// Lists the finished runs, ordered by cell, then repetition; of one cell if `filter` names one.
    ///
    /// # Errors
    /// `NotFound`; `Malformed` page.
    pub async fn experiment_rows(
        &self,
        id: &ExperimentId,
        cell: Option<u32>,
        page: PageQuery,
    ) -> Result<Page<RunRow>, AppError> {
        let keyset = Keyset::new(&page, &format!("rows of {id} {cell:?}"))?;
        self.get_experiment(id).await?;
        let after = keyset.before_id.as_deref().map(position).transpose()?;
        let filter = RowFilter { cell, after, limit: Some(keyset.limit + 1) };
        let rows = self.ports.store.experiment_rows(id, &filter).await?;
        Ok(keyset.page(rows, |row| format!("{}.{}", row.id.cell, row.id.repetition)))
    }

    /// Compares cell `second` with cell `first`, seed by seed, with Wilcoxon's signed-rank test.
    ///
    /// # Errors
    /// `NotFound`; `Malformed` cell; `Conflict` until some seed has valid runs in both.
    pub async fn compare_experiment(
        &self,
        id: &ExperimentId,
        first: u32,
        second: u32,
        quantity: Quantity,
    ) -> Result<ExperimentComparison, AppError> {
        let experiment = self.load(id).await?;
        let cells = &experiment.plan().cells;
        let setting = |name: &str, index: u32| match cells.get(index as usize) {
            Some(cell) => Ok(format!("{}, {}", cell.spec.action, cell.spec.setting)),
            None => Err(out_of_bounds(name, index, &format!("0 to {}", cells.len() - 1))),
        };
        let (first_name, second_name) = (setting("first", first)?, setting("second", second)?);
        let Some(comparison) = compute(move || experiment.compare(first, second, quantity)).await? else {
            let message =
                format!("cells {first} and {second} have no seed with valid runs in both yet: wait for more runs");
            return Err(AppError::new(ErrorKind::Conflict, "no_pairs", message));
        };
        let what = match quantity {
            Quantity::Evaluations => "evaluations",
            Quantity::Discrepancy => "discrepancy",
            Quantity::Painted => "painted %",
        };
        let sentence = export::sentence(&first_name, &second_name, what, &comparison);
        Ok(ExperimentComparison { experiment: id.clone(), first, second, quantity, sentence, comparison })
    }

    /// Exports the table as `csv` (columns and digits of `cgda reproduce --csv`), `full_csv` (every statistic) or
    /// `markdown`.
    ///
    /// # Errors
    /// `NotFound`; `Malformed` format.
    pub async fn export_experiment(&self, id: &ExperimentId, format: &str) -> Result<Export, AppError> {
        let (write, media_type, ending): (fn(&_) -> String, _, _) = match format {
            "csv" => (|table: &Vec<_>| export::paper_csv(table), "text/csv; charset=utf-8", "csv"),
            "full_csv" => (|table: &Vec<_>| export::full_csv(table), "text/csv; charset=utf-8", "csv"),
            "markdown" => (|table: &Vec<_>| export::markdown(table), "text/markdown; charset=utf-8", "md"),
            other => return Err(unknown_format(other, "csv, full_csv or markdown")),
        };
        let experiment = self.load(id).await?;
        let name = experiment.plan().name.clone();
        let text = compute(move || write(&experiment.table())).await?;
        Ok(Export::new(media_type, &name, ending, text.into_bytes()))
    }

    async fn load(&self, id: &ExperimentId) -> Result<Experiment, AppError> {
        let plan = self.ports.store.experiment_plan(id).await?;
        let rows = self.ports.store.experiment_rows(id, &RowFilter::default()).await?;
        compute(move || Experiment::resume(plan, rows)).await?.map_err(AppError::internal)
    }
}

/// The run encoded in a page token.
fn position(text: &str) -> Result<RunId, AppError> {
    let numbers =
        text.split_once('.').and_then(|(cell, repetition)| Some((cell.parse().ok()?, repetition.parse().ok()?)));
    let Some((cell, repetition)) = numbers else {
        let message = "page_token does not belong to this list: start again without it";
        return Err(AppError::new(ErrorKind::Malformed, "invalid_page_token", message));
    };
    Ok(RunId { cell, repetition })
}
