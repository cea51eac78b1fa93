//! A simulated voyage as the raw recording that the daemon would have made of it.

use std::path::Path;

use insd_base::{Arrival, Input, PortId, PortState, Span, Stamp, Time, Voyage};
use insd_config::Config;
use insd_drivers::raw::{RawHeader, RawWriter, RecordingConfig};
use insd_vessel::Pipeline;
use insd_wire::nmea::{Acn, AlertCommand, AlertId, Talker};

use crate::feed::{Encoding, FeedConfig, Reception, arrivals, feed};

/// The port of what comes from the daemon's own clock.
const NOWHERE: PortId = PortId(u16::MAX);

/// What reached the computer on a voyage, and how the daemon was configured.
#[derive(Clone, Debug)]
pub struct Recorded {
    /// The configuration as text.
    pub config: String,
    /// In their order, without the ticks of the daemon.
    pub arrivals: Vec<Arrival>,
    reception: Reception,
    ports: u16,
}

impl Recorded {
    /// A voyage by sensors of these encodings, one of each role on a serial line of its own, and a bridge
    /// that sends commands about alerts. `more` is appended to the configuration.
    #[must_use]
    pub fn new(voyage: &Voyage, encodings: &[Encoding], more: &str) -> Self {
        let feeds = FeedConfig::new(voyage, encodings);
        let start = feeds.sensors.first().unwrap().calendar.start;
        let reception = Reception::new(start, 1);
        let ports = encodings.len() as u16;
        let mut own = Recorded {
            config: configuration(voyage, &feeds, more),
            arrivals: arrivals(&feed(voyage, &feeds), &reception),
            reception,
            ports,
        };
        for port in 0..=ports {
            own.state(0.0, port, PortState::Open { what: format!("line {port}") });
        }
        own
    }

    /// Index of the port from which the bridge is heard.
    #[must_use]
    pub fn bridge(&self) -> u16 {
        self.ports
    }

    /// A port turns to another state.
    pub fn state(&mut self, seconds: f64, port: u16, state: PortState) {
        self.insert(seconds, port, Input::State(state));
    }

    /// Something else arrives.
    pub fn insert(&mut self, seconds: f64, port: u16, input: Input) {
        let stamp = self.reception.stamp(Time::from_seconds(seconds));
        let place = self.arrivals.partition_point(|own| own.stamp.monotonic < stamp.monotonic);
        self.arrivals.insert(place, Arrival { stamp, port: PortId(port), input });
    }

    /// The bridge acknowledges an alert.
    pub fn acknowledge(&mut self, seconds: f64, alert: AlertId) {
        let command = Acn { time: None, alert, command: AlertCommand::Acknowledge };
        let line = command.write(Talker::IN);
        self.insert(seconds, self.bridge(), Input::Bytes(line.as_bytes().to_vec()));
    }

    /// Nothing comes from a port for a while.
    pub fn silence(&mut self, port: u16, from: f64, to: f64) {
        let at = |seconds: f64| self.reception.stamp(Time::from_seconds(seconds)).monotonic;
        let span = at(from)..at(to);
        self.arrivals.retain(|own| own.port.0 != port || !span.contains(&own.stamp.monotonic));
    }

    /// Writes it, with the ticks at which the daemon would have spoken.
    pub fn write(&self, folder: &Path) {
        let config = Config::of_text(&self.config).unwrap();
        let mut pipeline = config.pipeline();
        let recording = RecordingConfig {
            name: "insd".to_owned(),
            rotate_bytes: u64::MAX,
            rotate_span: Span::from_seconds(3600.0),
            quota_bytes: None,
        };
        let program = format!("insd {}", env!("CARGO_PKG_VERSION"));
        let header = RawHeader { program, config: self.config.clone() };
        let mut writer = RawWriter::create(folder, recording, header).unwrap();
        let mut take = |arrival: &Arrival, pipeline: &mut Pipeline<Config>| {
            writer.record(arrival).unwrap();
            pipeline.handle(arrival, |_| {});
        };
        let first = self.arrivals.first().map(|arrival| arrival.stamp.monotonic);
        let mut now = first.unwrap_or(Time::START);
        for arrival in &self.arrivals {
            while let Some(due) =
                pipeline.wake_up(now).filter(|due| due.at < arrival.stamp.monotonic)
            {
                now = due.at.max(now);
                let early = arrival.stamp.monotonic - now;
                let system = arrival.stamp.system.plus(Span::from_nanos(-early.as_nanos()));
                let stamp = Stamp { monotonic: now, system };
                take(&Arrival { stamp, port: NOWHERE, input: Input::Tick }, &mut pipeline);
            }
            now = arrival.stamp.monotonic;
            take(arrival, &mut pipeline);
        }
        writer.flush().unwrap();
    }
}

fn configuration(voyage: &Voyage, feeds: &FeedConfig, more: &str) -> String {
    let shipped = include_str!("../../systemd/examples/survey.toml");
    let imu = shipped.find("[imu]").unwrap()..shipped.find("[[port]]").unwrap();
    let header = &voyage.header;
    let arm = |body: insd_base::Body| format!("[{:?}, {:?}, {:?}]", body.0.x, body.0.y, body.0.z);
    let start = match header.start {
        insd_base::StartCondition::Moored => "moored",
        insd_base::StartCondition::Underway => "underway",
    };
    let mut text = format!(
        "# made by a simulation\n[ship]\nstart = {start:?}\ngnss_lever_m = {}\nlog_lever_m = {}\n",
        arm(header.lever_arms.gnss),
        arm(header.lever_arms.log)
    );
    if let Some(place) = header.initial {
        let (latitude, longitude) = (place.latitude.to_degrees(), place.longitude.to_degrees());
        text.push_str(&format!("lat_deg = {latitude:.6}\nlon_deg = {longitude:.6}\n"));
        text.push_str(&format!("height_m = {:.1}\n", place.height));
    }
    text.push('\n');
    text.push_str(&shipped[imu]);
    let mut intake = feeds.intake(voyage);
    for (port, sensor) in intake.ports.iter_mut().zip(&mut intake.sensors) {
        let name = format!("{:?}", sensor.kind.role()).to_lowercase();
        (port.name, sensor.port, sensor.name) = (name.clone(), name.clone(), name);
    }
    for (index, port) in intake.ports.iter().enumerate() {
        let device = format!("/dev/ttyS{index}");
        text.push_str(&format!("[[port]]\nname = {:?}\n", port.name));
        text.push_str(&format!(
            "transport = {{ kind = \"serial\", device = {device:?}, baud = 921600 }}\n\n"
        ));
    }
    text.push_str(
        "[[port]]\nname = \"bridge\"\nalerts = true\n\
         transport = { kind = \"udp\", bind = \"127.0.0.1:60004\" }\n\n",
    );
    for sensor in &intake.sensors {
        let table = toml::Table::try_from(sensor).unwrap();
        let wrapped = toml::Table::from_iter([("sensor".to_owned(), vec![table].into())]);
        text.push_str(&wrapped.to_string());
        text.push('\n');
    }
    text.push_str(more);
    text
}

/// An alert of our own by its identifier; one of a standard below 10000.
#[must_use]
pub fn alert(identifier: u32) -> AlertId {
    let own = insd_wire::nmea::Manufacturer::new("INS");
    let manufacturer = own.filter(|_| identifier >= 10_000);
    AlertId { manufacturer, identifier, instance: None }
}
