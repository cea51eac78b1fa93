//! Alignment under way: the ship restarts at sea and only her heading is not small.
//!
//! The linear Kalman filter of JAE's hybrid navigation (docs/systems.md, S2, "Starting under way", eq.
//! (6)): position, velocity and tilt errors along true north and east, s = sin(dpsi) and c = 1 -
//! cos(dpsi), dpsi = true minus assumed heading. [`motion`] has the equations, linear in (s, c) for
//! any dpsi; so one filter starts where a bank of headings would need two dozen.
//!
//! What tells the heading:
//! * **GNSS and a change of velocity**: specific force integrated in the computed frame against the
//!   change of velocity over the ground, sigma about sigma_v / |change of velocity|. A turn, a change
//!   of speed, the swell; and the swing of a masthead antenna as the ship rolls. A straight and steady
//!   course in a calm tells nothing, whatever its speed.
//! * **GNSS and a log over the bottom**: two views of one velocity, sigma about sigma_log / speed, at
//!   once and without a manoeuvre. Through the water the unknown current enters: sigma_current / speed.
//! * **The Earth's rate**, with GNSS, reference or log: the misheaded frame tilts at up to 2 w_N (30
//!   deg/h at the equator), which shows in the velocity as g w_N t^2 / 2, 1 m/s after a minute. Sigma
//!   not less than (gyro bias) / w_N, so that it is for gyros much better than 10 deg/h.
//! * **A log alone** measures velocity *in the computed frame*. Its change against the specific force
//!   there shows the tilt, whatever the heading, for both are misheaded alike: turns and changes of
//!   speed tell nothing, only the Earth's rate breaks the symmetry. With gyros of 0.01 deg/h and a log
//!   of 0.05 m/s in a calm at 35 deg of latitude that gives 7 deg after one minute, 1 deg after two,
//!   0.2 deg after five; with gyros of 30 deg/h nothing, ever. Velocity north and east is as unsure as
//!   the heading; position only grows less sure, as no log measures it.
//!
//! Sensor errors are considered, not estimated ([`belief`]), so that the sigmas hold; the heading comes
//! from (s, c) by their distribution on the unit circle ([`circle`]). When its sigma is small, the
//! frame is turned true, and [`EightState::initial_state`] hands over to the full filter, correlations
//! with the sensor errors included. Not for the vicinity of the poles (latitudes beyond 89 deg), where
//! north and east turn under the ship.

pub mod aids;
pub mod belief;
pub mod blur;
pub mod circle;
mod handover;
pub mod mast;
mod messages;
pub mod motion;
mod polish;
pub mod stride;
pub mod vertical;

use insd_base::units::{DEG, wrap_two_pi};
use insd_base::{
    Attitude, Body, Message, Mode, Ned, Received, Solution, SolutionSigma, Time, earth,
};
use insd_estimation::Gate;
use insd_nav::angular_rate::rate_variance;
use insd_nav::antenna::AntennaMotion;
use insd_nav::judge::Docket;
use insd_nav::leap::LeapWatch;
use insd_nav::{Estimator, Increment, NavConfig, Report};
use nalgebra::{Matrix2, Rotation3, UnitQuaternion, Vector2, Vector3};

use crate::kinematics::Kinematics;
use crate::levelling::Level;
use aids::Scene;
use belief::{Belief, considered as k, state as x};
use blur::Blur;
use mast::Mast;
use motion::{HorizontalMotion, HorizontalStretch, Local};
use polish::Polish;
use stride::Stride;
use vertical::VerticalChannel;

/// The filter of eight states.
#[derive(Clone, Debug)]
pub struct EightState {
    config: NavConfig,
    gate: Gate,
    time: Time,
    motion: HorizontalMotion,
    local: Local,
    belief: Belief,
    /// What noise passes for, as long as she has made no way: of a craft under way it is little beside what she does, and on
    /// wheels what the monitor takes for it is motion.
    blur: Option<Blur>,
    vertical: VerticalChannel,
    stretch: HorizontalStretch,
    rate: Vector3<f64>,
    rate_variance: f64,
    /// Integral of the force, computed frame, m/s: only its changes are used.
    push: Vector3<f64>,
    antenna: AntennaMotion,
    /// Since the last epoch of ranges, and when one was last used.
    stride: Option<Stride>,
    strode: Option<Time>,
    /// Since the heading was first known to [`GOAL`].
    polish: Option<Polish>,
    rtk: Option<bool>,
    heard_height: Time,
    mast: Mast,
    /// When a position of GNSS was last used.
    gnss_used: Option<Time>,
    refused_since: Option<Time>,
    leap: LeapWatch,
    heading: (f64, f64),
    centred: bool,
    /// Of a log that takes the heading off the circle.
    gain_of_log: Option<f64>,
}

/// So much is way, m/s, and so much tells a log from noise.
const LEFT: f64 = 2.0;
const WAY: f64 = 1.5;
/// Heading sigma at which the phase ends, rad.
pub const GOAL: f64 = 5.0 * DEG;
/// While phases tell how she moves it goes on to this one, rad.
const FINE_GOAL: f64 = 1.0 * DEG;
/// Sigma of the tilt after levelling, sensor bias aside, rad.
const LEVEL_STD: f64 = 1.0 * DEG;
/// Longest stretch between propagations of the covariance, s.
const STRETCH: f64 = 0.5;
/// Tilt beyond which the computed frame is levelled, rad.
const LEAN: f64 = 1.0 * DEG;
/// Misheading beyond which a frame that has once been turned true is turned again, rad.
const ASTRAY: f64 = 1.0 * DEG;
/// Without a height for so long the ship is taken to float, s.
const SILENT: f64 = 3.0;

impl EightState {
    /// From a levelled ship and her place and velocity at the start of the levelling window. The
    /// heading is assumed as zero and taken as unknown.
    ///
    /// The frame is levelled as if the mean force were gravity alone. What it is off by is the tilt of
    /// the ship's mean acceleration a, phi = (a_E, -a_N) / g, and of the accelerometer bias, and that
    /// is the same whatever the heading.
    #[must_use]
    pub fn new(config: &NavConfig, level: &Level, start: &Kinematics) -> Self {
        let attitude = level.attitude(0.0, &start.position, &Vector3::zeros());
        let mut motion = HorizontalMotion {
            place: start.position,
            velocity: start.velocity.xy(),
            tilt: Vector2::zeros(),
            sine: 0.0,
            versine: 1.0,
            attitude: UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(
                attitude.c_nb(),
            )),
        };
        let local = Local::new(&motion);
        motion.tilt = motion::across(&start.acceleration.xy()) / -local.gravity;
        let mut filter = EightState {
            config: *config,
            gate: Gate::new(config.gate.probability),
            time: level.time,
            motion,
            local,
            belief: Belief::new(config),
            blur: (start.velocity.norm() < LEFT).then(Blur::default),
            vertical: VerticalChannel::new(
                start.position.height,
                start.position_std,
                start.velocity.z,
                start.velocity_std,
            ),
            stretch: HorizontalStretch::default(),
            rate: level.rate,
            rate_variance: rate_variance(&config.imu),
            push: Vector3::zeros(),
            antenna: AntennaMotion::default(),
            stride: None,
            strode: None,
            polish: None,
            rtk: None,
            heard_height: level.time,
            mast: Mast::default(),
            gnss_used: None,
            refused_since: None,
            leap: LeapWatch::default(),
            heading: (0.0, circle::UNKNOWN),
            centred: false,
            gain_of_log: None,
        };
        filter.renew(start.position_std, start.velocity_std);
        filter
    }

    /// Nothing known of the heading, the rest as stated, m and m/s.
    fn renew(&mut self, position_std: f64, velocity_std: f64) {
        self.belief = Belief::new(&self.config);
        self.blur = self.blur.map(|_| Blur::default());
        self.belief.renew_pair(x::POSITION, position_std * position_std);
        self.belief.renew_pair(x::VELOCITY, velocity_std * velocity_std);
        // a heading that could be anything: cosine and sine have mean 0 and variance 1/2
        self.belief.renew_pair(x::SINE, 0.5);
        self.motion.sine = 0.0;
        self.motion.versine = 1.0;
        let bias = self.belief.prior[k::ACCEL];
        let gravity = self.local.gravity;
        self.belief.renew_pair(x::TILT, LEVEL_STD.powi(2) + bias / (gravity * gravity));
        // levelling with a biased force: phi = -(down x bias) / g
        let leaning = Matrix2::new(0.0, 1.0, -1.0, 0.0) / gravity;
        let hull = self.scene().hull;
        let cross = leaning * hull * bias;
        self.belief.correlate_pair(x::TILT, k::ACCEL, &cross);
        (self.centred, self.gain_of_log) = (false, None);
        self.note_heading();
    }

    /// Instant of the estimate.
    #[must_use]
    pub fn time(&self) -> Time {
        self.time
    }

    /// The estimate, for tests and tools.
    #[must_use]
    pub fn motion(&self) -> &HorizontalMotion {
        &self.motion
    }

    /// True heading and its 1-sigma, rad; the sigma of an unknown heading is 104 deg.
    #[must_use]
    pub fn heading(&self) -> (f64, f64) {
        let (turn, sigma) = self.heading;
        (wrap_two_pi(self.assumed_heading() + turn), sigma)
    }

    /// Whether the heading is known well enough for the full filter. Phases, which tell it within seconds, are to the millimetre what a filter that is
    /// linear in the heading is not: they finish what they have begun, as long as it gets on.
    #[must_use]
    pub fn finished(&self) -> bool {
        let waits = self.polish.is_some_and(|polish| polish.goes_on(self.time));
        let goal = if waits && self.strides() { FINE_GOAL } else { GOAL };
        self.heading.1 < goal && self.gain_of_log.is_none()
    }

    /// Whether a log keeps the heading from being found.
    #[must_use]
    pub fn is_off_circle(&self) -> bool {
        self.gain_of_log.is_some()
    }

    /// How many times her speed the log tells, where that is why the heading is not found: no turn takes what it says to what the
    /// receiver says. Of a ship that lies still it may be noise that does so.
    #[must_use]
    pub fn gain_of_log(&self) -> Option<f64> {
        self.gain_of_log.filter(|_| self.motion.velocity.norm() > WAY)
    }

    /// Share of what was seen of the heading that may be noise; nothing of a craft that has made way.
    #[must_use]
    pub fn noise_share(&self) -> f64 {
        let covariance = self.belief.direction_covariance();
        self.blur.map_or(0.0, |blur| blur.share(&covariance))
    }

    /// What is assumed of sensors and sea; the lever arm is that of the antenna that was heard last.
    #[must_use]
    pub fn config(&self) -> &NavConfig {
        &self.config
    }

    /// Goes by what is known of who lies from now on.
    pub fn take_docket(&mut self, docket: Docket) {
        self.config = self.config.with_docket(docket);
    }

    fn assumed_heading(&self) -> f64 {
        let bow = self.motion.attitude * Vector3::x();
        bow.y.atan2(bow.x)
    }

    fn scene(&self) -> Scene {
        let down = (self.vertical.down, self.vertical.variances().1);
        let makes_way = self.blur.is_none();
        Scene { makes_way, ..Scene::new(&self.motion, &self.rate, self.rate_variance, down) }
    }

    /// Angle and sigma of dpsi from (s, c).
    fn note_heading(&mut self) {
        let (sin, off) = (self.motion.sine, self.motion.versine);
        self.heading = if self.centred {
            let variance = self.belief.own()[(x::SINE, x::SINE)];
            (sin.atan2(1.0 - off), variance.max(0.0).sqrt())
        } else {
            let (mean, covariance) = self.direction();
            circle::angle(&mean, &covariance)
        };
    }

    /// Mean and covariance of (cos dpsi, sin dpsi).
    fn direction(&self) -> (Vector2<f64>, Matrix2<f64>) {
        let mean = Vector2::new(1.0 - self.motion.versine, self.motion.sine);
        let covariance = self.belief.direction_covariance();
        let blur = self.blur.filter(|_| !self.centred);
        blur.map_or((mean, covariance), |blur| blur.sharpened(&mean, &covariance))
    }

    /// She makes way: goes on from what is known of the direction without what noise has told of it.
    fn leave(&mut self) {
        let (mean, covariance) = self.direction();
        self.blur = None;
        self.belief.renew_pair(x::SINE, 0.5 * covariance.trace());
        (self.motion.versine, self.motion.sine) = (1.0 - mean.x, mean.y);
    }

    /// Whether a receiver tells the height.
    fn hears_height(&self) -> bool {
        (self.time - self.heard_height).as_seconds() <= SILENT
    }

    /// Brings the belief up to the time of the estimate.
    fn settle(&mut self) {
        if self.stretch.duration <= 0.0 {
            return;
        }
        let stretched =
            self.stretch.transition(&self.motion, &self.local, &self.belief, &self.config);
        let scene = self.scene();
        self.mast.see(&scene.mast(), &scene.hull, self.stretch.duration);
        let before = self.belief.pair(x::SINE).sum();
        self.belief.propagate(&stretched);
        let after = self.belief.pair(x::SINE).sum().max(f64::MIN_POSITIVE);
        if let Some(blur) = &mut self.blur {
            blur.propagate(&stretched, (before / after).min(1.0));
            if self.motion.velocity.norm() > LEFT {
                self.leave();
            }
        }
        self.vertical.settle(self.stretch.duration, self.belief.prior[k::ACCEL].sqrt());
        if !self.hears_height() {
            self.vertical.hold_afloat();
        }
        self.motion.place.height = self.vertical.height;
        self.motion.attitude.renormalize();
        self.stretch = HorizontalStretch::default();
        self.keep_upright();
        self.local = Local::new(&self.motion);
        self.note_heading();
    }

    /// What is claimed of a position, 1-sigma, m: no more than a receiver that has leapt leaves.
    fn claimed(&self, std: Ned) -> Ned {
        let unproven = self.config.docket.unproven_std(self.time);
        Ned::new(std.0.x.max(unproven), std.0.y.max(unproven), std.0.z)
    }

    /// Notes the antenna's velocity but for a constant, for its acceleration.
    fn note_antenna(&mut self) {
        let swing = self.motion.attitude * self.rate.cross(&self.config.gnss_lever());
        self.antenna.note(self.time, &(self.push + swing));
    }

    /// Roll, pitch and heading with their sigmas, rad: of a copy that has been turned upright.
    fn attitude(&self) -> (Attitude, f64) {
        let mut upright = self.clone();
        upright.level();
        let c = Rotation3::from_axis_angle(&Vector3::z_axis(), self.heading.0).into_inner()
            * upright.motion.c_pb();
        let left = upright.motion.tilt.norm_squared();
        let variance = 0.5 * (upright.belief.pair(x::TILT).sum() + left);
        (Attitude::from_c_nb(&c), variance.sqrt())
    }
}

impl Estimator for EightState {
    fn advance(&mut self, increment: &Increment) {
        let step = self.motion.advance(&self.local, increment, self.vertical.down);
        self.vertical.advance(step.down, increment.duration());
        self.push += step.force;
        self.stretch.add(&step, increment);
        self.stride.iter_mut().for_each(|own| own.add(&step.force, increment.duration()));
        (self.rate, self.rate_variance) = (increment.end_rate, increment.end_rate_variance);
        self.time = increment.to;
        self.push.z += self.local.gravity * increment.duration();
        self.note_antenna();
        if self.stretch.duration >= STRETCH - 1e-6 {
            self.settle();
        }
    }

    fn apply(&mut self, received: &Received) -> Report {
        match &received.message {
            Message::Imu(_)
            | Message::Base(_)
            | Message::Rtk(_)
            | Message::Compass(_)
            | Message::Ranging(_)
            | Message::Camera(_)
            | Message::Odometry(_) => Report::default(),
            Message::Ranges(ranges) => self.ranges(ranges, received.source),
            Message::Gnss(fix) => self.gnss(fix, received.source),
            Message::Log(log) => self.log(log, received.source),
            Message::Reference(reference) => self.reference(reference, received.source),
        }
    }

    fn solution(&self) -> Solution {
        let (attitude, tilt) = self.attitude();
        let std = |at: usize, down: f64| {
            let variance = self.belief.pair(at);
            Ned::new(variance.x.sqrt(), variance.y.sqrt(), down.sqrt())
        };
        let (height, down) = self.vertical.variances();
        let velocity =
            Vector3::new(self.motion.velocity.x, self.motion.velocity.y, self.vertical.down);
        let place = self.motion.place;
        let turn_of_n = attitude.c_nb().transpose()
            * (earth::rate_n(place.latitude) + earth::transport_rate(&place, &velocity));
        Solution {
            time: self.time,
            position: insd_base::Geodetic { height: self.vertical.height, ..place },
            velocity: Ned(velocity),
            attitude,
            rate: Body(self.rate - turn_of_n),
            sigma: SolutionSigma {
                position: self.claimed(std(x::POSITION, height)),
                velocity: std(x::VELOCITY, down),
                roll: tilt / attitude.pitch.cos().max(1e-9),
                pitch: tilt,
                heading: self.heading.1,
            },
            mode: Mode::InMotionAlignment,
            judgement: self.config.docket.judgement(),
            source: None,
            hidden: insd_base::Protection::default(),
        }
    }

    fn solution_at(&self, increment: &Increment, at: Time) -> Solution {
        let mut ahead = self.clone();
        if at > increment.from {
            let (head, _) =
                if at < increment.to { increment.split(at) } else { (*increment, *increment) };
            let step = ahead.motion.advance(&ahead.local, &head, ahead.vertical.down);
            ahead.vertical.advance(step.down, head.duration());
            ahead.rate = head.end_rate;
        }
        ahead.time = at;
        ahead.solution()
    }
}

#[cfg(test)]
mod tests;
