//! The way of a motion: from home through the poses of a path, around whatever the straight motion would touch.

use super::error::MotionError;
use crate::collision::{CollisionModel, RouteBudget, route};
use crate::execution::PathPose;
use crate::trajectory::{CheckedTrajectory, Polynomial, Waypoint};

/// A way and the number of its moves that lead around something.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Way {
    pub waypoints: Vec<Waypoint>,
    pub detours: usize,
}

/// The straight way through `poses`, one per pose of `path`.
pub(super) fn straight(path: &[PathPose], poses: &[Vec<f64>]) -> Way {
    Way { waypoints: path.iter().zip(poses).map(rest).collect(), detours: 0 }
}

/// The way from `home` through `poses` on which `model` finds no contact; the same `seed` gives the same way.
///
/// # Errors
/// [`MotionError::NoRoute`] with the move for which none is found.
pub(super) fn around(
    model: &CollisionModel,
    home: &[f64],
    path: &[PathPose],
    poses: &[Vec<f64>],
    seed: u64,
) -> Result<Way, MotionError> {
    let mut way = Way { waypoints: Vec::with_capacity(poses.len()), detours: 0 };
    let mut from = home;
    for (index, (found, to)) in path.iter().zip(poses).enumerate() {
        let seed = seed.wrapping_add((index as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15));
        let Some(via) = route(model, from, to, seed, &RouteBudget::default()) else {
            return Err(no_route(model, from, to, index, found));
        };
        way.detours += usize::from(!via.is_empty());
        way.waypoints.extend(via.into_iter().map(|joints| Waypoint { joints, goal: None, rest: false }));
        way.waypoints.push(rest((found, to)));
        from = to;
    }
    Ok(way)
}

/// The arm rests at each pose of the path.
fn rest((found, joints): (&PathPose, &Vec<f64>)) -> Waypoint {
    Waypoint { joints: joints.clone(), goal: found.goals.last().copied(), rest: true }
}

fn no_route(model: &CollisionModel, from: &[f64], to: &[f64], index: usize, found: &PathPose) -> MotionError {
    let contact = model.check_motion(from, to, &mut model.workspace());
    MotionError::NoRoute {
        from: index.checked_sub(1).map_or_else(|| "home".to_owned(), |before| format!("pose {before}")),
        to: index,
        goal: found.goals.first().copied(),
        pair: contact.map(|contact| contact.pair.map(str::to_owned)).unwrap_or_default(),
    }
}

/// The first contact on the curve of a finished trajectory, in words; `None` if there is none.
pub(super) fn contact(model: &CollisionModel, trajectory: &CheckedTrajectory) -> Option<String> {
    let mut workspace = model.workspace();
    let contact = trajectory.pieces().iter().find_map(|piece| {
        let curve = |share: f64, joints: &mut [f64]| {
            let own_s = share * piece.duration_s;
            joints.iter_mut().zip(&piece.joints).for_each(|(q, polynomial)| *q = polynomial.at(own_s));
        };
        let rates: Vec<f64> =
            piece.joints.iter().map(|joint| fastest(joint, piece.duration_s) * piece.duration_s).collect();
        let found = model.check_curve(curve, &rates, &mut workspace)?;
        Some((piece.start_s + found.at * piece.duration_s, found.pair))
    });
    contact.map(|(time_s, [first, second])| format!("{first:?} would meet {second:?} at {time_s:.3} s"))
}

/// Largest speed of a joint on a piece.
fn fastest(joint: &Polynomial, duration_s: f64) -> f64 {
    let velocity = joint.derivative();
    joint.extrema(duration_s).into_iter().map(|own_s| velocity.at(own_s).abs()).fold(0.0, f64::max)
}
