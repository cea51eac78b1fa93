//! Records of Keplerian elements (RINEX 2.11, table A4; RINEX 3.05, tables A5 GPS, A8 Galileo, A11 QZSS, A12 BeiDou, A15 NavIC).
//!
//! All five lay out orbit and clock alike. They differ in the lines for the week, the accuracy and the health.

use insd_base::satellites::{ClockPolynomial, KeplerOrbit, KeplerRecord, MessageKind};
use insd_base::{Constellation, GpsTime};

use crate::calendar::{BEIDOU_BEHIND, SECOND, TimeSystem};
use crate::error::Flaw;
use crate::navigation::entry::{Entry, push_date, push_numbers};

/// Field, name, and place in the orbit.
type Element = (usize, &'static str, fn(&mut KeplerOrbit) -> &mut f64);

/// The elements by the indices of their fields, for the reader and for the writer.
const ELEMENTS: [Element; 15] = [
    (4, "Crs", |orbit| &mut orbit.crs),
    (5, "Delta n", |orbit| &mut orbit.delta_n),
    (6, "M0", |orbit| &mut orbit.m0),
    (7, "Cuc", |orbit| &mut orbit.cuc),
    (8, "e", |orbit| &mut orbit.eccentricity),
    (9, "Cus", |orbit| &mut orbit.cus),
    (10, "sqrt(A)", |orbit| &mut orbit.sqrt_a),
    (12, "Cic", |orbit| &mut orbit.cic),
    (13, "OMEGA0", |orbit| &mut orbit.omega0),
    (14, "Cis", |orbit| &mut orbit.cis),
    (15, "i0", |orbit| &mut orbit.i0),
    (16, "Crc", |orbit| &mut orbit.crc),
    (17, "omega", |orbit| &mut orbit.omega),
    (18, "OMEGA DOT", |orbit| &mut orbit.omega_dot),
    (19, "IDOT", |orbit| &mut orbit.i_dot),
];

const ISSUE: usize = 3;
const TOE: usize = 11;
/// Galileo: the data sources.
const SOURCES: usize = 20;
const WEEK: usize = 21;
const ACCURACY: usize = 23;
const HEALTH: usize = 24;
const DELAY: usize = 25;
/// Galileo and BeiDou: their second delay; GPS and QZSS: the issue of the clock.
const DELAY_OR_ISSUE: usize = 26;
const TRANSMITTED: usize = 27;
/// BeiDou: the issue of the clock; GPS and QZSS: the fit interval.
const CLOCK_ISSUE: usize = 28;
const FIELDS: usize = 29;

/// Bits of Galileo's data sources (RINEX 3.05, table A8): navigation data of E1-B, E5a-I and E5b-I; clock of E1 and E5a, of E1 and E5b.
const E1_B: u16 = 1;
const E5A_I: u16 = 1 << 1;
const E5B_I: u16 = 1 << 2;
const CLOCK_E5A: u16 = 1 << 8;
const CLOCK_E5B: u16 = 1 << 9;

/// An accuracy of 8192 m is that of index 15: no prediction (IS-GPS-200N, 20.3.3.3.1.3).
const NO_PREDICTION: f64 = 8192.0;

const DAY: i64 = 86_400;

fn system(constellation: Constellation) -> TimeSystem {
    if constellation == Constellation::BeiDou { TimeSystem::BeiDou } else { TimeSystem::Gps }
}

/// Start of the system's week in which an instant lies, by GPS time, and the week's number.
fn week_of(constellation: Constellation, instant: GpsTime) -> (i64, i64) {
    let behind = if constellation == Constellation::BeiDou { BEIDOU_BEHIND * SECOND } else { 0 };
    let (week, _) = GpsTime::from_nanos(instant.as_nanos().saturating_sub(behind)).to_week();
    let start = week * 7 * DAY * SECOND + behind;
    let first = if constellation == Constellation::BeiDou { BEIDOU_WEEKS } else { 0 };
    (start, week - first)
}

/// GPS weeks before the first of BeiDou (BDS-SIS-ICD-B1I 3.0, 3.3).
const BEIDOU_WEEKS: i64 = 1356;

/// Reads a record.
pub(crate) fn read(entry: &Entry<'_>) -> Result<KeplerRecord, Flaw> {
    let constellation = entry.satellite.constellation;
    let clock = ClockPolynomial {
        reference: entry.date(system(constellation))?,
        a0: entry.required(0, "clock bias", 0)?,
        a1: entry.required(1, "clock drift", 0)?,
        a2: entry.required(2, "clock drift rate", 0)?,
    };
    let issue = entry.count(ISSUE, "issue of data")?;
    let (delays, clock_issue) = delays(entry, issue)?;
    let reference = of_week(entry, clock.reference, TOE, "toe")?;
    let reference = reference.ok_or_else(|| entry.flaw(TOE, "toe", "seconds of the week"))?;
    let accuracy = entry.known(ACCURACY, "accuracy")?;
    Ok(KeplerRecord {
        satellite: entry.satellite,
        kind: kind(entry)?,
        issue,
        clock_issue,
        health: entry.count(HEALTH, "health")?,
        accuracy: accuracy.filter(|accuracy| (0.0..NO_PREDICTION).contains(accuracy)),
        group_delays: delays,
        orbit: orbit(entry, reference)?,
        clock,
        transmitted: of_week(entry, reference, TRANSMITTED, "transmission time")?,
    })
}

fn orbit(entry: &Entry<'_>, reference: GpsTime) -> Result<KeplerOrbit, Flaw> {
    let mut orbit = nothing(reference);
    for (index, name, place) in ELEMENTS {
        *place(&mut orbit) = entry.required(index, name, 0)?;
    }
    if !(0.0..1.0).contains(&orbit.eccentricity) {
        return Err(entry.flaw(8, "e", "an eccentricity of 0 to 1"));
    }
    if orbit.sqrt_a <= 0.0 {
        return Err(entry.flaw(10, "sqrt(A)", "a positive number"));
    }
    Ok(orbit)
}

fn nothing(reference: GpsTime) -> KeplerOrbit {
    KeplerOrbit {
        reference,
        sqrt_a: 0.0,
        eccentricity: 0.0,
        m0: 0.0,
        delta_n: 0.0,
        omega: 0.0,
        omega0: 0.0,
        omega_dot: 0.0,
        i0: 0.0,
        i_dot: 0.0,
        cuc: 0.0,
        cus: 0.0,
        crc: 0.0,
        crs: 0.0,
        cic: 0.0,
        cis: 0.0,
    }
}

/// Seconds of the record's week as an instant. Which week a file means is told by the field only where its writer was
/// careful: it may be that of the transmission, or Galileo's own count. The orbit is never half a week from its
/// clock, nor the transmission from the orbit, so that the nearest such second is the one that is meant.
fn of_week(
    entry: &Entry<'_>,
    near: GpsTime,
    index: usize,
    name: &'static str,
) -> Result<Option<GpsTime>, Flaw> {
    let Some(seconds) = entry.known(index, name)? else { return Ok(None) };
    if seconds.abs() > 1e6 {
        return Err(entry.flaw(index, name, "seconds of a week"));
    }
    // thirteen digits leave seven decimals: whole nanoseconds after rounding
    let nanos = (seconds * 1e9).round() as i64;
    let (start, _) = week_of(entry.satellite.constellation, near);
    Ok(Some(near.nearest_with_tow(start + nanos)))
}

/// The group delays and the issue of the clock.
fn delays(entry: &Entry<'_>, issue: u16) -> Result<([f64; 2], u16), Flaw> {
    use Constellation as C;
    let first = entry.required(DELAY, "group delay", 0)?;
    // F/NAV has one delay only
    let second =
        || Ok::<f64, Flaw>(entry.optional(DELAY_OR_ISSUE, "group delay", 0)?.unwrap_or(0.0));
    let issue_at = |index| match entry.known(index, "issue of clock")? {
        Some(_) => entry.count(index, "issue of clock"),
        None => Ok(issue),
    };
    Ok(match entry.satellite.constellation {
        C::Galileo => ([first, second()?], issue),
        C::BeiDou => ([first, entry.required(DELAY_OR_ISSUE, "TGD2", 0)?], issue_at(CLOCK_ISSUE)?),
        C::Gps | C::Qzss => ([first, 0.0], issue_at(DELAY_OR_ISSUE)?),
        C::Glonass | C::Navic | C::Sbas => ([first, 0.0], issue),
    })
}

/// The message: of Galileo by its data sources, of BeiDou by the orbit.
fn kind(entry: &Entry<'_>) -> Result<MessageKind, Flaw> {
    match entry.satellite.constellation {
        Constellation::Galileo => {
            let sources: u16 = entry.count(SOURCES, "data sources")?;
            if sources & (E1_B | E5B_I) != 0 {
                Ok(MessageKind::Inav)
            } else if sources & E5A_I != 0 {
                Ok(MessageKind::Fnav)
            } else {
                Err(entry.flaw(SOURCES, "data sources", "one of bits 0, 1 and 2"))
            }
        }
        Constellation::BeiDou if entry.satellite.is_geostationary() => Ok(MessageKind::D2),
        Constellation::BeiDou => Ok(MessageKind::D1),
        _ => Ok(MessageKind::Lnav),
    }
}

/// Writes a record.
pub(crate) fn push(out: &mut String, record: &KeplerRecord) {
    let constellation = record.satellite.constellation;
    let civil = system(constellation).civil(record.clock.reference, None);
    push_date(out, record.satellite, civil);
    let mut fields = [None; FIELDS];
    let ClockPolynomial { a0, a1, a2, .. } = record.clock;
    (fields[0], fields[1], fields[2]) = (Some(a0), Some(a1), Some(a2));
    let mut orbit = record.orbit;
    for (index, _, place) in ELEMENTS {
        fields[index] = Some(*place(&mut orbit));
    }
    let (start, week) = week_of(constellation, record.orbit.reference);
    // within hours of the week, so that f64 holds its nanoseconds
    let of_week = |instant: GpsTime| instant.as_nanos().saturating_sub(start) as f64 / 1e9;
    fields[ISSUE] = Some(f64::from(record.issue));
    fields[TOE] = Some(of_week(record.orbit.reference));
    fields[WEEK] = Some(week as f64);
    fields[HEALTH] = Some(f64::from(record.health));
    fields[DELAY] = Some(record.group_delays[0]);
    fields[TRANSMITTED] = record.transmitted.map(of_week);
    push_own(&mut fields, record);
    push_numbers(out, &fields.map(|field| (field, 0)));
}

/// The fields that mean something else in each constellation.
fn push_own(fields: &mut [Option<f64>; FIELDS], record: &KeplerRecord) {
    let clock_issue = Some(f64::from(record.clock_issue));
    let mut none = NO_PREDICTION;
    match record.satellite.constellation {
        Constellation::Galileo => {
            let sources = match record.kind {
                MessageKind::Fnav => E5A_I | CLOCK_E5A,
                _ => E1_B | E5B_I | CLOCK_E5B,
            };
            fields[SOURCES] = Some(f64::from(sources));
            fields[DELAY_OR_ISSUE] = Some(record.group_delays[1]);
            // RINEX 3.05, table A8: unknown is -1
            none = -1.0;
        }
        Constellation::BeiDou => {
            fields[DELAY_OR_ISSUE] = Some(record.group_delays[1]);
            fields[CLOCK_ISSUE] = clock_issue;
        }
        Constellation::Gps | Constellation::Qzss => fields[DELAY_OR_ISSUE] = clock_issue,
        Constellation::Glonass | Constellation::Navic | Constellation::Sbas => {}
    }
    fields[ACCURACY] = Some(record.accuracy.unwrap_or(none));
}
