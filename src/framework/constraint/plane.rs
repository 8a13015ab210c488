//! Half-spaces, the building blocks of regions and hulls.

use nalgebra::Vector3;

/// An open half-space `normal . p < offset`, unit normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Plane {
    pub normal: Vector3<f64>,
    pub offset_m: f64,
}
