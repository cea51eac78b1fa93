//! Bottom track: data type 0x0600.
//!
//! ```text
//! offset
//! 2      pings u16
//! 16     range to the bottom 4 x u16, cm; 0 bad; the third byte of each stands at 77
//! 24     velocity 4 x i16, mm/s; -32768 bad
//! 32     correlation 4 x u8   36 amplitude 4 x u8   40 percent good 4 x u8
//! 44     water layer: least size, near end, far end 3 x u16, dm
//! 50     its velocity 4 x i16, mm/s; -32768 bad
//! 58     its correlation 4 x u8   62 intensity 4 x u8   66 percent good 4 x u8
//! 70     greatest depth u16, dm   72 signal strength 4 x u8   76 gain   77 range, see above
//! ```
//!
//! It ends after 81 bytes (Pathfinder) or 85 (WorkHorse), or, in old instruments, before offset 44.

use crate::binary::{BinaryFault, Reader, Writer, scaled};

/// What a bad velocity is written as.
const BAD: i16 = i16::MIN;
/// m/s of the least bit of a velocity; m of that of a range, and of a layer's end.
const VELOCITY: f64 = 1e-3;
const RANGE: f64 = 1e-2;
const LAYER: f64 = 0.1;
/// Bytes that are written.
const LENGTH: usize = 85;

/// Velocity over the bottom and through a layer of water, as on the wire: of bottom and water with
/// respect to the instrument, in the frame that the fixed leader tells.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct BottomTrack {
    /// Pings that were averaged.
    pub pings: u16,
    /// Vertical distance to the bottom by each beam, not corrected for tilt, m.
    pub range: [Option<f64>; 4],
    /// Beams 1 to 4; or x, y, z, error; or starboard, forward, mast, error; or east, north, up, error;
    /// m/s.
    pub velocity: [Option<f64>; 4],
    /// Correlation of each beam, counts.
    pub correlation: [u8; 4],
    /// Amplitude of each beam, counts.
    pub amplitude: [u8; 4],
    /// Good pings of each beam, percent.
    pub percent_good: [u8; 4],
    /// The water layer.
    pub water: WaterLayer,
}

/// The layer of water against which the instrument measures as well.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct WaterLayer {
    /// Distance of its near and far ends, m.
    pub bounds: [f64; 2],
    /// As the velocity over the bottom, m/s.
    pub velocity: [Option<f64>; 4],
    /// Correlation of each beam, counts.
    pub correlation: [u8; 4],
    /// Echo intensity of each beam, counts.
    pub intensity: [u8; 4],
    /// Good pings of each beam, percent.
    pub percent_good: [u8; 4],
}

impl BottomTrack {
    /// The data type's id.
    pub(super) const ID: usize = 0x0600;

    pub(super) fn read(data: &[u8]) -> Result<Self, BinaryFault> {
        let mut reader = Reader::new(data);
        reader.take(2)?;
        let pings = reader.le_u16()?;
        reader.take(12)?;
        let mut ranges = [0_u32; 4];
        for range in &mut ranges {
            *range = reader.le_u16()?.into();
        }
        let velocity = velocities(&mut reader)?;
        let (correlation, amplitude) = (reader.array()?, reader.array()?);
        let percent_good = reader.array()?;
        let water = WaterLayer::read(&mut reader).unwrap_or_default();
        if let Some(high) = data.get(77..81) {
            for (range, high) in ranges.iter_mut().zip(high) {
                *range |= u32::from(*high) << 16;
            }
        }
        let range = ranges.map(|range| (range > 0).then(|| f64::from(range) * RANGE));
        Ok(BottomTrack { pings, range, velocity, correlation, amplitude, percent_good, water })
    }

    pub(super) fn write(&self) -> Vec<u8> {
        let most = f64::from(0x00FF_FFFF);
        let ranges = self
            .range
            .map(|range| scaled(range.unwrap_or(0.0), RANGE).clamp(0, most as i64) as u32);
        let mut data = Writer::new();
        data.le_u16(Self::ID as u16).le_u16(self.pings).put(&[0; 12]);
        for range in ranges {
            data.le_u16(range as u16);
        }
        put_velocities(&mut data, self.velocity);
        data.put(&self.correlation).put(&self.amplitude).put(&self.percent_good);
        self.water.write(&mut data);
        data.put(&[0; 7]).put(&ranges.map(|range| (range >> 16) as u8));
        let missing = LENGTH.saturating_sub(data.bytes().len());
        data.put([0; LENGTH].get(..missing).unwrap_or_default());
        data.into_bytes()
    }
}

impl WaterLayer {
    fn read(reader: &mut Reader<'_>) -> Result<Self, BinaryFault> {
        reader.take(2)?;
        let bounds = [reader.le_u16()?, reader.le_u16()?];
        Ok(WaterLayer {
            bounds: bounds.map(|bound| f64::from(bound) * LAYER),
            velocity: velocities(reader)?,
            correlation: reader.array()?,
            intensity: reader.array()?,
            percent_good: reader.array()?,
        })
    }

    fn write(&self, data: &mut Writer) {
        data.le_u16(0);
        for bound in self.bounds {
            data.le_u16(scaled(bound, LAYER).clamp(0, u16::MAX.into()) as u16);
        }
        put_velocities(data, self.velocity);
        data.put(&self.correlation).put(&self.intensity).put(&self.percent_good);
    }
}

fn velocities(reader: &mut Reader<'_>) -> Result<[Option<f64>; 4], BinaryFault> {
    let mut velocities = [None; 4];
    for velocity in &mut velocities {
        let count = reader.le_i16()?;
        *velocity = (count != BAD).then(|| f64::from(count) * VELOCITY);
    }
    Ok(velocities)
}

fn put_velocities(data: &mut Writer, velocities: [Option<f64>; 4]) {
    for velocity in velocities {
        let count = velocity.filter(|velocity| velocity.is_finite()).map(|velocity| {
            scaled(velocity, VELOCITY).clamp((-i16::MAX).into(), i16::MAX.into()) as i16
        });
        data.le_i16(count.unwrap_or(BAD));
    }
}
