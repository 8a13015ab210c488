//! Options of `cgda run` for trajectories and for the files that `--out` writes.

use crate::framework::trajectory::export::ExportSpec;
use crate::framework::trajectory::{MotionLimits, PlanSpec, Timing};

#[derive(Debug, clap::Args)]
pub(super) struct PlanningArguments {
    /// Share of each joint's velocity limit that trajectories use, 0.001 to 1; 0.5 if absent.
    #[arg(long, value_name = "SHARE")]
    speed: Option<f64>,
    /// Share of each joint's acceleration and jerk limits that trajectories use, 0.001 to 1; 0.5 if absent.
    #[arg(long, value_name = "SHARE")]
    acceleration: Option<f64>,
    /// Time at rest at each goal of a trajectory but the last, 0 to 60; 0.1 if absent.
    #[arg(long, value_name = "SECONDS", conflicts_with = "blend")]
    dwell: Option<f64>,
    /// Let trajectories pass through the goals without stopping.
    #[arg(long)]
    blend: bool,
    /// Reach the goals as early as the limits allow, or at the interval of the demonstrations; limits if absent.
    #[arg(long)]
    timing: Option<TimingArgument>,
    /// Limits of a joint's velocity, acceleration and jerk (rad or m, s), lower than the robot's own, or in place of
    /// those that it lacks; an empty one stays as it is, for example elbow=1.5,,30; may be repeated.
    #[arg(long = "joint-limit", value_name = "JOINT=V,A,J", value_parser = joint_limits)]
    joint_limits: Vec<(String, MotionLimits)>,
    /// Time between two points of a trajectory, 0.0001 to 10; 0.02 if absent.
    #[arg(long, value_name = "SECONDS")]
    sample: Option<f64>,
    /// Text in front of each joint's name in the written trajectories.
    #[arg(long, value_name = "TEXT", requires = "out")]
    prefix: Option<String>,
    /// Another name for a joint in the written trajectories; --prefix is put in front of it too; may be repeated.
    #[arg(long, value_name = "OLD=NEW", value_parser = renamed, requires = "out")]
    rename: Vec<(String, String)>,
    /// Leave joints that hold one value out of the written trajectories.
    #[arg(long, requires = "out")]
    omit_held: bool,
}

/// Decides when goals are reached.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum TimingArgument {
    /// As early as the limits allow.
    Limits,
    /// At the interval of the demonstrations, or later where the limits forbid it.
    Demonstration,
}

impl PlanningArguments {
    /// The choices for trajectories, unchecked.
    pub(super) fn spec(&self) -> PlanSpec {
        let default = PlanSpec::default();
        PlanSpec {
            speed: self.speed.unwrap_or(default.speed),
            acceleration: self.acceleration.unwrap_or(default.acceleration),
            dwell_s: self.dwell.unwrap_or(default.dwell_s),
            blend: self.blend,
            timing: match self.timing {
                None | Some(TimingArgument::Limits) => Timing::Limits,
                Some(TimingArgument::Demonstration) => Timing::Demonstration,
            },
            joint_limits: self.joint_limits.iter().cloned().collect(),
            sample_s: self.sample.unwrap_or(default.sample_s),
        }
    }

    /// The names in the written trajectories.
    pub(super) fn names(&self) -> ExportSpec {
        ExportSpec {
            prefix: self.prefix.clone().unwrap_or_default(),
            rename: self.rename.iter().cloned().collect(),
            omit_held: self.omit_held,
        }
    }
}

fn joint_limits(argument: &str) -> Result<(String, MotionLimits), String> {
    let help = "give JOINT=V,A,J in rad/s, rad/s^2 and rad/s^3 (or m), for example elbow=1.5,,30";
    let (joint, limits) = argument.split_once('=').ok_or(help)?;
    let number = |text: &str| match text.trim() {
        "" => Ok(None),
        text => text.parse().map(Some).map_err(|_| help),
    };
    let values = limits.split(',').map(number).collect::<Result<Vec<Option<f64>>, _>>()?;
    let [velocity, acceleration, jerk] = <[Option<f64>; 3]>::try_from(values).map_err(|_| help)?;
    Ok((joint.to_owned(), MotionLimits { velocity, acceleration, jerk }))
}

fn renamed(argument: &str) -> Result<(String, String), String> {
    let (old, new) = argument.split_once('=').ok_or("give OLD=NEW, for example elbow_pitch=elbow")?;
    Ok((old.to_owned(), new.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_joints_limits_are_three_numbers_of_which_some_may_be_empty() {
        let limits = MotionLimits { velocity: Some(1.5), acceleration: None, jerk: Some(30.0) };
        assert_eq!(joint_limits("elbow=1.5,,30"), Ok(("elbow".to_owned(), limits)));
        for wrong in ["elbow", "elbow=1", "elbow=1,2,x", "elbow=1,2,3,4"] {
            assert!(joint_limits(wrong).unwrap_err().starts_with("give JOINT=V,A,J"), "{wrong}");
        }
    }
}
