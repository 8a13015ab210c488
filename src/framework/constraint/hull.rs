//! Convex hull of points as half-spaces, by definition: every plane through three points with all others on one side.
//!
//! O(k^4) for k points: a tenth of a second at the limit of 128, once per job, and simple enough to be obviously right.
//! A quickhull (parry's) would be faster for thousands of points, which no hand-written constraint has.

use super::error::ConstraintError;
use super::plane::Plane;
use nalgebra::Vector3;

/// Maximum number of points of a hull.
pub(super) const MAX_POINTS: usize = 128;
/// Points closer to a plane than this share of the cloud's size count as lying on it.
const ON_PLANE: f64 = 1e-9;

/// Faces of the hull of `points` (m): every point satisfies `normal . p <= offset_m` up to rounding.
///
/// # Errors
/// [`ConstraintError::HullPoints`] for fewer than 4 or more than [`MAX_POINTS`] points, [`ConstraintError::FlatHull`]
/// for points in one plane.
pub(super) fn planes(points: &[Vector3<f64>]) -> Result<Vec<Plane>, ConstraintError> {
    if !(4..=MAX_POINTS).contains(&points.len()) {
        return Err(ConstraintError::HullPoints { found: points.len(), limit: MAX_POINTS });
    }
    let centre = points.iter().sum::<Vector3<f64>>() / points.len() as f64;
    let size = points.iter().map(|p| (p - centre).norm()).fold(0.0, f64::max);
    let mut faces: Vec<Plane> = Vec::new();
    for a in 0..points.len() {
        for b in a + 1..points.len() {
            for c in b + 1..points.len() {
                if let Some(face) = face(points, [a, b, c], size)
                    && !faces.iter().any(|known| same(known, &face, size))
                {
                    faces.push(face);
                }
            }
        }
    }
    let inside = |face: &Plane| face.normal.dot(&centre) < face.offset_m - ON_PLANE * size;
    if faces.len() < 4 || !faces.iter().all(inside) {
        return Err(ConstraintError::FlatHull { points: points.len() });
    }
    Ok(faces)
}

/// The plane through three points, facing outwards; `None` if points lie on both sides.
fn face(points: &[Vector3<f64>], corners: [usize; 3], size: f64) -> Option<Plane> {
    let [a, b, c] = corners.map(|corner| points[corner]);
    let across = (b - a).cross(&(c - a));
    if across.norm() <= ON_PLANE * size * size {
        return None;
    }
    let mut normal = across.normalize();
    let mut offset_m = normal.dot(&a);
    let (mut below, mut above) = (false, false);
    for point in points {
        let distance = normal.dot(point) - offset_m;
        below |= distance < -ON_PLANE * size;
        above |= distance > ON_PLANE * size;
        if below && above {
            return None;
        }
    }
    if above {
        (normal, offset_m) = (-normal, -offset_m);
    }
    Some(Plane { normal, offset_m })
}

fn same(known: &Plane, face: &Plane, size: f64) -> bool {
    (known.normal - face.normal).norm() < 1e-6 && (known.offset_m - face.offset_m).abs() < 1e-6 * size
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn violation(planes: &[Plane], point: &Vector3<f64>) -> f64 {
        planes.iter().map(|p| p.normal.dot(point) - p.offset_m).fold(f64::NEG_INFINITY, f64::max)
    }

    #[test]
    fn a_tetrahedron_has_four_faces_and_a_cube_six() {
        let unit = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
        let faces = planes(&unit).unwrap();
        assert_eq!(faces.len(), 4);
        assert!((violation(&faces, &Vector3::new(1.0, 1.0, 1.0)) - 2.0 / 3.0_f64.sqrt()).abs() < 1e-12);
        let cube: Vec<_> = (0..8).map(|c| Vector3::from([0, 1, 2].map(|axis| f64::from(c >> axis & 1)))).collect();
        assert_eq!(planes(&cube).unwrap().len(), 6);
    }

    #[test]
    fn flat_and_few_points_are_refused() {
        let flat: Vec<_> = (0..9).map(|i| Vector3::new(f64::from(i % 3), f64::from(i / 3), 0.5)).collect();
        assert!(matches!(planes(&flat), Err(ConstraintError::FlatHull { points: 9 })));
        assert!(matches!(planes(&flat[..3]), Err(ConstraintError::HullPoints { found: 3, .. })));
        assert!(matches!(planes(&vec![Vector3::x(); 129]), Err(ConstraintError::HullPoints { found: 129, .. })));
    }

    proptest! {
        #[test]
        fn holds_every_mixture_of_its_points_and_nothing_beyond_a_support(
            points in prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64), 6..16),
            weights in prop::collection::vec(0.001..1.0_f64, 16),
            toward in prop::array::uniform3(-1.0..1.0_f64),
        ) {
            let points: Vec<_> = points.into_iter().map(Vector3::from).collect();
            let Ok(faces) = planes(&points) else { return Ok(()) };
            let total: f64 = weights[..points.len()].iter().sum();
            let mixture = points.iter().zip(&weights).map(|(p, w)| p * (w / total)).sum::<Vector3<f64>>();
            prop_assert!(violation(&faces, &mixture) < 1e-9);
            let toward = Vector3::from(toward);
            prop_assume!(toward.norm() > 0.1);
            let support = points.iter().map(|p| p.dot(&toward)).fold(f64::NEG_INFINITY, f64::max);
            let beyond = toward * ((support + 1e-3) / toward.norm_squared());
            prop_assert!(violation(&faces, &beyond) > 0.0, "a point beyond the support is outside");
        }
    }
}
