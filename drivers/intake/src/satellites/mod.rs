//! Raw messages of one receiver: what it measured of each satellite, and what the satellites sent, whatever the format.
//!
//! A [`RawReading`] is what one message says; [`SatelliteFollower`] makes epochs and broadcast records of them. Whoever wants to see satellites,
//! and not to navigate, needs no more.

mod follower;
mod order;

pub use follower::{SatelliteFollower, SatelliteNews, WordsFault};
pub use order::EpochOrder;

use insd_base::{GpsTime, SatelliteEpoch};
use insd_wire::gnss::{NavigationWords, rtcm, sbf, ubx};
use insd_wire::stream::Protocol;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What is made of a receiver's raw messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RawUse {
    /// Ranges of each satellite, in the place of the receiver's fixes, where raw messages come.
    #[default]
    Tight,
    /// Nothing: they are not even read.
    Off,
}

/// What one raw message says.
#[derive(Clone, Debug, PartialEq)]
pub enum RawReading {
    /// What was measured.
    Measured {
        /// The epoch, as the receiver tells it.
        epoch: SatelliteEpoch,
        /// The receiver says that it knows the time.
        is_dated: bool,
        /// How often its clock was set so far, modulo 256, where it counts.
        jumps: Option<u8>,
    },
    /// Words of a satellite, and when they were received, where the message tells that.
    Words(NavigationWords, Option<GpsTime>),
    /// A frame of RTCM, which tells no date: it is read with what is known of it.
    Rtcm(Vec<u8>),
}

impl RawReading {
    /// What a message of UBX says; `None` if it is no raw one, or of a signal that is not known.
    #[must_use]
    pub fn of_ubx(message: &ubx::UbxMessage) -> Option<Self> {
        match message {
            ubx::UbxMessage::RxmRawx(raw) => {
                let epoch = raw.epoch()?;
                Some(RawReading::Measured { epoch, is_dated: raw.leap_seconds_valid, jumps: None })
            }
            ubx::UbxMessage::RxmSfrbx(raw) => Some(RawReading::Words(raw.navigation()?, None)),
            _ => None,
        }
    }

    /// What a block of SBF says; `None` as for [`Self::of_ubx`].
    #[must_use]
    pub fn of_sbf(message: &sbf::SbfMessage) -> Option<Self> {
        match message {
            sbf::SbfMessage::MeasEpoch(raw) => Some(RawReading::Measured {
                // a block whose time is not known has no epoch
                epoch: raw.epoch(None)?,
                is_dated: true,
                jumps: raw.clock_jumps,
            }),
            sbf::SbfMessage::RawNavigation(raw) => {
                Some(RawReading::Words(raw.navigation()?, raw.stamp.gps()))
            }
            _ => None,
        }
    }

    /// What a frame says, of a protocol that has raw messages; `None` as for [`Self::of_ubx`].
    #[must_use]
    pub fn of_frame(protocol: Protocol, frame: &[u8]) -> Option<Self> {
        match protocol {
            Protocol::Ubx => Self::of_ubx(&ubx::UbxMessage::read(frame).ok()?),
            Protocol::Sbf => Self::of_sbf(&sbf::SbfMessage::read(frame).ok()?),
            Protocol::Rtcm => {
                let number = rtcm::Frame::open(frame).ok()?.number()?;
                rtcm::is_of_satellites(number).then(|| RawReading::Rtcm(frame.to_vec()))
            }
            _ => None,
        }
    }
}
