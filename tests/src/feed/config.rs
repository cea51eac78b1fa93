//! The configuration of an intake that fits what is fed to it.

use insd_base::{Voyage, units::DEG};
use insd_intake::config::{
    Dialect, IntakeConfig, Kind, KvhSettings, PortSpec, Role, SensorConfig, StimSettings,
};
use insd_intake::mounting::{Direction, Mounting};
use insd_intake::port::Link;
use insd_intake::sensor::TimeBase;
use insd_wire::log::LogFrame;

use super::{Calendar, DeviceClock, Encoding, FeedConfig, SensorFeed, heading};

/// Bits of a byte with its start and stop bits.
const BITS: f64 = 10.0;

impl Encoding {
    /// The intake's word for it.
    #[must_use]
    pub fn kind(self) -> Kind {
        match self {
            Encoding::Sbg => Kind::Sbg,
            Encoding::Stdbin => Kind::Stdbin,
            Encoding::Mip => Kind::Mip,
            Encoding::Xbus(_) => Kind::Xbus,
            Encoding::Kvh { .. } => Kind::Kvh,
            Encoding::Stim => Kind::Stim,
            Encoding::Ubx => Kind::Ubx,
            Encoding::Sbf => Kind::Sbf,
            Encoding::NmeaGnss => Kind::NmeaGnss,
            Encoding::Vbw => Kind::NmeaLog,
            Encoding::Pd0(_) => Kind::Pd0,
            Encoding::Pd6(_) => Kind::Pd6,
            Encoding::Nortek => Kind::Nortek,
            Encoding::Hdt | Encoding::Ths => Kind::Compass,
            Encoding::Psxn => Kind::Psxn,
            Encoding::Pashr => Kind::Pashr,
        }
    }
}

/// How the device of an encoding sits. Those of Exail and Xsens have their y axis to port and their z
/// axis up; a Doppler log of Teledyne has its third beam forward.
#[must_use]
pub(super) fn mounting(encoding: Encoding) -> Mounting {
    use Direction::{Forward, Port, Starboard, Up};
    let axes = match encoding {
        Encoding::Stdbin | Encoding::Xbus(_) => [Forward, Port, Up],
        Encoding::Pd0(LogFrame::Beam | LogFrame::Instrument)
        | Encoding::Pd6(LogFrame::Instrument) => [Starboard, Forward, Up],
        _ => return Mounting::default(),
    };
    Mounting { axes, ..Mounting::default() }
}

/// What the KVH unit is told to send: angles and accelerations.
pub(super) fn kvh() -> KvhSettings {
    KvhSettings::default()
}

/// What the STIM unit is told to send: increments.
pub(super) fn stim() -> StimSettings {
    StimSettings { gyro_increments: true, accel_increments: true, range_g: 10 }
}

impl SensorFeed {
    /// A sensor that is right, on a line of 921600 baud for an IMU and 115200 for the others.
    #[must_use]
    pub fn new(encoding: Encoding, calendar: &Calendar) -> Self {
        let role = encoding.kind().role();
        let (baud, latency) = match role {
            Role::Imu => (921_600.0, if encoding == Encoding::Stim { 0.0 } else { 0.002 }),
            Role::Gnss => (115_200.0, 0.06),
            _ => (115_200.0, 0.02),
        };
        let (clock, calendar) = (DeviceClock::default(), calendar.clone());
        SensorFeed { encoding, clock, calendar, latency, byte_time: BITS / baud }
    }

    /// The sensor as an installer would describe it.
    #[must_use]
    pub fn config(&self, name: String, voyage: &Voyage) -> SensorConfig {
        let heading = heading::headings(voyage).first().map(|told| told.std);
        // this log tells itself how old its message is
        let told = self.encoding == Encoding::Nortek;
        SensorConfig {
            port: name.clone(),
            name,
            kind: self.encoding.kind(),
            priority: 1,
            patience_s: 3.0,
            latency_s: if told { 0.0 } else { self.latency },
            rate_hz: voyage.header.imu.rate,
            time: TimeBase::Device,
            mounting: mounting(self.encoding),
            talkers: Vec::new(),
            heading_std_deg: heading.unwrap_or(DEG) / DEG,
            velocity_std_mps: voyage.log.iter().find_map(|log| log.message.std).unwrap_or(0.1),
            position_std_m: 10.0,
            heading_offset_deg: 0.0,
            heading: false,
            magnetic: false,
            no_checksum: false,
            dialect: (self.encoding == Encoding::Pashr).then_some(Dialect::Sbg),
            kvh: kvh(),
            stim: stim(),
        }
    }
}

impl FeedConfig {
    /// Sensors of these encodings that are right, for a voyage that starts when its header says.
    #[must_use]
    pub fn new(voyage: &Voyage, encodings: &[Encoding]) -> Self {
        let calendar = Calendar::new(&voyage.header.start_utc);
        let sensors = encodings.iter().map(|encoding| SensorFeed::new(*encoding, &calendar));
        FeedConfig { sensors: sensors.collect() }
    }

    /// The intake's configuration: sensor and port have the same name and index.
    #[must_use]
    pub fn intake(&self, voyage: &Voyage) -> IntakeConfig {
        let name = |index: usize| format!("sensor {index}");
        let sensors = self.sensors.iter().enumerate();
        IntakeConfig {
            ports: sensors
                .clone()
                .map(|(index, sensor)| PortSpec {
                    name: name(index),
                    link: Link::Serial { byte_time: sensor.byte_time },
                })
                .collect(),
            sensors: sensors.map(|(index, sensor)| sensor.config(name(index), voyage)).collect(),
        }
    }
}
