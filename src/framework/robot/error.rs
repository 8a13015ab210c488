//! Reasons why a URDF is not a robot, or a robot description not a chain. Each error names the joint or link, the value
//! and the remedy.

use crate::range::OutOfRange;

/// The URDF cannot be used as a robot model.
#[derive(Debug, thiserror::Error)]
pub enum ModelError {
    /// Malformed XML, a DTD, or too many nodes.
    #[error("the URDF cannot be read: {0}; a URDF is plain XML without DTD")]
    Xml(#[from] roxmltree::Error),
    /// The document is not a URDF.
    #[error("the root element is <{found}>, not <robot>: give a URDF (xacro must be expanded first)")]
    NotARobot {
        /// Name of the root element.
        found: String,
    },
    /// urdf-rs rejected a URDF that had passed the tree check.
    #[error("the URDF cannot be read: {0}")]
    Urdf(#[from] urdf_rs::UrdfError),
    /// The robot has too many links.
    #[error("the URDF has {found} links, the limit is {limit}: remove links that are not needed")]
    TooManyLinks {
        /// Number of links found.
        found: usize,
        /// Maximum number of links.
        limit: usize,
    },
    /// There are no links.
    #[error("the URDF has no <link>")]
    NoLink,
    /// An element lacks a required attribute or child.
    #[error("{element} {name:?} has no {missing}")]
    Missing {
        /// `link` or `joint`.
        element: &'static str,
        /// Name of the element; empty if it has none.
        name: String,
        /// Missing attribute or child.
        missing: &'static str,
    },
    /// A name is too long or contains invisible characters.
    #[error("the name of a {element} starting with {begin:?} has {length} characters: use 1 to {limit} visible ones")]
    Name {
        /// `link` or `joint`.
        element: &'static str,
        /// Beginning of the name.
        begin: String,
        /// Number of characters found.
        length: usize,
        /// Maximum number of characters.
        limit: usize,
    },
    /// A length, angle or factor is implausibly large.
    #[error("joint {joint:?}: {attribute} contains {value:?}, outside +/-{limit}: correct it or its unit")]
    TooFar {
        /// Name of the joint.
        joint: String,
        /// Name of the attribute.
        attribute: String,
        /// Value found.
        value: f64,
        /// Largest allowed magnitude.
        limit: f64,
    },
    /// Two elements share a name.
    #[error("two {element}s are named {name:?}: names must be unique")]
    Duplicate {
        /// `link` or `joint`.
        element: &'static str,
        /// Shared name.
        name: String,
    },
    /// A joint refers to a link that does not exist.
    #[error("joint {joint:?}: its {end} link {link:?} is not in the URDF")]
    UnknownLink {
        /// Name of the joint.
        joint: String,
        /// `parent` or `child`.
        end: &'static str,
        /// Name of the missing link.
        link: String,
    },
    /// A link has two parents.
    #[error("link {link:?} is the child of joints {first:?} and {second:?}: a link has one parent; remove one joint")]
    TwoParents {
        /// Name of the link.
        link: String,
        /// First joint.
        first: String,
        /// Second joint.
        second: String,
    },
    /// The joints form a closed loop.
    #[error("link {link:?} is its own ancestor: the joints above it form a loop, which a URDF must not have")]
    Cycle {
        /// A link on the loop.
        link: String,
    },
    /// There are several unconnected trees.
    #[error("links {links:?} have no parent, but only one root is allowed: join them with fixed joints")]
    SeveralRoots {
        /// Names of the root links.
        links: Vec<String>,
    },
    /// The joint type is unknown.
    #[error(
        "joint {joint:?} has type {found:?}: use revolute, continuous, prismatic or fixed (floating, planar and spherical joints are readable, but not allowed in a chain)"
    )]
    JointType {
        /// Name of the joint.
        joint: String,
        /// Type found.
        found: String,
    },
    /// An attribute is not a finite number.
    #[error("joint {joint:?}: {attribute} is {found:?}, not {expected}")]
    Number {
        /// Name of the joint.
        joint: String,
        /// Name of the attribute.
        attribute: String,
        /// Text found.
        found: String,
        /// Expected form.
        expected: &'static str,
    },
    /// An axis has length zero.
    #[error("joint {joint:?}: axis {axis:?} has no direction; give a unit vector such as \"0 0 1\"")]
    ZeroAxis {
        /// Name of the joint.
        joint: String,
        /// Axis as given.
        axis: [f64; 3],
    },
    /// The lower limit is above the upper one.
    #[error("joint {joint:?}: lower limit {lower} is above upper limit {upper}; swap them")]
    LimitOrder {
        /// Name of the joint.
        joint: String,
        /// Lower limit, rad or m.
        lower: f64,
        /// Upper limit, rad or m.
        upper: f64,
    },
    /// A joint mimics one that does not exist.
    #[error("joint {joint:?} mimics {source_joint:?}, which is not in the URDF")]
    MimicUnknown {
        /// Name of the joint.
        joint: String,
        /// Name of the missing joint.
        source_joint: String,
    },
    /// Mimicking joints form a cycle.
    #[error("joint {joint:?} mimics itself through {through:?}; at least one joint of the cycle must not mimic")]
    MimicCycle {
        /// Name of the joint.
        joint: String,
        /// Joints of the cycle.
        through: Vec<String>,
    },
}

/// A robot description does not select a valid chain from its model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ChainError {
    /// There is no such link.
    #[error("{role} {link:?} is not a link of robot {robot:?}; its links are {links:?}")]
    UnknownLink {
        /// `base_link` or `tip_link`.
        role: &'static str,
        /// Name given.
        link: String,
        /// Name of the robot.
        robot: String,
        /// Names of all links.
        links: Vec<String>,
    },
    /// The robot has several leaf links and no tip is given.
    #[error("robot {robot:?} has {} end links: choose tip_link from {leaves:?}", leaves.len())]
    AmbiguousTip {
        /// Name of the robot.
        robot: String,
        /// Names of the leaf links.
        leaves: Vec<String>,
    },
    /// The tip does not descend from the base.
    #[error("link {tip:?} does not descend from {base:?}: choose base_link from its ancestors {ancestors:?}")]
    NotAncestor {
        /// Name of the base link.
        base: String,
        /// Name of the tip link.
        tip: String,
        /// Names of the tip's ancestors.
        ancestors: Vec<String>,
    },
    /// A joint on the chain has more than one degree of freedom.
    #[error(
        "the chain contains {kind} joint {joint:?}, whose position is not a single number: choose base_link {below:?} or a link below it"
    )]
    Unsupported {
        /// Name of the joint.
        joint: String,
        /// Kind of the joint.
        kind: &'static str,
        /// Name of the link below it.
        below: String,
    },
    /// A joint named in the description does not move this chain.
    #[error("{role} names joint {joint:?}, which does not move this chain; movable joints are {movable:?}")]
    UnknownJoint {
        /// `free_joints`, `fixed`, `limits`, `acceleration`, `jerk` or `home`.
        role: &'static str,
        /// Name given.
        joint: String,
        /// Names of the joints that move the chain.
        movable: Vec<String>,
    },
    /// A joint is named twice, or as both free and fixed.
    #[error("joint {joint:?} is named twice among free_joints and fixed: a joint is either free or fixed, once")]
    NamedTwice {
        /// Name of the joint.
        joint: String,
    },
    /// No joint of the chain is free.
    #[error("there is no free joint between {base:?} and {tip:?}: remove one from fixed or choose another tip_link")]
    NoFreeJoint {
        /// Name of the base link.
        base: String,
        /// Name of the tip link.
        tip: String,
    },
    /// A free joint has no position limits.
    #[error("free joint {joint:?} has no position limits in the URDF: give limits.{joint} = [lower, upper]")]
    NoLimits {
        /// Name of the joint.
        joint: String,
    },
    /// A number of the description is not finite or out of range.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// A number of the description of one joint is not finite or out of range.
    #[error("joint {joint:?}: {number}")]
    Joint {
        /// Name of the joint.
        joint: String,
        /// The field of the description, its value and its range.
        number: OutOfRange,
    },
    /// A fixed value is outside the joint's limits.
    #[error("fixed value {value} of joint {joint:?} is outside its limits {lower} to {upper}")]
    FixedOutside {
        /// Name of the joint.
        joint: String,
        /// Value given, rad or m (rad/s^2 or m/s^2 for an acceleration).
        value: f64,
        /// Lower limit, rad or m.
        lower: f64,
        /// Upper limit, rad or m.
        upper: f64,
    },
    /// A home value is not a number or outside the joint's limits.
    #[error("home {value} of joint {joint:?} is outside its limits {lower} to {upper}: give a value within them")]
    HomeOutside {
        /// Name of the joint.
        joint: String,
        /// Value given, rad or m (rad/s^2 or m/s^2 for an acceleration).
        value: f64,
        /// Lower limit, rad or m.
        lower: f64,
        /// Upper limit, rad or m.
        upper: f64,
    },
    /// The lower limit is above the upper one.
    #[error(
        "joint {joint:?}: lower limit {lower} is above upper limit {upper} (limits of joints that mimic it included)"
    )]
    LimitOrder {
        /// Name of the joint.
        joint: String,
        /// Lower limit, rad or m.
        lower: f64,
        /// Upper limit, rad or m.
        upper: f64,
    },
}
