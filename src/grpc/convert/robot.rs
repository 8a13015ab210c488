//! Conversion of robots.

use super::enumeration::Enumeration as _;
use super::{all, finite, list, time, triple};
use crate::app::model::{AppError, CreateRobot, RobotView};
use crate::framework::robot::{ChainSummary, Gene, JointSummary, RobotNote, RobotSpec, RobotSummary};
use crate::grpc::proto;
use std::collections::BTreeMap;

/// A new robot.
///
/// # Errors
/// `Invalid` for another number of coordinates than 3 or a number that is not finite.
pub fn create(request: proto::CreateRobotRequest) -> Result<CreateRobot, AppError> {
    let proto::CreateRobotRequest { name, urdf, spec } = request;
    Ok(CreateRobot { name, urdf, spec: spec.map(self::spec).transpose()?.unwrap_or_default() })
}

fn spec(spec: proto::RobotSpec) -> Result<RobotSpec, AppError> {
    let proto::RobotSpec { base_link, tip_link, free_joints, fixed, tool_offset_m, limits, acceleration, home, jerk } =
        spec;
    let limit = |(joint, proto::JointLimits { lower, upper }): (String, proto::JointLimits)| {
        let pointer = format!("/spec/limits/{joint}");
        Ok((joint, [finite(&pointer, lower)?, finite(&pointer, upper)?]))
    };
    Ok(RobotSpec {
        base_link,
        tip_link,
        free_joints: list(free_joints),
        fixed: values("/spec/fixed", fixed)?,
        tool_offset_m: if tool_offset_m.is_empty() { [0.0; 3] } else { triple("/spec/tool_offset_m", &tool_offset_m)? },
        limits: limits.into_iter().map(limit).collect::<Result<_, AppError>>()?,
        acceleration: values("/spec/acceleration", acceleration)?,
        jerk: values("/spec/jerk", jerk)?,
        home: values("/spec/home", home)?,
    })
}

fn values(pointer: &str, values: BTreeMap<String, f64>) -> Result<BTreeMap<String, f64>, AppError> {
    values.iter().try_for_each(|(joint, value)| finite(&format!("{pointer}/{joint}"), *value).map(drop))?;
    Ok(values)
}

impl From<RobotSpec> for proto::RobotSpec {
    fn from(spec: RobotSpec) -> Self {
        let RobotSpec { base_link, tip_link, free_joints, fixed, tool_offset_m, limits, acceleration, home, jerk } =
            spec;
        Self {
            base_link,
            tip_link,
            free_joints: free_joints.unwrap_or_default(),
            fixed,
            tool_offset_m: tool_offset_m.to_vec(),
            limits: limits.into_iter().map(|(joint, limits)| (joint, limits.into())).collect(),
            acceleration,
            jerk,
            home,
        }
    }
}

impl From<[f64; 2]> for proto::JointLimits {
    fn from([lower, upper]: [f64; 2]) -> Self {
        Self { lower, upper }
    }
}

impl From<RobotView> for proto::Robot {
    fn from(view: RobotView) -> Self {
        let RobotView { id, name, version, spec, chain, summary, urdf_sha256, created_at } = view;
        Self {
            id: id.into(),
            name,
            version,
            spec: Some(spec.into()),
            chain: Some(chain.into()),
            summary: Some(summary.into()),
            urdf_sha256,
            created_at: Some(time(created_at)),
        }
    }
}

impl From<ChainSummary> for proto::ChainSummary {
    fn from(chain: ChainSummary) -> Self {
        let ChainSummary { base_link, tip_link, free_joints, fixed_joints } = chain;
        Self { base_link, tip_link, free_joints: all(free_joints), fixed_joints }
    }
}

impl From<Gene> for proto::FreeJoint {
    fn from(joint: Gene) -> Self {
        let Gene { name, kind, lower, upper, velocity, acceleration, jerk } = joint;
        Self { name, kind: kind.number(), lower, upper, velocity, acceleration, jerk }
    }
}

impl From<RobotSummary> for proto::RobotSummary {
    fn from(summary: RobotSummary) -> Self {
        let RobotSummary { name, root_link, links, leaf_links, joints, notes } = summary;
        Self { name, root_link, links, leaf_links, joints: all(joints), notes: all(notes) }
    }
}

impl From<JointSummary> for proto::JointSummary {
    fn from(joint: JointSummary) -> Self {
        let JointSummary { name, kind, parent_link, child_link, limits, velocity, mimics } = joint;
        let limits = limits.map(Into::into);
        Self { name, kind: kind.number(), parent_link, child_link, limits, velocity, mimics }
    }
}

impl From<RobotNote> for proto::RobotNote {
    fn from(note: RobotNote) -> Self {
        let RobotNote { joint, code, message } = note;
        Self { joint, code, message }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::framework::robot::{Chain, RobotModel, summarize, summarize_chain};

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
            jerk: BTreeMap::from([("a".to_owned(), 30.0)]),
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

    #[test]
    fn what_keeps_a_robot_from_being_armed_is_told_with_its_tree() {
        let urdf = r#"<robot name="arm"><link name="a"/><link name="b"/><link name="c"/>
            <joint name="lift" type="prismatic"><parent link="a"/><child link="b"/>
              <limit lower="-1" upper="2" effort="1" velocity="0.5"/></joint>
            <joint name="turn" type="continuous"><parent link="b"/><child link="c"/></joint></robot>"#;
        let model = RobotModel::from_urdf(urdf).unwrap();
        let message = proto::RobotSummary::from(summarize(&model));
        assert_eq!((message.root_link.as_str(), message.leaf_links.as_slice()), ("a", &["c".to_owned()][..]));
        let [lift, turn] = message.joints.as_slice() else { panic!("two joints") };
        assert_eq!((lift.kind(), turn.kind()), (proto::JointKind::Prismatic, proto::JointKind::Continuous));
        assert_eq!((lift.parent_link.as_str(), lift.child_link.as_str()), ("a", "b"));
        assert_eq!(lift.limits, Some(proto::JointLimits { lower: -1.0, upper: 2.0 }));
        assert_eq!((turn.limits.as_ref(), turn.velocity), (None, None));
        assert_eq!((message.notes[0].joint.as_str(), message.notes[0].code.as_str()), ("turn", "no_velocity_limit"));

        let fixed = BTreeMap::from([("lift".to_owned(), 0.25)]);
        let chain = Chain::new(&model, &RobotSpec { fixed, ..RobotSpec::default() }).unwrap();
        let message = proto::ChainSummary::from(summarize_chain(&chain));
        assert_eq!(message.fixed_joints, BTreeMap::from([("lift".to_owned(), 0.25)]));
        assert_eq!(message.free_joints[0].name, "turn");
    }
}
