//! What the service around the navigation is told: `[recording]`, `[chrony]`, `[state]`, `[web]`, `[log]`.

use std::net::{Ipv4Addr, SocketAddr};
use std::path::PathBuf;

use schemars::JsonSchema;
use serde::Deserialize;

use crate::log_filter;

/// Recording of all that arrives.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RecordingSection {
    /// Where the files go.
    pub folder: PathBuf,
    /// Their name.
    #[serde(default = "insd")]
    pub name: String,
    /// A file holds at most so many megabytes.
    #[serde(default = "hundred")]
    pub rotate_mb: u64,
    /// A file holds at most so many seconds.
    #[serde(default = "hour")]
    pub rotate_s: f64,
    /// All files together hold at most so many megabytes.
    pub quota_mb: Option<u64>,
}

/// Where chronyd listens for time.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ChronySection {
    /// The socket of its `refclock SOCK`.
    pub socket: PathBuf,
}

fn hundred() -> u64 {
    100
}
fn hour() -> f64 {
    3600.0
}
fn insd() -> String {
    "insd".to_owned()
}

/// Where it is kept what the next start goes on from.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct StateSection {
    /// Whether anything is kept at all.
    pub enabled: bool,
    /// Folder on the disk: survives a power cut. Left out: that of the service, or none.
    pub folder: Option<PathBuf>,
    /// Folder in memory: survives a crash of the program. Left out: that of the service, or none.
    pub runtime_folder: Option<PathBuf>,
    /// Time between two states on the disk, s.
    pub interval_s: f64,
}

impl Default for StateSection {
    fn default() -> Self {
        StateSection { enabled: true, folder: None, runtime_folder: None, interval_s: 5.0 }
    }
}

impl StateSection {
    /// The folder on the disk: the configured one, else that which systemd made for the service.
    #[must_use]
    pub fn folder(&self) -> Option<PathBuf> {
        self.folder.clone().or_else(|| made_by_systemd("STATE_DIRECTORY"))
    }

    /// The folder in memory, the same way.
    #[must_use]
    pub fn runtime_folder(&self) -> Option<PathBuf> {
        self.runtime_folder.clone().or_else(|| made_by_systemd("RUNTIME_DIRECTORY"))
    }

    pub(super) fn faults(&self) -> impl Iterator<Item = String> {
        let is_sane = (0.5..=3600.0).contains(&self.interval_s);
        (!is_sane).then(|| "[state]: interval_s: expected 0.5 to 3600 s".to_owned()).into_iter()
    }
}

/// The first of the folders that systemd names in a variable (systemd.exec(5)).
fn made_by_systemd(variable: &str) -> Option<PathBuf> {
    let folders = std::env::var_os(variable)?;
    std::env::split_paths(&folders).next().filter(|folder| folder.is_absolute())
}

/// The status page.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct WebSection {
    /// Whether there is one.
    pub enabled: bool,
    /// Where it is served. Beyond this computer only if that is wanted.
    #[schemars(extend("format" = "socket"))]
    pub listen: SocketAddr,
    /// Names by which browsers reach it, beside those of this computer and the address itself.
    pub hosts: Vec<String>,
    /// Connections that one address may have at a time. Behind a reverse proxy all have its address.
    pub max_per_address: usize,
    /// File with the word that allows changes. Left out: nothing can be changed.
    pub token_file: Option<PathBuf>,
}

impl Default for WebSection {
    fn default() -> Self {
        WebSection {
            enabled: true,
            listen: SocketAddr::from((Ipv4Addr::LOCALHOST, 8470)),
            hosts: Vec::new(),
            max_per_address: 16,
            token_file: None,
        }
    }
}

impl WebSection {
    pub(super) fn faults(&self) -> impl Iterator<Item = String> {
        let fault = (self.max_per_address == 0)
            .then(|| "[web]: max_per_address: expected 1 or more".to_owned());
        fault.into_iter()
    }
}

/// What is logged.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct LogSection {
    /// The least severe level that is logged, or directives as `RUST_LOG` has them.
    pub level: String,
}

impl Default for LogSection {
    fn default() -> Self {
        LogSection { level: "info".to_owned() }
    }
}

impl LogSection {
    pub(super) fn faults(&self) -> impl Iterator<Item = String> {
        let fault = log_filter::filter(&self.level).err();
        fault.map(|fault| format!("[log]: level: {fault}")).into_iter()
    }
}
