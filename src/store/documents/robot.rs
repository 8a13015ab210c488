//! One version of a robot; its URDF is kept beside it.
//!
//! Its specification and its summaries are stored as the core writes them, see [`super::job`].

use super::{document, unchanged, versions};
use crate::app::model::{RobotId, RobotView, Timestamp};
use crate::framework::robot::{ChainSummary, RobotSpec, RobotSummary};

document! {
    /// A robot without its URDF.
    Robot keeps RobotView {
        id: RobotId,
        name: String,
        version: u32,
        spec: RobotSpec,
        chain: ChainSummary,
        summary: RobotSummary,
        urdf_sha256: String,
        created_at: Timestamp,
    }
}
versions! { Robot keeps RobotView, "robot", [unchanged, unchanged] }
