//! Whether to believe the thermometer of an IMU.
//!
//! What it tells goes into every sample: a reading that no IMU can have reached since the one before is passed over, and if it stays
//! so, the thermometer tells from another zero, and what it tells is taken as going on from where it was.

use insd_base::{Span, Time};
use serde::{Deserialize, Serialize};

/// Temperatures that an IMU can have, degrees Celsius.
const POSSIBLE: std::ops::Range<f64> = -80.0..150.0;
/// Readings that are so near are of one kind, K, and an IMU may warm up as fast, K/s, for so long, s.
const NEAR: f64 = 3.0;
const FASTEST: f64 = 0.2;
const LONGEST: f64 = 600.0;
/// Readings of one kind that it takes to be believed at first, and after a leap.
const AT_FIRST: u32 = 5;
const AFTER_A_LEAP: u32 = 30;

/// One of them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Thermometer {
    felt: Option<(Time, f64)>,
    /// The last reading, believed or not.
    heard: Option<Time>,
    /// A reading that is not believed yet, and how many were like it.
    candidate: Option<(f64, u32)>,
    /// What is added to readings since it leapt, K.
    offset: f64,
}

impl Thermometer {
    /// The last temperature that was believed, degrees Celsius, and when.
    pub(crate) fn felt(&self) -> Option<(Time, f64)> {
        self.felt
    }

    /// Hears a reading, degrees Celsius.
    pub(crate) fn hear(&mut self, time: Time, reading: f64) {
        if !POSSIBLE.contains(&reading) {
            return;
        }
        let told = reading + self.offset;
        let apart = self.heard.replace(time).map_or(0.0, |last| (time - last).as_seconds());
        let Some((_, celsius)) = self.felt else {
            if self.counts_alike(told) >= AT_FIRST {
                self.believe(time, told);
            }
            return;
        };
        if (told - celsius).abs() <= NEAR + FASTEST * apart.clamp(0.0, LONGEST) {
            self.believe(time, told);
        } else if self.counts_alike(told) >= AFTER_A_LEAP {
            self.offset += celsius - told;
            self.believe(time, celsius);
        }
    }

    fn believe(&mut self, time: Time, told: f64) {
        self.felt = Some((time, told));
        self.candidate = None;
    }

    /// How many readings in succession were like this one, it among them.
    fn counts_alike(&mut self, told: f64) -> u32 {
        let before = self.candidate.filter(|(other, _)| (told - other).abs() <= NEAR);
        let count = before.map_or(1, |(_, count)| count + 1);
        self.candidate = Some((told, count));
        count
    }

    /// The same on a time line that is later by a span.
    pub(crate) fn shifted(&self, by: Span) -> Self {
        let felt = self.felt.map(|(time, celsius)| (time + by, celsius));
        Thermometer { felt, heard: self.heard.map(|time| time + by), ..self.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn heard(readings: impl IntoIterator<Item = f64>) -> Thermometer {
        let mut own = Thermometer::default();
        for (i, reading) in readings.into_iter().enumerate() {
            own.hear(Time::from_seconds(i as f64), reading);
        }
        own
    }

    #[test]
    fn a_reading_that_no_imu_can_have_reached_is_passed_over() {
        let own = heard([20.0, 20.1, 20.2, 20.3, 20.4, 127.0, -273.0, f64::NAN, 20.6]);
        assert_eq!(own.felt(), Some((Time::from_seconds(8.0), 20.6)));
    }

    #[test]
    fn a_first_reading_that_is_wrong_is_not_where_it_begins() {
        let own = heard([85.0, 20.0, 20.0, 20.0, 20.0]);
        assert_eq!(own.felt(), None);
        let own = heard([85.0, 20.0, 20.0, 20.0, 20.0, 20.1]);
        assert_eq!(own.felt(), Some((Time::from_seconds(5.0), 20.1)));
    }

    #[test]
    fn after_a_leap_that_stays_it_goes_on_from_where_it_was() {
        let warming = |i: usize| 25.0 + 0.01 * i as f64;
        let readings = (0..200).map(|i| if i < 100 { warming(i) } else { warming(i) - 60.0 });
        let own = heard(readings);
        let (_, celsius) = own.felt().unwrap();
        // what it warmed by while it was not believed is lost, and nothing else
        assert!((celsius - warming(199)).abs() < 0.35, "{celsius}");
    }

    #[test]
    fn an_imu_that_was_switched_off_for_long_may_come_back_cold() {
        let mut own = heard([40.0; 6]);
        own.hear(Time::from_seconds(4000.0), 12.0);
        assert_eq!(own.felt(), Some((Time::from_seconds(4000.0), 12.0)));
    }
}
