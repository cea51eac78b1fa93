//! The error-state Kalman filter around the strapdown: blocks 23-32 of JP3375720B2.

use std::sync::Arc;

use insd_base::{
    Body, Ecef, Message, MotionCovariance, Ned, Received, Rejection, Solution, Time, earth,
};
use insd_estimation::Gate;
use nalgebra::Vector3;

use crate::aids::View;
use crate::config::NavConfig;
use crate::declaration::Regime;
use crate::disturbance::{PrefilterConfig, WhiteningConfig};
use crate::error_state::{Covariance, Errors, Innovation, Weighed};
use crate::increments::Increment;
use crate::initial::InitialState;
use crate::judge::agitate;
use crate::nominal::Nominal;
use crate::report::{Outcome, Report};
use crate::separate_bias::SeparateBias;
use crate::solution_sigma::solution_covariance;
use crate::strapdown;
use crate::timeline::Estimator;
use antennas_followed::Antennas;
use camera_standing::Camera;
use conduct::Conduct;
use court::Court;
pub use entry::Judged;
pub(crate) use entry::NO_INNOVATION;
use entry::detail;
use heard::Heard;
use held::Held;
use installation::Installation;
use odometry_standing::Odometry;
use ranging_standing::Rangings;
use receiver::Receiver;
use rtk_standing::RtkStanding;
use satellites::Satellites;
use sources::Sources;
use state::State;

pub mod ahead;
mod antennas;
mod antennas_followed;
mod bent;
mod camera;
mod camera_sight;
mod camera_standing;
pub mod checkpoint;
mod companion;
mod conduct;
mod court;
mod entry;
mod estimates;
mod found_lever;
mod gnss;
mod heard;
mod held;
mod hidden;
mod holding;
mod installation;
mod joined;
pub mod judged;
mod keeping;
mod landmarks;
mod leaps;
pub mod learnt;
mod level;
mod mending;
mod misconduct;
mod misplaced;
mod mode;
mod moored;
mod motion;
mod odometry;
mod odometry_standing;
mod others;
mod protected;
mod ranges;
mod ranging_standing;
mod rangings;
mod receiver;
mod receivers;
mod rtk;
mod rtk_standing;
mod satellites;
mod sideways;
mod slow;
mod sources;
mod state;
pub mod state_estimates;
mod states;
mod temperature;
mod unrest;
mod velocity_epoch;

/// An estimate and its covariance, what is known of who tells about them, and who judges that.
#[derive(Clone, Debug)]
pub struct Filter {
    config: NavConfig,
    gate: Gate,
    state: State,
    /// The receiver in use; others are compared with what is made of it.
    receiver: Receiver,
    /// By how much the sigma that the slow error of a compass is told in is larger than stated, as a variance.
    compass_noise: f64,
    heard: Heard,
    conduct: Conduct,
    installation: Installation,
    court: Court,
    satellites: Satellites,
    /// What is known of the place and not told yet.
    held: Held,
    /// How far places against a base are believed.
    rtk: RtkStanding,
    /// Several antennas, as they are followed.
    antennas: Antennas,
    /// Docking aids, and what they measure to.
    rangings: Rangings,
    /// What a camera sees.
    camera: Arc<Camera>,
    /// From where a visual odometry measures.
    odometry: Odometry,
    /// What was used when.
    sources: Sources,
    /// While there are ranges, the same ship without them.
    companion: Option<Arc<Filter>>,
    navigating: bool,
}

impl Filter {
    /// A filter from an initial state.
    #[must_use]
    pub fn new(config: &NavConfig, initial: &InitialState) -> Self {
        Filter {
            config: *config,
            gate: Gate::new(config.gate.probability),
            state: State::new(config, initial),
            receiver: Receiver::new(initial.gnss_used),
            compass_noise: 1.0,
            heard: Heard::default(),
            conduct: Conduct::default(),
            installation: Installation::default(),
            court: Court::new(initial.time),
            satellites: Satellites::default(),
            held: Held::default(),
            rtk: RtkStanding::default(),
            antennas: Antennas::default(),
            rangings: Rangings::default(),
            camera: Arc::default(),
            odometry: Odometry::default(),
            sources: Sources::default(),
            companion: None,
            navigating: false,
        }
    }

    /// Instant of the estimate.
    #[must_use]
    pub fn time(&self) -> Time {
        self.state.time
    }

    /// Turn-on bias of the gyros by their data sheet, 1-sigma, rad/s.
    #[must_use]
    pub fn gyro_bias_std(&self) -> f64 {
        self.config.imu.gyro.bias_std
    }

    /// How the sea is taken out of the velocity at the berth, where that is the method.
    #[must_use]
    pub fn prefilter(&self) -> &PrefilterConfig {
        &self.config.prefilter
    }

    /// How the displacement at the berth is whitened, where that is the method.
    #[must_use]
    pub fn whitening(&self) -> &WhiteningConfig {
        &self.config.whitening
    }

    /// The estimate.
    #[must_use]
    pub fn nominal(&self) -> &Nominal {
        &self.state.nominal
    }

    /// Covariance of the estimate's errors at its last propagation.
    #[must_use]
    pub fn covariance(&self) -> &Covariance {
        &self.state.covariance
    }

    /// Ends the search for the heading: the filter now stands for itself, may judge the sensors'
    /// honesty and keeps its covariance as fresh as navigation needs it.
    pub fn begin_navigation(&mut self) {
        self.navigating = true;
        self.state.interval = self.config.covariance_interval;
        self.installation.bias = Some(SeparateBias::of_unknown_origin(&self.view()));
        self.be_judged();
        if let Some(plan) = self.config.smoothing {
            self.settle();
            self.keep_past(plan, None);
        }
    }

    /// Propagates the covariance only every so many seconds until navigation begins: for searches
    /// that run many filters.
    pub fn slow_down(&mut self, interval: f64) {
        self.state.interval = interval;
    }

    /// Whether the covariance is that of the time of the estimate.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        self.state.is_settled()
    }

    /// Brings the covariance up to the time of the estimate.
    pub fn settle(&mut self) {
        if self.is_settled() {
            return;
        }
        let regime = self.regime();
        let Filter { config, state, installation, court, .. } = self;
        state.carry(config, regime, |passing| {
            installation.bias.iter_mut().for_each(|bias| passing.effects(bias.response_mut()));
            if court.judge.is_some() {
                passing.errors(&mut court.owed);
            }
        });
        if court.is_restless() {
            agitate(&mut state.covariance, state.stretch.duration);
        }
        self.note_antenna_motion();
        self.state.begin_stretch();
        self.keep_epoch_if_due();
    }

    fn regime(&self) -> Regime {
        Regime { rtk: self.receiver.is_rtk(), warmer: self.state.nominal.warmth.above }
    }

    /// The estimate with what aids need of it.
    #[must_use]
    pub fn view(&self) -> View {
        self.state.view()
    }

    /// Applies an innovation if it passes the chi-square gate and nothing else speaks against it.
    /// The covariance must be settled.
    fn gated(&mut self, innovation: &Innovation, refused: Option<Rejection>) -> Judged {
        let weighed = innovation.weigh(&self.state.covariance);
        self.gated_as(weighed.as_ref(), refused)
    }

    /// The same of one that is weighed, if it can be.
    fn gated_as(&mut self, weighed: Option<&Weighed>, refused: Option<Rejection>) -> Judged {
        let Some(weighed) = weighed else {
            let outcome = Outcome::Rejected(Rejection::OutOfRange);
            return Judged { outcome, log_likelihood: 0.0, innovation: NO_INNOVATION };
        };
        let passes = weighed.nis() <= self.gate.limit(weighed.rows());
        let refused = refused.or((!passes).then_some(Rejection::ChiSquare));
        let log_likelihood = self.bounded_likelihood(weighed);
        if refused.is_none() {
            self.absorb(weighed);
        }
        let outcome = refused.map_or(Outcome::Accepted, Outcome::Rejected);
        Judged { outcome, log_likelihood, innovation: detail(weighed) }
    }

    fn absorb(&mut self, weighed: &Weighed) {
        if let Some(bias) = &mut self.installation.bias {
            bias.absorb(weighed);
        }
        self.court.owed += &self.state.absorb(weighed);
    }

    /// Brings in a condition from outside, such as that the ship lies at her berth: judged and
    /// absorbed as a measurement.
    pub fn impose(&mut self, innovation: &Innovation) -> Judged {
        self.settle_sway();
        let weighed = innovation.weigh(&self.state.covariance);
        self.impose_weighed(weighed.as_ref())
    }

    /// The same of one that was weighed as the filter is now, if it could be.
    pub fn impose_weighed(&mut self, weighed: Option<&Weighed>) -> Judged {
        let judged = self.gated_as(weighed, None);
        self.note(judged.outcome);
        judged
    }

    /// Log-likelihood of a condition from outside that is not to be brought in.
    pub fn decline(&mut self, weighed: &Weighed) -> f64 {
        self.note(Outcome::Rejected(Rejection::SourceSuspect));
        self.bounded_likelihood(weighed)
    }

    /// Sum of all corrections of the estimate since the last call.
    pub fn take_correction(&mut self) -> Errors {
        std::mem::take(&mut self.state.corrected)
    }

    /// Takes back a correction that was made by mistake, and is as unsure of it as it is large.
    pub fn take_back(&mut self, correction: &Errors) {
        self.settle_sway();
        self.state.take_back(correction);
    }

    /// One that does not pass the gate counts as one at its limit.
    fn bounded_likelihood(&self, weighed: &Weighed) -> f64 {
        let bounded = weighed.nis().min(self.gate.limit(weighed.rows()));
        -0.5 * bounded - weighed.log_root_determinant()
    }

    /// The estimate in the time of GNSS, with the acceleration of the antenna, ECEF axes, m/s^2.
    fn dated_view(&self) -> (View, Vector3<f64>) {
        let antenna = self.antenna_velocity();
        let acceleration = self.receiver.antenna.acceleration(self.state.time, &antenna, 0.0);
        (self.view().at_gnss_time(&acceleration, &self.dating()), acceleration)
    }

    /// How the errors of [`Estimator::solution`] hang together.
    #[must_use]
    pub fn motion_covariance(&self) -> MotionCovariance {
        let (view, acceleration) = self.dated_view();
        solution_covariance(&view, &acceleration, &self.dating(), &self.state.covariance)
    }

    /// Velocity as if it had never been corrected, ECEF axes, m/s: it drifts, but does not step.
    #[must_use]
    pub fn smooth_velocity(&self) -> Vector3<f64> {
        self.state.nominal.velocity - self.state.absorbed
    }

    /// Claimed 1-sigma of the heading, rad.
    #[must_use]
    pub fn heading_std(&self) -> f64 {
        self.solution().sigma.heading
    }
}

impl Estimator for Filter {
    fn advance(&mut self, increment: &Increment) {
        if let Some(companion) = self.companion_mut() {
            companion.advance(increment);
        }
        // before that filters are joined: they have to have the same states
        if let Some(celsius) = increment.celsius.filter(|_| self.navigating) {
            self.feel(celsius);
        }
        self.keep_rows(increment);
        let step = self.state.advance(increment);
        self.court.note(&step, increment);
        if self.state.is_due() {
            self.settle();
            self.forget_silent_camera();
        }
        self.hold_to_wheels();
        self.look_at_pace();
        self.look_at_slip();
        if self.state.level.is_full() {
            self.settle();
            self.keeping_course(Self::hold_sea_level);
        }
    }

    fn apply(&mut self, received: &Received) -> Report {
        self.settle();
        if let Some(report) = self.accompany(received) {
            return report;
        }
        let mut report = Report::default();
        match &received.message {
            Message::Imu(_) | Message::Base(_) => {}
            Message::Rtk(told) => self.apply_rtk(told, received.source, &mut report),
            Message::Compass(told) => self.apply_compass(told, received.source, &mut report),
            Message::Gnss(fix) if fix.rank > 0 => self.compare(fix, received.source),
            // its own receiver's fix is made of the same ranges, and tells no more than whose antenna it is
            Message::Gnss(fix) if self.satellites.are_fresh(self.state.time) => {
                self.note_antenna(fix);
                Self::pass_over(fix, received.source, &mut report);
            }
            Message::Gnss(fix) => {
                self.satellites.replaced_by_fix();
                self.apply_gnss(fix, received.source, &mut report);
            }
            Message::Log(log) => {
                self.keeping_course(|own| own.apply_log(log, received.source, &mut report));
            }
            Message::Reference(r) => self.apply_reference(r, received.source, &mut report),
            Message::Ranges(ranges) => self.apply_ranges(ranges, received.source, &mut report),
            Message::Ranging(told) => self.apply_ranging(told, received.source, &mut report),
            Message::Camera(frame) => self.apply_camera(frame, received.source, &mut report),
            Message::Odometry(step) => self.apply_odometry(step, received.source, &mut report),
        }
        self.hold_back();
        self.forget_silent_marks();
        self.sources.note(self.state.time, &report, &received.message);
        self.heed();
        report
    }

    fn solution(&self) -> Solution {
        let (view, acceleration) = self.dated_view();
        let v_n = view.v_n();
        let turn_of_n = view.c_nb().transpose() * earth::transport_rate(&view.geodetic, &v_n);
        let (sigma, hidden) = self.claims(&view, &acceleration);
        Solution {
            time: self.state.time,
            position: self.told_place(&view),
            velocity: Ned(v_n),
            attitude: view.attitude(),
            rate: Body(view.rate - turn_of_n),
            sigma,
            mode: self.mode(),
            judgement: self.judgement(),
            source: self.source(),
            hidden,
        }
    }

    fn solution_at(&self, increment: &Increment, at: Time) -> Solution {
        let mut ahead = self.clone();
        if increment.bridged.is_some() && at > increment.from && at < increment.to {
            // inside a gap the claim grows from one output to the next
            let c_eb = self.state.nominal.c_eb();
            ahead.advance(&increment.split(at).0);
            ahead.settle();
            let noise = increment.rate_noise * (at - increment.from).as_seconds();
            ahead.state.widen(&c_eb, &noise);
            return ahead.solution();
        }
        ahead.state.nominal = strapdown::extrapolated(&self.state.nominal, increment, at);
        ahead.state.time = at;
        ahead.solution()
    }
}

/// The position of the IMU that a fix of its antenna means, ECEF, m.
fn imu_position(view: &View, antenna: &insd_base::Geodetic, lever: &Vector3<f64>) -> Ecef {
    Ecef(earth::ecef(antenna).0 - view.c_eb * lever)
}
