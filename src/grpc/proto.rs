//! The messages and services `build.rs` generates from `proto/cgda/v1`.

#![expect(clippy::pedantic, clippy::allow_attributes, reason = "generated code; its style is not ours")]

tonic::include_proto!("cgda.v1");

/// The encoded descriptor set, for reflection.
pub const DESCRIPTORS: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/cgda.v1.binpb"));
