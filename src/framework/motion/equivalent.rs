//! Equivalent poses: a joint that has turned once more holds the tool in the same place.
//!
//! Of all sequences of equivalent poses, the one with the least motion is found per joint by a dynamic programme over
//! the turns: joints turn independently of one another, and the cost of a move is the time that the joint takes at its
//! velocity limit, so that the sum over the joints and the moves is least. The move from the start counts half: if a joint
//! has to unwind, it does so on its way to the first pose, not between two goals.

use crate::robot::{Chain, Gene};
use crate::trajectory::DEFAULT_VELOCITY;
use std::f64::consts::TAU;

/// Weight of the move from the start.
const APPROACH: f64 = 0.5;
/// Largest number of turns to add or take away.
const MOST_TURNS: i32 = 32;

/// `poses` (joints in gene order, rad or m) with each joint moved by whole turns within its range, so that the motion
/// from `start` through all of them is least. Poses whose joints have less than a turn of freedom stay bit for bit.
#[must_use]
pub fn nearest(chain: &Chain, start: &[f64], poses: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut nearest = poses.to_vec();
    for (index, gene) in chain.genes().iter().enumerate() {
        if !chain.repeats(index) {
            continue;
        }
        let positions: Vec<f64> = poses.iter().map(|pose| pose[index]).collect();
        let turns = least_motion(gene, start[index], &positions);
        for (pose, turn) in nearest.iter_mut().zip(turns).filter(|(_, turn)| *turn != 0) {
            pose[index] += f64::from(turn) * TAU;
        }
    }
    nearest
}

/// Whole turns to add to each of `positions` for the least motion; of equal ones the first, and no turn before others.
fn least_motion(gene: &Gene, start: f64, positions: &[f64]) -> Vec<i32> {
    let velocity = gene.velocity.unwrap_or(DEFAULT_VELOCITY);
    let choices: Vec<Vec<i32>> = positions.iter().map(|position| turns(gene, *position)).collect();
    let at = |goal: usize, turn: i32| positions[goal] + f64::from(turn) * TAU;
    // Per goal and choice: least cost up to it, and the choice of the goal before.
    let mut table: Vec<Vec<(f64, usize)>> = Vec::with_capacity(positions.len());
    for (goal, turns) in choices.iter().enumerate() {
        let reach = |&turn: &i32| {
            let here = at(goal, turn);
            let weight = if goal == 0 { APPROACH } else { 1.0 };
            let from = |(index, (cost, before)): (usize, (f64, f64))| {
                (cost + weight * (here - before).abs() / velocity, index)
            };
            let before: Vec<(f64, f64)> = match goal.checked_sub(1) {
                None => vec![(0.0, start)],
                Some(last) => table[last].iter().zip(&choices[last]).map(|(c, t)| (c.0, at(last, *t))).collect(),
            };
            before.into_iter().enumerate().map(from).fold((f64::INFINITY, 0), |a, b| if b.0 < a.0 { b } else { a })
        };
        let row = turns.iter().map(reach).collect();
        table.push(row);
    }
    let mut chosen = vec![0; positions.len()];
    let mut choice = table.last().map_or(0, |row| first_least(row));
    for goal in (0..positions.len()).rev() {
        chosen[goal] = choices[goal][choice];
        choice = table[goal][choice].1;
    }
    chosen
}

fn first_least(row: &[(f64, usize)]) -> usize {
    (0..row.len()).reduce(|best, index| if row[index].0 < row[best].0 { index } else { best }).unwrap_or(0)
}

/// Whole turns that keep `position` within the range of `gene`; no turn comes first.
fn turns(gene: &Gene, position: f64) -> Vec<i32> {
    let [lower, upper] = gene.motion_range();
    let inside = |turn: &i32| (lower..=upper).contains(&(position + f64::from(*turn) * TAU));
    let others = (1..=MOST_TURNS).flat_map(|turn| [-turn, turn]).filter(inside);
    std::iter::once(0).chain(others).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::JointKind;
    use proptest::prelude::*;

    fn gene(kind: JointKind, lower: f64, upper: f64) -> Gene {
        Gene { name: "j".to_owned(), kind, lower, upper, velocity: Some(2.0), acceleration: None, jerk: None }
    }

    #[test]
    fn a_joint_of_two_turns_takes_the_short_way() {
        let joint = gene(JointKind::Revolute, -TAU, TAU);
        let turns = least_motion(&joint, 3.0, &[-3.0, -2.9, 2.9]);
        assert_eq!(turns, [1, 1, 0]);
    }

    #[test]
    fn a_short_first_move_does_not_pay_for_a_long_second_one() {
        // From 0.2 the nearest pose of -3 is itself, but the goal after it can only be reached from the other side.
        let joint = gene(JointKind::Revolute, -3.1, 6.0);
        assert_eq!(least_motion(&joint, 0.2, &[-3.0, 5.5]), [1, 0]);
    }

    #[test]
    fn a_joint_that_has_to_unwind_does_so_before_the_first_goal() {
        let joint = gene(JointKind::Revolute, -TAU, TAU);
        assert_eq!(least_motion(&joint, 6.1, &[6.2, 0.1, 0.2]), [-1, 0, 0]);
    }

    #[test]
    fn limits_hold_and_joints_of_less_than_a_turn_stay() {
        let joint = gene(JointKind::Revolute, -3.1, 3.1);
        assert_eq!(least_motion(&joint, 3.0, &[-3.0, 3.0]), [0, 0]);
        let endless = gene(JointKind::Continuous, -std::f64::consts::PI, std::f64::consts::PI);
        assert_eq!(least_motion(&endless, 3.0, &[-3.0, 3.0, -3.0]), [1, 0, 1]);
    }

    /// Least weighted motion over all choices, by trying them all.
    fn by_force(joint: &Gene, start: f64, positions: &[f64], weight: f64) -> f64 {
        let Some((first, rest)) = positions.split_first() else { return 0.0 };
        let cost = |turn: i32| {
            let here = first + f64::from(turn) * TAU;
            weight * (here - start).abs() + by_force(joint, here, rest, 1.0)
        };
        turns(joint, *first).into_iter().map(cost).fold(f64::INFINITY, f64::min)
    }

    proptest! {
        #[test]
        fn no_choice_of_turns_moves_less(
            start in -6.0..6.0_f64, positions in prop::collection::vec(-6.2..6.2_f64, 1..5)
        ) {
            let joint = gene(JointKind::Revolute, -TAU, TAU);
            let chosen = least_motion(&joint, start, &positions);
            let path: Vec<f64> = positions.iter().zip(chosen).map(|(q, turn)| q + f64::from(turn) * TAU).collect();
            let between: f64 = path.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
            let total = APPROACH * (path[0] - start).abs() + between;
            prop_assert!(total <= by_force(&joint, start, &positions, APPROACH) + 1e-9);
            prop_assert!(path.iter().all(|q| q.abs() <= TAU));
        }
    }
}
