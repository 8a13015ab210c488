//! Experiments, from request to submission: the plan is made and stored with the job.

use super::Resolved;
use super::cost::{PREVIEW_TIME, TrialCost};
use crate::app::UseCases;
use crate::app::model::{
    AppError, CostEstimate, CreateJob, ExperimentId, ExperimentRequest, ExperimentView, JobProgress, JobView, Work,
};
use crate::app::ports::{NewExperiment, Usage};
use crate::framework::experiment::Plan;

/// Checks and completes a request.
///
/// # Errors
/// `Invalid` with every wrong place.
pub(super) async fn resolve(app: &UseCases, request: ExperimentRequest) -> Result<Resolved, AppError> {
    let (request, plan) = app.plan_experiment(request).await?;
    Ok(planned(app, plan.name.clone(), CreateJob::Experiment(request), plan))
}

/// A new experiment with the plan of `experiment`.
///
/// # Errors
/// As the store.
pub(super) async fn again(
    app: &UseCases,
    name: String,
    request: CreateJob,
    experiment: &ExperimentId,
) -> Result<Resolved, AppError> {
    let plan = app.ports.store.experiment_plan(experiment).await?;
    Ok(planned(app, name, request, plan))
}

fn planned(app: &UseCases, name: String, request: CreateJob, plan: Plan) -> Resolved {
    let id = ExperimentId::from_uuid(app.ports.ids.uuid());
    Resolved {
        name,
        request,
        work: Work::Experiment { experiment: id.clone() },
        uses: Usage::default(),
        progress: JobProgress { repetitions: plan.repetitions, ..JobProgress::default() },
        experiment: Some((id, plan)),
    }
}

/// The experiment as stored with `job`.
pub(in crate::app::jobs) fn stored(id: ExperimentId, plan: Plan, job: &JobView) -> NewExperiment {
    let view = ExperimentView {
        id,
        name: plan.name.clone(),
        job: job.id.clone(),
        state: job.state,
        seed: plan.seed,
        repetitions: plan.repetitions,
        cells: u32::try_from(plan.cells.len()).unwrap_or(u32::MAX),
        runs: plan.runs(),
        finished_runs: 0,
        created_at: job.created_at,
    };
    NewExperiment { view, plan }
}

/// The cost of all cells, from a preview of each one's first repetition.
///
/// # Errors
/// `Invalid` if a preview breaks off.
pub(super) fn estimate(plan: &Plan, cost: TrialCost<'_>) -> Result<CostEstimate, AppError> {
    let time = PREVIEW_TIME / u32::try_from(plan.cells.len()).unwrap_or(u32::MAX).max(1);
    let previews = plan.cells.iter().map(|cell| cost.try_out(&cell.problem, plan.seed, time));
    let previews = previews.collect::<Result<Vec<_>, _>>()?;
    let evaluations = previews.iter().map(|p| p.preview.whole()).sum::<f64>() * f64::from(plan.repetitions);
    let ended = previews.iter().filter(|p| p.preview.finished).count();
    let basis = format!(
        "the first repetition of each of {} cells, {ended} of them simulated to the end; one core",
        previews.len()
    );
    Ok(cost.of(evaluations, &previews, 0.0, basis))
}
