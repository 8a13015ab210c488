//! Constraints and their handling as written by users (TOML presets, REST).

use super::collision_free::CollisionFreeSpec;
use crate::tagged;
use serde::{Deserialize, Serialize};

tagged! {
    /// A condition on candidates; `kind` selects the variant.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    #[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
    #[serde(tag = "kind", rename_all = "snake_case")]
    pub enum ConstraintSpec {
        /// A point of the robot stays strictly inside or outside a region.
        Region(RegionSpec),
        /// Limits the distance from the individuals a candidate was bred from (the paper's velocity limit).
        PopulationVelocity(PopulationVelocitySpec),
        /// Limits the step of each joint from the previous goal's joints; this is what a real robot needs.
        JointStep(JointStepSpec),
        /// No contact of the robot with itself, with obstacles or with the worked surface; such a pose is never executed.
        CollisionFree(CollisionFreeSpec),
    }
}

/// A point of the robot and the region it stays inside or outside of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct RegionSpec {
    /// The region, in the chain's base frame.
    pub geometry: GeometrySpec,
    /// Side of the boundary on which the point stays.
    #[serde(default, skip_serializing_if = "Side::is_inside")]
    pub side: Side,
    /// The constrained point; the tool centre point if absent.
    #[serde(default = "tool")]
    pub point: PointSpec,
}

fn tool() -> PointSpec {
    PointSpec::Tool
}

/// A side of a region's boundary.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// The point stays inside the region, for example a workspace.
    #[default]
    Inside,
    /// The point stays outside the region, for example an obstacle or a person's space.
    Outside,
}

impl Side {
    #[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
    fn is_inside(&self) -> bool {
        *self == Self::Inside
    }
}

tagged! {
    /// A convex region in the base frame; its boundary belongs to neither side.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    #[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
    #[serde(tag = "shape", rename_all = "snake_case", deny_unknown_fields)]
    pub enum GeometrySpec {
        /// Axis-aligned box, each side moved outwards by the dilatation.
        Box {
            /// Lower corner, m.
            lower_m: [f64; 3],
            /// Upper corner, m.
            upper_m: [f64; 3],
            /// Distance by which each side moves outwards, m; may be negative.
            #[serde(default)]
            dilatation_m: f64,
        },
        /// Sphere around a centre.
        Sphere {
            /// Centre, m.
            center_m: [f64; 3],
            /// Radius, m (> 0).
            radius_m: f64,
        },
        /// Convex hull of 4 to 128 points, each face moved outwards by the dilatation.
        Hull {
            /// Points, base frame, m.
            points_m: Vec<[f64; 3]>,
            /// Distance by which each face moves outwards, m; may be negative.
            #[serde(default)]
            dilatation_m: f64,
        },
        /// Intersection of half-spaces.
        Polyhedron {
            /// One or more half-spaces.
            half_spaces: Vec<HalfSpace>,
        },
    }
}

/// The points p with normal . p < offset.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct HalfSpace {
    /// Outward normal, any non-zero length.
    pub normal: [f64; 3],
    /// Value of normal . p on the boundary, m (times the normal's length).
    pub offset_m: f64,
}

tagged! {
    /// The constrained point.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    #[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
    #[serde(tag = "at", rename_all = "snake_case", deny_unknown_fields)]
    pub enum PointSpec {
        /// The tool centre point.
        Tool,
        /// A point fixed to a link of the same robot, for example its elbow.
        Link {
            /// Name of the link; it must lie between base and tip.
            link: String,
            /// Position in the link's frame, m.
            #[serde(default)]
            offset_m: [f64; 3],
        },
        /// The tip of a serial chain given explicitly and driven by the robot's free joints: the published runs checked
        /// their boxes on a chain slightly different from the executed one.
        Chain {
            /// Joints of the chain, base first.
            joints: Vec<ChainJoint>,
            /// Position of the point after the last joint, m.
            tip_m: [f64; 3],
        },
    }
}

/// One revolute joint of an explicit chain.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct ChainJoint {
    /// Free joint of the robot whose angle it follows.
    pub joint: String,
    /// Translation from the previous joint's frame to this one's, m.
    pub offset_m: [f64; 3],
    /// Axis in that frame, any non-zero length.
    pub axis: [f64; 3],
}

/// `sum over joints |child - parent| < limit` for at least one of the individuals a candidate was bred from.
///
/// This limits the distance within the population, not the step between goals. Candidates without ancestors (a random
/// initial population) satisfy it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct PopulationVelocitySpec {
    /// Limit V, rad (or m), > 0.
    pub limit_rad: f64,
}

/// `|joint - previous goal's joint| <= limit` for every joint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct JointStepSpec {
    /// Largest step, rad (or m), > 0.
    pub limit_rad: f64,
    /// Joints before the first goal (rad or m); if absent, the first goal is not limited.
    #[serde(default)]
    pub start: Option<Vec<f64>>,
}

tagged! {
    /// Treatment of a candidate that violates a constraint; `strategy` selects the variant.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    #[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
    #[serde(tag = "strategy", rename_all = "snake_case", deny_unknown_fields)]
    pub enum HandlingSpec {
        /// The candidate is discarded and the optimiser proposes another, at most `max_attempts` times.
        Rejecting {
            /// Number of attempts before a candidate counts as failed.
            #[serde(default = "attempts")]
            max_attempts: u32,
        },
        /// The candidate is moved along the line towards the best known feasible one (or else a random one) until it is
        /// feasible; the optimiser continues with the repaired candidate.
        Repairing {
            /// Number of random candidates tried if no feasible one is known.
            #[serde(default = "attempts")]
            max_attempts: u32,
        },
        /// The variation operators stay feasible: the step from the parent is halved until the child is feasible, and a
        /// random initial population is drawn from the feasible region.
        Operators {
            /// Number of random candidates tried if no feasible one is known.
            #[serde(default = "attempts")]
            max_attempts: u32,
        },
        /// The candidate's fitness is made worse.
        Penalty(PenaltySpec),
    }
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

/// Size of a penalty and how it is applied.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct PenaltySpec {
    /// Formula: f + p or f (1 + p).
    #[serde(default)]
    pub form: PenaltyForm,
    /// Size p of the penalty.
    pub penalty: PenaltyKind,
}

/// How a penalty p changes a discrepancy f.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum PenaltyForm {
    /// f + p with p = 0 if feasible (paper eq. 7).
    #[default]
    Additive,
    /// f (1 + p), whose factor is 1 if feasible (paper eq. 8).
    Multiplicative,
}

tagged! {
    /// Size p of a penalty for violations `v_k` (m or rad) in generation t; `kind` selects the variant. All except `death`
    /// execute the candidate, so use them in simulation.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    #[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
    #[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
    pub enum PenaltyKind {
        /// A fixed fitness regardless of the violation; the candidate is neither executed nor counted.
        Death {
            /// Fitness of an infeasible candidate, features' unit.
            #[serde(default = "death")]
            value: f64,
        },
        /// p = weight sum v^exponent.
        Static {
            /// Penalty per violation of 1 m or rad.
            weight: f64,
            /// Exponent (> 0).
            #[serde(default = "two")]
            exponent: f64,
        },
        /// p = (weight t)^growth sum v^exponent.
        Dynamic {
            /// Coefficient C.
            weight: f64,
            /// Exponent alpha (> 0).
            #[serde(default = "two")]
            growth: f64,
            /// Exponent beta (> 0).
            #[serde(default = "two")]
            exponent: f64,
        },
        /// p = lambda sum v^2; lambda is divided by `relax` after `window` generations with a feasible best, and multiplied
        /// by `tighten` after as many with an infeasible one.
        Adaptive {
            /// Initial lambda.
            weight: f64,
            /// Number of generations considered (at least 1).
            #[serde(default = "three")]
            window: u32,
            /// Divisor (> 1); must differ from `tighten`, so that lambda cannot cycle.
            #[serde(default = "relax")]
            relax: f64,
            /// Factor (> 1).
            #[serde(default = "tighten")]
            tighten: f64,
        },
        /// p = sum v^2 / (2 tau) with tau = temperature cooling^t, but at least `frozen`.
        Annealing {
            /// Initial tau.
            temperature: f64,
            /// Factor per generation (0 to 1).
            #[serde(default = "cooling")]
            cooling: f64,
            /// Smallest tau (> 0).
            #[serde(default = "frozen")]
            frozen: f64,
        },
    }
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

/// Treatment of a goal for which no feasible candidate was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum OnInfeasible {
    /// The run ends and reports it: no infeasible pose is ever part of a result.
    #[default]
    Stop,
    /// The least bad candidate is appended and the run continues, as in the published runs; the run is invalid if this
    /// happens at its last goal. Requires a penalty, because the other strategies give infeasible candidates no
    /// discrepancy.
    Append,
}
