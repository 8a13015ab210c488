//! From a request to a self-contained job: looks up references, fills in defaults, and checks everything as the worker
//! will. A dry run uses the same code.

use super::earlier::setting;
use super::estimate::estimate;
use super::reference::{look_up, missing};
use super::resolved::Resolved;
use crate::app::model::{
    AppError, CostEstimate, CreateJob, ErrorKind, ExecutionRequest, ExecutionWork, ExperimentId, FieldError,
    GeneralizationRequest, JobProgress, Validation, Work,
};
use crate::app::ports::SEED_BOUND;
use crate::app::{App, chain_text, check_name, compute};
use crate::framework::execution::{Chosen, Iet, Problem, ROBOT_TRIAL_S};
use crate::framework::experiment::Plan;
use crate::framework::generalization::Goals;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Maximum number of repetitions of one job.
const MAX_REPETITIONS: u32 = 1000;
/// Longest accepted duration of a trial on a robot: one day.
const MAX_TRIAL_S: f64 = 86_400.0;
/// Maximum number of demonstrations of one action.
const MAX_DEMONSTRATIONS: usize = 1000;

impl App {
    /// Checks a job as [`App::create_job`] would, without creating it, and estimates its cost. A trial on a robot is
    /// assumed to take `robot_trial_s` seconds (15 if absent).
    ///
    /// # Errors
    /// Only if the service is at fault; problems of the request are part of the answer.
    pub async fn validate_job(&self, request: CreateJob, robot_trial_s: Option<f64>) -> Result<Validation, AppError> {
        match self.preview(request, robot_trial_s.unwrap_or(ROBOT_TRIAL_S)).await {
            Ok((estimate, chosen)) => {
                Ok(Validation { valid: true, errors: Vec::new(), estimate: Some(estimate), chosen })
            }
            Err(error) if error.kind == ErrorKind::Invalid => {
                Ok(Validation { valid: false, errors: error.details, estimate: None, chosen: None })
            }
            Err(error) => Err(error),
        }
    }

    async fn preview(
        &self,
        request: CreateJob,
        robot_trial_s: f64,
    ) -> Result<(CostEstimate, Option<Chosen>), AppError> {
        if !(robot_trial_s > 0.0 && robot_trial_s <= MAX_TRIAL_S) {
            let detail = format!("robot_trial_s is {robot_trial_s}: give a time above 0 and up to {MAX_TRIAL_S} s");
            return Err(AppError::field("/robot_trial_s", "out_of_range", detail));
        }
        let resolved = self.resolve(request).await?;
        let chosen = match &resolved.work {
            Work::Execution(work) => work.problem.execution.chosen.clone(),
            Work::Generalization(_) | Work::Experiment { .. } => None,
        };
        let clock = Arc::clone(&self.ports.clock);
        let estimate = compute(move || estimate(&resolved, robot_trial_s, clock.as_ref())).await??;
        Ok((estimate, chosen))
    }

    pub(super) async fn resolve(&self, request: CreateJob) -> Result<Resolved, AppError> {
        match request {
            CreateJob::Generalization(request) => self.resolve_generalization(request).await,
            CreateJob::Execution(request) => self.resolve_execution(*request).await,
            CreateJob::Experiment(request) => {
                let (request, plan) = self.plan_experiment(request).await?;
                Ok(self.resolved_experiment(plan.name.clone(), CreateJob::Experiment(request), plan))
            }
        }
    }

    /// A new experiment with this plan.
    pub(super) fn resolved_experiment(&self, name: String, request: CreateJob, plan: Plan) -> Resolved {
        let id = ExperimentId::from_uuid(self.ports.ids.uuid());
        let work = Work::Experiment { experiment: id.clone() };
        let progress = JobProgress { repetitions: plan.repetitions, ..JobProgress::default() };
        Resolved { progress, experiment: Some((id, plan)), ..Resolved::new(name, request, work) }
    }

    async fn resolve_generalization(&self, request: GeneralizationRequest) -> Result<Resolved, AppError> {
        check_name("/name", &request.name)?;
        let mut errors = Vec::new();
        if !(request.t_min_s.is_finite() && request.t_min_s > 0.0) {
            let detail = format!("t_min_s is {}: give a time above 0", request.t_min_s);
            errors.push(FieldError::new("/t_min_s", "out_of_range", detail));
        }
        if request.demonstrations.is_empty() || request.demonstrations.len() > MAX_DEMONSTRATIONS {
            let count = request.demonstrations.len();
            let detail = format!("{count} demonstrations are named: give 1 to {MAX_DEMONSTRATIONS}");
            errors.push(FieldError::new("/demonstrations", "out_of_range", detail));
        }
        let mut seen = BTreeSet::new();
        for (index, id) in request.demonstrations.iter().enumerate().take(MAX_DEMONSTRATIONS) {
            let pointer = format!("/demonstrations/{index}");
            if !seen.insert(id) {
                errors.push(FieldError::new(pointer, "duplicate", format!("{id} is named twice: name it once")));
                continue;
            }
            match self.ports.store.demonstration(id).await {
                Ok(view) => {
                    if let Some(reason) = view.excluded {
                        let detail = format!("{id} is excluded ({reason}): include it again or omit it");
                        errors.push(FieldError::new(pointer, "excluded", detail));
                    }
                }
                Err(error) => errors.push(missing(pointer, error)?),
            }
        }
        if !errors.is_empty() {
            return Err(AppError::invalid(errors));
        }
        let work = Work::Generalization(request.clone());
        Ok(Resolved::new(request.name.clone(), CreateJob::Generalization(request), work))
    }

    async fn resolve_execution(&self, mut request: ExecutionRequest) -> Result<Resolved, AppError> {
        let mut errors = bounds(&request);
        let store = &self.ports.store;
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
        let goals = Goals::new(goals.features, &goals.goals).map_err(AppError::internal)?;
        let mut problem = Problem {
            goals,
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
        let seed = request.seed.unwrap_or_else(|| self.ports.ids.seed());
        let setting = setting(&robot, &problem, seed, request.repetitions);
        problem.earlier = self.earlier_trials(&mut request, setting.as_deref()).await?;
        let problem = compute(move || match Iet::new(&problem, seed) {
            Ok(_) => Ok(problem),
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
            setting,
            seed,
            repetitions: request.repetitions,
            max_evaluations_per_s: request.max_evaluations_per_s,
        };
        Ok(Resolved::new(name, CreateJob::Execution(Box::new(request)), Work::Execution(Box::new(work))))
    }
}

/// Checks the numbers and names of a request before anything is looked up.
fn bounds(request: &ExecutionRequest) -> Vec<FieldError> {
    let mut errors = Vec::new();
    let mut wrong = |pointer: &str, detail: String| errors.push(FieldError::new(pointer, "out_of_range", detail));
    if !(1..=MAX_REPETITIONS).contains(&request.repetitions) {
        wrong("/repetitions", format!("repetitions is {}: give 1 to {MAX_REPETITIONS}", request.repetitions));
    }
    let last = SEED_BOUND - u64::from(MAX_REPETITIONS);
    if let Some(seed) = request.seed.filter(|seed| *seed >= last) {
        wrong("/seed", format!("seed is {seed}: give one below {last}"));
    }
    if let Some(rate) = request.max_evaluations_per_s.filter(|rate| !(rate.is_finite() && *rate >= 0.1)) {
        wrong("/max_evaluations_per_s", format!("max_evaluations_per_s is {rate}: give 0.1 or more"));
    }
    if let Some(error) = request.name.as_deref().and_then(|name| check_name("/name", name).err()) {
        errors.extend(error.details);
    }
    errors
}
