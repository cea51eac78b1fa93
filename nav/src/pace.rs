//! How fast the speed changes, ahead or athwart: what no craft of a kind can do is the IMU's doing.

use insd_base::Time;

/// Looks that the memory spans, and how far apart they are, s.
const SPAN: usize = 30;
const SPACING: f64 = 1.0;
/// How much more than what was seen may be real.
const BEYOND: f64 = 2.0;

/// The speed at the latest looks.
#[derive(Clone, Copy, Debug)]
pub struct PaceWatch {
    speeds: [f64; SPAN],
    count: usize,
    last: Option<Time>,
    /// The greatest change that was seen while somebody told the speed, m/s.
    seen: f64,
}

impl Default for PaceWatch {
    fn default() -> Self {
        PaceWatch { speeds: [0.0; SPAN], count: 0, last: None, seen: 0.0 }
    }
}

impl PaceWatch {
    /// Whether it is time to look.
    #[must_use]
    pub fn is_due(&self, now: Time) -> bool {
        self.last.is_none_or(|last| (now - last).as_seconds() >= SPACING)
    }

    /// Takes a speed, m/s; gives by how much it has changed within half a minute at the most, m/s.
    pub fn see(&mut self, now: Time, speed: f64) -> f64 {
        self.speeds[self.count % SPAN] = speed;
        self.count += 1;
        self.last = Some(now);
        let known = self.speeds.iter().take(self.count);
        known.map(|before| (speed - before).abs()).fold(0.0, f64::max)
    }

    /// A change was real, as somebody told the speed.
    pub fn learn(&mut self, change: f64) {
        self.seen = self.seen.max(change);
    }

    /// Beyond this no change is real, m/s: what no craft of the kind does, and this one has not nearly done.
    #[must_use]
    pub fn limit(&self, greatest: f64) -> f64 {
        greatest.max(BEYOND * self.seen)
    }

    /// Forgets what was before, but not what was real.
    pub fn restart(&mut self) {
        self.count = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_counts_for_half_a_minute() {
        let mut pace = PaceWatch::default();
        let changes: Vec<f64> = (0..70)
            .map(|second| {
                let speed = if second < 10 { 5.0 } else { 9.0 };
                pace.see(Time::from_seconds(f64::from(second)), speed)
            })
            .collect();
        assert_eq!((changes[9], changes[10], changes[38]), (0.0, 4.0, 4.0));
        assert_eq!(changes[60], 0.0);
        assert_eq!(pace.limit(10.0), 10.0);
        pace.learn(8.0);
        assert_eq!(pace.limit(10.0), 16.0);
    }
}
