//! Time and date.

use insd_base::{Span, UtcTime};

use super::bits::{Number, Reader, TIME, Writer, place_of};
use super::{Group, Short, Sid, millis};

/// Where a time comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimeSource {
    /// GPS.
    Gps,
    /// GLONASS.
    Glonass,
    /// A radio station.
    RadioStation,
    /// A local caesium clock.
    LocalCesium,
    /// A local rubidium clock.
    LocalRubidium,
    /// A local crystal clock.
    LocalCrystal,
}

/// 129033 Time and date.
///
/// | bit | field |
/// |---:|---|
/// | 0 | date, u16, days |
/// | 16 | time, u32, 1e-4 s |
/// | 48 | local offset, i16, minutes |
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeDate {
    /// Days since 1970-01-01.
    pub date: Option<u16>,
    /// UTC, seconds of the day.
    pub time: Option<f64>,
    /// Local time minus UTC, minutes. Neither source of the layout tells the sign: not verified.
    pub local_offset: Option<i16>,
}

/// 126992 System time.
///
/// | bit | field |
/// |---:|---|
/// | 0 | SID, u8 |
/// | 8 | source, 4 bits: 0 GPS, 1 GLONASS, 2 radio, 3 caesium, 4 rubidium, 5 crystal |
/// | 12 | reserved, 4 bits |
/// | 16 | date, u16, days |
/// | 32 | time, u32, 1e-4 s |
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SystemTime {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Where it comes from.
    pub source: Option<TimeSource>,
    /// Days since 1970-01-01.
    pub date: Option<u16>,
    /// UTC, seconds of the day.
    pub time: Option<f64>,
}

/// Local offset, minutes.
const OFFSET: Number = Number::signed(16, 1.0);

impl TimeSource {
    /// By their codes.
    const LIST: [TimeSource; 6] = [
        TimeSource::Gps,
        TimeSource::Glonass,
        TimeSource::RadioStation,
        TimeSource::LocalCesium,
        TimeSource::LocalRubidium,
        TimeSource::LocalCrystal,
    ];
}

impl Group for TimeDate {
    const PGN: u32 = 129_033;
    const PRIORITY: u8 = 3;
    const INTERVAL: Option<Span> = millis(1000);

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut fields = Reader::new(data, 2)?;
        Ok(TimeDate {
            date: fields.short(16),
            time: fields.number(TIME),
            local_offset: fields.steps(OFFSET).map(|minutes| minutes as i16),
        })
    }

    fn write(&self) -> Vec<u8> {
        let mut fields = Writer::default();
        fields.short(16, self.date).number(TIME, self.time);
        fields.steps(OFFSET, self.local_offset.map(i64::from));
        fields.done()
    }
}

impl Group for SystemTime {
    const PGN: u32 = 126_992;
    const PRIORITY: u8 = 3;
    const INTERVAL: Option<Span> = millis(1000);

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut fields = Reader::new(data, 4)?;
        let sid = fields.byte();
        let source = fields.choice(4, &TimeSource::LIST, |_| None);
        fields.skip(4);
        Ok(SystemTime { sid, source, date: fields.short(16), time: fields.number(TIME) })
    }

    fn write(&self) -> Vec<u8> {
        let source = self.source.and_then(|source| place_of(&TimeSource::LIST, &source));
        let mut fields = Writer::default();
        fields.byte(self.sid).code(4, source).reserved(4);
        fields.short(16, self.date).number(TIME, self.time);
        fields.done()
    }
}

const DAY: i64 = 86_400;
const NANOS: f64 = 1e9;
/// Nanoseconds in the step of a time of the day.
const STEP: i64 = 100_000;
/// The last day that a date can tell.
const LAST_DAY: i64 = 65_532;

/// The instant of a date, days since 1970-01-01, and a time, seconds of the day; second 86400, a leap
/// second, is the first of the next day. `None` if either is unknown or out of the range of the wire.
#[must_use]
pub fn utc(date: Option<u16>, time: Option<f64>) -> Option<UtcTime> {
    let days = date.map(i64::from).filter(|days| *days <= LAST_DAY)?;
    let seconds = time.filter(|seconds| (0.0..86_401.0).contains(seconds))?;
    let midnight = UtcTime::from_nanos(days * DAY * NANOS as i64);
    Some(midnight.plus(Span::from_seconds(seconds)))
}

/// The days since 1970-01-01 and the seconds of the day of an instant, to the nearest 0.1 ms, which is
/// the step of the wire: so the seconds stay below 86400. `None` for instants that no date can tell:
/// before 1970, and after 2149.
#[must_use]
pub fn days_and_seconds(utc: UtcTime) -> Option<(u16, f64)> {
    let steps = (utc.as_nanos().checked_add(STEP / 2)?).div_euclid(STEP);
    let of_a_day = DAY * (NANOS as i64 / STEP);
    let days = steps.div_euclid(of_a_day);
    let date = u16::try_from(days).ok().filter(|_| days <= LAST_DAY)?;
    Some((date, steps.rem_euclid(of_a_day) as f64 * STEP as f64 / NANOS))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_instant_survives_as_days_and_seconds() {
        for date in [(1970, 1, 1), (2026, 11, 21), (2149, 6, 3)] {
            let instant = UtcTime::from_civil(date, (23, 59, 59), 999_900_000).unwrap();
            let (days, seconds) = days_and_seconds(instant).unwrap();
            assert_eq!(seconds, 86_399.999_9);
            assert_eq!(utc(Some(days), Some(seconds)), Some(instant));
        }
    }

    #[test]
    fn seconds_of_a_day_never_round_up_to_a_day() {
        let instant = UtcTime::from_civil((2026, 11, 21), (23, 59, 59), 999_960_000).unwrap();
        let (days, seconds) = days_and_seconds(instant).unwrap();
        assert_eq!(seconds, 0.0);
        assert_eq!(utc(Some(days), Some(0.0)), UtcTime::from_civil((2026, 11, 22), (0, 0, 0), 0));
    }

    #[test]
    fn instants_outside_of_the_calendar_of_the_wire_are_refused() {
        assert_eq!(days_and_seconds(UtcTime::from_nanos(-100_000)), None);
        assert_eq!(days_and_seconds(UtcTime::from_nanos(i64::MAX)), None);
        assert!(utc(Some(65_532), Some(86_400.5)).is_some());
        assert_eq!(utc(Some(65_533), Some(0.0)), None);
        assert_eq!(utc(Some(0), Some(86_401.0)), None);
        assert_eq!(utc(Some(0), Some(f64::NAN)), None);
        assert_eq!(utc(None, Some(0.0)), None);
        assert_eq!(utc(Some(0), None), None);
    }
}
