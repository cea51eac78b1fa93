//! PosCovGeodetic and VelCovGeodetic: how good position and velocity are.
//!
//! Layout: PolaRx5TR Reference Guide 5.5.0, p. 392, and pysbf2.

use super::field::{self, SbfMode, put_f32};
use super::frame::{SbfStamp, begun, body, framed};
use crate::binary::BinaryFault;
use crate::gnss::{GnssEpoch, GnssPart};

/// Number of PosCovGeodetic.
pub(super) const POSITION: u16 = 5906;

/// Number of VelCovGeodetic.
pub(super) const VELOCITY: u16 = 5908;

/// A covariance along north, east, up and the receiver's clock, in the order of the wire.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SbfCovariance {
    /// When, by the receiver's clock.
    pub stamp: SbfStamp,
    /// Type of the solution and error.
    pub mode: SbfMode,
    /// Variances of north, east, up and clock: m^2 or m^2/s^2.
    pub variances: [Option<f32>; 4],
    /// Covariances: north with east, up, clock; east with up, clock; up with clock.
    pub covariances: [Option<f32>; 6],
}

/// PosCovGeodetic, m^2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PosCovGeodetic(pub SbfCovariance);

/// VelCovGeodetic, m^2/s^2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VelCovGeodetic(pub SbfCovariance);

impl SbfCovariance {
    fn read(block: &[u8], id: u16) -> Result<Self, BinaryFault> {
        let (stamp, mut reader, _) = body(block, id)?;
        let mode = SbfMode::read(&mut reader)?;
        let mut next = || field::f32(&mut reader);
        Ok(SbfCovariance {
            stamp,
            mode,
            variances: [next()?, next()?, next()?, next()?],
            covariances: [next()?, next()?, next()?, next()?, next()?, next()?],
        })
    }

    fn write(&self, id: u16) -> Vec<u8> {
        let mut writer = begun(self.stamp);
        self.mode.write(&mut writer);
        for element in self.variances.iter().chain(&self.covariances) {
            put_f32(&mut writer, *element);
        }
        framed((id, 0), &writer)
    }

    /// Independent components, of a state that has a solution.
    fn of(state: &GnssEpoch, std: [f64; 3]) -> Self {
        let mode = SbfMode::of(state.quality);
        let [north, east, up] = std.map(|sigma| (sigma * sigma) as f32);
        let zero = mode.is_valid().then_some(0.0);
        let variances = [north, east, up, 0.0].map(|variance| mode.is_valid().then_some(variance));
        SbfCovariance { stamp: SbfStamp::of(state.time), mode, variances, covariances: [zero; 6] }
    }

    /// 1-sigma of north, east, down, if there is a solution.
    #[must_use]
    pub fn std(&self) -> [Option<f64>; 3] {
        let [north, east, up, _] = self.variances;
        [north, east, up].map(|variance| {
            let variance = f64::from(variance.filter(|_| self.mode.is_valid())?);
            (variance >= 0.0).then(|| variance.sqrt())
        })
    }
}

impl PosCovGeodetic {
    /// Reads a block.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(block: &[u8]) -> Result<Self, BinaryFault> {
        SbfCovariance::read(block, POSITION).map(PosCovGeodetic)
    }

    /// The block.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        self.0.write(POSITION)
    }

    /// What a receiver in this state would send.
    #[must_use]
    pub fn of(state: &GnssEpoch) -> Self {
        PosCovGeodetic(SbfCovariance::of(state, state.position_std))
    }

    /// What the message says of its epoch.
    #[must_use]
    pub fn part(&self) -> GnssPart {
        GnssPart {
            kind: "PosCovGeodetic",
            epoch: self.0.stamp.epoch(),
            position_std: self.0.std(),
            ..GnssPart::default()
        }
    }
}

impl VelCovGeodetic {
    /// Reads a block.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(block: &[u8]) -> Result<Self, BinaryFault> {
        SbfCovariance::read(block, VELOCITY).map(VelCovGeodetic)
    }

    /// The block.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        self.0.write(VELOCITY)
    }

    /// What a receiver in this state would send.
    #[must_use]
    pub fn of(state: &GnssEpoch) -> Self {
        VelCovGeodetic(SbfCovariance::of(state, state.velocity_std))
    }

    /// What the message says of its epoch.
    #[must_use]
    pub fn part(&self) -> GnssPart {
        GnssPart {
            kind: "VelCovGeodetic",
            epoch: self.0.stamp.epoch(),
            velocity_std: self.0.std(),
            ..GnssPart::default()
        }
    }
}
