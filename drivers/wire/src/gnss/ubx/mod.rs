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

pub use cov::{Covariance, NavCov, NavDop};
pub use frame::{Frame, look};
pub use hpposllh::NavHpPosLlh;
pub use older::{NavPosLlh, NavSol, NavStatus, NavTimeUtc, NavVelNed};
pub use pvt::{Carrier, FixType, NavPvt, PvtTime};
pub use raw::{RawMeasurement, RxmRawx, RxmSfrbx};
pub use relposned::NavRelPosNed;
pub use signal::Signal;
pub use time::{LeapEvent, NavTimeGps, NavTimeLs, TimTp};

use super::{GnssPart, PulseTime};
use crate::binary::Fault;

/// A message.
#[derive(Clone, Debug, PartialEq)]
pub enum Message {
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

impl Message {
    /// Reads a frame.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(frame: &[u8]) -> Result<Self, Fault> {
        let Frame { class, id, payload } = Frame::open(frame)?;
        // without a payload it is a poll, which says nothing
        Ok(match (class, id) {
            _ if payload.is_empty() => Message::Other { class, id },
            pvt::NAME => Message::NavPvt(Box::new(NavPvt::read(frame)?)),
            cov::DOP => Message::NavDop(NavDop::read(frame)?),
            cov::COV => Message::NavCov(NavCov::read(frame)?),
            hpposllh::NAME => Message::NavHpPosLlh(NavHpPosLlh::read(frame)?),
            older::POSLLH => Message::NavPosLlh(NavPosLlh::read(frame)?),
            older::VELNED => Message::NavVelNed(NavVelNed::read(frame)?),
            older::SOL => Message::NavSol(NavSol::read(frame)?),
            older::STATUS => Message::NavStatus(NavStatus::read(frame)?),
            older::TIMEUTC => Message::NavTimeUtc(NavTimeUtc::read(frame)?),
            relposned::NAME if payload.first() == Some(&NavRelPosNed::VERSION) => {
                Message::NavRelPosNed(NavRelPosNed::read(frame)?)
            }
            time::TIME_GPS => Message::NavTimeGps(NavTimeGps::read(frame)?),
            time::TIME_LS => Message::NavTimeLs(NavTimeLs::read(frame)?),
            time::TIM_TP => Message::TimTp(TimTp::read(frame)?),
            raw::RAWX => Message::RxmRawx(RxmRawx::read(frame)?),
            raw::SFRBX => Message::RxmSfrbx(RxmSfrbx::read(frame)?),
            _ => Message::Other { class, id },
        })
    }

    /// What the message says of an epoch.
    #[must_use]
    pub fn part(&self) -> Option<GnssPart> {
        Some(match self {
            Message::NavPvt(message) => message.part(),
            Message::NavDop(message) => message.part(),
            Message::NavCov(message) => message.part(),
            Message::NavHpPosLlh(message) => message.part(),
            Message::NavPosLlh(message) => message.part(),
            Message::NavVelNed(message) => message.part(),
            Message::NavSol(message) => message.part(),
            Message::NavStatus(message) => message.part(),
            Message::NavTimeUtc(message) => message.part(),
            Message::NavRelPosNed(message) => message.part(),
            Message::NavTimeGps(message) => message.part(),
            Message::NavTimeLs(message) => message.part(),
            _ => return None,
        })
    }

    /// The pulse of which the message speaks.
    #[must_use]
    pub fn pulse(&self) -> Option<PulseTime> {
        match self {
            Message::TimTp(message) => message.pulse(),
            _ => None,
        }
    }
}
