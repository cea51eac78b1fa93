//! Which second a pulse marks: its label.
//!
//! A pulse says when a second begins, not which. The first message with a whole second that comes after
//! a pulse and before the next one names it (gpsd's rule), or a message that announces the next pulse
//! (UBX TIM-TP). Three labels in a row that fit the pulses' spacing lock; from then on a pulse is
//! labelled by the clock itself, and messages only check.

use insd_base::{GpsTime, Pulse, Time};

/// Labels in a row before the pulses are believed.
const CONFIRM: u32 = 3;
/// A pulse farther from where it is expected is not the second's, s.
const GATE: f64 = 1e-3;
/// Spacing of labelled pulses may be off by this before the lock, s.
const SPACING: f64 = 5e-3;
/// A message names the pulse before it up to this long after it, s.
const REACH: f64 = 0.95;
/// Pulses or labels in a row that do not fit before the lock is given up.
const PATIENCE: u32 = 5;
/// After this time without a pulse it is told as lost, s.
const LOST: f64 = 2.5;

const SECOND: i64 = 1_000_000_000;

/// A pulse with its second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Labelled {
    /// The second that it marks.
    pub gps: GpsTime,
    /// When it was, on the computer's clock.
    pub time: Time,
}

/// What is wrong with the pulses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PulseFault {
    /// One came at another time than the second: late, early or twice.
    Off {
        /// By how much, s.
        by: f64,
    },
    /// None has come for a while.
    Lost,
    /// Their labels do not fit the messages any more, or they moved; they are labelled anew.
    Unlocked,
}

/// The pulses of a line.
#[derive(Clone, Debug, Default)]
pub struct Pulses {
    last: Option<Pulse>,
    /// When the last edge was, good or not.
    seen: Option<Time>,
    candidate: Option<Labelled>,
    announced: Option<GpsTime>,
    named: bool,
    confirmed: u32,
    misfits: u32,
    lost: bool,
}

impl Pulses {
    /// Takes an edge; `expected` is the time of that instant by the clock that former pulses made.
    ///
    /// # Errors
    /// A [`PulseFault`]: the edge is not used.
    pub fn edge(
        &mut self,
        pulse: Pulse,
        expected: Option<GpsTime>,
    ) -> Result<Option<Labelled>, PulseFault> {
        self.lost = false;
        self.seen = Some(pulse.time);
        let label = self.announced.take();
        if let (true, Some(expected)) = (self.is_locked(), expected) {
            return self.locked_edge(pulse, expected);
        }
        self.last = Some(pulse);
        self.named = false;
        Ok(label.and_then(|gps| self.name(gps, pulse.time)))
    }

    /// A message of a receiver: its epoch and when it was received; `own` is the time of the last pulse
    /// by the clock that former pulses made. Gives the labelled pulse once the labels are believed and
    /// until there is such a clock.
    ///
    /// # Errors
    /// [`PulseFault::Unlocked`].
    pub fn message(
        &mut self,
        epoch: GpsTime,
        received: Time,
        own: Option<GpsTime>,
    ) -> Result<Option<Labelled>, PulseFault> {
        let Some(pulse) = self.last else { return Ok(None) };
        let since = (received - pulse.time).as_seconds();
        let names = epoch.as_nanos() % SECOND == 0 && since > 0.0 && since < REACH && !self.named;
        if !names {
            return Ok(None);
        }
        self.named = true;
        match own.map(whole).filter(|_| self.is_locked()) {
            // until the clock that labels the pulses runs, messages name each of them
            None => Ok(self.name(epoch, pulse.time)),
            Some(own) if own != epoch => self.misfit().map_or(Ok(None), Err),
            Some(_) => Ok(None),
        }
    }

    /// A message that names the next pulse.
    pub fn announce(&mut self, next: GpsTime) {
        self.announced = Some(next);
    }

    /// Time passes: tells once when the pulses have stopped.
    pub fn tick(&mut self, now: Time) -> Option<PulseFault> {
        let silent = self.seen.is_some_and(|seen| (now - seen).as_seconds() > LOST);
        let tell = silent && !self.lost;
        self.lost |= silent;
        tell.then_some(PulseFault::Lost)
    }

    /// When the last good edge was.
    #[must_use]
    pub fn last(&self) -> Option<Time> {
        self.last.map(|pulse| pulse.time)
    }

    fn is_locked(&self) -> bool {
        self.confirmed >= CONFIRM
    }

    fn locked_edge(
        &mut self,
        pulse: Pulse,
        expected: GpsTime,
    ) -> Result<Option<Labelled>, PulseFault> {
        let gps = whole(expected);
        let by = (expected.as_nanos() - gps.as_nanos()) as f64 * 1e-9;
        if by.abs() > GATE {
            return Err(self.misfit().unwrap_or(PulseFault::Off { by }));
        }
        self.misfits = 0;
        self.last = Some(pulse);
        self.named = false;
        Ok(Some(Labelled { gps, time: pulse.time }))
    }

    /// Names a pulse and compares its spacing from the one named before.
    fn name(&mut self, gps: GpsTime, time: Time) -> Option<Labelled> {
        let named = Labelled { gps, time };
        let fits = self.candidate.is_some_and(|before| {
            let labels = (gps.as_nanos() - before.gps.as_nanos()) as f64 * 1e-9;
            let edges = (time - before.time).as_seconds();
            labels > 0.0 && (labels - edges).abs() < SPACING
        });
        self.confirmed = if fits { self.confirmed + 1 } else { 1 };
        self.candidate = Some(named);
        self.is_locked().then_some(named)
    }

    fn misfit(&mut self) -> Option<PulseFault> {
        self.misfits += 1;
        (self.misfits >= PATIENCE).then(|| {
            *self = Pulses { last: self.last, seen: self.seen, ..Pulses::default() };
            PulseFault::Unlocked
        })
    }
}

/// The nearest whole second.
fn whole(time: GpsTime) -> GpsTime {
    GpsTime::from_nanos((time.as_nanos() + SECOND / 2).div_euclid(SECOND) * SECOND)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pulse(seconds: f64) -> Pulse {
        Pulse { time: Time::from_seconds(seconds), sequence: 0 }
    }

    fn second(label: i64) -> GpsTime {
        GpsTime::from_nanos(label * SECOND)
    }

    /// The clock of the tests: GPS time is 1000 s ahead.
    fn by_clock(seconds: f64) -> Option<GpsTime> {
        Some(GpsTime::from_nanos(((seconds + 1000.0) * 1e9).round() as i64))
    }

    fn locked() -> Pulses {
        let mut pulses = Pulses::default();
        for k in 0..3 {
            assert_eq!(pulses.edge(pulse(f64::from(k)), None), Ok(None));
            let received = Time::from_seconds(f64::from(k) + 0.2);
            let named = pulses.message(second(1000 + i64::from(k)), received, None);
            assert_eq!(named.unwrap().is_some(), k == 2);
        }
        pulses
    }

    #[test]
    fn three_labels_that_fit_lock() {
        let mut pulses = locked();
        let labelled = pulses.edge(pulse(3.0001), by_clock(3.0001)).unwrap().unwrap();
        assert_eq!(labelled.gps, second(1003));
    }

    #[test]
    fn messages_name_each_pulse_until_the_clock_of_the_pulses_runs() {
        let mut pulses = locked();
        assert_eq!(pulses.edge(pulse(3.0), None), Ok(None));
        let named = pulses.message(second(1003), Time::from_seconds(3.2), None).unwrap().unwrap();
        assert_eq!((named.gps, named.time), (second(1003), Time::from_seconds(3.0)));
    }

    #[test]
    fn messages_of_broken_seconds_and_late_ones_name_nothing() {
        let mut pulses = Pulses::default();
        pulses.edge(pulse(5.0), None).unwrap();
        let broken = GpsTime::from_nanos(1004 * SECOND + 800_000_000);
        assert_eq!(pulses.message(broken, Time::from_seconds(5.1), None), Ok(None));
        assert_eq!(pulses.message(second(1005), Time::from_seconds(5.97), None), Ok(None));
        assert!(pulses.candidate.is_none());
    }

    #[test]
    fn doubled_and_late_pulses_are_refused_and_lost_ones_told_once() {
        let mut pulses = locked();
        for wrong in [3.01, 3.5] {
            let fault = pulses.edge(pulse(wrong), by_clock(wrong)).unwrap_err();
            assert!(matches!(fault, PulseFault::Off { .. }), "{fault:?}");
        }
        assert_eq!(pulses.tick(Time::from_seconds(3.6)), None);
        assert!(pulses.edge(pulse(4.0), by_clock(4.0)).is_ok());
        assert_eq!(pulses.tick(Time::from_seconds(6.0)), None);
        assert_eq!(pulses.tick(Time::from_seconds(6.6)), Some(PulseFault::Lost));
        assert_eq!(pulses.tick(Time::from_seconds(7.0)), None);
    }

    #[test]
    fn pulses_that_moved_for_good_are_labelled_anew() {
        let mut pulses = locked();
        let faults = (3..8).map(|k| {
            let at = f64::from(k) + 0.3;
            pulses.edge(pulse(at), by_clock(at)).unwrap_err()
        });
        assert_eq!(faults.last(), Some(PulseFault::Unlocked));
        assert!(!pulses.is_locked());
    }
}
