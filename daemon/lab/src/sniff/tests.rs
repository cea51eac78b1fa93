//! Claims about the statistics.

use insd_base::{Arrival, Input, PortId, PortState, Pulse, Stamp, Time, UtcTime};
use insd_drivers::ports::Transport as Opened;
use insd_intake::config::{Kind, SensorConfig};
use insd_wire::stream::Protocol;

use super::report::{PortReport, State};
use super::{PortToHear, Seen, SeenWhat, SniffReport, Sniffed, SuggestedTransport};

const PORT: PortId = PortId(0);

fn at(seconds: f64, input: Input) -> Arrival {
    let monotonic = Time::from_seconds(seconds);
    Arrival { stamp: Stamp { monotonic, system: UtcTime::from_nanos(0) }, port: PORT, input }
}

fn bytes(seconds: f64, bytes: &[u8]) -> Arrival {
    at(seconds, Input::Bytes(bytes.to_vec()))
}

fn opened(what: &str) -> Arrival {
    at(0.0, Input::State(PortState::Open { what: what.to_owned() }))
}

fn line(body: &str) -> Vec<u8> {
    let sum = body.bytes().fold(0, |sum, byte| sum ^ byte);
    format!("${body}*{sum:02X}\r\n").into_bytes()
}

fn sniffed(timed: bool) -> Sniffed {
    let mut sniffed = Sniffed::new(&Protocol::ALL);
    let device = "/dev/serial/by-id/gps".to_owned();
    let transport = Some(SuggestedTransport::Serial { device });
    sniffed.announce(PORT, PortToHear { name: "/dev/ttyUSB0".to_owned(), timed, transport });
    sniffed
}

/// The port after these arrivals at 10 s.
fn after(arrivals: &[Arrival]) -> PortReport {
    let mut sniffed = sniffed(true);
    arrivals.iter().for_each(|arrival| sniffed.take(arrival));
    only(sniffed.report(Time::from_seconds(10.0)))
}

fn only(report: SniffReport) -> PortReport {
    report.ports.into_iter().next().unwrap()
}

/// A line at each of so many tenths of a second.
fn lines(tenths: std::ops::Range<u32>, body: &str) -> Vec<Arrival> {
    let open = opened("/dev/ttyUSB0 at 4800 baud");
    let all = tenths.map(|tenth| bytes(f64::from(tenth) / 10.0, &line(body)));
    std::iter::once(open).chain(all).collect()
}

fn hints(port: &PortReport) -> String {
    port.hints.join("\n")
}

#[test]
fn a_message_has_its_count_rate_age_and_share_of_the_line() {
    let port = after(&lines(1..100, "HETHS,316.70,A"));
    let message = &port.messages[0];
    assert_eq!((message.name.as_str(), message.count, message.used), ("HETHS", 99, 99));
    assert!((message.rate_hz.unwrap() - 10.0).abs() < 1e-6, "{message:?}");
    assert!(message.jitter_ms.unwrap() < 1e-3, "{message:?}");
    assert!((message.age_s.unwrap() - 0.14).abs() < 0.01, "{message:?}");
    assert_eq!((port.state.clone(), port.baud), (State::Open, Some(4800)));
    assert!((port.load.unwrap() - 99.0 * 20.0 / 10.0 / 480.0).abs() < 1e-9);
    assert_eq!((port.talkers[0].name.as_str(), port.talkers[0].count), ("HE", 99));
    assert_eq!(port.hints, Vec::<String>::new());
}

#[test]
fn a_file_has_counts_but_no_rates() {
    let mut sniffed = sniffed(false);
    lines(1..30, "HETHS,316.70,A").iter().for_each(|arrival| sniffed.take(arrival));
    sniffed.take(&at(0.1, Input::State(PortState::Ended)));
    assert!(sniffed.is_ended() && sniffed.is_settled());
    let port = only(sniffed.report(Time::from_seconds(10.0)));
    assert_eq!((port.seconds, port.bytes_per_s, port.messages[0].rate_hz), (None, None, None));
    assert_eq!((port.messages[0].count, port.state), (29, State::Ended));
}

#[test]
fn a_refused_message_keeps_its_reason_and_its_bytes() {
    let port = after(&lines(1..3, "GPGGA,x,y"));
    let refusal = port.messages[0].refusal.clone().unwrap();
    assert_eq!(port.messages[0].refused, 2);
    assert!(refusal.bytes.starts_with("$GPGGA,x,y*") && !refusal.reason.is_empty());
}

#[test]
fn tag_sources_are_counted() {
    let tagged = b"UdPbC\0\\s:IN0001*4F\\$HETHS,316.70,E*1A\r\n";
    let port = after(&[opened("udp 239.192.0.1:60001"), bytes(0.1, tagged), bytes(0.2, tagged)]);
    assert_eq!((port.sources[0].name.as_str(), port.sources[0].count), ("IN0001", 2));
    assert_eq!((port.stray, port.baud, port.load), (0, None, None));
}

#[test]
fn rubbish_on_a_serial_line_is_told_with_its_likeliest_cause() {
    let junk: Vec<u8> =
        (0..60_000_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    let port = after(&[opened("/dev/ttyUSB0 at 4800 baud"), bytes(9.0, &junk)]);
    assert!(port.stray_share() > 0.9, "{port:?}");
    assert!(hints(&port).contains("wrong baud rate") && hints(&port).contains("`,auto`"));
    let text = b"U-Boot 2020.01 starting kernel\r\n".repeat(9);
    let console = after(&[opened("/dev/ttyUSB0 at 4800 baud"), bytes(9.0, &text)]);
    assert!(hints(&console).contains("text, but no sentences"), "{}", hints(&console));
}

#[test]
fn seven_bits_with_parity_are_recognised() {
    let even = |byte: &u8| byte | ((byte.count_ones() as u8 & 1) << 7);
    let sent: Vec<u8> = line("HETHS,316.70,A").repeat(5).iter().map(even).collect();
    let port = after(&[opened("/dev/ttyUSB0 at 4800 baud"), bytes(9.0, &sent)]);
    assert!(hints(&port).contains("reads as nmea: the line has 7 data bits"), "{}", hints(&port));
}

#[test]
fn damaged_and_missing_checksums_are_told() {
    let mut arrivals = lines(1..90, "HETHS,316.70,A");
    arrivals.extend((0..5).map(|_| bytes(9.1, b"$HETHS,316.71,E*1A\r\n")));
    arrivals.push(bytes(9.2, b"$HEHDT,316.71,T\r\n"));
    let port = after(&arrivals);
    assert_eq!(port.damaged, 5);
    assert!(hints(&port).contains("wrong checksum"), "{}", hints(&port));
    assert!(hints(&port).contains("no_checksum = true"), "{}", hints(&port));
}

#[test]
fn silence_absence_and_loss_have_their_advice() {
    let silent = after(&[opened("/dev/ttyUSB0 at 4800 baud")]);
    assert_eq!(silent.state, State::Silent { silent_s: 10.0 });
    assert!(hints(&silent).contains("not one byte"));
    let reason = "/dev/ttyUSB0: No such file or directory".to_owned();
    let absent = after(&[at(0.0, Input::State(PortState::Absent { reason }))]);
    assert!(matches!(absent.state, State::Absent { .. }) && hints(&absent).contains("insd ports"));
    let reason = "closed by the other end".to_owned();
    let lost = at(1.0, Input::State(PortState::Lost { reason }));
    let lost = after(&[opened("tcp 10.0.0.1:10110"), lost]);
    assert!(hints(&lost).contains("lost once"), "{}", hints(&lost));
}

#[test]
fn bytes_heard_at_no_rate_are_told_from_none() {
    let mut sniffed = sniffed(true);
    let reason = "/dev/ttyUSB0: nothing readable at 4800, 9600 baud".to_owned();
    sniffed.take(&at(0.0, Input::State(PortState::Absent { reason })));
    let told = |sniffed: &Sniffed| hints(&only(sniffed.report(Time::from_seconds(10.0))));
    assert!(told(&sniffed).contains("not one byte"));
    sniffed.unreadable(PORT, 77);
    assert!(told(&sniffed).contains("77 bytes were heard"));
}

#[test]
fn what_comes_from_our_own_clock_came_to_no_port() {
    let mut sniffed = sniffed(true);
    sniffed.take(&Arrival { port: PortId(u16::MAX), ..at(1.0, Input::Tick) });
    assert_eq!(sniffed.report(Time::from_seconds(10.0)).ports.len(), 1);
}

#[test]
fn pulses_are_counted() {
    let pulse =
        |n: u32| Input::Pulse(Pulse { time: Time::from_seconds(f64::from(n)), sequence: n });
    let port = after(&[opened("/dev/pps0"), at(8.0, pulse(8)), at(9.0, pulse(9))]);
    assert_eq!(port.pulses.as_ref().unwrap().interval_s, Some(1.0));
    assert_eq!(port.state, State::Open);
}

#[test]
fn memory_is_bounded_whatever_comes() {
    let mut sniffed = Sniffed::new(&Protocol::ALL);
    for n in 0..1000_u16 {
        let mut arrival = bytes(f64::from(n) / 100.0, &line(&format!("PX{n},{}", "x".repeat(90))));
        sniffed.take(&arrival);
        arrival.port = PortId(n);
        sniffed.take(&arrival);
    }
    let report = sniffed.report(Time::from_seconds(10.0));
    assert_eq!(report.ports.len(), super::PORTS);
    let first = only(report);
    assert_eq!(first.messages.iter().map(|m| m.count).sum::<u64>() + first.more, 1001);
    assert!(first.messages.len() < 100);
}

#[test]
fn what_comes_is_shown_frame_by_frame() {
    let mut sniffed = sniffed(true);
    let mut shown = Vec::new();
    let arrival = bytes(1.0, b"junk$HETHS,316.70,E*1A\r\n");
    sniffed.take_and_show(&arrival, |seen: &Seen<'_>| {
        shown.push(match seen.what {
            SeenWhat::Frame { name, .. } => name.to_owned(),
            SeenWhat::Stray { count, .. } => format!("{count} stray"),
            _ => "other".to_owned(),
        });
    });
    assert_eq!(shown, ["HETHS", "4 stray"]);
}

/// The suggested sections read as a configuration does.
fn suggested(port: &PortReport) -> (Opened, Vec<SensorConfig>) {
    #[derive(serde::Deserialize)]
    struct File {
        port: Vec<PortSection>,
        sensor: Vec<SensorConfig>,
    }
    #[derive(serde::Deserialize)]
    struct PortSection {
        transport: Opened,
    }
    let file: File = toml::from_str(&port.suggestions.concat()).unwrap();
    (file.port.into_iter().next().unwrap().transport, file.sensor)
}

#[test]
fn a_receiver_and_a_compass_on_one_line_are_suggested_as_a_configuration_reads_them() {
    let mut arrivals = lines(0..1, "HETHS,316.70,A");
    for second in 1..10 {
        for body in [
            "GPGGA,120000.00,3500.0000,N,05957.0000,W,1,08,1.0,20.0,M,10.0,M,,",
            "GPHDT,10.0,T",
            "HEHDT,11.0,T",
            "VDVBW,10.0,0.1,A,10.1,0.1,A",
        ] {
            arrivals.push(bytes(f64::from(second), &line(body)));
        }
    }
    let port = after(&arrivals);
    let (transport, sensors) = suggested(&port);
    let kinds: Vec<Kind> = sensors.iter().map(|sensor| sensor.kind).collect();
    assert_eq!(kinds, [Kind::NmeaGnss, Kind::NmeaLog, Kind::Compass]);
    assert!(sensors[0].heading && sensors[2].talkers == ["HE"], "{sensors:?}");
    assert!(port.suggestions[1].contains("1 Hz"), "{}", port.suggestions[1]);
    let Opened::Serial(serial) = transport else { panic!("{transport:?}") };
    assert_eq!(serial.device.to_str(), Some("/dev/serial/by-id/gps"));
    assert_eq!(serial.baud, 4800);
}

#[test]
fn a_magnetic_compass_is_suggested_as_such() {
    let port = after(&lines(0..50, "HCHDG,10.0,,,1.0,W"));
    let (_, sensors) = suggested(&port);
    assert!(sensors[0].kind == Kind::Compass && sensors[0].magnetic, "{sensors:?}");
}

#[test]
fn a_local_position_reference_is_suggested_with_where_its_axes_are_to_be_told() {
    let port = after(&lines(0..20, "RLS,+012.34,-105.60,A,271.500,A,0000"));
    let (_, sensors) = suggested(&port);
    assert_eq!(sensors[0].kind, Kind::Rls, "{sensors:?}");
    assert!(port.suggestions.concat().contains("[[ranging]]"), "{:?}", port.suggestions);
}

#[test]
fn an_imu_is_suggested_with_the_rate_to_which_it_was_set() {
    // the accelerations of the maker's SDK (mip_sdk, MIT)
    const ACCEL: [u8; 20] = *b"\x75\x65\x80\x0E\x0E\x04\x3F\x80\0\0\x40\0\0\0\xC0\x40\0\0\x79\xED";
    let mut arrivals = vec![opened("/dev/ttyUSB0 at 115200 baud")];
    arrivals.extend((0..990).map(|n| bytes(f64::from(n) * 0.010_01, &ACCEL)));
    let port = after(&arrivals);
    assert_eq!(port.messages[0].used, 990, "{port:?}");
    let (_, sensors) = suggested(&port);
    assert_eq!((sensors[0].kind, sensors[0].rate_hz), (Kind::Mip, 100.0));
}

/// A second of the R/V Nathaniel B. Palmer in August 2014 (OpenRVDAS).
fn palmer(second: u32) -> String {
    format!(
        "$GPZDA,0000{second:02},01,08,2014,7\r\n$GPGLL,2200.097,S,01756.346,W\r\n\
         $GPVTG,220.6,T,,M,009.7,N,018.0,K\r\n"
    )
}

#[test]
fn the_advice_for_lines_without_a_checksum_works_as_it_is_pasted() {
    let second = |second: u32| bytes(f64::from(second), palmer(second).as_bytes());
    let open = opened("/dev/ttyUSB0 at 4800 baud");
    let arrivals: Vec<Arrival> = std::iter::once(open).chain((0..10).map(second)).collect();
    let port = after(&arrivals);
    assert!(port.is_readable() && hints(&port).contains("no_checksum = true"), "{}", hints(&port));
    let (_, sensors) = suggested(&port);
    assert_eq!((sensors.len(), sensors[0].kind), (1, Kind::NmeaGnss));
    assert!(sensors[0].no_checksum, "{sensors:?}");
    // the ship that is configured so
    let name = sensors[0].port.clone();
    let ports = vec![insd_intake::config::PortSpec { name, link: super::port::link("/dev/x") }];
    let config = insd_intake::config::IntakeConfig {
        ports,
        sensors,
        ..insd_intake::config::IntakeConfig::default()
    };
    // nothing is wrong with what was pasted, but a ship needs an IMU besides
    assert!(config.faults().iter().all(|fault| fault.sensor.is_empty()), "{:?}", config.faults());
    let mut intake = insd_intake::Intake::new(&config);
    arrivals.iter().for_each(|arrival| intake.handle(arrival));
    let status = &intake.status().sensors[0];
    assert!(status.heard.is_some() && status.refused.is_empty(), "{status:?}");
}

#[test]
fn the_mounting_of_a_log_is_suggested_by_the_axes_that_it_tells() {
    use insd_wire::log::pd0::{Coordinates, Ensemble};
    let explorer: String = include_str!("../../../../drivers/wire/tests/data/pd0_explorer.hex")
        .lines()
        .filter(|line| !line.starts_with('#'))
        .flat_map(str::chars)
        .filter(char::is_ascii_hexdigit)
        .collect();
    let frame: Vec<u8> = (0..explorer.len() / 2)
        .map(|at| u8::from_str_radix(&explorer[2 * at..2 * at + 2], 16).unwrap())
        .collect();
    let mut ensemble = Ensemble::read(&frame).unwrap();
    let mut suggestion = |coordinates, alignment: f64| {
        ensemble.fixed.transformation.coordinates = coordinates;
        ensemble.fixed.heading_alignment = alignment.to_radians();
        let port = after(&[opened("/dev/ttyUSB0 at 4800 baud"), bytes(1.0, &ensemble.write())]);
        let (_, sensors) = suggested(&port);
        (sensors[0].mounting, port.suggestions[1].clone())
    };
    for coordinates in [Coordinates::Beam, Coordinates::Instrument] {
        let (mounting, text) = suggestion(coordinates, 45.0);
        assert_eq!(mounting, insd_intake::mounting::Mounting::rdi(45_f64.to_radians(), false));
        assert!(text.contains("beam 3 points 45.0 deg"), "{text}");
    }
    let (mounting, text) = suggestion(Coordinates::Ship, 45.0);
    assert_eq!(mounting, insd_intake::mounting::Mounting::default());
    assert!(text.contains("axes of the ship"), "{text}");
    assert!(suggestion(Coordinates::Earth, 0.0).1.contains("EX10111"));
}

#[test]
fn what_owners_have_is_suggested_by_its_kind() {
    let of = |bytes_of: &[u8]| {
        let open = opened("/dev/ttyUSB0 at 115200 baud");
        let all = (1..40_u32).map(|tenth| bytes(f64::from(tenth) / 10.0, bytes_of));
        let port = after(&std::iter::once(open).chain(all).collect::<Vec<_>>());
        suggested(&port)
            .1
            .into_iter()
            .map(|sensor| (sensor.kind, sensor.talkers))
            .collect::<Vec<_>>()
    };
    let loran = line("LCGLL,5000.00,N,00400.00,E,120000.00,A,A");
    assert_eq!(of(&loran), [(Kind::NmeaPosition, vec!["LC".to_owned()])]);
    let hpr = line("PSAT,HPR,235410.50,89.58,3.35,,N");
    assert_eq!(of(&hpr), [(Kind::Psat, Vec::new())]);
    let avr = line("PTNL,AVR,212405.20,+52.1531,Yaw,-0.0806,Tilt,,,12.575,3,1.4,16");
    assert_eq!(of(&avr), [(Kind::Ptnl, Vec::new())]);
    let oem = std::fs::read("../../fuzz/corpus/novatel/published.novatel").unwrap();
    let kinds: Vec<Kind> = of(&oem).into_iter().map(|(kind, _)| kind).collect();
    assert_eq!(kinds, [Kind::Novatel, Kind::NovatelImu, Kind::NovatelIns]);
    let seed = |name: &str| std::fs::read(format!("../../fuzz/corpus/{name}")).unwrap();
    let kinds = |name: &str| of(&seed(name)).into_iter().map(|own| own.0).collect::<Vec<_>>();
    assert_eq!(kinds("gsof/published.gsof"), [Kind::Gsof]);
    assert_eq!(kinds("vectornav/published.vectornav"), [Kind::Vectornav]);
    assert_eq!(kinds("ad2cp/recorded.ad2cp"), [Kind::Ad2cp]);
    assert_eq!(of(&line("PINSD,TRK,12.345,1,1,7,640.25,360.50")), [(Kind::Camera, Vec::new())]);
    let served = [Kind::SignalkHeading, Kind::SignalkLog, Kind::SignalkPosition];
    assert_eq!(kinds("signalk/made.signalk"), served);
    let kmb = std::fs::read("../../fuzz/corpus/kmb/telegrams.kmb").unwrap();
    assert_eq!(of(&kmb[..132]), [(Kind::Kmb, Vec::new())]);
}
