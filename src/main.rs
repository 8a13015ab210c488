//! The `cgda` binary: parse, set up telemetry, run the command.

use clap::Parser as _;
use std::process::ExitCode;

fn main() -> ExitCode {
    cgda::cli::main(&cgda::cli::Arguments::parse())
}
