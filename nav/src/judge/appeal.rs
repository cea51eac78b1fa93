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
use nalgebra::{DMatrix, UnitQuaternion, Vector2};

use super::Judge;
use super::aid::Aid;
use super::assessment::{WORST, unsure};
use super::charge::{Charge, Kind};
use super::onset::Onset;
use super::rows::{self, ALL, Axis, Direct, FaultGroup};
use crate::error_state::{ATTITUDE, CURRENT, Effects, Errors, VELOCITY, Weighed};

/// What is less likely than this is of no account any more.
const DISMISSED: f64 = 1e-8;
/// A heading that the two differ by more, rad, is no small error in what else they tell.
const LARGE: f64 = 0.5;

/// What the receiver may have been doing, against what the IMU was convicted of.
#[derive(Clone, Debug)]
pub(super) struct Appeal {
    group: usize,
    /// Since when the receiver would lie, and since when both are heard.
    since: Time,
    heard: Time,
    size: Vector2<f64>,
    /// What the estimate would lack, of the one cause that there is.
    effects: Effects,
    /// How likely it was, and how much likelier, as a logarithm, it has become.
    chance: f64,
    odds: f64,
    /// The judge has not begun anew since the verdict.
    is_new: bool,
}

impl Judge {
    /// The estimate is mended for a fault of the IMU; what the receiver may have done instead goes on to be heard.
    pub(super) fn hear_both(&mut self, lie: Option<Charge>, mended: &Charge, now: Time) {
        let appeal = lie.and_then(|lie| self.appeal_of(&lie, mended, now));
        self.appeal = appeal.map(Box::new);
    }

    fn appeal_of(&self, lie: &Charge, mended: &Charge, now: Time) -> Option<Appeal> {
        let Kind::Shaped { group, since, sized } = lie.kind else { return None };
        let (_, chance) = self.docket.open_lie()?.left;
        let mut lacks = self.done_by(lie)?;
        lacks -= &self.done_by(mended)?;
        Some(Appeal {
            group,
            since,
            heard: now,
            size: sized.value.xy(),
            effects: Effects::of(&lacks),
            chance,
            odds: 0.0,
            is_new: true,
        })
    }

    /// What a fault has done to the estimate.
    fn done_by(&self, charge: &Charge) -> Option<Errors> {
        let Kind::Shaped { group, since, sized } = charge.kind else { return None };
        let group = &ALL[group];
        let of = |onset: &Onset| {
            onset.effects_of(group).total(&sized.value.as_slice()[..group.rows.len()])
        };
        self.begun(since).map(of)
    }

    /// The judge begins anew: after the verdict both go on to be heard, later the estimate is another.
    pub(super) fn keep_new_appeal(&mut self) {
        self.appeal = self.appeal.take().filter(|appeal| appeal.is_new);
        self.appeal.iter_mut().for_each(|appeal| appeal.is_new = false);
    }

    /// Hears an innovation for both; `direct` is what faults add to it, `attitude` the navigator's.
    pub(super) fn hear_appeal(
        &mut self,
        (aid, now): (Aid, Time),
        weighed: &Weighed,
        attitude: &UnitQuaternion<f64>,
        direct: impl Fn(f64) -> Direct,
    ) {
        let Some(appeal) = self.appeal.as_mut().filter(|own| !own.is_new) else { return };
        let direct = direct((now - appeal.since).as_seconds());
        appeal.hear((aid, now), weighed, attitude, &direct);
        let chance = appeal.chance_now();
        let is_dismissed = chance < DISMISSED;
        self.docket.weigh_open_lie((!is_dismissed).then_some(chance));
        if is_dismissed || appeal.turned(attitude).abs() > LARGE {
            self.appeal = None;
        }
    }
}

impl Appeal {
    /// Its effects, to be carried along with the errors.
    pub(super) fn effects_mut(&mut self) -> &mut Effects {
        &mut self.effects
    }

    fn hear(
        &mut self,
        (aid, now): (Aid, Time),
        weighed: &Weighed,
        attitude: &UnitQuaternion<f64>,
        direct: &Direct,
    ) {
        self.effects.conform(weighed.layout());
        let FaultGroup { rows, .. } = &ALL[self.group];
        let own = direct.rows(rows.start, rows.len());
        let mut told = DMatrix::from_fn(1, own.ncols(), |_, row| own.column(row).dot(&self.size));
        (0..own.ncols()).for_each(|row| told[row] += self.bent(attitude, direct, row));
        let effect = weighed.effect_of(&self.effects, told);
        let gain = effect.transpose().dot(&weighed.whitened()) - 0.5 * effect.norm_squared();
        self.odds += gain / unsure((now - self.heard).as_seconds(), WORST);
        if aid.is_absorbed() {
            weighed.pass_on(&mut self.effects, &effect);
        }
    }

    /// By how much the headings of the two differ, rad.
    fn turned(&self, attitude: &UnitQuaternion<f64>) -> f64 {
        let turned = self.effects.total(&[1.0]).of(ATTITUDE);
        attitude.inverse_transform_vector(&turned).z
    }

    /// What a velocity through the water adds to a row of a log as it is turned by more than a little, m/s; nothing to others.
    ///
    /// With a its axis, b the one to the right of it, v the velocity and d what the estimate lacks of that, the angle p:
    /// cos(p) a (v + d) + sin(p) b (v + d) - a v, of which a d + p b v is what is linear.
    fn bent(&self, attitude: &UnitQuaternion<f64>, direct: &Direct, row: usize) -> f64 {
        let [along, aside] = rows::axes_of_log(direct, row);
        let [through, across] = rows::told_by_log(direct, row);
        let lacks = self.effects.total(&[1.0]);
        let by_velocity = attitude.inverse_transform_vector(&lacks.of(VELOCITY));
        let current = lacks.of(CURRENT);
        let less = |axis: &Axis| axis.body.dot(&by_velocity.xy()) - axis.level.dot(&current);
        let angle = self.turned(attitude);
        let (sin, cos) = angle.sin_cos();
        (cos - 1.0) * (through + less(&along)) + sin * less(&aside) + (sin - angle) * across
    }

    /// How likely it is now.
    fn chance_now(&self) -> f64 {
        let odds = self.chance / (1.0 - self.chance).max(DISMISSED) * self.odds.exp();
        if odds.is_finite() { odds / (1.0 + odds) } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::rows::of_log;
    use nalgebra::{Matrix3, Vector3};

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
            size: Vector2::new(0.0, 0.002),
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
            let bent = own.bent(&still, &direct, axis);
            assert!((bent - (whole - linear)[axis]).abs() < 1e-12, "{axis}: {bent}");
        }
        assert!(own.bent(&still, &rows::of_gnss_velocity(10.0), 0).abs() < 1e-12);
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
