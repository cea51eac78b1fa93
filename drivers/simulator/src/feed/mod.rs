//! A voyage as the byte streams of a ship's sensors.
//!
//! [`feed`] is the other end of `insd-intake`: it encodes what a simulated voyage measured in the
//! format of each sensor and says when the last byte of each message is on the wire. What the computer
//! sees of it and when is up to [`arrivals`]. Pure and without randomness of its own.

pub mod arrivals;
mod calendar;
mod config;
mod damage;
mod gnss;
mod heading;
mod imu;
mod log;
pub mod n2k;

use insd_base::can::CanFrame;
use insd_base::{Input, Span, Time, Voyage};
use insd_wire::imu::can::Shipped;
use insd_wire::imu::xbus::Precision;
use insd_wire::log::LogFrame;

pub use arrivals::{Reception, arrivals};
pub use calendar::Calendar;
pub use damage::{at_wrong_baud, noise};

/// A message on the wire.
#[derive(Clone, Debug, PartialEq)]
pub struct Sending {
    /// Time of the voyage at which its last byte is on the wire.
    pub at: Time,
    /// Index of the port, which is that of the sensor, or of the first of NMEA 2000.
    pub port: usize,
    /// All its bytes, or a frame.
    pub input: Input,
}

impl Sending {
    /// Its bytes; none of a frame.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        if let Input::Bytes(bytes) = &self.input { bytes } else { &[] }
    }
}

/// How a sensor's measurements are put into bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Encoding {
    /// sbgECom: IMU_SHORT, and UTC_TIME each second.
    Sbg,
    /// StdBin: raw rotation and raw acceleration, synchronised to UTC.
    Stdbin,
    /// MIP: delta theta and delta velocity with the reference time.
    Mip,
    /// MTData2: delta quaternion and delta velocity in a format of real numbers.
    Xbus(Precision),
    /// KVH format A, or B with its time stamp: angles and accelerations.
    Kvh {
        /// Format B.
        stamped: bool,
    },
    /// STIM300: increments.
    Stim,
    /// NAV-PVT and NAV-COV.
    Ubx,
    /// PVTGeodetic, PosCovGeodetic, VelCovGeodetic.
    Sbf,
    /// GGA, GST, VTG, ZDA, RMC.
    NmeaGnss,
    /// VBW.
    Vbw,
    /// PD0 in one of its frames.
    Pd0(LogFrame),
    /// PD6 in the instrument's or the ship's frame.
    Pd6(LogFrame),
    /// PNORBT7.
    Nortek,
    /// HDT.
    Hdt,
    /// THS.
    Ths,
    /// PSXN,23 and then PSXN,20.
    Psxn,
    /// PASHR as SBG Systems sends it.
    Pashr,
    /// Plain CAN frames by a maker's table, or by one whose steps are fine.
    CanImu(Option<Shipped>),
    /// 129029, 129026 and 129542, of a device that claims an address.
    N2kGnss,
    /// 130578.
    N2kLog,
    /// 127250.
    N2kHeading,
}

impl Encoding {
    /// Whether it is a device of NMEA 2000; all of them share the port of the first.
    #[must_use]
    pub fn is_n2k(self) -> bool {
        matches!(self, Encoding::N2kGnss | Encoding::N2kLog | Encoding::N2kHeading)
    }

    fn is_can(self) -> bool {
        self.is_n2k() || matches!(self, Encoding::CanImu(_))
    }
}

/// A device's own clock and its number of the first sample.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct DeviceClock {
    /// What it reads at the start of the voyage, s.
    pub offset: f64,
    /// How much faster it runs than true time, ppm.
    pub drift_ppm: f64,
    /// Number of the first sample.
    pub count: u64,
}

/// One sensor on a port of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorFeed {
    /// Its format.
    pub encoding: Encoding,
    /// Its clock.
    pub clock: DeviceClock,
    /// UTC by its account.
    pub calendar: Calendar,
    /// Time from a measurement to the first byte of its message, s.
    pub latency: f64,
    /// Time for a byte on the wire, s; on a CAN bus for eight bits.
    pub byte_time: f64,
}

/// All sensors of a ship, in the order of their ports.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct FeedConfig {
    /// Sensor and port have the same index.
    pub sensors: Vec<SensorFeed>,
}

/// Everything that the sensors of a ship send on a voyage, in order of time.
#[must_use]
pub fn feed(voyage: &Voyage, config: &FeedConfig) -> Vec<Sending> {
    let mut all = Vec::new();
    for (port, sensor) in config.sensors.iter().enumerate() {
        let mut line = Line::new(config.port_of(port), sensor);
        match sensor.encoding {
            Encoding::Sbg
            | Encoding::Stdbin
            | Encoding::Mip
            | Encoding::Xbus(_)
            | Encoding::Kvh { .. }
            | Encoding::Stim
            | Encoding::CanImu(_) => imu::encode(voyage, sensor, &mut line),
            Encoding::Ubx | Encoding::Sbf | Encoding::NmeaGnss => {
                gnss::encode(voyage, sensor, &mut line);
            }
            Encoding::Vbw | Encoding::Pd0(_) | Encoding::Pd6(_) | Encoding::Nortek => {
                log::encode(voyage, sensor, &mut line);
            }
            Encoding::Hdt | Encoding::Ths | Encoding::Psxn | Encoding::Pashr => {
                heading::encode(voyage, sensor, &mut line);
            }
            Encoding::N2kGnss | Encoding::N2kLog | Encoding::N2kHeading => {
                n2k::encode(voyage, sensor, port, &mut line);
            }
        }
        all.append(&mut line.sent);
    }
    all.sort_by_key(|sending| sending.at);
    all
}

impl DeviceClock {
    /// What the clock reads at an instant of the voyage, ns.
    #[must_use]
    pub fn nanos(&self, time: Time) -> u64 {
        let since = time.as_nanos() as f64 * self.drift_ppm * 1e-6;
        let nanos = time.as_nanos() as f64 + since + self.offset * 1e9;
        nanos.round() as u64
    }
}

/// A serial line: one byte after the other.
#[derive(Debug)]
struct Line {
    port: usize,
    latency: Span,
    byte_time: f64,
    free: Time,
    sent: Vec<Sending>,
}

impl Line {
    fn new(port: usize, sensor: &SensorFeed) -> Self {
        let (latency, byte_time) = (Span::from_seconds(sensor.latency), sensor.byte_time);
        Line { port, latency, byte_time, free: Time::START, sent: Vec::new() }
    }

    /// Sends a message of a measurement as soon as the device has it and the line is free.
    fn send(&mut self, measured: Time, bytes: &[u8]) {
        self.put(measured, bytes.len() as f64, Input::Bytes(bytes.to_vec()));
    }

    /// Sends a frame of a measurement as soon as the device has it and the bus is free.
    fn send_frame(&mut self, measured: Time, frame: &CanFrame) {
        self.put(measured, f64::from(frame.wire_bits()) / 8.0, Input::Can(*frame));
    }

    fn put(&mut self, measured: Time, bytes: f64, input: Input) {
        let begun = (measured + self.latency).max(self.free);
        let at = begun + Span::from_seconds(bytes * self.byte_time);
        self.free = at;
        self.sent.push(Sending { at, port: self.port, input });
    }
}
