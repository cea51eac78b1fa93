//! SBF: the binary format of Septentrio receivers.
//!
//! Readers never panic, whatever the bytes. Blocks may be longer than their document says: padding,
//! and fields of later revisions, are skipped. `WNc` is a whole week and knows no rollover of 1024.
//! Layouts are from the maker's guides and pysbf2; logs of a device were at hand for MeasEpoch and raw navigation bits only.

mod attitude;
mod cartesian;
mod cov;
mod field;
mod frame;
mod measurements;
mod navigation;
mod pvt;
mod signal;
mod time;
mod vector;

pub use attitude::{AttCovEuler, AttEuler};
pub use cartesian::PvtCartesian;
pub use cov::{Covariance, PosCovGeodetic, VelCovGeodetic};
pub use field::{Mode, Solution};
pub use frame::{Frame, Stamp, look};
pub use measurements::{MeasChannel, MeasEpoch, MeasOther};
pub use navigation::{RawNavigation, RawNavigationKind};
pub use pvt::{PvtAccuracy, PvtGeodetic};
pub use time::{ReceiverTime, XppsOffset};
pub use vector::{BaseVector, BaseVectorGeod};

use super::{GnssPart, PulseTime};
use crate::binary::Fault;

/// A block.
#[derive(Clone, Debug, PartialEq)]
pub enum Message {
    /// Position, velocity and time.
    PvtGeodetic(Box<PvtGeodetic>),
    /// Position, velocity and time along the axes of the Earth.
    PvtCartesian(Box<PvtCartesian>),
    /// Lines from bases.
    BaseVectorGeod(BaseVectorGeod),
    /// Covariance of the position.
    PosCovGeodetic(PosCovGeodetic),
    /// Covariance of the velocity.
    VelCovGeodetic(VelCovGeodetic),
    /// Attitude.
    AttEuler(AttEuler),
    /// Covariance of the attitude.
    AttCovEuler(AttCovEuler),
    /// UTC and leap seconds.
    ReceiverTime(ReceiverTime),
    /// Time of the last pulse.
    XppsOffset(XppsOffset),
    /// Measurements.
    MeasEpoch(MeasEpoch),
    /// Bits of a navigation message.
    RawNavigation(RawNavigation),
    /// A good block that is not read here.
    Other {
        /// Its number.
        id: u16,
        /// Its revision.
        revision: u8,
    },
}

impl Message {
    /// Reads a block.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(block: &[u8]) -> Result<Self, Fault> {
        let Frame { id, revision, .. } = Frame::open(block)?;
        Ok(match id {
            pvt::ID => Message::PvtGeodetic(Box::new(PvtGeodetic::read(block)?)),
            cartesian::ID => Message::PvtCartesian(Box::new(PvtCartesian::read(block)?)),
            vector::ID => Message::BaseVectorGeod(BaseVectorGeod::read(block)?),
            cov::POSITION => Message::PosCovGeodetic(PosCovGeodetic::read(block)?),
            cov::VELOCITY => Message::VelCovGeodetic(VelCovGeodetic::read(block)?),
            attitude::ANGLES => Message::AttEuler(AttEuler::read(block)?),
            attitude::COVARIANCE => Message::AttCovEuler(AttCovEuler::read(block)?),
            time::RECEIVER_TIME => Message::ReceiverTime(ReceiverTime::read(block)?),
            time::PULSE => Message::XppsOffset(XppsOffset::read(block)?),
            measurements::ID => Message::MeasEpoch(MeasEpoch::read(block)?),
            _ if RawNavigationKind::of(id).is_some() => {
                Message::RawNavigation(RawNavigation::read(block)?)
            }
            _ => Message::Other { id, revision },
        })
    }

    /// What the block says of an epoch.
    #[must_use]
    pub fn part(&self) -> Option<GnssPart> {
        Some(match self {
            Message::PvtGeodetic(block) => block.part(),
            Message::PvtCartesian(block) => block.part(),
            Message::BaseVectorGeod(block) => block.part(),
            Message::PosCovGeodetic(block) => block.part(),
            Message::VelCovGeodetic(block) => block.part(),
            Message::AttEuler(block) => block.part(),
            Message::AttCovEuler(block) => block.part(),
            Message::ReceiverTime(block) => block.part(),
            _ => return None,
        })
    }

    /// The pulse of which the block speaks.
    #[must_use]
    pub fn pulse(&self) -> Option<PulseTime> {
        match self {
            Message::XppsOffset(block) => block.pulse(),
            _ => None,
        }
    }
}
