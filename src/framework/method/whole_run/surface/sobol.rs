//! Sobol's low-discrepancy sequence with a random shift: covers the joint box evenly with few poses.
//!
//! Direction numbers: S. Joe, F. Kuo, SIAM J. Sci. Comput. 30 (2008), DOI 10.1137/070709359, first ten dimensions;
//! further dimensions use independent uniform numbers.

use crate::method::whole_run::space::Space;
use crate::random::RandomStream;

/// Degree, coefficients and initial direction numbers of dimensions 2 to 10.
const PRIMITIVE: [(u32, u32, &[u32]); 9] = [
    (1, 0, &[1]),
    (2, 1, &[1, 3]),
    (3, 1, &[1, 3, 1]),
    (3, 2, &[1, 1, 1]),
    (4, 1, &[1, 1, 3, 3]),
    (4, 4, &[1, 3, 5, 13]),
    (5, 2, &[1, 1, 5, 5, 17]),
    (5, 4, &[1, 1, 5, 5, 5]),
    (5, 7, &[1, 1, 7, 11, 19]),
];
const BITS: u32 = 32;

fn directions(dimension: usize) -> Option<[u32; 32]> {
    let mut v = [0_u32; 32];
    if dimension == 0 {
        for (bit, value) in (0..BITS).zip(&mut v) {
            *value = 1 << (BITS - 1 - bit);
        }
        return Some(v);
    }
    let &(degree, coefficients, initial) = PRIMITIVE.get(dimension - 1)?;
    let s = degree as usize;
    for ((bit, value), &m) in (0..BITS).zip(&mut v).zip(initial) {
        *value = m << (BITS - 1 - bit);
    }
    for bit in s..32 {
        v[bit] = v[bit - s] ^ (v[bit - s] >> degree);
        for k in 1..s {
            if coefficients >> (s - 1 - k) & 1 == 1 {
                v[bit] ^= v[bit - k];
            }
        }
    }
    Some(v)
}

/// Number of poses drawn per pose wanted, if most of the space is forbidden.
const PATIENCE: usize = 16;

/// `count` allowed poses, shifted by one random offset per joint; fewer if hardly any pose is allowed.
pub fn poses(space: &Space, count: usize, random: &mut RandomStream) -> Vec<Vec<f64>> {
    let tables: Vec<Option<[u32; 32]>> = (0..space.len()).map(directions).collect();
    let shifts: Vec<f64> = space.axes.iter().map(|_| random.unit()).collect();
    let mut state = vec![0_u32; space.len()];
    (1..=count * PATIENCE)
        .map(|index| {
            let bit = (index - 1).trailing_ones() as usize;
            let axes = space.axes.iter().zip(&tables).zip(&mut state).zip(&shifts);
            axes.map(|(((axis, table), x), shift)| {
                let unit = if let Some(v) = table {
                    *x ^= v[bit.min(31)];
                    (f64::from(*x) / 2.0_f64.powi(32) + shift).fract()
                } else {
                    random.unit()
                };
                axis.lower + (axis.upper - axis.lower) * unit
            })
            .collect()
        })
        .filter(|pose: &Vec<f64>| space.allows(pose))
        .take(count)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{directions, poses};
    use crate::method::whole_run::space::{Axis, Space};
    use crate::random::RandomStream;
    use std::sync::Arc;

    #[test]
    fn every_dyadic_interval_of_each_joint_is_hit_once() {
        for dimension in 0..10 {
            let v = directions(dimension).unwrap();
            let mut seen = [false; 64];
            let mut x = 0_u32;
            seen[0] = true;
            for index in 0..63_usize {
                x ^= v[index.trailing_ones() as usize];
                let bin = (x >> 26) as usize;
                assert!(!seen[bin], "dimension {dimension}, point {index}");
                seen[bin] = true;
            }
        }
    }

    #[test]
    fn poses_stay_inside_the_limits_in_more_joints_than_the_table_holds() {
        let axis = Axis { lower: -1.0, upper: 2.0, home: 0.0, revolute: true };
        let space = Space::new(vec![axis; 12]);
        let found = poses(&space, 100, &mut RandomStream::of_run(1, 0));
        assert_eq!(found.len(), 100);
        assert!(found.iter().flatten().all(|q| (-1.0..=2.0).contains(q)));
    }

    #[test]
    fn forbidden_poses_are_left_out_and_where_all_are_there_is_none() {
        let axis = Axis { lower: -1.0, upper: 2.0, home: 0.0, revolute: true };
        let space = |least: f64| Space::new(vec![axis; 2]).only(Arc::new(move |pose| pose[0] > least));
        let found = poses(&space(1.0), 100, &mut RandomStream::of_run(1, 0));
        assert!(found.len() == 100 && found.iter().all(|pose| pose[0] > 1.0));
        assert!(poses(&space(2.0), 100, &mut RandomStream::of_run(1, 0)).is_empty());
    }
}
