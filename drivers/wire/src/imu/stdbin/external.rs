//! External blocks: what the sensors of the system told it.

use super::composer::Composer;
use super::sizes::{Blocks, floats};
use crate::binary::{Reader, Writer};

/// The external blocks that are read.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct External {
    /// Bit 0: synchronisation to UTC.
    pub utc: Option<UtcSync>,
    /// Bits 4 and 5: electromagnetic logs.
    pub em_logs: [Option<EmLog>; 2],
    /// Bits 10 and 21: Doppler logs over the ground.
    pub ground: [Option<LogSpeed>; 2],
    /// Bits 11 and 22: Doppler logs through the water.
    pub water: [Option<LogSpeed>; 2],
}

/// Synchronisation to UTC.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UtcSync {
    /// Time of the last synchronisation, 0.1 ms of the system's clock.
    pub validity: u32,
    /// Which of the system's two sources.
    pub source: u8,
}

/// An electromagnetic log.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmLog {
    /// Time of validity, 0.1 ms of the system's clock.
    pub validity: u32,
    /// Which log: 0 or 1.
    pub id: u8,
    /// Speed through the water along XV1, m/s.
    pub forward: f64,
    /// 1-sigma of the speed, m/s.
    pub std: f64,
}

/// A Doppler log.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogSpeed {
    /// Time of validity, 0.1 ms of the system's clock.
    pub validity: u32,
    /// Which log: 0 or 1.
    pub id: u8,
    /// Velocity along XV1 forward, XV2 to port, XV3 up, m/s.
    pub velocity: [f64; 3],
    /// Speed of sound, m/s.
    pub sound: f64,
    /// Distance to the bottom, m; not told through the water.
    pub altitude: Option<f64>,
    /// 1-sigma of each component, m/s.
    pub std: [f64; 3],
}

impl External {
    pub(super) fn read(blocks: &Blocks<'_>) -> Self {
        External {
            utc: blocks[0].and_then(UtcSync::read),
            em_logs: [blocks[4], blocks[5]].map(|block| block.and_then(EmLog::read)),
            ground: [blocks[10], blocks[21]].map(|block| block.and_then(LogSpeed::read_ground)),
            water: [blocks[11], blocks[22]].map(|block| block.and_then(LogSpeed::read_water)),
        }
    }

    pub(super) fn write(&self, composer: &mut Composer) {
        if let Some(utc) = self.utc {
            composer.block((2, 0)).be_u32(utc.validity).u8(utc.source);
        }
        for (bit, em_log) in [4, 5].into_iter().zip(self.em_logs) {
            if let Some(em_log) = em_log {
                em_log.write(composer.block((2, bit)));
            }
        }
        let dvls = [self.ground[0], self.water[0], self.ground[1], self.water[1]];
        for ((bit, ground), dvl) in
            [(10, true), (11, false), (21, true), (22, false)].iter().zip(dvls)
        {
            if let Some(dvl) = dvl {
                dvl.write(composer.block((2, *bit)), *ground);
            }
        }
    }
}

/// Validity, id, and the rest of a block.
fn split(block: &[u8]) -> Option<(u32, u8, &[u8])> {
    let mut reader = Reader::new(block);
    Some((reader.be_u32().ok()?, reader.u8().ok()?, reader.rest()))
}

impl UtcSync {
    fn read(block: &[u8]) -> Option<Self> {
        let (validity, source, _) = split(block)?;
        Some(UtcSync { validity, source })
    }
}

impl EmLog {
    fn read(block: &[u8]) -> Option<Self> {
        let (validity, id, rest) = split(block)?;
        let [forward, std] = floats(Some(rest), [1.0; 2])?;
        Some(EmLog { validity, id, forward, std })
    }

    fn write(&self, block: &mut Writer) {
        block.be_u32(self.validity).u8(self.id);
        block.be_f32(self.forward as f32).be_f32(self.std as f32);
    }
}

impl LogSpeed {
    fn read_ground(block: &[u8]) -> Option<Self> {
        let (validity, id, rest) = split(block)?;
        let [x, y, z, sound, altitude, std @ ..] = floats::<8>(Some(rest), [1.0; 8])?;
        let velocity = [x, y, z];
        Some(LogSpeed { validity, id, velocity, sound, altitude: Some(altitude), std })
    }

    fn read_water(block: &[u8]) -> Option<Self> {
        let (validity, id, rest) = split(block)?;
        let [x, y, z, sound, std @ ..] = floats::<7>(Some(rest), [1.0; 7])?;
        Some(LogSpeed { validity, id, velocity: [x, y, z], sound, altitude: None, std })
    }

    /// An unknown altitude over the ground is written as NaN, so that the block is left out by readers.
    fn write(&self, block: &mut Writer, ground: bool) {
        block.be_u32(self.validity).u8(self.id);
        let altitude = ground.then_some(self.altitude.unwrap_or(f64::NAN));
        let values = self.velocity.into_iter().chain([self.sound]).chain(altitude).chain(self.std);
        for value in values {
            block.be_f32(value as f32);
        }
    }
}
