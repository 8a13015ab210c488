//! Generalizations, from request to submission: demonstrations are looked up; nothing is computed before the worker.

use super::Resolved;
use crate::app::jobs::reference::missing;
use crate::app::model::{
    AppError, CostEstimate, CreateJob, FieldError, GeneralizationRequest, JobProgress, Work, limits,
};
use crate::app::ports::Usage;
use crate::app::{UseCases, check_name};
use crate::framework::range::above;
use std::collections::BTreeSet;

/// Checks a request.
///
/// # Errors
/// `Invalid` with every wrong place.
pub(super) async fn resolve(app: &UseCases, request: GeneralizationRequest) -> Result<Resolved, AppError> {
    check_name("/name", &request.name)?;
    let mut errors = Vec::new();
    if let Err(error) = above(0.0).check("t_min_s", Some("s"), request.t_min_s) {
        errors.push(FieldError::new("/t_min_s", "out_of_range", error.to_string()));
    }
    let most = *limits::DEMONSTRATIONS.end() as usize;
    if request.demonstrations.is_empty() || request.demonstrations.len() > most {
        let count = request.demonstrations.len();
        let detail = format!("{count} demonstrations are named: give 1 to {most}");
        errors.push(FieldError::new("/demonstrations", "out_of_range", detail));
    }
    let mut seen = BTreeSet::new();
    for (index, id) in request.demonstrations.iter().enumerate().take(most) {
        let pointer = format!("/demonstrations/{index}");
        if !seen.insert(id) {
            errors.push(FieldError::new(pointer, "duplicate", format!("{id} is named twice: name it once")));
            continue;
        }
        match app.ports.store.demonstration(id).await {
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
    Ok(again(request.name.clone(), CreateJob::Generalization(request.clone()), request))
}

/// The same work once more.
pub(super) fn again(name: String, request: CreateJob, work: GeneralizationRequest) -> Resolved {
    Resolved {
        name,
        request,
        work: Work::Generalization(work),
        uses: Usage::default(),
        progress: JobProgress { repetitions: 1, ..JobProgress::default() },
        experiment: None,
    }
}

/// The cost of reading and averaging.
pub(super) fn estimate() -> CostEstimate {
    let basis = "a generalization needs no evaluations".to_owned();
    CostEstimate { evaluations: 0, simulated_s: 0.1, robot_s: 0.0, text: basis.clone(), basis }
}
