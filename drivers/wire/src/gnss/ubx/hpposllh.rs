//! NAV-HPPOSLLH: the position of an epoch to a tenth of a millimetre.
//!
//! Layout: pyubx2 and u-blox ZED-F9P Interface Description; no log of a device was at hand.

use insd_base::Geodetic;

use super::field::{accuracy, accuracy_raw, bit, epoch, milliseconds, position, time_of_week};
use super::frame::{Frame, framed};
use crate::binary::{BinaryFault, Reader, Writer, scaled};
use crate::gnss::GnssPart;

/// Class and id.
pub(super) const NAME: (u8, u8) = (0x01, 0x14);

/// NAV-HPPOSLLH.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NavHpPosLlh {
    /// `iTOW`: time of the GPS week, whole milliseconds, in ns.
    pub time_of_week: i64,
    /// Position, height above the ellipsoid; `None` if `invalidLlh` is set.
    pub position: Option<Geodetic>,
    /// `hMSL` and `hMSLHp`: height above mean sea level, m.
    pub height_msl: f64,
    /// `hAcc`, m, as in NAV-PVT.
    pub horizontal_accuracy: Option<f64>,
    /// `vAcc`, m.
    pub vertical_accuracy: Option<f64>,
}

impl NavHpPosLlh {
    /// Reads a frame of version 0.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        let mut reader = Reader::new(Frame::payload_of(frame, NAME)?);
        let [version, _, _, flags] = reader.array()?;
        if version != 0 {
            return Err(BinaryFault::Range { field: "version" });
        }
        let time_of_week = time_of_week(&mut reader)?;
        let place = [reader.le_i32()?, reader.le_i32()?, reader.le_i32()?];
        let msl = reader.le_i32()?;
        let finer = [reader.i8()?, reader.i8()?, reader.i8()?];
        let finer_msl = reader.i8()?;
        let located = !bit(flags, 0);
        Ok(NavHpPosLlh {
            time_of_week,
            position: located.then(|| position(place, finer)).transpose()?,
            height_msl: f64::from(msl) * 1e-3 + f64::from(finer_msl) * 1e-4,
            horizontal_accuracy: accuracy(reader.le_u32()?, 1e-4),
            vertical_accuracy: accuracy(reader.le_u32()?, 1e-4),
        })
    }

    /// The frame.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let place = self.position.unwrap_or_default();
        let longitude = insd_base::units::wrap_pi(place.longitude).to_degrees();
        let split = [
            split(longitude, 1e-9, 100),
            split(place.latitude.to_degrees(), 1e-9, 100),
            split(place.height, 1e-4, 10),
            split(self.height_msl, 1e-4, 10),
        ];
        let mut writer = Writer::new();
        writer.put(&[0, 0, 0, self.position.is_none().into()]);
        writer.le_u32(milliseconds(self.time_of_week));
        for (coarse, _) in split {
            writer.le_i32(coarse);
        }
        for (_, fine) in split {
            writer.put(&fine.to_le_bytes());
        }
        writer.le_u32(accuracy_raw(self.horizontal_accuracy, 1e-4));
        writer.le_u32(accuracy_raw(self.vertical_accuracy, 1e-4));
        framed(NAME, &writer)
    }

    /// What the message says of its epoch; the accuracies are shared out as in NAV-PVT.
    #[must_use]
    pub fn part(&self) -> GnssPart {
        let component = self.horizontal_accuracy.map(|both| both / std::f64::consts::SQRT_2);
        let std = [component, component, self.vertical_accuracy];
        GnssPart {
            kind: "NAV-HPPOSLLH",
            epoch: epoch(self.time_of_week),
            position: self.position,
            position_std: if self.position.is_some() { std } else { [None; 3] },
            ..GnssPart::default()
        }
    }
}

/// A value as whole steps of the coarse field and the rest in steps of the fine one, both saturated.
fn split(value: f64, fine: f64, ratio: i64) -> (i32, i8) {
    let steps = scaled(value, fine);
    let limits = i64::from(i32::MIN)..=i64::from(i32::MAX);
    let coarse = (steps / ratio).clamp(*limits.start(), *limits.end());
    let fine = steps.saturating_sub(coarse * ratio).clamp(i8::MIN.into(), i8::MAX.into());
    (coarse as i32, fine as i8)
}
