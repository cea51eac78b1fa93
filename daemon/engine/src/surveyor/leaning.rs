//! Whether a ship under way leans as her gyros say, by what her accelerometers feel and how her antenna moves.
//!
//! Over the time between two fixes, along a level axis of hers and with the lever arm r of the antenna below the IMU,
//!
//! ```text
//! change of v = sum over lags of h (integral of f - s g integral of lean) + r change of lean' + noise
//! ```
//!
//! f the specific force, v the velocity of the antenna, lean by the gyros, s = 1, or -1 of a gyro that is mirrored: waves that push
//! her are in f and in v, and what the mast does is the second term, wherever the antenna sits. A receiver smooths its
//! velocity and is late, which h allows for; its sum is one, and near nothing of a receiver that sees no waves. h and
//! r are found by least squares for either sign, and the likelihoods of what is left decide. Her bow points where
//! her course does, or a quarter or half a turn away from it: what explains most.

use std::collections::VecDeque;

use insd_base::units::DEG;
use insd_base::{Finding, GnssFix, Span, Time};
use insd_nav::Increment;
use nalgebra::{SMatrix, SVector, Vector2, Vector3};

/// Her course is where her bow points above this speed, m/s, while she turns no faster than this on the mean, rad/s: the mean of her
/// course is behind her bow by as much as she turns in its time constant.
const UNDER_WAY: f64 = 1.5;
const STRAIGHT: f64 = 0.3 * DEG;
/// Time constants of what is slow, twice; of the course; and of the mean of the force, s.
const SLOW: f64 = 10.0;
const COURSE: f64 = 10.0;
const MEAN: f64 = 20.0;
/// Fixes further apart than this, s, are no pair.
const APART: f64 = 1.5;
/// How late a receiver may be, s: lags of h.
const LAGS: [f64; 5] = [0.0, 0.7, 1.4, 2.1, 2.8];
/// What is found by least squares: h at each lag, and r.
const FOUND: usize = LAGS.len() + 1;
/// Sums are kept for so long, s, one in so many, s.
const KEPT: f64 = 5.0;
const SPACING: f64 = 0.02;
/// Seconds until the filters have settled, that make a verdict, and that the memory spans.
const SETTLED: f64 = 40.0;
const ENOUGH: f64 = 120.0;
const SPAN: f64 = 600.0;
/// Sum of h of a receiver that sees the waves.
const SEES: std::ops::Range<f64> = 0.7..1.5;
/// What explains more does so by a share of what is left, and is likelier by this, in logarithms.
const MORE: f64 = 0.1;
const LIKELIER: f64 = 40.0;

/// What the IMU has summed up: the force, m/s, and the time integral of the lean, m/s, along the level axes; and the rate of
/// the lean, rad/s.
#[derive(Clone, Copy, Debug)]
struct Sums {
    time: Time,
    force: Vector2<f64>,
    lean: Vector2<f64>,
    rate: Vector2<f64>,
}

/// What a pair of fixes says along the level axes: the change of velocity along her course and across it, force and lean at each
/// lag, and the change of the rate of the lean.
type Sample = [Vector2<f64>; 2 + 2 * LAGS.len()];

/// Least squares of one axis and one sign, for each way that her bow may point.
#[derive(Clone, Copy, Debug, Default)]
struct Fit {
    squares: SMatrix<f64, FOUND, FOUND>,
    products: [SVector<f64, FOUND>; 4],
}

impl Fit {
    fn see(&mut self, by: &SVector<f64, FOUND>, told: &[f64; 4], weight: f64, kept: f64) {
        self.squares = self.squares * kept + by * by.transpose() * weight;
        for (products, told) in self.products.iter_mut().zip(told) {
            *products = *products * kept + by * (*told * weight);
        }
    }

    /// The sum of h, and how much of the squares of what was told is explained, if her bow points a way.
    fn explained(&self, way: usize) -> Option<(f64, f64)> {
        let h = self.squares.cholesky()?.solve(&self.products[way]);
        Some((h.rows(0, LAGS.len()).sum(), h.dot(&self.products[way])))
    }
}

/// One level axis: its fits with the gyro as it is and mirrored, and the squares of what was told for each way.
#[derive(Clone, Copy, Debug, Default)]
struct Axis {
    fits: [Fit; 2],
    squares: [f64; 4],
}

impl Axis {
    fn see(&mut self, told: &[f64; 4], fast: &Sample, axis: usize, weight: f64, kept: f64) {
        for (squares, told) in self.squares.iter_mut().zip(told) {
            *squares = *squares * kept + told * told * weight;
        }
        for (fit, sign) in self.fits.iter_mut().zip([1.0, -1.0]) {
            let pushed = |lag: usize| fast[2 + 2 * lag][axis] - sign * fast[3 + 2 * lag][axis];
            let by =
                SVector::from_fn(|i, _| if i < LAGS.len() { pushed(i) } else { fast[1][axis] });
            fit.see(&by, told, weight, kept);
        }
    }

    /// Logarithm of what is left of the squares for a way and a sign; a receiver that moves against the waves explains nothing.
    fn left(&self, way: usize, is_mirrored: bool) -> f64 {
        let all = self.squares[way];
        let explained = self.fits[usize::from(is_mirrored)].explained(way);
        let explained = explained.filter(|(h, _)| *h > 0.0).map_or(0.0, |(_, explained)| explained);
        (all - explained).max(1e-6 * all).max(f64::MIN_POSITIVE).ln()
    }

    /// Whether the receiver sees the waves if the gyro is mirrored.
    fn sees(&self, way: usize) -> bool {
        self.fits[1].explained(way).is_some_and(|(h, _)| SEES.contains(&h))
    }
}

/// All that is seen of it.
#[derive(Clone, Debug, Default)]
pub(super) struct Leaning {
    seen: f64,
    mean: Vector3<f64>,
    turned: Vector2<f64>,
    /// Rate of turn on the mean, rad/s.
    turning: f64,
    force: Vector2<f64>,
    lean: Vector2<f64>,
    sums: VecDeque<Sums>,
    heard: Option<(Time, Vector2<f64>)>,
    last: Option<(Time, Vector2<f64>)>,
    course: Vector2<f64>,
    slow: [Sample; 2],
    lasts: f64,
    counted: f64,
    axes: [Axis; 2],
    mirrored: [bool; 2],
}

impl Leaning {
    /// Sees an increment; one that was not measured interrupts.
    pub(super) fn see(&mut self, increment: &Increment) {
        let duration = increment.duration();
        if increment.bridged.is_some() || duration <= 0.0 {
            self.interrupt();
            self.sums.clear();
            return;
        }
        self.seen += duration;
        let share = duration / self.seen.min(MEAN);
        self.mean += (increment.velocity / duration - self.mean) * share;
        let Some(up) = self.mean.try_normalize(1e-9) else { return };
        self.turned -= increment.rotation.cross(&up).xy();
        let rate = increment.rotation.dot(&up) / duration;
        self.turning += (rate - self.turning) * (duration / COURSE).min(1.0);
        self.force += increment.velocity.xy();
        self.lean += self.turned * self.mean.norm() * duration;
        let age = |sums: &Sums| (increment.to - sums.time).as_seconds();
        if self.sums.back().is_some_and(|newest| age(newest) < SPACING) {
            return;
        }
        self.sums.push_back(Sums {
            time: increment.to,
            force: self.force,
            lean: self.lean,
            rate: -increment.end_rate.cross(&up).xy(),
        });
        while self.sums.front().is_some_and(|oldest| age(oldest) > KEPT) {
            self.sums.pop_front();
        }
        self.weigh();
    }

    /// What comes next does not follow what was heard, as of another receiver.
    pub(super) fn interrupt(&mut self) {
        (self.lasts, self.last, self.heard) = (0.0, None, None);
    }

    /// What was summed up until an instant.
    fn at(&self, time: Time) -> Option<Sums> {
        let next = self.sums.partition_point(|sums| sums.time < time);
        let (after, before) = (self.sums.get(next)?, self.sums.get(next.checked_sub(1)?)?);
        let length = (after.time - before.time).as_seconds();
        let share = (time - before.time).as_seconds() / length;
        let between = |a: &Vector2<f64>, b: &Vector2<f64>| a.lerp(b, share);
        Some(Sums {
            time,
            force: between(&before.force, &after.force),
            lean: between(&before.lean, &after.lean),
            rate: between(&before.rate, &after.rate),
        })
    }

    /// Hears a fix.
    pub(super) fn hear(&mut self, fix: &GnssFix) {
        let velocity = fix.velocity.filter(|_| fix.quality.is_measured());
        let Some(velocity) = velocity.map(|velocity| velocity.0.xy()) else { return };
        self.heard = Some((fix.time, velocity));
        self.weigh();
    }

    /// Holds what a receiver has said against the IMU, once that has told as much. What does not follow, is not under way, or in a
    /// turn, begins anew.
    fn weigh(&mut self) {
        let newest = self.sums.back().map(|sums| sums.time);
        let has_come = |(time, _): &mut (Time, _)| newest.is_some_and(|newest| newest >= *time);
        let Some((time, velocity)) = self.heard.take_if(has_come) else { return };
        let Some((before, old)) = self.last.replace((time, velocity)) else { return };
        let apart = (time - before).as_seconds();
        if !(0.0..=APART).contains(&apart) || apart == 0.0 {
            self.lasts = 0.0;
            return;
        }
        self.course += (velocity - self.course) * (apart / COURSE).min(1.0);
        let is_straight = self.turning.abs() < STRAIGHT;
        let Some(bow) = self.course.try_normalize(UNDER_WAY).filter(|_| is_straight) else {
            self.lasts = 0.0;
            return;
        };
        let change = velocity - old;
        let told = Vector2::new(bow.dot(&change), bow.perp(&change));
        if let Some(sample) = self.sample(told, before, time) {
            self.learn(&sample, apart);
        }
    }

    fn sample(&self, told: Vector2<f64>, before: Time, now: Time) -> Option<Sample> {
        let mut sample = Sample::default();
        for (lag, by) in LAGS.iter().enumerate() {
            let by = Span::from_seconds(*by);
            let (from, to) = self.at(before - by).zip(self.at(now - by))?;
            (sample[2 + 2 * lag], sample[3 + 2 * lag]) =
                (to.force - from.force, to.lean - from.lean);
            if lag == 0 {
                sample[1] = to.rate - from.rate;
            }
        }
        sample[0] = told;
        Some(sample)
    }

    fn learn(&mut self, sample: &Sample, apart: f64) {
        if self.lasts == 0.0 {
            self.slow = [*sample, Sample::default()];
        }
        self.lasts += apart;
        let share = (apart / SLOW).min(1.0);
        let mut fast = *sample;
        for slow in &mut self.slow {
            for (fast, slow) in fast.iter_mut().zip(slow) {
                *slow += (*fast - *slow) * share;
                *fast -= *slow;
            }
        }
        if self.lasts <= SETTLED {
            return;
        }
        let kept = 1.0 - apart / SPAN;
        self.counted = self.counted * kept + apart;
        let (ahead, across) = (fast[0].x, fast[0].y);
        let ways = [[ahead, -across, -ahead, across], [across, ahead, -across, -ahead]];
        for (i, axis) in self.axes.iter_mut().enumerate() {
            axis.see(&ways[i], &fast, i, apart, kept);
        }
        if self.counted > ENOUGH {
            self.judge();
        }
    }

    /// Judges the axes the way that explains most: a ferry goes astern, and others crab.
    fn judge(&mut self) {
        let left = |mirrored: [bool; 2]| {
            let of = |way: usize| -> f64 {
                let axes = self.axes.iter().zip(mirrored);
                axes.map(|(axis, is_mirrored)| axis.left(way, is_mirrored)).sum()
            };
            (0..4).map(|way| (of(way), way)).min_by(|a, b| a.0.total_cmp(&b.0))
        };
        let Some((right, _)) = left([false; 2]) else { return };
        let explains = |more: f64| more > MORE && 0.5 * self.counted * more > LIKELIER;
        for i in 0..2 {
            let Some((wrong, way)) = left([i == 0, i == 1]) else { return };
            if explains(right - wrong) && self.axes[i].sees(way) {
                self.mirrored[i] = true;
            } else if explains(wrong - right) {
                self.mirrored[i] = false;
            }
        }
    }

    /// That an axis is mirrored, if it is.
    pub(super) fn finding(&self) -> Option<Finding> {
        let is_any = self.mirrored.contains(&true);
        is_any.then_some(Finding::ImuAxes { agreement: -1.0 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::{FixQuality, Ned};

    const TICK: f64 = 0.02;
    const GRAVITY: f64 = 9.81;

    /// A swing of nine waves with its integral, and its first and its second derivative: about an axis of hers, rad, or along it, m.
    fn swing(at: f64, size: f64) -> [f64; 4] {
        let waves = [
            (0.2, 0.47),
            (0.4, 0.56),
            (0.6, 0.63),
            (0.6, 0.71),
            (0.5, 0.8),
            (0.4, 0.92),
            (0.3, 1.03),
            (0.3, 1.17),
            (0.2, 1.31),
        ];
        waves.iter().fold([0.0; 4], |[integral, value, rate, twice], (share, omega)| {
            let (sin, cos) = (omega * at).sin_cos();
            let size = size * share;
            [
                integral - size * cos / omega,
                value + size * sin,
                rate + size * omega * cos,
                twice - size * omega * omega * sin,
            ]
        })
    }

    /// A ship with her bow to the north-east.
    #[derive(Clone, Copy, Debug)]
    struct Ship {
        /// How far her bow pitches, rad, for each that the gyro tells.
        gyro: f64,
        /// m/s.
        speed: f64,
        /// What waves push her by, m for each radian of pitch.
        pushed: f64,
        /// What she slides down their slopes by, in shares of gravity along the deck.
        sliding: f64,
        /// The antenna is so far above the IMU, m.
        above: f64,
        /// The receiver smooths its velocity over this, s,
        smooth: f64,
        /// and tells what it was so long ago, s.
        late: f64,
    }

    const SHIP: Ship = Ship {
        gyro: 1.0,
        speed: 6.0,
        pushed: 0.0,
        sliding: 0.0,
        above: 14.0,
        smooth: 0.0,
        late: 0.0,
    };

    impl Ship {
        /// Velocity of the antenna ahead and to starboard, m/s; she rolls as she does in every sea.
        fn velocity(&self, at: f64) -> Vector2<f64> {
            let [integral, _, rate, _] = swing(at, 0.01);
            let [rolled, _, rolls, _] = swing(at + 40.0, 0.02);
            let pushed = (self.pushed - self.above) * rate;
            let slid = GRAVITY * Vector2::new(self.sliding * integral, 0.3 * rolled);
            slid + Vector2::new(self.speed + pushed, self.above * rolls)
        }

        /// What the IMU tells of a tick.
        fn increment(&self, at: f64) -> Increment {
            let [_, lean, _, twice] = swing(at + 0.5 * TICK, 0.01);
            let [_, roll, ..] = swing(at + 40.0 + 0.5 * TICK, 0.02);
            let ahead = lean * GRAVITY * (1.0 + self.sliding) + self.pushed * twice;
            let turned = |at, size| swing(at + TICK, size)[1] - swing(at, size)[1];
            let ends = [swing(at + 40.0 + TICK, 0.02)[2], swing(at + TICK, 0.01)[2]];
            Increment {
                from: Time::from_seconds(at),
                to: Time::from_seconds(at + TICK),
                rotation: Vector3::new(turned(at + 40.0, 0.02), self.gyro * turned(at, 0.01), 0.0),
                velocity: Vector3::new(ahead, -0.7 * GRAVITY * roll, -GRAVITY) * TICK,
                end_rate: Vector3::new(ends[0], self.gyro * ends[1], 0.0),
                end_rate_variance: 0.0,
                angular_acceleration: Vector3::zeros(),
                rate_noise: Vector3::zeros(),
                force_noise: Vector3::zeros(),
                bridged: None,
                celsius: None,
            }
        }

        /// What is found in ten minutes.
        fn sail(&self) -> Option<Finding> {
            let mut leaning = Leaning::default();
            let mut told = self.velocity(0.0);
            for k in 0..30_000 {
                let at = f64::from(k) * TICK;
                leaning.see(&self.increment(at));
                told += (self.velocity(at - self.late) - told) * (TICK / self.smooth).min(1.0);
                if k % 50 == 25 {
                    let noise = |factor: f64| 0.03 * (factor * f64::from(k)).sin();
                    let [ahead, starboard] = [told.x + noise(1.0), told.y + noise(1.7)];
                    let half = std::f64::consts::FRAC_1_SQRT_2;
                    let velocity =
                        Ned::new(half * (ahead - starboard), half * (ahead + starboard), 0.0);
                    leaning.hear(&GnssFix {
                        time: Time::from_seconds(at),
                        velocity: Some(velocity),
                        quality: FixQuality::Autonomous,
                        ..GnssFix::default()
                    });
                }
            }
            leaning.finding()
        }
    }

    #[test]
    fn a_gyro_that_is_mirrored_is_found_whatever_pushes_her_and_wherever_the_antenna_sits() {
        for sliding in [-2.0, -1.5, -1.0, -0.5] {
            for above in [0.0, 14.0, 33.0, -14.0] {
                let ship = Ship { sliding, above, ..SHIP };
                assert_eq!(ship.sail(), None, "{ship:?}");
                let mirrored = Ship { gyro: -1.0, ..ship };
                let found = mirrored.sail();
                assert!(matches!(found, Some(Finding::ImuAxes { .. })), "{mirrored:?}: {found:?}");
            }
        }
    }

    #[test]
    fn an_honest_gyro_is_not_taken_for_mirrored_by_velocities_that_are_smoothed_or_late() {
        let receivers = [(0.3, 0.0), (1.0, 0.0), (3.0, 0.0), (10.0, 0.0), (1e9, 0.0)]
            .into_iter()
            .chain([0.3, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5].map(|late| (0.0, late)));
        for (smooth, late) in receivers {
            for sliding in [-4.0, -3.0, -2.5, -2.0, -1.5, -1.0, -0.5, 0.0, 1.0, 2.0] {
                let ship = Ship { sliding, smooth, late, ..SHIP };
                assert_eq!(ship.sail(), None, "{ship:?}");
            }
            for pushed in [-25.0, 12.0, 30.0] {
                let ship = Ship { pushed, smooth, late, ..SHIP };
                assert_eq!(ship.sail(), None, "{ship:?}");
            }
        }
    }
}
