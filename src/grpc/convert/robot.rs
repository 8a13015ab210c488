//! Robots.

use super::{all, finite, list, triple};
use crate::app::model::{AppError, CreateRobot, RobotView};
use crate::framework::robot::{ChainSummary, Gene, RobotSpec};
use crate::grpc::proto;
use std::collections::BTreeMap;

/// A new robot.
pub fn create(request: proto::CreateRobotRequest) -> Result<CreateRobot, AppError> {
    let spec = request.spec.map(spec).transpose()?.unwrap_or_default();
    Ok(CreateRobot { name: request.name, urdf: request.urdf, spec })
}

fn spec(spec: proto::RobotSpec) -> Result<RobotSpec, AppError> {
    let limit = |(joint, limits): (String, proto::JointLimits)| {
        let pointer = format!("/spec/limits/{joint}");
        Ok((joint, [finite(&pointer, limits.lower)?, finite(&pointer, limits.upper)?]))
    };
    let limits = spec.limits.into_iter().map(limit).collect::<Result<_, AppError>>()?;
    Ok(RobotSpec {
        base_link: spec.base_link,
        tip_link: spec.tip_link,
        free_joints: list(spec.free_joints),
        fixed: values("/spec/fixed", spec.fixed)?,
        tool_offset_m: if spec.tool_offset_m.is_empty() {
            [0.0; 3]
        } else {
            triple("/spec/tool_offset_m", &spec.tool_offset_m)?
        },
        limits,
        acceleration: values("/spec/acceleration", spec.acceleration)?,
        home: values("/spec/home", spec.home)?,
    })
}

fn values(pointer: &str, values: BTreeMap<String, f64>) -> Result<BTreeMap<String, f64>, AppError> {
    values.iter().try_for_each(|(joint, value)| finite(&format!("{pointer}/{joint}"), *value).map(drop))?;
    Ok(values)
}

impl From<RobotSpec> for proto::RobotSpec {
    fn from(spec: RobotSpec) -> Self {
        let limits = spec.limits.into_iter();
        Self {
            base_link: spec.base_link,
            tip_link: spec.tip_link,
            free_joints: spec.free_joints.unwrap_or_default(),
            fixed: spec.fixed,
            tool_offset_m: spec.tool_offset_m.to_vec(),
            limits: limits.map(|(joint, [lower, upper])| (joint, proto::JointLimits { lower, upper })).collect(),
            acceleration: spec.acceleration,
            home: spec.home,
        }
    }
}

impl From<RobotView> for proto::Robot {
    fn from(view: RobotView) -> Self {
        Self {
            id: view.id.into(),
            name: view.name,
            version: view.version,
            spec: Some(view.spec.into()),
            summary: Some(summary(view.summary.links.len(), view.chain)),
            urdf_sha256: view.urdf_sha256,
            created_at_ms: view.created_at.0,
        }
    }
}

fn summary(links: usize, chain: ChainSummary) -> proto::RobotSummary {
    proto::RobotSummary {
        links: u32::try_from(links).unwrap_or(u32::MAX),
        base_link: chain.base_link,
        tip_link: chain.tip_link,
        joints: all(chain.free_joints),
    }
}

impl From<Gene> for proto::JointSummary {
    fn from(joint: Gene) -> Self {
        Self {
            name: joint.name,
            kind: joint.kind.name().to_owned(),
            free: true,
            lower: Some(joint.lower),
            upper: Some(joint.upper),
            velocity: joint.velocity,
            acceleration: joint.acceleration,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spec_survives_the_wire() {
        let full = RobotSpec {
            base_link: Some("base".to_owned()),
            tip_link: Some("hand".to_owned()),
            free_joints: Some(vec!["a".to_owned(), "b".to_owned()]),
            fixed: BTreeMap::from([("c".to_owned(), -0.7)]),
            tool_offset_m: [0.0, 0.1, -0.2],
            limits: BTreeMap::from([("a".to_owned(), [-1.0, 2.0])]),
            acceleration: BTreeMap::from([("a".to_owned(), 3.0)]),
            home: BTreeMap::from([("b".to_owned(), 0.4)]),
        };
        for before in [full, RobotSpec::default()] {
            assert_eq!(spec(before.clone().into()).unwrap(), before);
        }
        assert_eq!(spec(proto::RobotSpec::default()).unwrap(), RobotSpec::default());
    }

    #[test]
    fn infinite_limits_are_refused_by_joint() {
        let limits = proto::JointLimits { lower: f64::NEG_INFINITY, upper: 0.0 };
        let wrong = proto::RobotSpec { limits: BTreeMap::from([("a".to_owned(), limits)]), ..Default::default() };
        assert_eq!(spec(wrong).unwrap_err().details[0].pointer, "/spec/limits/a");
    }
}
