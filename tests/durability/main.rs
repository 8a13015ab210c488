//! A crash, a stop or a pause must not change results: black-box tests of a server that is killed while it works.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking, helpers included")]

mod experiment;
mod keep_database;
mod kept_database;
mod kill;
mod server;
mod stop;
mod whole_run;
