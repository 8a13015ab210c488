//! `cgda healthcheck`: asks a server whether it is ready and reports through the exit code.

use anyhow::{Context as _, bail};
use std::net::SocketAddr;
use std::time::Duration;

/// Ask a server whether it is ready: exit code 0 if it is.
#[derive(Debug, clap::Args)]
#[command(allow_negative_numbers = true)]
pub struct HealthcheckArguments {
    /// Address of the server.
    #[arg(long, default_value = "127.0.0.1:8080", value_name = "ADDRESS")]
    address: SocketAddr,
    /// Maximum time to wait, seconds.
    #[arg(long, default_value_t = 3.0, value_name = "SECONDS")]
    timeout: f64,
}

/// Sends the request.
///
/// # Errors
/// If the server does not answer, or answers that it is not ready.
pub fn run(arguments: &HealthcheckArguments) -> anyhow::Result<()> {
    let timeout =
        Duration::try_from_secs_f64(arguments.timeout).context("--timeout is not a valid number of seconds")?;
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
    let url = format!("http://{}/readyz", arguments.address);
    let answer = runtime.block_on(async {
        let client = reqwest::Client::builder().timeout(timeout).no_proxy().build()?;
        client.get(&url).send().await
    });
    let answer = answer.with_context(|| format!("{url} does not answer"))?;
    if !answer.status().is_success() {
        bail!("{url} answers {}", answer.status());
    }
    Ok(())
}
