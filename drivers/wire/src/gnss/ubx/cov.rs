//! NAV-COV and NAV-DOP: how good an epoch is.
//!
//! Layout: u-blox ZED-F9P Interface Description; NAV-COV as in `ublox_ubx_msgs` (UBXNavCov) and pyubx2.

use super::field::{dilution, dilution_raw, epoch, milliseconds, time_of_week};
use super::frame::{Frame, framed};
use crate::binary::{BinaryFault, Reader, Writer};
use crate::gnss::{GnssEpoch, GnssPart};

/// Class and id of NAV-COV.
pub(super) const COV: (u8, u8) = (0x01, 0x36);

/// Class and id of NAV-DOP.
pub(super) const DOP: (u8, u8) = (0x01, 0x04);

/// The upper triangle of a covariance along north, east, down.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct UbxCovariance {
    /// North with north, north with east, north with down.
    pub north: [f32; 3],
    /// East with east, east with down.
    pub east: [f32; 2],
    /// Down with down.
    pub down: f32,
}

/// NAV-COV.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NavCov {
    /// `iTOW`: time of the GPS week, whole milliseconds, in ns.
    pub time_of_week: i64,
    /// Covariance of the position, m^2; `None` unless `posCovValid`.
    pub position: Option<UbxCovariance>,
    /// Covariance of the velocity, m^2/s^2; `None` unless `velCovValid`.
    pub velocity: Option<UbxCovariance>,
}

impl UbxCovariance {
    /// 1-sigma of north, east, down; a component that is no variance is unknown.
    #[must_use]
    pub fn std(&self) -> [Option<f64>; 3] {
        let sigma = |variance: f32| {
            let variance = f64::from(variance);
            (variance.is_finite() && variance >= 0.0).then(|| variance.sqrt())
        };
        [self.north[0], self.east[0], self.down].map(sigma)
    }

    /// Independent components.
    fn diagonal(std: [f64; 3]) -> Self {
        let [north, east, down] = std.map(|sigma| (sigma * sigma) as f32);
        UbxCovariance { north: [north, 0.0, 0.0], east: [east, 0.0], down }
    }

    fn read(reader: &mut Reader<'_>) -> Result<Self, BinaryFault> {
        let mut next = || reader.le_f32();
        Ok(UbxCovariance {
            north: [next()?, next()?, next()?],
            east: [next()?, next()?],
            down: next()?,
        })
    }

    fn write(&self, writer: &mut Writer) {
        for element in self.north.iter().chain(&self.east).chain([&self.down]) {
            writer.le_f32(*element);
        }
    }
}

impl NavCov {
    /// Reads a frame of version 0.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        let mut reader = Reader::new(Frame::payload_of(frame, COV)?);
        let time_of_week = time_of_week(&mut reader)?;
        let [version, position_valid, velocity_valid] = reader.array()?;
        if version != 0 {
            return Err(BinaryFault::Range { field: "version" });
        }
        reader.take(9)?;
        let position = UbxCovariance::read(&mut reader)?;
        let velocity = UbxCovariance::read(&mut reader)?;
        Ok(NavCov {
            time_of_week,
            position: (position_valid == 1).then_some(position),
            velocity: (velocity_valid == 1).then_some(velocity),
        })
    }

    /// The frame.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let mut writer = Writer::new();
        let valid = [0, self.position.is_some().into(), self.velocity.is_some().into()];
        writer.le_u32(milliseconds(self.time_of_week)).put(&valid).put(&[0; 9]);
        self.position.unwrap_or_default().write(&mut writer);
        self.velocity.unwrap_or_default().write(&mut writer);
        framed(COV, &writer)
    }

    /// What a receiver in this state would send.
    #[must_use]
    pub fn of(state: &GnssEpoch) -> Self {
        NavCov {
            time_of_week: state.time.to_week().1,
            position: Some(UbxCovariance::diagonal(state.position_std)),
            velocity: Some(UbxCovariance::diagonal(state.velocity_std)),
        }
    }

    /// What the message says of its epoch.
    #[must_use]
    pub fn part(&self) -> GnssPart {
        let std = |covariance: Option<UbxCovariance>| covariance.map_or([None; 3], |of| of.std());
        GnssPart {
            kind: "NAV-COV",
            epoch: epoch(self.time_of_week),
            position_std: std(self.position),
            velocity_std: std(self.velocity),
            ..GnssPart::default()
        }
    }
}

/// NAV-DOP: dilutions of precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NavDop {
    /// `iTOW`: time of the GPS week, whole milliseconds, in ns.
    pub time_of_week: i64,
    /// `gDOP`: position and time.
    pub geometric: Option<f64>,
    /// `pDOP`.
    pub position: Option<f64>,
    /// `tDOP`.
    pub time: Option<f64>,
    /// `vDOP`.
    pub vertical: Option<f64>,
    /// `hDOP`.
    pub horizontal: Option<f64>,
    /// `nDOP`: northing.
    pub north: Option<f64>,
    /// `eDOP`: easting.
    pub east: Option<f64>,
}

impl NavDop {
    /// Reads a frame.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        let mut reader = Reader::new(Frame::payload_of(frame, DOP)?);
        let time_of_week = time_of_week(&mut reader)?;
        let mut next = || reader.le_u16().map(dilution);
        Ok(NavDop {
            time_of_week,
            geometric: next()?,
            position: next()?,
            time: next()?,
            vertical: next()?,
            horizontal: next()?,
            north: next()?,
            east: next()?,
        })
    }

    /// The frame.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let mut writer = Writer::new();
        writer.le_u32(milliseconds(self.time_of_week));
        let dilutions = [
            self.geometric,
            self.position,
            self.time,
            self.vertical,
            self.horizontal,
            self.north,
            self.east,
        ];
        for dilution in dilutions {
            writer.le_u16(dilution_raw(dilution));
        }
        framed(DOP, &writer)
    }

    /// What the message says of its epoch.
    #[must_use]
    pub fn part(&self) -> GnssPart {
        GnssPart {
            kind: "NAV-DOP",
            epoch: epoch(self.time_of_week),
            hdop: self.horizontal,
            ..GnssPart::default()
        }
    }
}
