//! What the page is told at its start, and why it may not start.

use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::path::PathBuf;

use insd_languages::Language;

/// Fewest characters of a token.
pub const MIN_TOKEN: usize = 16;

/// Where to listen.
#[derive(Debug)]
pub enum Listen {
    /// At an address.
    Address(SocketAddr),
    /// At a socket that somebody else has opened, such as systemd.
    Inherited(TcpListener),
}

/// What the page is told at its start.
#[derive(Debug)]
pub struct WebConfig {
    /// Where to listen. Default 127.0.0.1:8470: nobody but this computer.
    pub listen: Listen,
    /// Who sends it may acknowledge alerts and change the level of the journal; at least [`MIN_TOKEN`]
    /// characters. Without a token, or with a shorter one, nothing can be changed.
    pub token: Option<String>,
    /// Names under which the page may be asked for, beside `localhost` and bare addresses: that of a
    /// reverse proxy, or of this computer. Others are refused, as a web site could otherwise read the page
    /// through the browser of somebody on board (DNS rebinding).
    pub allowed_hosts: Vec<String>,
    /// Most connections at a time; further ones are told that it is too many (503).
    pub max_clients: usize,
    /// Most connections of one address at a time, likewise. Behind a reverse proxy all have one address.
    pub max_per_address: usize,
    /// A picture of what the camera sees, which somebody else writes anew again and again.
    pub picture: Option<PathBuf>,
    /// The folder of raw recordings, which who can open the page may list and fetch.
    pub recordings: Option<PathBuf>,
    /// The program that makes reports of them: `PROGRAM report --background --language CODE --run N --out FILE -- RECORDING`.
    pub reporter: Option<PathBuf>,
    /// The language of who has not chosen one on the page.
    pub language: Language,
}

impl Default for WebConfig {
    fn default() -> Self {
        let address = SocketAddr::from((Ipv4Addr::LOCALHOST, 8470));
        WebConfig {
            listen: Listen::Address(address),
            token: None,
            allowed_hosts: Vec::new(),
            max_clients: 600,
            max_per_address: 16,
            picture: None,
            recordings: None,
            reporter: None,
            language: Language::default(),
        }
    }
}

/// Why the page cannot start.
#[derive(Debug, thiserror::Error)]
pub enum WebError {
    /// The address cannot be listened at.
    #[error("cannot listen at {address}: {source}")]
    Bind {
        /// The address.
        address: SocketAddr,
        /// What the system said.
        source: std::io::Error,
    },
    /// The inherited socket is not usable, or there is no thread to be had.
    #[error("cannot start the status page: {0}")]
    System(#[from] std::io::Error),
}
