//! UBX: the binary protocol of u-blox receivers.
//!
//! Readers never panic, whatever the bytes. Weeks are whole and need no help with rollovers of 1024;
//! but a receiver whose firmware has outlived its own reference week reports a week that is 1024 too
//! small, and no flag tells: [`insd_base::GpsTime::nearest_rollover`] is for whoever knows the date.

mod cov;
mod field;
mod frame;
mod hpposllh;
mod older;
mod pvt;
mod raw;
mod relposned;
mod signal;
mod time;

pub use cov::{NavCov, NavDop, UbxCovariance};
pub use frame::{Frame, look};
pub use hpposllh::NavHpPosLlh;
pub use older::{NavPosLlh, NavSol, NavStatus, NavTimeUtc, NavVelNed};
pub use pvt::{Carrier, FixType, NavPvt, PvtTime};
pub use raw::{RawMeasurement, RxmRawx, RxmSfrbx};
pub use relposned::NavRelPosNed;
pub use signal::Signal;
pub use time::{LeapEvent, NavTimeGps, NavTimeLs, TimTp};

use super::{GnssPart, PulseTime};
use crate::binary::BinaryFault;

/// A message.
#[derive(Clone, Debug, PartialEq)]
pub enum UbxMessage {
    /// Position, velocity and time.
    NavPvt(Box<NavPvt>),
    /// Dilutions of precision.
    NavDop(NavDop),
    /// Covariances of position and velocity.
    NavCov(NavCov),
    /// Position to a tenth of a millimetre.
    NavHpPosLlh(NavHpPosLlh),
    /// Position of an epoch; whether there is a fix another message tells.
    NavPosLlh(NavPosLlh),
    /// Velocity of an epoch.
    NavVelNed(NavVelNed),
    /// Fix, position and velocity along the axes of the Earth.
    NavSol(NavSol),
    /// What the receiver says of its fix.
    NavStatus(NavStatus),
    /// UTC of an epoch.
    NavTimeUtc(NavTimeUtc),
    /// From the antenna of a base to that of the receiver.
    NavRelPosNed(NavRelPosNed),
    /// GPS time of an epoch.
    NavTimeGps(NavTimeGps),
    /// Leap seconds.
    NavTimeLs(NavTimeLs),
    /// Time of the next pulse.
    TimTp(TimTp),
    /// Measurements.
    RxmRawx(RxmRawx),
    /// Words of a navigation message.
    RxmSfrbx(RxmSfrbx),
    /// A good frame of a message that is not read here.
    Other {
        /// Its class.
        class: u8,
        /// Which one of its class.
        id: u8,
    },
}

impl UbxMessage {
    /// Reads a frame.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        let Frame { class, id, payload } = Frame::open(frame)?;
        // without a payload it is a poll, which says nothing
        Ok(match (class, id) {
            _ if payload.is_empty() => UbxMessage::Other { class, id },
            pvt::NAME => UbxMessage::NavPvt(Box::new(NavPvt::read(frame)?)),
            cov::DOP => UbxMessage::NavDop(NavDop::read(frame)?),
            cov::COV => UbxMessage::NavCov(NavCov::read(frame)?),
            hpposllh::NAME => UbxMessage::NavHpPosLlh(NavHpPosLlh::read(frame)?),
            older::POSLLH => UbxMessage::NavPosLlh(NavPosLlh::read(frame)?),
            older::VELNED => UbxMessage::NavVelNed(NavVelNed::read(frame)?),
            older::SOL => UbxMessage::NavSol(NavSol::read(frame)?),
            older::STATUS => UbxMessage::NavStatus(NavStatus::read(frame)?),
            older::TIMEUTC => UbxMessage::NavTimeUtc(NavTimeUtc::read(frame)?),
            relposned::NAME if payload.first() == Some(&NavRelPosNed::VERSION) => {
                UbxMessage::NavRelPosNed(NavRelPosNed::read(frame)?)
            }
            time::TIME_GPS => UbxMessage::NavTimeGps(NavTimeGps::read(frame)?),
            time::TIME_LS => UbxMessage::NavTimeLs(NavTimeLs::read(frame)?),
            time::TIM_TP => UbxMessage::TimTp(TimTp::read(frame)?),
            raw::RAWX => UbxMessage::RxmRawx(RxmRawx::read(frame)?),
            raw::SFRBX => UbxMessage::RxmSfrbx(RxmSfrbx::read(frame)?),
            _ => UbxMessage::Other { class, id },
        })
    }

    /// What the message says of an epoch.
    #[must_use]
    pub fn part(&self) -> Option<GnssPart> {
        Some(match self {
            UbxMessage::NavPvt(message) => message.part(),
            UbxMessage::NavDop(message) => message.part(),
            UbxMessage::NavCov(message) => message.part(),
            UbxMessage::NavHpPosLlh(message) => message.part(),
            UbxMessage::NavPosLlh(message) => message.part(),
            UbxMessage::NavVelNed(message) => message.part(),
            UbxMessage::NavSol(message) => message.part(),
            UbxMessage::NavStatus(message) => message.part(),
            UbxMessage::NavTimeUtc(message) => message.part(),
            UbxMessage::NavRelPosNed(message) => message.part(),
            UbxMessage::NavTimeGps(message) => message.part(),
            UbxMessage::NavTimeLs(message) => message.part(),
            _ => return None,
        })
    }

    /// The pulse of which the message speaks.
    #[must_use]
    pub fn pulse(&self) -> Option<PulseTime> {
        match self {
            UbxMessage::TimTp(message) => message.pulse(),
            _ => None,
        }
    }
}
