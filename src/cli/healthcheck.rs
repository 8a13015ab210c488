//! `cgda healthcheck`: asks a server whether it is ready and reports through the exit code.

use super::values::address;
use anyhow::{Context as _, bail};
use axum::body::Body;
use axum::http::header::HOST;
use axum::http::{Request, StatusCode};
use hyper_util::rt::TokioIo;
use std::net::SocketAddr;
use std::time::Duration;
use tokio::net::TcpStream;

/// Ask a server whether it is ready: exit code 0 if it is.
#[derive(Debug, clap::Args)]
#[command(allow_negative_numbers = true)]
pub struct HealthcheckArguments {
    /// Numeric address and port of the server.
    #[arg(long, default_value = "127.0.0.1:8080", value_name = "ADDRESS", value_parser = address)]
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
    let answer = runtime.block_on(async { tokio::time::timeout(timeout, ask(arguments.address)).await });
    let status = match answer {
        Ok(status) => status.with_context(|| format!("{url} does not answer"))?,
        Err(_) => bail!("{url} does not answer within {} s", arguments.timeout),
    };
    if !status.is_success() {
        bail!("{url} answers {status}");
    }
    Ok(())
}

/// The status of `/readyz`.
async fn ask(address: SocketAddr) -> anyhow::Result<StatusCode> {
    let stream = TokioIo::new(TcpStream::connect(address).await?);
    let (mut sender, connection) = hyper::client::conn::http1::handshake(stream).await?;
    tokio::spawn(connection);
    let request = Request::get("/readyz").header(HOST, address.to_string()).body(Body::empty())?;
    Ok(sender.send_request(request).await?.status())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{Read as _, Write as _};
    use std::net::TcpListener;

    /// Result of the command for a server that gives `answer` to its first request.
    fn told(answer: &'static str) -> anyhow::Result<()> {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap();
        let server = std::thread::spawn(move || {
            let (mut stream, _) = listener.accept().unwrap();
            let mut head = [0; 1024];
            let read = stream.read(&mut head).unwrap();
            stream.write_all(answer.as_bytes()).unwrap();
            String::from_utf8_lossy(&head[..read]).into_owned()
        });
        let result = run(&HealthcheckArguments { address, timeout: 30.0 });
        let head = server.join().unwrap();
        assert!(head.starts_with("GET /readyz HTTP/1.1\r\n") && head.contains(&format!("host: {address}")), "{head}");
        result
    }

    #[test]
    fn the_status_decides() {
        told("HTTP/1.1 200 OK\r\ncontent-length: 0\r\n\r\n").unwrap();
        let error = told("HTTP/1.1 503 Service Unavailable\r\ncontent-length: 0\r\n\r\n").unwrap_err();
        assert!(error.to_string().ends_with("/readyz answers 503 Service Unavailable"), "{error}");
    }

    #[test]
    fn nobody_and_silence_are_no_answer() {
        let free = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = free.local_addr().unwrap();
        let silence = run(&HealthcheckArguments { address, timeout: 0.1 }).unwrap_err();
        assert!(silence.to_string().ends_with("does not answer within 0.1 s"), "{silence}");
        drop(free);
        let nobody = run(&HealthcheckArguments { address, timeout: 30.0 }).unwrap_err();
        assert!(format!("{nobody:#}").contains("does not answer: Connection refused"), "{nobody:#}");
    }
}
