//! BaseVectorGeod: from the antennas of bases to that of the receiver; of a base that moves with the ship, a heading.
//!
//! Layout: Septentrio's reference guides (mosaic-X5 4.14.10 as in pysbf2).

use insd_base::units::wrap_two_pi;

use super::field::{self, SbfMode, SbfSolution, put_f32, put_f64, put_u16};
use super::frame::{SbfStamp, begun, body, framed};
use crate::binary::{BinaryFault, Reader, Writer};
use crate::gnss::GnssPart;

/// Number of the block.
pub(super) const ID: u16 = 4028;

/// Bytes of a vector that are read; later revisions may append to it.
const VECTOR: usize = 52;

/// A line that is shorter than this has no direction, m.
const SHORTEST: f64 = 0.05;

/// BaseVectorGeod.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseVectorGeod {
    /// When, by the receiver's clock.
    pub stamp: SbfStamp,
    /// The lines from the bases that are in use.
    pub vectors: Vec<BaseVector>,
}

/// A line from a base to the receiver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BaseVector {
    /// `NrSV`: satellites used.
    pub satellites: u8,
    /// Type of the solution and error.
    pub mode: SbfMode,
    /// `Misc`: bit 0, the line ends at the reference points of the antennas.
    pub misc: u8,
    /// `DeltaNorth`, `DeltaEast` and the reverse of `DeltaUp`: north, east, down, m.
    pub relative: [Option<f64>; 3],
    /// `DeltaVn`, `DeltaVe` and the reverse of `DeltaVu`: how it changes, m/s.
    pub velocity: [Option<f32>; 3],
    /// `Azimuth` and `Elevation`, hundredths of a degree, as they stand.
    pub direction: (u16, i16),
    /// `ReferenceID`: number of the base.
    pub reference: u16,
    /// `CorrAge`: age of its corrections, s.
    pub correction_age: Option<f64>,
    /// `SignalInfo`: a bit for each type of signal used.
    pub signals: u32,
}

impl BaseVector {
    fn read(reader: &mut Reader<'_>) -> Result<Self, BinaryFault> {
        let [satellites, error, mode, misc] = reader.array()?;
        let mode = SbfMode::of_bytes([mode, error]);
        let [east, north, up] = [field::f64(reader)?, field::f64(reader)?, field::f64(reader)?];
        let [ve, vn, vu] = [field::f32(reader)?, field::f32(reader)?, field::f32(reader)?];
        Ok(BaseVector {
            satellites,
            mode,
            misc,
            relative: [north, east, up.map(|up| 0.0 - up)],
            velocity: [vn, ve, vu.map(|up| 0.0 - up)],
            direction: (reader.le_u16()?, reader.le_i16()?),
            reference: reader.le_u16()?,
            correction_age: field::u16(reader, 0.01)?,
            signals: reader.le_u32()?,
        })
    }

    fn write(&self, writer: &mut Writer) {
        let [mode, error] = self.mode.bytes();
        writer.put(&[self.satellites, error, mode, self.misc]);
        let [north, east, down] = self.relative;
        for component in [east, north, down.map(|down| 0.0 - down)] {
            put_f64(writer, component);
        }
        let [north, east, down] = self.velocity;
        for component in [east, north, down.map(|down| 0.0 - down)] {
            put_f32(writer, component);
        }
        let (azimuth, elevation) = self.direction;
        writer.le_u16(azimuth).le_i16(elevation).le_u16(self.reference);
        put_u16(writer, self.correction_age, 0.01);
        writer.le_u32(self.signals);
    }

    /// Direction from the base to the receiver, rad, of a base that moves with the ship and of ambiguities that are fixed.
    #[must_use]
    pub fn heading(&self) -> Option<f64> {
        let fixed = self.mode.is_valid() && self.mode.solution == SbfSolution::MovingBaseFixed;
        let [north, east, _] = self.relative;
        let (north, east) = north.zip(east).filter(|_| fixed)?;
        (north.hypot(east) > SHORTEST).then(|| wrap_two_pi(east.atan2(north)))
    }
}

impl BaseVectorGeod {
    /// Reads a block.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(block: &[u8]) -> Result<Self, BinaryFault> {
        let (stamp, mut reader, _) = body(block, ID)?;
        let [count, length] = reader.array()?;
        let length = usize::from(length);
        if count > 0 && length < VECTOR {
            return Err(BinaryFault::Range { field: "SBLength" });
        }
        let vector = |_| BaseVector::read(&mut Reader::new(reader.take(length)?));
        let vectors = (0..count).map(vector).collect::<Result<_, _>>()?;
        Ok(BaseVectorGeod { stamp, vectors })
    }

    /// The block; vectors beyond the 255th are left out.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let vectors = self.vectors.get(..usize::from(u8::MAX)).unwrap_or(&self.vectors);
        let mut writer = begun(self.stamp);
        writer.put(&[vectors.len() as u8, VECTOR as u8]);
        for vector in vectors {
            vector.write(&mut writer);
        }
        framed((ID, 0), &writer)
    }

    /// What the message says of its epoch: a heading, if there is just one base that moves.
    #[must_use]
    pub fn part(&self) -> GnssPart {
        let mut headings = self.vectors.iter().filter_map(BaseVector::heading);
        let heading = headings.next().filter(|_| headings.next().is_none());
        let (kind, epoch) = ("BaseVectorGeod", self.stamp.epoch());
        GnssPart { kind, epoch, heading, ..GnssPart::default() }
    }
}
