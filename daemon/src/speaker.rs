//! From what the engine knows to the messages of all ports: daemon and replay run this very code, so that
//! a recording replays to the bytes that were sent.

use insd_base::{
    AlignmentStatus, Arrival, Geodetic, Heave, Message as Measurement, Motion, PortId, Received,
    Span, Time, UtcTime,
};
use insd_engine::{Engine, Output};
use insd_n2k::pgn::TimeSource;
use insd_output::{Doubts, Epoch, Message, Moment, Receiver, Station, Variation};
use insd_wire::nmea::{AlertCommand, Sentence};

use crate::ears::Ears;

/// The year of the World Magnetic Model in use.
const MODEL: u16 = 2025;
/// The variation is found again after this time: she moves by less than its own error until then.
const VARIATION_SPAN: Span = Span::from_nanos(60_000_000_000);
/// What a receiver said of its fix holds for so long.
const RECEIVER_SPAN: Span = Span::from_nanos(5_000_000_000);

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
    Messages(usize, Vec<Message>),
    /// What is known of each monitoring point: for buses and for whoever looks on.
    Epochs(Vec<Epoch>),
}

/// All ports, and what they are told beside the ship's motion.
#[derive(Debug)]
pub struct Speaker {
    station: Station,
    ears: Ears,
    alignment: Option<AlignmentStatus>,
    receiver: Option<(Time, Receiver)>,
    variation: Option<(Time, Variation)>,
}

impl Speaker {
    /// A speaker for these ports.
    #[must_use]
    pub fn new(station: Station) -> Self {
        let ears = Ears::default();
        Speaker { station, ears, alignment: None, receiver: None, variation: None }
    }

    /// The same, obeying the alert management of the bridge on these ports.
    #[must_use]
    pub fn obeying(self, ports: impl IntoIterator<Item = PortId>) -> Self {
        Speaker { ears: Ears::new(ports), ..self }
    }

    /// Takes note of what arrived: commands about alerts, and the heartbeat of who gives them.
    pub fn overhear(&mut self, arrival: &Arrival, utc: Option<UtcTime>) {
        let now = arrival.stamp.monotonic;
        for sentence in self.ears.hear(arrival) {
            match sentence {
                Sentence::Acn(command) => self.station.acknowledge(&command, now, utc),
                Sentence::Hbt(heartbeat) => self.station.hear(&heartbeat, now),
                _ => {}
            }
        }
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

    /// Speaks from now on to other ports, knowing and alerting of what it did.
    pub fn succeed(&mut self, next: Speaker) {
        let Speaker { mut station, ears, .. } = next;
        station.inherit(&self.station);
        (self.station, self.ears) = (station, ears);
    }

    /// Its ports.
    #[must_use]
    pub fn station(&self) -> &Station {
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
            let own =
                Receiver { satellites: fix.satellites, hdop: fix.hdop, ..Receiver::default() };
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

    /// The next instant at which something is due.
    #[must_use]
    pub fn next(&self, now: Time, utc: Option<UtcTime>) -> Option<Time> {
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

    fn moment(&mut self, engine: &impl Knows, now: Time, utc: Option<UtcTime>) -> Moment {
        let motion = engine.motion();
        let place = motion.map(|motion| motion.solution.position);
        let receiver = self.receiver.filter(|(told, _)| now - *told <= RECEIVER_SPAN);
        Moment {
            motion,
            heaves: engine.heaves(),
            time_source: utc.map(|_| TimeSource::Gps),
            variation: place.zip(utc).and_then(|(place, utc)| self.variation(&place, now, utc)),
            receiver: receiver.map(|(_, receiver)| receiver),
            alignment: self.alignment,
            engines_differ: engine.engines_differ(),
            doubts: engine.doubts(),
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
    use insd_base::{Body, Input, Stamp};
    use insd_engine::EngineConfig;
    use insd_output::{Manner, MessageKind, PortConfig, Rate};
    use insd_wire::nmea::{Acn, AlertCommand, AlertId, Manufacturer, Talker, TimeOfDay};

    const BRIDGE: PortId = PortId(3);

    /// A port that tells alerts of simulated data once a second.
    fn simulated() -> PortConfig {
        let alerts = MessageKind::named("ALF").unwrap();
        PortConfig {
            messages: vec![(alerts, Rate::from_hertz(1.0))],
            manner: Manner { simulated: true, ..Manner::default() },
            ..PortConfig::default()
        }
    }

    /// Formatters of what is told in some seconds.
    fn told(speaker: &mut Speaker, seconds: std::ops::Range<i64>) -> Vec<String> {
        let scenario = insd_simulator::Scenario::from_toml(insd_simulator::shipped()[6].1).unwrap();
        let header = insd_simulator::simulate(&scenario.with_duration(1.0), 1).header;
        let engine = Engine::new(EngineConfig::for_voyage(&header, 10.0));
        let mut formatters = Vec::new();
        for tenth in seconds.start * 10..seconds.end * 10 {
            speaker.speak(&engine, Time::from_nanos(tenth * 100_000_000), None, |spoken| {
                let Spoken::Messages(_, messages) = spoken else { return };
                for message in messages {
                    let bytes = message.content.to_bytes();
                    formatters.push(String::from_utf8_lossy(&bytes[3..6]).into_owned());
                }
            });
        }
        formatters
    }

    fn command(port: PortId) -> Arrival {
        let manufacturer = Manufacturer::new("INS");
        let alert = AlertId { manufacturer, identifier: 10_006, instance: None };
        let time = TimeOfDay::from_nanos(0);
        let line = Acn { time, alert, command: AlertCommand::Acknowledge }.write(Talker::IN);
        let monotonic = Time::from_seconds(5.0);
        let stamp = Stamp { monotonic, system: UtcTime::from_nanos(0) };
        Arrival { stamp, port, input: Input::Bytes(line.as_bytes().to_vec()) }
    }

    #[test]
    fn commands_about_alerts_are_taken_from_the_port_that_is_obeyed_and_from_no_other() {
        let station = Station::new([simulated()], vec![Body::default()], None);
        let mut speaker = Speaker::new(station).obeying([BRIDGE]);
        assert!(told(&mut speaker, 0..5).contains(&"ALF".to_owned()));
        speaker.overhear(&command(PortId(2)), None);
        assert_eq!(told(&mut speaker, 5..8), Vec::<String>::new());
        // a caution has nothing to acknowledge, so the command is refused
        speaker.overhear(&command(BRIDGE), None);
        assert_eq!(told(&mut speaker, 8..11), ["ARC"]);
    }
}
