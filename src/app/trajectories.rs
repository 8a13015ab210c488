//! Trajectories: checked joint trajectories of runs.
//!
//! A trajectory is a function of its run. An export plans it again, which also checks it again, and fails if the result
//! differs from the stored one.

use crate::app::model::{AppError, ErrorKind, Export, TrajectoryId, TrajectoryView, Work};
use crate::app::{UseCases, chain_text, compute, unknown_format};
use crate::framework::execution::Problem;
use crate::framework::robot::{Chain, RobotModel};
use crate::framework::trajectory::{CheckedTrajectory, PlanSpec, export, plan};
use sha2::{Digest as _, Sha256};

/// Plans from the chain's home pose through `waypoints` (free joints, rad or m), within the chain's limits.
///
/// # Errors
/// The reason why there is no such trajectory.
pub fn plan_through(chain: &Chain, waypoints: &[Vec<f64>]) -> Result<CheckedTrajectory, String> {
    plan(chain, chain.home(), waypoints, &PlanSpec::default()).map_err(|error| error.to_string())
}

/// SHA-256 over the points' numbers, little-endian, hexadecimal.
#[must_use]
pub fn digest(trajectory: &CheckedTrajectory) -> String {
    let mut hash = Sha256::new();
    for point in trajectory.points() {
        let rows = [&point.positions, &point.velocities, &point.accelerations];
        for number in std::iter::once(&point.time_s).chain(rows.into_iter().flatten()) {
            hash.update(number.to_bits().to_le_bytes());
        }
    }
    hex::encode(hash.finalize())
}

impl UseCases {
    /// Reads one trajectory with its points.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn get_trajectory(&self, id: &TrajectoryId) -> Result<TrajectoryView, AppError> {
        Ok(self.ports.store.trajectory(id).await?)
    }

    /// Exports the trajectory as `csv`, `json` or `ros2` (YAML of `trajectory_msgs/JointTrajectory`).
    ///
    /// # Errors
    /// `NotFound`; `Malformed` format; `Conflict` if this version plans it differently from the one that created it.
    pub async fn export_trajectory(&self, id: &TrajectoryId, format: &str) -> Result<Export, AppError> {
        if !["csv", "json", "ros2"].contains(&format) {
            return Err(unknown_format(format, "csv, json or ros2"));
        }
        let view = self.get_trajectory(id).await?;
        let goals = self.run_goals(&view.run).await?;
        let Work::Execution(work) = self.ports.store.work(&view.job).await? else {
            return Err(AppError::internal(format!("{} is not an execution, but has a trajectory", view.job)));
        };
        let waypoints: Vec<Vec<f64>> = goals.goals.into_iter().map(|goal| goal.joints).collect();
        let trajectory = compute(move || again(&work.problem, &waypoints)).await??;
        if digest(&trajectory) != view.sha256 {
            let message =
                format!("this version plans {id} differently from the one that created it: run the job again");
            return Err(AppError::new(ErrorKind::Conflict, "planned_otherwise", message));
        }
        let name = id.as_str();
        Ok(match format {
            "csv" => Export::new("text/csv; charset=utf-8", name, "csv", export::csv(&trajectory).into_bytes()),
            "ros2" => {
                let text = export::ros2_joint_trajectory(&trajectory);
                Export::new("application/yaml", name, "yaml", text.into_bytes())
            }
            _ => {
                let text = export::json(&trajectory).map_err(AppError::internal)?;
                Export::new("application/json", name, "json", text.into_bytes())
            }
        })
    }
}

fn again(problem: &Problem, waypoints: &[Vec<f64>]) -> Result<CheckedTrajectory, AppError> {
    let model = RobotModel::from_urdf(&problem.urdf).map_err(|error| AppError::internal(chain_text(&error)))?;
    let chain = Chain::new(&model, &problem.robot).map_err(|error| AppError::internal(chain_text(&error)))?;
    plan_through(&chain, waypoints).map_err(|why| {
        AppError::new(
            ErrorKind::Conflict,
            "planned_otherwise",
            format!("this version cannot plan the trajectory: {why}"),
        )
    })
}

#[cfg(test)]
mod tests {
    use crate::app::bench::Bench;
    use crate::app::model::{ErrorKind, TrajectoryId};
    use uuid::Uuid;

    #[tokio::test]
    async fn an_export_is_planned_again_in_every_format() {
        let bench = Bench::new();
        let id = bench.run(true).await.trajectory.unwrap();
        for (format, beginning) in [("csv", "time_s,"), ("json", "{"), ("ros2", "")] {
            let export = bench.app.export_trajectory(&id, format).await.unwrap();
            let text = String::from_utf8(export.bytes).unwrap();
            assert!(text.starts_with(beginning) && text.contains("shoulder_pitch"), "{format}: {text}");
        }
        assert_eq!(bench.app.export_trajectory(&id, "pdf").await.unwrap_err().code, "unknown_format");
        let missing = TrajectoryId::from_uuid(Uuid::from_u128(99));
        assert_eq!(bench.app.export_trajectory(&missing, "csv").await.unwrap_err().kind, ErrorKind::NotFound);
    }

    #[tokio::test]
    async fn a_trajectory_that_is_planned_differently_today_is_not_exported() {
        let bench = Bench::new();
        let id = bench.run_with(|trajectory| trajectory.sha256 = "of another version".to_owned()).await;
        let error = bench.app.export_trajectory(&id, "csv").await.unwrap_err();
        assert_eq!((error.kind, error.code), (ErrorKind::Conflict, "planned_otherwise"));
        assert!(error.message.ends_with("run the job again"), "{error}");
    }
}
