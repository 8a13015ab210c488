//! Checks of a motion: its polynomials at their extrema and joints, its samples one by one.

use super::error::TrajectoryError;
use super::limits::{JointLimits, limits_under};
use super::piece::Piece;
use super::point::Point;
use super::spec::PlanSpec;
use super::tightest::{LimitKind, Tightest};
use crate::robot::Chain;

/// Relative amount by which a computed value may exceed its limit, for rounding.
const SLACK: f64 = 1e-9;
/// Jump between two pieces that counts as rounding, as a share of the limit (for positions rad or m).
const GAP: f64 = 1e-6;
/// Shortest time between two samples, s.
const NANOSECOND: f64 = 1e-9;

/// Checks that the pieces respect the limits everywhere, that position, velocity and acceleration are continuous, and
/// that the first starts and the last ends at rest; returns the most used limit of each kind.
///
/// # Errors
/// [`TrajectoryError`] with joint, time and value.
pub(super) fn check_pieces(limits: &[JointLimits], pieces: &[Piece]) -> Result<Vec<Tightest>, TrajectoryError> {
    check_borders(limits, pieces)?;
    let mut tightest = Vec::new();
    for piece in pieces {
        for (limit, joint) in limits.iter().zip(&piece.joints) {
            let derivatives = joint.derivatives();
            for own_s in joint.extrema(piece.duration_s) {
                let values = derivatives.map(|polynomial| polynomial.at(own_s));
                for used in usage(limit, piece.start_s + own_s, &values) {
                    within(&used)?;
                    keep(&mut tightest, used);
                }
            }
        }
    }
    Ok(tightest)
}

/// Checks that samples are finite and in order, start and end at rest, and respect the limits one by one. A motion that
/// is only known by its samples cannot be checked any further.
///
/// # Errors
/// [`TrajectoryError`] with joint, time and value.
pub(super) fn check_samples(limits: &[JointLimits], points: &[Point]) -> Result<(), TrajectoryError> {
    check_shape(limits, points)?;
    check_time(points)?;
    check_ends(limits, points)?;
    for point in points {
        for (index, limit) in limits.iter().enumerate() {
            let values = [point.positions[index], point.velocities[index], point.accelerations[index]];
            usage(limit, point.time_s, &values).iter().try_for_each(within)?;
        }
    }
    Ok(())
}

/// Checks a stored motion of `chain` that was planned with `spec`, of which only the samples are known.
///
/// # Errors
/// [`TrajectoryError`] with joint, time and value.
pub fn check_stored(chain: &Chain, spec: &PlanSpec, points: &[Point]) -> Result<(), TrajectoryError> {
    check_samples(&limits_under(chain, spec).0, points)
}

/// The share of each limit that is used by `values`: position and as many of its derivatives as are known.
fn usage(limit: &JointLimits, time_s: f64, values: &[f64]) -> Vec<Tightest> {
    let make = |kind, value: f64, bound: f64, ratio: f64| Tightest {
        kind,
        joint: limit.name.clone(),
        time_s,
        value,
        limit: bound,
        ratio,
    };
    let kinds = [
        (LimitKind::Position, f64::NAN),
        (LimitKind::Velocity, limit.velocity),
        (LimitKind::Acceleration, limit.acceleration),
        (LimitKind::Jerk, limit.jerk),
    ];
    let used = values.iter().zip(kinds).map(|(&value, (kind, bound))| {
        if kind != LimitKind::Position {
            return make(kind, value, bound, value.abs() / bound);
        }
        let (middle, half) = (f64::midpoint(limit.lower, limit.upper), (limit.upper - limit.lower) / 2.0);
        let away = (value - middle).abs();
        let nearer = if value >= middle { limit.upper } else { limit.lower };
        // A joint without a range counts as at its limit while it stays there.
        make(kind, value, nearer, if half > 0.0 { away / half } else { 1.0 + away })
    });
    used.collect()
}

fn within(used: &Tightest) -> Result<(), TrajectoryError> {
    let Tightest { kind, joint, time_s, value, limit, ratio } = used;
    let (joint, kind, time_s, value, limit) = (joint.clone(), *kind, *time_s, *value, *limit);
    if !value.is_finite() {
        return Err(TrajectoryError::NonFinite { joint, time_s, value });
    }
    if *ratio > 1.0 + SLACK {
        return Err(TrajectoryError::Limit { kind, joint, time_s, value, limit });
    }
    Ok(())
}

fn keep(tightest: &mut Vec<Tightest>, used: Tightest) {
    match tightest.iter_mut().find(|most| most.kind == used.kind) {
        None => tightest.push(used),
        Some(most) if used.ratio > most.ratio => *most = used,
        Some(_) => {}
    }
}

/// Checks that neighbouring pieces agree at their border, and the outermost ones with rest.
fn check_borders(limits: &[JointLimits], pieces: &[Piece]) -> Result<(), TrajectoryError> {
    for (joint, limit) in limits.iter().enumerate() {
        let ends = |piece: &Piece| {
            let derivatives = piece.joints[joint].derivatives();
            [0.0, piece.duration_s].map(|own_s| [0, 1, 2].map(|order: usize| derivatives[order].at(own_s)))
        };
        let mut before: Option<[f64; 3]> = None;
        for piece in pieces {
            let [start, end] = ends(piece);
            let [position, ..] = start;
            same(limit, piece.start_s, before.unwrap_or([position, 0.0, 0.0]), start)?;
            before = Some(end);
        }
        if let (Some(end), Some(piece)) = (before, pieces.last()) {
            same(limit, piece.start_s + piece.duration_s, end, [end[0], 0.0, 0.0])?;
        }
    }
    Ok(())
}

fn same(limit: &JointLimits, time_s: f64, before: [f64; 3], after: [f64; 3]) -> Result<(), TrajectoryError> {
    let kinds = [
        (LimitKind::Position, 1.0),
        (LimitKind::Velocity, limit.velocity),
        (LimitKind::Acceleration, limit.acceleration),
    ];
    for ((kind, scale), (a, b)) in kinds.into_iter().zip(before.into_iter().zip(after)) {
        let by = (b - a).abs();
        if by.is_nan() || by > GAP * scale {
            return Err(TrajectoryError::Jump { kind, joint: limit.name.clone(), time_s, by });
        }
    }
    Ok(())
}

fn check_shape(limits: &[JointLimits], points: &[Point]) -> Result<(), TrajectoryError> {
    for (index, point) in points.iter().enumerate() {
        for values in [&point.positions, &point.velocities, &point.accelerations] {
            if values.len() != limits.len() {
                let (found, expected) = (values.len(), limits.len());
                return Err(TrajectoryError::RaggedSample { index, found, expected });
            }
        }
    }
    Ok(())
}

fn check_time(points: &[Point]) -> Result<(), TrajectoryError> {
    let mut previous_s = f64::NEG_INFINITY;
    for (index, point) in points.iter().enumerate() {
        if !point.time_s.is_finite() || point.time_s < previous_s + NANOSECOND {
            return Err(TrajectoryError::NonIncreasing { index, time_s: point.time_s, previous_s });
        }
        previous_s = point.time_s;
    }
    Ok(())
}

fn check_ends(limits: &[JointLimits], points: &[Point]) -> Result<(), TrajectoryError> {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return Err(TrajectoryError::Empty) };
    for point in [first, last] {
        let moving = limits.iter().zip(point.velocities.iter().zip(&point.accelerations));
        for (limit, (&velocity, &acceleration)) in moving {
            if velocity != 0.0 || acceleration != 0.0 {
                let (joint, time_s) = (limit.name.clone(), point.time_s);
                return Err(TrajectoryError::NotAtRest { joint, time_s, velocity, acceleration });
            }
        }
    }
    Ok(())
}
