//! The command line, one file per command: each reads its input, calls the library and prints.
//!
//! Results go to stdout, progress and errors to stderr. Exit codes: 0 success, 1 failure, 2 incorrect usage (clap), 78
//! a start-up gate stayed closed.

mod demonstrations;
mod experiment;
mod generalize;
mod healthcheck;
mod openapi;
mod recognize;
mod reproduce;
mod run;
mod serve;
mod values;

use crate::app::chain_text;
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
    Reproduce(reproduce::ReproduceArguments),
    Experiment(experiment::ExperimentArguments),
    /// Print the OpenAPI 3.1 document of the REST API.
    Openapi,
}

/// Runs the command and prints a failure, with its causes, on stderr.
#[must_use]
pub fn main(arguments: &Arguments) -> ExitCode {
    let result = match &arguments.command {
        Command::Generalize(arguments) => generalize::run(arguments),
        Command::Recognize(arguments) => recognize::run(arguments),
        Command::Run(arguments) => run::run(arguments),
        Command::Serve(arguments) => serve::run(arguments),
        Command::Healthcheck(arguments) => healthcheck::run(arguments),
        Command::Reproduce(arguments) => reproduce::run_command(arguments),
        Command::Experiment(arguments) => experiment::run_command(arguments),
        Command::Openapi => openapi::run(),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {}", chain_text(error.as_ref()).trim_end());
            if error.is::<GateClosed>() { ExitCode::from(EXIT_GATE) } else { ExitCode::FAILURE }
        }
    }
}
