//! The temperature of an IMU: the mean of what it tells within a second.
//!
//! Formats tell it in steps of up to one kelvin, with every sample or with one of many; what follows it follows slowly.

use insd_base::{Span, Time};

/// Time that one mean is of.
const SECOND: Span = Span::from_nanos(1_000_000_000);
/// What no IMU survives is no temperature, degrees Celsius.
const SANE: std::ops::RangeInclusive<f64> = -80.0..=150.0;

/// What was told since the last mean.
#[derive(Clone, Copy, Debug, Default)]
pub struct Warmth {
    begun: Option<Time>,
    sum: f64,
    count: u32,
}

impl Warmth {
    /// Takes a temperature, degrees Celsius; tells the mean when a second is over.
    pub fn take(&mut self, now: Time, celsius: f64) -> Option<f64> {
        if !SANE.contains(&celsius) {
            return None;
        }
        let begun = *self.begun.get_or_insert(now);
        self.sum += celsius;
        self.count += 1;
        if now - begun < SECOND {
            return None;
        }
        let mean = self.sum / f64::from(self.count);
        *self = Warmth { begun: Some(now), ..Warmth::default() };
        Some(mean)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_of_a_second_is_told_once_and_nonsense_is_left_out() {
        let mut own = Warmth::default();
        let told: Vec<f64> = (0..=20)
            .filter_map(|i| {
                let celsius = if i % 2 == 0 { 30.0 } else { 31.0 };
                let now = Time::from_seconds(0.1 * f64::from(i));
                own.take(now, f64::NAN).or(own.take(now, 1e9)).or(own.take(now, celsius))
            })
            .collect();
        assert_eq!(told.len(), 2);
        assert!(told.iter().all(|mean| (mean - 30.5).abs() < 0.06), "{told:?}");
    }
}
