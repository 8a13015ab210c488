//! Start-up gates, the accept loop and signals: the frame around a server's work.

mod accept;
mod data_dir;
mod system;

pub use accept::{Limits, accept};
pub use data_dir::{DataDir, DataDirError};
pub use system::{SystemClock, SystemIds};

use tokio::signal::unix::{Signal, SignalKind, signal};
use tokio_util::sync::CancellationToken;

/// Exit code if a start-up gate stays closed (`EX_CONFIG`).
pub const EXIT_GATE: u8 = 78;

/// A start-up gate stayed closed: the server exits with 78 and this reason.
#[derive(Debug, thiserror::Error)]
#[error("cannot start: {reason}")]
pub struct GateClosed {
    /// The gate, and the remedy.
    pub reason: String,
    /// Underlying error; `None` if a rule closed the gate.
    #[source]
    pub source: Option<anyhow::Error>,
}

impl GateClosed {
    /// A gate closed by an error.
    pub fn because(error: impl Into<anyhow::Error>) -> Self {
        let error: anyhow::Error = error.into();
        let reason = error.to_string();
        // Some errors already include their cause in their text.
        let cause = error.source().map(ToString::to_string).filter(|cause| !reason.contains(cause.as_str()));
        Self { reason, source: cause.map(anyhow::Error::msg) }
    }

    /// A gate closed by a rule.
    pub fn rule(reason: impl Into<String>) -> Self {
        Self { reason: reason.into(), source: None }
    }
}

/// Token that SIGTERM or SIGINT cancels; a second signal ends the process at once.
///
/// # Errors
/// If the signal handlers cannot be installed.
pub fn stop_signal() -> std::io::Result<CancellationToken> {
    let stop = CancellationToken::new();
    let (mut terminate, mut interrupt) = (signal(SignalKind::terminate())?, signal(SignalKind::interrupt())?);
    let cancelled = stop.clone();
    tokio::spawn(async move {
        either(&mut terminate, &mut interrupt).await;
        tracing::info!("stopping: a second signal ends at once");
        cancelled.cancel();
        either(&mut terminate, &mut interrupt).await;
        std::process::exit(130);
    });
    Ok(stop)
}

async fn either(terminate: &mut Signal, interrupt: &mut Signal) {
    tokio::select! {
        _ = terminate.recv() => {}
        _ = interrupt.recv() => {}
    }
}
