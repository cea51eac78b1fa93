//! The tie between a foreign clock and the computer's: offset and drift from times of receipt.
//!
//! A message can not arrive before it was made, so its receipt minus its time is the offset of the
//! clocks plus a delay that is never negative and now and then small. The least difference of every
//! second is taken as a measurement of the offset (the idea of the convex hull in the measurement of
//! network clocks: Zhang, Liu, Xia, Clock synchronization algorithms for network measurements, INFOCOM
//! 2002), and a Kalman filter of two states, offset and drift, smooths it. Edges of a pulse line are
//! late and early alike and are taken as they are.
//!
//! What leaves the map slews towards the filter's line, so that intervals between samples stay even.

use insd_base::Time;

/// Seconds of foreign time over which the least delay is sought.
const BIN: i64 = 1_000_000_000;
/// Receipts that come more rarely than this in such a time are gathered for up to the longest time: the
/// least of a single one is no least delay.
const MANY: u32 = 50;
const LONGEST_BIN: i64 = 10 * BIN;
/// The first one is over after this, if it has as many for its length: nothing is known of any sample until then.
const FIRST_BIN: i64 = BIN / 2;
/// Time over which the map slews to the filter's line, s.
const SLEW: f64 = 10.0;
/// The map never slews faster than this beside the drift.
const MAX_SLEW: f64 = 2e-4;
/// While the map is younger than this many bins it follows at once.
const YOUNG: u32 = 5;
/// An offset that is off by more than this is not drift: one of the clocks has stepped, s.
const STEP: f64 = 0.1;
/// Bins off by more than [`STEP`], all by the same, before the map believes the step. Bins that are off
/// by ever less are a line that was held up and delivers what has waited.
const PATIENCE: u32 = 3;
/// A message that is early by more than this, s, and by more than so many sigmas is no noise, as nothing
/// arrives before it was made: the map follows at once.
const EARLY: f64 = 5e-3;
const EARLY_SIGMAS: f64 = 6.0;
/// Random walk of the drift, 1/sqrt(s): a quartz in a ship's temperature.
const DRIFT_WALK: f64 = 3e-9;
/// Random walk of the offset, s/sqrt(s).
const OFFSET_WALK: f64 = 1e-7;
/// Least sigma of a bin, s.
const LEAST_SIGMA: f64 = 5e-6;
/// Sigma of a bin before any has been seen, s.
const FIRST_SIGMA: f64 = 1e-3;
/// Weight of a new bin in the mean square of the deviations.
const LEARNING: f64 = 0.05;

/// What kind of difference a map is fed with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Observed {
    /// Receipts: late by a delay that is never negative.
    Receipts,
    /// Edges: late and early alike.
    Edges,
}

/// What an observation changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MapChange {
    /// Nothing worth telling.
    Nothing,
    /// The map can be used from now on.
    Ready,
    /// One of the clocks stepped; the map was tied anew, by so many seconds.
    Stepped {
        /// New offset minus old one, s.
        by: f64,
    },
}

/// A map from a foreign clock, ns, to the computer's monotonic clock.
#[derive(Clone, Debug)]
pub struct ClockMap {
    observed: Observed,
    drift_std: f64,
    line: Option<Line>,
    bin: Option<Bin>,
    bins: u32,
    /// By how much the first of some bins in a row was off by more than a step, s, and how many have
    /// been off by the same.
    off: Option<(f64, u32)>,
    mean_square: f64,
}

/// The filter's line, and the one that is in use.
#[derive(Clone, Copy, Debug)]
struct Line {
    /// Foreign time of the state, ns.
    at: i64,
    /// Computer's time minus foreign time that the state counts from, ns.
    origin: i64,
    /// Offset beyond `origin`, s, and drift of the computer's clock against the foreign one.
    offset: f64,
    drift: f64,
    /// Covariance: offset, both, drift.
    p: [f64; 3],
    /// Offset in use at the foreign time `from`, s beyond `origin`, and its slope.
    used: f64,
    from: i64,
    slope: f64,
}

#[derive(Clone, Copy, Debug)]
struct Bin {
    start: i64,
    /// Foreign time and excess over the line of the least difference.
    at: i64,
    least: f64,
    /// Observations so far.
    count: u32,
}

impl ClockMap {
    /// A map that knows nothing. `drift_std`: what the foreign clock's rate may be off at first, ratio.
    #[must_use]
    pub fn new(observed: Observed, drift_std: f64) -> Self {
        ClockMap {
            observed,
            drift_std,
            line: None,
            bin: None,
            bins: 0,
            off: None,
            mean_square: FIRST_SIGMA * FIRST_SIGMA,
        }
    }

    /// Takes an observation: foreign time, ns, and the computer's time when it was seen.
    pub fn observe(&mut self, foreign: i64, seen: Time) -> MapChange {
        let Some(line) = self.line else {
            self.line = Some(Line::through(foreign, seen, self.drift_std));
            self.bin = Some(Bin { start: foreign, at: foreign, least: 0.0, count: 1 });
            return MapChange::Nothing;
        };
        let excess = line.excess(foreign, seen);
        if self.is_early(excess) {
            return self.follow(excess, foreign);
        }
        let full = self.bin.filter(|bin| self.is_full(bin, foreign));
        let change = full.map_or(MapChange::Nothing, |bin| self.close(&bin, foreign));
        let excess = if full.is_some() {
            self.line.map_or(excess, |line| line.excess(foreign, seen))
        } else {
            excess
        };
        match &mut self.bin {
            Some(bin) if full.is_none() => {
                bin.count = bin.count.saturating_add(1);
                if excess < bin.least {
                    (bin.at, bin.least) = (foreign, excess);
                }
            }
            bin => *bin = Some(Bin { start: foreign, at: foreign, least: excess, count: 1 }),
        }
        change
    }

    fn is_full(&self, bin: &Bin, foreign: i64) -> bool {
        let length = foreign.saturating_sub(bin.start).saturating_abs();
        let of_receipts = self.observed == Observed::Receipts;
        let few = of_receipts && self.bins >= YOUNG && bin.count < MANY;
        let is_soon = of_receipts && self.bins == 0 && 2 * bin.count >= MANY;
        length
            >= if few {
                LONGEST_BIN
            } else if is_soon {
                FIRST_BIN
            } else {
                BIN
            }
    }

    /// The computer's time of a foreign one; `None` before the first bin is full.
    #[must_use]
    pub fn map(&self, foreign: i64) -> Option<Time> {
        self.line.filter(|_| self.bins > 0).map(|line| line.time(foreign))
    }

    /// The foreign time, ns, of an instant of the computer's clock.
    #[must_use]
    pub fn inverse(&self, time: Time) -> Option<i64> {
        let line = self.line.filter(|_| self.bins > 0)?;
        let elapsed = time.as_nanos().saturating_sub(line.origin).saturating_sub(line.from);
        let span = (elapsed as f64 - line.used * 1e9) / (1.0 + line.slope);
        Some(line.from.saturating_add(span.round() as i64))
    }

    /// 1-sigma of the offset by the filter's own account, s; the least delay is not in it.
    #[must_use]
    pub fn sigma(&self) -> Option<f64> {
        let line = self.line.filter(|_| self.bins > 0)?;
        let behind = line.predicted(line.from) - line.used;
        Some(line.p[0].max(0.0).sqrt() + behind.abs())
    }

    /// Forgets the tie: the next observation ties the clocks anew.
    pub fn forget_offset(&mut self) {
        self.line = None;
        self.bin = None;
        self.bins = 0;
        self.off = None;
    }

    /// Whether an observation is too early for any noise.
    fn is_early(&self, excess: f64) -> bool {
        let limit = EARLY.max(EARLY_SIGMAS * self.mean_square.sqrt());
        self.observed == Observed::Receipts && self.bins > 0 && excess < -limit
    }

    /// Ties the clocks by an observation that is early.
    fn follow(&mut self, excess: f64, foreign: i64) -> MapChange {
        let Some(line) = &mut self.line else { return MapChange::Nothing };
        let measured = line.used_at(foreign) + excess;
        line.advance(foreign);
        let deviation = measured - line.offset;
        self.bin = Some(Bin { start: foreign, at: foreign, least: 0.0, count: 1 });
        self.step(deviation, foreign)
    }

    /// Moves the line; a step that is too great for drift is told.
    fn step(&mut self, by: f64, now: i64) -> MapChange {
        if let Some(line) = &mut self.line {
            line.step(by, now);
        }
        self.off = None;
        self.mean_square = FIRST_SIGMA * FIRST_SIGMA;
        if by.abs() > STEP { MapChange::Stepped { by } } else { MapChange::Nothing }
    }

    /// Enters the least difference of a full bin; `now` is the foreign time that has been reached.
    fn close(&mut self, bin: &Bin, now: i64) -> MapChange {
        let Some(line) = &mut self.line else { return MapChange::Nothing };
        let measured = line.used_at(bin.at) + bin.least;
        line.advance(bin.at);
        let deviation = measured - line.offset;
        let first = self.bins == 0;
        let sigma = self.mean_square.sqrt().max(LEAST_SIGMA);
        if deviation.abs() > STEP && !first {
            let again = self.off.filter(|(by, _)| (deviation - by).abs() < STEP);
            let (by, count) = again.map_or((deviation, 1), |(by, count)| (by, count + 1));
            self.off = Some((by, count));
            if count < PATIENCE {
                line.slew(now, false);
                return MapChange::Nothing;
            }
            return self.step(deviation, now);
        }
        self.off = None;
        let late = self.observed == Observed::Receipts && deviation > 3.0 * sigma && !first;
        // a late bin says little: its weight falls with the square of its lateness
        let assumed = if late { deviation } else { sigma };
        line.update(deviation, assumed * assumed);
        if !late {
            self.mean_square += (deviation * deviation - self.mean_square) * LEARNING;
        }
        self.bins = self.bins.saturating_add(1);
        line.slew(now, self.bins < YOUNG);
        if first { MapChange::Ready } else { MapChange::Nothing }
    }
}

impl Line {
    fn through(foreign: i64, seen: Time, drift_std: f64) -> Self {
        Line {
            at: foreign,
            origin: seen.as_nanos().saturating_sub(foreign),
            offset: 0.0,
            drift: 0.0,
            p: [0.1 * 0.1, 0.0, drift_std * drift_std],
            used: 0.0,
            from: foreign,
            slope: 0.0,
        }
    }

    /// Offset in use at a foreign time, s beyond the origin.
    fn used_at(&self, foreign: i64) -> f64 {
        self.used + self.slope * seconds(foreign, self.from)
    }

    /// How much later than the line in use an observation was seen, s.
    fn excess(&self, foreign: i64, seen: Time) -> f64 {
        let difference = seen.as_nanos().saturating_sub(foreign).saturating_sub(self.origin);
        difference as f64 * 1e-9 - self.used_at(foreign)
    }

    fn time(&self, foreign: i64) -> Time {
        let offset = (self.used_at(foreign) * 1e9).round() as i64;
        Time::from_nanos(foreign.saturating_add(self.origin).saturating_add(offset))
    }

    /// Offset by the filter at a foreign time, s beyond the origin.
    fn predicted(&self, foreign: i64) -> f64 {
        self.offset + self.drift * seconds(foreign, self.at)
    }

    /// Moves state and covariance to a foreign time.
    fn advance(&mut self, foreign: i64) {
        let dt = seconds(foreign, self.at);
        self.offset += self.drift * dt;
        let [offset, both, drift] = self.p;
        let (walk, length) = (DRIFT_WALK * DRIFT_WALK, dt.abs());
        self.p = [
            offset
                + 2.0 * dt * both
                + dt * dt * drift
                + OFFSET_WALK * OFFSET_WALK * length
                + walk * length.powi(3) / 3.0,
            both + dt * drift + 0.5 * walk * length * dt,
            drift + walk * length,
        ];
        self.at = foreign;
    }

    fn update(&mut self, deviation: f64, variance: f64) {
        let [offset, both, drift] = self.p;
        let total = offset + variance;
        let (k0, k1) = (offset / total, both / total);
        self.offset += k0 * deviation;
        self.drift += k1 * deviation;
        self.p = [offset * variance / total, both * variance / total, drift - k1 * both];
    }

    /// Sends the line in use towards the filter's, from a foreign time on.
    fn slew(&mut self, now: i64, at_once: bool) {
        let target = self.predicted(now);
        self.used = if at_once { target } else { self.used_at(now) };
        self.from = now;
        let towards = ((target - self.used) / SLEW).clamp(-MAX_SLEW, MAX_SLEW);
        self.slope = self.drift + towards;
    }

    fn step(&mut self, by: f64, now: i64) {
        self.offset += by;
        self.p = [FIRST_SIGMA * FIRST_SIGMA, 0.0, self.p[2]];
        self.slew(now, true);
    }
}

fn seconds(later: i64, earlier: i64) -> f64 {
    later.saturating_sub(earlier) as f64 * 1e-9
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Observations each `period` s of a foreign clock that runs fast by `drift`, late by `delay(k)`.
    fn fed(
        map: &mut ClockMap,
        from: i64,
        count: i64,
        period: f64,
        drift: f64,
        delay: impl Fn(i64) -> f64,
    ) -> Vec<(i64, f64)> {
        let mut errors = Vec::new();
        for k in from..from + count {
            let true_time = k as f64 * period;
            let foreign = (true_time * (1.0 + drift) * 1e9).round() as i64 + 7_000_000_000_000;
            map.observe(foreign, Time::from_seconds(100.0 + true_time + delay(k)));
            if let Some(time) = map.map(foreign) {
                errors.push((k, time.as_seconds() - 100.0 - true_time));
            }
        }
        errors
    }

    /// A made-up delay: 30 us at least, 2 ms now and then.
    fn jitter(k: i64) -> f64 {
        let scrambled = (k.wrapping_mul(2_654_435_761) >> 7).rem_euclid(1000) as f64 / 1000.0;
        30e-6 + 2e-3 * scrambled.powi(4)
    }

    #[test]
    fn offset_and_drift_are_found_through_jitter() {
        let mut map = ClockMap::new(Observed::Receipts, 1e-3);
        let errors = fed(&mut map, 0, 60_000, 0.01, 40e-6, jitter);
        assert!(errors[0].1.abs() < 1e-3, "{:?}", errors[0]);
        let late = errors.iter().filter(|(k, _)| *k > 12_000);
        let worst = late.map(|(_, error)| (error - 30e-6).abs()).fold(0.0, f64::max);
        assert!(worst < 30e-6, "{worst}");
        let drift = map.line.unwrap().drift;
        assert!((drift + 40e-6).abs() < 0.2e-6, "{drift}");
    }

    #[test]
    fn intervals_between_samples_stay_even() {
        let mut map = ClockMap::new(Observed::Receipts, 1e-3);
        let errors = fed(&mut map, 0, 30_000, 0.01, 40e-6, jitter);
        let settled = errors.iter().skip(1000).map(|(_, error)| *error).collect::<Vec<_>>();
        let uneven = settled.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
        assert!(uneven < 3e-6, "{uneven}");
    }

    #[test]
    fn late_messages_do_not_pull_the_line_and_a_step_is_followed_and_told() {
        let mut map = ClockMap::new(Observed::Receipts, 1e-4);
        fed(&mut map, 0, 20_000, 0.01, 0.0, jitter);
        let stalled = fed(&mut map, 20_000, 1_000, 0.01, 0.0, |k| jitter(k) + 0.05);
        assert!(stalled.iter().all(|(_, error)| error.abs() < 5e-3));
        let mut told = Vec::new();
        for k in 21_000..22_000_i64 {
            let foreign = k * 10_000_000 + 7_000_000_000_000 - 60_000_000_000;
            let seen = Time::from_seconds(100.0 + k as f64 * 0.01 + jitter(k));
            if let MapChange::Stepped { by } = map.observe(foreign, seen) {
                told.push(by);
            }
        }
        assert!(told.len() == 1 && (told[0] - 60.0).abs() < 0.02, "{told:?}");
    }

    #[test]
    fn a_line_that_was_held_up_and_delivers_what_waited_is_no_step() {
        let mut map = ClockMap::new(Observed::Receipts, 1e-4);
        fed(&mut map, 0, 5_000, 0.01, 0.0, jitter);
        let at_once = |k: i64| (8_000 - k) as f64 * 0.01 + jitter(k);
        let held_up = fed(&mut map, 5_000, 3_000, 0.01, 0.0, at_once);
        let after = fed(&mut map, 8_000, 1_000, 0.01, 0.0, jitter);
        let worst = held_up.iter().chain(&after).map(|(_, error)| error.abs()).fold(0.0, f64::max);
        assert!(worst < 2e-4, "{worst}");
    }

    #[test]
    fn a_message_that_is_early_is_followed_at_once() {
        let mut map = ClockMap::new(Observed::Receipts, 1e-4);
        fed(&mut map, 0, 5_000, 0.01, 0.0, jitter);
        let early = fed(&mut map, 5_000, 1_000, 0.01, 0.0, |k| jitter(k) - 0.02);
        let worst = early.iter().map(|(_, error)| (error + 0.02).abs()).fold(0.0, f64::max);
        assert!(worst < 2.1e-3, "{worst}");
    }

    #[test]
    fn a_receiver_of_one_message_a_second_is_read_through_its_jitter() {
        let mut map = ClockMap::new(Observed::Receipts, 1e-4);
        let late = |k: i64| 10.0 * jitter(k);
        let errors = fed(&mut map, 0, 900, 1.0, 5e-6, late);
        let settled = errors.iter().filter(|(k, _)| *k > 120);
        let worst = settled.map(|(_, error)| (error - 300e-6).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-3, "{worst}");
    }

    #[test]
    fn the_inverse_takes_back() {
        let mut map = ClockMap::new(Observed::Receipts, 1e-4);
        assert_eq!(map.map(0), None);
        fed(&mut map, 0, 5_000, 0.01, 20e-6, jitter);
        for foreign in [7_010_000_000_000_i64, 7_050_123_456_789, 7_055_000_000_001] {
            let time = map.map(foreign).unwrap();
            assert!((map.inverse(time).unwrap() - foreign).abs() <= 2);
        }
    }
}
