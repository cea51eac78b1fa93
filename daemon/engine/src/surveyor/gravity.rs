//! Whether gravity swings in the axes of the IMU the way its gyros say that these are turned.
//!
//! A direction that stands still in space moves in the body by f' = -w x f. Of the specific force that holds but for what
//! the ship is accelerated by, and to make gravity swing the other way she would have to be accelerated by more than she
//! leans, in step with it: a raft that follows every wave feels none of its slope, and no ship feels the
//! opposite. So where rolling or pitching as it is felt runs against that as it is told an axis is mirrored, or two are
//! swapped, whichever way she lies and whatever else is heard.
//!
//! Both are filtered alike to what lies between drift and vibration, and compared in blocks: by the correlation, which noise
//! makes small, and by the share of it that is felt, of which an IMU far below the point that she turns about loses a little.
//! Of a ship under way only rolling counts: head seas come so often that they may push her more than they lift her bow.

use insd_base::{Finding, GnssFix};
use insd_nav::Increment;
use nalgebra::{Vector2, Vector3};

/// Time constants of the filters, each twice, s, and of the mean of the force.
const DRIFT: f64 = 10.0;
const VIBRATION: f64 = 0.5;
const MEAN: f64 = 20.0;
/// Until the filters have settled, and length of a block, s.
const SETTLED: f64 = 30.0;
const BLOCK: f64 = 20.0;
/// So many blocks make a mean at the most, and so many a verdict.
const BLOCKS: f64 = 12.0;
const ENOUGH: f64 = 4.0;
/// Correlation up to which they run against each other, less what the noise of one block of a ship that lies still makes of
/// it, over the root of their number; and from which on they are seen to go together again.
const AGAINST: f64 = -0.4;
const NOISE: f64 = 0.8;
const TOGETHER: f64 = 0.2;
/// Share of what is told that is felt, up to which no ship does.
const FELT: f64 = -0.3;
/// A ship that is slower lies, m/s, as far as is known for so long after that was heard, s.
const LIES: f64 = 1.0;
const LASTS: f64 = 10.0;

/// One that lets pass what is between drift and vibration.
#[derive(Clone, Copy, Debug, Default)]
struct Band {
    drift: [Vector2<f64>; 2],
    swing: [Vector2<f64>; 2],
}

impl Band {
    fn beginning_at(value: Vector2<f64>) -> Self {
        Band { drift: [value, Vector2::zeros()], ..Band::default() }
    }

    fn pass(&mut self, value: Vector2<f64>, duration: f64) -> Vector2<f64> {
        let [slow, fast] = [DRIFT, VIBRATION].map(|constant| (duration / constant).min(1.0));
        let high = self.drift.iter_mut().fold(value, |value, drift| {
            *drift += (value - *drift) * slow;
            value - *drift
        });
        self.swing.iter_mut().fold(high, |value, swing| {
            *swing += (value - *swing) * fast;
            *swing
        })
    }
}

/// The filters, and how long they have run, s.
#[derive(Clone, Copy, Debug, Default)]
struct Swings {
    seen: f64,
    mean: Vector3<f64>,
    turned: Vector2<f64>,
    told: Band,
    felt: Band,
}

impl Swings {
    /// How gravity swings by the gyros and by the accelerometers, rad, once that is known.
    fn see(
        &mut self,
        increment: &Increment,
        duration: f64,
    ) -> Option<(Vector2<f64>, Vector2<f64>)> {
        let is_first = self.seen == 0.0;
        self.seen += duration;
        let share = duration / self.seen.min(MEAN);
        self.mean += (increment.velocity / duration - self.mean) * share;
        let length = self.mean.norm();
        if length <= 0.0 {
            return None;
        }
        self.turned -= increment.rotation.cross(&self.mean).xy() / length;
        let lies = increment.velocity.xy() / (duration * length);
        if is_first {
            self.felt = Band::beginning_at(lies);
        }
        let (told, felt) = (self.told.pass(self.turned, duration), self.felt.pass(lies, duration));
        (self.seen > SETTLED).then_some((told, felt))
    }
}

/// One axis: squares and products of a block, and the means of all.
#[derive(Clone, Copy, Debug, Default)]
struct Axis {
    told: f64,
    felt: f64,
    both: f64,
    blocks: f64,
    correlation: f64,
    share: f64,
    is_against: bool,
}

impl Axis {
    fn see(&mut self, told: f64, felt: f64, duration: f64) {
        self.told += told * told * duration;
        self.felt += felt * felt * duration;
        self.both += felt * told * duration;
    }

    /// Forgets the block that runs.
    fn interrupt(&mut self) {
        (self.told, self.felt, self.both) = (0.0, 0.0, 0.0);
    }

    /// Ends a block.
    fn judge(&mut self) {
        let (told, felt, both) = (self.told, self.felt, self.both);
        self.interrupt();
        if told <= 0.0 || felt <= 0.0 {
            return;
        }
        self.blocks = (self.blocks + 1.0).min(BLOCKS);
        self.correlation += (both / (told * felt).sqrt() - self.correlation) / self.blocks;
        self.share += (both / told - self.share) / self.blocks;
        let is_known = self.blocks >= ENOUGH && self.share < FELT;
        if is_known && self.correlation < AGAINST - NOISE / self.blocks.sqrt() {
            self.is_against = true;
        } else if self.correlation > TOGETHER {
            self.is_against = false;
        }
    }
}

/// What was made of all blocks.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Gravity {
    swings: Swings,
    /// How long the block that runs lasts, s.
    lasts: f64,
    pitch: Axis,
    roll: Axis,
    /// For how long it is known that she lies still, s.
    lies_for: f64,
}

impl Gravity {
    /// Sees an increment; one that was not measured interrupts.
    pub(super) fn see(&mut self, increment: &Increment) {
        let duration = increment.duration();
        if increment.bridged.is_some() || duration <= 0.0 {
            (self.swings, self.lasts) = (Swings::default(), 0.0);
            [&mut self.pitch, &mut self.roll].into_iter().for_each(Axis::interrupt);
            return;
        }
        let Some((told, felt)) = self.swings.see(increment, duration) else { return };
        self.roll.see(told.y, felt.y, duration);
        self.lies_for = (self.lies_for - duration).max(0.0);
        if self.lies_for > 0.0 {
            self.pitch.see(told.x, felt.x, duration);
        }
        self.lasts += duration;
        if self.lasts >= BLOCK {
            self.lasts = 0.0;
            [&mut self.pitch, &mut self.roll].into_iter().for_each(Axis::judge);
        }
    }

    /// Hears whether she lies still.
    pub(super) fn hear(&mut self, fix: &GnssFix) {
        if let Some(velocity) = fix.velocity.filter(|_| fix.quality.is_measured()) {
            self.lies_for = if velocity.0.xy().norm() < LIES { LASTS } else { 0.0 };
        }
    }

    /// That an axis is mirrored, if it is.
    pub(super) fn finding(&self) -> Option<Finding> {
        let against = [&self.roll, &self.pitch].into_iter().find(|axis| axis.is_against);
        against.map(|axis| Finding::ImuAxes { agreement: axis.correlation })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::Time;
    use insd_base::units::DEG;

    /// How IMU and ship differ: what the gyros tell of a rotation, and the accelerometers of a force.
    type Told = fn(Vector3<f64>) -> Vector3<f64>;

    fn increment(at: f64, dt: f64, rotation: Vector3<f64>, velocity: Vector3<f64>) -> Increment {
        Increment {
            from: Time::from_seconds(at),
            to: Time::from_seconds(at + dt),
            rotation,
            velocity,
            end_rate: Vector3::zeros(),
            end_rate_variance: 0.0,
            angular_acceleration: Vector3::zeros(),
            rate_noise: Vector3::zeros(),
            force_noise: Vector3::zeros(),
            bridged: None,
            celsius: None,
        }
    }

    /// Five minutes of a ship that rolls and pitches by so much, deg, of which the accelerometers feel a share, each; she trims
    /// and turns, and her gyros drift.
    fn sailed(gyros: Told, accels: Told, swing: [f64; 2], felt: [f64; 2]) -> Option<Finding> {
        swung(f64::INFINITY, [gyros, accels], swing, felt)
    }

    /// The same of one that is known to lie for so long, s.
    fn swung(
        lies_for: f64,
        [gyros, accels]: [Told; 2],
        swing: [f64; 2],
        felt: [f64; 2],
    ) -> Option<Finding> {
        let mut gravity = Gravity { lies_for, ..Gravity::default() };
        let dt = 0.02;
        let roll = |t: f64| swing[0] * DEG * (t * 0.7).sin();
        let pitch = |t: f64| swing[1] * DEG * ((t * 0.9).sin() + 0.5 * (t * 0.61).cos());
        for k in 0..15_000 {
            let at = f64::from(k) * dt;
            let (dx, dy) = (roll(at + dt) - roll(at), pitch(at + dt) - pitch(at));
            let yaw = 0.5 * DEG * dt;
            let (lean, trim) = (felt[0] * roll(at), felt[1] * pitch(at) + 2.0 * DEG);
            let drift = Vector3::new(2e-4, -1e-4, 0.0) * dt;
            let rotation = gyros(Vector3::new(dx - yaw * trim, dy + yaw * lean, yaw)) + drift;
            let force = accels(Vector3::new(trim.sin(), -lean.sin(), -1.0) * 9.81 * dt);
            gravity.see(&increment(at, dt, rotation, force));
        }
        gravity.finding()
    }

    #[test]
    fn the_noise_of_a_ship_that_lies_still_says_nothing() {
        let mut gravity = Gravity { lies_for: f64::INFINITY, ..Gravity::default() };
        let mut state = 1_u64;
        let mut noise = || {
            let one = |state: &mut u64| {
                *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                (*state >> 40) as f64 / f64::from(1 << 24) - 0.5
            };
            Vector3::from_fn(|_, _| one(&mut state))
        };
        for k in 0..12 * 3600 * 20 {
            let at = f64::from(k) * 0.05;
            gravity.see(&increment(at, 0.05, noise() * 1e-4, noise() * 1e-3 - Vector3::z() * 0.49));
            assert_eq!(gravity.finding(), None, "after {at} s");
        }
    }

    const SWINGS: [[f64; 2]; 3] = [[0.1, 0.03], [3.0, 1.0], [15.0, 4.0]];

    #[test]
    fn a_ship_that_lay_still_when_she_was_last_heard_of_may_be_pushed_by_head_seas() {
        let pushed = |lies_for: f64| swung(lies_for, [|it| it, |it| it], [3.0, 1.0], [1.0, -0.9]);
        assert!(pushed(f64::INFINITY).is_some());
        assert_eq!(pushed(LASTS), None);
    }

    #[test]
    fn a_ship_that_is_told_as_she_is_agrees_in_any_sea() {
        let turned: Told = |it| Vector3::new(it.y, -it.x, it.z);
        for swing in SWINGS {
            for felt in [[1.0, 1.0], [1.7, 0.5], [2.0, 0.2]] {
                assert_eq!(sailed(|it| it, |it| it, swing, felt), None, "{swing:?} {felt:?}");
            }
            assert_eq!(sailed(turned, turned, swing, [1.2, 0.7]), None, "{swing:?}");
        }
    }

    #[test]
    fn an_axis_that_is_mirrored_or_two_that_are_swapped_are_found() {
        let same: Told = |it| it;
        let (x, y): (Told, Told) =
            (|it| Vector3::new(-it.x, it.y, it.z), |it| Vector3::new(it.x, -it.y, it.z));
        let swapped: Told = |it| Vector3::new(it.y, it.x, it.z);
        let upwards: Told = |it| Vector3::new(it.x, it.y, -it.z);
        let wrong = [(x, same), (y, same), (y, y), (same, x), (swapped, swapped), (same, upwards)];
        for (i, (gyros, accels)) in wrong.into_iter().enumerate() {
            for swing in SWINGS {
                let found = sailed(gyros, accels, swing, [1.3, 0.6]);
                assert!(
                    matches!(found, Some(Finding::ImuAxes { agreement }) if agreement < -0.8),
                    "{i} {swing:?} {found:?}"
                );
            }
        }
    }
}
