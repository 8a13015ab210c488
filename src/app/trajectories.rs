//! Trajectories: checked joint trajectories of runs.
//!
//! A trajectory is planned once, when its run ends, and stored with its points. An export is made of the stored points,
//! after their digest and, as far as samples show it, their order, their rest at both ends and their limits have been
//! checked again.

use crate::app::model::{
    AppError, ErrorKind, ExecutionWork, Export, TrajectoryId, TrajectoryPoint, TrajectoryView, Work,
};
use crate::app::{UseCases, chain_text, compute, unknown_format};
use crate::framework::robot::{Chain, RobotModel};
use crate::framework::trajectory::export::{ExportSpec, Exported, Sampled};
use crate::framework::trajectory::{CheckedTrajectory, Point, check_stored};
use sha2::{Digest as _, Sha256};

/// The points as they are stored.
#[must_use]
pub fn points_of(trajectory: &CheckedTrajectory) -> Vec<TrajectoryPoint> {
    let point = |point: &Point| TrajectoryPoint {
        t_s: point.time_s,
        positions: point.positions.clone(),
        velocities: point.velocities.clone(),
        accelerations: point.accelerations.clone(),
    };
    trajectory.points().iter().map(point).collect()
}

/// SHA-256 over the points' numbers, little-endian, hexadecimal.
#[must_use]
pub fn digest(points: &[TrajectoryPoint]) -> String {
    let mut hash = Sha256::new();
    for point in points {
        let rows = [&point.positions, &point.velocities, &point.accelerations];
        for number in std::iter::once(&point.t_s).chain(rows.into_iter().flatten()) {
            hash.update(number.to_bits().to_le_bytes());
        }
    }
    hex::encode(hash.finalize())
}

/// The names of an export; `rename` holds `OLD=NEW`, separated by commas.
///
/// # Errors
/// `Malformed` if it does not.
pub fn export_names(prefix: String, rename: &str, omit_held: bool) -> Result<ExportSpec, AppError> {
    let pairs = rename.split(',').filter(|pair| !pair.is_empty()).map(|pair| {
        let (old, new) = pair.split_once('=').ok_or_else(|| {
            let message = format!("rename has {pair:?}: give OLD=NEW, separated by commas");
            AppError::new(ErrorKind::Malformed, "invalid_names", message)
        })?;
        Ok((old.to_owned(), new.to_owned()))
    });
    Ok(ExportSpec { prefix, rename: pairs.collect::<Result<_, AppError>>()?, omit_held })
}

impl UseCases {
    /// Reads one trajectory with its points.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn get_trajectory(&self, id: &TrajectoryId) -> Result<TrajectoryView, AppError> {
        Ok(self.ports.store.trajectory(id).await?)
    }

    /// Exports the trajectory as `csv`, `json` or `ros2` (YAML of `trajectory_msgs/JointTrajectory`), with the joints'
    /// names of `names`.
    ///
    /// # Errors
    /// `NotFound`; `Malformed` format or names; `Conflict` if the stored points are damaged.
    pub async fn export_trajectory(
        &self,
        id: &TrajectoryId,
        format: &str,
        names: ExportSpec,
    ) -> Result<Export, AppError> {
        if !["csv", "json", "ros2"].contains(&format) {
            return Err(unknown_format(format, "csv, json or ros2"));
        }
        let view = self.get_trajectory(id).await?;
        let Work::Execution(work) = self.ports.store.work(&view.job).await? else {
            return Err(AppError::internal(format!("{} is not an execution, but has a trajectory", view.job)));
        };
        let exported = compute(move || {
            let points = checked(&view, &work).map_err(|why| damaged(&view.id, &why))?;
            let TrajectoryView { joint_names, fixed_joints, tightest, notes, .. } = &view;
            let motion = Sampled { joints: joint_names, fixed_joints, points: &points, tightest, notes };
            Exported::new(motion, &names)
                .map_err(|error| AppError::new(ErrorKind::Malformed, "invalid_names", error.to_string()))
        })
        .await??;
        let name = id.as_str();
        Ok(match format {
            "csv" => Export::new("text/csv; charset=utf-8", name, "csv", exported.csv().into_bytes()),
            "ros2" => Export::new("application/yaml", name, "yaml", exported.ros2_joint_trajectory().into_bytes()),
            _ => {
                let text = exported.json().map_err(AppError::internal)?;
                Export::new("application/json", name, "json", text.into_bytes())
            }
        })
    }
}

fn damaged(id: &TrajectoryId, why: &str) -> AppError {
    let message = format!("the stored points of {id} are damaged: {why}: run the job again");
    AppError::new(ErrorKind::Conflict, "trajectory_damaged", message)
}

/// The stored points, after their digest and their limits have been checked.
///
/// # Errors
/// The reason why they are not a trajectory of this robot.
fn checked(view: &TrajectoryView, work: &ExecutionWork) -> Result<Vec<Point>, String> {
    if digest(&view.points) != view.sha256 {
        return Err("their digest is not the one stored with them".to_owned());
    }
    let model = RobotModel::from_urdf(&work.problem.urdf).map_err(|error| chain_text(&error))?;
    let chain = Chain::new(&model, &work.problem.robot).map_err(|error| chain_text(&error))?;
    let point = |point: &TrajectoryPoint| Point {
        time_s: point.t_s,
        positions: point.positions.clone(),
        velocities: point.velocities.clone(),
        accelerations: point.accelerations.clone(),
        waypoint: view.pose_times_s.iter().rposition(|time_s| *time_s == point.t_s),
        goal: view.goal_times_s.iter().rposition(|time_s| *time_s == point.t_s),
    };
    let points: Vec<Point> = view.points.iter().map(point).collect();
    check_stored(&chain, &work.planning, &points).map_err(|error| error.to_string())?;
    Ok(points)
}

#[cfg(test)]
mod tests {
    use crate::app::bench::Bench;
    use crate::app::model::{ErrorKind, TrajectoryId, TrajectoryView};
    use crate::app::trajectories::digest;
    use crate::framework::trajectory::export::ExportSpec;
    use rstest::rstest;
    use uuid::Uuid;

    #[tokio::test]
    async fn an_export_holds_the_stored_points_in_every_format() {
        let bench = Bench::new();
        let id = bench.run(true).await.trajectory.unwrap();
        let names = || ExportSpec { prefix: "right_".to_owned(), ..ExportSpec::default() };
        for (format, beginning) in [("csv", "time_s,"), ("json", "{"), ("ros2", "header")] {
            let export = bench.app.export_trajectory(&id, format, names()).await.unwrap();
            let text = String::from_utf8(export.bytes).unwrap();
            assert!(text.starts_with(beginning) && text.contains("right_wrist_yaw"), "{format}: {text}");
        }
        let csv = bench.app.export_trajectory(&id, "csv", names()).await.unwrap().bytes;
        let stored = bench.app.get_trajectory(&id).await.unwrap();
        assert_eq!(String::from_utf8(csv).unwrap().lines().count(), stored.points.len() + 1);
        assert_eq!(bench.app.export_trajectory(&id, "pdf", names()).await.unwrap_err().code, "unknown_format");
        let rename = [("knee".to_owned(), "k".to_owned())].into();
        let error = bench.app.export_trajectory(&id, "csv", ExportSpec { rename, ..names() }).await.unwrap_err();
        assert_eq!((error.kind, error.code), (ErrorKind::Malformed, "invalid_names"));
        let missing = TrajectoryId::from_uuid(Uuid::from_u128(99));
        let error = bench.app.export_trajectory(&missing, "csv", names()).await.unwrap_err();
        assert_eq!(error.kind, ErrorKind::NotFound);
    }

    #[rstest]
    #[case::another_number(|view: &mut TrajectoryView| view.points[3].positions[1] += 1e-9, "their digest")]
    #[case::too_fast(|view: &mut TrajectoryView| {
        view.points[3].velocities[1] = 9.0;
        view.sha256 = digest(&view.points);
    }, "velocity of joint \"shoulder_roll\" is 9")]
    #[case::cut_off(|view: &mut TrajectoryView| {
        view.points.truncate(7);
        view.sha256 = digest(&view.points);
    }, "must start and end at rest")]
    #[tokio::test]
    async fn damaged_points_are_not_exported(#[case] damage: fn(&mut TrajectoryView), #[case] told: &str) {
        let bench = Bench::new();
        let id = bench.run_with(damage).await;
        let error = bench.app.export_trajectory(&id, "csv", ExportSpec::default()).await.unwrap_err();
        assert_eq!((error.kind, error.code), (ErrorKind::Conflict, "trajectory_damaged"));
        assert!(error.message.contains(told) && error.message.ends_with("run the job again"), "{error}");
    }
}
