//! The command line: one file a command; each reads its input, calls the library, prints.
//!
//! Results go to stdout, progress and errors to stderr. Exit codes: 0 done, 1 failed, 2 wrong usage (clap), 78 refused
//! by a start-up gate.

mod demonstrations;
mod generalize;
mod healthcheck;
mod openapi;
mod recognize;
mod run;
mod serve;

use crate::lifecycle::{EXIT_GATE, GateClosed};
use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Teach robots by showing effects.
#[derive(Debug, Parser)]
#[command(name = "cgda", version, about, max_term_width = 100)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Generalize(Box<generalize::GeneralizeArguments>),
    Recognize(Box<recognize::RecognizeArguments>),
    Run(Box<run::RunArguments>),
    Serve(Box<serve::ServeArguments>),
    Healthcheck(healthcheck::HealthcheckArguments),
    /// Print the OpenAPI 3.1 document of the REST interface.
    Openapi,
}

/// Runs the command and turns its error chain into one readable line on stderr.
#[must_use]
pub fn main(arguments: &Arguments) -> ExitCode {
    let result = match &arguments.command {
        Command::Generalize(arguments) => generalize::run(arguments),
        Command::Recognize(arguments) => recognize::run(arguments),
        Command::Run(arguments) => run::run(arguments),
        Command::Serve(arguments) => serve::run(arguments),
        Command::Healthcheck(arguments) => healthcheck::run(arguments),
        Command::Openapi => openapi::run(),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            if error.is::<GateClosed>() { ExitCode::from(EXIT_GATE) } else { ExitCode::FAILURE }
        }
    }
}
