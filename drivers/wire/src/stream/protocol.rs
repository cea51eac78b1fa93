//! The protocols that a port can speak.

use super::Look;
use crate::gnss::{gsof, novatel, rtcm, sbf, ubx};
use crate::imu::{kvh, mip, sbg, stdbin, stim, vectornav, xbus};
use crate::log::{ad2cp, pd0, pd6};
use crate::motion::{em, kmb, tss1};
use crate::{ngt1, nmea, signalk};

/// A way of framing bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Protocol {
    /// NMEA 0183 lines, bare or in IEC 61162-450 datagrams.
    Nmea,
    /// sbgECom frames of SBG Systems.
    Sbg,
    /// MIP packets of MicroStrain.
    Mip,
    /// Xbus messages of Xsens.
    Xbus,
    /// UBX of u-blox receivers.
    Ubx,
    /// SBF of Septentrio receivers.
    Sbf,
    /// RTCM 10403 corrections.
    Rtcm,
    /// Telegrams of Exail (iXblue) inertial systems.
    StdBin,
    /// Messages of KVH 1725, 1750 and 1775.
    Kvh,
    /// Datagrams of Sensonor STIM300 and STIM318.
    Stim,
    /// Binary ensembles of Teledyne RDI.
    Pd0,
    /// Text lines of Teledyne RDI.
    Pd6,
    /// Binary logs of NovAtel receivers.
    Novatel,
    /// KM binary of motion sensors.
    Kmb,
    /// EM3000 of motion sensors.
    Em3000,
    /// TSS1 of motion sensors.
    Tss1,
    /// Binary messages of Actisense's adapters to NMEA 2000.
    Ngt1,
    /// Reports of Trimble receivers.
    Gsof,
    /// Binary messages of VectorNav.
    VectorNav,
    /// Records of Nortek's AD2CP instruments.
    Ad2cp,
    /// Lines of a Signal K server.
    SignalK,
}

impl Protocol {
    /// Those that can be told from one another in one stream, in the order in which they are asked.
    pub const ALL: [Protocol; 20] = [
        Protocol::Nmea,
        Protocol::Ubx,
        Protocol::Sbf,
        Protocol::Rtcm,
        Protocol::Sbg,
        Protocol::StdBin,
        Protocol::Mip,
        Protocol::Xbus,
        Protocol::Kvh,
        Protocol::Stim,
        Protocol::Pd0,
        Protocol::Pd6,
        Protocol::Novatel,
        Protocol::Kmb,
        Protocol::Tss1,
        Protocol::Ngt1,
        Protocol::VectorNav,
        Protocol::Ad2cp,
        Protocol::Gsof,
        Protocol::SignalK,
    ];

    /// Those that are sought only where somebody says that they are spoken: a telegram of EM3000 has no checksum, and may stand at the
    /// start of a longer frame of another.
    pub const ASKED_FOR: [Protocol; 1] = [Protocol::Em3000];

    /// Its short name, as in configurations and tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Protocol::Nmea => "nmea",
            Protocol::Sbg => "sbg",
            Protocol::Mip => "mip",
            Protocol::Xbus => "xbus",
            Protocol::Ubx => "ubx",
            Protocol::Sbf => "sbf",
            Protocol::Rtcm => "rtcm",
            Protocol::StdBin => "stdbin",
            Protocol::Kvh => "kvh",
            Protocol::Stim => "stim",
            Protocol::Pd0 => "pd0",
            Protocol::Pd6 => "pd6",
            Protocol::Novatel => "novatel",
            Protocol::Kmb => "kmb",
            Protocol::Em3000 => "em3000",
            Protocol::Tss1 => "tss1",
            Protocol::Ngt1 => "ngt1",
            Protocol::Gsof => "gsof",
            Protocol::VectorNav => "vectornav",
            Protocol::Ad2cp => "ad2cp",
            Protocol::SignalK => "signalk",
        }
    }

    /// What stands at the start of some bytes, at least one.
    #[must_use]
    pub fn look(self, bytes: &[u8]) -> Look {
        match self {
            Protocol::Nmea => nmea::look(bytes),
            Protocol::Sbg => sbg::look(bytes),
            Protocol::Mip => mip::look(bytes),
            Protocol::Xbus => xbus::look(bytes),
            Protocol::Ubx => ubx::look(bytes),
            Protocol::Sbf => sbf::look(bytes),
            Protocol::Rtcm => rtcm::look(bytes),
            Protocol::StdBin => stdbin::look(bytes),
            Protocol::Kvh => kvh::look(bytes),
            Protocol::Stim => stim::look(bytes),
            Protocol::Pd0 => pd0::look(bytes),
            Protocol::Pd6 => pd6::look(bytes),
            Protocol::Novatel => novatel::look(bytes),
            Protocol::Kmb => kmb::look(bytes),
            Protocol::Em3000 => em::look(bytes),
            Protocol::Tss1 => tss1::look(bytes),
            Protocol::Ngt1 => ngt1::look(bytes),
            Protocol::Gsof => gsof::look(bytes),
            Protocol::VectorNav => vectornav::look(bytes),
            Protocol::Ad2cp => ad2cp::look(bytes),
            Protocol::SignalK => signalk::look(bytes),
        }
    }

    /// Whether a frame or filler of this protocol can begin with a byte. May say yes too often.
    pub(crate) fn may_start(self, byte: u8) -> bool {
        self.look(&[byte]) != Look::Nothing
    }
}
