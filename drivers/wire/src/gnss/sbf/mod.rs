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
pub use cov::{PosCovGeodetic, SbfCovariance, VelCovGeodetic};
pub use field::{SbfMode, SbfSolution};
pub use frame::{Frame, SbfStamp, look};
pub use measurements::{MeasChannel, MeasEpoch, MeasOther};
pub use navigation::{RawNavigation, RawNavigationKind};
pub use pvt::{PvtAccuracy, PvtGeodetic};
pub use time::{ReceiverTime, XppsOffset};
pub use vector::{BaseVector, BaseVectorGeod};

use super::{GnssPart, PulseTime};
use crate::binary::BinaryFault;

/// A block.
#[derive(Clone, Debug, PartialEq)]
pub enum SbfMessage {
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

impl SbfMessage {
    /// Reads a block.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(block: &[u8]) -> Result<Self, BinaryFault> {
        let Frame { id, revision, .. } = Frame::open(block)?;
        Ok(match id {
            pvt::ID => SbfMessage::PvtGeodetic(Box::new(PvtGeodetic::read(block)?)),
            cartesian::ID => SbfMessage::PvtCartesian(Box::new(PvtCartesian::read(block)?)),
            vector::ID => SbfMessage::BaseVectorGeod(BaseVectorGeod::read(block)?),
            cov::POSITION => SbfMessage::PosCovGeodetic(PosCovGeodetic::read(block)?),
            cov::VELOCITY => SbfMessage::VelCovGeodetic(VelCovGeodetic::read(block)?),
            attitude::ANGLES => SbfMessage::AttEuler(AttEuler::read(block)?),
            attitude::COVARIANCE => SbfMessage::AttCovEuler(AttCovEuler::read(block)?),
            time::RECEIVER_TIME => SbfMessage::ReceiverTime(ReceiverTime::read(block)?),
            time::PULSE => SbfMessage::XppsOffset(XppsOffset::read(block)?),
            measurements::ID => SbfMessage::MeasEpoch(MeasEpoch::read(block)?),
            _ if RawNavigationKind::of(id).is_some() => {
                SbfMessage::RawNavigation(RawNavigation::read(block)?)
            }
            _ => SbfMessage::Other { id, revision },
        })
    }

    /// What the block says of an epoch.
    #[must_use]
    pub fn part(&self) -> Option<GnssPart> {
        Some(match self {
            SbfMessage::PvtGeodetic(block) => block.part(),
            SbfMessage::PvtCartesian(block) => block.part(),
            SbfMessage::BaseVectorGeod(block) => block.part(),
            SbfMessage::PosCovGeodetic(block) => block.part(),
            SbfMessage::VelCovGeodetic(block) => block.part(),
            SbfMessage::AttEuler(block) => block.part(),
            SbfMessage::AttCovEuler(block) => block.part(),
            SbfMessage::ReceiverTime(block) => block.part(),
            _ => return None,
        })
    }

    /// The pulse of which the block speaks.
    #[must_use]
    pub fn pulse(&self) -> Option<PulseTime> {
        match self {
            SbfMessage::XppsOffset(block) => block.pulse(),
            _ => None,
        }
    }
}
