//! Robots: known values, numeric against analytic results, properties and rejected inputs.

use super::*;
use proptest::prelude::*;
use rstest::rstest;
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_4, PI};

const TEO_ARM: &str = include_str!("../../../examples/robots/teo_right_arm.urdf");

fn paper_spec() -> RobotSpec {
    RobotSpec {
        free_joints: Some(["shoulder_pitch", "shoulder_roll", "elbow_pitch"].map(str::to_owned).to_vec()),
        fixed: BTreeMap::from([("wrist_yaw".to_owned(), -FRAC_PI_4)]),
        ..RobotSpec::default()
    }
}

fn paper_chain() -> Chain {
    Chain::new(&RobotModel::from_urdf(TEO_ARM).unwrap(), &paper_spec()).unwrap()
}

/// p = S + Ry(-g0) Rx(-g1) [ (0,0,-0.329) + Ry(-g2) Rz(-45 deg) (0, 0.00892, -0.4692) ].
fn closed_form(g: &[f64]) -> [f64; 3] {
    let ry = |a: f64, v: [f64; 3]| [a.cos() * v[0] + a.sin() * v[2], v[1], a.cos() * v[2] - a.sin() * v[0]];
    let rx = |a: f64, v: [f64; 3]| [v[0], a.cos() * v[1] - a.sin() * v[2], a.sin() * v[1] + a.cos() * v[2]];
    let side = 0.00892 * FRAC_PI_4.sin();
    let mut v = ry(-g[2], [side, side, -0.4692]);
    v[2] -= 0.329;
    let v = ry(-g[0], rx(-g[1], v));
    [v[0], v[1] - 0.34692, v[2] + 0.7982]
}

#[test]
fn paper_arm_has_the_published_check_value() {
    let p = tool_position(&paper_chain(), &[0.0; 3]);
    for (found, known) in p.iter().zip([0.006_307_4, -0.340_612_6, 0.0]) {
        assert!((found - known).abs() < 1e-7, "{p:?}");
    }
}

proptest! {
    #[test]
    fn paper_arm_equals_the_closed_form(g in prop::array::uniform3(-0.262..1.745_f64)) {
        let chain = paper_chain();
        let p = tool_position(&chain, &g);
        let pose = forward_kinematics(&chain, &g, &mut Workspace::new(&chain));
        for (k, known) in closed_form(&g).into_iter().enumerate() {
            prop_assert!((p[k] - known).abs() < 1e-12);
            prop_assert!((pose.translation.vector[k] - known).abs() < 1e-12);
        }
    }

    #[test]
    fn jacobian_equals_central_differences(q in prop::collection::vec(-1.0..1.0_f64, 6)) {
        let chain = all_kinds_chain();
        let q = &q[..chain.len()];
        let mut workspace = Workspace::new(&chain);
        let analytic = jacobian(&chain, q, &mut workspace).clone();
        let h = 1e-6;
        for gene in 0..chain.len() {
            let at = |delta: f64, workspace: &mut Workspace| {
                let mut moved = q.to_vec();
                moved[gene] += delta;
                forward_kinematics(&chain, &moved, workspace)
            };
            let (plus, minus) = (at(h, &mut workspace), at(-h, &mut workspace));
            let linear = (plus.translation.vector - minus.translation.vector) / (2.0 * h);
            let angular = (plus.rotation * minus.rotation.inverse()).scaled_axis() / (2.0 * h);
            for k in 0..3 {
                prop_assert!((analytic[(k, gene)] - linear[k]).abs() < 1e-7);
                prop_assert!((analytic[(k + 3, gene)] - angular[k]).abs() < 1e-7);
            }
        }
    }
}

/// Revolute about a slanted axis, prismatic, continuous, a fixed joint in between, and a mimic of the first with factor
/// -0.5.
fn all_kinds_urdf() -> String {
    let joint = |name: &str, kind: &str, parent: &str, child: &str, rest: &str| {
        format!(r#"<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>{rest}</joint>"#)
    };
    let origin = r#"<origin xyz="0.1 -0.2 0.3" rpy="0.3 -0.2 0.5"/>"#;
    let limit = r#"<limit lower="-2" upper="2" effort="1" velocity="1.5"/>"#;
    format!(
        r#"<robot name="kinds"><link name="a"/><link name="b"/><link name="c"/><link name="d"/><link name="e"/><link name="f"/>{}{}{}{}{}</robot>"#,
        joint("slant", "revolute", "a", "b", &format!(r#"{origin}<axis xyz="1 2 -1"/>{limit}"#)),
        joint("slide", "prismatic", "b", "c", &format!(r#"{origin}<axis xyz="0 0 1"/>{limit}"#)),
        joint("bolt", "fixed", "c", "d", origin),
        joint("spin", "continuous", "d", "e", r#"<axis xyz="0 1 0"/><limit effort="1" velocity="4"/>"#),
        joint(
            "follow",
            "revolute",
            "e",
            "f",
            &format!(r#"{origin}<axis xyz="1 0 0"/>{limit}<mimic joint="slant" multiplier="-0.5" offset="0.1"/>"#)
        ),
    )
}

fn all_kinds_chain() -> Chain {
    let spec = RobotSpec { tool_offset_m: [0.05, 0.0, 0.2], ..RobotSpec::default() };
    Chain::new(&RobotModel::from_urdf(&all_kinds_urdf()).unwrap(), &spec).unwrap()
}

#[test]
fn every_kind_of_joint_becomes_the_gene_it_should() {
    let chain = all_kinds_chain();
    let names: Vec<&str> = chain.genes().iter().map(|g| g.name.as_str()).collect();
    assert_eq!(names, ["slant", "slide", "spin"]);
    assert_eq!((chain.genes()[2].lower, chain.genes()[2].upper), (-PI, PI));
    assert_eq!(chain.genes()[0].velocity, Some(1.5));
    let all = chain.all_positions(&[0.4, 0.5, 0.6]);
    assert!((all["follow"] - (0.1 - 0.2)).abs() < 1e-15);
}

#[test]
fn a_mimic_narrows_the_limits_of_the_joint_it_follows() {
    let urdf = all_kinds_urdf().replace(r#"multiplier="-0.5" offset="0.1""#, r#"multiplier="-4" offset="0""#);
    let chain = Chain::new(&RobotModel::from_urdf(&urdf).unwrap(), &RobotSpec::default()).unwrap();
    let gene = &chain.genes()[0];
    assert_eq!((gene.lower, gene.upper, gene.velocity), (-0.5, 0.5, Some(0.375)));
}

#[test]
fn holding_a_joint_equals_moving_it_there() {
    let model = RobotModel::from_urdf(TEO_ARM).unwrap();
    let moving = Chain::new(&model, &RobotSpec::default()).unwrap();
    assert_eq!(moving.len(), 6);
    let held = tool_position(&paper_chain(), &[0.3, 0.7, 1.1]);
    let moved = tool_position(&moving, &[0.3, 0.7, 0.0, 1.1, -FRAC_PI_4, 0.0]);
    assert!((held - moved).norm() < 1e-12);
}

#[test]
fn missing_velocity_is_a_note_not_an_error() {
    let urdf = all_kinds_urdf().replace(r#" effort="1" velocity="1.5""#, r#" effort="1""#);
    let model = RobotModel::from_urdf(&urdf).unwrap();
    let codes: Vec<String> = summarize(&model).notes.iter().map(|n| format!("{} {}", n.joint, n.code)).collect();
    assert_eq!(codes, ["slant no_velocity_limit", "slide no_velocity_limit", "follow no_velocity_limit"]);
}

#[rstest]
#[case::dtd(r#"<!DOCTYPE robot [<!ENTITY a "b">]><robot name="r"><link name="a"/></robot>"#, "DTD")]
#[case::other_document("<sdf/>", "<sdf>")]
#[case::no_link(r#"<robot name="r"/>"#, "no <link>")]
#[case::two_links_one_name(r#"<robot name="r"><link name="a"/><link name="a"/></robot>"#, "\"a\"")]
#[case::two_roots(r#"<robot name="r"><link name="a"/><link name="z"/></robot>"#, "[\"a\", \"z\"]")]
fn refuses_documents(#[case] urdf: &str, #[case] told: &str) {
    let error = RobotModel::from_urdf(urdf).unwrap_err().to_string();
    assert!(error.contains(told), "{error}");
}

#[rstest]
#[case::missing_link(r#"<child link="c"/>"#, r#"<child link="nowhere"/>"#, "\"slide\": its child link \"nowhere\"")]
#[case::two_parents(r#"<child link="c"/>"#, r#"<child link="b"/>"#, "link \"b\" is the child of")]
#[case::cycle(r#"<parent link="a"/>"#, r#"<parent link="f"/>"#, "loop")]
#[case::zero_axis("1 2 -1", "0 0 0", "joint \"slant\": axis [0.0, 0.0, 0.0]")]
#[case::nan_axis("1 2 -1", "0 NaN 0", "joint \"slant\": axis xyz is \"0 NaN 0\"")]
#[case::limit_order(r#"lower="-2" upper="2""#, r#"lower="3" upper="2""#, "lower limit 3 is above upper limit 2")]
#[case::limit_text(r#"lower="-2""#, r#"lower="two""#, "lower is \"two\"")]
#[case::mimic_unknown(r#"<mimic joint="slant""#, r#"<mimic joint="ghost""#, "mimics \"ghost\"")]
#[case::mimic_self(r#"<mimic joint="slant""#, r#"<mimic joint="follow""#, "mimics itself")]
#[case::kind(r#"type="prismatic""#, r#"type="screw""#, "type \"screw\"")]
#[case::duplicate_joint(r#"name="slide""#, r#"name="slant""#, "two joints are named \"slant\"")]
fn refuses_broken_trees(#[case] from: &str, #[case] to: &str, #[case] told: &str) {
    let urdf = all_kinds_urdf();
    assert!(urdf.contains(from), "the test's own text has changed: {from}");
    let error = RobotModel::from_urdf(&urdf.replace(from, to)).unwrap_err().to_string();
    assert!(error.contains(told), "{error}");
}

#[rstest]
#[case(r#"<axis xyz="1e300 1e300 1e300"/>"#, "axis xyz contains 1e300")]
#[case(r#"<origin xyz="1e300 0 0"/>"#, "origin xyz contains 1e300")]
#[case(r#"<limit lower="-1e308" upper="1e308"/>"#, "lower contains -1e308")]
#[case(r#"<limit lower="-1" upper="1"/><mimic joint="j" multiplier="1e300"/>"#, "mimic multiplier contains 1e300")]
fn refuses_numbers_that_would_overflow(#[case] inside: &str, #[case] told: &str) {
    let urdf = format!(
        r#"<robot name="r"><link name="a"/><link name="b"/>
        <joint name="j" type="revolute"><parent link="a"/><child link="b"/>{inside}</joint></robot>"#
    );
    let error = RobotModel::from_urdf(&urdf).unwrap_err().to_string();
    assert!(error.contains(told), "{error}");
}

#[rstest]
#[case("x".repeat(1 << 20), "1048576 characters")]
#[case("\u{202e}x".to_owned(), "2 characters")]
fn refuses_names_without_repeating_them_whole(#[case] name: String, #[case] told: &str) {
    let error = RobotModel::from_urdf(&format!(r#"<robot name="r"><link name="{name}"/></robot>"#)).unwrap_err();
    let error = error.to_string();
    assert!(error.contains(told) && error.len() < 300, "{error}");
}

#[test]
fn refuses_more_links_than_allowed() {
    let links = (0..=MAX_LINKS).map(|i| format!(r#"<link name="l{i}"/>"#)).collect::<Vec<_>>().concat();
    let error = RobotModel::from_urdf(&format!(r#"<robot name="r">{links}</robot>"#)).unwrap_err().to_string();
    assert!(error.contains("257 links"), "{error}");
}

#[rstest]
#[case::tip(RobotSpec { tip_link: Some("x".into()), ..RobotSpec::default() }, "tip_link \"x\"")]
#[case::order(
    RobotSpec { base_link: Some("d".into()), tip_link: Some("b".into()), ..RobotSpec::default() },
    "does not descend"
)]
#[case::free(RobotSpec { free_joints: Some(vec!["bolt".into()]), ..RobotSpec::default() }, "free_joints names joint \"bolt\"")]
#[case::twice(RobotSpec { free_joints: Some(vec!["slant".into(); 2]), ..RobotSpec::default() }, "named twice")]
#[case::outside(
    RobotSpec { fixed: BTreeMap::from([("slant".into(), 9.0)]), ..RobotSpec::default() },
    "fixed value 9 of joint \"slant\""
)]
#[case::far_limits(
    RobotSpec { limits: BTreeMap::from([("slant".into(), [-1e308, 1e308])]), ..RobotSpec::default() },
    "joint \"slant\": limit is -1e308"
)]
#[case::home(
    RobotSpec { home: BTreeMap::from([("slant".into(), 9.0)]), ..RobotSpec::default() },
    "home 9 of joint \"slant\" is outside its limits"
)]
#[case::home_of_nothing(
    RobotSpec { home: BTreeMap::from([("bolt".into(), 0.0)]), ..RobotSpec::default() },
    "home names joint \"bolt\""
)]
#[case::far_tool(
    RobotSpec { tool_offset_m: [0.0, 1e308, 0.0], ..RobotSpec::default() },
    "tool_offset_m is 1e308: give -1000000 to 1000000 m"
)]
#[case::acceleration(
    RobotSpec { acceleration: BTreeMap::from([("slant".into(), 0.0)]), ..RobotSpec::default() },
    "joint \"slant\": acceleration is 0: give more than 0"
)]
fn refuses_chains(#[case] spec: RobotSpec, #[case] told: &str) {
    let model = RobotModel::from_urdf(&all_kinds_urdf()).unwrap();
    let error = Chain::new(&model, &spec).unwrap_err().to_string();
    assert!(error.contains(told), "{error}");
}

#[test]
fn a_floating_base_is_read_but_no_chain_passes_it() {
    let urdf = all_kinds_urdf().replacen(r#"type="revolute""#, r#"type="floating""#, 1);
    let model =
        RobotModel::from_urdf(&urdf.replace(r#"<mimic joint="slant" multiplier="-0.5" offset="0.1"/>"#, "")).unwrap();
    assert_eq!(summarize(&model).notes[0].code, "not_drivable");
    let error = Chain::new(&model, &RobotSpec::default()).unwrap_err().to_string();
    assert!(error.contains("floating joint \"slant\"") && error.contains("choose base_link \"b\""), "{error}");
    let below = RobotSpec { base_link: Some("b".into()), ..RobotSpec::default() };
    assert_eq!(Chain::new(&model, &below).unwrap().len(), 3);
}

#[test]
fn the_whole_humanoid_loads_and_its_arm_moves() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data/robots/teo.urdf");
    let Ok(urdf) = std::fs::read_to_string(path) else {
        eprintln!("skipped: {path} is not there");
        return;
    };
    let model = RobotModel::from_urdf(&urdf).unwrap();
    assert_eq!(model.joints().iter().filter(|j| j.kind == JointKind::Revolute).count(), 28);
    let spec = RobotSpec { tip_link: Some("r_wrist_pitch_link".into()), ..RobotSpec::default() };
    let chain = Chain::new(&model, &spec).unwrap();
    assert_eq!((chain.base_link(), chain.len()), ("waist", 8));
    assert!(tool_position(&chain, chain.home()).iter().all(|v| v.is_finite()));
}

#[test]
fn home_is_as_described_and_otherwise_0_moved_into_the_limits() {
    let model = RobotModel::from_urdf(&all_kinds_urdf()).unwrap();
    let joint = Chain::new(&model, &RobotSpec::default()).unwrap().genes()[0].name.clone();
    let limits = BTreeMap::from([(joint.clone(), [0.25, 0.75])]);
    let near_zero = RobotSpec { limits: limits.clone(), ..RobotSpec::default() };
    assert_eq!(Chain::new(&model, &near_zero).unwrap().home()[0].to_bits(), 0.25_f64.to_bits());
    let described = RobotSpec { limits, home: BTreeMap::from([(joint, 0.5)]), ..RobotSpec::default() };
    assert_eq!(Chain::new(&model, &described).unwrap().home()[0].to_bits(), 0.5_f64.to_bits());
}
