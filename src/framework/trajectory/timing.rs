//! The demonstration's timing: goal g is reached one interval after goal g - 1, the first one interval after the start.

use super::waypoint::Waypoint;

/// The interval between the goals of a demonstration.
pub struct Interval<'a> {
    /// Time between two goals, s.
    pub interval_s: f64,
    /// The waypoints to be timed.
    pub waypoints: &'a [Waypoint],
}

impl Interval<'_> {
    /// The waypoints from one goal to the next, as index ranges with the time they should take, s. Waypoints after the
    /// last goal are left out.
    fn groups(&self) -> Vec<(std::ops::Range<usize>, f64)> {
        let (mut from, mut before) = (0, -1.0);
        let mut groups = Vec::new();
        for (index, waypoint) in self.waypoints.iter().enumerate() {
            let Some(goal) = waypoint.goal else { continue };
            // Goals out of order are one interval apart.
            let intervals = (goal as f64 - before).max(1.0);
            groups.push((from..index + 1, intervals * self.interval_s));
            (from, before) = (index + 1, goal as f64);
        }
        groups
    }

    /// A note if goals are late; `times_s` are the waypoints' times.
    pub fn note(&self, times_s: &[f64]) -> Option<String> {
        let groups = self.groups();
        let (mut late, mut before_s) = (0, 0.0);
        for (waypoints, wanted_s) in &groups {
            let reached_s = times_s[waypoints.end - 1];
            late += usize::from(reached_s - before_s > wanted_s * (1.0 + 1e-6));
            before_s = reached_s;
        }
        let wanted_s: f64 = groups.iter().map(|(_, wanted_s)| wanted_s).sum();
        (late > 0).then(|| {
            format!(
                "the demonstration's timing is too fast for the limits at {late} of {} goals: the last goal is reached \
                 after {before_s:.2} s instead of {wanted_s:.2} s",
                groups.len()
            )
        })
    }
}

/// Duration of each leg, s: the least one, or more to keep the interval. `rests_s` is the time at rest after each leg.
pub fn leg_durations(interval: Option<&Interval<'_>>, least_s: &[f64], rests_s: &[f64]) -> Vec<f64> {
    let mut durations_s = least_s.to_vec();
    for (waypoints, wanted_s) in interval.into_iter().flat_map(Interval::groups) {
        // The rest at the goal before is part of the interval, the one at the goal itself is not.
        let resting_s = rests_s[waypoints.start.saturating_sub(1)..waypoints.end - 1].iter().sum::<f64>();
        let moving_s = least_s[waypoints.clone()].iter().sum::<f64>();
        let left_s = wanted_s - resting_s;
        if left_s <= moving_s {
            continue;
        }
        let legs = waypoints.len() as f64;
        for duration_s in &mut durations_s[waypoints] {
            *duration_s = if moving_s > 0.0 { *duration_s * (left_s / moving_s) } else { left_s / legs };
        }
    }
    durations_s
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn legs_between_goals_share_the_interval_and_hasty_ones_are_told() {
        let via = Waypoint { joints: vec![], goal: None, rest: false };
        let waypoints = [Waypoint::goal(0, vec![]), via, Waypoint::goal(1, vec![]), Waypoint::goal(3, vec![])];
        let interval = Interval { interval_s: 2.0, waypoints: &waypoints };
        // Goal 1 after 0.5 s at rest: 1.5 s are shared by legs of 0.25 s and 0.5 s. Goal 3 should take two intervals.
        let durations_s = leg_durations(Some(&interval), &[1.0, 0.25, 0.5, 5.0], &[0.5, 0.0, 0.5, 0.5]);
        assert_eq!(durations_s, [2.0, 0.5, 1.0, 5.0]);
        assert_eq!(interval.note(&[2.0, 3.0, 4.0, 8.0]), None);
        let note = interval.note(&[2.0, 3.0, 4.0, 9.5]).unwrap();
        assert!(note.contains("at 1 of 3 goals") && note.contains("9.50 s instead of 8.00 s"), "{note}");
    }
}
