//! From what the engine knows to the messages of all ports: daemon and replay run this very code, so that
//! a recording replays to the bytes that were sent.

use insd_base::{
    AlignmentStatus, Arrival, Geodetic, Heave, Message as Measurement, Motion, Received, Span,
    StorageFaults, Time, UtcTime,
};
use insd_engine::{Engine, Output};
use insd_n2k::pgn::TimeSource;
use insd_output::{
    Contradicted, Doubts, OutputEpoch, OutputStation, PortMessage, SatelliteGeometry, Situation,
    Variation, WakeUp,
};
use insd_wire::nmea::{Acn, AlertCommand, Sentence};

use crate::alert_commands::{AlertCommands, Who};
use crate::plan::OutputPlan;

/// The year of the World Magnetic Model in use.
const MODEL: u16 = 2025;
/// The variation is found again after this time: she moves by less than its own error until then.
const VARIATION_SPAN: Span = Span::from_nanos(60_000_000_000);
/// What a receiver said of its fix holds for so long.
const RECEIVER_SPAN: Span = Span::from_nanos(5_000_000_000);

/// Of those who may not command one is answered in this time: they do not fill the bridge's line.
const REFUSAL_SPAN: Span = Span::from_nanos(1_000_000_000);

/// A command of the bridge about an alert, and what became of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Commanded {
    /// Who gave it.
    pub who: Who,
    /// What it was.
    pub command: Acn,
    /// Whether it was obeyed. Where the sender may not command it never is.
    pub obeyed: bool,
    /// Commands of senders who may not command, at all ports since the start.
    pub strangers: u64,
}

/// Who knows how the ship moves.
pub trait Knows {
    /// How the IMU moves.
    fn motion(&self) -> Option<Motion>;
    /// Heave of each monitoring point.
    fn heaves(&self) -> Vec<Option<Heave>>;
    /// Whether two engines are apart by more than they claim.
    fn engines_differ(&self) -> bool {
        false
    }
    /// What is doubted of installation and sensors.
    fn doubts(&self) -> Doubts;
}

impl Knows for Engine {
    fn motion(&self) -> Option<Motion> {
        Engine::motion(self)
    }

    fn heaves(&self) -> Vec<Option<Heave>> {
        Engine::heaves(self)
    }

    fn doubts(&self) -> Doubts {
        Doubts::of(self.findings())
    }
}

/// What leaves at a boundary.
#[derive(Clone, Debug, PartialEq)]
pub enum Spoken {
    /// Messages of one epoch for the port of this index.
    Messages(usize, Vec<PortMessage>),
    /// What is known of each monitoring point: for buses and for whoever looks on.
    Epochs(Vec<OutputEpoch>),
}

/// All ports, and what they are told beside the ship's motion.
#[derive(Debug)]
pub struct Outputs {
    station: OutputStation,
    commands: AlertCommands,
    alignment: Option<AlignmentStatus>,
    receiver: Option<(Time, SatelliteGeometry)>,
    variation: Option<(Time, Variation)>,
    storage: StorageFaults,
    contradicted: Contradicted,
    /// Commands of those who may not command, and when one of them was answered last.
    strangers: (u64, Option<Time>),
}

impl Outputs {
    /// The outputs of a plan.
    #[must_use]
    pub fn new(plan: OutputPlan) -> Self {
        Outputs {
            station: OutputStation::new(plan.ports, plan.points, plan.groups)
                .with_berths(plan.berths),
            commands: AlertCommands::new(plan.obeyed),
            alignment: None,
            receiver: None,
            variation: None,
            storage: StorageFaults::default(),
            contradicted: Contradicted::default(),
            strangers: (0, None),
        }
    }

    /// Takes note of what arrived: commands about alerts, and the heartbeat of who gives them. Tells what
    /// became of each command; those that follow a refused one of a stranger at once are only counted.
    pub fn overhear(
        &mut self,
        arrival: &Arrival,
        utc: Option<UtcTime>,
        mut tell: impl FnMut(Commanded),
    ) {
        let now = arrival.stamp.monotonic;
        let Some((who, sentences)) = self.commands.hear(arrival) else { return };
        for sentence in sentences {
            match sentence {
                Sentence::Acn(command) => {
                    let obeyed = if who.may_command {
                        self.station.acknowledge(&command, now, utc)
                    } else if self.is_to_be_answered(now) {
                        self.station.refuse(&command, now, utc);
                        false
                    } else {
                        continue;
                    };
                    let (who, strangers) = (who.clone(), self.strangers.0);
                    tell(Commanded { who, command, obeyed, strangers });
                }
                Sentence::Hbt(heartbeat) if who.may_command => self.station.hear(&heartbeat, now),
                _ => {}
            }
        }
    }

    /// Counts a command of somebody who may not command; whether it is answered.
    fn is_to_be_answered(&mut self, now: Time) -> bool {
        let (count, last) = self.strangers;
        let answered = last.is_none_or(|last| now - last >= REFUSAL_SPAN);
        self.strangers = (count + 1, if answered { Some(now) } else { last });
        answered
    }

    /// Takes note of what cannot be written on the disk.
    pub fn note_storage(&mut self, faults: StorageFaults) {
        self.storage = faults;
    }

    /// Takes note of which references that are watched are contradicted.
    pub fn note_contradicted(&mut self, contradicted: Contradicted) {
        self.contradicted = contradicted;
    }

    /// Obeys the operator about an alert; whether it could.
    pub fn obey(
        &mut self,
        identifier: u32,
        command: AlertCommand,
        now: Time,
        utc: Option<UtcTime>,
    ) -> bool {
        self.station.obey(identifier, command, now, utc)
    }

    /// Chooses a berth by its name, or again the nearest; whether there is such a berth.
    pub fn choose_berth(&mut self, name: Option<&str>) -> bool {
        self.station.choose_berth(name)
    }

    /// Speaks from now on to other ports, knowing and alerting of what it did.
    pub fn succeed(&mut self, next: Outputs) {
        let Outputs { mut station, commands, .. } = next;
        station.inherit(&self.station);
        (self.station, self.commands) = (station, commands);
    }

    /// Its ports.
    #[must_use]
    pub fn station(&self) -> &OutputStation {
        &self.station
    }

    /// How the alignment stands, as the engine told it last.
    #[must_use]
    pub fn alignment(&self) -> Option<AlignmentStatus> {
        self.alignment
    }

    /// Takes note of a measurement on its way to the engine.
    pub fn hear(&mut self, received: &Received) {
        if let Measurement::Gnss(fix) = &received.message {
            let own = SatelliteGeometry {
                satellites: fix.satellites,
                hdop: fix.hdop,
                ..SatelliteGeometry::default()
            };
            let measured = fix.quality.is_measured() && fix.position.is_some();
            self.receiver = measured.then_some((fix.time, own)).or(self.receiver);
        }
    }

    /// Takes note of what the engine says.
    pub fn note(&mut self, output: &Output) {
        if let Output::Alignment(status) = output {
            self.alignment = Some(*status);
        }
    }

    /// The next instant at which something is due, and what.
    #[must_use]
    pub fn next(&self, now: Time, utc: Option<UtcTime>) -> Option<WakeUp> {
        self.station.next(now, utc)
    }

    /// Says what has become due up to now.
    pub fn speak(
        &mut self,
        engine: &impl Knows,
        now: Time,
        utc: Option<UtcTime>,
        mut say: impl FnMut(Spoken),
    ) {
        let due = self.station.due(now, utc);
        if due.is_empty() {
            return;
        }
        let moment = self.moment(engine, now, utc);
        for boundary in due {
            let epochs = self.station.messages(&boundary, &moment, |port, messages| {
                say(Spoken::Messages(port, messages));
            });
            say(Spoken::Epochs(epochs));
        }
    }

    fn moment(&mut self, engine: &impl Knows, now: Time, utc: Option<UtcTime>) -> Situation {
        let motion = engine.motion();
        let place = motion.map(|motion| motion.solution.position);
        let receiver = self.receiver.filter(|(told, _)| now - *told <= RECEIVER_SPAN);
        Situation {
            motion,
            heaves: engine.heaves(),
            time_source: utc.map(|_| TimeSource::Gps),
            variation: place.zip(utc).and_then(|(place, utc)| self.variation(&place, now, utc)),
            receiver: receiver.map(|(_, receiver)| receiver),
            alignment: self.alignment,
            engines_differ: engine.engines_differ(),
            doubts: engine.doubts(),
            storage: self.storage,
            contradicted: self.contradicted,
        }
    }

    fn variation(&mut self, place: &Geodetic, now: Time, utc: UtcTime) -> Option<Variation> {
        let known = self.variation.filter(|(found, _)| now - *found < VARIATION_SPAN);
        if known.is_none() {
            let day = u16::try_from(utc.as_nanos().div_euclid(86_400 * 1_000_000_000)).ok();
            let value = insd_intake::variation(place, utc);
            self.variation = value.map(|value| (now, Variation { value, model: MODEL, day }));
        }
        self.variation.map(|(_, variation)| variation)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::{Body, Input, PortId, Sent, Stamp};
    use insd_engine::EngineConfig;
    use insd_output::{Manner, MessageKind, OutputPortConfig, Rate};
    use insd_wire::nmea::{Acn, AlertCommand, AlertId, Manufacturer, Talker, TimeOfDay};

    const BRIDGE: PortId = PortId(3);

    /// A port that tells alerts of simulated data once a second.
    fn simulated() -> OutputPortConfig {
        let alerts = MessageKind::named("ALF").unwrap();
        OutputPortConfig {
            messages: vec![(alerts, Rate::from_hertz(1.0))],
            manner: Manner { simulated: true, ..Manner::default() },
            ..OutputPortConfig::default()
        }
    }

    fn obeying_the_bridge() -> Outputs {
        let (ports, points) = (vec![simulated()], vec![Body::default()]);
        Outputs::new(OutputPlan { ports, points, obeyed: vec![BRIDGE], ..OutputPlan::default() })
    }

    /// Formatters of what is told in some seconds.
    fn told(outputs: &mut Outputs, seconds: std::ops::Range<i64>) -> Vec<String> {
        let scenario = insd_simulator::Scenario::from_toml(insd_simulator::shipped()[6].1).unwrap();
        let header = insd_simulator::simulate(&scenario.with_duration(1.0), 1).header;
        let engine = Engine::new(EngineConfig::for_voyage(&header, 10.0));
        let mut formatters = Vec::new();
        for tenth in seconds.start * 10..seconds.end * 10 {
            outputs.speak(&engine, Time::from_nanos(tenth * 100_000_000), None, |spoken| {
                let Spoken::Messages(_, messages) = spoken else { return };
                for message in messages {
                    let bytes = message.content.to_bytes();
                    formatters.push(String::from_utf8_lossy(&bytes[3..6]).into_owned());
                }
            });
        }
        formatters
    }

    fn acn() -> Vec<u8> {
        let manufacturer = Manufacturer::new("INS");
        let alert = AlertId { manufacturer, identifier: 10_006, instance: None };
        let time = TimeOfDay::from_nanos(0);
        let line = Acn { time, alert, command: AlertCommand::Acknowledge }.write(Talker::IN);
        line.as_bytes().to_vec()
    }

    fn arrival(port: PortId, input: Input) -> Arrival {
        let monotonic = Time::from_seconds(5.0);
        let stamp = Stamp { monotonic, system: UtcTime::from_nanos(0) };
        Arrival { stamp, port, input }
    }

    fn command(port: PortId) -> Arrival {
        arrival(port, Input::Bytes(acn()))
    }

    fn sent(host: &str, may_command: bool, bytes: &[u8]) -> Arrival {
        let (host, bytes) = (host.to_owned(), bytes.to_vec());
        arrival(BRIDGE, Input::Sent(Sent { host, may_command, bytes }))
    }

    #[test]
    fn commands_about_alerts_are_taken_from_the_port_that_is_obeyed_and_from_no_other() {
        let mut outputs = obeying_the_bridge();
        assert!(told(&mut outputs, 0..5).contains(&"ALF".to_owned()));
        outputs.overhear(&command(PortId(2)), None, |_| {});
        assert_eq!(told(&mut outputs, 5..8), Vec::<String>::new());
        // a caution has nothing to acknowledge, so the command is refused
        outputs.overhear(&command(BRIDGE), None, |_| {});
        assert_eq!(told(&mut outputs, 8..11), ["ARC"]);
    }

    /// What is told of a command when it arrives.
    fn heard(outputs: &mut Outputs, arrival: &Arrival) -> Vec<(Option<String>, bool, u64)> {
        let mut all = Vec::new();
        outputs.overhear(arrival, None, |own| {
            all.push((own.who.host, own.who.may_command, own.strangers));
        });
        all
    }

    #[test]
    fn a_command_of_a_host_that_is_not_listed_is_refused_counted_and_told() {
        let mut outputs = obeying_the_bridge();
        told(&mut outputs, 0..5);
        let stranger = sent("10.0.0.9", false, &acn());
        let name = Some("10.0.0.9".to_owned());
        assert_eq!(heard(&mut outputs, &stranger), [(name, false, 1)]);
        // however many follow, the bridge's line is not filled with refusals
        (0..100).for_each(|_| assert_eq!(heard(&mut outputs, &stranger), []));
        assert_eq!(told(&mut outputs, 5..8), ["ARC"]);
        let bridge = sent("10.0.0.2", true, &acn());
        assert_eq!(heard(&mut outputs, &bridge), [(Some("10.0.0.2".to_owned()), true, 101)]);
    }

    #[test]
    fn what_two_hosts_say_is_not_put_together() {
        let mut outputs = obeying_the_bridge();
        let line = acn();
        let (first, second) = line.split_at(10);
        assert_eq!(heard(&mut outputs, &sent("10.0.0.9", false, first)), []);
        assert_eq!(heard(&mut outputs, &sent("10.0.0.2", true, second)), []);
        for stranger in 0..100 {
            heard(&mut outputs, &sent(&format!("10.0.1.{stranger}"), false, b"$"));
        }
        assert_eq!(heard(&mut outputs, &sent("10.0.0.2", true, first)), []);
        assert_eq!(heard(&mut outputs, &sent("10.0.0.2", true, second)).len(), 1);
    }
}
