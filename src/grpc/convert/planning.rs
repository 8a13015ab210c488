//! Conversion of the choices for trajectories, in both directions.

use super::enumeration::{Enumeration as _, or_default};
use super::finite_or_none;
use crate::app::json_pointer;
use crate::app::model::AppError;
use crate::framework::trajectory::{MotionLimits, PlanSpec};
use crate::grpc::proto;

/// The choices; those that are absent have their defaults.
///
/// # Errors
/// `Invalid` at the JSON pointer that the field has over HTTP.
pub fn spec(message: proto::PlanSpec) -> Result<PlanSpec, AppError> {
    let proto::PlanSpec { speed, acceleration, dwell_s, blend, timing, joint_limits, sample_s } = message;
    let default = PlanSpec::default();
    let number = |field: &str, value: Option<f64>| finite_or_none(&format!("/planning/{field}"), value);
    let limit = |(joint, message): (String, proto::MotionLimits)| {
        let place = json_pointer::join("/planning/joint_limits", &joint);
        Ok((joint, limits(&place, message)?))
    };
    Ok(PlanSpec {
        speed: number("speed", speed)?.unwrap_or(default.speed),
        acceleration: number("acceleration", acceleration)?.unwrap_or(default.acceleration),
        dwell_s: number("dwell_s", dwell_s)?.unwrap_or(default.dwell_s),
        blend,
        timing: or_default("/planning/timing", timing)?,
        joint_limits: joint_limits.into_iter().map(limit).collect::<Result<_, AppError>>()?,
        sample_s: number("sample_s", sample_s)?.unwrap_or(default.sample_s),
    })
}

fn limits(place: &str, message: proto::MotionLimits) -> Result<MotionLimits, AppError> {
    let proto::MotionLimits { velocity, acceleration, jerk } = message;
    let number = |field: &str, value: Option<f64>| finite_or_none(&json_pointer::join(place, field), value);
    Ok(MotionLimits {
        velocity: number("velocity", velocity)?,
        acceleration: number("acceleration", acceleration)?,
        jerk: number("jerk", jerk)?,
    })
}

impl From<PlanSpec> for proto::PlanSpec {
    fn from(spec: PlanSpec) -> Self {
        let PlanSpec { speed, acceleration, dwell_s, blend, timing, joint_limits, sample_s } = spec;
        Self {
            speed: Some(speed),
            acceleration: Some(acceleration),
            dwell_s: Some(dwell_s),
            blend,
            timing: timing.number(),
            joint_limits: joint_limits.into_iter().map(|(joint, limits)| (joint, limits.into())).collect(),
            sample_s: Some(sample_s),
        }
    }
}

impl From<MotionLimits> for proto::MotionLimits {
    fn from(limits: MotionLimits) -> Self {
        let MotionLimits { velocity, acceleration, jerk } = limits;
        Self { velocity, acceleration, jerk }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn absent_choices_are_the_defaults_and_no_number_is_told_at_its_place() {
        assert_eq!(spec(proto::PlanSpec::default()).unwrap(), PlanSpec::default());
        let wrong = proto::MotionLimits { jerk: Some(f64::NAN), ..Default::default() };
        let message = proto::PlanSpec { joint_limits: [("a/b".to_owned(), wrong)].into(), ..Default::default() };
        assert_eq!(spec(message).unwrap_err().details[0].pointer, "/planning/joint_limits/a~1b/jerk");
    }
}
