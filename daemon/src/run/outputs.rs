//! The ports that are written to.

use insd_base::{Arrival, Input, PortId, PortState, Span};
use insd_config::{Config, LanSection, OutputSection};
use insd_drivers::ports::{
    self, AgeStatus, Destination, Outgoing, OutputConfig, OutputPort, OutputStatus, Surroundings,
    UdpOutput,
};
use insd_output::{Lan, MessageKind, Port, PortMessage};
use insd_web::SECURITY;
use insd_wire::nmea::TransmissionGroup;

/// All ports that are written to.
pub(super) struct Outputs {
    first: u16,
    /// Names of all carriers there ever were, by their numbers from `first` on.
    names: Vec<String>,
    ports: Vec<Output>,
}

struct Output {
    section: OutputSection,
    kinds: Vec<MessageKind>,
    link: Link,
}

/// What a carrier has done.
#[derive(Clone, Debug)]
pub(super) struct OutputReport {
    pub(super) name: String,
    pub(super) kinds: Vec<&'static str>,
    pub(super) status: OutputStatus,
}

/// What a port's messages go over.
enum Link {
    /// One destination; each message by itself.
    One(OutputPort),
    /// The ship's network: a destination for each transmission group.
    Lan(Box<Lan>, Vec<(TransmissionGroup, OutputPort)>),
}

impl Outputs {
    /// None yet; they will be numbered from `first`.
    pub(super) fn new(first: u16) -> Self {
        Outputs { first, names: Vec::new(), ports: Vec::new() }
    }

    /// Closes those that the next configuration has no more, or otherwise.
    pub(super) fn close_changed(&mut self, next: &Config) {
        self.ports.retain(|own| next.outputs.contains(&own.section));
    }

    /// Opens those of a configuration that are not open yet, and puts all in its order. To be called inside
    /// the runtime.
    pub(super) fn open(&mut self, config: &Config, made: &[Port], surroundings: &Surroundings) {
        let mut before = std::mem::take(&mut self.ports);
        for (section, port) in config.outputs.iter().zip(made) {
            if let Some(index) = before.iter().position(|own| own.section == *section) {
                self.ports.push(before.swap_remove(index));
                continue;
            }
            if let Some(share) = section.overload() {
                let percent = (share * 100.0).round();
                tracing::warn!(
                    output = section.name,
                    percent,
                    "asked for more than its line carries"
                );
            }
            if let Some(link) = self.link(section, port, surroundings) {
                let kinds = port.kinds().collect();
                self.ports.push(Output { section: section.clone(), kinds, link });
            }
        }
    }

    /// What each carrier has done, with its name.
    pub(super) fn status(&self) -> Vec<OutputReport> {
        let mut all = Vec::new();
        for output in &self.ports {
            let kinds: Vec<&'static str> = output.kinds.iter().map(|kind| kind.name()).collect();
            match &output.link {
                Link::One(carrier) => all.push(OutputReport {
                    name: output.section.name.clone(),
                    kinds,
                    status: carrier.status(),
                }),
                Link::Lan(_, carriers) => all.extend(carriers.iter().map(|(group, carrier)| {
                    let name = format!("{} {}", output.section.name, group.name());
                    OutputReport { name, kinds: kinds.clone(), status: carrier.status() }
                })),
            }
        }
        all
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.ports.len()
    }

    /// Hands the messages of an epoch over to the port of this index; never waits.
    pub(super) fn send(&mut self, port: usize, messages: &[PortMessage]) {
        match self.ports.get_mut(port).map(|output| &mut output.link) {
            Some(Link::One(carrier)) => {
                for PortMessage { slot, content, valid, period, .. } in messages {
                    let (slot, bytes) = (*slot, content.to_bytes());
                    carrier.send(Outgoing { slot, bytes, valid: *valid, period: *period });
                }
            }
            Some(Link::Lan(lan, carriers)) => {
                let utc = messages.first().and_then(|first| first.utc);
                for datagram in lan.datagrams(messages, utc) {
                    let carrier = carriers.iter().find(|(group, _)| *group == datagram.group);
                    let Some((_, carrier)) = carrier else { continue };
                    carrier.send(Outgoing {
                        slot: datagram.slot,
                        bytes: datagram.bytes,
                        valid: datagram.valid,
                        period: datagram.period,
                    });
                }
            }
            None => {}
        }
    }

    /// Tells what each port has sent, and how old it was by then.
    pub(super) fn tell(&self) {
        for output in &self.ports {
            match &output.link {
                Link::One(carrier) => output.tell(carrier, None),
                Link::Lan(_, carriers) => {
                    for (group, carrier) in carriers {
                        output.tell(carrier, Some(*group));
                    }
                }
            }
        }
    }

    /// Takes note of what became of one of them.
    pub(super) fn note(&self, arrival: &Arrival) {
        let index = usize::from(arrival.port.0.saturating_sub(self.first));
        if let (Some(name), Input::State(state)) = (self.names.get(index), &arrival.input) {
            if let PortState::Refused { host, .. } = state {
                tracing::warn!(target: SECURITY, output = name, host, "{state}");
            } else {
                tracing::info!(output = name, "{state}");
            }
        }
    }

    fn link(
        &mut self,
        section: &OutputSection,
        port: &Port,
        surroundings: &Surroundings,
    ) -> Option<Link> {
        if let Some(carrier) = section.carrier() {
            return Some(Link::One(self.carrier(section.name.clone(), carrier, surroundings)));
        }
        let lan = section.lan.as_ref()?;
        let sender = Lan::new(lan.config()?);
        let open = |group: TransmissionGroup| {
            let name = format!("{} {}", section.name, group.name());
            (group, self.carrier(name, OutputConfig::new(to(lan, group)), surroundings))
        };
        let carriers = sender.groups(port).into_iter().map(open).collect();
        Some(Link::Lan(Box::new(sender), carriers))
    }

    fn carrier(
        &mut self,
        name: String,
        config: OutputConfig,
        surroundings: &Surroundings,
    ) -> OutputPort {
        let number = u16::try_from(self.names.len()).unwrap_or(u16::MAX);
        let number = self.first.saturating_add(number);
        self.names.push(name);
        ports::spawn_output(PortId(number), config, surroundings.clone())
    }
}

impl Output {
    fn tell(&self, carrier: &OutputPort, group: Option<TransmissionGroup>) {
        let status = carrier.status();
        let (name, group) = (&self.section.name, group.map(TransmissionGroup::name));
        for slot in &status.slots {
            // on the network a slot is a datagram, which may hold several kinds
            let kind = self.kinds.get(usize::from(slot.slot)).filter(|_| group.is_none());
            let ms = |age: Span| (age.as_seconds() * 1e5).round() / 1e2;
            let of = |own: fn(&AgeStatus) -> Span| slot.age.as_ref().map(|age| ms(own(age)));
            let (p50_ms, p99_ms, max_ms) =
                (of(|age| age.p50), of(|age| age.p99), of(|age| age.max));
            let (message, sent, dropped) = (kind.map(|kind| kind.name()), slot.sent, slot.dropped);
            tracing::info!(
                output = name,
                group,
                message,
                sent,
                dropped,
                p50_ms,
                p99_ms,
                max_ms,
                "sent"
            );
        }
    }
}

/// Where a transmission group is.
fn to(lan: &LanSection, group: TransmissionGroup) -> Destination {
    let destination = UdpOutput::new((group.address(), group.port()).into());
    Destination::Udp(UdpOutput { ttl: lan.ttl, interface: lan.interface, ..destination })
}
