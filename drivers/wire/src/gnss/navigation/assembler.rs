//! Pages of all satellites until their set is whole.

use std::collections::BTreeMap;
use std::mem::discriminant;

use insd_base::GpsTime;
use insd_base::satellites::{
    BroadcastKind, BroadcastRecord, Constellation, IonosphereModel, SatelliteId,
};

use super::super::bits::Bits;
use super::super::kepler::SECOND;
use super::super::words::NavigationWords;
use super::broadcast::{Broadcast, WordsRefusal};
use super::{beidou, galileo, glonass, lnav};

/// The newest pages of one message of one satellite.
#[derive(Clone, Debug, Default)]
struct Pages {
    pages: BTreeMap<u8, Bits>,
    last: Option<BroadcastRecord>,
    /// GLONASS: when the first string of the frame came.
    begun: Option<GpsTime>,
}

/// GLONASS: longest time from string 1 to string 4 of one frame, ns: six seconds, and what receivers take to tell them.
const FRAME: i64 = 15 * SECOND;

impl Pages {
    /// All pages up to a number end to end; `None` unless they are all there.
    fn joined(&self, last: u8) -> Option<Bits> {
        let mut joined = Bits::default();
        for number in 1..=last {
            let page = self.pages.get(&number)?;
            joined.append(page, 0, page.len());
        }
        Some(joined)
    }

    /// Drops strings of GLONASS of another frame: they have no issue, so that only those that follow each other belong together.
    fn begin_frame(&mut self, number: u8, now: GpsTime) {
        if number == 1 {
            self.begun = Some(now);
        }
        let age = |begun: GpsTime| now.since(begun).as_nanos();
        let is_same = self.begun.is_some_and(|begun| (0..=FRAME).contains(&age(begun)));
        self.pages.retain(|earlier, _| is_same && *earlier < number);
    }

    /// A record that was not told before, but for the time of its transmission.
    fn news(&mut self, record: BroadcastRecord) -> Option<Broadcast> {
        let undated = |record: BroadcastRecord| match record {
            BroadcastRecord::Kepler(mut record) => {
                record.transmitted = None;
                BroadcastRecord::Kepler(record)
            }
            glonass @ BroadcastRecord::Glonass(_) => glonass,
        };
        let is_new = self.last.is_none_or(|last| undated(last) != undated(record));
        self.last = Some(record);
        is_new.then_some(Broadcast::Record(record))
    }
}

/// Puts the pages of all satellites together. Each record, model and count of leap seconds is told once until it changes.
#[derive(Clone, Debug, Default)]
pub struct NavigationAssembler {
    messages: BTreeMap<(SatelliteId, BroadcastKind), Pages>,
    ionospheres: Vec<IonosphereModel>,
    leap_seconds: Option<i8>,
}

/// The message that a satellite sends on a signal; `None` where it is not read.
fn kind(words: &NavigationWords) -> Option<BroadcastKind> {
    use Constellation as C;
    let (band, attribute) = (words.signal.band, words.signal.attribute);
    Some(match (words.satellite.constellation, band, attribute) {
        (C::Gps | C::Qzss, 1, b'C') => BroadcastKind::Lnav,
        // receivers before generation 9 do not tell E1-B from E1-C
        (C::Galileo, 1 | 7, _) => BroadcastKind::Inav,
        (C::Galileo, 5, _) => BroadcastKind::Fnav,
        (C::BeiDou, 2 | 6 | 7, b'I') if words.satellite.is_geostationary() => BroadcastKind::D2,
        (C::BeiDou, 2 | 6 | 7, b'I') => BroadcastKind::D1,
        (C::Glonass, 1 | 2, b'C') => BroadcastKind::Fdma,
        _ => return None,
    })
}

/// Number and bits of a page; `None` for one that says nothing.
fn page(kind: BroadcastKind, words: &[u32]) -> Result<Option<(u8, Bits)>, WordsRefusal> {
    match kind {
        BroadcastKind::Lnav => lnav::page(words).map(Some),
        BroadcastKind::Inav => galileo::inav_page(words),
        BroadcastKind::Fnav => galileo::fnav_page(words).map(Some),
        BroadcastKind::D1 | BroadcastKind::D2 => beidou::page(words, kind).map(Some),
        BroadcastKind::Fdma => glonass::string(words).map(Some),
    }
}

/// How many pages make a record.
fn pages(kind: BroadcastKind) -> u8 {
    match kind {
        BroadcastKind::Lnav | BroadcastKind::D1 => 3,
        BroadcastKind::Inav => 5,
        BroadcastKind::Fnav | BroadcastKind::Fdma => 4,
        BroadcastKind::D2 => 10,
    }
}

impl NavigationAssembler {
    /// An assembler that has heard nothing.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Says how many leap seconds there are, where somebody else knows; otherwise the table of this version holds until a satellite tells them.
    pub fn set_leap_seconds(&mut self, leap_seconds: i8) {
        self.leap_seconds = Some(leap_seconds);
    }

    /// Takes words that were received at a time, and gives what is whole by them.
    ///
    /// # Errors
    /// Why the words are refused. Those of a message that is not read are taken and say nothing.
    pub fn take(
        &mut self,
        words: &NavigationWords,
        received: GpsTime,
    ) -> Result<Vec<Broadcast>, WordsRefusal> {
        let Some(kind) = kind(words) else { return Ok(Vec::new()) };
        let Some((number, bits)) = page(kind, &words.words)? else { return Ok(Vec::new()) };
        let mut told = self.aside(words.satellite, kind, (number, &bits), received);
        if (1..=pages(kind)).contains(&number) {
            let own = self.messages.entry((words.satellite, kind)).or_default();
            if kind == BroadcastKind::Fdma {
                own.begin_frame(number, received);
            }
            own.pages.insert(number, bits);
            told.extend(self.record(words, kind, received)?);
        }
        Ok(told)
    }

    /// The record of a message whose pages are all there.
    fn record(
        &mut self,
        words: &NavigationWords,
        kind: BroadcastKind,
        received: GpsTime,
    ) -> Result<Option<Broadcast>, WordsRefusal> {
        let satellite = words.satellite;
        let Some(own) = self.messages.get_mut(&(satellite, kind)) else { return Ok(None) };
        let Some(bits) = own.joined(pages(kind)) else { return Ok(None) };
        let record = match kind {
            BroadcastKind::Lnav => lnav::record(satellite, &bits, received)?,
            BroadcastKind::Inav => galileo::INAV.record(satellite, &bits, received)?,
            BroadcastKind::Fnav => galileo::FNAV.record(satellite, &bits, received)?,
            BroadcastKind::D1 => beidou::D1.record(satellite, &bits, received)?,
            BroadcastKind::D2 => beidou::D2.record(satellite, &bits, received)?,
            BroadcastKind::Fdma => {
                let Some(channel) = words.channel else { return Ok(None) };
                let leap = self.leap_seconds.unwrap_or_else(|| crate::gnss::leap_seconds(received));
                let record = glonass::record(satellite, channel, &bits, (received, leap));
                return Ok(own.news(BroadcastRecord::Glonass(record)));
            }
        };
        Ok(record.and_then(|record| own.news(BroadcastRecord::Kepler(record))))
    }

    /// What a page tells beside the record.
    fn aside(
        &mut self,
        satellite: SatelliteId,
        kind: BroadcastKind,
        (number, bits): (u8, &Bits),
        received: GpsTime,
    ) -> Vec<Broadcast> {
        let (ionosphere, leap) = match (kind, number) {
            (BroadcastKind::Lnav, 4) if satellite.constellation == Constellation::Gps => {
                lnav::page_18(bits, received)
                    .map_or((None, None), |(ionosphere, leap)| (Some(ionosphere), leap))
            }
            (BroadcastKind::Inav, 5) => (galileo::INAV.ionosphere(&alone(bits, 5)), None),
            (BroadcastKind::Inav, 6) => (None, galileo::INAV.leap_seconds(bits, received)),
            (BroadcastKind::Fnav, 1) => (galileo::FNAV.ionosphere(&alone(bits, 1)), None),
            (BroadcastKind::Fnav, 4) => {
                (None, galileo::FNAV.leap_seconds(&alone(bits, 4), received))
            }
            _ => (None, None),
        };
        let ionosphere = ionosphere.filter(|model| self.is_new(*model)).map(Broadcast::Ionosphere);
        let leap = leap.filter(|leap| self.leap_seconds.replace(*leap) != Some(*leap));
        ionosphere.into_iter().chain(leap.map(Broadcast::LeapSeconds)).collect()
    }

    /// Whether a model is another than the last of its kind, which it takes the place of.
    fn is_new(&mut self, model: IonosphereModel) -> bool {
        if self.ionospheres.contains(&model) {
            return false;
        }
        self.ionospheres.retain(|last| discriminant(last) != discriminant(&model));
        self.ionospheres.push(model);
        true
    }
}

/// A page where it stands when all are end to end, with nothing before it.
fn alone(page: &Bits, number: usize) -> Bits {
    let mut bits = Bits::default();
    for _ in 1..number {
        bits.push(0, page.len());
    }
    bits.append(page, 0, page.len());
    bits
}
