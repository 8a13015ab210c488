//! `cgda serve` as a child process on a free port with its own data directory; killed on drop.

use std::io::{BufRead as _, BufReader};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc;
use std::time::Duration;
use tempfile::TempDir;

/// Maximum time for start-up.
const PATIENCE: Duration = Duration::from_mins(1);

/// A running server.
pub struct Server {
    child: Child,
    data: TempDir,
    /// `127.0.0.1:PORT`.
    pub address: String,
    /// Access token.
    pub token: String,
}

impl Server {
    /// Starts a server with an empty data directory.
    pub fn start() -> Self {
        Self::start_in(TempDir::new().unwrap(), &[])
    }

    /// Like [`Server::start`], with additional environment variables.
    pub fn start_with(environment: &[(&str, &str)]) -> Self {
        Self::start_in(TempDir::new().unwrap(), environment)
    }

    fn start_in(data: TempDir, environment: &[(&str, &str)]) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_cgda"))
            .args(["serve", "--listen", "127.0.0.1:0", "--data-dir"])
            .arg(data.path())
            .envs(environment.iter().copied())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let lines = BufReader::new(child.stdout.take().unwrap()).lines();
        let (sender, ready) = mpsc::channel();
        std::thread::spawn(move || {
            let found = lines.map_while(Result::ok).find_map(|line| ready_line(&line));
            let _ = sender.send(found);
        });
        let (address, token) = ready.recv_timeout(PATIENCE).unwrap().expect("the server ended before it was ready");
        Self { child, data, address, token }
    }

    /// Sends SIGTERM without waiting for the end.
    pub fn ask_to_stop(&self) {
        let sent = Command::new("kill").args(["-TERM", &self.child.id().to_string()]).status().unwrap();
        assert!(sent.success());
    }

    /// Kills the server as a power cut would and restarts it on the same data.
    pub fn kill_and_restart(mut self) -> Self {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
        let data = std::mem::replace(&mut self.data, TempDir::new().unwrap());
        Self::start_in(data, &[])
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Parses address and token from the ready line.
fn ready_line(line: &str) -> Option<(String, String)> {
    let (_, rest) = line.split_once("url=http://")?;
    let (address, rest) = rest.split_once("/?token=")?;
    let token = rest.split_whitespace().next()?;
    Some((address.to_owned(), token.to_owned()))
}
