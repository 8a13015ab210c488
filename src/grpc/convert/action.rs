//! Conversion of actions.

use super::enumeration::Enumeration as _;
use super::{all, time};
use crate::app::model::{ActionGoals, ActionView, Interpolation};
use crate::grpc::proto;

impl From<ActionView> for proto::Action {
    fn from(view: ActionView) -> Self {
        let ActionView {
            id,
            name,
            version,
            features,
            goals,
            mean_duration_s,
            t_min_s,
            weighting,
            metric,
            demonstrations,
            job,
            created_at,
        } = view;
        Self {
            id: id.into(),
            name,
            version,
            features: all(features),
            goals,
            mean_duration_s,
            t_min_s,
            weighting: weighting.number(),
            metric: metric.number(),
            demonstrations: demonstrations.into_iter().map(String::from).collect(),
            job: job.into(),
            created_at: Some(time(created_at)),
        }
    }
}

impl From<ActionGoals> for proto::ActionGoals {
    fn from(view: ActionGoals) -> Self {
        let ActionGoals { action, features, goals, spread } = view;
        Self { action: action.into(), features: all(features), goals: all(goals), spread: all(spread) }
    }
}

impl From<Interpolation> for proto::Interpolation {
    fn from(view: Interpolation) -> Self {
        let Interpolation { action, features, x, values } = view;
        Self { action: action.into(), features: all(features), x, values: all(values) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::model::{ActionId, DemonstrationId, JobId, Timestamp};
    use crate::framework::Feature;
    use crate::framework::generalization::Weighting;
    use crate::framework::recognition::Metric;
    use uuid::Uuid;

    #[test]
    fn an_action_keeps_its_choices_and_its_time() {
        let view = ActionView {
            id: ActionId::from_uuid(Uuid::from_u128(1)),
            name: "wax".to_owned(),
            version: 2,
            features: vec![Feature::new("x", "m")],
            goals: 3,
            mean_duration_s: 4.5,
            t_min_s: 1.5,
            weighting: Weighting::PerSample,
            metric: Metric::Aquila,
            demonstrations: vec![DemonstrationId::from_uuid(Uuid::from_u128(2))],
            job: JobId::from_uuid(Uuid::from_u128(3)),
            created_at: Timestamp(-1),
        };
        let message = proto::Action::from(view);
        assert_eq!(message.weighting(), proto::Weighting::PerSample);
        assert_eq!(message.metric(), proto::Metric::Aquila);
        assert_eq!(message.demonstrations, ["dem_00000000000000000000000000000002"]);
        assert_eq!(message.features[0].unit, "m");
        let time = message.created_at.unwrap();
        assert_eq!((time.seconds, time.nanos), (-1, 999_000_000));
    }

    #[test]
    fn goals_have_their_spread() {
        let view = ActionGoals {
            action: ActionId::from_uuid(Uuid::from_u128(1)),
            features: vec![Feature::new("x", "m"), Feature::new("y", "m")],
            goals: vec![vec![1.0, 2.0], vec![3.0, 4.0]],
            spread: vec![vec![0.1, 0.2], vec![0.3, 0.4]],
        };
        let message = proto::ActionGoals::from(view);
        assert_eq!(message.goals[1].values, [3.0, 4.0]);
        assert_eq!(message.spread[1].values, [0.3, 0.4]);
    }
}
