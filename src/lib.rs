//! `cgda` teaches robots from demonstrations of *effects* (Continuous Goal-Directed Actions) and finds the joint
//! trajectory with which a given robot produces the same effects (Incrementally Evolved Trajectories).
//!
//! # The map
//! | folder | content | may import |
//! |---|---|---|
//! | [`framework`] | CGDA itself: pure science, no I/O; the package `cgda-core` | nothing of ours |
//! | [`reproduce`] | the paper: shipped presets, its tables and figures | `framework` |
//! | [`app`] | the one service layer: use cases and ports | `framework`, `reproduce` |
//! | [`store`], [`evaluate`], [`jobs`] | implementations of the ports | `app`, `framework` |
//! | [`http`], [`grpc`] | thin edges: extract, one `app` call, convert | `app`, value types of `framework` |
//! | [`config`], [`telemetry`], [`lifecycle`], [`cli`] | wiring | everything |
//!
//! # Architecture Invariants
//! - `framework` never reads a clock, a file, the environment or a global random source, and never logs: the same input
//!   and seed give the same bits, after a kill and resume and on any number of threads.
//! - `http` and `grpc` never access `store` or each other: a use case is written once, in `app`.
//! - SI units and radians inside; every name that crosses a boundary carries its unit.
//!
//! `tests/tidy` enforces these.

pub mod app;
pub mod cli;
pub mod config;
pub mod evaluate;
pub mod grpc;
pub mod http;
pub mod jobs;
pub mod lifecycle;
pub mod reproduce;
pub mod store;
pub mod telemetry;

pub use cgda_core as framework;
