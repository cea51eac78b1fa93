//! The error-state Kalman filter around the strapdown: blocks 23-32 of JP3375720B2.

use std::sync::Arc;

use insd_base::{
    Body, Ecef, Message, Ned, Received, Rejection, Solution, SolutionSigma, Time, earth,
};
use insd_estimation::Gate;
use nalgebra::{Matrix3, UnitQuaternion, Vector3};

use crate::aids::View;
use crate::angular_rate::rate_variance;
use crate::antenna::AntennaMotion;
use crate::config::NavConfig;
use crate::echo::Echo;
use crate::error_state::{ATTITUDE, Covariance, Errors, Innovation, VELOCITY, Weighed};
use crate::increments::Increment;
use crate::initial::InitialState;
use crate::judge::{Judge, agitate};
use crate::leap::LeapWatch;
use crate::nominal::Nominal;
use crate::own_word::OwnWord;
use crate::pace::Pace;
use crate::propagation::{self, Passage, Regime, Stretch};
use crate::report::{Outcome, Report};
use crate::sea_window::LevelWindow;
use crate::separate_bias::SeparateBias;
use crate::slip::Slip;
use crate::solution_sigma::solution_sigma;
use crate::strapdown::{self, LocalGravity};
use crate::sway::Sway;
use crate::symmetry::{keep_turn_unknown, turn_biases};
use crate::timeline::Estimator;
use crate::trust::Trust;
use crate::wheels::Wheels;
use ahead::VelocityEpoch;
pub use entry::Judged;
pub(crate) use entry::NO_INNOVATION;
use entry::detail;
use found_lever::FoundLever;

pub mod ahead;
mod bent;
mod entry;
mod estimates;
mod found_lever;
mod gnss;
mod installation;
mod joined;
pub mod judged;
pub mod kept;
mod leaps;
mod level;
mod mode;
mod moored;
mod motion;
mod others;
mod receivers;
mod sideways;
mod slow;
mod states;

/// An estimate, its covariance and what is needed to carry both on.
#[derive(Clone, Debug)]
pub struct Filter {
    config: NavConfig,
    gate: Gate,
    time: Time,
    nominal: Nominal,
    covariance: Covariance,
    gravity: LocalGravity,
    stretch: Stretch,
    /// What is left of a long gap that it stands in, s.
    gap_left: f64,
    rate: Vector3<f64>,
    rate_variance: f64,
    trust: Trust,
    rtk: Option<bool>,
    /// By how much the sigmas that slow errors are told in, of position, velocity and heading, are larger than stated,
    /// as variances.
    slow_noise: [f64; 3],
    level: LevelWindow,
    sway: Option<Sway>,
    navigating: bool,
    antenna: AntennaMotion,
    /// By how much the fixes of its receiver are set back, s; `None` before the first.
    redated: Option<f64>,
    /// When a log or another reference was last used, and when one that tells how she moves, not where she points.
    last_relative: Option<Time>,
    last_motion: Option<Time>,
    last_water: Option<Time>,
    /// When the motion across was last assumed, and when a log last told it.
    held: Option<Time>,
    told_across: Option<Time>,
    pace: Pace,
    lurch: Pace,
    slip: Slip,
    wheels: Wheels,
    /// When another reference last told a position.
    last_reference: Option<Time>,
    turned: Vector3<f64>,
    corrected: Errors,
    interval: f64,
    unswayed: f64,
    absorbed: Vector3<f64>,
    velocity_epoch: Option<VelocityEpoch>,
    /// Who is to be believed, while the filter navigates and nothing holds the ship; what it has not been told
    /// yet: the way since, and corrections.
    judge: Option<Arc<Judge>>,
    /// Stands in for it otherwise.
    leap: LeapWatch,
    own_word: OwnWord,
    echo: Echo,
    judged_since: Time,
    /// The heading was found with a reference that nothing bears out yet.
    heading_doubted: bool,
    unjudged: Stretch,
    owed: Errors,
    /// Sigmas that cover all that may be, while somebody may lie.
    covered: Option<SolutionSigma>,
    /// What wrong constants of the installation would do, while the filter navigates.
    bias: Option<SeparateBias>,
    /// What the epochs of the receiver are suspected of being late by, 1-sigma, s.
    lateness: f64,
    /// Whether they told that the antenna sits elsewhere, or speaks late.
    mended: bool,
    found_lever: FoundLever,
    /// Whether they told of what no ship has.
    is_impossible: bool,
    /// 1-sigma of the lever arm of the log, m, if it was found to be otherwise than configured.
    log_lever_std: Option<Vector3<f64>>,
}

/// Correction of the attitude after which the knowledge of the biases is turned with it, rad.
const TURN: f64 = 2e-4;

/// Gap over which the heights are not the ship's: their mean begins anew, s.
const UNSEEN: f64 = 0.5;

impl Filter {
    /// A filter from an initial state.
    #[must_use]
    pub fn new(config: &NavConfig, initial: &InitialState) -> Self {
        let mut trust = Trust::default();
        initial.gnss_used.iter().for_each(|time| trust.used(*time));
        Filter {
            config: *config,
            gate: Gate::new(config.gate.probability),
            time: initial.time,
            nominal: initial.nominal,
            covariance: initial.covariance.clone(),
            gravity: LocalGravity::around(&initial.nominal.position, &initial.nominal.geodetic()),
            stretch: Stretch::new(),
            gap_left: 0.0,
            rate: initial.rate,
            rate_variance: rate_variance(&config.imu),
            trust,
            rtk: None,
            slow_noise: [1.0; 3],
            level: LevelWindow::new(&config.sea),
            sway: None,
            navigating: false,
            antenna: AntennaMotion::default(),
            redated: None,
            last_relative: None,
            last_motion: None,
            last_water: None,
            held: None,
            told_across: None,
            pace: Pace::default(),
            lurch: Pace::default(),
            slip: Slip::default(),
            wheels: Wheels::default(),
            last_reference: None,
            turned: Vector3::zeros(),
            corrected: Errors::none(),
            interval: config.covariance_interval,
            unswayed: 0.0,
            absorbed: Vector3::zeros(),
            velocity_epoch: None,
            judge: None,
            leap: LeapWatch::default(),
            own_word: OwnWord::default(),
            echo: Echo::default(),
            judged_since: initial.time,
            heading_doubted: false,
            unjudged: Stretch::new(),
            owed: Errors::none(),
            covered: None,
            bias: None,
            lateness: 0.0,
            mended: false,
            found_lever: FoundLever::default(),
            is_impossible: false,
            log_lever_std: None,
        }
    }

    /// Instant of the estimate.
    #[must_use]
    pub fn time(&self) -> Time {
        self.time
    }

    /// Turn-on bias of the gyros by their data sheet, 1-sigma, rad/s.
    #[must_use]
    pub fn gyro_bias_std(&self) -> f64 {
        self.config.imu.gyro.bias_std
    }

    /// The estimate.
    #[must_use]
    pub fn nominal(&self) -> &Nominal {
        &self.nominal
    }

    /// Covariance of the estimate's errors at its last propagation.
    #[must_use]
    pub fn covariance(&self) -> &Covariance {
        &self.covariance
    }

    /// Ends the search for the heading: the filter now stands for itself, may judge the sensors'
    /// honesty and keeps its covariance as fresh as navigation needs it.
    pub fn begin_navigation(&mut self) {
        self.navigating = true;
        self.interval = self.config.covariance_interval;
        self.bias = Some(SeparateBias::of_unknown_origin(&self.view()));
        self.be_judged();
    }

    /// Propagates the covariance only every so many seconds until navigation begins: for searches
    /// that run many filters.
    pub fn slow_down(&mut self, interval: f64) {
        self.interval = interval;
    }

    /// Whether the covariance is that of the time of the estimate.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        self.stretch.duration <= 0.0
    }

    /// Brings the covariance up to the time of the estimate.
    pub fn settle(&mut self) {
        if self.is_settled() {
            return;
        }
        let regime = Regime { rtk: self.is_rtk() };
        let passage = Passage {
            stretch: &self.stretch,
            gradient: self.gravity.gradient(),
            config: &self.config,
            regime,
        };
        passage.over(&self.covariance.layout().clone(), |passing| {
            passing.covariance(&mut self.covariance);
            self.bias.iter_mut().for_each(|bias| passing.effects(bias.response_mut()));
            if self.judge.is_some() {
                passing.errors(&mut self.owed);
            }
        });
        if self.is_restless() {
            agitate(&mut self.covariance, self.stretch.duration);
        }
        propagation::relax(&mut self.nominal, self.stretch.duration, &self.config, &regime);
        self.unswayed += self.stretch.duration;
        self.nominal.attitude.renormalize();
        self.note_antenna_motion();
        let place = self.nominal.geodetic();
        if self.stretch.bridged > UNSEEN {
            self.level.restart();
        } else {
            self.level.add(place.height, self.stretch.duration);
        }
        self.gravity = LocalGravity::around(&self.nominal.position, &place);
        self.stretch = Stretch::new();
    }

    /// Follows how much is left of a long gap.
    fn pass_gap(&mut self, increment: &Increment) {
        let gap = increment.bridged.filter(|gap| *gap > UNSEEN).unwrap_or(0.0);
        let left = if self.is_in_gap() { self.gap_left.min(gap) } else { gap };
        self.gap_left = (left - increment.duration()).max(0.0);
    }

    /// Whether it stands inside a gap so long that the ship may have swung out and back: both sides of it are
    /// known, and claims are those of its end.
    fn is_in_gap(&self) -> bool {
        self.gap_left > 1e-6
    }

    /// The estimate with what aids need of it.
    #[must_use]
    pub fn view(&self) -> View {
        View::new(&self.nominal, &self.rate, self.rate_variance)
    }

    /// Applies an innovation if it passes the chi-square gate and nothing else speaks against it.
    /// The covariance must be settled.
    fn gated(&mut self, innovation: &Innovation, refused: Option<Rejection>) -> Judged {
        let weighed = innovation.weigh(&self.covariance);
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
        if let Some(bias) = &mut self.bias {
            bias.absorb(weighed, &weighed.gain());
        }
        let error = weighed.update(&mut self.covariance);
        self.nominal.inject(&error);
        self.corrected += &error;
        self.owed += &error;
        self.absorbed += error.of(VELOCITY);
        if self.sway.is_some() {
            let down = -self.nominal.position.normalize();
            keep_turn_unknown(&mut self.covariance, &error, &down);
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

    /// Brings in a condition from outside, such as that the ship lies at her berth: judged and
    /// absorbed as a measurement.
    pub fn impose(&mut self, innovation: &Innovation) -> Judged {
        self.settle_sway();
        let judged = self.gated(innovation, None);
        self.note(judged.outcome);
        judged
    }

    /// Log-likelihood of a condition from outside that is not to be brought in.
    pub fn decline(&mut self, innovation: &Innovation) -> f64 {
        let weighed = innovation.weigh(&self.covariance);
        self.note(Outcome::Rejected(Rejection::SourceSuspect));
        weighed.map_or(0.0, |weighed| self.bounded_likelihood(&weighed))
    }

    /// Sum of all corrections of the estimate since the last call.
    pub fn take_correction(&mut self) -> Errors {
        std::mem::take(&mut self.corrected)
    }

    /// Takes back a correction that was made by mistake, and is as unsure of it as it is large.
    pub fn take_back(&mut self, correction: &Errors) {
        self.settle_sway();
        self.nominal.inject(&-correction);
        self.corrected -= correction;
        self.absorbed -= correction.of(VELOCITY);
        self.covariance.spread(correction);
    }

    fn bounded_likelihood(&self, weighed: &Weighed) -> f64 {
        let bounded = weighed.nis().min(self.gate.limit(weighed.rows()));
        -0.5 * bounded - weighed.log_root_determinant()
    }

    /// Whether GNSS positions come from fixed carrier ambiguities.
    fn is_rtk(&self) -> bool {
        self.rtk == Some(true)
    }

    /// Velocity as if it had never been corrected, ECEF axes, m/s: it drifts, but does not step.
    #[must_use]
    pub fn smooth_velocity(&self) -> Vector3<f64> {
        self.nominal.velocity - self.absorbed
    }

    /// Claimed 1-sigma of the heading, rad.
    #[must_use]
    pub fn heading_std(&self) -> f64 {
        self.solution().sigma.heading
    }
}

impl Estimator for Filter {
    fn advance(&mut self, increment: &Increment) {
        let step = strapdown::integrate(&mut self.nominal, &self.gravity, increment);
        self.stretch.add(&step);
        self.stretch.add_noise(increment);
        if self.judge.is_some() {
            self.unjudged.add(&step);
            self.unjudged.add_noise(increment);
        }
        (self.rate, self.rate_variance) = (increment.end_rate, increment.end_rate_variance);
        self.time = increment.to;
        self.pass_gap(increment);
        if self.stretch.duration >= self.interval - 1e-6 {
            self.settle();
        }
        self.hold_to_wheels();
        self.look_at_pace();
        self.look_at_slip();
        if self.level.is_full() {
            self.settle();
            self.hold_sea_level();
        }
    }

    fn apply(&mut self, received: &Received) -> Report {
        self.settle();
        let mut report = Report::default();
        match &received.message {
            Message::Imu(_) => {}
            Message::Gnss(fix) if fix.rank > 0 => self.compare(fix, received.source),
            Message::Gnss(fix) => self.apply_gnss(fix, received.source, &mut report),
            Message::Log(log) => self.apply_log(log, received.source, &mut report),
            Message::Reference(r) => self.apply_reference(r, received.source, &mut report),
        }
        self.heed();
        report
    }

    fn solution(&self) -> Solution {
        let acceleration = self.antenna.acceleration(self.time, &self.antenna_velocity());
        let dating = self.dating();
        let view = self.view().at_gnss_time(&acceleration, &dating);
        let sigma = solution_sigma(&view, &acceleration, &dating, &self.covariance);
        let sigma = self.covered.map_or(sigma, |covered| sigma.greatest(&covered));
        let v_n = view.v_n();
        let turn_of_n = view.c_nb().transpose() * earth::transport_rate(&view.geodetic, &v_n);
        Solution {
            time: self.time,
            position: view.geodetic,
            velocity: Ned(v_n),
            attitude: view.attitude(),
            rate: Body(view.rate - turn_of_n),
            sigma,
            mode: self.mode(),
            judgement: self.judgement(),
        }
    }

    fn solution_at(&self, increment: &Increment, at: Time) -> Solution {
        let mut ahead = self.clone();
        if increment.bridged.is_some() && at > increment.from && at < increment.to {
            // inside a gap the claim grows from one output to the next
            let c_eb = self.nominal.c_eb();
            ahead.advance(&increment.split(at).0);
            ahead.settle();
            let noise = increment.rate_noise * (at - increment.from).as_seconds();
            let turned = c_eb * Matrix3::from_diagonal(&noise) * c_eb.transpose();
            ATTITUDE.add(&mut ahead.covariance, &turned);
            return ahead.solution();
        }
        ahead.nominal = strapdown::extrapolated(&self.nominal, increment, at);
        ahead.time = at;
        ahead.solution()
    }
}

/// The position of the IMU that a fix of its antenna means, ECEF, m.
fn imu_position(view: &View, antenna: &insd_base::Geodetic, lever: &Vector3<f64>) -> Ecef {
    Ecef(earth::ecef(antenna).0 - view.c_eb * lever)
}
