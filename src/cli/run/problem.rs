//! The problem that `cgda run` executes: a preset, or demonstrations with a robot and a world.

use super::collisions::CollisionArguments;
use super::reality::{RealityArguments, SurfaceArguments};
use crate::cli::demonstrations::{ReadArguments, read_demonstrations};
use crate::cli::values::{Metric, Weighting};
use crate::framework::execution::{ExecutionSpec, Problem};
use crate::framework::generalization::{GeneralizeSpec, generalize};
use crate::framework::method::per_goal::SstSpec;
use crate::framework::method::{MethodSpec, catalogue};
use crate::framework::preset::{self, Preset};
use crate::framework::robot::RobotSpec;
use crate::reproduce::shipped;
use anyhow::{Context as _, bail};
use clap::builder::{PossibleValue, PossibleValuesParser};
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
pub(super) struct ProblemArguments {
    /// Demonstrations: a file is one with a single stream, a directory one with a stream per file.
    #[arg(conflicts_with = "preset", required_unless_present = "preset")]
    files: Vec<PathBuf>,
    /// Name of a shipped preset (an unknown name lists them), or path of a TOML file.
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    /// Optimisation method, with the preset's own parameters for it if it has any.
    #[arg(long, value_parser = PossibleValuesParser::new(methods()))]
    method: Option<String>,
    /// End a goal once an observation is this close to it (Euclidean, features' unit).
    #[arg(long)]
    tolerance: Option<f64>,
    /// End a goal once the discrepancy is at most this (features' unit).
    #[arg(long)]
    target_discrepancy: Option<f64>,
    /// End a goal after this many evaluations.
    #[arg(long, value_name = "EVALUATIONS")]
    max_evaluations_per_goal: Option<u64>,
    #[command(flatten)]
    collisions: CollisionArguments,
    #[command(flatten)]
    reality: RealityArguments,
    #[command(flatten)]
    surface: SurfaceArguments,
    /// Metric of the discrepancy.
    #[arg(long, value_enum)]
    metric: Option<Metric>,
    /// URDF file of the robot.
    #[arg(long, value_name = "URDF", required_unless_present = "preset", conflicts_with = "preset")]
    robot: Option<PathBuf>,
    /// First link of the chain; the root if absent.
    #[arg(long, value_name = "LINK", conflicts_with = "preset")]
    base_link: Option<String>,
    /// Last link of the chain; the only leaf if absent.
    #[arg(long, value_name = "LINK", conflicts_with = "preset")]
    tip_link: Option<String>,
    /// Joint to search, in gene order; may be repeated; all movable joints if absent.
    #[arg(long = "free", value_name = "JOINT", conflicts_with = "preset")]
    free: Vec<String>,
    /// Joint held at a constant value (rad or m); may be repeated.
    #[arg(long = "fixed", value_name = "JOINT=VALUE", value_parser = joint_value, conflicts_with = "preset")]
    fixed: Vec<(String, f64)>,
    /// TOML file of the world.
    #[arg(long, value_name = "FILE", required_unless_present = "preset", conflicts_with = "preset")]
    world: Option<PathBuf>,
    /// T_min, the duration of one goal in seconds; n = mean duration / T_min.
    #[arg(long, value_name = "SECONDS", default_value_t = 10.0, conflicts_with = "preset")]
    t_min: f64,
    /// Whether every demonstration or every sample has the same weight.
    #[arg(long, value_enum, default_value_t = Weighting::PerDemonstration, conflicts_with = "preset")]
    weighting: Weighting,
    /// Feature to keep; may be repeated; all if absent.
    #[arg(long = "feature", value_name = "NAME", conflicts_with = "preset")]
    features: Vec<String>,
    #[command(flatten)]
    read: ReadArguments,
}

/// The names of all methods, each with the sentence the catalogue has for it.
fn methods() -> impl Iterator<Item = PossibleValue> {
    catalogue().into_iter().map(|entry| PossibleValue::new(entry.name).help(entry.purpose))
}

fn joint_value(argument: &str) -> Result<(String, f64), String> {
    let help = "give JOINT=VALUE in rad or m, for example wrist_yaw=-0.785";
    let (joint, value) = argument.split_once('=').ok_or(help)?;
    Ok((joint.to_owned(), value.parse().map_err(|_| help)?))
}

/// Builds the problem described by the arguments.
pub(super) fn read(arguments: &ProblemArguments) -> anyhow::Result<Preset> {
    let named = match &arguments.preset {
        Some(name) => read_preset(name)?,
        None => from_demonstrations(arguments)?,
    };
    adjusted(named, arguments)
}

/// Preset `name` with the execution options of the arguments.
pub(super) fn read_like(arguments: &ProblemArguments, name: &str) -> anyhow::Result<Preset> {
    adjusted(read_preset(name)?, arguments)
}

fn adjusted(mut named: Preset, arguments: &ProblemArguments) -> anyhow::Result<Preset> {
    arguments.surface.apply(&mut named.problem.world);
    if let Some(method) = &arguments.method
        && !named.select_method(method)
    {
        bail!("no method is named {method:?}: use one of {:?}", MethodSpec::NAMES);
    }
    let execution = &mut named.problem.execution;
    execution.tolerance = arguments.tolerance.or(execution.tolerance);
    execution.target_discrepancy = arguments.target_discrepancy.or(execution.target_discrepancy);
    execution.max_evaluations_per_goal = arguments.max_evaluations_per_goal.or(execution.max_evaluations_per_goal);
    execution.metric = arguments.metric.map_or(execution.metric, Into::into);
    arguments.collisions.apply(arguments.preset.is_some(), execution)?;
    arguments.reality.apply(&mut named.problem);
    named.problem.choose();
    Ok(named)
}

fn read_text(path: &Path) -> anyhow::Result<String> {
    std::fs::read_to_string(path).with_context(|| format!("cannot read {}", path.display()))
}

fn read_preset(name: &str) -> anyhow::Result<Preset> {
    let path = Path::new(name);
    let is_file = path.extension().is_some_and(|e| e == "toml") || path.components().count() > 1;
    if !is_file {
        return Ok(shipped::preset(name)?);
    }
    let folder = path.parent().unwrap_or(Path::new("."));
    let resolve = |file: &str| std::fs::read_to_string(folder.join(file)).map_err(|e| e.to_string());
    let mut read = preset::parse(name, &read_text(path)?, resolve)?;
    if let Some(stem) = path.file_stem() {
        read.name = stem.to_string_lossy().into_owned();
    }
    Ok(read)
}

fn from_demonstrations(arguments: &ProblemArguments) -> anyhow::Result<Preset> {
    let (Some(robot), Some(world)) = (&arguments.robot, &arguments.world) else {
        bail!("demonstrations need --robot URDF and --world FILE");
    };
    let urdf = read_text(robot)?;
    let world = preset::parse_world(&world.display().to_string(), &read_text(world)?)?;
    let demonstrations = read_demonstrations(&arguments.files, &arguments.read)?;
    let features = (!arguments.features.is_empty()).then(|| arguments.features.clone());
    let spec = GeneralizeSpec { t_min_s: arguments.t_min, weighting: arguments.weighting.into(), features };
    let generalized = generalize(&demonstrations, &spec)?;
    let robot = RobotSpec {
        base_link: arguments.base_link.clone(),
        tip_link: arguments.tip_link.clone(),
        free_joints: (!arguments.free.is_empty()).then(|| arguments.free.clone()),
        fixed: arguments.fixed.iter().cloned().collect(),
        ..RobotSpec::default()
    };
    let method = MethodSpec::Sst(SstSpec::default());
    let execution = ExecutionSpec { target_discrepancy: Some(0.0), ..ExecutionSpec::new(method) };
    let count = demonstrations.len();
    Ok(Preset {
        name: "demonstrations".to_owned(),
        description: format!("{} goals from {count} demonstrations", generalized.goals.len()),
        problem: Problem { goals: generalized.goals, urdf, robot, world, execution, earlier: Vec::new() },
        methods: Vec::new(),
        threshold: None,
    })
}
