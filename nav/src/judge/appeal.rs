//! A verdict against the IMU that left open what the receiver may have been doing instead: both go on to be heard.
//!
//! If the receiver lied, as sized, and the IMU did nothing, the estimate that was mended for the IMU's fault is off by what the lie had done to it less what
//! the mending did, and what the receiver says is off by a lie that goes on to grow. That makes an innovation of g, where none is expected of the verdict. By the
//! innovations nu, in units of their sigmas, the lie is likelier than the verdict by
//!
//! sum(g nu - g^2 / 2),
//!
//! as a logarithm: on a straight course nothing, once she turns or the heading that the two differ by is large, much. Heading and the velocity
//! that a log sees are turned by it as a whole: what is not linear of that is what tells a circle from a straight line.

use insd_base::Time;
use nalgebra::{DMatrix, UnitQuaternion, Vector2, Vector3};

use super::rows::{self, ALL, Axis, Direct, FaultGroup};
use crate::error_state::{ATTITUDE, CURRENT, Effects, Errors, VELOCITY, Weighed};

/// What is less likely than this is of no account any more.
pub(super) const DISMISSED: f64 = 1e-8;
/// A heading that the two differ by more, rad, is no small error in what else they tell.
const LARGE: f64 = 0.5;

/// What the receiver may have been doing, against what the IMU was convicted of.
#[derive(Clone, Debug)]
pub(super) struct Appeal {
    group: usize,
    /// Since when the receiver would lie, and since when both are heard.
    since: Time,
    heard: Time,
    size: Vector3<f64>,
    /// What the estimate would lack, of the one cause that there is.
    effects: Effects,
    /// How likely it was, and how much likelier, as a logarithm, it has become.
    chance: f64,
    odds: f64,
    /// The judge has not begun anew since the verdict.
    is_new: bool,
}

impl Appeal {
    /// That the receiver does what a group has, of such a size, since then, and was so likely; `lacks` is what the estimate lacks then.
    pub(super) fn new(
        (group, since): (usize, Time),
        size: Vector3<f64>,
        (lacks, chance): (&Errors, f64),
        heard: Time,
    ) -> Self {
        let effects = Effects::of(lacks);
        Appeal { group, since, heard, size, effects, chance, odds: 0.0, is_new: true }
    }

    /// Whether the judge has not begun anew since the verdict.
    pub(super) fn is_new(&self) -> bool {
        self.is_new
    }

    /// The judge has begun anew.
    pub(super) fn begin(&mut self) {
        self.is_new = false;
    }

    /// For how long the receiver would have lied, s.
    pub(super) fn age(&self, now: Time) -> f64 {
        (now - self.since).as_seconds()
    }

    /// For how long both are heard, s.
    pub(super) fn heard_for(&self, now: Time) -> f64 {
        (now - self.heard).as_seconds()
    }

    /// Whether the headings of the two differ by so much that nothing else is linear.
    pub(super) fn is_beyond(&self, attitude: &UnitQuaternion<f64>) -> bool {
        self.apart(attitude).turned.abs() > LARGE
    }

    /// Its effects, to be carried along with the errors.
    pub(super) fn effects_mut(&mut self) -> &mut Effects {
        &mut self.effects
    }

    /// Hears an innovation, which is worth so many times less than it says, and is `absorbed` by the estimate or not; `direct` is what faults add to it,
    /// `attitude` the navigator's.
    pub(super) fn hear(
        &mut self,
        (weighed, absorbed): (&Weighed, bool),
        worth: f64,
        attitude: &UnitQuaternion<f64>,
        direct: &Direct,
    ) {
        self.effects.conform(weighed.layout());
        let FaultGroup { rows, .. } = &ALL[self.group];
        let own = direct.rows(rows.start, rows.len());
        let size = self.size.rows(0, rows.len());
        let mut told = DMatrix::from_fn(1, own.ncols(), |_, row| own.column(row).dot(&size));
        let apart = self.apart(attitude);
        (0..own.ncols()).for_each(|row| told[row] += apart.bent(direct, row));
        let effect = weighed.effect_of(&self.effects, told);
        let gain = effect.transpose().dot(&weighed.whitened()) - 0.5 * effect.norm_squared();
        self.odds += gain / worth;
        if absorbed {
            weighed.pass_on(&mut self.effects, &effect);
        }
    }

    /// By how much the two differ as a log sees it.
    fn apart(&self, attitude: &UnitQuaternion<f64>) -> Apart {
        let lacks = self.effects.total(&[1.0]);
        let to_body = |own: Vector3<f64>| attitude.inverse_transform_vector(&own);
        Apart {
            turned: to_body(lacks.of(ATTITUDE)).z,
            velocity: to_body(lacks.of(VELOCITY)).xy(),
            current: lacks.of(CURRENT),
        }
    }

    /// How likely it is now.
    pub(super) fn chance_now(&self) -> f64 {
        let odds = self.chance / (1.0 - self.chance).max(DISMISSED) * self.odds.exp();
        if odds.is_finite() { odds / (1.0 + odds) } else { 1.0 }
    }
}

/// What the navigator's estimate lacks of the heading, rad, of the velocity, body axes, and of the current, north and east, m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Apart {
    turned: f64,
    velocity: Vector2<f64>,
    current: Vector2<f64>,
}

impl Apart {
    /// What a velocity through the water adds to a row of a log as it is turned by more than a little, m/s; nothing to others.
    ///
    /// With a its axis, b the one to the right of it, v the velocity and d what the estimate lacks of that, the angle p:
    /// cos(p) a (v + d) + sin(p) b (v + d) - a v, of which a d + p b v is what is linear.
    fn bent(&self, direct: &Direct, row: usize) -> f64 {
        let [along, aside] = rows::axes_of_log(direct, row);
        let [through, across] = rows::told_by_log(direct, row);
        let less = |axis: &Axis| axis.body.dot(&self.velocity) - axis.level.dot(&self.current);
        let (sin, cos) = self.turned.sin_cos();
        (cos - 1.0) * (through + less(&along)) + sin * less(&aside) + (sin - self.turned) * across
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::rows::of_log;
    use nalgebra::Matrix3;

    /// What an estimate lacks of heading, velocity and current.
    fn appeal(turned: f64, velocity: Vector3<f64>, current: Vector2<f64>) -> Appeal {
        let mut lacks = Errors::none();
        lacks.set(ATTITUDE, &Vector3::new(0.0, 0.0, turned));
        lacks.set(VELOCITY, &velocity);
        lacks.set(CURRENT, &current);
        Appeal {
            group: 4,
            since: Time::START,
            heard: Time::START,
            size: Vector3::new(0.0, 0.002, 0.0),
            effects: Effects::of(&lacks),
            chance: 0.1,
            odds: 0.0,
            is_new: false,
        }
    }

    #[test]
    fn a_log_is_told_by_all_of_the_turn_and_not_by_its_linear_part() {
        // body, level and Earth axes are the same here
        let (through, lacks) = (Vector3::new(5.0, 0.4, 0.0), Vector3::new(-0.3, 0.8, 0.0));
        let (current, turned) = (Vector2::new(0.1, -0.2), 0.4_f64);
        let own = appeal(turned, lacks, current);
        let direct = of_log(&through, &Matrix3::identity());
        let less = lacks - Vector3::new(current.x, current.y, 0.0);
        let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.0, 0.0, -turned));
        let whole = turn * (through + less) - through;
        let linear = less - Vector3::new(0.0, 0.0, turned).cross(&through);
        let still = UnitQuaternion::identity();
        for axis in 0..2 {
            let bent = own.apart(&still).bent(&direct, axis);
            assert!((bent - (whole - linear)[axis]).abs() < 1e-12, "{axis}: {bent}");
        }
        assert!(own.apart(&still).bent(&rows::of_gnss_velocity(10.0), 0).abs() < 1e-12);
    }

    #[test]
    fn what_was_likely_becomes_as_much_likelier_as_the_innovations_say() {
        let mut own = appeal(0.0, Vector3::zeros(), Vector2::zeros());
        assert!((own.chance_now() - 0.1).abs() < 1e-12);
        own.odds = 9.0_f64.ln();
        assert!((own.chance_now() - 0.5).abs() < 1e-12);
        (own.chance, own.odds) = (1.0, 2000.0);
        assert!((own.chance_now() - 1.0).abs() < 1e-12);
    }
}
