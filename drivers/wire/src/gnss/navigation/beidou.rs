//! D1 and D2 of BeiDou (BDS-SIS-ICD-B1I 3.0, 5.2 and 5.3): subframes 1 to 3 of D1, pages 1 to 10 of subframe 1 of D2.
//!
//! Positions count data bits, 224 of each subframe, parity taken out; subframes or pages end to end. Its own coefficients for the ionosphere belong to
//! another model than those of GPS and are not read.

use insd_base::GpsTime;
use insd_base::satellites::{BroadcastKind, KeplerRecord, SatelliteId};

use super::super::bits::{Bits, Field};
use super::super::kepler::{Layout, SECOND, half, range_accuracy, semi};
use super::broadcast::WordsRefusal;
use super::checks::beidou_data;

/// Data bits of a subframe.
pub(super) const SIZE: usize = 224;

/// GPS week in which BeiDou's weeks begin.
const FIRST_WEEK: u16 = 1356;

/// GPS time - BeiDou time, s.
const BEHIND: i64 = 14;

/// One step of a group delay, s.
const DELAY: f64 = 1e-10;

const PREAMBLE: Field = Field::count(0, 11);
const NUMBER: Field = Field::count(15, 3);
/// Start of the subframe, s of BeiDou's week.
const TIME: Field = Field::count(18, 20);
/// Page of subframe 1 of D2.
const PAGE: Field = Field::count(38, 4);

/// Where a bit of a subframe or a page stands.
const fn on(page: usize, at: usize) -> usize {
    (page - 1) * SIZE + at
}

/// One message of BeiDou: where it says what.
pub(super) struct Message {
    kind: BroadcastKind,
    layout: Layout,
    pages: usize,
    /// Seconds from the start of one of its subframes or pages to the next.
    step: i64,
    health: Field,
    /// AODC and AODE.
    issues: [Field; 2],
    accuracy: Field,
    week: Field,
    /// TGD1 and TGD2.
    group_delays: [Field; 2],
}

/// D1: satellites in medium and inclined orbits.
pub(super) const D1: Message = Message {
    kind: BroadcastKind::D1,
    layout: Layout {
        toe: Field::unsigned(on(3, 38), 15, 8.0).behind(on(2, 222), 2),
        sqrt_a: Field::unsigned(on(2, 190), 32, half(19)),
        eccentricity: Field::unsigned(on(2, 104), 32, half(33)),
        m0: Field::signed(on(2, 72), 32, semi(31)),
        delta_n: Field::signed(on(2, 38), 16, semi(43)),
        omega: Field::signed(on(3, 191), 32, semi(31)),
        omega0: Field::signed(on(3, 159), 32, semi(31)),
        omega_dot: Field::signed(on(3, 103), 24, semi(43)),
        i0: Field::signed(on(3, 53), 32, semi(31)),
        i_dot: Field::signed(on(3, 145), 14, semi(43)),
        latitude: [Field::signed(on(2, 54), 18, half(31)), Field::signed(on(2, 136), 18, half(31))],
        radius: [Field::signed(on(2, 154), 18, half(6)), Field::signed(on(2, 172), 18, half(6))],
        inclination: [
            Field::signed(on(3, 85), 18, half(31)),
            Field::signed(on(3, 127), 18, half(31)),
        ],
        toc: Field::unsigned(61, 17, 8.0),
        clock: [
            Field::signed(173, 24, half(33)),
            Field::signed(197, 22, half(50)),
            Field::signed(162, 11, half(66)),
        ],
        behind: BEHIND,
    },
    pages: 3,
    step: 6,
    health: Field::count(38, 1),
    issues: [Field::count(39, 5), Field::count(219, 5)],
    accuracy: Field::count(44, 4),
    week: Field::count(48, 13),
    group_delays: [Field::signed(78, 10, DELAY), Field::signed(88, 10, DELAY)],
};

/// D2: geostationary satellites.
pub(super) const D2: Message = Message {
    kind: BroadcastKind::D2,
    layout: Layout {
        toe: Field::unsigned(on(7, 68), 17, 8.0),
        sqrt_a: Field::unsigned(on(6, 64), 32, half(19)),
        eccentricity: Field::unsigned(on(6, 42), 22, half(33)).behind(on(5, 96), 10),
        m0: Field::signed(on(5, 46), 32, semi(31)),
        delta_n: Field::signed(on(4, 76), 16, semi(43)),
        omega: Field::signed(on(10, 42), 5, semi(31)).behind(on(9, 79), 27),
        omega0: Field::signed(on(9, 47), 32, semi(31)),
        omega_dot: Field::signed(on(9, 42), 5, semi(43)).behind(on(8, 89), 19),
        i0: Field::signed(on(8, 42), 11, semi(31)).behind(on(7, 85), 21),
        i_dot: Field::signed(on(10, 47), 14, semi(43)),
        latitude: [
            Field::signed(on(5, 42), 4, half(31)).behind(on(4, 92), 14),
            Field::signed(on(5, 78), 18, half(31)),
        ],
        radius: [Field::signed(on(8, 53), 18, half(6)), Field::signed(on(8, 71), 18, half(6))],
        inclination: [
            Field::signed(on(7, 42), 8, half(31)).behind(on(6, 96), 10),
            Field::signed(on(7, 50), 18, half(31)),
        ],
        toc: Field::unsigned(65, 17, 8.0),
        clock: [
            Field::signed(on(3, 80), 24, half(33)),
            Field::signed(on(4, 42), 18, half(50)).behind(on(3, 104), 4),
            Field::signed(on(4, 60), 11, half(66)),
        ],
        behind: BEHIND,
    },
    pages: 10,
    step: 3,
    health: Field::count(42, 1),
    issues: [Field::count(43, 5), Field::count(on(4, 71), 5)],
    accuracy: Field::count(48, 4),
    week: Field::count(52, 13),
    group_delays: [Field::signed(82, 10, DELAY), Field::signed(92, 10, DELAY)],
};

/// Number and data of a subframe of D1, or of a page of subframe 1 of D2; other subframes of D2 have number 0.
pub(super) fn page(words: &[u32], kind: BroadcastKind) -> Result<(u8, Bits), WordsRefusal> {
    let bits = beidou_data(words)?;
    if PREAMBLE.raw(&bits) != 0b111_0001_0010 {
        return Err(WordsRefusal::Damaged);
    }
    let number = NUMBER.raw(&bits) as u8;
    Ok(match kind {
        BroadcastKind::D2 if number == 1 => (PAGE.raw(&bits) as u8, bits),
        BroadcastKind::D2 => (0, bits),
        _ => (number, bits),
    })
}

impl Message {
    /// Whether all subframes or pages are of one turn: each began when it should after the one before.
    fn is_of_one_turn(&self, bits: &Bits) -> bool {
        let started = |page: usize| bits.get((page - 1) * SIZE + 18, 20) as i64;
        let first = started(1);
        (2..=self.pages).all(|page| {
            let due = first + self.step * (page as i64 - 1);
            (started(page) - due).rem_euclid(604_800) == 0
        })
    }

    /// The record of all its subframes or pages; `None` while they are not of one turn.
    pub(super) fn record(
        &self,
        satellite: SatelliteId,
        bits: &Bits,
        received: GpsTime,
    ) -> Result<Option<KeplerRecord>, WordsRefusal> {
        if !self.is_of_one_turn(bits) {
            return Ok(None);
        }
        let week = FIRST_WEEK + self.week.raw(bits) as u16;
        let sent = (TIME.whole(bits) + BEHIND) * SECOND;
        let sent = GpsTime::from_week(week, sent).nearest_rollover(received);
        let [clock_issue, issue] = self.issues.map(|field| field.raw(bits) as u16);
        Ok(Some(KeplerRecord {
            satellite,
            kind: self.kind,
            issue,
            clock_issue,
            health: self.health.raw(bits) as u16,
            accuracy: range_accuracy(self.accuracy.whole(bits)),
            group_delays: self.group_delays.map(|field| field.value(bits)),
            orbit: self.layout.orbit(bits, sent).ok_or(WordsRefusal::Implausible)?,
            clock: self.layout.clock(bits, sent),
            transmitted: Some(sent),
        }))
    }

    /// The words of all subframes or pages that say a record.
    #[cfg(test)]
    pub(super) fn words(&self, record: &KeplerRecord) -> Vec<Vec<u32>> {
        let mut bits = Bits::zeros(self.pages * SIZE);
        let (week, time) = record.transmitted.unwrap_or(record.orbit.reference).to_week();
        self.layout.put(&mut bits, &record.orbit, &record.clock);
        self.week.put(&mut bits, (week - 1356) as f64);
        self.health.put(&mut bits, record.health.into());
        self.issues[0].put(&mut bits, record.clock_issue.into());
        self.issues[1].put(&mut bits, record.issue.into());
        let index = (0..16).find(|index| range_accuracy(*index) == record.accuracy);
        self.accuracy.put(&mut bits, index.unwrap_or(15) as f64);
        for (field, value) in self.group_delays.iter().zip(record.group_delays) {
            field.put(&mut bits, value);
        }
        let started = |page: usize| (time / SECOND - BEHIND + self.step * page as i64) as u64;
        let page = |page: usize| {
            let mut own = Bits::default();
            own.append(&bits, page * SIZE, SIZE);
            PREAMBLE.put_raw(&mut own, 0b111_0001_0010);
            TIME.put_raw(&mut own, started(page));
            let is_d1 = self.kind == BroadcastKind::D1;
            NUMBER.put_raw(&mut own, if is_d1 { page as u64 + 1 } else { 1 });
            if !is_d1 {
                PAGE.put_raw(&mut own, page as u64 + 1);
            }
            super::checks::beidou_words(&own)
        };
        (0..self.pages).map(page).collect()
    }
}
