//! Conversion of trajectories.

use super::enumeration::Enumeration as _;
use super::{all, time};
use crate::app::model::{TrajectoryPoint, TrajectoryView};
use crate::framework::trajectory::Tightest;
use crate::grpc::proto;

/// Splits a trajectory into its head and its points.
pub fn split(view: TrajectoryView) -> (proto::Trajectory, Vec<TrajectoryPoint>) {
    let TrajectoryView {
        id,
        run,
        job,
        robot,
        joint_names,
        fixed_joints,
        duration_s,
        points,
        pose_times_s,
        goal_times_s,
        tightest,
        notes,
        sha256,
        created_at,
    } = view;
    let head = proto::Trajectory {
        id: id.into(),
        run: run.into(),
        job: job.into(),
        robot: robot.into(),
        joint_names,
        fixed_joints,
        duration_s,
        point_count: points.len() as u64,
        pose_times_s,
        goal_times_s,
        tightest: all(tightest),
        notes,
        sha256,
        created_at: Some(time(created_at)),
    };
    (head, points)
}

/// The points from `from` on, `batch` per message.
pub fn chunks(points: Vec<TrajectoryPoint>, from: usize, batch: usize) -> Vec<proto::TrajectoryChunk> {
    let mut left = points.into_iter().skip(from).map(proto::TrajectoryPoint::from).peekable();
    let mut chunks: Vec<proto::TrajectoryChunk> = Vec::new();
    while left.peek().is_some() {
        let first_index = (from + chunks.len() * batch) as u64;
        chunks.push(proto::TrajectoryChunk { first_index, points: left.by_ref().take(batch).collect() });
    }
    chunks
}

impl From<TrajectoryPoint> for proto::TrajectoryPoint {
    fn from(point: TrajectoryPoint) -> Self {
        let TrajectoryPoint { t_s, positions, velocities, accelerations } = point;
        Self { t_s, positions, velocities, accelerations }
    }
}

impl From<Tightest> for proto::TightestLimit {
    fn from(tightest: Tightest) -> Self {
        let Tightest { kind, joint, time_s, value, limit, ratio } = tightest;
        Self { kind: kind.number(), joint, time_s, value, limit, ratio }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chunks_hold_every_point_once_with_its_index() {
        let point = |i: i32| TrajectoryPoint {
            t_s: f64::from(i),
            positions: vec![],
            velocities: vec![],
            accelerations: vec![],
        };
        let points: Vec<_> = (0..10).map(point).collect();
        for (from, batch) in [(0, 4), (3, 4), (0, 10), (9, 1), (10, 3), (50, 3)] {
            let chunks = chunks(points.clone(), from, batch);
            let mut index = from;
            for chunk in &chunks {
                assert_eq!(chunk.first_index, index as u64);
                assert!(!chunk.points.is_empty() && chunk.points.len() <= batch);
                assert!(chunk.points.iter().zip(index..).all(|(p, i)| (p.t_s - i as f64).abs() < 0.5));
                index += chunk.points.len();
            }
            assert_eq!(index, 10.max(from));
        }
    }
}
