//! Sections of a configuration for what was recognised.

use insd_wire::stream::Protocol;

use super::bus;
use super::plan::SuggestedTransport;
use super::report::{MessageReport, PortReport};

/// Rates that devices can be set to, Hz.
const RATES: [f64; 20] = [
    1.0, 2.0, 4.0, 5.0, 8.0, 10.0, 20.0, 25.0, 40.0, 50.0, 80.0, 100.0, 125.0, 200.0, 250.0, 400.0,
    500.0, 800.0, 1000.0, 2000.0,
];

/// How near a measured rate must be to one of them to be taken for it.
const NEAR: f64 = 0.04;

/// Talkers of satellite receivers.
const RECEIVERS: [&str; 7] = ["GP", "GN", "GL", "GA", "GB", "GQ", "BD"];

/// The talker of Loran receivers.
const LORAN: &str = "LC";

/// How the numbers of messages of RTCM begin that tell measurements: GPS, GLONASS, Galileo, BeiDou.
const MEASURED: [&str; 4] = ["RTCM 107", "RTCM 108", "RTCM 109", "RTCM 112"];

/// Messages of RTCM that tell where a base is.
const BASES: [&str; 2] = ["1005", "1006"];

/// Sentences that are read of a receiver.
const RECEIVED: [&str; 8] = ["GGA", "GNS", "GLL", "RMC", "VTG", "ZDA", "GST", "GSA"];

/// A sensor that a port carries.
#[derive(Clone, Debug, Default, PartialEq)]
struct Sensor {
    kind: &'static str,
    /// Beginning of its name.
    role: &'static str,
    /// The talker after which it is named.
    talker: Option<String>,
    protocol: &'static str,
    rate: Option<f64>,
    keys: Vec<String>,
    notes: Vec<String>,
}

/// The port's section, if what it opens is known, and one for each sensor on it, as TOML.
pub(super) fn sections(port: &PortReport, transport: Option<&SuggestedTransport>) -> Vec<String> {
    let name = plain(&port.name);
    let mut sections: Vec<String> =
        sensors(port).iter().map(|sensor| sensor.section(&name)).collect();
    sections.extend(port.bus.iter().flat_map(|bus| bus::suggestion::sections(bus, &name)));
    if let Some(transport) = transport.filter(|_| !sections.is_empty()) {
        sections.insert(0, port_section(&name, transport, port.baud));
    }
    sections
}

fn port_section(name: &str, transport: &SuggestedTransport, baud: Option<u32>) -> String {
    let inside = match transport {
        SuggestedTransport::Serial { device } => {
            let baud = baud.map_or(String::new(), |baud| format!(", baud = {baud}"));
            format!("{{ kind = \"serial\", device = {}{baud} }}", quoted(device))
        }
        SuggestedTransport::Other(table) => table.clone(),
    };
    format!("[[port]]\nname = {}\ntransport = {inside}\n", quoted(name))
}

/// A text as TOML has it.
pub fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

/// A name without what is not needed in it: `/dev/ttyUSB0` is `ttyUSB0`.
fn plain(name: &str) -> String {
    let last = name.rsplit(['/', '@']).next().filter(|last| !last.is_empty()).unwrap_or(name);
    let good = |c: char| if c.is_ascii_alphanumeric() || "-_".contains(c) { c } else { '-' };
    last.chars().map(good).collect()
}

impl Sensor {
    fn section(&self, port: &str) -> String {
        let mut text = format!("[[sensor]] # {}", self.protocol);
        if let Some(rate) = self.rate {
            text.push_str(&format!(", {rate} Hz"));
        }
        let talker = self
            .talker
            .as_ref()
            .map_or(String::new(), |talker| format!("-{}", talker.to_lowercase()));
        let name = quoted(&format!("{}{talker}-{port}", self.role));
        text.push_str(&format!("\nname = {name}\nport = {}\n", quoted(port)));
        text.push_str(&format!("kind = \"{}\"\n", self.kind));
        for line in &self.keys {
            text.push_str(&format!("{line}\n"));
        }
        for note in &self.notes {
            text.push_str(&format!("# {note}\n"));
        }
        text
    }

    fn note(mut self, note: &str) -> Self {
        self.notes.push(note.to_owned());
        self
    }

    fn key(mut self, line: String) -> Self {
        self.keys.push(line);
        self
    }
}

fn sensors(port: &PortReport) -> Vec<Sensor> {
    let binary = [
        imu(port, Protocol::Sbg, "sbg", |name| name.starts_with("IMU_")),
        imu(port, Protocol::StdBin, "stdbin", |_| true)
            .map(|own| own.note("as a compass and not as an IMU: kind = \"stdbin_ins\"")),
        imu(port, Protocol::Mip, "mip", |_| true),
        imu(port, Protocol::Xbus, "xbus", |_| true),
        imu(port, Protocol::Kvh, "kvh", |_| true).map(|sensor| {
            sensor.note("what the unit was told to send cannot be seen: check [sensor.kvh]")
        }),
        imu(port, Protocol::Stim, "stim", |name| name != "STIM configuration").map(|sensor| {
            sensor.note("unless the unit sends its configuration, check [sensor.stim]")
        }),
        imu(port, Protocol::VectorNav, "vectornav", |_| true)
            .map(|own| own.note("as a compass and not as an IMU: kind = \"vectornav_ins\"")),
        ublox(port),
        plain_sensor(port, Protocol::Gsof, "gsof", "gnss", "")
            .map(|own| own.note("records 1, 2, 8 and 12 must be among what it sends")),
        plain_sensor(port, Protocol::Sbf, "sbf", "gnss", "SBF 4007")
            .or_else(|| plain_sensor(port, Protocol::Sbf, "sbf", "gnss", "SBF 4006"))
            .or_else(|| raw_only(port, Protocol::Sbf, "sbf", "SBF 4027"))
            .or_else(|| plain_sensor(port, Protocol::Sbf, "sbf", "gnss", "SBF ")),
        plain_sensor(port, Protocol::Novatel, "novatel", "gnss", "BEST").map(|own| span(own, port)),
        imu(port, Protocol::Novatel, "novatel_imu", |name| {
            name.starts_with("RAWIMU") && name.ends_with('X')
        }),
        plain_sensor(port, Protocol::Novatel, "novatel_ins", "compass", "INSPVA"),
        plain_sensor(port, Protocol::Pd0, "pd0", "log", "").map(|log| mounted(log, port)),
        plain_sensor(port, Protocol::Pd6, "pd6", "log", "PD6 :B").map(|log| mounted(log, port)),
    ];
    let mut sensors: Vec<Sensor> =
        binary.into_iter().chain(motion(port)).chain(adapted(port)).flatten().collect();
    let has_receiver = sensors.iter().any(|sensor| sensor.role == "gnss");
    match receiver(port) {
        Some(sensor) if !has_receiver => sensors.push(sensor),
        Some(_) => beside(&mut sensors),
        None if !has_receiver => sensors.extend(measured_by_rtcm(port)),
        None => {}
    }
    sensors.extend(served(port).into_iter().chain([seen(port)]).flatten());
    sensors.extend(loran(port));
    sensors.extend(logs(port).into_iter().flatten());
    sensors.extend(compasses(port));
    sensors.extend(own(port, "psxn", "psxn", "PSXN"));
    sensors.extend(own(port, "psat", "psat", "PSAT"));
    sensors.extend(own(port, "pfec", "pfec", "PFEC"));
    sensors.extend(
        own(port, "ptnl", "ptnl", "PTNL").map(|sensor| {
            sensor.note("heading_offset_deg: how the line between its antennas lies")
        }),
    );
    sensors.extend(
        own(port, "rls", "rls", "RLS")
            .map(|sensor| sensor.note("its axes must be told in [[ranging]] (docs/berthing.md)")),
    );
    sensors.extend(own(port, "pashr", "pashr", "PASHR").map(|sensor| {
        sensor.note("dialect must be stated: sbg, sbg_wassp, ixblue, novatel, trimble or applanix")
    }));
    sensors
}

/// The front end of a camera, by points or by steps.
fn seen(port: &PortReport) -> Option<Sensor> {
    let told =
        ["PINSD,TRK", "PINSD,VO"].iter().find_map(|part| own(port, "camera", "camera", part))?;
    Some(told.note("how it sits must be told in [camera] (docs/camera.md)"))
}

/// Logs by sentences and by records.
fn logs(port: &PortReport) -> [Option<Sensor>; 3] {
    [
        sentences(port, "nmea_log", "log", &["VBW", "VHW"]),
        own(port, "nortek", "log", "PNORBT")
            .map(|sensor| sensor.note("x forward, y to starboard, z down; else tell its mounting")),
        plain_sensor(port, Protocol::Ad2cp, "ad2cp", "log", "AD2CP 17").map(|sensor| {
            sensor
                .note("it must tell XYZ; x forward, y to starboard, z down; else tell its mounting")
        }),
    ]
}

/// Motion sensors by their telegrams.
fn motion(port: &PortReport) -> [Option<Sensor>; 3] {
    [
        plain_sensor(port, Protocol::Kmb, "kmb", "motion", ""),
        plain_sensor(port, Protocol::Em3000, "em3000", "motion", ""),
        plain_sensor(port, Protocol::Tss1, "tss1", "motion", "")
            .map(|own| own.note("it tells no heading: name it in a [[watch]] (docs/watch.md)")),
    ]
}

/// What a Signal K server tells, of each the first who told it.
fn served(port: &PortReport) -> [Option<Sensor>; 3] {
    [
        ("signalk_heading", "compass", "navigation.headingTrue"),
        ("signalk_log", "log", "navigation.speedThroughWater"),
        ("signalk_position", "position", "navigation.position"),
    ]
    .map(|(kind, role, path)| {
        let start = format!("SIGNALK {path} ");
        let mut told = used(port, Protocol::SignalK);
        let source = told.find_map(|message| message.name.strip_prefix(&start))?;
        let sensor = plain_sensor(port, Protocol::SignalK, kind, role, &start)?;
        Some(sensor.key(format!("source = {}", quoted(source))))
    })
}

/// Devices of a bus behind an adapter.
fn adapted(port: &PortReport) -> [Option<Sensor>; 3] {
    [
        plain_sensor(port, Protocol::Ngt1, "n2k_gnss", "gnss", "PGN 129029"),
        plain_sensor(port, Protocol::Ngt1, "n2k_heading", "compass", "PGN 127250"),
        plain_sensor(port, Protocol::Ngt1, "n2k_log", "log", "PGN 130578")
            .or_else(|| plain_sensor(port, Protocol::Ngt1, "n2k_log", "log", "PGN 128259")),
    ]
}

/// Messages of a protocol that are used, or would be if lines without a checksum were taken.
fn used(port: &PortReport, protocol: Protocol) -> impl Iterator<Item = &MessageReport> {
    let is = move |message: &&MessageReport| {
        message.protocol == protocol && message.used + message.bare > 0
    };
    port.messages.iter().filter(is)
}

/// The key without which a sensor of these messages would lose one of them.
fn with_checksum<'a>(
    sensor: Sensor,
    mut messages: impl Iterator<Item = &'a MessageReport>,
) -> Sensor {
    if messages.any(|message| message.bare > message.used) {
        return sensor.key("no_checksum = true".to_owned());
    }
    sensor
}

/// A log of RDI with its mounting, as far as the axes of its velocities need one.
fn mounted(log: Sensor, port: &PortReport) -> Sensor {
    let told = used(port, Protocol::Pd0).find_map(|message| message.axes);
    let ships = used(port, Protocol::Pd6).any(|message| message.name.ends_with("BS"));
    let (frame, up, alignment) = match told {
        Some(axes) => (axes.frame, axes.up, axes.alignment_deg),
        None => (if ships { "ship" } else { "instrument" }, false, 0.0),
    };
    match frame {
        "ship" => log.note("it tells the axes of the ship, by its own heading alignment (EA)"),
        "earth" => log
            .note("it tells east and north by its own compass, and errs with it: better set it to")
            .note("the axes of the ship (EX10111)"),
        _ => {
            let axes = if up {
                "\"port\", \"forward\", \"down\""
            } else {
                "\"starboard\", \"forward\", \"up\""
            };
            let turn = format!("rotation_deg = [0.0, 0.0, {alignment:?}]");
            log.key(format!("mounting = {{ axes = [{axes}], {turn} }}"))
                .note(&format!("{frame} axes: so it hangs if its beam 3 points {alignment:?} deg"))
                .note("clockwise from the bow, as its heading alignment (EA) says")
        }
    }
}

fn imu(
    port: &PortReport,
    protocol: Protocol,
    kind: &'static str,
    is_imu: fn(&str) -> bool,
) -> Option<Sensor> {
    let messages = used(port, protocol).filter(|message| is_imu(&message.name));
    let most = messages.max_by_key(|message| message.count)?;
    let sensor = Sensor { kind, role: "imu", protocol: protocol.name(), ..Sensor::default() };
    Some(match most.rate_hz.map(round) {
        Some(rate) => Sensor { rate: Some(rate), ..sensor }.key(format!("rate_hz = {rate:?}")),
        None => sensor.note("rate_hz: the rate could not be measured"),
    })
}

fn plain_sensor(
    port: &PortReport,
    protocol: Protocol,
    kind: &'static str,
    role: &'static str,
    start: &str,
) -> Option<Sensor> {
    let mut messages = used(port, protocol).filter(|message| message.name.starts_with(start));
    let rate = messages.next()?.rate_hz.map(round);
    Some(Sensor { kind, role, protocol: protocol.name(), rate, ..Sensor::default() })
}

/// A NovAtel receiver, by what else it sends.
fn span(mut sensor: Sensor, port: &PortReport) -> Sensor {
    let has =
        |start: &str| used(port, Protocol::Novatel).any(|message| message.name.starts_with(start));
    if has("HEADING2") || has("DUALANTENNA") {
        sensor = sensor.key("heading = true".to_owned());
        sensor = sensor.note("heading_offset_deg: how the line between its antennas lies");
    }
    if (has("INSPVA") || has("RAWIMU")) && !has("BESTGNSS") {
        sensor = sensor.note("of a SPAN system BESTPOS is its own inertial place: let it send BESTGNSSPOS and BESTGNSSVEL");
    }
    sensor
}

/// A u-blox receiver: by its fixes, else by what it measured, else as a compass.
fn ublox(port: &PortReport) -> Option<Sensor> {
    let has = |name: &str| used(port, Protocol::Ubx).any(|message| message.name == name);
    let told = |start| plain_sensor(port, Protocol::Ubx, "ubx", "gnss", start);
    let fix = ["NAV-PVT", "NAV-POSLLH", "NAV-SOL"].iter().find_map(|start| told(start));
    let mut sensor = fix
        .or_else(|| raw_only(port, Protocol::Ubx, "ubx", "RXM-RAWX"))
        .or_else(|| told("NAV-RELPOSNED"))?;
    if has("NAV-POSLLH") && !["NAV-PVT", "NAV-SOL", "NAV-STATUS"].iter().any(|name| has(name)) {
        sensor = sensor.note(
            "neither NAV-SOL nor NAV-STATUS: the receiver does not tell whether it has a fix",
        );
    }
    if has("NAV-RELPOSNED") {
        sensor = sensor.key("heading = true".to_owned());
        sensor = sensor.note("NAV-RELPOSNED is a heading only if the base moves with the ship;");
        sensor =
            sensor.note("heading_offset_deg: how the line from its antenna to the receiver's lies");
    }
    Some(sensor)
}

/// A receiver that tells what it measured, and no fix.
fn raw_only(
    port: &PortReport,
    protocol: Protocol,
    kind: &'static str,
    start: &str,
) -> Option<Sensor> {
    let sensor = plain_sensor(port, protocol, kind, "gnss", start)?;
    Some(sensor.note("it tells no fixes of its own: insd makes them of what it measures"))
}

/// A receiver whose measurements come in RTCM; a stream that tells where its antenna stands is a base's.
fn measured_by_rtcm(port: &PortReport) -> Option<Sensor> {
    let is_base = |message: &MessageReport| {
        message.protocol == Protocol::Rtcm
            && BASES.iter().any(|number| message.name.ends_with(number))
    };
    if port.messages.iter().any(is_base) {
        let base = |start: &&str| plain_sensor(port, Protocol::Rtcm, "rtcm_base", "base", start);
        return MEASURED.iter().find_map(base);
    }
    MEASURED.iter().find_map(|start| raw_only(port, Protocol::Rtcm, "rtcm", start))
}

/// Used sentences of these formatters.
fn with_formatter<'a>(
    port: &'a PortReport,
    formatters: &'a [&str],
) -> impl Iterator<Item = &'a MessageReport> {
    used(port, Protocol::Nmea).filter(move |message| {
        !message.name.starts_with('P')
            && message.name.get(2..).is_some_and(|own| formatters.contains(&own))
    })
}

fn talker(message: &MessageReport) -> &str {
    message.name.get(..2).unwrap_or_default()
}

fn is_receiver(message: &MessageReport) -> bool {
    RECEIVERS.contains(&talker(message))
}

fn receiver(port: &PortReport) -> Option<Sensor> {
    let mut positions = with_formatter(port, &["GGA", "GNS", "RMC", "GLL"]);
    let first = positions.find(|message| talker(message) != LORAN)?;
    let mut sensor = Sensor {
        kind: "nmea_gnss",
        role: "gnss",
        protocol: "nmea",
        rate: first.rate_hz.map(round),
        ..Sensor::default()
    };
    if with_formatter(port, &["HDT", "THS"]).any(is_receiver) {
        sensor = sensor.key("heading = true".to_owned());
        sensor = sensor.note("heading_offset_deg: how the baseline of the antennas lies");
    }
    if with_formatter(port, &["GST"]).next().is_none() {
        sensor = sensor.note("no GST: the receiver does not say how good its position is");
    }
    if with_formatter(port, &["ZDA", "RMC"]).next().is_none() {
        sensor = sensor.note("neither ZDA nor RMC: the receiver does not tell the date");
    }
    Some(with_checksum(sensor, with_formatter(port, &RECEIVED)))
}

/// A receiver of Loran, whose place is not one by satellites.
fn loran(port: &PortReport) -> Option<Sensor> {
    let mut positions = with_formatter(port, &["GGA", "GNS", "RMC", "GLL"]);
    let rate = positions.find(|message| talker(message) == LORAN)?.rate_hz.map(round);
    let sensor = Sensor {
        kind: "nmea_position",
        role: "loran",
        protocol: "nmea",
        rate,
        ..Sensor::default()
    };
    let sensor = sensor.key(format!("talkers = [\"{LORAN}\"]"));
    Some(sensor.note(
        "position_std_m must be told: what the corrections of the ground leave (docs/sensors.md)",
    ))
}

/// A receiver that speaks binary, too, is read in that language alone.
fn beside(sensors: &mut [Sensor]) {
    for sensor in sensors.iter_mut().filter(|sensor| sensor.role == "gnss") {
        sensor.notes.push("its NMEA positions are not needed beside this".to_owned());
    }
}

fn sentences(
    port: &PortReport,
    kind: &'static str,
    role: &'static str,
    formatters: &[&str],
) -> Option<Sensor> {
    let rate = with_formatter(port, formatters).next()?.rate_hz.map(round);
    let sensor = Sensor { kind, role, protocol: "nmea", rate, ..Sensor::default() };
    Some(with_checksum(sensor, with_formatter(port, formatters)))
}

/// A sensor of makers' own sentences.
fn own(port: &PortReport, kind: &'static str, role: &'static str, start: &str) -> Option<Sensor> {
    let is_read = |message: &&MessageReport| {
        message.name.starts_with(start)
            && (kind != "nortek" || matches!(message.name.as_bytes().last(), Some(b'6'..=b'9')))
    };
    let rate = used(port, Protocol::Nmea).find(is_read)?.rate_hz.map(round);
    let sensor = Sensor { kind, role, protocol: "nmea", rate, ..Sensor::default() };
    Some(with_checksum(sensor, used(port, Protocol::Nmea).filter(is_read)))
}

/// One compass for each talker that tells a heading and is no receiver.
fn compasses(port: &PortReport) -> Vec<Sensor> {
    let headings = with_formatter(port, &["HDT", "THS", "HDG", "HDM"]);
    let headings: Vec<_> = headings.filter(|message| !is_receiver(message)).collect();
    let mut talkers: Vec<&str> = headings.iter().map(|message| talker(message)).collect();
    talkers.dedup();
    let is_alone = port.talkers.len() < 2;
    let compass = |of: &&str| {
        let own = || headings.iter().filter(|message| talker(message) == *of);
        let rate = own().next().and_then(|message| message.rate_hz).map(round);
        let mut sensor = Sensor {
            kind: "compass",
            role: "compass",
            protocol: "nmea",
            rate,
            ..Sensor::default()
        };
        if !is_alone {
            sensor = sensor.key(format!("talkers = [\"{of}\"]"));
            sensor.talker = Some((*of).to_owned());
        }
        if own().all(|message| message.name.ends_with("HDG") || message.name.ends_with("HDM")) {
            sensor = sensor.key("magnetic = true".to_owned());
        }
        with_checksum(sensor, own().copied())
    };
    talkers.iter().map(compass).collect()
}

/// The rate to which a device was probably set, Hz.
pub(super) fn round(rate: f64) -> f64 {
    let near = |nominal: &&f64| (rate / **nominal - 1.0).abs() < NEAR;
    RATES.iter().find(near).copied().unwrap_or((rate * 100.0).round() / 100.0)
}
