//! The seed-dependent parts of a problem: the robot's start pose and its earlier trials.

use crate::framework::constraint::Constraints;
use crate::framework::execution::{Iet, Problem, simulate};
use crate::framework::method::whole_run::{Space, Trial};
use crate::framework::preset::Preset;
use crate::framework::random::RandomStream;
use crate::framework::robot::{Chain, RobotModel, RobotSpec};
use anyhow::{Context as _, bail};

/// Maximum number of start poses drawn until one is free of collisions.
const MAX_DRAWS: u32 = 10_000;

/// A problem to run with many seeds.
pub(super) struct Seeded {
    pub named: Preset,
    /// Action executed before each run on the same robot; its trials are the run's initial knowledge.
    pub after: Option<Preset>,
    /// Whether the robot starts in a pose drawn from the seed.
    pub random_start: bool,
}

impl Seeded {
    /// Checks that the two actions fit together: same robot, same world, a method that learns from trials.
    pub(super) fn new(named: Preset, after: Option<Preset>, random_start: bool) -> anyhow::Result<Self> {
        if let Some(before) = &after {
            if !named.problem.execution.method.profile().learns_from_earlier_runs {
                bail!("--after needs --method model: no other method learns from trials of an earlier action");
            }
            if !is_same_robot(&named.problem, &before.problem) {
                bail!("--after {}: its robot or world differs from {}'s", before.name, named.name);
            }
        }
        Ok(Self { named, after, random_start })
    }

    /// The problem for one seed.
    pub(super) fn problem(&self, seed: u64) -> anyhow::Result<Problem> {
        let mut problem = self.named.problem.clone();
        if self.random_start {
            problem.robot = started_anywhere(&problem, seed)?;
        }
        if let Some(before) = &self.after {
            problem.earlier = self.trials_of(before, seed).with_context(|| format!("--after {}", before.name))?;
        }
        Ok(problem)
    }

    /// Executes `before` on the robot of `seed` and returns its trials.
    fn trials_of(&self, before: &Preset, seed: u64) -> anyhow::Result<Vec<Trial>> {
        let mut problem = before.problem.clone();
        if self.random_start {
            problem.robot = started_anywhere(&problem, seed)?;
        }
        let mut iet = Iet::new(&problem, seed)?;
        let mut world = iet.world()?;
        simulate(&mut iet, world.as_mut(), u64::MAX)?;
        Ok(iet.log().to_vec())
    }
}

/// Whether both problems move the same joints of the same robot in the same world; limits and start may differ.
fn is_same_robot(one: &Problem, other: &Problem) -> bool {
    let there = RobotSpec {
        limits: one.robot.limits.clone(),
        home: one.robot.home.clone(),
        acceleration: one.robot.acceleration.clone(),
        jerk: one.robot.jerk.clone(),
        ..other.robot.clone()
    };
    one.urdf == other.urdf && one.robot == there && one.world == other.world
}

/// The robot with a start pose drawn from `seed`, uniformly within its limits; free of collisions, if they are checked.
fn started_anywhere(problem: &Problem, seed: u64) -> anyhow::Result<RobotSpec> {
    let model = RobotModel::from_urdf(&problem.urdf)?;
    let chain = Chain::new(&model, &problem.robot)?;
    let allows = Constraints::new(&problem.execution.constraints, &model, &problem.robot, &chain, &problem.world)?;
    let space = Space::of(&chain);
    let mut random = RandomStream::of_run(seed, 0);
    let mut pose = chain.home().to_vec();
    for _ in 0..MAX_DRAWS {
        space.uniform(&mut random, &mut pose);
        if !allows.forbids(&pose) {
            let home = chain.genes().iter().map(|gene| gene.name.clone()).zip(pose).collect();
            return Ok(RobotSpec { home, ..problem.robot.clone() });
        }
    }
    bail!(
        "--random-start: {MAX_DRAWS} start poses in a row are in collision: check the robot's shapes and its obstacles"
    )
}
