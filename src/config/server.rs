//! `[server]`: addresses and access.

use serde::{Deserialize, Serialize};
use std::net::{Ipv4Addr, SocketAddr};
use std::path::PathBuf;

/// Addresses and access.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ServerConfig {
    /// Address of HTTP and gRPC; port 0 takes a free one.
    pub listen: SocketAddr,
    /// Folder of everything that is kept.
    pub data_dir: PathBuf,
    /// Allows an address that other machines can reach. Without TLS the token then crosses the network readable.
    pub allow_remote: bool,
    /// Names of this server beside its numeric addresses and `localhost`.
    pub hosts: Vec<String>,
    /// Whether gRPC clients may ask for the services and their messages.
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
