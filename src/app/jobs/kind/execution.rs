//! Executions, from request to submission: references are looked up and copied, the method is chosen, earlier trials are
//! found, and the whole problem is checked as the worker will check it.

use super::Resolved;
use super::cost::{PREVIEW_TIME, TrialCost};
use crate::app::jobs::reference::look_up;
use crate::app::jobs::trial_reuse::setup_key;
use crate::app::model::{
    AppError, CostEstimate, CreateJob, ExecutionRequest, ExecutionWork, FieldError, JobProgress, Work, limits,
};
use crate::app::ports::Usage;
use crate::app::{UseCases, chain_text, check_name, compute, json_pointer};
use crate::framework::execution::{Iet, Problem};
use crate::framework::generalization::Goals;
use crate::framework::range::Range;
use crate::framework::trajectory::PlanError;

/// Checks and completes a request.
///
/// # Errors
/// `Invalid` with every wrong place.
pub(super) async fn resolve(app: &UseCases, mut request: ExecutionRequest) -> Result<Resolved, AppError> {
    let mut errors = bounds(&request);
    let store = &app.ports.store;
    let action = look_up(&mut errors, "/action", store.action(&request.action).await)?;
    let goals = look_up(&mut Vec::new(), "/action", store.action_goals(&request.action).await)?;
    let robot = look_up(&mut errors, "/robot", store.robot(&request.robot).await)?;
    let urdf = look_up(&mut Vec::new(), "/robot", store.robot_urdf(&request.robot).await)?;
    let world = look_up(&mut errors, "/world", store.world(&request.world).await)?;
    let (Some(action), Some(goals), Some(robot), Some(urdf), Some(world), true) =
        (action, goals, robot, urdf, world, errors.is_empty())
    else {
        return Err(AppError::invalid(errors));
    };
    if *request.avoid_collisions.get_or_insert(true) {
        request.execution.avoid_collisions();
    }
    let goals = Goals::new(goals.features, &goals.goals).map_err(AppError::internal)?;
    let interval_s = action.mean_duration_s / goals.len() as f64;
    let mut problem = Problem {
        goals: goals.spaced(Some(interval_s)),
        urdf,
        robot: robot.spec.clone(),
        world: world.spec,
        execution: request.execution.clone(),
        earlier: Vec::new(),
    };
    // Only the service records the reason for a method.
    problem.execution.chosen = None;
    problem.choose();
    request.execution = problem.execution.clone();
    let seed = request.seed.unwrap_or_else(|| app.ports.ids.seed());
    let setup_key = setup_key(&robot, &problem, seed, request.repetitions);
    problem.earlier = app.earlier_trials(&mut request, setup_key.as_deref()).await?;
    let planning = request.planning.clone().unwrap_or_default();
    request.planning = Some(planning.clone());
    let (problem, planning) = compute(move || match Iet::new(&problem, seed) {
        Ok(iet) => planning.check(iet.chain()).map_err(|error| refused(&error)).map(|()| (problem, planning)),
        Err(error) => Err(AppError::field("/execution", "invalid_problem", chain_text(&error))),
    })
    .await??;
    let name = request.name.clone().unwrap_or_else(|| format!("{} on {}", action.name, robot.name));
    request.name = Some(name.clone());
    request.seed = Some(seed);
    let work = ExecutionWork {
        action: request.action.clone(),
        robot: request.robot.clone(),
        world: request.world.clone(),
        problem,
        setup_key,
        seed,
        repetitions: request.repetitions,
        max_evaluations_per_s: request.max_evaluations_per_s,
        planning,
    };
    Ok(again(name, CreateJob::Execution(Box::new(request)), work))
}

/// The same work once more, with the same seed.
pub(super) fn again(name: String, request: CreateJob, work: ExecutionWork) -> Resolved {
    let uses =
        Usage { action: Some(work.action.clone()), robot: Some(work.robot.clone()), world: Some(work.world.clone()) };
    let goals = u32::try_from(work.problem.goals.len()).unwrap_or(u32::MAX);
    let progress = JobProgress { repetitions: work.repetitions, goals, ..JobProgress::default() };
    Resolved { name, request, work: Work::Execution(Box::new(work)), uses, progress, experiment: None }
}

/// The cost of all repetitions, from a preview of the first one.
///
/// # Errors
/// `Invalid` if the preview breaks off.
pub(super) fn estimate(work: &ExecutionWork, cost: TrialCost<'_>) -> Result<CostEstimate, AppError> {
    let first = cost.try_out(&work.problem, work.seed, PREVIEW_TIME)?;
    let basis = first.preview.basis();
    let evaluations = first.preview.whole() * f64::from(work.repetitions);
    let paced_s = work.max_evaluations_per_s.map_or(0.0, |rate| evaluations / rate);
    Ok(cost.of(evaluations, &[first], paced_s, basis))
}

/// A choice for the trajectories that is not allowed, with its place.
fn refused(error: &PlanError) -> AppError {
    let place = error.place().into_iter().fold("/planning".to_owned(), |parent, key| json_pointer::join(&parent, key));
    AppError::field(place, "invalid_planning", error.to_string())
}

/// Checks the numbers and names of a request before anything is looked up.
fn bounds(request: &ExecutionRequest) -> Vec<FieldError> {
    let mut errors = Vec::new();
    let mut wrong = |pointer: &str, detail: String| errors.push(FieldError::new(pointer, "out_of_range", detail));
    if !limits::REPETITIONS.contains(&request.repetitions) {
        let bounds = limits::in_words(&limits::REPETITIONS);
        wrong("/repetitions", format!("repetitions is {}: give {bounds}", request.repetitions));
    }
    if let Some(seed) = request.seed.filter(|seed| !limits::FIRST_SEED.contains(seed)) {
        wrong("/seed", format!("seed is {seed}: give {}", limits::in_words(&limits::FIRST_SEED)));
    }
    let pace = Range::from(limits::MIN_EVALUATIONS_PER_S..);
    let rate = request.max_evaluations_per_s.map(|rate| pace.check("max_evaluations_per_s", None, rate));
    if let Some(Err(error)) = rate {
        wrong("/max_evaluations_per_s", error.to_string());
    }
    if let Some(error) = request.name.as_deref().and_then(|name| check_name("/name", name).err()) {
        errors.extend(error.details);
    }
    errors
}
