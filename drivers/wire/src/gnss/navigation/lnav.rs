//! LNAV of GPS and QZSS on L1 C/A (IS-GPS-200N, figure 20-1, tables 20-I to 20-III and 20-X): subframes 1 to 3, and page 18 of subframe 4.
//!
//! Positions count data bits, 24 of each word, parity taken out.

use insd_base::GpsTime;
use insd_base::satellites::{BroadcastKind, IonosphereModel, KeplerRecord, SatelliteId};

use super::super::bits::{Bits, Field};
use super::super::kepler::{Layout, SECOND, half, range_accuracy, semi};
use super::broadcast::WordsRefusal;
use super::checks::gps_data;
use super::leap::LeapLayout;

/// Data bits of a subframe.
pub(super) const SIZE: usize = 240;

const SECOND_FRAME: usize = SIZE;
const THIRD_FRAME: usize = 2 * SIZE;

const PREAMBLE: Field = Field::count(0, 8);
/// Start of the next subframe, units of 6 s.
const TIME: Field = Field::count(24, 17);
const NUMBER: Field = Field::count(43, 3);
const WEEK: Field = Field::count(48, 10);
const ACCURACY: Field = Field::count(60, 4);
const HEALTH: Field = Field::count(64, 6);
const IODC: Field = Field::count(168, 8).behind(70, 2);
const GROUP_DELAY: Field = Field::signed(160, 8, half(31));
const IODE: [Field; 2] = [Field::count(SECOND_FRAME + 48, 8), Field::count(THIRD_FRAME + 216, 8)];

const LAYOUT: Layout = Layout {
    toe: Field::unsigned(SECOND_FRAME + 216, 16, 16.0),
    sqrt_a: Field::unsigned(SECOND_FRAME + 184, 32, half(19)),
    eccentricity: Field::unsigned(SECOND_FRAME + 136, 32, half(33)),
    m0: Field::signed(SECOND_FRAME + 88, 32, semi(31)),
    delta_n: Field::signed(SECOND_FRAME + 72, 16, semi(43)),
    omega: Field::signed(THIRD_FRAME + 160, 32, semi(31)),
    omega0: Field::signed(THIRD_FRAME + 64, 32, semi(31)),
    omega_dot: Field::signed(THIRD_FRAME + 192, 24, semi(43)),
    i0: Field::signed(THIRD_FRAME + 112, 32, semi(31)),
    i_dot: Field::signed(THIRD_FRAME + 224, 14, semi(43)),
    latitude: [
        Field::signed(SECOND_FRAME + 120, 16, half(29)),
        Field::signed(SECOND_FRAME + 168, 16, half(29)),
    ],
    radius: [
        Field::signed(THIRD_FRAME + 144, 16, half(5)),
        Field::signed(SECOND_FRAME + 56, 16, half(5)),
    ],
    inclination: [
        Field::signed(THIRD_FRAME + 48, 16, half(29)),
        Field::signed(THIRD_FRAME + 96, 16, half(29)),
    ],
    toc: Field::unsigned(176, 16, 16.0),
    clock: [
        Field::signed(216, 22, half(31)),
        Field::signed(200, 16, half(43)),
        Field::signed(192, 8, half(55)),
    ],
    behind: 0,
};

/// Data id and page of subframe 4: 01 and 56 for page 18.
const PAGE: Field = Field::count(48, 8);
const PAGE_18: i64 = 0b01 << 6 | 56;

const ALPHA: [Field; 4] = [
    Field::signed(56, 8, half(30)),
    Field::signed(64, 8, half(27)),
    Field::signed(72, 8, half(24)),
    Field::signed(80, 8, half(24)),
];
const BETA: [Field; 4] = [
    Field::signed(88, 8, half(-11)),
    Field::signed(96, 8, half(-14)),
    Field::signed(104, 8, half(-16)),
    Field::signed(112, 8, half(-16)),
];
const LEAP: LeapLayout = LeapLayout {
    before: Field::signed(192, 8, 1.0),
    week: Field::count(200, 8),
    day: Field::count(208, 8),
    after: Field::signed(216, 8, 1.0),
};

/// Number and data of a subframe.
pub(super) fn page(words: &[u32]) -> Result<(u8, Bits), WordsRefusal> {
    let bits = gps_data(words)?;
    if PREAMBLE.whole(&bits) != 0x8B {
        return Err(WordsRefusal::Damaged);
    }
    Ok((NUMBER.raw(&bits) as u8, bits))
}

/// The record of subframes 1 to 3; `None` while they are of different issues.
pub(super) fn record(
    satellite: SatelliteId,
    bits: &Bits,
    received: GpsTime,
) -> Result<Option<KeplerRecord>, WordsRefusal> {
    let issue = IODE[0].raw(bits);
    let clock_issue = IODC.raw(bits);
    if issue != IODE[1].raw(bits) || issue != clock_issue & 0xFF {
        return Ok(None);
    }
    // the week is that of the subframe's own start, its time that of the next one
    let start = (TIME.whole(bits) * 6 - 6).rem_euclid(604_800);
    let start =
        GpsTime::from_week(WEEK.raw(bits) as u16, start * SECOND).nearest_rollover(received);
    let sent = GpsTime::from_nanos(start.as_nanos().saturating_add(6 * SECOND));
    Ok(Some(KeplerRecord {
        satellite,
        kind: BroadcastKind::Lnav,
        issue: issue as u16,
        clock_issue: clock_issue as u16,
        health: HEALTH.raw(bits) as u16,
        accuracy: range_accuracy(ACCURACY.whole(bits)),
        group_delays: [GROUP_DELAY.value(bits), 0.0],
        orbit: LAYOUT.orbit(bits, sent).ok_or(WordsRefusal::Implausible)?,
        clock: LAYOUT.clock(bits, sent),
        transmitted: Some(sent),
    }))
}

/// Ionosphere and leap seconds of page 18.
pub(super) fn page_18(bits: &Bits, now: GpsTime) -> Option<(IonosphereModel, Option<i8>)> {
    let is_18 = NUMBER.whole(bits) == 4 && PAGE.whole(bits) == PAGE_18;
    is_18.then(|| {
        let [alpha, beta] = [ALPHA, BETA].map(|fields| fields.map(|field| field.value(bits)));
        (IonosphereModel::Klobuchar { alpha, beta }, LEAP.leap_seconds(bits, now))
    })
}

/// The words of subframes 1 to 3 that say a record of GPS or QZSS, in the form of [`super::super::NavigationWords`].
#[must_use]
pub fn words(record: &KeplerRecord) -> [Vec<u32>; 3] {
    let mut bits = Bits::zeros(3 * SIZE);
    let (week, time) = record.transmitted.unwrap_or(record.orbit.reference).to_week();
    LAYOUT.put(&mut bits, &record.orbit, &record.clock);
    WEEK.put(&mut bits, (week % 1024) as f64);
    HEALTH.put(&mut bits, record.health.into());
    IODC.put(&mut bits, record.clock_issue.into());
    GROUP_DELAY.put(&mut bits, record.group_delays[0]);
    IODE.iter().for_each(|field| field.put(&mut bits, record.issue.into()));
    let index = (0..16).find(|index| range_accuracy(*index) == record.accuracy);
    ACCURACY.put(&mut bits, index.unwrap_or(15) as f64);
    [0, 1, 2].map(|frame| {
        let mut own = Bits::default();
        own.append(&bits, frame * SIZE, SIZE);
        PREAMBLE.put_raw(&mut own, 0x8B);
        TIME.put_raw(&mut own, (time / SECOND / 6) as u64 + frame as u64);
        NUMBER.put_raw(&mut own, frame as u64 + 1);
        super::checks::gps_words(&own)
    })
}

/// The words of page 18 of subframe 4: ionosphere, then leap seconds before a change, its week and day, and after it.
#[cfg(test)]
pub(super) fn page_18_words(alpha: [f64; 4], beta: [f64; 4], leap: [f64; 4]) -> Vec<u32> {
    let mut bits = Bits::zeros(SIZE);
    PREAMBLE.put_raw(&mut bits, 0x8B);
    NUMBER.put_raw(&mut bits, 4);
    PAGE.put_raw(&mut bits, PAGE_18 as u64);
    let fields = ALPHA.iter().zip(alpha).chain(BETA.iter().zip(beta));
    let leaps = [&LEAP.before, &LEAP.week, &LEAP.day, &LEAP.after];
    for (field, value) in fields.chain(leaps.into_iter().zip(leap)) {
        field.put(&mut bits, value);
    }
    super::checks::gps_words(&bits)
}
