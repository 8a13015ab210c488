//! The surface of a coverage world as an obstacle: a solid behind the cells, which the tool may come close to but not
//! pass.

use super::error::CollisionError;
use super::obstacle::{HullObstacle, Obstacle, ObstacleShape};
use crate::robot::{Chain, tool_position};
use crate::world::CoverageSpec;
use nalgebra::Vector3;

/// Smallest distance of the tool at home from the plane of a surface, metres.
const MIN_SIDE_M: f64 = 1e-6;

/// The surface of `spec` as a hull. Its front is the plane of the cells, beyond the outer centres by half a cell or by
/// the radius of the tool's effect, whichever is more; its back lies `thickness_m` farther from the side where the tool
/// of `chain` is at home. If it is at least as thick as that radius, no cell is within reach of the tool from behind.
///
/// # Errors
/// [`CollisionError`] if the steps span no plane or the tool at home lies in it. Other faults of the numbers are found
/// when the obstacle is used.
pub fn surface_obstacle(
    name: &str,
    spec: &CoverageSpec,
    chain: &Chain,
    thickness_m: f64,
) -> Result<Obstacle, CollisionError> {
    let [origin, column, row] = [spec.origin_m, spec.column_step_m, spec.row_step_m].map(Vector3::from);
    let parallel = (column.norm() * row.norm() * 1e-9).max(f64::MIN_POSITIVE);
    let area = column.cross(&row).norm();
    let normal = column.cross(&row).try_normalize(parallel);
    let normal = normal.ok_or_else(|| CollisionError::NoPlane { obstacle: name.to_owned() })?;
    let side = normal.dot(&(tool_position(chain, chain.home()) - origin));
    if side.abs() < MIN_SIDE_M {
        return Err(CollisionError::NoSide { obstacle: name.to_owned() });
    }
    let back = normal * (-side.signum() * thickness_m);
    let [columns, rows] = [f64::from(spec.columns), f64::from(spec.rows)];
    // A strip of width w along the rows is w |row| / area columns wide.
    let (beside, above) = (spec.radius_m * row.norm() / area, spec.radius_m * column.norm() / area);
    let (beside, above) = (beside.max(0.5), above.max(0.5));
    let across = [-beside, columns - 1.0 + beside];
    let along = [-above, rows - 1.0 + above];
    let front = across.into_iter().flat_map(|c| along.map(|r| origin + column * c + row * r)).collect::<Vec<_>>();
    let points_m = front.iter().flat_map(|corner| [*corner, corner + back]).map(Into::into).collect();
    Ok(Obstacle { name: name.to_owned(), shape: ObstacleShape::Hull(HullObstacle { points_m }) })
}
