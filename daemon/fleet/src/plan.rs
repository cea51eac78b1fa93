//! What a fleet is told: plain values.

use std::path::PathBuf;

use insd_base::Span;

use crate::spool::SpoolClass;

/// How what is sent is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum FleetPayload {
    /// The objects of the interface, with keys.
    #[default]
    Json,
    /// Deltas of Signal K.
    SignalK,
    /// Packages of ISO 19848.
    Iso19848,
}

/// Where the broker is, and as who it is called.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BrokerPlan {
    /// Its name or address.
    pub host: String,
    /// Its port.
    pub port: u16,
    /// The name of the client: one for each connection of a broker.
    pub client: String,
    /// User and password.
    pub login: Option<(String, String)>,
    /// Whether the connection is encrypted; the certificates of those that are believed, or those of the
    /// computer.
    pub tls: Option<Option<PathBuf>>,
}

/// What leaves the ship for one fleet.
#[derive(Clone, Debug, PartialEq)]
pub struct FleetPlan {
    /// Name, for the journal.
    pub name: String,
    /// The broker.
    pub broker: BrokerPlan,
    /// What topics begin with.
    pub prefix: String,
    /// Who the ship is: a level of the topic and a part of every key.
    pub ship: String,
    /// Her name for people.
    pub ship_name: Option<String>,
    /// Folder of the spool.
    pub folder: PathBuf,
    /// What it may hold, bytes.
    pub quota: u64,
    /// What may be sent, bytes an hour.
    pub budget: Option<u64>,
    /// Time between two states; `None` for none.
    pub state: Option<Span>,
    /// Time between two records of the history; `None` for none.
    pub history: Option<Span>,
    /// Time over which records are gathered to one message.
    pub gather: Span,
    /// Whether changes of alerts are sent.
    pub alerts: bool,
    /// How what is sent is written.
    pub payload: FleetPayload,
    /// Whether batches are compressed.
    pub compress: bool,
    /// After this nobody wants to know any more, on board and at the broker.
    pub expiry: Option<Span>,
}

impl FleetPlan {
    /// Whether messages of a class are compressed: what others read without knowing of it is not.
    #[must_use]
    pub fn packs(&self, class: SpoolClass) -> bool {
        self.compress && self.payload == FleetPayload::Json && class == SpoolClass::History
    }
}
