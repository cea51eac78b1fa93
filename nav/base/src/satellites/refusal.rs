//! Why a satellite that a receiver hears tells no range.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Why a satellite has no orbit at an instant, or a record is not taken.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum OrbitRefusal {
    /// Nothing is known of the satellite.
    NoRecord,
    /// The nearest record refers to another time: seconds from the reference time, signed, and the limit.
    Stale {
        /// Since the reference time, s.
        age: f64,
        /// The most that holds, s.
        limit: f64,
    },
    /// The satellite says that it is not healthy.
    Unhealthy(u16),
    /// An element no orbit of this constellation can have.
    Implausible(&'static str),
}

impl fmt::Display for OrbitRefusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoRecord => write!(f, "no orbit known"),
            Self::Stale { age, limit } => {
                write!(
                    f,
                    "orbit {:.0} min from its reference time, at most {:.0}",
                    age / 60.0,
                    limit / 60.0
                )
            }
            Self::Unhealthy(health) => write!(f, "not healthy (0x{health:02X})"),
            Self::Implausible(what) => write!(f, "implausible record: {what}"),
        }
    }
}

/// Why a satellite of an epoch has no range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RangeRefusal {
    /// The receiver tells no code of it.
    NoCode,
    /// It has no orbit.
    NoOrbit(OrbitRefusal),
    /// Nobody knows where the antenna is.
    NoPlace,
    /// It stands too low.
    Low {
        /// The lowest elevation that is used, rad.
        lowest: f64,
    },
    /// Its record tells the delay of none of the bands that are received.
    NoDelay,
}

impl RangeRefusal {
    /// A short name for tables: `low`, `no_orbit`, ...
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::NoCode => "no_code",
            Self::NoOrbit(OrbitRefusal::NoRecord) => "no_orbit",
            Self::NoOrbit(OrbitRefusal::Stale { .. }) => "stale_orbit",
            Self::NoOrbit(OrbitRefusal::Unhealthy(_)) => "unhealthy",
            Self::NoOrbit(OrbitRefusal::Implausible(_)) => "implausible_orbit",
            Self::NoPlace => "no_place",
            Self::Low { .. } => "low",
            Self::NoDelay => "no_delay",
        }
    }
}

impl fmt::Display for RangeRefusal {
    /// The same in words.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoCode => write!(f, "no code is received"),
            Self::NoOrbit(refusal) => write!(f, "{refusal}"),
            Self::NoPlace => write!(f, "nobody knows yet where the antenna is"),
            Self::Low { lowest } => write!(f, "below {:.0} degrees", lowest.to_degrees()),
            Self::NoDelay => write!(f, "its record does not tell the delay of these signals"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_reason_has_a_name_for_tables_and_words_for_people() {
        let low = RangeRefusal::Low { lowest: 0.1745 };
        assert_eq!((low.as_str(), low.to_string().as_str()), ("low", "below 10 degrees"));
        let stale = RangeRefusal::NoOrbit(OrbitRefusal::Stale { age: 9000.0, limit: 7260.0 });
        assert_eq!(stale.as_str(), "stale_orbit");
        assert_eq!(stale.to_string(), "orbit 150 min from its reference time, at most 121");
    }
}
