//! Black-box tests: the real binary, driven over HTTP and gRPC by real clients.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking, helpers included")]

mod answers;
mod auth;
mod clients;
mod errors;
mod events;
mod few_evaluations;
mod health;
mod jobs;
mod joint_trajectory;
mod main_job;
mod paging;
mod parity;
mod server;
mod work;
