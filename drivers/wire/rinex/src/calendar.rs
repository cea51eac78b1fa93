//! Dates and times of day of RINEX, and the time systems they are told in.

use insd_base::{GpsTime, UtcTime};

/// Nanoseconds of a second.
pub(crate) const SECOND: i64 = 1_000_000_000;

/// Seconds from 1970 to the start of GPS time, 1980-01-06, in a calendar without leap seconds.
const GPS_EPOCH: i64 = 315_964_800;

/// GPS time less BeiDou time, s (BDS-SIS-ICD-B1I 3.0, 3.3).
pub(crate) const BEIDOU_BEHIND: i64 = 14;

/// The system of the times in a file (RINEX 3.05, 4.2 and `TIME OF FIRST OBS` in table A2).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TimeSystem {
    /// GPS time, and with it those of Galileo, QZSS and NavIC, which RINEX counts alike.
    #[default]
    Gps,
    /// UTC, by which RINEX tells the times of GLONASS.
    Glonass,
    /// BeiDou time, 14 s behind GPS time.
    BeiDou,
}

/// A date and a time of day, not yet in any system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Civil {
    /// Year, month, day.
    pub(crate) date: (i32, u8, u8),
    /// Hour and minute.
    pub(crate) clock: (u8, u8),
    /// Nanoseconds of the minute, less than 61 s.
    pub(crate) nanos: i64,
}

impl Civil {
    /// From year, month, day, hour and minute as read, and nanoseconds of the minute.
    pub(crate) fn new(numbers: [i64; 5], nanos: i64) -> Option<Self> {
        let [year, month, day, hour, minute] = numbers;
        let small = |number: i64| u8::try_from(number).ok();
        let date = (i32::try_from(year).ok()?, small(month)?, small(day)?);
        let clock = (small(hour)?, small(minute)?);
        (0..61 * SECOND).contains(&nanos).then_some(Self { date, clock, nanos })
    }

    fn of_nanos_since_1970(nanos: i64) -> Self {
        let (date, of_day) = UtcTime::from_nanos(nanos).to_civil();
        let minutes = of_day / (60 * SECOND);
        // a day has 1440 minutes
        let part = |number: i64| u8::try_from(number).unwrap_or(0);
        Self {
            date,
            clock: (part(minutes / 60), part(minutes % 60)),
            nanos: of_day % (60 * SECOND),
        }
    }

    fn nanos_since_1970(self) -> Option<i64> {
        let start = UtcTime::from_civil(self.date, (self.clock.0, self.clock.1, 0), 0)?;
        start.as_nanos().checked_add(self.nanos)
    }
}

impl TimeSystem {
    /// The system of a name of `TIME OF FIRST OBS`.
    pub(crate) fn from_name(name: &[u8]) -> Option<Self> {
        match name {
            b"GPS" | b"GAL" | b"QZS" | b"IRN" | b"SBA" => Some(Self::Gps),
            b"GLO" | b"UTC" => Some(Self::Glonass),
            b"BDT" | b"BDS" => Some(Self::BeiDou),
            _ => None,
        }
    }

    /// An instant told in this system. `leap_seconds` is GPS - UTC as the file says; without, the table of this version counts.
    pub(crate) fn to_gps(self, civil: Civil, leap_seconds: Option<i8>) -> Option<GpsTime> {
        let since_1970 = civil.nanos_since_1970()?;
        let ahead = match (self, leap_seconds) {
            (Self::Gps, _) => 0,
            (Self::BeiDou, _) => BEIDOU_BEHIND,
            (Self::Glonass, Some(leaps)) => i64::from(leaps),
            (Self::Glonass, None) => return Some(UtcTime::from_nanos(since_1970).to_gps()),
        };
        since_1970.checked_sub((GPS_EPOCH - ahead) * SECOND).map(GpsTime::from_nanos)
    }

    /// How this system tells an instant.
    pub(crate) fn civil(self, instant: GpsTime, leap_seconds: Option<i8>) -> Civil {
        let behind = match self {
            Self::Gps => 0,
            Self::BeiDou => BEIDOU_BEHIND,
            Self::Glonass => {
                return Civil::of_nanos_since_1970(instant.to_utc(leap_seconds).as_nanos());
            }
        };
        let nanos = instant.as_nanos().saturating_add((GPS_EPOCH - behind) * SECOND);
        Civil::of_nanos_since_1970(nanos)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn civil(second: i64) -> Civil {
        Civil::new([2020, 6, 25, 0, 15], second * SECOND).unwrap()
    }

    #[test]
    fn systems_differ_by_leap_seconds_and_by_fourteen() {
        let gps = TimeSystem::Gps.to_gps(civil(0), Some(18)).unwrap();
        assert_eq!(gps, GpsTime::from_week(2111, (4 * 86_400 + 900) * SECOND));
        let seconds = |system: TimeSystem, leaps| {
            system.to_gps(civil(0), leaps).unwrap().since(gps).as_nanos() / SECOND
        };
        assert_eq!(seconds(TimeSystem::BeiDou, None), 14);
        assert_eq!(seconds(TimeSystem::Glonass, None), 18);
        assert_eq!(seconds(TimeSystem::Glonass, Some(17)), 17);
    }

    #[test]
    fn every_system_tells_back_what_it_was_told() {
        for system in [TimeSystem::Gps, TimeSystem::Glonass, TimeSystem::BeiDou] {
            for leaps in [None, Some(18)] {
                let instant = system.to_gps(civil(59), leaps).unwrap();
                assert_eq!(system.civil(instant, leaps), civil(59));
            }
        }
    }

    #[test]
    fn dates_that_do_not_exist_are_nothing() {
        assert_eq!(Civil::new([2020, 6, 25, 0, 15], 61 * SECOND), None);
        assert_eq!(Civil::new([2020, -6, 25, 0, 15], 0), None);
        let wrong = Civil::new([2021, 2, 29, 0, 0], 0).unwrap();
        assert_eq!(TimeSystem::Gps.to_gps(wrong, None), None);
        let far = Civil::new([9999, 1, 1, 0, 0], 0).unwrap();
        assert_eq!(TimeSystem::Gps.to_gps(far, None), None);
    }
}
