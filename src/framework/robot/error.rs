//! Why a URDF is not a robot, or a robot not a chain: each error names the joint or link, the value and the remedy.

/// A URDF that cannot be a robot model.
#[derive(Debug, thiserror::Error)]
pub enum ModelError {
    /// Not well-formed XML, a DTD, or too many nodes.
    #[error("the URDF cannot be read: {0}; a URDF is plain XML without DTD")]
    Xml(#[from] roxmltree::Error),
    /// Another document.
    #[error("the root element is <{found}>, not <robot>: give a URDF (xacro must be expanded first)")]
    NotARobot {
        /// Name of the root element.
        found: String,
    },
    /// urdf-rs refused what the tree check let pass.
    #[error("the URDF cannot be read: {0}")]
    Urdf(#[from] urdf_rs::UrdfError),
    /// Too many links.
    #[error("the URDF has {found} links, the limit is {limit}: remove links that carry nothing")]
    TooManyLinks {
        /// Links found.
        found: usize,
        /// Links allowed.
        limit: usize,
    },
    /// No link.
    #[error("the URDF has no <link>")]
    NoLink,
    /// An element without a needed attribute or child.
    #[error("{element} {name:?} has no {missing}")]
    Missing {
        /// `link` or `joint`.
        element: &'static str,
        /// Its name, empty where that is missing.
        name: String,
        /// What is missing.
        missing: &'static str,
    },
    /// A name too long or with characters that are not seen.
    #[error(
        "the name of a {element} that begins with {begin:?} has {length} characters: give 1 to {limit} visible ones"
    )]
    Name {
        /// `link` or `joint`.
        element: &'static str,
        /// Its first characters.
        begin: String,
        /// Characters found.
        length: usize,
        /// Characters allowed.
        limit: usize,
    },
    /// A length, angle or factor beyond any robot.
    #[error("joint {joint:?}: {attribute} holds {value:?}, the limit is {limit} either way: correct it or its unit")]
    TooFar {
        /// The joint.
        joint: String,
        /// The attribute.
        attribute: String,
        /// The value.
        value: f64,
        /// Largest magnitude.
        limit: f64,
    },
    /// A name used twice.
    #[error("two {element}s are named {name:?}: names must be unique")]
    Duplicate {
        /// `link` or `joint`.
        element: &'static str,
        /// The name.
        name: String,
    },
    /// A joint to or from nowhere.
    #[error("joint {joint:?}: its {end} link {link:?} is not in the URDF")]
    UnknownLink {
        /// The joint.
        joint: String,
        /// `parent` or `child`.
        end: &'static str,
        /// The missing link.
        link: String,
    },
    /// A link with two parents.
    #[error("link {link:?} is the child of joints {first:?} and {second:?}: a link has one parent; remove one joint")]
    TwoParents {
        /// The link.
        link: String,
        /// One joint.
        first: String,
        /// The other.
        second: String,
    },
    /// A closed loop.
    #[error("link {link:?} is its own ancestor: the joints above it form a loop; URDF trees have none")]
    Cycle {
        /// A link on the loop.
        link: String,
    },
    /// Several unconnected trees.
    #[error("links {links:?} have no parent: one root is allowed; join them with fixed joints")]
    SeveralRoots {
        /// The roots.
        links: Vec<String>,
    },
    /// An unknown joint type.
    #[error(
        "joint {joint:?} has type {found:?}: use revolute, continuous, prismatic or fixed (floating, planar and spherical are read, but no chain may pass them)"
    )]
    JointType {
        /// The joint.
        joint: String,
        /// The type found.
        found: String,
    },
    /// A number that is none, or not finite.
    #[error("joint {joint:?}: {attribute} is {found:?}, not {expected}")]
    Number {
        /// The joint.
        joint: String,
        /// The attribute.
        attribute: String,
        /// The text found.
        found: String,
        /// What is expected.
        expected: &'static str,
    },
    /// An axis of no length.
    #[error("joint {joint:?}: axis {axis:?} has no direction; give a unit vector such as \"0 0 1\"")]
    ZeroAxis {
        /// The joint.
        joint: String,
        /// The axis.
        axis: [f64; 3],
    },
    /// lower > upper.
    #[error("joint {joint:?}: lower limit {lower} is above upper limit {upper}; swap them")]
    LimitOrder {
        /// The joint.
        joint: String,
        /// Lower limit.
        lower: f64,
        /// Upper limit.
        upper: f64,
    },
    /// A mimic of a joint that is not there.
    #[error("joint {joint:?} mimics {source_joint:?}, which is not in the URDF")]
    MimicUnknown {
        /// The joint.
        joint: String,
        /// The joint it names.
        source_joint: String,
    },
    /// Mimics in a circle.
    #[error("joint {joint:?} mimics itself through {through:?}; one joint of the circle must not mimic")]
    MimicCycle {
        /// The joint.
        joint: String,
        /// The joints on the circle.
        through: Vec<String>,
    },
}

/// A robot description that picks no valid chain out of its model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ChainError {
    /// No such link.
    #[error("{role} {link:?} is not a link of robot {robot:?}; its links are {links:?}")]
    UnknownLink {
        /// `base_link` or `tip_link`.
        role: &'static str,
        /// The name given.
        link: String,
        /// The robot.
        robot: String,
        /// All links.
        links: Vec<String>,
    },
    /// Several leaves and no tip given.
    #[error("robot {robot:?} ends in {} links: choose tip_link among {leaves:?}", leaves.len())]
    AmbiguousTip {
        /// The robot.
        robot: String,
        /// The leaf links.
        leaves: Vec<String>,
    },
    /// The tip does not descend from the base.
    #[error("link {tip:?} does not descend from {base:?}: choose base_link among its ancestors {ancestors:?}")]
    NotAncestor {
        /// Base link.
        base: String,
        /// Tip link.
        tip: String,
        /// Ancestors of the tip.
        ancestors: Vec<String>,
    },
    /// A joint no chain may pass.
    #[error(
        "the chain passes {kind} joint {joint:?}, which has no single position: choose base_link {below:?} or a link below it"
    )]
    Unsupported {
        /// The joint.
        joint: String,
        /// Its kind.
        kind: &'static str,
        /// The link below it.
        below: String,
    },
    /// A name in the description that moves nothing here.
    #[error("{role} names joint {joint:?}, which does not move this chain; movable joints are {movable:?}")]
    UnknownJoint {
        /// `free_joints`, `fixed`, `limits`, `acceleration` or `home`.
        role: &'static str,
        /// The name given.
        joint: String,
        /// Joints that move the chain.
        movable: Vec<String>,
    },
    /// One joint named twice, or both free and fixed.
    #[error("joint {joint:?} is named twice among free_joints and fixed: a joint is either free or fixed, once")]
    NamedTwice {
        /// The joint.
        joint: String,
    },
    /// Nothing left to move.
    #[error("no joint is free between {base:?} and {tip:?}: remove one from fixed or choose another tip_link")]
    NoFreeJoint {
        /// Base link.
        base: String,
        /// Tip link.
        tip: String,
    },
    /// A free joint without a range.
    #[error("free joint {joint:?} has no position limits in the URDF: give limits.{joint} = [lower, upper]")]
    NoLimits {
        /// The joint.
        joint: String,
    },
    /// A number of the description that is not finite or out of range.
    #[error("{role} of joint {joint:?} is {value:?}: {expected}")]
    Value {
        /// The field.
        role: &'static str,
        /// The joint.
        joint: String,
        /// The value given.
        value: f64,
        /// What is expected.
        expected: &'static str,
    },
    /// A fixed value outside the limits.
    #[error("fixed value {value} of joint {joint:?} is outside its limits {lower} to {upper}")]
    FixedOutside {
        /// The joint.
        joint: String,
        /// The value given.
        value: f64,
        /// Lower limit.
        lower: f64,
        /// Upper limit.
        upper: f64,
    },
    /// A home outside the limits, or not a number.
    #[error("home {value} of joint {joint:?} is outside its limits {lower} to {upper}: give a value within them")]
    HomeOutside {
        /// The joint.
        joint: String,
        /// The value given.
        value: f64,
        /// Lower limit.
        lower: f64,
        /// Upper limit.
        upper: f64,
    },
    /// lower > upper.
    #[error(
        "joint {joint:?}: lower limit {lower} is above upper limit {upper} (limits of joints that mimic it included)"
    )]
    LimitOrder {
        /// The joint.
        joint: String,
        /// Lower limit.
        lower: f64,
        /// Upper limit.
        upper: f64,
    },
}
