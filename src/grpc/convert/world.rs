//! Conversion of worlds.

use super::enumeration::{Enumeration as _, or_default};
use super::{all, finite, required, time, triple};
use crate::app::model::{AppError, CreateWorld, WorldView};
use crate::framework::world::{CoverageSpec, ToolDistanceSpec, ToolPositionSpec, WorldSpec};
use crate::grpc::proto;
use proto::world_spec::Kind;

/// A new world.
///
/// # Errors
/// `Invalid` for a message without a kind, with another number of coordinates than 3 or a number that is not finite.
pub fn create(request: proto::CreateWorldRequest) -> Result<CreateWorld, AppError> {
    let proto::CreateWorldRequest { name, spec } = request;
    let kind = required("/spec", spec.and_then(|proto::WorldSpec { kind }| kind))?;
    Ok(CreateWorld { name, spec: self::spec(kind)? })
}

fn spec(kind: Kind) -> Result<WorldSpec, AppError> {
    match kind {
        Kind::ToolPosition(proto::ToolPositionWorld { unit }) => Ok(WorldSpec::ToolPosition(ToolPositionSpec { unit })),
        Kind::ToolDistance(proto::ToolDistanceWorld { point_m, unit }) => {
            Ok(WorldSpec::ToolDistance(ToolDistanceSpec { point_m: triple("/spec/point_m", &point_m)?, unit }))
        }
        Kind::Coverage(world) => coverage(world).map(WorldSpec::Coverage),
    }
}

fn coverage(world: proto::CoverageWorld) -> Result<CoverageSpec, AppError> {
    let proto::CoverageWorld { origin_m, column_step_m, row_step_m, columns, rows, radius_m, resets, observes } = world;
    Ok(CoverageSpec {
        origin_m: triple("/spec/origin_m", &origin_m)?,
        column_step_m: triple("/spec/column_step_m", &column_step_m)?,
        row_step_m: triple("/spec/row_step_m", &row_step_m)?,
        columns,
        rows,
        radius_m: finite("/spec/radius_m", radius_m)?,
        resets: resets.unwrap_or(true),
        observes: or_default("/spec/observes", observes)?,
    })
}

impl From<WorldSpec> for proto::WorldSpec {
    fn from(spec: WorldSpec) -> Self {
        let kind = match spec {
            WorldSpec::ToolPosition(ToolPositionSpec { unit }) => Kind::ToolPosition(proto::ToolPositionWorld { unit }),
            WorldSpec::ToolDistance(ToolDistanceSpec { point_m, unit }) => {
                Kind::ToolDistance(proto::ToolDistanceWorld { point_m: point_m.to_vec(), unit })
            }
            WorldSpec::Coverage(spec) => Kind::Coverage(spec.into()),
        };
        Self { kind: Some(kind) }
    }
}

impl From<CoverageSpec> for proto::CoverageWorld {
    fn from(spec: CoverageSpec) -> Self {
        let CoverageSpec { origin_m, column_step_m, row_step_m, columns, rows, radius_m, resets, observes } = spec;
        Self {
            origin_m: origin_m.to_vec(),
            column_step_m: column_step_m.to_vec(),
            row_step_m: row_step_m.to_vec(),
            columns,
            rows,
            radius_m,
            resets: Some(resets),
            observes: observes.number(),
        }
    }
}

impl From<WorldView> for proto::World {
    fn from(view: WorldView) -> Self {
        let WorldView { id, name, spec, features, created_at } = view;
        Self {
            id: id.into(),
            name,
            spec: Some(spec.into()),
            features: all(features),
            created_at: Some(time(created_at)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spec_survives_the_wire_and_resets_by_default() {
        let json = serde_json::json!({"kind": "coverage", "origin_m": [0.6, -0.8, 0.32],
            "column_step_m": [0.0, 0.2, 0.0], "row_step_m": [0.0, 0.0, 0.2], "columns": 4, "rows": 4, "radius_m": 0.13});
        let before: WorldSpec = serde_json::from_value(json).unwrap();
        let mut message = proto::WorldSpec::from(before.clone());
        if let Some(Kind::Coverage(world)) = &mut message.kind {
            world.resets = None;
        }
        assert_eq!(spec(message.kind.unwrap()).unwrap(), before);
        assert!(create(proto::CreateWorldRequest::default()).is_err());
    }
}
