//! The `cgda` binary: parses the arguments and runs the command.

use clap::Parser as _;
use std::process::ExitCode;

fn main() -> ExitCode {
    cgda::cli::main(&cgda::cli::Arguments::parse())
}
