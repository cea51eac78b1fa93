//! The ship's UTC: which instant of UTC is which instant of the computer's clock.
//!
//! Inside it is GPS time, which has no leap seconds. It is tied to the computer's clock by pulses where
//! there are any, else by the receipt of time messages. An epoch that does not fit what is known is
//! refused until five in a row agree with each other; then the labels step, and only the labels.

use insd_base::{GpsTime, Pulse, Span, Stamp, Time, UtcTime};
use insd_wire::gnss::EpochTime;
use insd_wire::nmea::TimeOfDay;

use super::map::{ClockMap, MapChange, Observed};
use super::pulses::{PulseFault, Pulses};

/// The day this version was made: no clock of a computer and no receiver at work is before it.
const MADE: (i32, u8, u8) = (2026, 1, 1);
/// What a computer's clock is off at first, ratio.
const DRIFT_STD: f64 = 1e-4;
/// A message may be this late before its time is doubted, s.
const LATEST: f64 = 2.5;
/// A message may be this early against what is known, s.
const EARLIEST: f64 = -0.3;
/// Epochs in a row that agree with each other before a new time is believed.
const PATIENCE: u32 = 5;
/// How far such epochs may be from each other, s.
const AGREE: f64 = 0.3;
/// Messages no farther apart than this tell the same epoch, ns: some round to a millisecond.
const SAME: i64 = 5_000_000;
/// Without pulses for this long the messages take over, s.
const COAST: f64 = 600.0;
/// Without messages of the source in use for this long another may take over, s.
const SILENCE: f64 = 5.0;

/// A date that no message has told for this long is taken from the system clock, s.
const DATELESS: f64 = 5.0;

const SECOND: i64 = 1_000_000_000;
const DAY: i64 = 86_400 * SECOND;
const WEEK: i64 = 604_800 * SECOND;
/// What a week number of ten bits goes over, ns.
const CYCLE: i64 = 1024 * WEEK;
/// Before GPS began and after its last week no date is believed: it is as if it were the nearest to that, ns
/// since 1970. The ends also keep sums of times within what they are counted in.
const FIRST: i64 = 315_964_800 * SECOND;
const LAST: i64 = FIRST + 9999 * WEEK;
/// What a computer's clock that has been set may be off, ns: a date that is farther from it, and would
/// be even after whole cycles, is no rollover but a recording.
const OFF: i64 = 2 * 365 * DAY;
/// What the clock of a recording and its receivers are apart at most, ns.
const TOGETHER: i64 = DAY;

/// How well UTC is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TimeQuality {
    /// By the system clock alone, if at all.
    Unknown,
    /// By the receipt of messages: to milliseconds, or tens of them.
    Messages,
    /// By pulses: to microseconds.
    Pulses,
}

/// Something about time worth telling.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TimeChange {
    /// UTC is known better or worse than before.
    Quality(TimeQuality),
    /// The labels stepped; the time line did not.
    Stepped {
        /// New UTC minus old, s.
        by: f64,
    },
    /// A receiver was whole cycles of 1024 weeks off; all its times are corrected.
    Rollover {
        /// Weeks added.
        weeks: i64,
    },
    /// A leap second that this version's table does not know was inserted.
    LeapSecond,
    /// An epoch is refused as it does not fit what is known.
    Doubted {
        /// By how much it is late, s; negative: from the future.
        late: f64,
    },
    /// Something is wrong with the pulses.
    Pulse(PulseFault),
}

/// Epochs in a row that do not fit what is known, but each other.
#[derive(Clone, Copy, Debug)]
struct Doubt {
    /// By how much the first was late, s.
    late: f64,
    /// The first and the last.
    first: GpsTime,
    last: GpsTime,
    count: u32,
}

/// UTC on the computer's clock.
#[derive(Clone, Debug)]
pub struct ShipUtc {
    edges: ClockMap,
    messages: ClockMap,
    pulses: Pulses,
    quality: TimeQuality,
    /// Priority, index and last receipt of the source in use.
    source: Option<(u8, usize, Time)>,
    doubted: Option<Doubt>,
    /// The last message that told a whole date, and its receipt.
    dated: Option<(GpsTime, Time)>,
    /// When a part of a time first had to be completed.
    asked: Option<Time>,
    rollover: i64,
    /// Ends of leap seconds that the table does not know.
    leaps: Vec<UtcTime>,
    changes: Vec<TimeChange>,
}

impl Default for ShipUtc {
    fn default() -> Self {
        ShipUtc {
            edges: ClockMap::new(Observed::Edges, DRIFT_STD),
            messages: ClockMap::new(Observed::Receipts, DRIFT_STD),
            pulses: Pulses::default(),
            quality: TimeQuality::Unknown,
            source: None,
            doubted: None,
            dated: None,
            asked: None,
            rollover: 0,
            leaps: Vec::new(),
            changes: Vec::new(),
        }
    }
}

impl ShipUtc {
    /// The instant of an epoch in GPS time, from whatever part of it a message tells; the rest is what
    /// is nearest to what is known. `None` for a part while no date is known: the system clock is asked
    /// for it only after some seconds in which no message told one. `live`: the message was made while
    /// the computer's clock ran, and is not read from a file.
    pub fn resolve(&mut self, epoch: &EpochTime, stamp: &Stamp, live: bool) -> Option<GpsTime> {
        let gps = match epoch {
            EpochTime::Utc(utc) => {
                // the receiver took the leap seconds of today off: the date is put right before them
                let near = |own: &Self, gps| own.utc_of(gps).as_nanos();
                let told = utc.as_nanos().clamp(FIRST, LAST);
                let behind = self.behind(told, stamp, live, near);
                self.gps_of(UtcTime::from_nanos(told.saturating_add(behind)))
            }
            EpochTime::Gps(gps) => {
                let near = |_: &Self, gps: GpsTime| gps.as_nanos();
                let told = gps.as_nanos().clamp(0, LAST - FIRST);
                let behind = self.behind(told, stamp, live, near);
                GpsTime::from_nanos(told.saturating_add(behind))
            }
            _ if !self.knows_date(stamp.monotonic) => return None,
            EpochTime::TimeOfWeek(nanos) => self.expected(stamp).nearest_with_tow(*nanos),
            EpochTime::TimeOfDay(clock) => self.resolve_clock(*clock, self.expected(stamp)),
        };
        if matches!(epoch, EpochTime::Utc(_) | EpochTime::Gps(_)) {
            self.dated = Some((gps, stamp.monotonic));
        }
        Some(gps)
    }

    /// By how much a time is behind for whole cycles of 1024 weeks, ns; a change is told.
    ///
    /// A date is put right only by evidence: by what messages have told before, by a computer's clock
    /// that has been set and from which the date is away by whole cycles, or, where that clock has not
    /// been set, because a receiver at work is not older than this program. Any other date is taken as
    /// it stands, as is one of a file that nothing speaks against.
    fn behind(
        &mut self,
        told: i64,
        stamp: &Stamp,
        live: bool,
        near: impl Fn(&Self, GpsTime) -> i64,
    ) -> i64 {
        let made = UtcTime::from_civil(MADE, (0, 0, 0), 0).unwrap_or(stamp.system);
        let is_set = live && stamp.system >= made;
        let cycles = if let Some(known) = self.told_before(stamp) {
            let known = near(self, known);
            self.look_ahead(told, known, is_set);
            cycles_behind(told, known, TOGETHER)
        } else if !live {
            0
        } else if is_set {
            cycles_behind(told, near(self, self.gps_of(stamp.system)), OFF)
        } else if stamp.system.as_nanos().saturating_sub(told).saturating_abs() < TOGETHER {
            0
        } else {
            let short = made.as_nanos().saturating_sub(told).max(0);
            short.saturating_add(CYCLE - 1).div_euclid(CYCLE)
        };
        let weeks = cycles * (CYCLE / WEEK);
        if weeks != self.rollover && weeks != 0 {
            self.changes.push(TimeChange::Rollover { weeks });
            self.rollover = weeks;
        }
        cycles.saturating_mul(CYCLE)
    }

    /// Where no clock has confirmed the date that is believed, a receiver that is ahead of it by whole
    /// cycles shows that it is behind, as none is ever ahead.
    fn look_ahead(&mut self, told: i64, known: i64, is_set: bool) {
        if !is_set && cycles_behind(known, told, TOGETHER) > 0 {
            if self.quality != TimeQuality::Unknown {
                let by = told.saturating_sub(known) as f64 * 1e-9;
                self.changes.push(TimeChange::Stepped { by });
            }
            self.start_over();
            self.dated = None;
        }
    }

    /// The instant nearest to `expected` with this time of day.
    fn resolve_clock(&mut self, clock: TimeOfDay, expected: GpsTime) -> GpsTime {
        let near = self.utc_of(expected);
        let leaping = clock.second == 60;
        if leaping {
            self.note_leap(near);
        }
        let ahead = (clock.as_nanos() - near.as_nanos()).rem_euclid(DAY);
        let utc = near.as_nanos() + if ahead > DAY / 2 { ahead - DAY } else { ahead };
        let gps = self.gps_of(UtcTime::from_nanos(utc)).as_nanos();
        GpsTime::from_nanos(gps - if leaping { self.leap_correction(utc) } else { 0 })
    }

    /// A message of an epoch from a source that may set the ship's UTC. `begun`: when its first byte
    /// came; `latency`: how long after the epoch it is sent. Returns whether the epoch is believed. Only
    /// the source in use can make the time step: the others are merely refused while they say something
    /// else.
    pub fn message(
        &mut self,
        (priority, index): (u8, usize),
        epoch: GpsTime,
        begun: Time,
        latency: Span,
    ) -> bool {
        let received = begun - latency;
        let leads = self.leads(priority, index, received);
        if !self.is_plausible(epoch, received, leads) {
            return false;
        }
        if leads {
            self.source = Some((priority, index, received));
            let own = self.pulses.last().and_then(|last| inverse(&self.edges, last));
            match self.pulses.message(epoch, begun, own) {
                Ok(Some(labelled)) => self.enter_edge(labelled.gps, labelled.time),
                Ok(None) => {}
                Err(fault) => self.unlock(fault),
            }
            match self.messages.observe(epoch.as_nanos(), received) {
                MapChange::Ready => self.look_at_quality(received),
                MapChange::Stepped { by } if self.quality == TimeQuality::Messages => {
                    self.changes.push(TimeChange::Stepped { by: -by });
                }
                MapChange::Stepped { .. } | MapChange::Nothing => {}
            }
        }
        true
    }

    /// GPS time about now, for what is read with the help of it; `None` as for a part of a time in [`Self::resolve`].
    pub fn about(&mut self, stamp: &Stamp) -> Option<GpsTime> {
        self.knows_date(stamp.monotonic).then(|| self.expected(stamp))
    }

    /// Whether a message of an epoch that is to set nothing fits what is known, as in [`Self::message`].
    #[must_use]
    pub fn fits(&self, epoch: GpsTime, begun: Time, latency: Span) -> bool {
        let late = self.time_of(epoch).map(|known| (begun - latency - known).as_seconds());
        late.is_none_or(|late| (EARLIEST..LATEST).contains(&late))
    }

    /// A pulse.
    pub fn pulse(&mut self, pulse: Pulse) {
        let expected = inverse(&self.edges, pulse.time);
        match self.pulses.edge(pulse, expected) {
            Ok(Some(labelled)) => self.enter_edge(labelled.gps, labelled.time),
            Ok(None) => {}
            Err(fault) => self.unlock(fault),
        }
    }

    /// A message that names the next pulse.
    pub fn announce(&mut self, next: GpsTime) {
        self.pulses.announce(next);
    }

    /// Time passes.
    pub fn tick(&mut self, now: Time) {
        if let Some(fault) = self.pulses.tick(now) {
            self.changes.push(TimeChange::Pulse(fault));
        }
        self.look_at_quality(now);
    }

    /// The computer's time of an epoch, if UTC is known.
    #[must_use]
    pub fn time_of(&self, epoch: GpsTime) -> Option<Time> {
        self.map()?.map(epoch.as_nanos())
    }

    /// UTC at an instant of the computer's clock, if it is known.
    #[must_use]
    pub fn utc_at(&self, time: Time) -> Option<UtcTime> {
        inverse(self.map()?, time).map(|gps| self.utc_of(gps))
    }

    /// How well UTC is known.
    #[must_use]
    pub fn quality(&self) -> TimeQuality {
        self.quality
    }

    /// 1-sigma of UTC on the computer's clock, s, apart from the least delay of messages.
    #[must_use]
    pub fn sigma(&self) -> Option<f64> {
        self.map()?.sigma()
    }

    /// What has happened since it was last asked.
    pub fn take_changes(&mut self) -> Vec<TimeChange> {
        std::mem::take(&mut self.changes)
    }

    fn map(&self) -> Option<&ClockMap> {
        match self.quality {
            TimeQuality::Unknown => None,
            TimeQuality::Messages => Some(&self.messages),
            TimeQuality::Pulses => Some(&self.edges),
        }
    }

    /// Whether the day is known, or has been asked for in vain for long enough.
    fn knows_date(&mut self, now: Time) -> bool {
        let asked = *self.asked.get_or_insert(now);
        let in_vain = (now - asked).as_seconds() > DATELESS;
        self.map().is_some() || self.dated.is_some() || in_vain
    }

    /// GPS time by the tie, or by the last message with a date.
    fn told_before(&self, stamp: &Stamp) -> Option<GpsTime> {
        let tied = self.map().and_then(|map| inverse(map, stamp.monotonic));
        tied.or_else(|| {
            let (gps, told) = self.dated?;
            let since = (stamp.monotonic - told).as_nanos();
            Some(GpsTime::from_nanos(gps.as_nanos().saturating_add(since)))
        })
    }

    /// GPS time by what messages have told, or by the system clock if that is not before this version
    /// was made.
    fn expected(&self, stamp: &Stamp) -> GpsTime {
        if let Some(gps) = self.told_before(stamp) {
            return gps;
        }
        let made = UtcTime::from_civil(MADE, (0, 0, 0), 0).unwrap_or(stamp.system);
        self.gps_of(stamp.system.max(made))
    }

    fn gps_of(&self, utc: UtcTime) -> GpsTime {
        let unknown = self.leaps.iter().filter(|leap| **leap <= utc).count();
        let extra = i64::try_from(unknown).unwrap_or(0) * SECOND;
        GpsTime::from_nanos(utc.to_gps().as_nanos().saturating_add(extra))
    }

    fn utc_of(&self, gps: GpsTime) -> UtcTime {
        let passed = |leap: &&UtcTime| self.gps_of(**leap).as_nanos() <= gps.as_nanos();
        let unknown = self.leaps.iter().filter(passed).count();
        let extra = i64::try_from(unknown).unwrap_or(0) * SECOND;
        GpsTime::from_nanos(gps.as_nanos().saturating_sub(extra)).to_utc(None)
    }

    /// Second 60 was seen near an instant: the day ends with a leap second.
    fn note_leap(&mut self, near: UtcTime) {
        let midnight = (near.as_nanos() + DAY / 2).div_euclid(DAY) * DAY;
        let end = UtcTime::from_nanos(midnight);
        let before = UtcTime::from_nanos(midnight - SECOND);
        let listed = end.to_gps().as_nanos() - before.to_gps().as_nanos() > SECOND;
        let close = (near.as_nanos() - midnight).abs() < 10 * SECOND;
        if close && !listed && !self.leaps.contains(&end) {
            self.leaps.push(end);
            self.changes.push(TimeChange::LeapSecond);
        }
    }

    /// Second 60 counts like the second after it, which GPS time puts one second later.
    fn leap_correction(&self, utc_nanos: i64) -> i64 {
        let end = utc_nanos.div_euclid(DAY) * DAY;
        let (at, before) = (UtcTime::from_nanos(end), UtcTime::from_nanos(end - SECOND));
        self.gps_of(at).as_nanos() - self.gps_of(before).as_nanos() - SECOND
    }

    /// Whether an epoch fits what is known; one that does not is believed once enough agree.
    fn is_plausible(&mut self, epoch: GpsTime, received: Time, leads: bool) -> bool {
        let Some(known) = self.time_of(epoch) else { return true };
        let late = (received - known).as_seconds();
        let fits = (EARLIEST..LATEST).contains(&late);
        if !leads {
            return fits;
        }
        if fits {
            self.doubted = None;
            return true;
        }
        let again = self.doubted.and_then(|doubt| doubt.again(epoch, late));
        if again.is_none() {
            self.changes.push(TimeChange::Doubted { late });
        }
        let doubt = again.unwrap_or(Doubt { late, first: epoch, last: epoch, count: 1 });
        self.doubted = Some(doubt);
        if doubt.count < PATIENCE {
            return false;
        }
        self.start_over();
        self.changes.push(TimeChange::Stepped { by: -late });
        true
    }

    fn start_over(&mut self) {
        self.doubted = None;
        self.edges.forget_offset();
        self.messages.forget_offset();
        self.pulses = Pulses::default();
        self.quality = TimeQuality::Unknown;
    }

    /// Whether a source is the one that sets UTC: the best that speaks and is believed.
    fn leads(&self, priority: u8, index: usize, now: Time) -> bool {
        self.source.is_none_or(|(best, leader, last)| {
            leader == index || priority < best || (now - last).as_seconds() > SILENCE
        })
    }

    fn enter_edge(&mut self, gps: GpsTime, time: Time) {
        self.edges.observe(gps.as_nanos(), time);
        self.look_at_quality(time);
    }

    fn unlock(&mut self, fault: PulseFault) {
        if fault == PulseFault::Unlocked {
            self.edges.forget_offset();
        }
        self.changes.push(TimeChange::Pulse(fault));
    }

    fn look_at_quality(&mut self, now: Time) {
        let beats = self.pulses.last().is_some_and(|last| (now - last).as_seconds() < COAST);
        let by_edges = beats && self.edges.map(0).is_some();
        let quality = if by_edges {
            TimeQuality::Pulses
        } else if self.messages.map(0).is_some() {
            TimeQuality::Messages
        } else {
            TimeQuality::Unknown
        };
        if quality != self.quality {
            self.quality = quality;
            self.changes.push(TimeChange::Quality(quality));
        }
    }
}

impl Doubt {
    /// The doubt with one more epoch, if it agrees with the first. Epochs that were held up and come all
    /// at once do not: each is late by less than the one before.
    fn again(self, epoch: GpsTime, late: f64) -> Option<Self> {
        let apart = |other: GpsTime| epoch.as_nanos().saturating_sub(other.as_nanos());
        let new = apart(self.last).saturating_abs() > SAME;
        let since = apart(self.first);
        let agreed = AGREE.min(0.5 * since as f64 * 1e-9);
        let agrees = since >= 0 && (late - self.late).abs() <= agreed;
        let count = self.count + u32::from(new);
        (agrees || !new).then_some(Doubt { last: epoch, count, ..self })
    }
}

/// By how many whole cycles of 1024 weeks a time is behind another, if it is to within some nanoseconds;
/// else 0.
fn cycles_behind(told: i64, near: i64, within: i64) -> i64 {
    let behind = near.saturating_sub(told);
    let cycles = behind.saturating_add(CYCLE / 2).div_euclid(CYCLE);
    let rest = behind.saturating_sub(cycles.saturating_mul(CYCLE));
    if rest.saturating_abs() < within { cycles.max(0) } else { 0 }
}

fn inverse(map: &ClockMap, time: Time) -> Option<GpsTime> {
    map.inverse(time).map(GpsTime::from_nanos)
}

#[cfg(test)]
mod tests;
