//! The messages and services `build.rs` generates from `proto/cgda/v1`.

#![expect(clippy::pedantic, reason = "generated code; the style of its generator is not ours")]

tonic::include_proto!("cgda.v1");

/// The encoded descriptor set, for reflection.
pub const DESCRIPTORS: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/cgda.v1.binpb"));
