//! The accept loop, for HTTP/1.1 and HTTP/2 on one port.
//!
//! We need our own because axum's sets no timeouts: a client that never finishes its request head would hold its
//! connection forever.

use axum::Router;
use hyper::body::Incoming;
use hyper_util::rt::{TokioExecutor, TokioIo, TokioTimer};
use hyper_util::server::conn::auto::Builder;
use hyper_util::server::graceful::{GracefulShutdown, Watcher};
use std::io::ErrorKind;
use std::sync::Arc;
use std::time::Duration;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::time::timeout;
use tokio_util::sync::CancellationToken;
use tower::ServiceExt as _;

/// First bytes of every HTTP/2 connection.
const PREFACE: &[u8] = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";
/// Time for connections to end by themselves after a signal; streams never would.
const GRACE: Duration = Duration::from_secs(2);
/// HTTP/2 connections that do not answer a ping within this time are closed.
const PING: Duration = Duration::from_secs(20);

/// Limits for clients.
#[derive(Debug, Clone)]
pub struct Limits {
    /// Maximum time until the head of a request has arrived.
    pub request_head: Duration,
    /// Maximum number of concurrent connections; further ones wait.
    pub connections: usize,
}

/// Serves `router` until `stop`, then gives requests in flight a short time to finish.
pub async fn accept(listener: TcpListener, router: Router, limits: Limits, stop: CancellationToken) {
    let mut builder = Builder::new(TokioExecutor::new());
    builder.http1().timer(TokioTimer::new()).header_read_timeout(limits.request_head).max_buf_size(64 << 10);
    builder
        .http2()
        .timer(TokioTimer::new())
        .keep_alive_interval(PING)
        .keep_alive_timeout(PING)
        .max_concurrent_streams(256)
        .max_header_list_size(32 << 10);
    let builder = Arc::new(builder);
    let graceful = GracefulShutdown::new();
    let places = Arc::new(Semaphore::new(limits.connections));
    loop {
        let Ok(place) = Arc::clone(&places).acquire_owned().await else { break };
        let accepted = tokio::select! {
            accepted = listener.accept() => accepted,
            () = stop.cancelled() => break,
        };
        match accepted {
            Ok((stream, _)) => {
                let connection = Connection {
                    builder: Arc::clone(&builder),
                    router: router.clone(),
                    head: limits.request_head,
                    watcher: graceful.watcher(),
                    _place: place,
                };
                tokio::spawn(connection.serve(stream));
            }
            Err(error) if is_of_one_client(error.kind()) => {}
            Err(error) => {
                tracing::error!(error = %error, "cannot accept a connection");
                tokio::time::sleep(Duration::from_millis(100)).await;
            }
        }
    }
    drop(listener);
    if timeout(GRACE, graceful.shutdown()).await.is_err() {
        tracing::info!("closed the connections that were still open");
    }
}

fn is_of_one_client(kind: ErrorKind) -> bool {
    matches!(kind, ErrorKind::ConnectionAborted | ErrorKind::ConnectionReset | ErrorKind::ConnectionRefused)
}

struct Connection {
    builder: Arc<Builder<TokioExecutor>>,
    router: Router,
    head: Duration,
    watcher: Watcher,
    _place: OwnedSemaphorePermit,
}

impl Connection {
    async fn serve(self, stream: TcpStream) {
        let _ = stream.set_nodelay(true);
        if timeout(self.head, began(&stream)).await.is_err() {
            return;
        }
        let router = self.router;
        let service =
            hyper::service::service_fn(move |request: hyper::Request<Incoming>| router.clone().oneshot(request));
        let connection = self.builder.serve_connection(TokioIo::new(stream), service).into_owned();
        if let Err(error) = self.watcher.watch(connection).await {
            tracing::debug!(error = %error, "a connection ended early");
        }
    }
}

/// Returns once the protocol is known; hyper waits for that without a time limit.
async fn began(stream: &TcpStream) {
    let mut head = [0; PREFACE.len()];
    loop {
        match stream.peek(&mut head).await {
            Ok(0) | Err(_) => return,
            Ok(length) if length == PREFACE.len() || head[..length] != PREFACE[..length] => return,
            Ok(_) => tokio::time::sleep(Duration::from_millis(5)).await,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};

    async fn start(request_head: Duration) -> (std::net::SocketAddr, CancellationToken, tokio::task::JoinHandle<()>) {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = listener.local_addr().unwrap();
        let stop = CancellationToken::new();
        let router = Router::new().route("/", axum::routing::get(|| async { "hello" }));
        let task = tokio::spawn(accept(listener, router, Limits { request_head, connections: 8 }, stop.clone()));
        (address, stop, task)
    }

    #[tokio::test]
    async fn a_request_is_answered_and_a_stop_ends_the_loop() {
        let (address, stop, task) = start(Duration::from_secs(5)).await;
        let mut stream = TcpStream::connect(address).await.unwrap();
        stream.write_all(b"GET / HTTP/1.1\r\nhost: x\r\nconnection: close\r\n\r\n").await.unwrap();
        let mut answer = String::new();
        stream.read_to_string(&mut answer).await.unwrap();
        assert!(answer.starts_with("HTTP/1.1 200") && answer.ends_with("hello"), "{answer}");
        stop.cancel();
        timeout(Duration::from_secs(5), task).await.unwrap().unwrap();
    }

    #[tokio::test]
    async fn heads_that_never_end_are_let_go() {
        let (address, _stop, _task) = start(Duration::from_millis(200)).await;
        for begin in [&b""[..], b"P", b"PRI * HTTP", b"GET / HTTP/1.1\r\nhost:"] {
            let mut stream = TcpStream::connect(address).await.unwrap();
            stream.write_all(begin).await.unwrap();
            let mut rest = Vec::new();
            let ended = timeout(Duration::from_secs(3), stream.read_to_end(&mut rest)).await;
            assert!(ended.is_ok(), "{:?} is still held", String::from_utf8_lossy(begin));
        }
    }
}
