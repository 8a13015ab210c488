//! Worlds.

use super::{all, finite, required, triple};
use crate::app::model::{AppError, CreateWorld, WorldView};
use crate::framework::world::{CoverageSpec, SurfaceView, ToolPositionSpec, WorldSpec};
use crate::grpc::proto;
use proto::world_spec::Kind;

/// A new world.
pub fn create(request: proto::CreateWorldRequest) -> Result<CreateWorld, AppError> {
    let kind = required("/spec", request.spec.and_then(|spec| spec.kind))?;
    Ok(CreateWorld { name: request.name, spec: spec(kind)? })
}

fn spec(kind: Kind) -> Result<WorldSpec, AppError> {
    Ok(match kind {
        Kind::ToolPosition(world) => WorldSpec::ToolPosition(ToolPositionSpec { unit: world.unit }),
        Kind::Coverage(world) => WorldSpec::Coverage(CoverageSpec {
            origin_m: triple("/spec/origin_m", &world.origin_m)?,
            column_step_m: triple("/spec/column_step_m", &world.column_step_m)?,
            row_step_m: triple("/spec/row_step_m", &world.row_step_m)?,
            columns: world.columns,
            rows: world.rows,
            radius_m: finite("/spec/radius_m", world.radius_m)?,
            resets: world.resets.unwrap_or(true),
            observes: match world.observes() {
                proto::SurfaceView::Cells => SurfaceView::Cells,
                proto::SurfaceView::Percent | proto::SurfaceView::Unspecified => SurfaceView::Percent,
            },
        }),
    })
}

impl From<WorldSpec> for proto::WorldSpec {
    fn from(spec: WorldSpec) -> Self {
        let kind = match spec {
            WorldSpec::ToolPosition(world) => Kind::ToolPosition(proto::ToolPositionWorld { unit: world.unit }),
            WorldSpec::Coverage(world) => Kind::Coverage(proto::CoverageWorld {
                origin_m: world.origin_m.to_vec(),
                column_step_m: world.column_step_m.to_vec(),
                row_step_m: world.row_step_m.to_vec(),
                columns: world.columns,
                rows: world.rows,
                radius_m: world.radius_m,
                resets: Some(world.resets),
                observes: match world.observes {
                    SurfaceView::Percent => proto::SurfaceView::Percent,
                    SurfaceView::Cells => proto::SurfaceView::Cells,
                }
                .into(),
            }),
        };
        Self { kind: Some(kind) }
    }
}

impl From<WorldView> for proto::World {
    fn from(view: WorldView) -> Self {
        Self {
            id: view.id.into(),
            name: view.name,
            spec: Some(view.spec.into()),
            features: all(view.features),
            created_at_ms: view.created_at.0,
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
