//! A ship's sensors as they are put on a line.

use insd_base::Time;
use insd_wire::imu::can::Shipped;
use insd_wire::imu::xbus::Precision;
use insd_wire::log::LogFrame;

use super::calendar::Calendar;

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
    /// PINSD,TRK.
    Tracks,
}

impl Encoding {
    /// Whether it is a device of NMEA 2000; all of them share the port of the first.
    #[must_use]
    pub fn is_n2k(self) -> bool {
        matches!(self, Encoding::N2kGnss | Encoding::N2kLog | Encoding::N2kHeading)
    }

    pub(super) fn is_can(self) -> bool {
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

impl DeviceClock {
    /// What the clock reads at an instant of the voyage, ns.
    #[must_use]
    pub fn nanos(&self, time: Time) -> u64 {
        let since = time.as_nanos() as f64 * self.drift_ppm * 1e-6;
        let nanos = time.as_nanos() as f64 + since + self.offset * 1e9;
        nanos.round() as u64
    }
}
