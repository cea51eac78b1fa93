//! Inertial measurement units: what every one of them says, whatever its format.
//!
//! Each format is a file or folder of its own with its messages, reader and writer, and turns into an
//! [`ImuReading`]. Axes are the device's own; the mounting is dealt with where the ship is known.

pub mod can;
pub mod kvh;
pub mod mip;
pub mod rotation;
pub mod sbg;
pub mod stdbin;
pub mod stim;
pub mod vectornav;
pub mod xbus;

use insd_base::UtcTime;

/// What an IMU measured, in its own axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ImuMotion {
    /// Means over the sampling interval, or instantaneous values.
    Rates {
        /// Angular rate with respect to inertial space, rad/s.
        gyro: [f64; 3],
        /// Specific force, m/s^2.
        accel: [f64; 3],
    },
    /// Integrals over the sampling interval.
    Increments {
        /// Integral of the angular rate, rad.
        delta_theta: [f64; 3],
        /// Integral of specific force, m/s.
        delta_velocity: [f64; 3],
    },
}

impl ImuMotion {
    /// Whether every component is a number: formats with floats carry NaN and infinities too.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        let (ImuMotion::Rates { gyro: turn, accel: push }
        | ImuMotion::Increments { delta_theta: turn, delta_velocity: push }) = self;
        turn.iter().chain(push).all(|component| component.is_finite())
    }
}

/// A count that starts again after its last value: a device's clock or sample number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wrapping {
    /// The count.
    pub value: u64,
    /// Values before it starts again (2^32 for a 32-bit count).
    pub modulus: u64,
}

/// A device's clock as it stands in a message.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeviceTime {
    /// Count of the clock at the end of the sampling interval.
    pub ticks: Wrapping,
    /// Length of a tick, s.
    pub tick: f64,
}

/// One sample of an IMU.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImuReading {
    /// What was measured.
    pub motion: ImuMotion,
    /// The device's clock at the end of the interval, if the format has one.
    pub device_time: Option<DeviceTime>,
    /// The sample's number, if the format has one.
    pub counter: Option<Wrapping>,
    /// UTC of the end of the interval, if the device knows it.
    pub utc: Option<UtcTime>,
    /// Time from the end of the interval to the first byte on the wire as the device states it, s.
    pub latency: Option<f64>,
    /// Temperature of the sensors, deg C.
    pub temperature: Option<f64>,
    /// Whether the device's own status says that the sample may be used.
    pub valid: bool,
    /// The device's status word as it stands on the wire, for the operator.
    pub status: u32,
}

impl ImuReading {
    /// A valid sample of which nothing but the motion is known.
    #[must_use]
    pub fn bare(motion: ImuMotion) -> Self {
        ImuReading {
            motion,
            device_time: None,
            counter: None,
            utc: None,
            latency: None,
            temperature: None,
            valid: true,
            status: 0,
        }
    }
}
