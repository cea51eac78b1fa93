//! What the bridge's alert management says to us on ports that are listened to for it.

use insd_base::{Arrival, Input, PortId, Sent};
use insd_wire::nmea::Sentence;
use insd_wire::stream::{Cutter, Protocol};

/// Hosts to whom it is listened at a time. What one says is never put together with what another says.
const SPEAKERS: usize = 32;

/// The ports that may command our alerts.
#[derive(Debug, Default)]
pub(crate) struct AlertCommands {
    ports: Vec<PortId>,
    speakers: Vec<Speaker>,
}

/// Who speaks at one of them.
#[derive(Debug)]
struct Speaker {
    who: Who,
    cutter: Cutter,
}

/// Where something was said, and by whom.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Who {
    /// The port.
    pub port: PortId,
    /// The host on the network; `None` for a line of its own.
    pub host: Option<String>,
    /// Whether commands are obeyed: over the network only of hosts that are listed.
    pub may_command: bool,
}

impl AlertCommands {
    /// Those of these ports.
    pub(crate) fn new(ports: impl IntoIterator<Item = PortId>) -> Self {
        AlertCommands { ports: ports.into_iter().collect(), speakers: Vec::new() }
    }

    /// The sentences in what arrived, if it came to one of the ports, and who said them.
    pub(crate) fn hear(&mut self, arrival: &Arrival) -> Option<(Who, Vec<Sentence>)> {
        let port = arrival.port;
        let (who, bytes) = match &arrival.input {
            Input::Bytes(bytes) => (Who { port, host: None, may_command: true }, bytes),
            Input::Sent(Sent { host, may_command, bytes }) => {
                (Who { port, host: Some(host.clone()), may_command: *may_command }, bytes)
            }
            _ => return None,
        };
        if !self.ports.contains(&port) {
            return None;
        }
        let cutter = self.cutter(&who);
        cutter.push(bytes);
        let mut heard = Vec::new();
        while let Some(cut) = cutter.cut() {
            heard.extend(Sentence::read(cut.bytes).ok().map(|(_, sentence)| sentence));
        }
        Some((who, heard))
    }

    fn cutter(&mut self, who: &Who) -> &mut Cutter {
        let known = self.speakers.iter().position(|own| own.who == *who);
        let index = known.unwrap_or_else(|| {
            if self.speakers.len() >= SPEAKERS {
                // a stranger first: however many come, none takes the place of who may command
                let stranger = self.speakers.iter().position(|own| !own.who.may_command);
                self.speakers.remove(stranger.unwrap_or(0));
            }
            let cutter = Cutter::new(&[Protocol::Nmea]);
            self.speakers.push(Speaker { who: who.clone(), cutter });
            self.speakers.len() - 1
        });
        &mut self.speakers[index].cutter
    }
}
