//! gRPC: one file a service.
//!
//! # Architecture Invariants
//! - A method converts, makes one `app` call and converts back; what a use-case means is decided in `app`.
//! - Radians on the wire, units in the comments of `proto/cgda/v1`.

pub mod proto;
