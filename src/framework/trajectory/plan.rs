//! Time parameterisation by uniform scaling: rest-to-rest quintic segments between waypoints.
//!
//! Between two waypoints all joints share s(u) = 10 u^3 - 15 u^4 + 6 u^5, u = t / T. Position, velocity and
//! acceleration are continuous, and the arm rests at each waypoint, where a feature is observed. If |dq| is the
//! distance a joint moves, max |v| = 15/8 |dq| / T and max |a| = 10/sqrt(3) |dq| / T^2; T is the smallest value that
//! respects every joint's limits.

use super::checked::{CheckedTrajectory, JointLimits, Point, TrajectoryError};
use crate::range::{OutOfRange, Range};
use crate::robot::Chain;
use serde::{Deserialize, Serialize};

/// Velocity limit assumed if the URDF has none, rad/s or m/s.
pub const DEFAULT_VELOCITY: f64 = 0.5;
/// Acceleration limit assumed if the robot's description has none (a URDF never does), rad/s^2 or m/s^2.
pub const DEFAULT_ACCELERATION: f64 = 2.0;
/// Poses that differ by less than this in every joint (rad or m) are considered equal.
const SAME_POSE: f64 = 1e-12;
/// Maximum number of samples of a trajectory.
const MAX_SAMPLES: f64 = 1e6;

/// Parameters of a trajectory.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PlanSpec {
    /// Time between two samples, s; each waypoint is an additional sample.
    pub sample_s: f64,
    /// Share of the velocity and acceleration limits to use, in (0, 1].
    pub speed: f64,
    /// Time at rest at each waypoint, s.
    pub dwell_s: f64,
}

impl Default for PlanSpec {
    fn default() -> Self {
        Self { sample_s: 0.02, speed: 1.0, dwell_s: 0.1 }
    }
}

/// Joins `start` (n values, rad or m) and the waypoints into a trajectory within the chain's limits, and checks it.
///
/// # Errors
/// [`TrajectoryError`] with joint, time, value and limit, for example if a waypoint is outside the position limits.
pub fn plan(
    chain: &Chain,
    start: &[f64],
    waypoints: &[Vec<f64>],
    spec: &PlanSpec,
) -> Result<CheckedTrajectory, TrajectoryError> {
    check_spec(spec)?;
    check_shape(chain, start, waypoints)?;
    let (limits, notes) = limits(chain);
    let rest = |time_s, pose: &[f64], waypoint| Point {
        time_s,
        positions: pose.to_vec(),
        velocities: vec![0.0; pose.len()],
        accelerations: vec![0.0; pose.len()],
        waypoint,
    };
    let mut points = vec![rest(0.0, start, None)];
    let mut time_s = 0.0;
    let mut from = start;
    for (index, to) in waypoints.iter().enumerate() {
        let least_s = duration(&limits, from, to, spec.speed);
        if least_s > 0.0 {
            let steps = (least_s / spec.sample_s).ceil().max(1.0);
            if steps + points.len() as f64 > MAX_SAMPLES {
                return Err(TrajectoryError::TooManySamples { sample_s: spec.sample_s });
            }
            for step in (1_u32..).map(f64::from).take_while(|&step| step < steps) {
                points.push(sample(time_s, least_s, step / steps, from, to));
            }
            time_s += least_s;
            points.push(rest(time_s, to, Some(index)));
        } else if let Some(last) = points.last_mut() {
            last.waypoint = Some(index);
        }
        if spec.dwell_s > 0.0 && index + 1 < waypoints.len() {
            time_s += spec.dwell_s;
            points.push(rest(time_s, to, None));
        }
        from = to;
    }
    if points.len() == 1 {
        // If nothing moves, the pose is held for one sample.
        points.push(rest(spec.sample_s, start, points[0].waypoint));
    }
    let fixed = chain.fixed_joints().iter().cloned().collect();
    CheckedTrajectory::new(&limits, fixed, points, notes)
}

/// Shortest time of the segment, s.
fn duration(limits: &[JointLimits], from: &[f64], to: &[f64], speed: f64) -> f64 {
    let mut least_s = 0.0_f64;
    for (limit, (a, b)) in limits.iter().zip(from.iter().zip(to)) {
        let way = (b - a).abs();
        if way > SAME_POSE {
            let by_velocity = 1.875 * way / (limit.velocity * speed);
            let by_acceleration = (10.0 / 3.0_f64.sqrt() * way / (limit.acceleration * speed)).sqrt();
            least_s = least_s.max(by_velocity).max(by_acceleration);
        }
    }
    least_s
}

/// Writes to `pose` where the joints are `lag_s` before they come to rest at `to`, on the fastest motion from `from` (n
/// values, rad or m).
pub fn late(limits: &[JointLimits], from: &[f64], to: &[f64], lag_s: f64, pose: &mut [f64]) {
    let duration_s = duration(limits, from, to, 1.0);
    let u = if duration_s > 0.0 { (1.0 - lag_s / duration_s).clamp(0.0, 1.0) } else { 1.0 };
    let share = u * u * u * (10.0 + u * (6.0 * u - 15.0));
    pose.iter_mut()
        .zip(from.iter().zip(to))
        .for_each(|(p, (a, b))| *p = if share < 1.0 { a + (b - a) * share } else { *b });
}

fn sample(start_s: f64, duration_s: f64, u: f64, from: &[f64], to: &[f64]) -> Point {
    let position = u * u * u * (10.0 + u * (6.0 * u - 15.0));
    let velocity = 30.0 * u * u * (1.0 - u) * (1.0 - u) / duration_s;
    let acceleration = 60.0 * u * (1.0 - u) * (1.0 - 2.0 * u) / (duration_s * duration_s);
    let scale = |by: f64| from.iter().zip(to).map(|(a, b)| (b - a) * by).collect::<Vec<f64>>();
    Point {
        time_s: start_s + u * duration_s,
        positions: from.iter().zip(scale(position)).map(|(a, way)| a + way).collect(),
        velocities: scale(velocity),
        accelerations: scale(acceleration),
        waypoint: None,
    }
}

/// Velocity and acceleration limits of a chain's joints, with a note for each assumed one.
pub fn limits(chain: &Chain) -> (Vec<JointLimits>, Vec<String>) {
    let mut notes = Vec::new();
    let mut assumed = |joint: &str, what: &str, value: f64, unit: &str| {
        notes.push(format!("joint {joint:?} has no {what} limit: {value} {unit} assumed"));
        value
    };
    let limits = chain
        .genes()
        .iter()
        .map(|gene| {
            let unit = if gene.kind == crate::robot::JointKind::Prismatic { "m" } else { "rad" };
            JointLimits {
                name: gene.name.clone(),
                lower: gene.lower,
                upper: gene.upper,
                velocity: gene
                    .velocity
                    .unwrap_or_else(|| assumed(&gene.name, "velocity", DEFAULT_VELOCITY, &format!("{unit}/s"))),
                acceleration: gene.acceleration.unwrap_or_else(|| {
                    assumed(&gene.name, "acceleration", DEFAULT_ACCELERATION, &format!("{unit}/s^2"))
                }),
            }
        })
        .collect();
    (limits, notes)
}

fn check_spec(spec: &PlanSpec) -> Result<(), OutOfRange> {
    Range::from(1e-4..=10.0).check("sample_s", Some("s"), spec.sample_s)?;
    Range::from(1e-3..=1.0).check("speed", None, spec.speed)?;
    Range::from(0.0..=60.0).check("dwell_s", Some("s"), spec.dwell_s)
}

fn check_shape(chain: &Chain, start: &[f64], waypoints: &[Vec<f64>]) -> Result<(), TrajectoryError> {
    if waypoints.is_empty() {
        return Err(TrajectoryError::Empty);
    }
    let named = std::iter::once(("start".to_owned(), start))
        .chain(waypoints.iter().enumerate().map(|(i, w)| (i.to_string(), w.as_slice())));
    for (waypoint, values) in named {
        if values.len() != chain.len() {
            return Err(TrajectoryError::Ragged { waypoint, found: values.len(), expected: chain.len() });
        }
        if let Some((gene, &value)) = chain.genes().iter().zip(values).find(|(_, v)| !v.is_finite()) {
            return Err(TrajectoryError::NonFinite { joint: gene.name.clone(), time_s: 0.0, value });
        }
    }
    Ok(())
}
