//! When a message is due: on whole multiples of its period, in UTC as soon as it is known, so that messages
//! of one rate leave together, and with them those of every other box that keeps to UTC.

use insd_base::{Span, Time, UtcTime};

/// How often a message is sent, in times in 30000 s, so that boundaries are exact: those of whole hertz, and
/// those of 30 s.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Rate(u32);

/// The seconds of the unit, and their nanoseconds.
const UNIT: f64 = 30_000.0;
const LONGEST: i128 = 30_000_000_000_000;

/// A step back of the grid by more than this is another grid, not a correction.
const STEP: i64 = 1_000_000_000;

/// An epoch found to be older than this is skipped: what it would say is old.
const STALE: i64 = 200_000_000;

impl Rate {
    /// A rate from messages per second, to the nearest one in 30000 s and at least that. NaN and
    /// negative values give the lowest rate.
    #[must_use]
    pub fn from_hertz(hertz: f64) -> Self {
        Rate(((hertz * UNIT).round() as u32).max(1))
    }

    /// Messages per second.
    #[must_use]
    pub fn as_hertz(self) -> f64 {
        f64::from(self.0) / UNIT
    }

    /// Time from one message to the next.
    #[must_use]
    pub fn period(self) -> Span {
        Span::from_nanos((LONGEST / i128::from(self.0)) as i64)
    }

    /// The last boundary up to an instant of the grid, ns.
    fn last(self, grid: i64) -> i64 {
        self.boundary(self.interval(grid))
    }

    /// The first boundary after an instant of the grid, ns.
    fn next(self, grid: i64) -> i64 {
        self.boundary(self.interval(grid) + 1)
    }

    /// Whether an instant of the grid is one of its boundaries.
    pub(crate) fn is_on(self, grid: i64) -> bool {
        self.last(grid) == grid
    }

    fn interval(self, grid: i64) -> i128 {
        (i128::from(grid) * i128::from(self.0)).div_euclid(LONGEST)
    }

    /// The first whole nanosecond of an interval.
    fn boundary(self, interval: i128) -> i64 {
        let rate = i128::from(self.0);
        let up = (interval * LONGEST + rate - 1).div_euclid(rate);
        i64::try_from(up).unwrap_or(i64::MAX)
    }
}

/// An instant at which something is due.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Boundary {
    /// On the ship's time line.
    pub time: Time,
    /// In UTC, if it is known; then this is the exact boundary.
    pub utc: Option<UtcTime>,
}

impl Boundary {
    /// Its place on the grid, ns.
    pub(crate) fn grid(&self) -> i64 {
        self.utc.map_or(self.time.as_nanos(), UtcTime::as_nanos)
    }
}

/// When somebody wants to be woken, and why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WakeUp {
    /// On the ship's time line; it may have passed.
    pub at: Time,
    /// Why.
    pub why: Due,
}

/// What is due at an instant; of several things the first of these.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Due {
    /// Its place in UTC: that has become known or is lost, or nobody has looked yet.
    Grid,
    /// Messages of the port of this index.
    Messages(usize),
    /// A look at the groups of NMEA 2000.
    Groups,
    /// A look at alerts and at the distance run.
    Upkeep,
}

/// Tells when the next of several rates is due.
#[derive(Clone, Debug)]
pub struct Pacer {
    rates: Vec<(Rate, i64)>,
    is_utc: Option<bool>,
    skipped: u64,
}

impl Pacer {
    /// A pacer of these rates.
    #[must_use]
    pub fn new(rates: impl IntoIterator<Item = Rate>) -> Self {
        let mut rates: Vec<(Rate, i64)> = rates.into_iter().map(|rate| (rate, 0)).collect();
        rates.sort_unstable();
        rates.dedup();
        Pacer { rates, is_utc: None, skipped: 0 }
    }

    /// The next instant at which something is due, by what is known of UTC now, and of which rate; `None`
    /// without rates. At first, and when UTC becomes known or is lost, that is now, of no rate: the grid is
    /// to be found.
    #[must_use]
    pub fn next(&self, now: Time, utc: Option<UtcTime>) -> Option<(Time, Option<Rate>)> {
        let grid = Boundary { time: now, utc }.grid();
        let next = |(rate, last): &(Rate, i64)| {
            let is_behind = last.saturating_sub(grid) > STEP;
            (rate.next(if is_behind { grid } else { *last }), *rate)
        };
        let (next, rate) = self.rates.iter().map(next).min()?;
        let known = self.is_utc == Some(utc.is_some());
        let wait = Span::from_nanos(next.saturating_sub(grid));
        Some(if known { (now + wait, Some(rate)) } else { (now, None) })
    }

    /// What has become due up to now, the oldest first: of each rate its newest boundary, once.
    /// Boundaries that were missed for longer than 0.2 s are skipped and counted.
    pub fn due(&mut self, now: Time, utc: Option<UtcTime>) -> Vec<Boundary> {
        let grid = Boundary { time: now, utc }.grid();
        let known = self.is_utc.replace(utc.is_some()) == Some(utc.is_some());
        let mut due = Vec::new();
        for (rate, last) in &mut self.rates {
            let newest = rate.last(grid);
            let before = *last;
            let is_new = newest > before || before.saturating_sub(newest) > STEP;
            if !known || is_new {
                *last = newest;
            }
            if known && is_new {
                if grid.saturating_sub(newest) > STALE {
                    self.skipped += 1;
                } else {
                    due.push(newest);
                }
            }
        }
        due.sort_unstable();
        due.dedup();
        let at = |boundary: i64| Boundary {
            time: now + Span::from_nanos(boundary - grid),
            utc: utc.map(|_| UtcTime::from_nanos(boundary)),
        };
        due.into_iter().map(at).collect()
    }

    /// Boundaries that were skipped because nobody was awake.
    #[must_use]
    pub fn skipped(&self) -> u64 {
        self.skipped
    }
}

/// Remembers the interval of the last message of one kind.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Beat {
    last: Option<i64>,
}

impl Beat {
    /// Whether this epoch is the first one of an interval, so that messages of one rate leave
    /// together and a late or missing epoch does not shift the ones after it.
    pub(crate) fn is_due(&mut self, now: &Boundary, interval: Span) -> bool {
        let grid = now.grid();
        let length = interval.as_nanos().max(1);
        let number = |grid: i64| grid.div_euclid(length);
        let due = self.last.is_none_or(|last| {
            number(grid) > number(last) || last.saturating_sub(grid) > STEP.max(length)
        });
        if due {
            self.last = Some(grid);
        }
        due
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MILLISECOND: i64 = 1_000_000;

    fn at(ms: i64) -> Time {
        Time::from_nanos(ms * MILLISECOND)
    }

    /// UTC that is 300.25 ms ahead of a second of the time line.
    fn utc(time: Time) -> Option<UtcTime> {
        Some(UtcTime::from_nanos(1_000_000_000_300_250_000 + time.as_nanos()))
    }

    #[test]
    fn a_boundary_of_any_rate_is_found_again_as_one() {
        for hertz in [0.1, 1.0, 3.0, 7.0, 12.5, 50.0, 200.0, 333.333] {
            let rate = Rate::from_hertz(hertz);
            let mut grid = 1_795_000_000_123_456_789;
            for _ in 0..1000 {
                let next = rate.next(grid);
                assert!(next > grid && rate.is_on(next) && !rate.is_on(next + 1), "{hertz}");
                grid = next;
            }
        }
    }

    #[test]
    fn everything_is_due_on_whole_multiples_of_its_period_in_utc() {
        let mut pacer = Pacer::new([Rate::from_hertz(10.0), Rate::from_hertz(4.0)]);
        assert!(pacer.due(at(0), utc(at(0))).is_empty(), "the first look only finds where it is");
        let mut now = at(0);
        let mut found = Vec::new();
        for _ in 0..7 {
            now = pacer.next(now, utc(now)).unwrap().0;
            for boundary in pacer.due(now, utc(now)) {
                assert_eq!(boundary.time, now);
                found.push(boundary.grid() / MILLISECOND % 1000);
            }
        }
        assert_eq!(found, [400, 500, 600, 700, 750, 800, 900]);
    }

    #[test]
    fn whoever_waits_for_the_next_instant_sends_everything() {
        let mut pacer = Pacer::new([Rate::from_hertz(50.0)]);
        let mut now = at(3);
        let mut count = 0;
        while now < at(1000) {
            let known = (now > at(500)).then(|| utc(now)).flatten();
            now = pacer.next(now, known).unwrap().0.max(now);
            let known = (now > at(500)).then(|| utc(now)).flatten();
            count += pacer.due(now, known).len();
        }
        assert!((49..=50).contains(&count), "{count}");
    }

    #[test]
    fn what_is_due_every_30_s_is_due_on_the_half_minutes() {
        for hertz in [0.033_333, 1.0 / 30.0] {
            let rate = Rate::from_hertz(hertz);
            assert_eq!(rate.period(), Span::from_nanos(30_000 * MILLISECOND));
            let on = |seconds: i64| rate.is_on(seconds * 1000 * MILLISECOND);
            assert!(on(1_795_000_020) && on(1_795_000_050) && !on(1_795_000_051));
        }
    }

    #[test]
    fn who_wakes_late_sends_the_newest_of_each_rate_once() {
        let mut pacer = Pacer::new([Rate::from_hertz(10.0), Rate::from_hertz(1.0)]);
        pacer.due(at(950), None);
        let due: Vec<i64> = pacer.due(at(1130), None).iter().map(Boundary::grid).collect();
        assert_eq!(due, [1000 * MILLISECOND, 1100 * MILLISECOND]);
        assert!(pacer.due(at(1131), None).is_empty());
        assert_eq!(pacer.due(at(2350), None).len(), 1, "the second is too old");
        assert_eq!(pacer.skipped(), 1);
    }

    #[test]
    fn nothing_is_sent_twice_when_utc_is_corrected_or_becomes_known() {
        let mut pacer = Pacer::new([Rate::from_hertz(10.0)]);
        pacer.due(at(0), None);
        assert_eq!(pacer.due(at(100), None).len(), 1);
        assert!(pacer.due(at(110), utc(at(110))).is_empty());
        assert_eq!(pacer.due(at(200), utc(at(200))).len(), 1);
        // UTC back by 2 ms just after a boundary
        let back =
            |time: Time| utc(time).map(|utc| UtcTime::from_nanos(utc.as_nanos() - 2_000_000));
        assert!(pacer.due(at(201), back(at(201))).is_empty());
        let ten = Some(Rate::from_hertz(10.0));
        assert_eq!(pacer.next(at(201), back(at(201))), Some((Time::from_nanos(301_750_000), ten)));
    }
}
