//! PD0: the binary ensemble of Teledyne RDI's Doppler logs and current profilers.
//!
//! ```text
//! header      7F 7F   bytes u16   spare   types u8   offset of each type u16
//! 0x0000      fixed leader: set-up            0x0080   variable leader: time, attitude
//! 0x0600      bottom track                    others   stepped over: profiles, makers' own
//! reserved 2 bytes   checksum u16: the sum of all bytes before it
//! ```
//!
//! Numbers are little endian; `bytes` does not count the checksum. Velocities are in the frame that
//! the fixed leader tells: beams, instrument, ship or earth.
//!
//! **Sign.** PD0 takes the instrument to stand and the bottom to move: with beam 3 forward and the
//! ship going ahead, y is negative (PD4, PD5, PD6 and PD13 are the other way round). The structs hold
//! what is on the wire. [`Ensemble::reading`] turns it round, so that instrument, ship and earth
//! velocities are those of the ship; beam velocities stay as they are, positive towards the
//! transducer.
//!
//! **Ship frame** of the maker: x to starboard, y forward, z along the mast, up; a reading has forward,
//! starboard, down. It holds the instrument's heading alignment (`EA`), and its tilts if it was told to
//! use them ([`Transformation::tilts`]).
//!
//! The clock of the instrument is set by hand, so that a reading has no UTC.
//!
//! Sources: Teledyne RDI Pathfinder DVL Guide (April 2018), tables 39 and 40 and page 206 for the
//! signs; WorkHorse output data format; field offsets compared with `rock-drivers/drivers-dvl_teledyne`
//! and with the reader of dolfyn 1.3.

mod bottom;
mod janus;
mod leader;

pub use bottom::{BottomTrack, WaterLayer};
pub use janus::{Geometry, Janus};
pub use leader::{Coordinates, FixedLeader, Transformation, VariableLeader};

use insd_base::LogReference;

use super::{LogFrame, LogReading};
use crate::binary::{BinaryFault, Reader, Writer};
use crate::stream::Look;

/// Longest ensemble that is taken, bytes: leaders, bottom track, and profiles of 255 cells with four
/// velocities, correlations, intensities, percents and states each come to some 6700.
const LONGEST: usize = 8192;
/// Bytes of the header before the offsets, and of the checksum.
const HEADER: usize = 6;
const SUM: usize = 2;

/// One ensemble. Data types that are not among the fields are stepped over and not written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ensemble {
    /// How the instrument is built and set up.
    pub fixed: FixedLeader,
    /// When, where and how it hung.
    pub variable: VariableLeader,
    /// Velocity over the bottom and through a layer of water.
    pub bottom: Option<BottomTrack>,
}

/// What stands at the start of some bytes: an ensemble with its checksum verified.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    if bytes.iter().take(2).any(|byte| *byte != 0x7F) {
        return Look::Nothing;
    }
    let Some(header) = bytes.get(..HEADER) else { return Look::More(HEADER) };
    let (Some(length), Some(types)) = (le_u16(header, 2), header.last()) else {
        return Look::Nothing;
    };
    let start = HEADER + 2 * usize::from(*types);
    if *types == 0 || !(start + 2..=LONGEST).contains(&length) {
        return Look::Nothing;
    }
    let Some(offsets) = bytes.get(HEADER..start) else { return Look::More(start) };
    let inside = |at: usize| (start..=length - 2).contains(&at);
    if !offsets.chunks(2).all(|pair| le_u16(pair, 0).is_some_and(inside)) {
        return Look::Nothing;
    }
    match bytes.get(..length + SUM) {
        None => Look::More(length + SUM),
        Some(frame) if is_sound(frame) => Look::Frame(length + SUM),
        Some(_) => Look::Damaged,
    }
}

fn le_u16(bytes: &[u8], at: usize) -> Option<usize> {
    let pair = bytes.get(at..at + 2)?;
    Some(pair.iter().rev().fold(0, |sum, byte| sum << 8 | usize::from(*byte)))
}

fn checksum(bytes: &[u8]) -> u16 {
    bytes.iter().fold(0, |sum, byte| sum.wrapping_add(u16::from(*byte)))
}

fn is_sound(frame: &[u8]) -> bool {
    frame
        .split_last_chunk::<SUM>()
        .is_some_and(|(body, sum)| checksum(body) == u16::from_le_bytes(*sum))
}

impl Ensemble {
    /// Reads a whole ensemble.
    ///
    /// # Errors
    /// [`BinaryFault::Frame`] if header, offsets or checksum are wrong, [`BinaryFault::OtherMessage`] without both
    /// leaders, [`BinaryFault::Short`] if one ends too early.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        if look(frame) != Look::Frame(frame.len()) {
            return Err(BinaryFault::Frame);
        }
        let mut header = Reader::new(frame);
        let [.., types] = header.array::<HEADER>()?;
        let offsets = header.take(2 * usize::from(types))?.chunks(2);
        let offsets: Vec<usize> = offsets.filter_map(|pair| le_u16(pair, 0)).collect();
        let (mut fixed, mut variable, mut bottom) = (None, None, None);
        for at in &offsets {
            let next = offsets.iter().filter(|next| *next > at).min();
            let end = next.copied().unwrap_or(frame.len() - SUM);
            let data = frame.get(*at..end).unwrap_or_default();
            match le_u16(data, 0) {
                Some(FixedLeader::ID) => fixed = Some(FixedLeader::read(data)?),
                Some(VariableLeader::ID) => variable = Some(VariableLeader::read(data)?),
                Some(BottomTrack::ID) => bottom = Some(BottomTrack::read(data)?),
                _ => {}
            }
        }
        match (fixed, variable) {
            (Some(fixed), Some(variable)) => Ok(Ensemble { fixed, variable, bottom }),
            _ => Err(BinaryFault::OtherMessage),
        }
    }

    /// Writes the ensemble.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let bottom = self.bottom.as_ref().map(BottomTrack::write);
        let types = [Some(self.fixed.write()), Some(self.variable.write()), bottom];
        let types: Vec<Vec<u8>> = types.into_iter().flatten().collect();
        let start = HEADER + 2 * types.len();
        // the two bytes before the checksum are reserved
        let length = start + types.iter().map(Vec::len).sum::<usize>() + 2;
        let mut frame = Writer::new();
        frame.put(&[0x7F, 0x7F]).le_u16(length as u16).u8(0).u8(types.len() as u8);
        let mut offset = start;
        for data in &types {
            frame.le_u16(offset as u16);
            offset += data.len();
        }
        for data in &types {
            frame.put(data);
        }
        frame.le_u16(0);
        let sum = checksum(frame.bytes());
        frame.le_u16(sum);
        frame.into_bytes()
    }

    /// Velocity of the ship over the bottom or through the water layer, in the frame of the ensemble.
    /// `None` without bottom track, if not one component is valid, or if no ping of the water layer was
    /// good, as its fields are there even when it is not measured.
    #[must_use]
    pub fn reading(&self, reference: LogReference) -> Option<LogReading> {
        let bottom = self.bottom.as_ref()?;
        let wire = match reference {
            LogReference::Bottom => bottom.velocity,
            LogReference::Water if bottom.water.percent_good == [0; 4] => [None; 4],
            LogReference::Water => bottom.water.velocity,
        };
        let turned = wire.map(|component| component.map(|velocity| -velocity));
        let (frame, velocity) = match self.fixed.transformation.coordinates {
            Coordinates::Beam => (LogFrame::Beam, wire),
            Coordinates::Instrument => {
                (LogFrame::Instrument, [turned[0], turned[1], turned[2], None])
            }
            Coordinates::Ship => (LogFrame::Ship, [turned[1], turned[0], wire[2], None]),
            Coordinates::Earth => (LogFrame::Earth, [turned[0], turned[1], turned[2], None]),
        };
        let some = velocity.iter().any(Option::is_some);
        some.then_some(LogReading { velocity, frame, reference, std: None, utc: None, age: None })
    }
}
