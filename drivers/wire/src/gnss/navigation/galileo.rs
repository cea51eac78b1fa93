//! I/NAV of Galileo on E1-B and E5b-I (OS SIS ICD 2.1, 4.3), and F/NAV on E5a-I (4.2).
//!
//! I/NAV: positions count the 128 bits of each word type, types 1 to 5 end to end. F/NAV: the 214 bits of each page that the sum
//! guards, types 1 to 4 end to end.

use insd_base::GpsTime;
use insd_base::satellites::{BroadcastKind, IonosphereModel, KeplerRecord, SatelliteId};

use super::super::bits::{Bits, Field};
use super::super::crc24q::crc24q;
use super::super::kepler::{Layout, SECOND, half, semi, signal_in_space_accuracy};
use super::broadcast::WordsRefusal;
use super::leap::LeapLayout;

/// Bits of a word of I/NAV.
pub(super) const WORD: usize = 128;

/// Bits of a page of F/NAV before its sum.
pub(super) const PAGE: usize = 214;

/// GPS week in which Galileo's weeks begin.
const FIRST_WEEK: u16 = 1024;

/// One message of Galileo: where it says what.
pub(super) struct Message {
    kind: BroadcastKind,
    layout: Layout,
    /// IODnav, once a word or page that has one.
    issues: &'static [Field],
    accuracy: Field,
    week: Field,
    time: Field,
    /// BGD(E1,E5a) and BGD(E1,E5b).
    group_delays: [Field; 2],
    /// Fields of the nine bits of RINEX, with the place of each there.
    health: &'static [(Field, u32)],
    ionisation: [Field; 3],
    leap: LeapLayout,
}

/// Where a bit of a word of I/NAV stands.
const fn inav(word: usize, at: usize) -> usize {
    (word - 1) * WORD + at
}

/// Where a bit of a page of F/NAV stands.
const fn fnav(page: usize, at: usize) -> usize {
    (page - 1) * PAGE + at
}

/// I/NAV, word types 1 to 5; leap seconds are those of word type 6 on its own.
pub(super) const INAV: Message = Message {
    kind: BroadcastKind::Inav,
    layout: Layout {
        toe: Field::unsigned(inav(1, 16), 14, 60.0),
        sqrt_a: Field::unsigned(inav(1, 94), 32, half(19)),
        eccentricity: Field::unsigned(inav(1, 62), 32, half(33)),
        m0: Field::signed(inav(1, 30), 32, semi(31)),
        delta_n: Field::signed(inav(3, 40), 16, semi(43)),
        omega: Field::signed(inav(2, 80), 32, semi(31)),
        omega0: Field::signed(inav(2, 16), 32, semi(31)),
        omega_dot: Field::signed(inav(3, 16), 24, semi(43)),
        i0: Field::signed(inav(2, 48), 32, semi(31)),
        i_dot: Field::signed(inav(2, 112), 14, semi(43)),
        latitude: [
            Field::signed(inav(3, 56), 16, half(29)),
            Field::signed(inav(3, 72), 16, half(29)),
        ],
        radius: [Field::signed(inav(3, 88), 16, half(5)), Field::signed(inav(3, 104), 16, half(5))],
        inclination: [
            Field::signed(inav(4, 22), 16, half(29)),
            Field::signed(inav(4, 38), 16, half(29)),
        ],
        toc: Field::unsigned(inav(4, 54), 14, 60.0),
        clock: [
            Field::signed(inav(4, 68), 31, half(34)),
            Field::signed(inav(4, 99), 21, half(46)),
            Field::signed(inav(4, 120), 6, half(59)),
        ],
        behind: 0,
    },
    issues: &[
        Field::count(inav(1, 6), 10),
        Field::count(inav(2, 6), 10),
        Field::count(inav(3, 6), 10),
        Field::count(inav(4, 6), 10),
    ],
    accuracy: Field::count(inav(3, 120), 8),
    week: Field::count(inav(5, 73), 12),
    time: Field::count(inav(5, 85), 20),
    group_delays: [
        Field::signed(inav(5, 47), 10, half(32)),
        Field::signed(inav(5, 57), 10, half(32)),
    ],
    health: &[
        (Field::count(inav(5, 72), 1), 0),
        (Field::count(inav(5, 69), 2), 1),
        (Field::count(inav(5, 71), 1), 6),
        (Field::count(inav(5, 67), 2), 7),
    ],
    ionisation: [
        Field::unsigned(inav(5, 6), 11, half(2)),
        Field::signed(inav(5, 17), 11, half(8)),
        Field::signed(inav(5, 28), 14, half(15)),
    ],
    leap: LeapLayout {
        before: Field::signed(62, 8, 1.0),
        week: Field::count(86, 8),
        day: Field::count(94, 3),
        after: Field::signed(97, 8, 1.0),
    },
};

/// F/NAV, page types 1 to 4, which holds the leap seconds, too.
pub(super) const FNAV: Message = Message {
    kind: BroadcastKind::Fnav,
    layout: Layout {
        toe: Field::unsigned(fnav(3, 160), 14, 60.0),
        sqrt_a: Field::unsigned(fnav(2, 104), 32, half(19)),
        eccentricity: Field::unsigned(fnav(2, 72), 32, half(33)),
        m0: Field::signed(fnav(2, 16), 32, semi(31)),
        delta_n: Field::signed(fnav(3, 80), 16, semi(43)),
        omega: Field::signed(fnav(3, 48), 32, semi(31)),
        omega0: Field::signed(fnav(2, 136), 32, semi(31)),
        omega_dot: Field::signed(fnav(2, 48), 24, semi(43)),
        i0: Field::signed(fnav(3, 16), 32, semi(31)),
        i_dot: Field::signed(fnav(2, 168), 14, semi(43)),
        latitude: [
            Field::signed(fnav(3, 96), 16, half(29)),
            Field::signed(fnav(3, 112), 16, half(29)),
        ],
        radius: [
            Field::signed(fnav(3, 128), 16, half(5)),
            Field::signed(fnav(3, 144), 16, half(5)),
        ],
        inclination: [
            Field::signed(fnav(4, 16), 16, half(29)),
            Field::signed(fnav(4, 32), 16, half(29)),
        ],
        toc: Field::unsigned(fnav(1, 22), 14, 60.0),
        clock: [
            Field::signed(fnav(1, 36), 31, half(34)),
            Field::signed(fnav(1, 67), 21, half(46)),
            Field::signed(fnav(1, 88), 6, half(59)),
        ],
        behind: 0,
    },
    issues: &[
        Field::count(fnav(1, 12), 10),
        Field::count(fnav(2, 6), 10),
        Field::count(fnav(3, 6), 10),
        Field::count(fnav(4, 6), 10),
    ],
    accuracy: Field::count(fnav(1, 94), 8),
    week: Field::count(fnav(1, 155), 12),
    time: Field::count(fnav(1, 167), 20),
    group_delays: [Field::signed(fnav(1, 143), 10, half(32)), Field::count(0, 0)],
    health: &[(Field::count(fnav(1, 187), 1), 3), (Field::count(fnav(1, 153), 2), 4)],
    ionisation: [
        Field::unsigned(fnav(1, 102), 11, half(2)),
        Field::signed(fnav(1, 113), 11, half(8)),
        Field::signed(fnav(1, 124), 14, half(15)),
    ],
    leap: LeapLayout {
        before: Field::signed(fnav(4, 104), 8, 1.0),
        week: Field::count(fnav(4, 128), 8),
        day: Field::count(fnav(4, 136), 3),
        after: Field::signed(fnav(4, 139), 8, 1.0),
    },
};

/// Type and 128 bits of a word of I/NAV; `None` for an alert page, which has none.
pub(super) fn inav_page(words: &[u32]) -> Result<Option<(u8, Bits)>, WordsRefusal> {
    let halves: &[u32; 8] =
        words.first_chunk().ok_or(WordsRefusal::Short { needed: 8, found: words.len() })?;
    let mut page = Bits::default();
    halves.iter().for_each(|word| _ = page.push(u64::from(*word), 32));
    if page.get(0, 1) != 0 || page.get(128, 1) != 1 {
        return Err(WordsRefusal::Halves);
    }
    if page.get(1, 1) == 1 || page.get(129, 1) == 1 {
        return Ok(None);
    }
    let mut summed = Bits::default();
    summed.push(0, 4).append(&page, 0, 114).append(&page, 128, 82);
    if u64::from(crc24q(summed.bytes())) != page.get(128 + 82, 24) {
        return Err(WordsRefusal::Damaged);
    }
    let mut word = Bits::default();
    word.append(&page, 2, 112).append(&page, 130, 16);
    Ok(Some((word.get(0, 6) as u8, word)))
}

/// Type and 214 bits of a page of F/NAV.
pub(super) fn fnav_page(words: &[u32]) -> Result<(u8, Bits), WordsRefusal> {
    let words: &[u32; 8] =
        words.first_chunk().ok_or(WordsRefusal::Short { needed: 8, found: words.len() })?;
    let mut page = Bits::default();
    words.iter().for_each(|word| _ = page.push(u64::from(*word), 32));
    let mut summed = Bits::default();
    summed.push(0, 2).append(&page, 0, PAGE);
    if u64::from(crc24q(summed.bytes())) != page.get(PAGE, 24) {
        return Err(WordsRefusal::Damaged);
    }
    let mut own = Bits::default();
    own.append(&page, 0, PAGE);
    Ok((own.get(0, 6) as u8, own))
}

impl Message {
    /// The record of all its words or pages; `None` while they are of different issues.
    pub(super) fn record(
        &self,
        satellite: SatelliteId,
        bits: &Bits,
        received: GpsTime,
    ) -> Result<Option<KeplerRecord>, WordsRefusal> {
        let issues = self.issues.iter().map(|field| field.raw(bits));
        let issue = self.issues[0].raw(bits);
        if !issues.into_iter().all(|other| other == issue) {
            return Ok(None);
        }
        let week = FIRST_WEEK + self.week.raw(bits) as u16;
        let sent =
            GpsTime::from_week(week, self.time.whole(bits) * SECOND).nearest_rollover(received);
        let health = self.health.iter().map(|(field, at)| field.raw(bits) << at).sum::<u64>();
        Ok(Some(KeplerRecord {
            satellite,
            kind: self.kind,
            issue: issue as u16,
            clock_issue: issue as u16,
            health: health as u16,
            accuracy: signal_in_space_accuracy(self.accuracy.whole(bits)),
            group_delays: self.group_delays.map(|field| field.value(bits)),
            orbit: self.layout.orbit(bits, sent).ok_or(WordsRefusal::Implausible)?,
            clock: self.layout.clock(bits, sent),
            transmitted: Some(sent),
        }))
    }

    /// The ionosphere; `None` where all coefficients are zero, which says that there are none.
    pub(super) fn ionosphere(&self, bits: &Bits) -> Option<IonosphereModel> {
        let ionisation = self.ionisation.map(|field| field.value(bits));
        (ionisation != [0.0; 3]).then_some(IonosphereModel::NeQuickG { ionisation })
    }

    /// Leap seconds, out of word type 6 of I/NAV or all pages of F/NAV.
    pub(super) fn leap_seconds(&self, bits: &Bits, now: GpsTime) -> Option<i8> {
        self.leap.leap_seconds(bits, now)
    }

    /// The bits of all words or pages that say a record.
    #[cfg(test)]
    pub(super) fn bits(&self, record: &KeplerRecord, ionisation: [f64; 3]) -> Bits {
        let size = if self.kind == BroadcastKind::Inav { 5 * WORD } else { 4 * PAGE };
        let mut bits = Bits::zeros(size);
        let (week, time) = record.transmitted.unwrap_or(record.orbit.reference).to_week();
        self.layout.put(&mut bits, &record.orbit, &record.clock);
        self.week.put(&mut bits, (week - 1024) as f64);
        self.time.put(&mut bits, (time / SECOND) as f64);
        self.issues.iter().for_each(|field| field.put(&mut bits, record.issue.into()));
        let index = (0..256).find(|index| signal_in_space_accuracy(*index) == record.accuracy);
        self.accuracy.put(&mut bits, index.unwrap_or(15) as f64);
        for (field, value) in self.group_delays.iter().zip(record.group_delays) {
            field.put(&mut bits, value);
        }
        for (field, at) in self.health {
            field.put_raw(&mut bits, u64::from(record.health) >> at);
        }
        for (field, value) in self.ionisation.iter().zip(ionisation) {
            field.put(&mut bits, value);
        }
        bits
    }
}

/// The words of a page of I/NAV that carries a word.
#[cfg(test)]
pub(super) fn inav_words(word: &Bits) -> Vec<u32> {
    let mut even = Bits::default();
    even.push(0, 2).append(word, 0, 112);
    let mut odd = Bits::default();
    odd.push(0b10, 2).append(word, 112, 16).push(0, 64);
    let mut summed = Bits::default();
    summed.push(0, 4).append(&even, 0, 114).append(&odd, 0, 82);
    odd.push(crc24q(summed.bytes()).into(), 24).push(0, 22);
    even.push(0, 14).append(&odd, 0, 128);
    (0..8).map(|number| even.get(number * 32, 32) as u32).collect()
}

/// The words of a page of F/NAV.
#[cfg(test)]
pub(super) fn fnav_words(page: &Bits) -> Vec<u32> {
    let mut summed = Bits::default();
    summed.push(0, 2).append(page, 0, PAGE);
    let mut own = page.clone();
    own.push(crc24q(summed.bytes()).into(), 24).push(0, 18);
    (0..8).map(|number| own.get(number * 32, 32) as u32).collect()
}
