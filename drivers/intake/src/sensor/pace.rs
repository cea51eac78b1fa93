//! Readings that tell no time of their own: whether one is fresh.
//!
//! Such a reading is timed by its receipt. After a line was held up, all that waited comes at once, and a
//! message that was sent twice comes right behind itself: neither is as old as its receipt says, and
//! neither is a further measurement. They come much sooner after the one before than the sensor usually
//! speaks.

use insd_base::Time;

/// Share of the usual interval that must have passed since the last fresh reading.
const SOONEST: f64 = 0.2;
/// Weight of a longer and of a shorter interval in the usual one, and by how much it counts as longer or
/// shorter at most. Of a sensor that tells each instant in two sentences the short intervals prevail.
const LONGER: f64 = 0.1;
const SHORTER: f64 = 0.5;
const FACTOR: f64 = 2.0;

/// How often a sensor speaks.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pace {
    last: Option<Time>,
    /// Usual interval, s.
    usual: Option<f64>,
}

impl Pace {
    /// Takes the receipt of a reading and says whether it is fresh.
    pub fn is_fresh(&mut self, received: Time) -> bool {
        let since = self.last.map(|last| (received - last).as_seconds());
        let soon = since.zip(self.usual).is_some_and(|(since, usual)| since < SOONEST * usual);
        if soon {
            return false;
        }
        self.last = Some(received);
        if let Some(since) = since {
            let usual = self.usual.unwrap_or(since);
            let counted = since.min(FACTOR * usual).max(usual / FACTOR);
            let weight = if counted > usual { LONGER } else { SHORTER };
            self.usual = Some(usual + (counted - usual) * weight);
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fresh(pace: &mut Pace, receipts: &[f64]) -> Vec<bool> {
        receipts.iter().map(|seconds| pace.is_fresh(Time::from_seconds(*seconds))).collect()
    }

    #[test]
    fn of_what_comes_at_once_the_first_counts() {
        let mut pace = Pace::default();
        assert_eq!(fresh(&mut pace, &[0.0, 1.0, 2.0, 3.0]), [true; 4]);
        let burst = [33.0, 33.001, 33.002, 33.003, 34.0, 34.0, 35.0];
        assert_eq!(fresh(&mut pace, &burst), [true, false, false, false, true, false, true]);
    }

    #[test]
    fn a_sensor_that_is_set_to_speak_more_often_is_heard_after_a_while() {
        let mut pace = Pace::default();
        fresh(&mut pace, &[0.0, 1.0, 2.0]);
        let often: Vec<f64> = (0..200).map(|k| 3.0 + f64::from(k) * 0.1).collect();
        let heard = fresh(&mut pace, &often);
        assert!(heard[100..].iter().all(|own| *own), "{heard:?}");
    }

    #[test]
    fn two_sentences_of_one_instant_go_on_as_they_began() {
        let mut pace = Pace::default();
        for k in 0..1000 {
            let seconds = f64::from(k);
            assert_eq!(fresh(&mut pace, &[seconds, seconds + 0.01]), [true; 2], "{k}");
        }
    }
}
