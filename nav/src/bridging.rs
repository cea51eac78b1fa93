//! How a gap in the IMU data is bridged, and what that gets wrong: learnt from the ship's own motion.
//!
//! Over a gap of T seconds rotation and velocity are made up from the rates on both sides, the slope r0' of
//! the rate before it and its mean m, axis by axis,
//!
//! b = T (m + a(T) ((r0 + r1) / 2 - m) + c(T) r0').
//!
//! In a gap much shorter than a wave the motion goes on evenly: a is one and c nothing. In a swing of the
//! angular frequency w, which rate and slope at one instant fix, b is exact; at half a wave, where the rates
//! at both ends cancel, with c T = 2 / w^2. In a gap of several waves of a broad sea neither says anything
//! of the swing between, which is bounded, and both are near zero. While there
//! are data, gaps of a quarter of a second to half a minute are made up all the time beside them, and
//! compared with what the samples say: least squares gives a and c, and the mean square of what is left is the
//! variance that a true gap of that length adds. So a ship in a calm, one in a seaway and one that turns
//! all the time each get the claim that is due to them, for each axis.
//!
//! What no past can tell is that she begins to turn. Where the rate after a gap differs from that before it
//! by more than it ever did, d, she has begun somewhere in the gap, and nobody knows when: a step at any
//! instant of it alike leaves d T / 2 (1 - a) on the mean, with a variance of (d T)^2 / 12. Turns that
//! begin and end inside are covered by a floor about down.
//!
//! Cost: a quaternion product for a sample, and 3 us four times a second. Memory: 50 kB.

use std::collections::VecDeque;

use insd_base::Time;
use nalgebra::{UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use crate::increments::Increment;
use lag::{LAGS, LENGTHS, Lag, Sides, TICK, WAVE, length_of, place_of};

mod lag;

/// What is known of the motion at an instant.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct Moment {
    /// Angular rate, body axes, rad/s.
    pub rate: Vector3<f64>,
    /// Specific force, body axes, m/s^2.
    pub force: Vector3<f64>,
}

/// A gap made up: rotation and velocity over it, body axes, and the variance of each component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bridge {
    /// Rotation vector, rad.
    pub rotation: Vector3<f64>,
    /// Integral of specific force in the axes of the middle, m/s.
    pub velocity: Vector3<f64>,
    /// Variance of the rotation, rad^2.
    pub rotation_variance: Vector3<f64>,
    /// Variance of the velocity, (m/s)^2.
    pub velocity_variance: Vector3<f64>,
}

/// What has been learnt; the samples of the last half minute are not kept with it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bridging {
    turn: Quantity,
    push: Quantity,
    /// Slopes of rate and force before a gap, where the samples are no longer there.
    ended: Option<Moment>,
    #[serde(skip)]
    run: Run,
}

/// The unbroken data since the last gap.
#[derive(Clone, Debug, PartialEq, Default)]
struct Run {
    attitude: UnitQuaternion<f64>,
    velocity: Vector3<f64>,
    /// Sums since the last tick, and their time, s.
    turned: Vector3<f64>,
    pushed: Vector3<f64>,
    since: f64,
    ticks: VecDeque<Tick>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Tick {
    time: Time,
    attitude: UnitQuaternion<f64>,
    velocity: Vector3<f64>,
    moment: Moment,
    slopes: Moment,
    means: Moment,
}

/// What is learnt of the rotation, or of the velocity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Quantity {
    mean: Vector3<f64>,
    seconds: f64,
    lags: [Lag; LAGS],
}

/// What is assumed before anything is known.
#[derive(Clone, Copy)]
struct Prior {
    /// Of the rate, 1-sigma of each component: rad/s or m/s^2.
    rate: f64,
}

/// The longest of them.
const LONGEST: usize = 128;
/// Time over which the mean rate is taken, s.
const MEAN: f64 = 30.0;
/// Doubt in a variance from so many independent gaps.
const DOUBT: f64 = 4.0;
/// Rate and force of a ship of which nothing is known.
const TURN: Prior = Prior { rate: 0.05 };
const PUSH: Prior = Prior { rate: 0.5 };
/// Ratio of the square of a change to its mean beyond which she has begun to turn.
const BEGUN: f64 = 12.0;
/// Factor on the variance where no slope is known: the data have only just begun.
const NO_SLOPE: f64 = 4.0;
/// A rate of turn wanders by this much without anything being seen of it, (rad/s)^2 in a second: from
/// nothing to 0.3 deg/s in 20 s. The error of a bridge over such a rate has the variance q T^3 / 12.
const TURNING: f64 = 1.5e-6;
/// Force that a ship in a calm may come to have, m/s^2.
const PUSHING: f64 = 0.02;

impl Default for Bridging {
    fn default() -> Self {
        let nothing =
            Quantity { mean: Vector3::zeros(), seconds: 0.0, lags: [Lag::default(); LAGS] };
        Bridging { turn: nothing, push: nothing, ended: None, run: Run::default() }
    }
}

impl Bridging {
    /// Learns from an increment and the mean rate and force of its sample.
    pub fn learn(&mut self, increment: &Increment, moment: &Moment) {
        let run = &mut self.run;
        if run.ticks.is_empty() {
            self.turn.begin(&moment.rate);
            self.push.begin(&moment.force);
            self.ended = None;
            run.tick(increment.from, moment, &self.turn.mean, &self.push.mean);
        }
        let half = run.attitude * UnitQuaternion::new(increment.rotation * 0.5);
        run.velocity += half * increment.velocity;
        run.attitude *= UnitQuaternion::new(increment.rotation);
        run.turned += increment.rotation;
        run.pushed += increment.velocity;
        run.since += increment.duration();
        if run.since < TICK - 0.5 * increment.duration() {
            return;
        }
        run.attitude.renormalize();
        self.average();
        self.run.tick(increment.to, moment, &self.turn.mean, &self.push.mean);
        self.make_up();
    }

    /// Forgets the samples before a gap, not what was learnt from them. The means go on where gaps follow one
    /// another closely.
    pub fn interrupt(&mut self) {
        self.average();
        self.run = Run::default();
    }

    /// Takes what was summed up into the means.
    fn average(&mut self) {
        let run = &mut self.run;
        let since = std::mem::take(&mut run.since);
        let (turned, pushed) = (std::mem::take(&mut run.turned), std::mem::take(&mut run.pushed));
        if since > 0.0 {
            self.turn.average(&(turned / since), since);
            self.push.average(&(pushed / since), since);
        }
    }

    /// What is kept for the next start of the program: all but the samples.
    #[must_use]
    pub fn kept(&self, last: Time, moment: &Moment) -> Bridging {
        Bridging {
            turn: self.turn,
            push: self.push,
            ended: self.slopes(last, moment),
            run: Run::default(),
        }
    }

    /// Makes up a gap of `length` seconds after the moment of the `last` sample.
    #[must_use]
    pub fn bridge(&self, last: Time, length: f64, before: &Moment, after: &Moment) -> Bridge {
        let means = Moment { rate: self.turn.mean, force: self.push.mean };
        let slopes = self.slopes(last, before);
        let (turn, push) = quantities(length, before, after, &slopes.unwrap_or_default(), &means);
        let doubt = if slopes.is_some() { 1.0 } else { NO_SLOPE };
        let mut rotation_variance =
            self.turn.variance(&TURN, length) * doubt + self.turn.unsure(&TURN, &turn);
        rotation_variance.z += TURNING * length.powi(3) / 12.0;
        let pushing = (PUSHING * length * (length / WAVE).min(1.0)).powi(2);
        let velocity_variance =
            self.push.variance(&PUSH, length) * doubt + self.push.unsure(&PUSH, &push);
        Bridge {
            rotation: self.turn.over(&turn),
            velocity: self.push.over(&push),
            rotation_variance,
            velocity_variance: velocity_variance.add_scalar(pushing),
        }
    }

    /// Slopes of rate and force up to the last sample, over about a tick.
    fn slopes(&self, last: Time, moment: &Moment) -> Option<Moment> {
        let since = |tick: &Tick| (last - tick.time).as_seconds();
        let tick = self.run.ticks.iter().rev().find(|tick| since(tick) > 0.5 * TICK);
        let slopes = |tick: &Tick| tick.moment.slopes(moment, since(tick));
        tick.map(slopes).or(self.ended)
    }

    /// Variance of a rotation made up over `length` seconds, by what is known before the gap ends,
    /// body axes, rad^2.
    #[must_use]
    pub fn rotation_variance(&self, length: f64) -> Vector3<f64> {
        let down = TURNING * length.powi(3) / 12.0;
        self.turn.variance(&TURN, length) + Vector3::new(0.0, 0.0, down)
    }

    /// Whether all that was learnt are numbers, and no variance is negative.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        let lag = |lag: &Lag| {
            let squares = lag.ends.iter().chain(&lag.slope).chain(&lag.error).chain(&lag.change);
            let crosses = lag.cross.iter().flatten().chain(&lag.both);
            crosses.copied().all(f64::is_finite)
                && squares.copied().all(|x| x.is_finite() && x >= 0.0)
        };
        let quantity = |quantity: &Quantity| {
            quantity.seconds.is_finite()
                && quantity.mean.iter().all(|x| x.is_finite())
                && quantity.lags.iter().all(lag)
        };
        quantity(&self.turn) && quantity(&self.push)
    }

    /// Makes up every gap that ends now, and learns from what the samples say.
    fn make_up(&mut self) {
        let Some(now) = self.run.ticks.back().copied() else { return };
        for (lag, ticks) in LENGTHS.iter().enumerate() {
            let back = self.run.ticks.len().checked_sub(1 + *ticks as usize);
            let Some(then) = back.and_then(|place| self.run.ticks.get(place)).copied() else {
                return;
            };
            let length = (now.time - then.time).as_seconds();
            let (turn, push) =
                quantities(length, &then.moment, &now.moment, &then.slopes, &then.means);
            let back = then.attitude.inverse();
            let rotation = (back * now.attitude).scaled_axis();
            let turned = self.turn.over(&turn);
            self.turn.lags[lag].learn(lag, &turn, &rotation, &turned);
            let pushed = self.push.over(&push);
            let middle = UnitQuaternion::new(turned * 0.5).inverse() * back;
            // the strapdown turns the force evenly over the gap
            let evenly = turned.cross(&turned.cross(&pushed)) / 24.0;
            let velocity = middle * (now.velocity - then.velocity) - evenly;
            self.push.lags[lag].learn(lag, &push, &velocity, &pushed);
        }
    }
}

impl Moment {
    /// Slopes from this to a later moment.
    fn slopes(&self, later: &Moment, seconds: f64) -> Moment {
        Moment {
            rate: (later.rate - self.rate) / seconds,
            force: (later.force - self.force) / seconds,
        }
    }
}

/// Rate and force on both sides of a gap.
fn quantities(
    length: f64,
    before: &Moment,
    after: &Moment,
    slopes: &Moment,
    means: &Moment,
) -> (Sides, Sides) {
    let of = |part: fn(&Moment) -> Vector3<f64>| Sides {
        length,
        before: part(before),
        after: part(after),
        slope: part(slopes),
        mean: part(means),
    };
    (of(|moment| moment.rate), of(|moment| moment.force))
}

impl Run {
    fn tick(&mut self, time: Time, moment: &Moment, turn: &Vector3<f64>, push: &Vector3<f64>) {
        if self.ticks.len() > LONGEST {
            self.ticks.pop_front();
        }
        let slopes = self.ticks.back().map(|last| {
            last.moment.slopes(moment, (time - last.time).as_seconds().max(0.5 * TICK))
        });
        self.ticks.push_back(Tick {
            slopes: slopes.unwrap_or_default(),
            time,
            attitude: self.attitude,
            velocity: self.velocity,
            moment: *moment,
            means: Moment { rate: *turn, force: *push },
        });
    }
}

impl Quantity {
    /// The mean begins with what is there.
    fn begin(&mut self, rate: &Vector3<f64>) {
        if self.seconds <= 0.0 {
            self.mean = *rate;
        }
    }

    fn average(&mut self, rate: &Vector3<f64>, dt: f64) {
        self.seconds = (self.seconds + dt).min(MEAN);
        self.mean += (rate - self.mean) * (dt / self.seconds).min(1.0);
    }

    /// The integral over a gap.
    fn over(&self, sides: &Sides) -> Vector3<f64> {
        let [ends, slope] = self.shares(sides.length);
        let swing = sides.slope.component_mul(&slope) * sides.length;
        sides.mean * sides.length + sides.ends().component_mul(&ends) + swing
    }

    /// How much of what is seen at the ends of a gap, and of the slope before it, holds for all of it.
    fn shares(&self, length: f64) -> [Vector3<f64>; 2] {
        let (index, along) = place_of(length);
        let (low, high) = (self.lags[index].shares(index), self.lags[index + 1].shares(index + 1));
        // all of the ends and nothing of the slope as the gap becomes short, by the square as in a swing
        let short = (length / TICK).min(1.0).powi(2);
        std::array::from_fn(|i| {
            let even = Vector3::repeat(if i == 0 { 1.0 } else { 0.0 });
            let between = low[i] * (1.0 - along) + high[i] * along;
            even + (between - even) * short
        })
    }

    /// Mean square error of a bridge, by what was made up lately.
    fn variance(&self, prior: &Prior, length: f64) -> Vector3<f64> {
        self.of_length(length, |index| self.error(prior, index))
    }

    fn error(&self, prior: &Prior, index: usize) -> Vector3<f64> {
        let lag = &self.lags[index];
        if lag.is_learnt(index) {
            return lag.error * (1.0 + DOUBT / lag.independent(index));
        }
        // the motion is scaled by what is known of shorter gaps
        let known = (0..index).rev().find(|shorter| self.lags[*shorter].is_learnt(*shorter));
        let expected = prior.error(length_of(index)).powi(2);
        known.map_or(Vector3::repeat(expected), |shorter| {
            self.error(prior, shorter) * (expected / prior.error(length_of(shorter)).powi(2))
        })
    }

    /// What is added in the case at hand.
    fn unsure(&self, prior: &Prior, sides: &Sides) -> Vector3<f64> {
        self.begun(prior, sides) + self.between_lengths(sides)
    }

    /// The shares of a length between two that are made up lie between theirs, nobody knows where: where
    /// the ends of a gap cancel they change fast, and what the two make of the case at hand differs.
    fn between_lengths(&self, sides: &Sides) -> Vector3<f64> {
        let (index, along) = place_of(sides.length);
        let (low, high) = (self.lags[index].shares(index), self.lags[index + 1].shares(index + 1));
        let by_ends = sides.ends().component_mul(&(high[0] - low[0]));
        let by_slope = sides.slope.component_mul(&(high[1] - low[1])) * sides.length;
        (by_ends + by_slope).map(|difference| difference * difference * along * (1.0 - along))
    }

    /// What is added where the rates at the ends differ from the mean by more than was ever seen:
    /// then the rate has changed at some instant of the gap.
    fn begun(&self, prior: &Prior, sides: &Sides) -> Vector3<f64> {
        let length = sides.length;
        let change = sides.after - sides.before;
        let usual = self.of_length(length, |index| {
            let lag = &self.lags[index];
            let unknown = Vector3::repeat(2.0 * prior.rate * prior.rate);
            (if lag.is_learnt(index) { lag.change } else { unknown }) * length_of(index).powi(2)
        });
        let [share, _] = self.shares(length);
        let variance = self.variance(prior, length);
        Vector3::from_fn(|i, _| {
            let times = (change[i] * length).powi(2) / usual[i].max(f64::MIN_POSITIVE);
            let step = usual[i] * (0.25 * (1.0 - share[i]).powi(2) + 1.0 / 12.0);
            // in a gap so short that she cannot have begun to turn it is a larger wave
            if times > BEGUN { (times - 1.0) * step.min(variance[i]) } else { 0.0 }
        })
    }

    /// A variance at any length: a power of it between two lengths that are made up, the greater of both
    /// from the length of a wave on, where it goes up and down; its square beyond all of them.
    fn of_length(&self, length: f64, of: impl Fn(usize) -> Vector3<f64>) -> Vector3<f64> {
        let (index, along) = place_of(length);
        let (low, high) = (of(index), of(index + 1));
        let inside = length.clamp(TICK, length_of(LAGS - 1));
        let even = length < WAVE;
        let value = low.zip_map(&high, |low, high| {
            let (low, high) = (low.max(f64::MIN_POSITIVE), high.max(f64::MIN_POSITIVE));
            if even || along <= 0.0 { low * (high / low).powf(along) } else { low.max(high) }
        });
        value * (length / inside).powi(2)
    }
}

impl Prior {
    /// Error of a bridge over a motion of which nothing is known, 1-sigma: what goes on nearly evenly
    /// for a time much shorter than a wave is anyone's guess beyond it.
    fn error(&self, length: f64) -> f64 {
        self.rate * length * (length / WAVE).powi(2).min(1.0)
    }
}

#[cfg(test)]
mod tests;
