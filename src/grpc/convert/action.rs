//! Actions.

use super::all;
use crate::app::model::{ActionGoals, ActionView};
use crate::grpc::proto;

impl From<ActionView> for proto::Action {
    fn from(view: ActionView) -> Self {
        Self {
            id: view.id.into(),
            name: view.name,
            version: view.version,
            features: all(view.features),
            goals: view.goals,
            mean_duration_s: view.mean_duration_s,
            t_min_s: view.t_min_s,
            weighting: super::work::weighting_message(view.weighting) as i32,
            metric: proto::Metric::from(view.metric) as i32,
            demonstrations: view.demonstrations.into_iter().map(String::from).collect(),
            job: view.job.into(),
            created_at_ms: view.created_at.0,
        }
    }
}

impl From<ActionGoals> for proto::ActionGoals {
    fn from(goals: ActionGoals) -> Self {
        Self { action: goals.action.into(), features: all(goals.features), goals: all(goals.goals) }
    }
}
