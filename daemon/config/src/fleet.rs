//! What leaves the ship: `[[fleet]]`.

use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Port of a broker without and with TLS, as IANA has them.
const PORTS: [u16; 2] = [1883, 8883];

/// A fleet that is told, over MQTT 5. Nothing is received from it.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FleetSection {
    /// Name, for the journal.
    pub name: String,
    /// Name or address of the broker.
    pub host: String,
    /// Its port. Left out: 1883, with TLS 8883.
    pub port: Option<u16>,
    /// Whether the connection is encrypted; the program must be built with the feature `tls`.
    #[serde(default)]
    pub tls: bool,
    /// File with the certificates that are believed, PEM. Left out: those of the computer.
    pub tls_ca_file: Option<PathBuf>,
    /// Who she is: a level of the topic and a part of every key, different for each ship. `imo9074729`, or
    /// `urn:mrn:imo:mmsi:211000000` as Signal K has it.
    pub ship: String,
    /// Her name for people.
    pub ship_name: Option<String>,
    /// Name of the client, which only she has at that broker. Left out: `insd-` and the ship.
    pub client_id: Option<String>,
    /// User at the broker.
    pub user: Option<String>,
    /// File with the password.
    pub password_file: Option<PathBuf>,
    /// What topics begin with.
    #[serde(default = "prefix")]
    pub topic: String,
    /// Time between two states, which tell all as it is now, s. 0 for none.
    #[serde(default = "ten")]
    pub state_s: f64,
    /// Time between two records of the history, s. 0 for none.
    #[serde(default = "ten")]
    pub history_s: f64,
    /// Time over which records of the history are gathered to one message, s.
    #[serde(default = "minute")]
    pub gather_s: f64,
    /// Whether changes of alerts are told.
    #[serde(default = "yes")]
    pub alerts: bool,
    /// How what is told is written.
    #[serde(default)]
    pub payload: PayloadKind,
    /// Whether messages of the history are compressed (zstd).
    #[serde(default = "yes")]
    pub compress: bool,
    /// Bytes that may be sent in an hour. Left out: no limit.
    pub budget_bytes_h: Option<u64>,
    /// Folder of what waits for the broker. Left out: `fleet` and its name in the folder of `[state]`.
    pub folder: Option<PathBuf>,
    /// What it holds at the most, MB.
    #[serde(default = "quota")]
    pub quota_mb: u64,
    /// After so long nobody wants to know any more, s: it is neither sent nor kept by the broker. 0 for never.
    #[serde(default = "month")]
    pub expiry_s: f64,
}

/// How what is told is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PayloadKind {
    /// The objects of the interface, with keys: what `insd fleet sink` reads.
    #[default]
    Json,
    /// Deltas of Signal K.
    SignalK,
    /// Packages of ISO 19848 with DNV's names of channels.
    #[serde(rename = "iso19848")]
    Iso19848,
}

fn prefix() -> String {
    "insd/v1".to_owned()
}
fn ten() -> f64 {
    10.0
}
fn minute() -> f64 {
    60.0
}
fn quota() -> u64 {
    64
}
fn month() -> f64 {
    30.0 * 86_400.0
}
fn yes() -> bool {
    true
}

impl FleetSection {
    /// The port that is called.
    #[must_use]
    pub fn port(&self) -> u16 {
        self.port.unwrap_or(PORTS[usize::from(self.tls)])
    }

    /// The folder of what waits: its own, or one below the folder of the state.
    #[must_use]
    pub fn spool(&self, state: Option<&Path>) -> Option<PathBuf> {
        let below = || Some(state?.join("fleet").join(&self.name));
        self.folder.clone().or_else(below)
    }

    /// All that is wrong with it, in words.
    pub(crate) fn faults(&self, all: &[FleetSection]) -> Vec<String> {
        let mut faults = Vec::new();
        let mut expect = |good: bool, key: &str, expected: &str| {
            if !good {
                faults.push(format!("{key}: expected {expected}"));
            }
        };
        let is_word = |text: &str| {
            !text.is_empty()
                && text.len() <= 64
                && !text.contains(['/', '+', '#', ' '])
                && !text.contains(char::is_control)
        };
        let named = all.iter().filter(|other| other.name == self.name).count();
        expect(
            named == 1 && is_word(&self.name),
            "name",
            "a word that no other fleet has, without / + # and blanks",
        );
        expect(
            !self.host.trim().is_empty() && !self.host.contains("://"),
            "host",
            "a name or an address alone",
        );
        expect(is_word(&self.ship), "ship", "1 to 64 characters without / + # and blanks");
        let is_topic = !self.topic.is_empty() && self.topic.split('/').all(is_word);
        expect(is_topic, "topic", "words with / between them, without + # and blanks");
        let is_named = self.payload != PayloadKind::SignalK || self.ship.starts_with("urn:mrn:");
        expect(is_named, "ship", "for Signal K a name that begins with urn:mrn:");
        let is_login = self.user.is_some() || self.password_file.is_none();
        expect(is_login, "password_file", "a user with it");
        expect(self.tls || self.tls_ca_file.is_none(), "tls_ca_file", "tls = true with it");
        let period = |value: f64| value == 0.0 || (0.2..=86_400.0).contains(&value);
        expect(period(self.state_s), "state_s", "0.2 to 86400, or 0");
        expect(period(self.history_s), "history_s", "0.2 to 86400, or 0");
        expect((0.0..=3600.0).contains(&self.gather_s), "gather_s", "0 to 3600");
        expect(self.budget_bytes_h.is_none_or(|own| own >= 1000), "budget_bytes_h", "1000 or more");
        expect((1..=1_000_000).contains(&self.quota_mb), "quota_mb", "1 to 1000000");
        let expiry = self.expiry_s == 0.0 || (60.0..=1e9).contains(&self.expiry_s);
        expect(expiry, "expiry_s", "60 to 1e9, or 0");
        faults
    }
}
