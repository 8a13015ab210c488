//! Tree check: proves that a URDF is a tree with sane numbers before urdf-rs parses it.
//!
//! urdf-rs alone accepts duplicate names, several parents and zero axes; here they are errors that name the joint. It
//! also rejects a missing velocity limit, which is tolerated here so that such a robot can still be viewed.

use super::error::ModelError;
use crate::is_hidden;
use roxmltree::{Document, Node, ParsingOptions};
use std::collections::{BTreeMap, BTreeSet};

/// Maximum number of links of a robot.
pub const MAX_LINKS: usize = 256;
/// Maximum number of XML nodes in a URDF.
pub const MAX_NODES: u32 = 100_000;
/// Maximum length of a link's or joint's name, characters.
const MAX_NAME: usize = 128;
/// Largest position, length or mimic factor (rad, m, 1); larger values could overflow in kinematics.
pub(super) const MAX_VALUE: f64 = 1e6;

const TYPES: [&str; 7] = ["revolute", "continuous", "prismatic", "fixed", "floating", "planar", "spherical"];

/// Values declared by a joint's `<limit>`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Declared {
    pub position: bool,
    pub velocity: bool,
}

/// A URDF that passed the check, with `velocity="0"` added to each `<limit>` that has none, because urdf-rs requires
/// one.
pub(super) struct Checked {
    pub text: String,
    pub declared: BTreeMap<String, Declared>,
}

struct RawJoint {
    parent: String,
    child: String,
    mimic: Option<String>,
}

/// Checks the tree and every number that a chain depends on.
///
/// # Errors
/// The first violated rule, with the name of the joint or link.
pub(super) fn check(urdf: &str) -> Result<Checked, ModelError> {
    let options = ParsingOptions { nodes_limit: MAX_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(urdf, options)?;
    let robot = document.root_element();
    if robot.tag_name().name() != "robot" {
        return Err(ModelError::NotARobot { found: robot.tag_name().name().to_owned() });
    }
    let links = read_links(robot)?;
    let mut joints: BTreeMap<String, RawJoint> = BTreeMap::new();
    let mut declared = BTreeMap::new();
    let mut insertions = Vec::new();
    for node in children(robot, "joint") {
        let name = node.attribute("name").filter(|n| !n.is_empty()).ok_or_else(|| ModelError::Missing {
            element: "joint",
            name: String::new(),
            missing: "name",
        })?;
        check_name("joint", name)?;
        let (joint, limits) = read_joint(node, name, &mut insertions)?;
        if joints.insert(name.to_owned(), joint).is_some() {
            return Err(ModelError::Duplicate { element: "joint", name: name.to_owned() });
        }
        declared.insert(name.to_owned(), limits);
    }
    check_tree(&links, &joints)?;
    check_mimics(&joints)?;
    let mut text = urdf.to_owned();
    insertions.sort_unstable();
    for position in insertions.into_iter().rev() {
        text.insert_str(position, " velocity=\"0\"");
    }
    Ok(Checked { text, declared })
}

fn children<'a, 'i>(node: Node<'a, 'i>, name: &'static str) -> impl Iterator<Item = Node<'a, 'i>> {
    node.children().filter(move |c| c.is_element() && c.tag_name().name() == name)
}

fn check_name(element: &'static str, name: &str) -> Result<(), ModelError> {
    let length = name.chars().count();
    if length > MAX_NAME || name.chars().any(is_hidden) {
        let begin = name.chars().take(16).collect();
        return Err(ModelError::Name { element, begin, length, limit: MAX_NAME });
    }
    Ok(())
}

fn read_links(robot: Node<'_, '_>) -> Result<BTreeSet<String>, ModelError> {
    let mut links = BTreeSet::new();
    let mut found = 0;
    for node in children(robot, "link") {
        found += 1;
        let name = node.attribute("name").filter(|n| !n.is_empty()).ok_or_else(|| ModelError::Missing {
            element: "link",
            name: String::new(),
            missing: "name",
        })?;
        check_name("link", name)?;
        if !links.insert(name.to_owned()) {
            return Err(ModelError::Duplicate { element: "link", name: name.to_owned() });
        }
    }
    if found > MAX_LINKS {
        return Err(ModelError::TooManyLinks { found, limit: MAX_LINKS });
    }
    if found == 0 {
        return Err(ModelError::NoLink);
    }
    Ok(links)
}

fn read_joint(node: Node<'_, '_>, name: &str, insertions: &mut Vec<usize>) -> Result<(RawJoint, Declared), ModelError> {
    let missing = |what| ModelError::Missing { element: "joint", name: name.to_owned(), missing: what };
    let kind = node.attribute("type").ok_or_else(|| missing("type"))?;
    if !TYPES.contains(&kind) {
        return Err(ModelError::JointType { joint: name.to_owned(), found: excerpt(kind) });
    }
    let end = |tag, what| {
        children(node, tag).next().and_then(|c| c.attribute("link")).map(str::to_owned).ok_or_else(|| missing(what))
    };
    let (parent, child) = (end("parent", "parent link")?, end("child", "child link")?);
    if let Some(origin) = children(node, "origin").next() {
        vector(name, "origin xyz", origin.attribute("xyz"))?;
        vector(name, "origin rpy", origin.attribute("rpy"))?;
    }
    if kind != "fixed"
        && let Some(axis) = children(node, "axis").next()
    {
        let xyz = vector(name, "axis xyz", axis.attribute("xyz"))?.ok_or_else(|| missing("axis xyz"))?;
        let length = xyz.iter().map(|v| v * v).sum::<f64>().sqrt();
        if length < 1e-6 {
            return Err(ModelError::ZeroAxis { joint: name.to_owned(), axis: xyz });
        }
    }
    let mut limits = Declared::default();
    if let Some(limit) = children(node, "limit").next() {
        let value = |attribute: &'static str| number(name, attribute, limit.attribute(attribute));
        let (lower, upper) = (bounded(name, "lower", value("lower")?)?, bounded(name, "upper", value("upper")?)?);
        value("effort")?;
        limits.position = lower.is_some() || upper.is_some();
        let (lower, upper) = (lower.unwrap_or(0.0), upper.unwrap_or(0.0));
        if lower > upper {
            return Err(ModelError::LimitOrder { joint: name.to_owned(), lower, upper });
        }
        match value("velocity")? {
            Some(velocity) => limits.velocity = velocity > 0.0,
            None => insertions.push(limit.range().start + "<limit".len()),
        }
    }
    let mimic = match children(node, "mimic").next() {
        None => None,
        Some(mimic) => {
            for (what, attribute) in [("mimic multiplier", "multiplier"), ("mimic offset", "offset")] {
                bounded(name, what, number(name, what, mimic.attribute(attribute))?)?;
            }
            Some(mimic.attribute("joint").ok_or_else(|| missing("mimic joint"))?.to_owned())
        }
    };
    Ok((RawJoint { parent, child, mimic }, limits))
}

fn number(joint: &str, attribute: &str, text: Option<&str>) -> Result<Option<f64>, ModelError> {
    let Some(text) = text else { return Ok(None) };
    text.trim().parse::<f64>().ok().filter(|v| v.is_finite()).map(Some).ok_or_else(|| ModelError::Number {
        joint: joint.to_owned(),
        attribute: attribute.to_owned(),
        found: excerpt(text),
        expected: "a finite number",
    })
}

fn bounded(joint: &str, attribute: &str, value: Option<f64>) -> Result<Option<f64>, ModelError> {
    if let Some(value) = value.filter(|value| value.abs() > MAX_VALUE) {
        let joint = joint.to_owned();
        return Err(ModelError::TooFar { joint, attribute: attribute.to_owned(), value, limit: MAX_VALUE });
    }
    Ok(value)
}

/// Truncates an invalid value for an error message.
fn excerpt(text: &str) -> String {
    text.chars().take(64).collect()
}

fn vector(joint: &str, attribute: &str, text: Option<&str>) -> Result<Option<[f64; 3]>, ModelError> {
    let Some(text) = text else { return Ok(None) };
    let values: Vec<f64> =
        text.split_whitespace().map_while(|v| v.parse::<f64>().ok().filter(|v| v.is_finite())).collect();
    let complete = values.len() == text.split_whitespace().count();
    let values: [f64; 3] = values.try_into().ok().filter(|_| complete).ok_or_else(|| ModelError::Number {
        joint: joint.to_owned(),
        attribute: attribute.to_owned(),
        found: excerpt(text),
        expected: "three finite numbers",
    })?;
    for value in values {
        bounded(joint, attribute, Some(value))?;
    }
    Ok(Some(values))
}

fn check_tree(links: &BTreeSet<String>, joints: &BTreeMap<String, RawJoint>) -> Result<(), ModelError> {
    let mut parent_of: BTreeMap<&str, (&str, &str)> = BTreeMap::new();
    for (name, joint) in joints {
        for (end, link) in [("parent", &joint.parent), ("child", &joint.child)] {
            if !links.contains(link) {
                return Err(ModelError::UnknownLink { joint: name.clone(), end, link: link.clone() });
            }
        }
        if let Some((first, _)) = parent_of.insert(&joint.child, (name, &joint.parent)) {
            return Err(ModelError::TwoParents {
                link: joint.child.clone(),
                first: first.to_owned(),
                second: name.clone(),
            });
        }
    }
    for link in links {
        let mut above = link.as_str();
        for _ in 0..=links.len() {
            match parent_of.get(above) {
                Some((_, parent)) => above = parent,
                None => break,
            }
        }
        if parent_of.contains_key(above) {
            return Err(ModelError::Cycle { link: link.clone() });
        }
    }
    let roots: Vec<String> = links.iter().filter(|l| !parent_of.contains_key(l.as_str())).cloned().collect();
    if roots.len() > 1 {
        return Err(ModelError::SeveralRoots { links: roots });
    }
    Ok(())
}

fn check_mimics(joints: &BTreeMap<String, RawJoint>) -> Result<(), ModelError> {
    for name in joints.keys() {
        let mut through: Vec<String> = Vec::new();
        let mut at = name;
        while let Some(source) = joints[at].mimic.as_ref() {
            if !joints.contains_key(source) {
                return Err(ModelError::MimicUnknown { joint: at.clone(), source_joint: source.clone() });
            }
            through.push(source.clone());
            if source == name || through.len() > joints.len() {
                return Err(ModelError::MimicCycle { joint: name.clone(), through });
            }
            at = source;
        }
    }
    Ok(())
}
