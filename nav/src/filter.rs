//! The error-state Kalman filter around the strapdown: blocks 23-32 of JP3375720B2.

use insd_base::{
    Body, Ecef, Message, Mode, Ned, Received, Rejection, Solution, Source, Time, earth,
};
use nalgebra::{SMatrix, Vector3};

use crate::aids::{View, sea_level};
use crate::antenna::AntennaMotion;
use crate::config::NavConfig;
use crate::error_state::{Covariance, POSITION, SEA_LEVEL, VELOCITY};
use crate::gate::ChiSquareGate;
use crate::increments::Increment;
use crate::initial::InitialState;
use crate::innovation::{Innovation, Weighed};
use crate::nominal::Nominal;
use crate::propagation::{self, Regime, Stretch, markov_decay};
use crate::report::{AidReport, Outcome, Report};
use crate::sea_window::LevelWindow;
use crate::solution_sigma::solution_sigma;
use crate::spread::Spread;
use crate::strapdown::{self, LocalGravity};
use crate::timeline::Estimator;
use crate::trust::Trust;

mod gnss;
mod others;

/// An estimate, its covariance and what is needed to carry both on.
#[derive(Clone, Debug)]
pub struct Filter {
    config: NavConfig,
    gate: ChiSquareGate,
    time: Time,
    nominal: Nominal,
    covariance: Covariance,
    gravity: LocalGravity,
    stretch: Stretch,
    rate: Vector3<f64>,
    trust: Trust,
    rtk: Option<bool>,
    level: LevelWindow,
    sway: Spread,
    moored: bool,
    navigating: bool,
    antenna: AntennaMotion,
    strayed: u32,
    next_mooring: Time,
    berth_offset_std: f64,
    last_relative: Option<Time>,
    internal_likelihood: f64,
}

/// What the gates said of an innovation.
pub(crate) struct Judged {
    outcome: Outcome,
    log_likelihood: f64,
    innovation: [(f64, f64); 3],
}

/// After this long without GNSS the solution no longer counts as aided by it, s.
const GNSS_TIMEOUT: f64 = 5.0;
/// The same for logs and references, which may be slower, s.
const RELATIVE_TIMEOUT: f64 = 15.0;

impl Filter {
    /// A filter from an initial state; `moored` if the ship is known to lie at her berth.
    #[must_use]
    pub fn new(config: &NavConfig, initial: &InitialState, moored: bool) -> Self {
        Filter {
            config: *config,
            gate: ChiSquareGate::new(config.gate.probability),
            time: initial.time,
            nominal: initial.nominal,
            covariance: initial.covariance,
            gravity: LocalGravity::around(&initial.nominal.position, &initial.nominal.geodetic()),
            stretch: Stretch::new(),
            rate: initial.rate,
            trust: Trust::default(),
            rtk: None,
            level: LevelWindow::new(&config.sea),
            sway: Spread::new(config.sea.mooring_velocity_std, 0.01),
            moored,
            navigating: false,
            antenna: AntennaMotion::default(),
            strayed: 0,
            next_mooring: initial.time,
            berth_offset_std: config.sea.berth_offset_std,
            last_relative: None,
            internal_likelihood: 0.0,
        }
    }

    /// Instant of the estimate.
    #[must_use]
    pub fn time(&self) -> Time {
        self.time
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

    /// Whether the ship is still taken as lying at her berth.
    #[must_use]
    pub fn is_moored(&self) -> bool {
        self.moored
    }

    /// Ends alignment: the filter now stands for itself and may judge the sensors' honesty.
    pub fn begin_navigation(&mut self) {
        self.navigating = true;
    }

    /// Moves estimate and covariance by an error and a covariance from outside: for alignment, which
    /// joins hypotheses.
    pub fn replace(&mut self, nominal: Nominal, covariance: Covariance) {
        self.nominal = nominal;
        self.covariance = covariance;
    }

    /// Brings the covariance up to the time of the estimate.
    pub fn settle(&mut self) {
        if self.stretch.duration <= 0.0 {
            return;
        }
        let regime = Regime { rtk: self.is_rtk(), berth_offset_std: self.berth_offset_std };
        propagation::propagate(
            &mut self.covariance,
            &self.stretch,
            self.gravity.gradient(),
            &self.config,
            &regime,
        );
        self.relax_nominal(self.stretch.duration);
        self.nominal.attitude.renormalize();
        self.antenna.note(self.time, &self.antenna_velocity());
        let place = self.nominal.geodetic();
        self.level.add(place.height, self.stretch.duration);
        self.gravity = LocalGravity::around(&self.nominal.position, &place);
        self.stretch = Stretch::new();
    }

    /// The expected values of Gauss-Markov states decay as the states do.
    fn relax_nominal(&mut self, dt: f64) {
        let (imu, gnss, log) = (&self.config.imu, &self.config.gnss, &self.config.log);
        let rtk = self.is_rtk();
        let nominal = &mut self.nominal;
        nominal.gyro_drift *= markov_decay(dt, imu.gyro.instability_time);
        nominal.accel_drift *= markov_decay(dt, imu.accel.instability_time);
        nominal.gnss_position_error *= markov_decay(dt, gnss.position_time_for(rtk));
        nominal.gnss_velocity_error *= markov_decay(dt, gnss.velocity_time);
        nominal.berth_offset *= markov_decay(dt, self.config.sea.berth_offset_time);
        nominal.current *= markov_decay(dt, log.current_time);
    }

    fn view(&self) -> View {
        // the rate comes from one sample and is extrapolated by half of it from the one before
        let noise = self.config.imu.gyro.random_walk.powi(2) * self.config.imu.rate * 2.5;
        View::new(&self.nominal, &self.rate, noise)
    }

    /// Applies an innovation if it passes the chi-square gate and nothing else speaks against it.
    /// The covariance must be settled.
    fn judge<const M: usize>(
        &mut self,
        innovation: &Innovation<M>,
        refused: Option<Rejection>,
    ) -> Judged {
        let Some(weighed) = innovation.weigh(&self.covariance) else {
            let outcome = Outcome::Rejected(Rejection::OutOfRange);
            return Judged { outcome, log_likelihood: 0.0, innovation: NO_INNOVATION };
        };
        let passes = weighed.nis() <= self.gate.limit::<M>();
        let refused = refused.or((!passes).then_some(Rejection::ChiSquare));
        let log_likelihood = self.bounded_likelihood(&weighed);
        if refused.is_none() {
            self.absorb(&weighed);
        }
        let outcome = refused.map_or(Outcome::Accepted, Outcome::Rejected);
        Judged { outcome, log_likelihood, innovation: detail(&weighed) }
    }

    fn absorb<const M: usize>(&mut self, weighed: &Weighed<M>) {
        let error = weighed.update(&mut self.covariance);
        self.nominal.inject(&error);
    }

    fn bounded_likelihood<const M: usize>(&self, weighed: &Weighed<M>) -> f64 {
        -0.5 * weighed.nis().min(self.gate.limit::<M>()) - weighed.log_root_determinant()
    }

    /// Whether GNSS positions come from fixed carrier ambiguities.
    fn is_rtk(&self) -> bool {
        self.rtk == Some(true)
    }

    /// Holds the mean height over a window of waves against the sea level.
    fn hold_sea_level(&mut self) {
        let (mean, length) = self.level.take_mean();
        let innovation = sea_level::innovation(&self.view(), mean, length, self.level.heave.std());
        let Some(weighed) = innovation.weigh(&self.covariance) else { return };
        let expected = weighed.sigma().x.powi(2) - innovation.r.x;
        self.level.heave.learn(innovation.z.x, expected);
        if weighed.nis() > self.gate.limit::<1>() {
            return;
        }
        if self.mode() == Mode::Inertial {
            self.absorb_vertically(&weighed);
        } else {
            self.absorb(&weighed);
        }
    }

    /// Lets a height move the vertical channel only. Without any other aid tilt and heading errors
    /// grow until their squares matter to the height, and the linear filter would take them for
    /// knowledge of the horizontal.
    fn absorb_vertically(&mut self, weighed: &Weighed<1>) {
        let up = self.nominal.position.normalize();
        let error = weighed.update_shaped(&mut self.covariance, |optimal| {
            let mut gain = SMatrix::zeros();
            for block in [POSITION, VELOCITY] {
                let along = block.of(optimal).dot(&up);
                block.set(&mut gain, &(up * along));
            }
            SEA_LEVEL.set(&mut gain, &SEA_LEVEL.of(optimal));
            gain
        });
        self.nominal.inject(&error);
    }

    fn gnss_is_fresh(&self) -> bool {
        self.trust.last_used().is_some_and(|last| (self.time - last).as_seconds() < GNSS_TIMEOUT)
    }

    /// Log-likelihood of the conditions that the filter imposed on itself (zero mean velocity at the
    /// berth) since the last call.
    pub fn take_internal_likelihood(&mut self) -> f64 {
        std::mem::take(&mut self.internal_likelihood)
    }

    /// Which aids carry the solution.
    #[must_use]
    pub fn mode(&self) -> Mode {
        let relative = self
            .last_relative
            .is_some_and(|last| (self.time - last).as_seconds() < RELATIVE_TIMEOUT);
        if self.gnss_is_fresh() {
            Mode::Aided
        } else if relative {
            Mode::DeadReckoning
        } else {
            Mode::Inertial
        }
    }

    /// Claimed 1-sigma of the heading, rad.
    #[must_use]
    pub fn heading_std(&self) -> f64 {
        self.solution().sigma.heading
    }
}

fn detail<const M: usize>(weighed: &Weighed<M>) -> [(f64, f64); 3] {
    let sigma = weighed.sigma();
    std::array::from_fn(|i| if i < M { (weighed.z()[i], sigma[i]) } else { (f64::NAN, f64::NAN) })
}

impl Estimator for Filter {
    fn advance(&mut self, increment: &Increment) {
        let step = strapdown::integrate(&mut self.nominal, &self.gravity, increment);
        self.stretch.add(&step);
        self.stretch.add_noise(increment);
        if increment.bridged {
            self.stretch.add_gap(step.duration);
        }
        self.rate = increment.end_rate;
        self.time = increment.to;
        if self.stretch.duration >= self.config.covariance_interval - 1e-6 {
            self.settle();
        }
        if self.level.is_full() {
            self.settle();
            self.hold_sea_level();
        }
        if self.moored && self.time >= self.next_mooring {
            self.settle();
            self.hold_mooring();
        }
    }

    fn apply(&mut self, received: &Received) -> Report {
        self.settle();
        let mut report = Report::default();
        match &received.message {
            Message::Imu(_) => {}
            Message::Gnss(fix) => self.apply_gnss(fix, received.source, &mut report),
            Message::Log(log) => self.apply_log(log, received.source, &mut report),
            Message::Reference(r) => self.apply_reference(r, received.source, &mut report),
        }
        report
    }

    fn solution(&self) -> Solution {
        let acceleration = self.antenna.acceleration(self.time, &self.antenna_velocity());
        let view = self.view().at_gnss_time(&acceleration);
        let sigma = solution_sigma(&view, &acceleration, &self.covariance);
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
        }
    }

    fn solution_at(&self, increment: &Increment, at: Time) -> Solution {
        let mut ahead = self.clone();
        ahead.nominal = strapdown::extrapolated(&self.nominal, increment, at);
        ahead.time = at;
        ahead.solution()
    }
}

/// The position of the IMU that a fix of its antenna means, ECEF, m.
fn imu_position(view: &View, antenna: &insd_base::Geodetic, lever: &Vector3<f64>) -> Ecef {
    Ecef(earth::ecef(antenna).0 - view.c_eb * lever)
}

/// Where there is no innovation to tell of.
pub(crate) const NO_INNOVATION: [(f64, f64); 3] = [(f64::NAN, f64::NAN); 3];

/// Enters a judgement in the report of a message.
fn enter(
    report: &mut Report,
    time: Time,
    source: Source,
    aid: &'static str,
    judged: &Judged,
) -> Outcome {
    report.log_likelihood += judged.log_likelihood;
    report.aids.push(AidReport {
        time,
        source,
        aid,
        outcome: judged.outcome,
        innovation: judged.innovation,
    });
    judged.outcome
}
