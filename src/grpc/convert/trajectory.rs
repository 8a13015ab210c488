//! Trajectories.

use crate::app::model::{TrajectoryPoint, TrajectoryView};
use crate::framework::trajectory::{LimitKind, Tightest};
use crate::grpc::proto;

/// The head and the points.
pub fn split(view: TrajectoryView) -> (proto::Trajectory, Vec<TrajectoryPoint>) {
    let head = proto::Trajectory {
        id: view.id.into(),
        run: view.run.into(),
        job: view.job.into(),
        robot: view.robot.into(),
        joint_names: view.joint_names,
        fixed_joints: view.fixed_joints.into_iter().collect(),
        duration_s: view.duration_s,
        points: view.points.len() as u64,
        goal_times_s: view.goal_times_s,
        tightest: super::all(view.tightest),
        notes: view.notes,
        sha256: view.sha256,
        created_at_ms: view.created_at.0,
    };
    (head, view.points)
}

/// The points from `from` on, `batch` a message.
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
        Self {
            t_s: point.t_s,
            positions: point.positions,
            velocities: point.velocities,
            accelerations: point.accelerations,
        }
    }
}

impl From<Tightest> for proto::TightestLimit {
    fn from(tightest: Tightest) -> Self {
        let kind = match tightest.kind {
            LimitKind::Position => proto::LimitKind::Position,
            LimitKind::Velocity => proto::LimitKind::Velocity,
            LimitKind::Acceleration => proto::LimitKind::Acceleration,
        };
        Self {
            kind: kind as i32,
            joint: tightest.joint,
            time_s: tightest.time_s,
            value: tightest.value,
            limit: tightest.limit,
            ratio: tightest.ratio,
        }
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
