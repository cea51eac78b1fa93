//! What of the alerts leaves the ports, and when.

use insd_base::{Body, Mode, Motion};
use insd_output::alerts::{AlertView, Condition};
use insd_output::{
    Boundary, Lan, LanConfig, Manner, MessageKind, OutputPortConfig, OutputStation, PortMessage,
    Profile, Rate, Sfi, Situation, TransmissionGroup,
};
use insd_wire::nmea::{AlertCommand, AlertState, Alf, Sentence};

use super::{acn, at, solution};

/// A station that says ten times a second what is due.
struct Bridge {
    station: OutputStation,
    step: i32,
}

/// Sentences with the second at which each left.
type Heard = Vec<(f64, String)>;

impl Bridge {
    fn new(ports: impl IntoIterator<Item = OutputPortConfig>) -> Self {
        Bridge { station: OutputStation::new(ports, vec![Body::default()], None), step: 0 }
    }

    fn now(&self) -> Boundary {
        at(f64::from(self.step) / 10.0)
    }

    /// The messages of each port in so many seconds of a ship in a mode.
    fn messages(&mut self, seconds: f64, mode: Option<Mode>) -> Vec<(f64, usize, PortMessage)> {
        let mut heard = Vec::new();
        for _ in 0..(seconds * 10.0) as u32 {
            let now = self.now();
            let second = f64::from(self.step) / 10.0;
            self.station.messages(&now, &moment(&now, mode), |port, messages| {
                heard.extend(messages.into_iter().map(|message| (second, port, message)));
            });
            self.step += 1;
        }
        heard
    }

    fn hear(&mut self, seconds: f64, mode: Option<Mode>) -> Heard {
        let messages = self.messages(seconds, mode).into_iter();
        let lines = messages.flat_map(|(second, _, message)| {
            let text = String::from_utf8(message.content.to_bytes()).unwrap();
            let lines: Vec<String> = text.split_terminator("\r\n").map(str::to_owned).collect();
            lines.into_iter().map(move |line| (second, line))
        });
        lines.collect()
    }

    fn command(&mut self, condition: Condition, command: AlertCommand) {
        let now = self.now();
        self.station.acknowledge(&acn(condition, command), now.time, now.utc);
    }
}

fn moment(now: &Boundary, mode: Option<Mode>) -> Situation {
    let motion = mode.map(|mode| Motion {
        solution: insd_base::Solution { mode, ..solution(now.time) },
        acceleration: None,
        covariance: None,
        current: None,
    });
    Situation { motion, ..Situation::default() }
}

fn port(messages: &[(&str, f64)]) -> OutputPortConfig {
    let kind =
        |(name, hertz): &(&str, f64)| (MessageKind::named(name).unwrap(), Rate::from_hertz(*hertz));
    OutputPortConfig {
        messages: messages.iter().map(kind).collect(),
        ..OutputPortConfig::default()
    }
}

fn simulated(unmarked_when_simulated: bool) -> OutputPortConfig {
    let manner = Manner { simulated: true, unmarked_when_simulated, ..Manner::default() };
    OutputPortConfig { manner, ..alerts() }
}

fn alerts() -> OutputPortConfig {
    port(&[("ALF", 1.0), ("ALC", 1.0 / 30.0)])
}

fn stems(heard: &Heard) -> Vec<&str> {
    heard.iter().map(|(_, line)| line.split('*').next().unwrap()).collect()
}

fn titles(heard: &Heard) -> Vec<(f64, Alf)> {
    let alf = |(second, line): &(f64, String)| match Sentence::read(line.as_bytes()) {
        Ok((_, Sentence::Alf(alf))) if alf.number == 1 => Some((*second, alf)),
        _ => None,
    };
    heard.iter().filter_map(alf).collect()
}

const SOUND: Option<Mode> = Some(Mode::Aided);

#[test]
fn the_list_is_sent_every_30_s_also_when_it_is_empty() {
    let ecdis = Profile::named("ecdis").unwrap().port();
    let heard = Bridge::new([ecdis]).hear(301.0, SOUND);
    let lists: Heard = heard.into_iter().filter(|(_, line)| line.starts_with("$INALC")).collect();
    let times: Vec<f64> = lists.iter().map(|(second, _)| *second).collect();
    assert_eq!(times, (0..=10).map(|count| f64::from(count) * 30.0).collect::<Vec<_>>());
    assert_eq!(stems(&lists)[..2], ["$INALC,01,01,00,0", "$INALC,01,01,01,0"]);
}

#[test]
fn nothing_is_said_of_a_ship_on_which_nothing_happens() {
    let heard = Bridge::new([port(&[("ALF", 10.0)])]).hear(600.0, SOUND);
    assert_eq!(heard, []);
}

#[test]
fn who_looks_on_sees_all_alerts_as_the_bridge_is_told() {
    let mut bridge = Bridge::new([alerts()]);
    bridge.hear(60.0, SOUND);
    let told = titles(&bridge.hear(31.0, None));
    let views: Vec<AlertView> = bridge.station.alerts().views().collect();
    assert_eq!(views.len(), Condition::ALL.len());
    let active: Vec<&AlertView> =
        views.iter().filter(|view| view.state != AlertState::Normal).collect();
    let (_, alf) = told.last().unwrap();
    assert_eq!(active.len(), 1);
    assert_eq!((active[0].identifier, active[0].title), (3062, "System fault"));
    assert_eq!((Some(active[0].state), Some(active[0].priority)), (alf.state, alf.priority));
    assert_eq!(Some(active[0].escalation), alf.escalation);
    let changed = active[0].changed.and_then(insd_output::CivilTime::from_utc).unwrap();
    assert_eq!(
        alf.time.map(|time| (time.minute, time.second)),
        Some((changed.time.minute, changed.time.second))
    );
}

#[test]
fn a_fault_is_told_and_listed_with_the_same_revision() {
    let mut bridge = Bridge::new([alerts()]);
    bridge.hear(60.0, SOUND);
    let heard = bridge.hear(31.0, None);
    assert_eq!(
        stems(&heard),
        [
            "$INALC,01,01,02,0",
            "$INALF,2,1,0,030505.00,B,W,V,,3062,,1,0,System fault",
            "$INALF,2,2,0,,,,,,3062,,1,0,No solution. Check the IMU",
            "$INALC,01,01,03,1,,3062,,1",
        ]
    );
}

#[test]
fn each_port_tells_a_change_once_at_its_own_next_boundary() {
    let ports = [port(&[("ALF", 10.0)]), port(&[("ALF", 0.1)]), port(&[("HDT", 1.0)])];
    let mut bridge = Bridge::new(ports);
    bridge.hear(60.0, SOUND);
    let told = bridge.messages(60.0, None);
    let told: Vec<(f64, usize)> = told.iter().map(|(second, port, _)| (*second, *port)).collect();
    assert_eq!(told, [(65.0, 0), (70.0, 1)]);
}

#[test]
fn the_bridge_acknowledges_and_hears_that_it_has() {
    let mut bridge = Bridge::new([alerts()]);
    bridge.hear(60.0, SOUND);
    bridge.hear(10.0, None);
    bridge.command(Condition::SystemFault, AlertCommand::Acknowledge);
    let [(second, alf)] = titles(&bridge.hear(5.0, None))[..] else { panic!() };
    assert_eq!((alf.state, alf.revision), (Some(AlertState::Acknowledged), Some(2)));
    assert_eq!((second, alf.message), (70.0, 1), "the second message of this port");
    let [(_, alf)] = titles(&bridge.hear(30.0, SOUND))[..] else { panic!() };
    assert_eq!((alf.state, alf.revision), (Some(AlertState::Normal), Some(3)));
}

#[test]
fn what_cannot_be_done_is_refused_on_all_ports_that_tell_of_alerts() {
    let mut bridge = Bridge::new([alerts(), port(&[("ALF", 1.0)]), port(&[("ALC", 1.0 / 30.0)])]);
    bridge.hear(61.0, SOUND);
    bridge.command(Condition::HeadingLost, AlertCommand::Acknowledge);
    let heard = bridge.hear(10.0, SOUND);
    assert_eq!(stems(&heard), ["$INARC,030501.00,INS,10001,,A"; 2]);
}

#[test]
fn a_change_never_takes_the_place_of_another_alert_on_its_way() {
    let mut bridge = Bridge::new([alerts()]);
    bridge.hear(61.0, SOUND);
    for command in [AlertCommand::Silence, AlertCommand::Acknowledge] {
        bridge.command(Condition::HeadingLost, command);
    }
    let lost = bridge.messages(60.0, Some(Mode::DeadReckoning));
    let fault = bridge.messages(60.0, Some(Mode::Fault));
    let told = lost.iter().chain(&fault).filter(|(.., message)| message.kind.name() == "ALF");
    let slots: Vec<u16> = told.map(|(.., message)| message.slot).collect();
    let mut sorted = slots.clone();
    sorted.sort_unstable();
    sorted.dedup();
    assert_eq!(slots.len(), 5, "two refusals, estimated, normal again, fault");
    assert_eq!(sorted.len(), 4, "only the newer state of an alert takes the place of the older");
    assert!(slots.iter().all(|slot| *slot >= 2), "those of the port's list stay free");
}

#[test]
fn from_a_simulator_only_that_is_told() {
    for (unmarked, expected) in [(false, 1), (true, 2)] {
        let mut bridge = Bridge::new([simulated(unmarked)]);
        let heard = titles(&bridge.hear(60.0, Some(Mode::DeadReckoning)));
        let texts: Vec<String> = heard.iter().map(|(_, alf)| alf.text.to_string()).collect();
        assert_eq!(texts.len(), expected, "{texts:?}");
        assert_eq!(texts[0], Condition::Simulated.title());
    }
    let mut both = Bridge::new([alerts(), simulated(false)]);
    both.hear(1.0, SOUND);
    let list = both.messages(60.0, SOUND);
    let count = |own: usize| list.iter().filter(|(_, port, _)| *port == own).count();
    assert_eq!([count(0), count(1)], [2, 2]);
    for (_, port, message) in &list {
        let text = String::from_utf8(message.content.to_bytes()).unwrap();
        assert_eq!(text.contains("10006"), *port == 1, "{text}");
    }
}

#[test]
fn a_port_without_a_station_says_nothing_of_alerts() {
    let mut port = insd_output::Port::new(alerts());
    let epoch = insd_output::OutputEpoch {
        utc: at(0.0).utc,
        ..insd_output::OutputEpoch::unknown(at(0.0).time)
    };
    assert_eq!(port.messages(&epoch), []);
}

#[test]
fn the_longest_list_is_not_longer_than_its_line_was_reckoned_with() {
    let mut board = insd_output::alerts::AlertBoard::default();
    for condition in Condition::ALL {
        board.raise(condition, &at(0.0));
    }
    let mut entries = board.list(|_| true);
    entries.iter_mut().for_each(|entry| entry.revision = Some(99));
    let sentences = insd_wire::nmea::Alc::list(99, &entries);
    let longest = MessageKind::named("ALC").unwrap().longest();
    assert!(sentences.len() * 82 <= longest, "{}", sentences.len());
}

#[test]
fn the_two_sentences_of_an_alert_are_one_tag_group_on_the_network() {
    let mut bridge = Bridge::new([alerts()]);
    bridge.hear(60.0, SOUND);
    let messages: Vec<PortMessage> =
        bridge.messages(10.0, None).into_iter().map(|(.., message)| message).collect();
    let source = Sfi::new("IN0001").unwrap();
    let mut lan = Lan::new(LanConfig { source, groups: Vec::new(), time: false, single: false });
    let [datagram] = &lan.datagrams(&messages[1..], None)[..] else { panic!() };
    assert_eq!(datagram.group, TransmissionGroup::Navd);
    let text = std::str::from_utf8(&datagram.bytes).unwrap();
    assert!(text.starts_with("UdPbC\0\\g:1-2-1,s:IN0001,n:1*"), "{text}");
    assert!(text.contains("\\g:2-2-1,s:IN0001,n:2*"), "{text}");
}

#[test]
fn the_same_epochs_and_commands_give_the_same_bytes() {
    let run = || {
        let mut bridge = Bridge::new([alerts(), port(&[("ALF", 5.0)])]);
        let mut heard = bridge.hear(60.0, SOUND);
        heard.extend(bridge.hear(20.0, None));
        bridge.command(Condition::SystemFault, AlertCommand::Silence);
        heard.extend(bridge.hear(400.0, None));
        heard.extend(bridge.hear(60.0, Some(Mode::Inertial)));
        heard
    };
    assert_eq!(run(), run());
    assert!(run().len() > 20);
}
