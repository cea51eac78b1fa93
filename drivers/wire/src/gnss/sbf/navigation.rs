//! Raw navigation bits: GPSRawCA, GALRawFNAV, GALRawINAV, GLORawCA, BDSRaw and QZSRawL1CA, which have one layout.
//!
//! Layout: mosaic-X5 Reference Guide 4.14.10, 4.2.2.

use insd_base::satellites::{Constellation, SatelliteId, SignalCode};

use super::super::bits::Bits;
use super::frame::{Frame, SbfStamp, begun, body, framed};
use super::signal::{channel, satellite, signal};
use crate::binary::BinaryFault;
use crate::gnss::NavigationWords;

/// Bits of the even half of a page of I/NAV without its tail, and of the odd half.
const HALVES: [usize; 2] = [114, 120];

/// Which message a block carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RawNavigationKind {
    /// GPSRawCA (4017): a subframe of LNAV.
    Gps,
    /// GALRawFNAV (4022): a page of F/NAV.
    GalileoFnav,
    /// GALRawINAV (4023): both halves of a page of I/NAV.
    GalileoInav,
    /// GLORawCA (4026): a string.
    Glonass,
    /// BDSRaw (4047): a subframe of D1 or D2.
    BeiDou,
    /// QZSRawL1CA (4066): a subframe of LNAV.
    Qzss,
}

use RawNavigationKind as Kind;

/// Number of the block, kind, words, number of the signal where `Source` tells none.
const BLOCKS: [(u16, Kind, usize, u8); 6] = [
    (4017, Kind::Gps, 10, 0),
    (4022, Kind::GalileoFnav, 8, 20),
    (4023, Kind::GalileoInav, 8, 17),
    (4026, Kind::Glonass, 3, 8),
    (4047, Kind::BeiDou, 10, 28),
    (4066, Kind::Qzss, 10, 6),
];

impl RawNavigationKind {
    /// The kind of a block's number.
    pub(super) fn of(id: u16) -> Option<Self> {
        BLOCKS.iter().find(|(own, ..)| *own == id).map(|(_, kind, ..)| *kind)
    }

    fn row(self) -> (u16, Kind, usize, u8) {
        BLOCKS.into_iter().find(|(_, own, ..)| *own == self).unwrap_or(BLOCKS[0])
    }
}

/// A block of raw navigation bits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RawNavigation {
    /// Which message.
    pub kind: RawNavigationKind,
    /// When the last bit was received, by the receiver's clock.
    pub stamp: SbfStamp,
    /// `SVID`.
    pub satellite: u8,
    /// `CRCPassed`: the receiver found its parities or its sum good.
    pub passed: bool,
    /// `ViterbiCnt`: errors that were mended.
    pub mended: u8,
    /// `Source`: bits 0-4 the number of the signal.
    pub source: u8,
    /// `FreqNr`: GLONASS' frequency number + 8.
    pub frequency: u8,
    /// `RxChannel`.
    pub receiver_channel: u8,
    /// `NAVBits`, as many as the kind has.
    pub words: Vec<u32>,
}

impl RawNavigation {
    /// Reads a block.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(block: &[u8]) -> Result<Self, BinaryFault> {
        let kind = Kind::of(Frame::open(block)?.id).ok_or(BinaryFault::OtherMessage)?;
        let (id, _, count, _) = kind.row();
        let (stamp, mut reader, _) = body(block, id)?;
        let [satellite, passed, mended, source, frequency, receiver_channel] = reader.array()?;
        Ok(RawNavigation {
            kind,
            stamp,
            satellite,
            passed: passed != 0,
            mended,
            source,
            frequency,
            receiver_channel,
            words: (0..count).map(|_| reader.le_u32()).collect::<Result<_, _>>()?,
        })
    }

    /// The block. Words that are missing are zero.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let (id, _, count, _) = self.kind.row();
        let mut writer = begun(self.stamp);
        writer.put(&[self.satellite, u8::from(self.passed), self.mended, self.source]);
        writer.put(&[self.frequency, self.receiver_channel]);
        for number in 0..count {
            writer.le_u32(self.words.get(number).copied().unwrap_or(0));
        }
        framed((id, 0), &writer)
    }

    /// The words for [`crate::gnss::navigation::NavigationAssembler`]; `None` if the receiver found them wrong, or does not say whose they are.
    #[must_use]
    pub fn navigation(&self) -> Option<NavigationWords> {
        let satellite = satellite(self.satellite).filter(|_| self.passed)?;
        let signal = self.signal(satellite)?;
        let channel = channel(satellite, self.frequency);
        let mut bits = Bits::default();
        self.words.iter().for_each(|word| _ = bits.push(u64::from(*word), 32));
        let words = match self.kind {
            Kind::GalileoInav => halves(&bits),
            Kind::BeiDou => (0..10).map(|word| bits.get(word * 30, 30) as u32).collect(),
            _ => self.words.clone(),
        };
        Some(NavigationWords { satellite, signal, channel, words })
    }

    fn signal(&self, satellite: SatelliteId) -> Option<SignalCode> {
        let (.., usual) = self.kind.row();
        let code = signal(satellite, self.source & 31).or_else(|| signal(satellite, usual))?;
        // the data are on the other component than the one that is measured
        let galileo = satellite.constellation == Constellation::Galileo;
        let data = match (galileo, code.band) {
            (true, 1) => b'B',
            (true, _) => b'I',
            _ => code.attribute,
        };
        Some(SignalCode::new(code.band, data))
    }
}

/// The halves of a page, each from the top bit of four words on.
fn halves(bits: &Bits) -> Vec<u32> {
    let [even, odd] = HALVES;
    let mut apart = Bits::default();
    apart.append(bits, 0, even).push(0, 128 - even).append(bits, even, odd).push(0, 128 - odd);
    (0..8).map(|word| apart.get(word * 32, 32) as u32).collect()
}
