//! The state of the filter: an estimate, the covariance of its errors, and what carries both on.

use insd_base::Time;
use nalgebra::{Matrix3, UnitQuaternion, Vector2, Vector3};

use crate::aids::View;
use crate::angular_rate::rate_variance;
use crate::config::NavConfig;
use crate::declaration::Regime;
use crate::error_state::{ATTITUDE, BERTH_OFFSET, Covariance, Errors, VELOCITY, Weighed};
use crate::increments::Increment;
use crate::initial::InitialState;
use crate::nominal::Nominal;
use crate::propagation::{self, Passage, Passing, Stretch};
use crate::sea_window::LevelWindow;
use crate::smoothing::Past;
use crate::strapdown::{self, LocalGravity, Step};
use crate::sway::Sway;
use crate::symmetry::{keep_course_unknown, keep_turn_unknown, turn_biases};

/// Correction of the attitude after which the knowledge of the biases is turned with it, rad.
const TURN: f64 = 2e-4;
/// So long the rate of turn is averaged, s: a hull slides through a turn, not through each wave.
const CALM: f64 = 10.0;
/// Gap over which the heights are not the ship's: their mean begins anew, s.
const UNSEEN: f64 = 0.5;

/// An estimate with its covariance.
#[derive(Clone, Debug)]
pub(super) struct State {
    pub(super) time: Time,
    pub(super) nominal: Nominal,
    pub(super) covariance: Covariance,
    pub(super) gravity: LocalGravity,
    /// What the covariance has not been carried over yet.
    pub(super) stretch: Stretch,
    /// Interval between propagations of the covariance, s.
    pub(super) interval: f64,
    /// What is left of a long gap that it stands in, s.
    pub(super) gap_left: f64,
    pub(super) rate: Vector3<f64>,
    pub(super) rate_variance: f64,
    /// Rate of turn without that of the waves, rad/s.
    pub(super) turn: f64,
    pub(super) level: LevelWindow,
    /// How the ship sways while she is moored, and what that has not been carried over yet, s.
    pub(super) sway: Option<Sway>,
    pub(super) unswayed: f64,
    /// Sum of corrections of the attitude that the biases have not been turned by yet, of all corrections since they
    /// were last asked for, and of those of the velocity.
    pub(super) turned: Vector3<f64>,
    pub(super) corrected: Errors,
    pub(super) absorbed: Vector3<f64>,
    /// What is kept for smoothing, where that is wanted.
    pub(super) past: Option<Box<Past>>,
}

impl State {
    pub(super) fn new(config: &NavConfig, initial: &InitialState) -> Self {
        State {
            time: initial.time,
            nominal: initial.nominal,
            covariance: initial.covariance.clone(),
            gravity: LocalGravity::around(&initial.nominal.position, &initial.nominal.geodetic()),
            stretch: Stretch::new(),
            interval: config.covariance_interval,
            gap_left: 0.0,
            rate: initial.rate,
            rate_variance: rate_variance(&config.imu),
            turn: 0.0,
            level: LevelWindow::new(&config.sea),
            sway: None,
            unswayed: 0.0,
            turned: Vector3::zeros(),
            corrected: Errors::none(),
            absorbed: Vector3::zeros(),
            past: None,
        }
    }

    /// The estimate with what aids need of it.
    pub(super) fn view(&self) -> View {
        View::new(&self.nominal, &self.rate, self.rate_variance)
    }

    /// Carries the estimate over an increment, and notes what the covariance is to be carried over.
    pub(super) fn advance(&mut self, increment: &Increment) -> Step {
        let step = strapdown::integrate(&mut self.nominal, &self.gravity, increment);
        self.stretch.add(&step);
        self.stretch.add_noise(increment);
        (self.rate, self.rate_variance) = (increment.end_rate, increment.end_rate_variance);
        self.turn += (self.rate.z - self.turn) * (increment.duration() / CALM).min(1.0);
        self.time = increment.to;
        let gap = increment.bridged.filter(|gap| *gap > UNSEEN).unwrap_or(0.0);
        let left = if self.is_in_gap() { self.gap_left.min(gap) } else { gap };
        self.gap_left = (left - increment.duration()).max(0.0);
        step
    }

    /// Whether it stands inside a gap so long that the ship may have swung out and back: both sides of it are
    /// known, and claims are those of its end.
    pub(super) fn is_in_gap(&self) -> bool {
        self.gap_left > 1e-6
    }

    /// Whether the covariance is that of the time of the estimate.
    pub(super) fn is_settled(&self) -> bool {
        self.stretch.duration <= 0.0
    }

    /// Whether it is time to carry the covariance on.
    pub(super) fn is_due(&self) -> bool {
        self.stretch.duration >= self.interval - 1e-6
    }

    /// Carries the covariance over the stretch, and whatever goes `along`.
    pub(super) fn carry(
        &mut self,
        config: &NavConfig,
        regime: Regime,
        along: impl FnOnce(&Passing<'_>),
    ) {
        let gradient = self.gravity.gradient();
        let passage = Passage { stretch: &self.stretch, gradient, config, regime };
        passage.over(&self.covariance.layout().clone(), |passing| {
            passing.covariance(&mut self.covariance);
            along(passing);
        });
        let carried = (self.covariance.layout(), config);
        propagation::relax(&mut self.nominal, self.stretch.duration, carried, &regime);
        self.unswayed += self.stretch.duration;
        self.nominal.attitude.renormalize();
    }

    /// Begins the next stretch where the estimate is now.
    pub(super) fn begin_stretch(&mut self) {
        let place = self.nominal.geodetic();
        if self.stretch.bridged > UNSEEN {
            self.level.restart();
        } else {
            self.level.add(place.height, self.stretch.duration);
        }
        self.gravity = LocalGravity::around(&self.nominal.position, &place);
        self.stretch = Stretch::new();
    }

    /// Whether the ship is taken as lying at a berth.
    pub(super) fn is_moored(&self) -> bool {
        self.covariance.has(BERTH_OFFSET)
    }

    /// Carries the swaying up to the time of the estimate.
    pub(super) fn settle_sway(&mut self) {
        if let Some(sway) = &self.sway {
            sway.propagate(&mut self.covariance, self.unswayed);
            sway.relax(&mut self.nominal, self.unswayed);
        }
        self.unswayed = 0.0;
    }

    /// Takes the estimate to be off by an error.
    pub(super) fn correct(&mut self, error: &Errors) {
        self.nominal.inject(error);
        self.corrected += error;
        self.absorbed += error.of(VELOCITY);
        self.past.iter_mut().for_each(|past| past.note(error));
    }

    /// Brings in an innovation that was weighed with its covariance; returns the error that was found.
    pub(super) fn absorb(&mut self, weighed: &Weighed) -> Errors {
        let error = weighed.update(&mut self.covariance);
        self.take_on(&error);
        error
    }

    /// Takes on an error that the covariance has absorbed.
    pub(super) fn take_on(&mut self, error: &Errors) {
        self.correct(error);
        if self.is_moored() {
            let down = -self.nominal.position.normalize();
            keep_turn_unknown(&mut self.covariance, error, &down);
        }
        self.turned += error.of(ATTITUDE);
        if self.turned.norm() > TURN {
            let now = self.nominal.attitude;
            let before = UnitQuaternion::new(-self.turned) * now;
            let axes = |attitude: UnitQuaternion<f64>| attitude.to_rotation_matrix().into_inner();
            turn_biases(&mut self.covariance, &axes(before), &axes(now));
            self.turned = Vector3::zeros();
        }
    }

    /// Velocity, ECEF axes, and current, north and east, m/s.
    pub(super) fn course(&self) -> (Vector3<f64>, Vector2<f64>) {
        (self.nominal.velocity, self.nominal.current)
    }

    /// A log has corrected what was [`Self::course`] before.
    pub(super) fn keep_course_unknown(
        &mut self,
        (velocity, current): &(Vector3<f64>, Vector2<f64>),
    ) {
        if !self.is_moored() {
            let down = -self.nominal.position.normalize();
            let by = (self.nominal.velocity - velocity, self.nominal.current - current);
            keep_course_unknown(&mut self.covariance, &by.0, &by.1, &down);
        }
    }

    /// Takes back a correction that was made by mistake, and is as unsure of it as it is large.
    pub(super) fn take_back(&mut self, correction: &Errors) {
        self.correct(&-correction);
        self.covariance.spread(correction);
    }

    /// Becomes an estimate that is off from it by an error, with another covariance.
    pub(super) fn become_other(&mut self, error: &Errors, covariance: &Covariance) {
        self.correct(error);
        self.covariance.clone_from(covariance);
        self.turned = Vector3::zeros();
    }

    /// The estimate inside a gap, from which on the claim grows: as sure of its attitude as of the part of the gap that is over.
    pub(super) fn widen(&mut self, c_eb: &Matrix3<f64>, noise: &Vector3<f64>) {
        let turned = c_eb * Matrix3::from_diagonal(noise) * c_eb.transpose();
        ATTITUDE.add(&mut self.covariance, &turned);
    }
}
