//! The collision model of a chain: built once, asked for many poses.

use super::error::CollisionError;
use super::links::{self, ShapeNote};
use super::obstacle::Obstacle;
use super::options::{CollisionOptions, HomeContacts};
use super::pairs::{self, ExcludedPair, Exclusion, Owners, Pair, TOOL};
use super::solid::{Solid, Surround, distance, pose, separation, signed_distance};
use crate::random::RandomStream;
use crate::robot::{Chain, RobotModel, moving_frames};
use nalgebra::{Isometry3, Vector3};
use parry3d_f64::math::Pose;
use std::collections::BTreeSet;

/// Number of random poses that tell shapes that overlap by design from those that meet at home only.
const POSES: u32 = 200;

/// Solids of a robot and of its surroundings, and the pairs that are checked.
#[derive(Debug, Clone)]
pub struct CollisionModel {
    pub(super) chain: Chain,
    pub(super) solids: Vec<Solid>,
    pub(super) pairs: Vec<Pair>,
    pub(super) margin_m: f64,
    pub(super) step_m: f64,
    names: Vec<String>,
    excluded: Vec<ExcludedPair>,
    notes: Vec<ShapeNote>,
}

/// Scratch space of one thread for one collision model.
#[derive(Debug, Clone)]
pub struct Workspace {
    frames: Vec<Isometry3<f64>>,
    /// Pose of each solid in the base frame.
    pub(super) poses: Vec<Pose>,
    /// Per pair: bound of its relative motion over a whole joint motion, m; empty before the first motion.
    pub(super) travel_m: Vec<f64>,
    /// Joint positions of the current check.
    pub(super) joints: Vec<f64>,
}

/// The closest pair at a pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clearance<'m> {
    /// Distance, m; 0 if the two overlap.
    pub distance_m: f64,
    /// Names of the two links, or of a link and an obstacle.
    pub pair: [&'m str; 2],
}

impl CollisionModel {
    /// Builds the model of `chain`, which is a chain of `model`, among `obstacles` at rest in the chain's base frame.
    ///
    /// # Errors
    /// [`CollisionError`] with the link, obstacle or option and a remedy.
    pub fn new(
        model: &RobotModel,
        chain: &Chain,
        obstacles: &[Obstacle],
        options: &CollisionOptions,
    ) -> Result<Self, CollisionError> {
        options.check()?;
        let names = names(model, obstacles)?;
        let placements = chain.placements(model);
        let (mut solids, notes) = links::solids(model, &placements, options)?;
        let adjacent = pairs::adjacent(model, chain, &solids);
        let given = pairs::given(&options.excluded, &names)?;
        let tool = model.links().len();
        let tip = model.link_index(chain.tip_link()).map(|tip| placements[tip].x_f.translation.vector);
        solids.push(tool_solid(chain, tool, tip, options.tool_radius_m));
        for (index, obstacle) in obstacles.iter().enumerate() {
            solids.push(obstacle.solid(tool + 1 + index)?);
        }
        let mut built = Self {
            chain: chain.clone(),
            pairs: pairs::moving(&solids, &[&adjacent, &given]),
            solids,
            margin_m: options.margin_m,
            step_m: options.step_m,
            names,
            excluded: Vec::new(),
            notes,
        };
        let touching = match options.home_contacts {
            HomeContacts::Exclude => built.touching_at_home(tool),
            HomeContacts::Check => Owners::new(),
        };
        built.excluded = built.report(&[
            (Exclusion::Given, &given),
            (Exclusion::Adjacent, &adjacent),
            (Exclusion::ContactAtHome, &touching),
        ]);
        built.pairs = pairs::moving(&built.solids, &[&adjacent, &given, &touching]);
        Ok(built)
    }

    /// Pairs of links, or of a link and the tool, whose shapes overlap by design: in contact at home and at no less than
    /// half of [`POSES`] random poses. A home pose in which the robot folds into itself thus excludes nothing.
    fn touching_at_home(&self, tool: usize) -> Owners {
        let mut workspace = self.workspace();
        self.place(self.chain.home(), &mut workspace);
        let mut contacts: Vec<(Pair, u32)> = self.pairs.iter().map(|&pair| (pair, 0)).collect();
        contacts.retain(|(pair, _)| self.owners(*pair)[1] <= tool && self.touches(*pair, &workspace));
        if contacts.is_empty() {
            return Owners::new();
        }
        let mut random = RandomStream::new(0, 0);
        for _ in 0..POSES {
            let pose: Vec<f64> = self.chain.genes().iter().map(|g| random.between(g.lower, g.upper)).collect();
            self.place(&pose, &mut workspace);
            for (pair, count) in &mut contacts {
                *count += u32::from(self.touches(*pair, &workspace));
            }
        }
        contacts.into_iter().filter(|(_, count)| 2 * count >= POSES).map(|(pair, _)| self.owners(pair)).collect()
    }

    fn touches(&self, pair: Pair, workspace: &Workspace) -> bool {
        self.separation(pair, workspace) <= self.margin_m && self.distance(pair, workspace) <= self.margin_m
    }

    /// Excluded pairs that would otherwise be checked, each with its first reason.
    fn report(&self, reasons: &[(Exclusion, &Owners)]) -> Vec<ExcludedPair> {
        let all = pairs::moving(&self.solids, &[]);
        let owners: BTreeSet<[usize; 2]> = all.into_iter().map(|pair| self.owners(pair)).collect();
        let excluded = owners.into_iter().filter_map(|pair| {
            let (reason, _) = reasons.iter().find(|(_, set)| set.contains(&pair))?;
            Some(ExcludedPair { names: pair.map(|owner| self.names[owner].clone()), reason: *reason })
        });
        excluded.collect()
    }

    fn owners(&self, pair: Pair) -> [usize; 2] {
        pairs::ordered(self.solids[pair.first].owner, self.solids[pair.second].owner)
    }

    /// Allocates scratch space.
    #[must_use]
    pub fn workspace(&self) -> Workspace {
        Workspace {
            frames: vec![Isometry3::identity(); self.chain.frames()],
            poses: self.solids.iter().map(|solid| solid.local).collect(),
            travel_m: Vec::new(),
            joints: vec![0.0; self.chain.len()],
        }
    }

    /// The chain that moves.
    #[must_use]
    pub fn chain(&self) -> &Chain {
        &self.chain
    }

    /// Pairs that are not checked although they move, with the reason.
    #[must_use]
    pub fn excluded(&self) -> &[ExcludedPair] {
        &self.excluded
    }

    /// Assumptions about the shapes of links.
    #[must_use]
    pub fn notes(&self) -> &[ShapeNote] {
        &self.notes
    }

    /// Number of pairs of shapes that are checked.
    #[must_use]
    pub fn pair_count(&self) -> usize {
        self.pairs.len()
    }

    /// The closest pair at `joints` (n values in gene order, rad or m); `None` if no pair is checked.
    ///
    /// # Panics
    /// If `joints` is shorter than the chain or not finite, or `workspace` belongs to another model.
    pub fn check(&self, joints: &[f64], workspace: &mut Workspace) -> Option<Clearance<'_>> {
        self.place(joints, workspace);
        let mut closest: Option<(f64, Pair)> = None;
        for &pair in &self.pairs {
            let least = closest.map_or(f64::INFINITY, |(least, _)| least);
            if self.separation(pair, workspace) >= least {
                continue;
            }
            let found = self.distance(pair, workspace);
            if found < least {
                closest = Some((found, pair));
            }
        }
        closest.map(|(distance_m, pair)| Clearance { distance_m, pair: self.pair_names(pair) })
    }

    /// Whether any pair is within the margin at `joints`; stops at the first.
    ///
    /// # Panics
    /// As [`check`](Self::check).
    pub fn collides(&self, joints: &[f64], workspace: &mut Workspace) -> bool {
        self.place(joints, workspace);
        self.pairs.iter().any(|&pair| self.touches(pair, workspace))
    }

    /// Clearance, m, that the worst pair lacks at `joints`: the margin minus its distance, where the distance of two
    /// shapes that overlap is minus the depth of the penetration. Above 0 exactly if the pose [`collides`](Self::collides).
    ///
    /// # Panics
    /// As [`check`](Self::check).
    pub fn lack_m(&self, joints: &[f64], workspace: &mut Workspace) -> f64 {
        self.place(joints, workspace);
        let pairs = self.pairs.iter().filter(|pair| self.touches(**pair, workspace));
        let lack = pairs.map(|&Pair { first, second }| {
            let poses = [&workspace.poses[first], &workspace.poses[second]];
            self.margin_m - signed_distance([&self.solids[first], &self.solids[second]], poses)
        });
        lack.map(|lack| lack.max(f64::MIN_POSITIVE)).fold(0.0, f64::max)
    }

    /// Distance that every pair keeps, m.
    #[must_use]
    pub fn margin_m(&self) -> f64 {
        self.margin_m
    }

    /// Places every moving solid for `joints`.
    pub(super) fn place(&self, joints: &[f64], workspace: &mut Workspace) {
        assert!(joints.iter().all(|q| q.is_finite()), "joint positions are finite");
        moving_frames(&self.chain, joints, &mut workspace.frames);
        for (solid, x) in self.solids.iter().zip(&mut workspace.poses) {
            if solid.frame > 0 {
                *x = pose(&workspace.frames[solid.frame]) * solid.local;
            }
        }
    }

    pub(super) fn separation(&self, pair: Pair, workspace: &Workspace) -> f64 {
        let Pair { first, second } = pair;
        separation([&self.solids[first], &self.solids[second]], [&workspace.poses[first], &workspace.poses[second]])
    }

    pub(super) fn distance(&self, pair: Pair, workspace: &Workspace) -> f64 {
        let Pair { first, second } = pair;
        distance([&self.solids[first], &self.solids[second]], [&workspace.poses[first], &workspace.poses[second]])
    }

    pub(super) fn pair_names(&self, pair: Pair) -> [&str; 2] {
        self.owners(pair).map(|owner| self.names[owner].as_str())
    }
}

/// Names of the links, the tool and the obstacles.
fn names(model: &RobotModel, obstacles: &[Obstacle]) -> Result<Vec<String>, CollisionError> {
    let mut names = model.links().to_vec();
    names.push(TOOL.to_owned());
    for obstacle in obstacles {
        if names.contains(&obstacle.name) {
            return Err(CollisionError::DuplicateName { name: obstacle.name.clone() });
        }
        names.push(obstacle.name.clone());
    }
    Ok(names)
}

/// Capsule from the tip link's origin to the tool centre point.
fn tool_solid(chain: &Chain, owner: usize, tip: Option<Vector3<f64>>, radius_m: f64) -> Solid {
    let place = chain.tool_placement();
    let tool = place.x_f.translation.vector;
    let around = Surround { owner, frame: place.frame, x_f: Isometry3::identity() };
    Solid::capsule(around, [tip.unwrap_or(tool), tool], radius_m)
}
