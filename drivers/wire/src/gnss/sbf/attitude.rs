//! AttEuler and AttCovEuler: attitude from several antennas.
//!
//! Layout: Septentrio's reference guides (mosaic-X5 4.14.10 as in pysbf2; 4.10.1).

use insd_base::units::{DEG, wrap_two_pi};

use super::field::{self, put_f32};
use super::frame::{SbfStamp, begun, body, framed};
use crate::binary::BinaryFault;
use crate::gnss::GnssPart;

/// Number of AttEuler.
pub(super) const ANGLES: u16 = 5938;

/// Number of AttCovEuler.
pub(super) const COVARIANCE: u16 = 5939;

/// Error bits of attitude blocks that say something: two for each baseline, and bit 7, set when
/// nobody asked for attitude.
const ERRORS: u8 = 0b1000_1111;

/// AttEuler. Heading is from true north, pitch positive with the bow up, roll with starboard down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AttEuler {
    /// When, by the receiver's clock.
    pub stamp: SbfStamp,
    /// `NrSV`: satellites used, the mean over the antennas.
    pub satellites: Option<u8>,
    /// `Error`: bits 0-1 for the first baseline, 2-3 for the second, 7 if attitude is not requested.
    pub error: u8,
    /// `Mode`: 0 none, 1 heading and pitch with float ambiguities, 2 with fixed ones, 3 and 4 the same
    /// with roll.
    pub mode: u16,
    /// `Heading`, rad.
    pub heading: Option<f64>,
    /// `Pitch`, rad.
    pub pitch: Option<f64>,
    /// `Roll`, rad; not measured with two antennas.
    pub roll: Option<f64>,
    /// `PitchDot`, `RollDot`, `HeadingDot`, in the order of the wire, rad/s.
    pub rates: [Option<f64>; 3],
}

impl AttEuler {
    /// Reads a block.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(block: &[u8]) -> Result<Self, BinaryFault> {
        let (stamp, mut reader, _) = body(block, ANGLES)?;
        let [satellites, error] = reader.array()?;
        let mode = reader.le_u16()?;
        reader.take(2)?;
        let mut angle = || Ok(field::f32(&mut reader)?.map(|degrees| f64::from(degrees) * DEG));
        Ok(AttEuler {
            stamp,
            satellites: (satellites != u8::MAX).then_some(satellites),
            error,
            mode,
            heading: angle()?,
            pitch: angle()?,
            roll: angle()?,
            rates: [angle()?, angle()?, angle()?],
        })
    }

    /// The block.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let mut writer = begun(self.stamp);
        writer.u8(self.satellites.unwrap_or(u8::MAX)).u8(self.error).le_u16(self.mode).le_u16(0);
        for angle in [self.heading, self.pitch, self.roll].iter().chain(&self.rates) {
            put_f32(&mut writer, angle.map(|angle| (angle / DEG) as f32));
        }
        framed((ANGLES, 0), &writer)
    }

    /// Whether there is an attitude.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        self.error & ERRORS == 0 && (1..=4).contains(&self.mode)
    }

    /// What the message says of its epoch.
    #[must_use]
    pub fn part(&self) -> GnssPart {
        GnssPart {
            kind: "AttEuler",
            epoch: self.stamp.epoch(),
            heading: self.heading.filter(|_| self.is_valid()).map(wrap_two_pi),
            ..GnssPart::default()
        }
    }
}

/// AttCovEuler.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AttCovEuler {
    /// When, by the receiver's clock.
    pub stamp: SbfStamp,
    /// `Error`, as in [`AttEuler`].
    pub error: u8,
    /// Variances of heading, pitch and roll, rad^2.
    pub variances: [Option<f64>; 3],
    /// Covariances of heading with pitch, heading with roll, pitch with roll, rad^2.
    pub covariances: [Option<f64>; 3],
}

impl AttCovEuler {
    /// Reads a block.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(block: &[u8]) -> Result<Self, BinaryFault> {
        let (stamp, mut reader, _) = body(block, COVARIANCE)?;
        let [_, error] = reader.array()?;
        let mut element = || Ok(field::f32(&mut reader)?.map(|raw| f64::from(raw) * DEG * DEG));
        let variances = [element()?, element()?, element()?];
        let covariances = [element()?, element()?, element()?];
        Ok(AttCovEuler { stamp, error, variances, covariances })
    }

    /// The block.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let mut writer = begun(self.stamp);
        writer.u8(0).u8(self.error);
        for element in self.variances.iter().chain(&self.covariances) {
            put_f32(&mut writer, element.map(|element| (element / (DEG * DEG)) as f32));
        }
        framed((COVARIANCE, 0), &writer)
    }

    /// What the message says of its epoch.
    #[must_use]
    pub fn part(&self) -> GnssPart {
        let usable = |variance: &f64| self.error & ERRORS == 0 && *variance >= 0.0;
        GnssPart {
            kind: "AttCovEuler",
            epoch: self.stamp.epoch(),
            heading_std: self.variances[0].filter(usable).map(f64::sqrt),
            ..GnssPart::default()
        }
    }
}
