//! `cgda serve`: the service with its dashboard, REST and gRPC on one address.

mod demo;

use super::values::address;
use crate::app::ports::LocalEvents;
use crate::app::{Access, App, Caller, Ports};
use crate::config::{Config, Flags, LogFormat, ServerConfig};
use crate::evaluate::{PacedEvaluators, Simulations};
use crate::jobs::{Runner, Settings};
use crate::lifecycle::{self, DataDir, GateClosed, SystemClock, SystemIds};
use crate::store::sqlite::SqliteStore;
use crate::{grpc, http, telemetry};
use anyhow::Context as _;
use secrecy::{ExposeSecret as _, SecretString};
use std::io::Write as _;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;
use tokio::net::TcpListener;

/// Time for workers to write their checkpoints after a signal.
const SHUT_DOWN: Duration = Duration::from_secs(8);

/// Serve the dashboard, REST and gRPC; prints one line with the addresses on stdout once it is ready.
///
/// Every setting can also be given in a file (cgda.toml) or in the environment (CGDA_SERVER__LISTEN); flags take
/// precedence.
#[derive(Debug, clap::Args)]
pub struct ServeArguments {
    /// Configuration file; by default cgda.toml in the working directory, if it exists.
    #[arg(long, env = "CGDA_CONFIG", value_name = "FILE")]
    config: Option<PathBuf>,
    /// Directory of all persistent data [default: cgda-data]
    #[arg(long, value_name = "DIR")]
    data_dir: Option<PathBuf>,
    /// Address of HTTP and gRPC; port 0 picks a free port [default: 127.0.0.1:8080]
    #[arg(long, value_name = "ADDRESS", value_parser = address)]
    listen: Option<SocketAddr>,
    /// Access token of clients; if absent, generated at the first start and stored in the data directory.
    #[arg(long, env = "CGDA_TOKEN", hide_env_values = true, value_name = "TOKEN")]
    token: Option<SecretString>,
    /// Allow an address that other machines can reach, although the token then crosses the network unencrypted.
    #[arg(long)]
    allow_remote: bool,
    /// Number of jobs run concurrently [default: one per core]
    #[arg(long, value_name = "N")]
    workers: Option<usize>,
    /// Format of log lines [default: text]
    #[arg(long, value_name = "FORMAT")]
    log_format: Option<LogFormat>,
    /// Fill an empty database with the shipped demonstrations, robot and worlds, and start a wax and a paint job.
    #[arg(long)]
    demo: bool,
}

impl ServeArguments {
    fn flags(&self) -> Flags {
        let format = self.log_format.map(|format| if format == LogFormat::Json { "json" } else { "text" });
        Flags::default()
            .with("server.data_dir", "--data-dir", self.data_dir.as_ref().map(|path| path.display().to_string()))
            .with("server.listen", "--listen", self.listen.map(|address| address.to_string()))
            .with("server.allow_remote", "--allow-remote", self.allow_remote.then_some(true))
            .with("jobs.workers", "--workers", self.workers.map(|workers| i64::try_from(workers).unwrap_or(i64::MAX)))
            .with("log.format", "--log-format", format)
    }
}

/// Serves until a signal arrives.
///
/// # Errors
/// [`GateClosed`] if a start-up gate stays closed; otherwise whatever prevents the server from starting.
pub fn run(arguments: &ServeArguments) -> anyhow::Result<()> {
    let config = Config::load(arguments.config.as_deref(), &arguments.flags()).map_err(GateClosed::because)?;
    telemetry::start(&config.log)?;
    let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build()?;
    let served = runtime.block_on(serve(&config, arguments));
    // Blocking work has already had its time to finish.
    runtime.shutdown_timeout(Duration::from_millis(500));
    served
}

async fn serve(config: &Config, arguments: &ServeArguments) -> anyhow::Result<()> {
    let stop = lifecycle::stop_signal().context("signals cannot be handled")?;
    check_address(&config.server)?;
    let data = DataDir::hold(&config.server.data_dir).map_err(GateClosed::because)?;
    let token = match &arguments.token {
        Some(token) => token.clone(),
        None => data.token(fresh_token).map_err(GateClosed::because)?.into(),
    };
    check_token(token.expose_secret())?;
    let store = SqliteStore::open(&data.database()).await.map_err(GateClosed::because)?;
    let ports = Ports {
        store: Arc::new(store),
        clock: Arc::new(SystemClock::new()),
        ids: Arc::new(SystemIds),
        events: Arc::new(LocalEvents::new()),
    };
    let app = App::new(ports.clone()).with_upload_limit(config.limits.upload_bytes);
    let listener = TcpListener::bind(config.server.listen)
        .await
        .with_context(|| format!("cannot listen on {}: give another --listen", config.server.listen))?;
    let address = listener.local_addr()?;
    let evaluators = Arc::new(PacedEvaluators(Simulations));
    let runner = Runner::start(&ports, evaluators, &settings(config)).await?;
    let router = router(&app, &Access::new(token.expose_secret()), config)?;
    let limits = lifecycle::Limits {
        request_head: Duration::from_millis(config.limits.request_head_ms),
        connections: config.limits.connections,
    };
    let accepting = tokio::spawn(lifecycle::accept(listener, router, limits, stop.clone()));
    app.set_ready(true);
    announce(address, token.expose_secret())?;
    if arguments.demo {
        tokio::spawn(demo::fill(app.on_behalf_of(Caller::LocalOperator)));
    }
    stop.cancelled().await;
    app.set_ready(false);
    let (in_time, _) = tokio::join!(runner.shut_down(SHUT_DOWN), accepting);
    if !in_time {
        tracing::warn!("some jobs did not reach a checkpoint in time: they will continue from the previous one");
    }
    Ok(())
}

fn check_address(server: &ServerConfig) -> Result<(), GateClosed> {
    if server.listen.ip().is_loopback() || server.allow_remote {
        return Ok(());
    }
    Err(GateClosed::rule(format!(
        "{} can be reached by other machines, and the token would cross the network readable: listen on 127.0.0.1, or \
         give --allow-remote if the network or a proxy with TLS protects it",
        server.listen
    )))
}

/// Checks the token, which appears in headers and in the printed URL.
fn check_token(token: &str) -> Result<(), GateClosed> {
    if token.len() < 16 {
        return Err(GateClosed::rule("the token is shorter than 16 characters: give a longer one"));
    }
    if token.bytes().all(|b| b.is_ascii_alphanumeric() || b"-._~".contains(&b)) {
        return Ok(());
    }
    Err(GateClosed::rule("the token contains a character other than A-Z a-z 0-9 - . _ ~: give another one"))
}

fn fresh_token() -> String {
    use crate::app::ports::Ids as _;
    format!("cgda_{}{}", SystemIds.token(), SystemIds.token())
}

fn settings(config: &Config) -> Settings {
    let default = Settings::default();
    Settings {
        workers: config.jobs.workers.unwrap_or(default.workers),
        lease: Duration::from_millis(config.jobs.lease_ms),
        heartbeat: Duration::from_millis(config.jobs.heartbeat_ms),
        checkpoint: Duration::from_millis(config.jobs.checkpoint_ms),
        ..default
    }
}

fn router(app: &App, access: &Access, config: &Config) -> anyhow::Result<axum::Router> {
    let limits = &config.limits;
    let grpc_settings = grpc::Settings { message_limit_bytes: limits.body_bytes, reflection: config.server.reflection };
    // Both routers have a fallback, and a merged router may only have one.
    let grpc = grpc::routes(app.clone(), access.clone(), &grpc_settings)?.into_axum_router().reset_fallback();
    let http_settings = http::Settings {
        body_limit_bytes: limits.body_bytes,
        timeout: Duration::from_millis(limits.answer_ms),
        hosts: config.server.hosts.clone(),
    };
    Ok(http::router(app.clone(), access.clone(), http_settings, grpc))
}

/// Prints the ready line on stdout.
fn announce(address: SocketAddr, token: &str) -> anyhow::Result<()> {
    let mut out = std::io::stdout().lock();
    writeln!(out, "cgda ready http=http://{address} grpc={address} url=http://{address}/?token={token}")?;
    out.flush()?;
    Ok(())
}
