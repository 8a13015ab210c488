//! Time parameterisation: from poses to a motion within the limits of velocity, acceleration and jerk.
//!
//! Stopping at each waypoint, all joints share one time-optimal profile ([`super::profile`]) along the straight line
//! between two poses. Blending, they pass the waypoints on quintics ([`super::blend`]). With the demonstration's timing,
//! the way from one goal to the next is stretched to the interval between the demonstrated goals.

use super::blend::Route;
use super::checked::{CheckedTrajectory, Planned};
use super::error::TrajectoryError;
use super::limits::{JointLimits, limits_under};
use super::piece::{Piece, State, at_time};
use super::point::Point;
use super::polynomial::Polynomial;
use super::profile::DoubleS;
use super::spec::{PlanSpec, Timing};
use super::timing::{Interval, leg_durations};
use super::waypoint::Waypoint;
use crate::robot::Chain;

/// Maximum number of samples of a trajectory.
const MAX_SAMPLES: f64 = 1e6;

/// Joins `start` (n values, rad or m) and the waypoints into a trajectory within the chain's limits, and checks it.
/// `interval_s` is the time between two goals of the demonstrations; `None` if it is unknown.
///
/// # Errors
/// [`TrajectoryError`] with joint, time, value and limit, for example if a waypoint is outside the position limits.
pub fn plan(
    chain: &Chain,
    start: &[f64],
    waypoints: &[Waypoint],
    interval_s: Option<f64>,
    spec: &PlanSpec,
) -> Result<CheckedTrajectory, TrajectoryError> {
    spec.check(chain)?;
    check_shape(chain, start, waypoints)?;
    let (limits, mut notes) = limits_under(chain, spec);
    let shared: Vec<JointLimits> = limits.iter().map(|limit| limit.shared(spec)).collect();
    let interval = match (spec.timing, interval_s) {
        (Timing::Demonstration, Some(interval_s)) => Some(Interval { interval_s, waypoints }),
        (Timing::Demonstration, None) => {
            notes.push("the goals do not say how long their demonstrations took: the limits decide".to_owned());
            None
        }
        (Timing::Limits, _) => None,
    };
    let mut motion = Motion::from(start, spec.sample_s);
    if spec.blend {
        motion.pass(waypoints, &shared, interval.as_ref())?;
    } else {
        motion.stop(waypoints, &shared, interval.as_ref(), spec.dwell_s)?;
    }
    notes.extend(interval.and_then(|interval| interval.note(&motion.times_s)));
    motion.end();
    let planned = Planned {
        fixed_joints: chain.fixed_joints().iter().cloned().collect(),
        pieces: motion.pieces,
        points: motion.points,
        waypoint_times_s: motion.times_s,
        goals: waypoints.iter().map(|waypoint| waypoint.goal).collect(),
        notes,
    };
    CheckedTrajectory::new(&limits, planned)
}

/// Writes to `pose` where the joints are `lag_s` before they come to rest at `to`, on the fastest motion from `from` (n
/// values, rad or m).
pub(crate) fn late(limits: &[JointLimits], from: &[f64], to: &[f64], lag_s: f64, pose: &mut [f64]) {
    let share =
        DoubleS::between(from, to, limits).map_or(1.0, |profile| profile.share_at(profile.duration_s() - lag_s));
    pose.iter_mut()
        .zip(from.iter().zip(to))
        .for_each(|(p, (a, b))| *p = if share < 1.0 { a + (b - a) * share } else { *b });
}

/// A motion under construction.
struct Motion {
    pieces: Vec<Piece>,
    points: Vec<Point>,
    /// Time of each waypoint so far, s.
    times_s: Vec<f64>,
    /// Number of waypoints so far that ask for rest.
    rests: usize,
    /// Pose at the end so far.
    pose: Vec<f64>,
    end_s: f64,
    sample_s: f64,
}

impl Motion {
    fn from(start: &[f64], sample_s: f64) -> Self {
        let points = vec![Point::new(0.0, State::at_rest(start))];
        Self { pieces: Vec::new(), points, times_s: Vec::new(), rests: 0, pose: start.to_vec(), end_s: 0.0, sample_s }
    }

    /// Stops at each waypoint.
    fn stop(
        &mut self,
        waypoints: &[Waypoint],
        limits: &[JointLimits],
        interval: Option<&Interval<'_>>,
        dwell_s: f64,
    ) -> Result<(), TrajectoryError> {
        let starts = std::iter::once(self.pose.clone()).chain(waypoints.iter().map(|w| w.joints.clone()));
        let profiles: Vec<Option<DoubleS>> =
            starts.zip(waypoints).map(|(from, to)| DoubleS::between(&from, &to.joints, limits)).collect();
        let least_s: Vec<f64> = profiles.iter().map(|p| p.map_or(0.0, |profile| profile.duration_s())).collect();
        let rests_s: Vec<f64> = waypoints.iter().map(|w| if w.rest { dwell_s } else { 0.0 }).collect();
        let durations_s = leg_durations(interval, &least_s, &rests_s);
        for (index, waypoint) in waypoints.iter().enumerate() {
            let pieces = match profiles[index] {
                Some(profile) => self.straight(&profile, &waypoint.joints, durations_s[index] / least_s[index]),
                None => self.still(durations_s[index]),
            };
            self.add(pieces, State::at_rest(&waypoint.joints))?;
            self.reach(waypoint);
            if rests_s[index] > 0.0 && index + 1 < waypoints.len() {
                let still = self.still(rests_s[index]);
                self.add(still, State::at_rest(&waypoint.joints))?;
            }
        }
        Ok(())
    }

    /// Passes the waypoints, and rests at the last one.
    fn pass(
        &mut self,
        waypoints: &[Waypoint],
        limits: &[JointLimits],
        interval: Option<&Interval<'_>>,
    ) -> Result<(), TrajectoryError> {
        let starts = std::iter::once(self.pose.clone()).chain(waypoints.iter().map(|w| w.joints.clone()));
        let starts: Vec<Vec<f64>> = starts.collect();
        let straight_s: Vec<f64> = starts
            .windows(2)
            .map(|pair| DoubleS::between(&pair[0], &pair[1], limits).map_or(0.0, |profile| profile.duration_s()))
            .collect();
        let least_s = match interval {
            Some(_) => leg_durations(interval, &straight_s, &vec![0.0; waypoints.len()]),
            None => vec![0.0; waypoints.len()],
        };
        // The waypoint of a leg that takes no time is reached together with the one before.
        let legs: Vec<usize> = (0..waypoints.len()).filter(|&leg| straight_s[leg].max(least_s[leg]) > 0.0).collect();
        let mut pieces = Vec::new();
        if !legs.is_empty() {
            let route = Route {
                knots: std::iter::once(starts[0].as_slice())
                    .chain(legs.iter().map(|&leg| starts[leg + 1].as_slice()))
                    .collect(),
                straight_s: legs.iter().map(|&leg| straight_s[leg].max(least_s[leg])).collect(),
                least_s: legs.iter().map(|&leg| least_s[leg]).collect(),
                limits,
            };
            pieces = route.pieces();
        }
        let states: Vec<State> = pieces.iter().map(|piece| piece.state(piece.start_s)).collect();
        let mut pieces = pieces.into_iter().zip(states.into_iter().skip(1).map(Some).chain([None]));
        for (index, waypoint) in waypoints.iter().enumerate() {
            if legs.contains(&index)
                && let Some((piece, state)) = pieces.next()
            {
                self.add(vec![piece], state.unwrap_or_else(|| State::at_rest(&waypoint.joints)))?;
            }
            self.reach(waypoint);
        }
        Ok(())
    }

    /// The straight motion from the present pose, `slower` times slower than the profile.
    fn straight(&self, profile: &DoubleS, to: &[f64], slower: f64) -> Vec<Piece> {
        let phases = profile.phases().into_iter().map(|phase| {
            let [c0, c1, c2, c3] = phase.coefficients;
            let shares = [c0, c1 / slower, c2 / slower.powi(2), c3 / slower.powi(3)];
            let joint = |(from, to): (&f64, &f64)| {
                let [s0, s1, s2, s3] = shares.map(|share| share * (to - from));
                Polynomial([from + s0, s1, s2, s3, 0.0, 0.0])
            };
            Piece {
                start_s: self.end_s + phase.start_s * slower,
                duration_s: phase.duration_s * slower,
                joints: self.pose.iter().zip(to).map(joint).collect(),
            }
        });
        phases.collect()
    }

    /// No motion for `duration_s`.
    fn still(&self, duration_s: f64) -> Vec<Piece> {
        let joints = self.pose.iter().map(|q| Polynomial::constant(*q)).collect();
        let piece = Piece { start_s: self.end_s, duration_s, joints };
        if duration_s > 0.0 { vec![piece] } else { Vec::new() }
    }

    /// Appends pieces that end in `end`, and their samples.
    fn add(&mut self, pieces: Vec<Piece>, end: State) -> Result<(), TrajectoryError> {
        self.pose.clone_from(&end.positions);
        let Some(last) = pieces.last() else { return Ok(()) };
        let (start_s, end_s) = (self.end_s, last.start_s + last.duration_s);
        let is_still = pieces.iter().all(|piece| piece.joints.iter().all(|joint| joint.derivative().0 == [0.0; 6]));
        let steps = if is_still { 1.0 } else { ((end_s - start_s) / self.sample_s).ceil().max(1.0) };
        if steps + self.points.len() as f64 > MAX_SAMPLES {
            return Err(TrajectoryError::TooManySamples { sample_s: self.sample_s });
        }
        for step in (1_u32..).map(f64::from).take_while(|&step| step < steps) {
            let time_s = start_s + (end_s - start_s) * (step / steps);
            self.points.push(Point::new(time_s, at_time(&pieces, time_s).state(time_s)));
        }
        self.points.push(Point::new(end_s, end));
        self.pieces.extend(pieces);
        self.end_s = end_s;
        Ok(())
    }

    /// Marks the last sample as the place of a waypoint.
    fn reach(&mut self, waypoint: &Waypoint) {
        self.times_s.push(self.end_s);
        if let Some(last) = self.points.last_mut() {
            last.goal = waypoint.goal.or(last.goal);
            if waypoint.rest {
                last.waypoint = Some(self.rests);
                self.rests += 1;
            }
        }
    }

    /// Holds the pose for one sample if nothing has moved.
    fn end(&mut self) {
        if self.pieces.is_empty() {
            self.pieces = self.still(self.sample_s);
            self.points.push(Point::new(self.sample_s, State::at_rest(&self.pose)));
        }
    }
}

fn check_shape(chain: &Chain, start: &[f64], waypoints: &[Waypoint]) -> Result<(), TrajectoryError> {
    if waypoints.is_empty() {
        return Err(TrajectoryError::Empty);
    }
    let named = std::iter::once(("start".to_owned(), start))
        .chain(waypoints.iter().enumerate().map(|(i, w)| (i.to_string(), w.joints.as_slice())));
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
