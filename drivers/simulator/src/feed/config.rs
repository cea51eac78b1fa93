//! The configuration of an intake that fits what is fed to it.

use insd_base::{UtcTime, Voyage, units::DEG};
use insd_intake::config::{
    Dialect, IntakeConfig, Kind, KvhSettings, PortSpec, Role, SensorConfig, StimSettings,
};
use insd_intake::mounting::{Direction, Mounting};
use insd_intake::port::Link;
use insd_wire::imu::can::{ByteOrder, CanLayout, Field, FrameLayout, LayoutChoice, Shipped, What};
use insd_wire::imu::xbus::Precision;
use insd_wire::log::LogFrame;

use super::calendar::Calendar;
use super::sensor::{DeviceClock, Encoding, FeedConfig, SensorFeed};
use super::{heading, n2k};

/// Bits of a byte with its start and stop bits, and of one in a frame of a bus.
const BITS: f64 = 10.0;
const FRAME_BITS: f64 = 8.0;

impl Encoding {
    /// How a kind of sensor is encoded if nothing else is said; `None` of what is not fed as bytes.
    #[must_use]
    pub fn of(kind: Kind) -> Option<Self> {
        Some(match kind {
            Kind::Sbg => Encoding::Sbg,
            Kind::Stdbin => Encoding::Stdbin,
            Kind::Mip => Encoding::Mip,
            Kind::Xbus => Encoding::Xbus(Precision::Float64),
            Kind::Kvh => Encoding::Kvh { stamped: true },
            Kind::Stim => Encoding::Stim,
            Kind::Ubx => Encoding::Ubx,
            Kind::Sbf => Encoding::Sbf,
            Kind::NmeaGnss => Encoding::NmeaGnss,
            Kind::NmeaLog => Encoding::Vbw,
            Kind::Pd0 => Encoding::Pd0(LogFrame::Ship),
            Kind::Pd6 => Encoding::Pd6(LogFrame::Ship),
            Kind::Nortek => Encoding::Nortek,
            Kind::Compass => Encoding::Ths,
            Kind::Psxn => Encoding::Psxn,
            Kind::Pashr => Encoding::Pashr,
            Kind::Camera => Encoding::Tracks,
            Kind::Rtcm
            | Kind::Gsof
            | Kind::Vectornav
            | Kind::VectornavIns
            | Kind::Ad2cp
            | Kind::Novatel
            | Kind::NovatelImu
            | Kind::NovatelIns
            | Kind::Kmb
            | Kind::Em3000
            | Kind::Tss1
            | Kind::StdbinIns
            | Kind::Psat
            | Kind::Ptnl
            | Kind::Pfec
            | Kind::RtcmBase
            | Kind::NmeaPosition
            | Kind::SignalkHeading
            | Kind::SignalkLog
            | Kind::SignalkPosition
            | Kind::Manual
            | Kind::Ranging
            | Kind::Rls
            | Kind::N2kGnss
            | Kind::N2kHeading
            | Kind::N2kLog
            | Kind::N2kPosition
            | Kind::CanImu => return None,
        })
    }

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
            Encoding::CanImu(_) => Kind::CanImu,
            Encoding::N2kGnss => Kind::N2kGnss,
            Encoding::N2kLog => Kind::N2kLog,
            Encoding::N2kHeading => Kind::N2kHeading,
            Encoding::Tracks => Kind::Camera,
        }
    }
}

/// How the device of an encoding sits. Those of Exail and Xsens have their y axis to port and their z
/// axis up; a Doppler log of Teledyne has its third beam forward.
#[must_use]
pub(super) fn mounting(encoding: Encoding) -> Mounting {
    use Direction::{Forward, Port, Starboard, Up};
    let axes = match encoding {
        Encoding::Stdbin
        | Encoding::Xbus(_)
        | Encoding::CanImu(Some(Shipped::Xsens | Shipped::XsensIncrements)) => [Forward, Port, Up],
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

/// The table of a plain CAN IMU.
pub(super) fn layout(encoding: Encoding) -> Option<LayoutChoice> {
    match encoding {
        Encoding::CanImu(Some(shipped)) => Some(LayoutChoice::Shipped(shipped)),
        Encoding::CanImu(None) => Some(LayoutChoice::Own(fine())),
        _ => None,
    }
}

/// A table whose steps are far below any noise: three frames of two numbers, and one of time and number.
fn fine() -> CanLayout {
    let field = |what, start, scale| Field {
        signed: true,
        order: ByteOrder::Big,
        scale,
        ..Field::new(what, start, 32)
    };
    let frame = |id, fields| FrameLayout { id, extended: true, optional: false, fields };
    let pair = |id, first, second| frame(id, vec![field(first, 0, 1e-9), field(second, 32, 1e-9)]);
    let time = Field { scale: 1e-6, ..Field::new(What::Time, 0, 32) };
    CanLayout {
        frames: vec![
            frame(0x1CFF_0040, vec![time, Field::new(What::Counter, 32, 16)]),
            pair(0x1CFF_0140, What::AngleX, What::VelocityX),
            pair(0x1CFF_0240, What::AngleY, What::VelocityY),
            pair(0x1CFF_0340, What::AngleZ, What::VelocityZ),
        ],
    }
}

impl SensorFeed {
    /// A sensor that is right, on a line of 921600 baud for an IMU and 115200 for the others, but for a camera.
    #[must_use]
    pub fn new(encoding: Encoding, calendar: &Calendar) -> Self {
        let role = encoding.kind().role();
        let (baud, latency) = match role {
            Role::Imu => (921_600.0, if encoding == Encoding::Stim { 0.0 } else { 0.002 }),
            Role::Gnss => (115_200.0, 0.06),
            // no serial line carries hundreds of points ten times a second
            Role::Camera => (10e6, 0.03),
            _ => (115_200.0, 0.02),
        };
        let (clock, calendar) = (DeviceClock::default(), calendar.clone());
        let byte_time = match encoding {
            Encoding::CanImu(_) => FRAME_BITS / 1e6,
            own if own.is_n2k() => FRAME_BITS / 250e3,
            _ => BITS / baud,
        };
        SensorFeed { encoding, clock, calendar, latency, byte_time }
    }

    /// The sensor as an installer would describe it.
    #[must_use]
    pub fn config(&self, name: &str, voyage: &Voyage) -> SensorConfig {
        let heading = heading::headings(voyage).first().map(|told| told.std);
        // this log tells itself how old its message is
        let told = self.encoding == Encoding::Nortek;
        SensorConfig {
            latency_s: if told { 0.0 } else { self.latency },
            rate_hz: voyage.header.imu.rate,
            mounting: mounting(self.encoding),
            heading_std_deg: heading.unwrap_or(DEG) / DEG,
            velocity_std_mps: voyage.log.iter().find_map(|log| log.message.std).unwrap_or(0.1),
            dialect: (self.encoding == Encoding::Pashr).then_some(Dialect::Sbg),
            layout: layout(self.encoding),
            kvh: kvh(),
            stim: stim(),
            ..SensorConfig::new(name, name, self.encoding.kind())
        }
    }
}

impl FeedConfig {
    /// Sensors of these encodings that are right, for a voyage that starts when its header says: in 1970
    /// if it says nothing that is an instant.
    #[must_use]
    pub fn new(voyage: &Voyage, encodings: &[Encoding]) -> Self {
        let calendar = Calendar::new(&voyage.header.start_utc);
        let unknown = || Calendar::from(UtcTime::from_nanos(0));
        Self::starting(&calendar.unwrap_or_else(unknown), encodings)
    }

    /// Sensors of these encodings that are right, for a voyage that starts when this calendar says.
    #[must_use]
    pub fn starting(calendar: &Calendar, encodings: &[Encoding]) -> Self {
        let sensors = encodings.iter().map(|encoding| SensorFeed::new(*encoding, calendar));
        FeedConfig { sensors: sensors.collect() }
    }

    /// Index of the port of a sensor.
    #[must_use]
    pub fn port_of(&self, sensor: usize) -> usize {
        let n2k = |own: &SensorFeed| own.encoding.is_n2k();
        let shared = self.sensors.get(sensor).filter(|own| n2k(own));
        shared.and_then(|_| self.sensors.iter().position(n2k)).unwrap_or(sensor)
    }

    /// The intake's configuration: sensor and port have the same name and index, but for devices on a
    /// bus that they share.
    #[must_use]
    pub fn intake(&self, voyage: &Voyage) -> IntakeConfig {
        let name = |index: usize| format!("sensor {index}");
        let sensors = self.sensors.iter().enumerate();
        let link = |sensor: &SensorFeed| {
            if sensor.encoding.is_can() {
                Link::Can { bit_time: sensor.byte_time / FRAME_BITS }
            } else {
                Link::Serial { byte_time: sensor.byte_time }
            }
        };
        let config = |(index, sensor): (usize, &SensorFeed)| SensorConfig {
            port: name(self.port_of(index)),
            device: sensor.encoding.is_n2k().then(|| n2k::filter(index)),
            ..sensor.config(&name(index), voyage)
        };
        IntakeConfig {
            ports: sensors
                .clone()
                .map(|(index, sensor)| PortSpec { name: name(index), link: link(sensor) })
                .collect(),
            sensors: sensors.map(config).collect(),
            ..IntakeConfig::default()
        }
    }
}
