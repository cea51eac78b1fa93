//! What is plugged in: ports by their link, sensors by their format and place.

use insd_base::{Body, Time};
use insd_wire::imu::can::LayoutChoice;
pub use insd_wire::nmea::PashrDialect as Dialect;
use insd_wire::stream::Protocol;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::base::BaseSettings;
use crate::device::DeviceFilter;
pub use crate::kind::{Kind, Role};
use crate::mounting::Mounting;
use crate::port::Link;
use crate::ranging::RangingSpec;
use crate::satellites::RawUse;
use crate::sensor::TimeBase;

/// What a KVH unit was told to send.
#[derive(Clone, Copy, Debug, PartialEq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct KvhSettings {
    /// Rates (`true`) or differences (`false`) of rotation.
    pub rates: bool,
    /// Rotation in degrees, else radians.
    pub degrees: bool,
    /// Velocity differences in m/s instead of accelerations in g.
    pub delta_velocity: bool,
    /// Temperature in hundredths of a degree.
    pub centidegrees: bool,
}

/// What a STIM unit was told to send; it need not be said if the unit sends its configuration.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct StimSettings {
    /// Gyros send increments instead of rates.
    pub gyro_increments: bool,
    /// Accelerometers send increments instead of accelerations.
    pub accel_increments: bool,
    /// Range of the accelerometers, g: 2, 5, 10, 30 or 80.
    pub range_g: u8,
}

/// One sensor as the installer describes it.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SensorConfig {
    /// Its name in tables and events.
    pub name: String,
    /// Name of its port.
    pub port: String,
    /// Its format.
    pub kind: Kind,
    /// Which of several is used: lower is better.
    #[serde(default = "one")]
    pub priority: u8,
    /// Silence or invalidity after which another takes over, and which is told, s.
    #[serde(default = "patience")]
    pub patience_s: f64,
    /// Time from the measurement to the first byte on the wire, beyond what the device tells, s.
    #[serde(default)]
    pub latency_s: f64,
    /// Of a receiver: its antenna from the IMU: forward, starboard, down, m. Left out, or zeros:
    /// `gnss_lever_m` of `[ship]`. Of a position that is watched: where it is of.
    #[serde(default)]
    pub lever_m: Option<[f64; 3]>,
    /// Of a receiver: by how much its fixes are older than the time they carry, s.
    #[serde(default)]
    pub delay_s: f64,
    /// Of a receiver: what is made of its raw messages, if it sends any.
    #[serde(default)]
    pub raw: RawUse,
    /// Of a receiver with raw messages: its antenna is one of those that together are a compass.
    #[serde(default)]
    pub array: bool,
    /// Of such a receiver: the oscillator that it shares with others that name the same one; its own if left out.
    #[serde(default)]
    pub clock: Option<String>,
    /// Of such a receiver: how well the phase centre of its antenna is known against those of the others, each component, 1-sigma, m.
    #[serde(default = "millimetres")]
    pub lever_std_m: f64,
    /// Of a base: what is known of it beside what it says.
    #[serde(default)]
    pub base: BaseSettings,
    /// Samples per second of an IMU.
    #[serde(default = "hundred")]
    pub rate_hz: f64,
    /// Whose time of an IMU's samples is believed.
    #[serde(default)]
    pub time: TimeBase,
    /// How an IMU or log sits. A log of RDI (PD0, PD6) of which nothing is told hangs as its maker has
    /// it: beam 3 forward by its own heading alignment.
    #[serde(default)]
    pub mounting: Mounting,
    /// Talkers that are heard, on a port that carries several; all if none is named.
    #[serde(default)]
    pub talkers: Vec<String>,
    /// 1-sigma of a heading that states none, deg.
    #[serde(default = "one_degree")]
    pub heading_std_deg: f64,
    /// 1-sigma of a velocity that states none, m/s.
    #[serde(default = "tenth")]
    pub velocity_std_mps: f64,
    /// 1-sigma of a position that states none, m.
    #[serde(default = "ten")]
    pub position_std_m: f64,
    /// 1-sigma of what stays for hours of the error of a position from elsewhere, beside that, m: of Loran, what the corrections of the ground leave.
    #[serde(default)]
    pub position_lasting_std_m: Option<f64>,
    /// Offset that is added to a heading, deg: how the compass or the baseline of antennas sits.
    #[serde(default)]
    pub heading_offset_deg: f64,
    /// Whether a receiver's own heading (two antennas) is used.
    #[serde(default)]
    pub heading: bool,
    /// Whether magnetic headings are used, with the variation of the sentence or of the world magnetic
    /// model.
    #[serde(default)]
    pub magnetic: bool,
    /// Whether lines without a checksum are taken.
    #[serde(default)]
    pub no_checksum: bool,
    /// Dialect of PASHR; it is never guessed.
    #[serde(default)]
    pub dialect: Option<Dialect>,
    /// Which device of NMEA 2000; any one that sends what the sensor's kind consists of if left out.
    #[serde(default)]
    pub device: Option<DeviceFilter>,
    /// Of a Signal K server: who told it, `$source` in its data browser. It is never guessed: the server may hand on what we told it.
    #[serde(default)]
    pub source: Option<String>,
    /// Whether the yaw of an attitude (127257) is the heading of a device that sends none (127250).
    #[serde(default)]
    pub yaw: bool,
    /// Whether a receiver of NMEA 2000 sends the altitude above the geoid instead of the ellipsoid.
    #[serde(default)]
    pub altitude_above_geoid: bool,
    /// The frames of a plain CAN IMU: the name of a table, or a table.
    #[serde(default)]
    pub layout: Option<LayoutChoice>,
    /// What a KVH unit was told to send.
    #[serde(default)]
    pub kvh: KvhSettings,
    /// What a STIM unit was told to send.
    #[serde(default)]
    pub stim: StimSettings,
}

/// A port as far as its bytes are concerned.
#[derive(Clone, Debug, PartialEq)]
pub struct PortSpec {
    /// Its name.
    pub name: String,
    /// What carries its bytes.
    pub link: Link,
}

/// Everything that is plugged in.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct IntakeConfig {
    /// Ports, in the order of their [`insd_base::PortId`].
    pub ports: Vec<PortSpec>,
    /// Sensors.
    pub sensors: Vec<SensorConfig>,
    /// Name of the only IMU that is used; the others are listened to. The best that is valid if left out.
    pub imu: Option<String>,
    /// Docking aids, in the order of their [`insd_base::Source`].
    pub rangings: Vec<RangingSpec>,
    /// Names of the sensors that are watched and not used.
    pub watched: Vec<String>,
}

/// A fault of a sensor's description.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ConfigFault {
    /// Name of the sensor.
    pub sensor: String,
    /// Key.
    pub key: &'static str,
    /// What was expected.
    pub expected: String,
}

fn one() -> u8 {
    1
}
fn patience() -> f64 {
    3.0
}
fn hundred() -> f64 {
    100.0
}
fn one_degree() -> f64 {
    1.0
}
fn tenth() -> f64 {
    0.1
}
/// What centres of phase of patch antennas differ by.
fn millimetres() -> f64 {
    0.002
}
fn ten() -> f64 {
    10.0
}

impl Default for StimSettings {
    fn default() -> Self {
        StimSettings { gyro_increments: false, accel_increments: false, range_g: 10 }
    }
}

impl IntakeConfig {
    /// All faults of the description, each with its sensor and key.
    #[must_use]
    pub fn faults(&self) -> Vec<ConfigFault> {
        let mut faults = Vec::new();
        for sensor in &self.sensors {
            sensor.look(self, &mut faults);
        }
        if !self.sensors.iter().any(|sensor| sensor.kind.role() == Role::Imu) {
            faults.push(ConfigFault {
                sensor: String::new(),
                key: "kind",
                expected: "at least one sensor that is an IMU".to_owned(),
            });
        }
        faults
    }

    /// The protocols that are spoken on a port.
    #[must_use]
    pub fn protocols(&self, port: &str) -> Vec<Protocol> {
        let mut protocols = Vec::new();
        for sensor in self.sensors.iter().filter(|sensor| sensor.port == port) {
            let adapter = sensor.kind.is_n2k() && !self.is_bus(port);
            let own = sensor.kind.protocol().or(adapter.then_some(Protocol::Ngt1));
            protocols.extend(own.filter(|own| !protocols.contains(own)));
        }
        protocols
    }

    /// Whether a port carries CAN frames.
    fn is_bus(&self, port: &str) -> bool {
        let mut own = self.ports.iter().filter(|own| own.name == port);
        own.any(|own| matches!(own.link, Link::Can { .. }))
    }

    /// Whether a sensor on a port is a device of NMEA 2000.
    #[must_use]
    pub fn speaks_n2k(&self, port: &str) -> bool {
        self.sensors.iter().any(|sensor| sensor.port == port && sensor.kind.is_n2k())
    }
}

impl SensorConfig {
    /// Whether something came within the sensor's patience.
    pub(crate) fn is_recent(&self, last: Option<Time>, now: Time) -> bool {
        last.is_some_and(|last| (now - last).as_seconds() <= self.patience_s)
    }

    /// A sensor of which nothing is said but what must be.
    #[must_use]
    pub fn new(name: &str, port: &str, kind: Kind) -> Self {
        SensorConfig {
            name: name.to_owned(),
            port: port.to_owned(),
            kind,
            priority: one(),
            patience_s: patience(),
            latency_s: 0.0,
            lever_m: None,
            delay_s: 0.0,
            raw: RawUse::default(),
            array: false,
            clock: None,
            lever_std_m: millimetres(),
            base: BaseSettings::default(),
            rate_hz: hundred(),
            time: TimeBase::default(),
            mounting: Mounting::default(),
            talkers: Vec::new(),
            heading_std_deg: one_degree(),
            velocity_std_mps: tenth(),
            position_std_m: ten(),
            position_lasting_std_m: None,
            heading_offset_deg: 0.0,
            heading: false,
            magnetic: false,
            no_checksum: false,
            dialect: None,
            device: None,
            source: None,
            yaw: false,
            altitude_above_geoid: false,
            layout: None,
            kvh: KvhSettings::default(),
            stim: StimSettings::default(),
        }
    }

    /// From the IMU to a receiver's own antenna, if that was measured.
    #[must_use]
    pub fn lever(&self) -> Option<Body> {
        let [forward, starboard, down] = self.lever_m.filter(|arm| *arm != [0.0; 3])?;
        Some(Body::new(forward, starboard, down))
    }

    fn look(&self, config: &IntakeConfig, faults: &mut Vec<ConfigFault>) {
        let mut expect = |good: bool, key, expected: &str| {
            if !good {
                let (sensor, expected) = (self.name.clone(), expected.to_owned());
                faults.push(ConfigFault { sensor, key, expected });
            }
        };
        let namesakes = config.sensors.iter().filter(|other| other.name == self.name);
        expect(namesakes.count() == 1, "name", "a name that no other sensor has");
        let known = config.ports.iter().any(|port| port.name == self.port);
        expect(known, "port", "the name of a port");
        let carries = config.ports.iter().filter(|port| port.name == self.port);
        let frames = |link: &Link| matches!(link, Link::Can { .. });
        // an adapter makes bytes of a bus
        let fits = self.kind.is_n2k()
            || carries
                .map(|port| frames(&port.link))
                .all(|own| own == self.kind.protocol().is_none());
        expect(fits, "kind", "a kind of sensor that the port can carry: CAN frames, or bytes");
        expect((0.1..=600.0).contains(&self.patience_s), "patience_s", "0.1 to 600 s");
        expect((0.0..=2.0).contains(&self.latency_s), "latency_s", "0 to 2 s");
        let is_receiver = self.kind.role() == Role::Gnss;
        let lever = self.lever_m.iter().flatten().all(|length| length.abs() <= 1000.0);
        expect(lever, "lever_m", "[forward, starboard, down] in m, each within +-1000");
        let has_place = is_receiver || config.watched.contains(&self.name);
        let expected = "a GNSS receiver, or a position that is watched";
        expect(self.lever_m.is_none() || has_place, "lever_m", expected);
        expect(self.delay_s.abs() <= 2.0, "delay_s", "-2 to 2 s");
        expect(self.delay_s == 0.0 || is_receiver, "delay_s", "a GNSS receiver");
        let has_raw = matches!(self.kind, Kind::Ubx | Kind::Sbf);
        let expected = "a receiver that sends more than raw data, if it is off: ubx, sbf";
        expect(self.raw == RawUse::Tight || has_raw, "raw", expected);
        self.look_at_array(config, &mut expect);
        self.look_at_speaker(&mut expect);
        expect(self.base.fault().is_none(), "base", self.base.fault().unwrap_or_default());
        let is_base = self.kind == Kind::RtcmBase || self.base == BaseSettings::default();
        expect(is_base, "base", "a base station, for only that has one");
        expect((1.0..=10_000.0).contains(&self.rate_hz), "rate_hz", "1 to 10000");
        let mounted = self.mounting.c_bd().is_some();
        expect(mounted, "mounting", "three directions that make a right-handed set, finite angles");
        let positive = |sigma: f64| sigma.is_finite() && sigma > 0.0;
        expect(positive(self.heading_std_deg), "heading_std_deg", "a number above 0");
        expect(positive(self.velocity_std_mps), "velocity_std_mps", "a number above 0");
        expect(positive(self.position_std_m), "position_std_m", "a number above 0");
        let expected = "a number above 0, of nmea_position, n2k_position or signalk_position alone";
        expect(self.may_last(), "position_lasting_std_m", expected);
        let offset = self.heading_offset_deg.abs() <= 360.0;
        expect(offset, "heading_offset_deg", "-360 to 360");
        let stated = self.kind != Kind::Pashr || self.dialect.is_some();
        let expected = "the dialect of PASHR: sbg, sbg_wassp, ixblue, novatel, trimble, applanix";
        expect(stated, "dialect", expected);
        expect(self.stim.format(1.0).is_some(), "stim.range_g", "2, 5, 10, 30 or 80");
        let laid_out = self.layout.is_some() == (self.kind == Kind::CanImu);
        expect(laid_out, "layout", "the table of frames of a can_imu, and of no other sensor");
        for fault in self.layout.iter().flat_map(|layout| layout.layout().faults()) {
            expect(false, "layout", &fault);
        }
    }

    /// Who of many on the same wire it is.
    fn look_at_speaker(&self, expect: &mut impl FnMut(bool, &'static str, &str)) {
        let filtered = self.device.is_none() || self.kind.is_n2k();
        expect(filtered, "device", "a sensor of NMEA 2000, for only those have a NAME");
        let is_told = self.source.is_some() == self.kind.is_signalk();
        let expected = "who told it to the Signal K server, of a sensor of one and of no other";
        expect(is_told, "source", expected);
    }

    /// Whether what stays of the error of a position is told of one from elsewhere alone.
    fn may_last(&self) -> bool {
        let is_placed =
            matches!(self.kind, Kind::NmeaPosition | Kind::N2kPosition | Kind::SignalkPosition);
        let is_one = |std: f64| std.is_finite() && std > 0.0 && is_placed;
        self.position_lasting_std_m.is_none_or(is_one)
    }

    fn look_at_array(
        &self,
        config: &IntakeConfig,
        expect: &mut impl FnMut(bool, &'static str, &str),
    ) {
        let measures = matches!(self.kind, Kind::Ubx | Kind::Sbf | Kind::Rtcm);
        let is_raw = measures && self.raw == RawUse::Tight;
        let expected = "a receiver whose raw messages are used: ubx, sbf, rtcm";
        expect(!self.array || is_raw, "array", expected);
        let members = config.sensors.iter().filter(|sensor| sensor.array).count();
        expect(!self.array || members > 1, "array", "two antennas at least that are an array");
        let expected = "where the antenna of an array stands, to a centimetre";
        expect(!self.array || self.lever().is_some(), "lever_m", expected);
        expect(self.clock.is_none() || self.array, "clock", "a receiver of an array");
        expect((0.0..=1.0).contains(&self.lever_std_m), "lever_std_m", "0 to 1 m");
    }
}
