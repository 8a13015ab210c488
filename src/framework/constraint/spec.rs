//! Constraints and their handling as users write them (TOML presets, REST).

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// What a candidate must satisfy; `kind` picks one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum ConstraintSpec {
    /// A point of the robot stays strictly inside a region.
    Region(RegionSpec),
    /// Distance from the individuals a candidate was bred from (the paper's velocity limit).
    PopulationVelocity(PopulationVelocitySpec),
    /// Step of each joint from the previous goal's joints: what a robot needs.
    JointStep(JointStepSpec),
}

/// A point of the robot and the region it stays in, or out of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct RegionSpec {
    /// The region, in the chain's base frame.
    pub geometry: GeometrySpec,
    /// On which side of its boundary the point stays.
    #[serde(default, skip_serializing_if = "Side::is_inside")]
    pub side: Side,
    /// Which point it is; the tool centre point when absent.
    #[serde(default)]
    pub point: PointSpec,
}

/// A side of a region's boundary.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// The point stays in the region: a workspace.
    #[default]
    Inside,
    /// The point stays out of it: an obstacle, a person's place.
    Outside,
}

impl Side {
    #[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
    fn is_inside(&self) -> bool {
        *self == Self::Inside
    }
}

/// A convex region in the base frame; its boundary is on neither side.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(tag = "shape", rename_all = "snake_case", deny_unknown_fields)]
pub enum GeometrySpec {
    /// Axis-aligned bounding box, every side moved outwards by the dilatation.
    Box {
        /// Lower corner, m.
        lower_m: [f64; 3],
        /// Upper corner, m.
        upper_m: [f64; 3],
        /// Outward motion of each side, m; may be negative.
        #[serde(default)]
        dilatation_m: f64,
    },
    /// Sphere.
    Sphere {
        /// Centre, m.
        center_m: [f64; 3],
        /// Radius, m (> 0).
        radius_m: f64,
    },
    /// Convex hull of 4 to 128 points, every face moved outwards by the dilatation.
    Hull {
        /// The points, m.
        points_m: Vec<[f64; 3]>,
        /// Outward motion of each face, m; may be negative.
        #[serde(default)]
        dilatation_m: f64,
    },
    /// Intersection of half-spaces.
    Polyhedron {
        /// The half-spaces, at least one.
        half_spaces: Vec<HalfSpace>,
    },
}

/// The points p with normal . p < offset.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct HalfSpace {
    /// Outward direction, any length but 0.
    pub normal: [f64; 3],
    /// normal . p on the boundary, m (times the normal's length).
    pub offset_m: f64,
}

/// The constrained point.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, ToSchema)]
#[serde(tag = "at", rename_all = "snake_case", deny_unknown_fields)]
pub enum PointSpec {
    /// The tool centre point.
    #[default]
    Tool,
    /// A point fixed to a link of the same robot, such as its elbow.
    Link {
        /// Name of the link; it must lie between base and tip.
        link: String,
        /// The point in the link's frame, m.
        #[serde(default)]
        offset_m: [f64; 3],
    },
    /// The tip of a serial chain written out here and driven by the robot's free joints: the published runs judged
    /// their boxes by a chain slightly different from the one they executed.
    Chain {
        /// The joints, base first.
        joints: Vec<ChainJoint>,
        /// The point after the last joint, m.
        tip_m: [f64; 3],
    },
}

/// One revolute joint of a written-out chain.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct ChainJoint {
    /// The free joint of the robot whose angle it takes.
    pub joint: String,
    /// From the previous joint's frame to this one's, m.
    pub offset_m: [f64; 3],
    /// Axis in that frame, any length but 0.
    pub axis: [f64; 3],
}

/// `sum over joints |child - parent| < limit` for at least one of the individuals a candidate was bred from.
///
/// It limits the distance within the population, not the step between goals. Candidates without ancestors (a random
/// initial population) satisfy it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct PopulationVelocitySpec {
    /// V, rad (or m), > 0.
    pub limit_rad: f64,
}

/// `|joint - previous goal's joint| <= limit` for every joint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct JointStepSpec {
    /// Largest step, rad (or m), > 0.
    pub limit_rad: f64,
    /// Joints before the first goal (rad or m); when absent the first goal may lie anywhere.
    #[serde(default)]
    pub start: Option<Vec<f64>>,
}

/// What happens to a candidate that violates a constraint; `strategy` picks one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(tag = "strategy", rename_all = "snake_case", deny_unknown_fields)]
pub enum HandlingSpec {
    /// It is not executed; the optimiser makes another in its place, at most `max_attempts` times.
    Rejecting {
        /// Attempts for one candidate before it counts as failed.
        #[serde(default = "attempts")]
        max_attempts: u32,
    },
    /// It is moved back along the line to the best feasible candidate known (else to a random feasible one) until it
    /// is feasible; the optimiser goes on with the repaired one.
    Repairing {
        /// Random candidates tried where no feasible one is known.
        #[serde(default = "attempts")]
        max_attempts: u32,
    },
    /// The operators are closed: the step from the individual it was bred from is halved until it is feasible, and a
    /// random initial population is drawn from the feasible region.
    Operators {
        /// Random candidates tried where no feasible one is known.
        #[serde(default = "attempts")]
        max_attempts: u32,
    },
    /// Its fitness is made worse.
    Penalty(PenaltySpec),
}

impl HandlingSpec {
    /// Attempts unless another number is given.
    pub const MAX_ATTEMPTS: u32 = 1000;
}

fn attempts() -> u32 {
    HandlingSpec::MAX_ATTEMPTS
}

impl Default for HandlingSpec {
    fn default() -> Self {
        Self::Rejecting { max_attempts: attempts() }
    }
}

/// How much worse, and how that is applied.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct PenaltySpec {
    /// f + p or f (1 + p).
    #[serde(default)]
    pub form: PenaltyForm,
    /// The size p of the penalty.
    pub penalty: PenaltyKind,
}

/// How a penalty p enters a discrepancy f.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum PenaltyForm {
    /// f + p, p = 0 where feasible (paper eq. 7).
    #[default]
    Additive,
    /// f (1 + p), the factor is 1 where feasible (paper eq. 8).
    Multiplicative,
}

/// The size p of a penalty for violations `v_k` (m or rad) in generation t; `kind` picks one. All but `death` execute
/// the candidate: use them in simulation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum PenaltyKind {
    /// The fitness is this value whatever the violation; the candidate is neither executed nor counted.
    Death {
        /// The fitness, features' unit.
        #[serde(default = "death")]
        value: f64,
    },
    /// p = weight sum v^exponent.
    Static {
        /// Penalty of a violation of 1 m or rad.
        weight: f64,
        /// Exponent (> 0).
        #[serde(default = "two")]
        exponent: f64,
    },
    /// p = (weight t)^growth sum v^exponent.
    Dynamic {
        /// C.
        weight: f64,
        /// alpha (> 0).
        #[serde(default = "two")]
        growth: f64,
        /// beta (> 0).
        #[serde(default = "two")]
        exponent: f64,
    },
    /// p = lambda sum v^2; lambda is divided by `relax` after `window` generations with a feasible best and multiplied
    /// by `tighten` after as many with an infeasible one.
    Adaptive {
        /// lambda in the first generation.
        weight: f64,
        /// Generations looked at (at least 1).
        #[serde(default = "three")]
        window: u32,
        /// Divisor (> 1), other than `tighten`, so that lambda cannot cycle.
        #[serde(default = "relax")]
        relax: f64,
        /// Factor (> 1).
        #[serde(default = "tighten")]
        tighten: f64,
    },
    /// p = sum v^2 / (2 tau); tau = temperature cooling^t, not below `frozen`.
    Annealing {
        /// tau in generation 0.
        temperature: f64,
        /// Factor of each generation (0 to 1).
        #[serde(default = "cooling")]
        cooling: f64,
        /// Least tau (> 0).
        #[serde(default = "frozen")]
        frozen: f64,
    },
}

impl PenaltyKind {
    /// Fitness of an infeasible candidate under `death`, features' unit, unless another is given.
    pub const DEATH_VALUE: f64 = 1e12;
    /// Exponent of violations and growth with the generation unless others are given.
    pub const EXPONENT: f64 = 2.0;
    /// Generations an adaptive penalty looks at unless another number is given.
    pub const WINDOW: u32 = 3;
    /// Divisor of an adaptive penalty unless another is given.
    pub const RELAX: f64 = 2.0;
    /// Factor of an adaptive penalty unless another is given.
    pub const TIGHTEN: f64 = 3.0;
    /// Factor of an annealing penalty's temperature unless another is given.
    pub const COOLING: f64 = 0.8;
    /// Least temperature of an annealing penalty unless another is given.
    pub const FROZEN: f64 = 1e-9;
}

fn death() -> f64 {
    PenaltyKind::DEATH_VALUE
}
fn two() -> f64 {
    PenaltyKind::EXPONENT
}
fn three() -> u32 {
    PenaltyKind::WINDOW
}
fn relax() -> f64 {
    PenaltyKind::RELAX
}
fn tighten() -> f64 {
    PenaltyKind::TIGHTEN
}
fn cooling() -> f64 {
    PenaltyKind::COOLING
}
fn frozen() -> f64 {
    PenaltyKind::FROZEN
}

/// What happens to a goal for which no feasible candidate was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum OnInfeasible {
    /// The run ends there and says so: no infeasible pose is ever part of a result.
    #[default]
    Stop,
    /// The least bad candidate is appended and the run goes on, as in the published runs; the run is invalid if that
    /// happens at its last goal. Needs a penalty: the other strategies give infeasible candidates no discrepancy.
    Append,
}
