//! The Euclidean distance, for all who need it: summed from the first value to the last, so that every use gives the
//! same bits.

/// Distance of two rows of equal length, in the unit of their values.
#[must_use]
pub fn distance(a: &[f64], b: &[f64]) -> f64 {
    squared_distance(a, b).sqrt()
}

/// Squared distance of two rows of equal length.
#[inline]
#[must_use]
pub fn squared_distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum()
}

#[cfg(test)]
mod tests {
    use super::{distance, squared_distance};

    #[test]
    fn three_and_four_are_five_apart() {
        assert_eq!(squared_distance(&[1.0, 1.0], &[4.0, 5.0]).to_bits(), 25.0_f64.to_bits());
        assert_eq!(distance(&[1.0, 1.0], &[4.0, 5.0]).to_bits(), 5.0_f64.to_bits());
    }
}
