//! PVTCartesian: position, velocity and time of an epoch along the axes of the Earth.
//!
//! Layout: that of PVTGeodetic with other components, by the same guides. Of its end nothing is kept but satellites and accuracies.

use insd_base::FixQuality;

use super::field::{self, SbfMode, put_f32, put_f64};
use super::frame::{SbfStamp, begun, body};
use super::pvt::PvtAccuracy;
use crate::binary::BinaryFault;
use crate::gnss::{GnssPart, cartesian};

/// Number of the block.
pub(super) const ID: u16 = 4006;

/// PVTCartesian.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PvtCartesian {
    /// When, by the receiver's clock.
    pub stamp: SbfStamp,
    /// Type of the solution and error.
    pub mode: SbfMode,
    /// `X`, `Y`, `Z`, m.
    pub position: Option<[f64; 3]>,
    /// `Undulation`: height of the geoid above the ellipsoid, m.
    pub undulation: Option<f32>,
    /// `Vx`, `Vy`, `Vz`, m/s.
    pub velocity: Option<[f32; 3]>,
    /// `NrSV`: satellites used.
    pub satellites: Option<u8>,
    /// What revision 2 added.
    pub extra: Option<PvtAccuracy>,
}

impl PvtCartesian {
    /// Reads a block of any revision.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(block: &[u8]) -> Result<Self, BinaryFault> {
        let (stamp, mut reader, revision) = body(block, ID)?;
        let reader = &mut reader;
        let mode = SbfMode::read(reader)?;
        let place = [field::f64(reader)?, field::f64(reader)?, field::f64(reader)?];
        let undulation = field::f32(reader)?;
        let velocity = [field::f32(reader)?, field::f32(reader)?, field::f32(reader)?];
        // course, clock bias and drift, time system, datum
        reader.take(4 + 8 + 4 + 2)?;
        let satellites = Some(reader.u8()?).filter(|count| *count != u8::MAX);
        // corrections, reference, age, signals, alert
        reader.take(1 + 2 + 2 + 4 + 1)?;
        Ok(PvtCartesian {
            stamp,
            mode,
            position: all(place),
            undulation,
            velocity: all(velocity),
            satellites,
            extra: PvtAccuracy::read(reader, revision)?,
        })
    }

    /// The block, of revision 2, or of revision 0 if the accuracies are not known. What is not kept is written as not available.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let mut writer = begun(self.stamp);
        self.mode.write(&mut writer);
        for at in 0..3 {
            put_f64(&mut writer, self.position.map(|position| position[at]));
        }
        put_f32(&mut writer, self.undulation);
        for at in 0..3 {
            put_f32(&mut writer, self.velocity.map(|velocity| velocity[at]));
        }
        put_f32(&mut writer, None);
        put_f64(&mut writer, None);
        put_f32(&mut writer, None);
        writer.put(&[u8::MAX, u8::MAX, self.satellites.unwrap_or(u8::MAX), 0]);
        writer.le_u16(0).le_u16(u16::MAX).le_u32(0).u8(0);
        PvtAccuracy::framed(self.extra.as_ref(), ID, writer)
    }

    /// What the message says of its epoch, as that of PVTGeodetic.
    #[must_use]
    pub fn part(&self) -> GnssPart {
        let valid = self.mode.is_valid();
        let place = self.position.filter(|_| valid).and_then(cartesian::place);
        let velocity = place.as_ref().zip(self.velocity);
        let velocity = velocity.map(|(place, own)| cartesian::velocity(place, own.map(f64::from)));
        let [north, east, down] = velocity.map_or([None; 3], |own| own.map(Some));
        let std = self.extra.filter(|_| place.is_some()).map_or([None; 3], |extra| extra.std());
        GnssPart {
            kind: "PVTCartesian",
            epoch: self.stamp.epoch(),
            position: place,
            position_std: std,
            velocity: [north, east, down.filter(|_| !self.mode.two_dimensional)],
            satellites: self.satellites.map(u16::from),
            quality: self.mode.quality(),
            invalid: self.mode.quality() == Some(FixQuality::Invalid),
            ..GnssPart::default()
        }
    }
}

/// All three, if none is missing.
fn all<T: Copy>(of: [Option<T>; 3]) -> Option<[T; 3]> {
    let [Some(x), Some(y), Some(z)] = of else { return None };
    Some([x, y, z])
}
