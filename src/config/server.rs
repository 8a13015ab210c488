//! `[server]`: addresses and access.

use serde::Deserialize;
use std::net::{Ipv4Addr, SocketAddr};
use std::path::PathBuf;

/// Addresses and access.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ServerConfig {
    /// Address of HTTP and gRPC; port 0 picks a free port.
    pub listen: SocketAddr,
    /// Directory of all persistent data.
    pub data_dir: PathBuf,
    /// Allows an address that other machines can reach. There is no TLS, so the token then crosses the network
    /// unencrypted.
    pub allow_remote: bool,
    /// Host names of this server besides its numeric addresses and `localhost`.
    pub hosts: Vec<String>,
    /// Whether gRPC reflection is offered.
    pub reflection: bool,
}

impl Default for ServerConfig {
    fn default() -> Self {
        Self {
            listen: SocketAddr::from((Ipv4Addr::LOCALHOST, 8080)),
            data_dir: PathBuf::from("cgda-data"),
            allow_remote: false,
            hosts: Vec::new(),
            reflection: true,
        }
    }
}
