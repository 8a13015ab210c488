//! All constraints of a job: how far a candidate is from satisfying each of them.
//!
//! A violation is 0 if satisfied, otherwise positive: metres on the wrong side of a region's boundary, radians (or
//! metres) above a step limit, metres of missing clearance. A candidate is feasible exactly if every violation is 0.

use super::error::ConstraintError;
use super::geometry::{LEAST_VIOLATION, Region, finite, positive};
use super::point::Point;
use super::spec::{ConstraintSpec, Side};
use crate::collision::CollisionModel;
use crate::robot::{Chain, RobotModel, RobotSpec};
use crate::world::WorldSpec;

/// A candidate with everything its constraints refer to; joints in gene order, rad or m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Proposal<'a> {
    /// The candidate.
    pub joints: &'a [f64],
    /// The individuals it was bred from: none for a random one.
    pub origins: [Option<&'a [f64]>; 2],
    /// The joints appended for the previous goal, if any.
    pub previous: Option<&'a [f64]>,
}

#[derive(Debug, Clone)]
enum Constraint {
    Region { region: Region, side: Side, point: Box<Point> },
    PopulationVelocity { limit: f64 },
    JointStep { limit: f64, start: Option<Vec<f64>> },
    CollisionFree(Box<CollisionModel>),
}

/// The constraints of a job, ready to be measured. Collisions are by far the most expensive to measure and are looked
/// at last.
#[derive(Debug, Clone)]
pub struct Constraints(Vec<Constraint>);

impl Constraints {
    /// Prepares `specs` for a robot in `world`: `chain` is the one `robot` picks out of `model`.
    ///
    /// # Errors
    /// [`ConstraintError`] with the numbers and what would do.
    pub fn new(
        specs: &[ConstraintSpec],
        model: &RobotModel,
        robot: &RobotSpec,
        chain: &Chain,
        world: &WorldSpec,
    ) -> Result<Self, ConstraintError> {
        let is_collision_free = |spec: &&ConstraintSpec| matches!(spec, ConstraintSpec::CollisionFree(_));
        if specs.iter().filter(is_collision_free).count() > 1 {
            return Err(ConstraintError::SecondCollisionFree);
        }
        let prepare = |spec: &ConstraintSpec| match spec {
            ConstraintSpec::Region(spec) => Ok(Constraint::Region {
                region: Region::new(&spec.geometry)?,
                side: spec.side,
                point: Box::new(Point::new(&spec.point, model, robot, chain)?),
            }),
            ConstraintSpec::PopulationVelocity(spec) => {
                positive("limit_rad", spec.limit_rad)?;
                Ok(Constraint::PopulationVelocity { limit: spec.limit_rad })
            }
            ConstraintSpec::JointStep(spec) => {
                positive("limit_rad", spec.limit_rad)?;
                if let Some(start) = &spec.start {
                    finite("start", start)?;
                    if start.len() != chain.len() {
                        let (found, expected) = (start.len(), chain.len());
                        return Err(ConstraintError::PoseLength { field: "start", found, expected });
                    }
                }
                Ok(Constraint::JointStep { limit: spec.limit_rad, start: spec.start.clone() })
            }
            ConstraintSpec::CollisionFree(spec) => {
                Ok(Constraint::CollisionFree(Box::new(spec.model(model, chain, world)?)))
            }
        };
        specs.iter().map(prepare).collect::<Result<_, _>>().map(Self)
    }

    /// Whether nothing is constrained.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether regions and collisions allow a pose (n joints, rad or m), regardless of the previous pose.
    #[must_use]
    pub fn allows(&self, joints: &[f64]) -> bool {
        let proposal = Proposal { joints, origins: [None; 2], previous: None };
        let regions = self.0.iter().filter(|constraint| matches!(constraint, Constraint::Region { .. }));
        regions.map(|region| region.violation(&proposal)).all(|violation| violation == 0.0) && !self.forbids(joints)
    }

    /// Whether a hard constraint forbids a pose (n joints, rad or m): it must not be executed under any handling.
    #[must_use]
    pub fn forbids(&self, joints: &[f64]) -> bool {
        self.collisions().is_some_and(|model| model.collides(joints, &mut model.workspace()))
    }

    /// The collision model; `None` if collisions are not checked.
    #[must_use]
    pub fn collisions(&self) -> Option<&CollisionModel> {
        self.0.iter().find_map(|constraint| match constraint {
            Constraint::CollisionFree(model) => Some(model.as_ref()),
            _ => None,
        })
    }

    /// The smallest limit on the step between goals (rad or m), with the start of the first step if it is given.
    #[must_use]
    pub fn joint_step(&self) -> Option<(f64, Option<&[f64]>)> {
        let steps = self.0.iter().filter_map(|constraint| match constraint {
            Constraint::JointStep { limit, start } => Some((*limit, start.as_deref())),
            _ => None,
        });
        steps.reduce(|a, b| (a.0.min(b.0), a.1.or(b.1)))
    }

    /// Whether a constraint refers to the individuals a candidate was bred from.
    #[must_use]
    pub fn needs_a_population(&self) -> bool {
        self.0.iter().any(|constraint| matches!(constraint, Constraint::PopulationVelocity { .. }))
    }

    /// Violations of `proposal`, one per constraint in the given order; 0 if satisfied.
    pub fn violations(&self, proposal: &Proposal<'_>) -> impl Iterator<Item = f64> {
        self.0.iter().map(|constraint| constraint.violation(proposal))
    }

    /// Whether every constraint is satisfied.
    #[must_use]
    pub fn is_feasible(&self, proposal: &Proposal<'_>) -> bool {
        let cheap = self.0.iter().filter(|constraint| !matches!(constraint, Constraint::CollisionFree(_)));
        cheap.map(|constraint| constraint.violation(proposal)).all(|violation| violation == 0.0)
            && !self.forbids(proposal.joints)
    }
}

impl Constraint {
    fn violation(&self, proposal: &Proposal<'_>) -> f64 {
        match self {
            Self::Region { region, side, point } => region.violation(*side, &point.position(proposal.joints)),
            Self::PopulationVelocity { limit } => {
                let distance = |origin: &[f64]| proposal.joints.iter().zip(origin).map(|(c, o)| (c - o).abs()).sum();
                let nearest = proposal.origins.iter().flatten().map(|o| distance(o)).reduce(f64::min);
                match nearest {
                    Some(distance) if distance >= *limit => (distance - limit).max(LEAST_VIOLATION),
                    _ => 0.0,
                }
            }
            Self::JointStep { limit, start } => {
                let Some(from) = proposal.previous.or(start.as_deref()) else { return 0.0 };
                let step = proposal.joints.iter().zip(from).map(|(c, o)| (c - o).abs()).fold(0.0, f64::max);
                (step - limit).max(0.0)
            }
            Self::CollisionFree(model) => model.lack_m(proposal.joints, &mut model.workspace()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixtures;
    use super::super::spec::{GeometrySpec, JointStepSpec, PointSpec, PopulationVelocitySpec, RegionSpec};
    use super::*;

    fn set(specs: &[ConstraintSpec]) -> Constraints {
        let arm = fixtures::arm();
        Constraints::new(specs, &arm.model, &arm.robot, &arm.chain, &fixtures::world()).unwrap()
    }

    fn alone(joints: &[f64]) -> Proposal<'_> {
        Proposal { joints, origins: [None; 2], previous: None }
    }

    #[test]
    fn velocity_asks_for_one_near_ancestor() {
        let velocity = set(&[ConstraintSpec::PopulationVelocity(PopulationVelocitySpec { limit_rad: 0.5 })]);
        let (near, far) = ([0.1, 0.2, 0.1], [1.0, 1.0, 1.0]);
        let bred = |a, b| Proposal { joints: &[0.0; 3], origins: [a, b], previous: None };
        assert!(velocity.is_feasible(&bred(Some(&near[..]), Some(&far[..]))));
        assert!(velocity.is_feasible(&bred(Some(&far[..]), Some(&near[..]))));
        assert!(velocity.is_feasible(&bred(None, None)), "a random initial population has no ancestors");
        let violation: f64 = velocity.violations(&bred(Some(&far[..]), None)).sum();
        assert!((violation - 2.5).abs() < 1e-12, "{violation}");
        assert!(!velocity.is_feasible(&bred(Some(&[0.5, 0.0, 0.0]), None)), "the limit itself is too far");
    }

    #[test]
    fn a_step_is_counted_from_the_previous_goal_else_from_the_start() {
        let spec = JointStepSpec { limit_rad: 0.25, start: Some(vec![1.0; 3]) };
        let step = set(&[ConstraintSpec::JointStep(spec)]);
        let near = [1.25, 1.0, 0.75];
        assert!(step.is_feasible(&alone(&near)));
        let from_origin = Proposal { previous: Some(&[0.5, 1.0, 1.0]), ..alone(&near) };
        assert!((step.violations(&from_origin).sum::<f64>() - 0.5).abs() < 1e-12);
        let free = set(&[ConstraintSpec::JointStep(JointStepSpec { limit_rad: 0.25, start: None })]);
        assert!(free.is_feasible(&alone(&[9.0; 3])), "the first goal is free without a start");
    }

    #[test]
    fn violations_come_in_order() {
        let geometry = GeometrySpec::Sphere { center_m: [0.0, -0.338, 0.7982], radius_m: 0.5 };
        let region =
            ConstraintSpec::Region(RegionSpec { geometry, side: Side::Inside, point: fixtures::constraint_point() });
        let velocity = ConstraintSpec::PopulationVelocity(PopulationVelocitySpec { limit_rad: 1.0 });
        let both = set(&[region, velocity]);
        let found: Vec<f64> = both.violations(&alone(&[0.0; 3])).collect();
        assert!((found[0] - 0.29821).abs() < 1e-9, "{found:?}");
        assert_eq!(found[1].to_bits(), 0.0_f64.to_bits());
        assert!(!both.is_feasible(&alone(&[0.0; 3])));
    }

    #[test]
    fn limits_must_be_numbers_of_this_robot() {
        let arm = fixtures::arm();
        let refuse = |spec| {
            Constraints::new(&[spec], &arm.model, &arm.robot, &arm.chain, &fixtures::world()).unwrap_err().to_string()
        };
        let message = refuse(ConstraintSpec::PopulationVelocity(PopulationVelocitySpec { limit_rad: -1.0 }));
        assert!(message.contains("-1"), "{message}");
        let message = refuse(ConstraintSpec::JointStep(JointStepSpec { limit_rad: 1.0, start: Some(vec![0.0; 2]) }));
        assert!(message.contains('2') && message.contains('3'), "{message}");
        let geometry = GeometrySpec::Sphere { center_m: [0.0; 3], radius_m: f64::INFINITY };
        let message =
            refuse(ConstraintSpec::Region(RegionSpec { geometry, side: Side::Inside, point: PointSpec::Tool }));
        assert!(message.contains("radius_m"), "{message}");
    }
}
