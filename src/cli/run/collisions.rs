//! Collisions that the robot of `cgda run` avoids: on for demonstrations, as the preset says for presets.

use crate::framework::collision::Obstacle;
use crate::framework::constraint::ConstraintSpec;
use crate::framework::execution::ExecutionSpec;
use anyhow::Context as _;
use serde::Deserialize;
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
pub(super) struct CollisionArguments {
    /// Let the robot's links pass through each other and through the worked surface.
    #[arg(long, conflicts_with_all = ["preset", "obstacles"])]
    ignore_collisions: bool,
    /// Avoid collisions with a preset that does not check them, too.
    #[arg(long, requires = "preset")]
    avoid_collisions: bool,
    /// TOML file of obstacles to avoid: an array of tables named obstacles, each with name and shape, in the chain's base frame.
    #[arg(long, value_name = "FILE")]
    obstacles: Option<PathBuf>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ObstacleFile {
    obstacles: Vec<Obstacle>,
}

impl CollisionArguments {
    /// Adds the constraint `collision_free`, if it is asked for, and the obstacles.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub(super) fn apply(&self, is_preset: bool, execution: &mut ExecutionSpec) -> anyhow::Result<()> {
        let is_wanted =
            if is_preset { self.avoid_collisions || self.obstacles.is_some() } else { !self.ignore_collisions };
        if !is_wanted {
            return Ok(());
        }
        execution.avoid_collisions();
        let Some(file) = &self.obstacles else { return Ok(()) };
        for constraint in &mut execution.constraints {
            if let ConstraintSpec::CollisionFree(spec) = constraint {
                spec.obstacles.extend(read(file)?);
            }
        }
        Ok(())
    }
}

fn read(file: &Path) -> anyhow::Result<Vec<Obstacle>> {
    let text = std::fs::read_to_string(file).with_context(|| format!("cannot read {}", file.display()))?;
    let read: ObstacleFile = toml::from_str(&text).with_context(|| format!("obstacles of {}", file.display()))?;
    Ok(read.obstacles)
}
