//! What the bridge's alert management says to us on ports that are listened to for it.

use insd_base::{Arrival, Input, PortId};
use insd_wire::nmea::Sentence;
use insd_wire::stream::{Cutter, Protocol};

/// The ports that may command our alerts.
#[derive(Debug, Default)]
pub(crate) struct Ears {
    ports: Vec<(PortId, Cutter)>,
}

impl Ears {
    /// Ears for these ports.
    pub(crate) fn new(ports: impl IntoIterator<Item = PortId>) -> Self {
        let cutter = |port| (port, Cutter::new(&[Protocol::Nmea]));
        Ears { ports: ports.into_iter().map(cutter).collect() }
    }

    /// The sentences in what arrived, if it came to one of the ports.
    pub(crate) fn hear(&mut self, arrival: &Arrival) -> Vec<Sentence> {
        let own = self.ports.iter_mut().find(|(port, _)| *port == arrival.port);
        let (Some((_, cutter)), Input::Bytes(bytes)) = (own, &arrival.input) else {
            return Vec::new();
        };
        cutter.push(bytes);
        let mut heard = Vec::new();
        while let Some(cut) = cutter.cut() {
            heard.extend(Sentence::read(cut.bytes).ok().map(|(_, sentence)| sentence));
        }
        heard
    }
}
