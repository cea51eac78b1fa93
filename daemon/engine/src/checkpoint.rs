//! A navigating engine as bytes, from which the next one goes on after a crash.
//!
//! The bytes are `insc`, the version, the length of what follows, the state by `postcard`, and a CRC-32
//! over all of it; numbers in little-endian order. They are the same for the same state. 18 kB, of
//! which one triangle of the covariance is 12. Whatever the bytes are, reading them gives a state
//! or a reason, never a panic.

use crc::{CRC_32_ISO_HDLC, Crc, Table};
use insd_alignment::stored::fingerprint;
use insd_base::{ImuSpec, LeverArms, ResumeDoubt};
use insd_nav::Conditioner;
use insd_nav::navigator::checkpoint::NavigatorCheckpoint;
use serde::{Deserialize, Serialize};

use crate::alignment_status::StatusCheckpoint;
use crate::learning::Learning;
use crate::surveyor::Probation;

/// What begins each checkpoint.
const MARK: [u8; 4] = *b"insc";
/// To be raised whenever anything of [`Kept`] changes: the bytes do not say what they are. `tests/crash/bytes.rs` holds
/// their number, under way and at the berth.
const VERSION: u16 = 25;
const HEAD: usize = MARK.len() + 2 + 4;
const SUM: usize = 4;
/// More than a state can ever be, bytes.
const LONGEST: usize = 1 << 20;

static CRC: Crc<u32, Table<16>> = Crc::<u32, Table<16>>::new(&CRC_32_ISO_HDLC);

/// The state of a navigating engine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Kept {
    /// Which IMU it was, by its error model.
    pub(crate) imu: u64,
    /// Where the sensors sat, IMU to antenna and to log, body axes, m.
    pub(crate) arms: [[f64; 3]; 2],
    pub(crate) conditioner: Conditioner,
    pub(crate) navigator: NavigatorCheckpoint,
    pub(crate) aligned: bool,
    pub(crate) alignment_status: StatusCheckpoint,
    pub(crate) probation: Probation,
    pub(crate) learning: Option<Box<Learning>>,
}

impl Kept {
    /// What speaks against it before anything has been measured.
    pub(crate) fn doubt(&self, imu: &ImuSpec, arms: &LeverArms) -> Option<ResumeDoubt> {
        if self.imu != fingerprint(imu) {
            return Some(ResumeDoubt::OtherImu);
        }
        if self.arms != places(arms) {
            return Some(ResumeDoubt::OtherMounting);
        }
        (!self.conditioner.is_finite()).then_some(ResumeDoubt::NotFinite)
    }
}

/// Lever arms as they are kept.
pub(crate) fn places(arms: &LeverArms) -> [[f64; 3]; 2] {
    [arms.gnss.0.into(), arms.log.0.into()]
}

/// The bytes of a state; `None` if it cannot be written.
pub(crate) fn write(kept: &Kept) -> Option<Vec<u8>> {
    let state = postcard::to_stdvec(kept).ok()?;
    let length = u32::try_from(state.len()).ok()?;
    let mut bytes = Vec::with_capacity(HEAD + state.len() + SUM);
    bytes.extend(MARK);
    bytes.extend(VERSION.to_le_bytes());
    bytes.extend(length.to_le_bytes());
    bytes.extend(state);
    let sum = CRC.checksum(&bytes);
    bytes.extend(sum.to_le_bytes());
    Some(bytes)
}

/// The state of the bytes.
pub(crate) fn read(bytes: &[u8]) -> Result<Kept, ResumeDoubt> {
    let damaged = ResumeDoubt::Damaged;
    if bytes.len() > LONGEST {
        return Err(damaged);
    }
    let body = bytes.len().checked_sub(SUM).ok_or(damaged)?;
    let (summed, sum) = bytes.split_at_checked(body).ok_or(damaged)?;
    if CRC.checksum(summed).to_le_bytes() != *sum {
        return Err(damaged);
    }
    let (head, state) = summed.split_at_checked(HEAD).ok_or(damaged)?;
    let (mark, head) = head.split_at(MARK.len());
    let (version, length) = head.split_at(2);
    let is_whole = u32::try_from(state.len()).is_ok_and(|whole| whole.to_le_bytes() == *length);
    if mark != MARK || !is_whole {
        return Err(damaged);
    }
    if version != VERSION.to_le_bytes() {
        return Err(ResumeDoubt::OtherVersion);
    }
    match postcard::take_from_bytes::<Kept>(state) {
        Ok((kept, [])) => Ok(kept),
        _ => Err(ResumeDoubt::OtherVersion),
    }
}

#[cfg(test)]
mod tests;
