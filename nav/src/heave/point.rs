//! One monitoring point: its heave at a tick, and how it goes on from there.

use insd_base::{Body, DelayedHeave, HeaveQuality, Time};
use nalgebra::SMatrix;

use super::bank::SIGNALS;
use super::combine::Combination;
use super::history::Raw;
use super::learner::{Grade, Learner};
use super::model::{Model, error_of};
use super::times::TICK;

/// The bank's signals for each of the raw displacements.
pub(super) type Outputs = SMatrix<f64, SIGNALS, 4>;

/// Accuracy of a survey: the greater of so many metres and this share of the heave.
const REAL_TIME: (f64, f64) = (0.05, 0.05);
const DELAYED: (f64, f64) = (0.02, 0.02);
/// Time after which the filter counts as settled once it is accurate, and in any case, s.
const SETTLING: (f64, f64) = (60.0, 300.0);
/// The first seconds after a start say nothing; from the second number on the heave is given whole, s.
const SILENCE: (f64, f64) = (10.0, 25.0);
/// Age up to which the weights are found anew at every tick, s.
const YOUNG: f64 = 60.0;
/// Least heave of a sea that the estimate is weighed against, 1-sigma, m.
const LEAST_SEA: f64 = 0.25;
/// Memory of the heave's mean square, s.
const MEMORY: f64 = 300.0;
/// Share of the heave that the delayed heave's average takes away or leaves.
const RIPPLE: f64 = 0.003;
/// Memory of the slow motion that the delayed heave is judged by, s.
const SLOW_MEMORY: f64 = 60.0;
/// What is expected of the IMU by its data sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Expected {
    /// Variance of the delayed heave, m^2.
    pub(super) delayed: f64,
    /// Mean square of the slow motion, m^2.
    pub(super) slow: f64,
}

/// The bank and the raw displacements at a tick.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moment<'a> {
    /// What the bank makes of what it may meet.
    pub(super) model: &'a Model,
    /// The bank's signals.
    pub(super) outputs: &'a Outputs,
    /// The displacements.
    pub(super) raw: &'a Raw,
    /// Share of the second that has passed.
    pub(super) share: f64,
    /// No tick came before.
    pub(super) first: bool,
}

/// What the turn of a second brings.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Second<'a> {
    /// The bank's signals some time ago and the heave of then.
    pub(super) past: Option<(&'a Outputs, Raw)>,
    /// How long ago that was, s.
    pub(super) lag: usize,
    /// Slow motion about the delayed instant.
    pub(super) slow: Option<Raw>,
}

/// A monitoring point.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Point {
    /// Its upward displacement as a sum of the raw ones.
    pub(super) share: Raw,
    /// Estimate less raw displacement at the last ticks, the latest first, m.
    offsets: [f64; 3],
    pub(super) sigma: f64,
    pub(super) quality: HeaveQuality,
    pub(super) delayed: Option<DelayedHeave>,
    learner: Learner,
    before: Combination,
    after: Combination,
    square: Running,
    slow: Running,
}

/// A mean square over the last seconds.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
struct Running {
    mean: f64,
    seconds: f64,
}

impl Running {
    fn add(&mut self, square: f64, memory: f64) {
        self.seconds = (self.seconds + 1.0).min(memory);
        self.mean += (square - self.mean) / self.seconds;
    }
}

impl Point {
    /// A point at a lever arm from the IMU.
    pub(super) fn new(lever: &Body, grade: Grade) -> Self {
        Point {
            share: Raw::new(1.0, -lever.0.x, -lever.0.y, -lever.0.z),
            offsets: [0.0; 3],
            sigma: 0.0,
            quality: HeaveQuality::Unsettled,
            delayed: None,
            learner: Learner::new(grade),
            before: Combination::none(),
            after: Combination::none(),
            square: Running::default(),
            slow: Running::default(),
        }
    }

    /// The bank starts anew.
    pub(super) fn restart(&mut self) {
        self.learner.restart();
        self.quality = HeaveQuality::Unsettled;
        self.delayed = None;
        self.slow = Running::default();
    }

    /// A second has passed.
    pub(super) fn second(&mut self, now: &Moment<'_>, news: &Second<'_>) {
        let signals = now.outputs * self.share;
        let past = news
            .past
            .map(|(outputs, heave)| error_of(&(outputs * self.share), heave.dot(&self.share)));
        self.learner.second(now.model, &signals, past.as_ref(), news.lag);
        self.before = self.after;
        self.after = self.learner.best(now.model).unwrap_or(self.before);
        if let Some(slow) = news.slow {
            self.slow.add(slow.dot(&self.share).powi(2), SLOW_MEMORY);
        }
    }

    /// The estimate at a tick.
    pub(super) fn tick(&mut self, now: &Moment<'_>) {
        let signals = now.outputs * self.share;
        let age = now.model.age();
        if age < YOUNG {
            self.after = self.learner.best(now.model).unwrap_or(self.after);
            self.before = self.after;
        }
        let sums = [&self.before, &self.after].map(|combination| combination.sum(&signals));
        let error = self.before.sigma + now.share * (self.after.sigma - self.before.sigma);
        let sea = self.learner.sea().max(LEAST_SEA * LEAST_SEA);
        let heard = smooth((age - SILENCE.0) / (SILENCE.1 - SILENCE.0));
        let given = heard * sea / (sea + error * error);
        let heave = given * (sums[0] + now.share * (sums[1] - sums[0]));
        self.sigma = (given * error).hypot((1.0 - given) * sea.sqrt());
        let offset = heave - self.share.dot(now.raw);
        let [before, earlier, _] = if now.first { [offset; 3] } else { self.offsets };
        self.offsets = [offset, before, earlier];
        if age > SETTLING.0 {
            self.square.add(heave * heave, MEMORY / TICK);
        }
        self.judge(age);
    }

    fn judge(&mut self, age: f64) {
        let limit = self.limit(REAL_TIME);
        let settled = self.quality != HeaveQuality::Unsettled
            || age > SETTLING.1
            || age > SETTLING.0 && self.sigma <= limit;
        self.quality = match (settled, self.sigma <= limit) {
            (false, _) => HeaveQuality::Unsettled,
            (true, false) => HeaveQuality::Reduced,
            (true, true) => HeaveQuality::Settled,
        };
    }

    fn limit(&self, (metres, share): (f64, f64)) -> f64 {
        (share * self.square.mean.sqrt()).max(metres)
    }

    /// Takes the delayed heave of an instant, as raw displacements.
    pub(super) fn take_delayed(&mut self, time: Time, raw: &Raw, expected: &Expected) {
        let excess = (self.slow.mean / expected.slow).max(1.0);
        let ripple = RIPPLE * RIPPLE * self.square.mean;
        let sigma = (expected.delayed * excess + ripple).sqrt();
        let good = sigma <= self.limit(DELAYED);
        let quality = if good { HeaveQuality::Settled } else { HeaveQuality::Reduced };
        let heave = raw.dot(&self.share);
        self.delayed = Some(DelayedHeave { time, heave, sigma, quality });
    }

    /// What is to be added to the raw displacement so many seconds after the last tick, m, and its rate
    /// of change, m/s: a parabola through the last three ticks has this slope.
    pub(super) fn offset(&self, after: f64) -> (f64, f64) {
        let [now, before, earlier] = self.offsets;
        let slope = (3.0 * now - 4.0 * before + earlier) / (2.0 * TICK);
        (now + slope * after, slope)
    }

    /// The raw displacement has lost a straight line: `displacement` now, changing by `velocity`, m/s.
    pub(super) fn rebase(&mut self, displacement: f64, velocity: f64) {
        for (age, offset) in self.offsets.iter_mut().enumerate() {
            *offset += displacement - velocity * TICK * age as f64;
        }
    }
}

/// From 0 to 1 along a cubic without corners.
fn smooth(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}
