//! The covariance run ahead of the data: how sure the filter will be if things stay as they are.
//!
//! The very same propagation and updates as with data, in longer steps and for a ship that lies still:
//! her attitude is what it is now, her specific force is gravity's, her rotation the Earth's. The
//! length of the steps is limited by what the transition leaves out: a gyro error moves the position by
//! g dt^3 / 6 within one step, which the steps after it make good.

use insd_base::earth;
use nalgebra::{Vector1, Vector3};

use super::Filter;
use super::velocity_epoch::VelocityEpoch;
use crate::aids::View;
use crate::aids::gnss_velocity::{self, VelocityFix};
use crate::declaration::Regime;
use crate::error_state::{ATTITUDE, Covariance, Innovation, Jacobian};
use crate::propagation::{Passage, Stretch};

/// A filter's covariance on its way into the future.
#[derive(Clone, Debug)]
pub struct Ahead<'a> {
    filter: &'a Filter,
    view: View,
    regime: Regime,
    second: Stretch,
    covariance: Covariance,
}

impl Filter {
    /// The estimate as if the ship did not turn.
    fn still_view(&self) -> View {
        let moving = self.view();
        let rate = moving.c_eb.transpose() * earth::rate_e();
        View::new(&self.state.nominal, &rate, moving.rate_variance)
    }

    /// The covariance with the swaying carried up to the time of the estimate.
    fn swayed_covariance(&self) -> Covariance {
        let mut covariance = self.state.covariance.clone();
        covariance.break_trail();
        if let Some(sway) = &self.state.sway {
            sway.propagate(&mut covariance, self.state.unswayed);
        }
        covariance
    }

    /// The covariance from now on, for a ship that lies still.
    #[must_use]
    pub fn ahead(&self) -> Ahead<'_> {
        let view = self.still_view();
        let gravity = earth::normal_gravity(view.geodetic.latitude, view.geodetic.height);
        let force = view.c_ne.transpose() * Vector3::new(0.0, 0.0, -gravity);
        let to_body = view.c_eb.transpose();
        let second = Stretch {
            duration: 1.0,
            c_eb: view.c_eb,
            force,
            rotation: to_body * earth::rate_e(),
            velocity: to_body * force,
            ..Stretch::new()
        };
        Ahead {
            filter: self,
            view,
            regime: self.regime(),
            second,
            covariance: self.swayed_covariance(),
        }
    }
}

impl Ahead<'_> {
    /// The estimate from which it started.
    #[must_use]
    pub fn view(&self) -> &View {
        &self.view
    }

    /// Moves on by `dt` seconds.
    pub fn advance(&mut self, dt: f64) {
        let stretch = Stretch {
            duration: dt,
            c_eb: self.second.c_eb * dt,
            force: self.second.force * dt,
            rotation: self.second.rotation * dt,
            velocity: self.second.velocity * dt,
            ..self.second
        };
        let (gradient, config) = (self.filter.state.gravity.gradient(), &self.filter.config);
        let regime = self.regime;
        let passage = Passage { stretch: &stretch, gradient, config, regime };
        passage.propagate(&mut self.covariance);
        if let Some(sway) = &self.filter.state.sway {
            sway.propagate(&mut self.covariance, dt);
        }
    }

    /// Takes what a measurement of this kind will tell, whatever its value.
    pub fn observe(&mut self, innovation: &Innovation) {
        if let Some(weighed) = innovation.weigh(&self.covariance) {
            let _ = weighed.update(&mut self.covariance);
        }
    }

    /// Takes the GNSS velocities of `dt` seconds as one, if there are any these days.
    ///
    /// A heading error turns the computed motion in the waves, of root mean square `speed` over the
    /// ground, m/s: dv = phi_D k x v. The run ahead lies still, so what each velocity of noise sigma
    /// tells of that is a heading of variance (sigma / speed)^2 of its own.
    pub fn observe_gnss_velocity(&mut self, speed: f64, dt: f64) {
        let filter = self.filter;
        let fresh = |epoch: &VelocityEpoch| {
            (filter.state.time - epoch.time).as_seconds() < super::mode::GNSS_TIMEOUT
        };
        let Some(epoch) = filter.receiver.velocity_epoch.filter(fresh) else { return };
        let fix = VelocityFix { acceleration: Vector3::zeros(), ..epoch.fix };
        let mut sample = gnss_velocity::innovation(&self.view, &fix, &filter.antenna_lever());
        let share = (epoch.spacing / dt).min(1.0);
        sample.r *= share;
        self.observe(&sample);
        let variance = fix.white.xy().norm_squared() * 0.5 / (speed * speed).max(1e-9);
        let h = Jacobian::none(1).with(ATTITUDE, &self.view.c_ne.row(2).into_owned());
        let noise = Vector1::new(variance * share);
        self.observe(&Innovation::new(&Vector1::zeros(), h, &noise));
    }

    /// 1-sigma of the rotation about down, rad: the heading of a ship that is nearly level.
    #[must_use]
    pub fn heading_std(&self) -> f64 {
        heading_std(&self.view, &self.covariance)
    }
}

/// 1-sigma of the rotation about down, rad, of an estimate with a covariance.
pub(super) fn heading_std(view: &View, covariance: &Covariance) -> f64 {
    let down = view.c_ne.row(2).into_owned();
    ATTITUDE.covariance_in(covariance, &down).x.max(0.0).sqrt()
}
