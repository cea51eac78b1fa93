//! The trial of a state that is gone on from after a crash: do the sensors say what it claims?
//!
//! It is believed from the first sample on, so that the ship has a heading at once; for some seconds
//! every innovation of GNSS, logs and references is held against its claim, and gravity against the
//! claimed tilt. A bad fix or two refute nothing: it takes several epochs over several seconds, most of
//! all there were.
//!
//! Gravity: over the trial the mean acceleration, less what a turn at her speed explains, is small,
//! whatever the sea; g times the tilt is not.
//!
//! What cannot be seen: a heading that is wrong while the ship neither turns nor changes her speed, nor
//! has a log or a reference; at the berth the Earth's rotation shows it only within minutes.

use insd_base::{Ned, ResumeDoubt, Time};
use insd_nav::{Filter, Increment, Report};
use nalgebra::Vector2;

/// A state that is gone on from.
#[derive(Clone, Debug)]
pub(crate) struct Resumption {
    since: Option<Time>,
    /// Whether the receiver was good when the state was saved: one in fault is no witness.
    hears_gnss: bool,
    place: Witness,
    velocity: Witness,
    heading: Witness,
    gravity: Gravity,
    /// The filter has taken itself as lost.
    lost: bool,
    /// Somebody contradicts the others, or the IMU is not believed.
    contradicted: bool,
}

/// What became of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Finding {
    /// The sensors agree.
    Confirmed,
    /// They do not.
    Refuted(ResumeDoubt),
}

/// Length of the trial, s.
const TRIAL: f64 = 10.0;
/// Where an aid has said too little by then it is waited for, at most so long, s.
const PATIENCE: f64 = 30.0;
/// Epochs that make a judgement.
const EPOCHS: u32 = 6;
/// Mean square of an epoch, one being expected, from which on it disagrees: three sigmas.
const DISAGREES: f64 = 9.0;
/// Epochs that must disagree, and the time that they must span, s.
const REFUTE: u32 = 4;
const SPAN: f64 = 2.9;
/// Mean square over all epochs that refutes at the end: with six of three components eight standard
/// deviations of what is expected. One epoch counts no more than so much.
const LIMIT: f64 = 3.5;
const MOST: f64 = 12.0;
/// Mean horizontal acceleration over the trial that the sea and the rudder may leave, m/s^2.
const LEFT: f64 = 0.4;
/// Sigmas of the tilt on top of it.
const SURE: f64 = 4.0;
const GRAVITY: f64 = 9.8;

/// What one quantity has said.
#[derive(Clone, Copy, Debug, Default)]
struct Witness {
    epochs: u32,
    disagreed: u32,
    first: Option<Time>,
    last: Option<Time>,
    sum: f64,
}

/// The horizontal acceleration of the trial.
#[derive(Clone, Copy, Debug, Default)]
struct Gravity {
    sum: Vector2<f64>,
    seconds: f64,
    tilt: f64,
}

impl Resumption {
    pub(crate) fn new(hears_gnss: bool) -> Self {
        Resumption {
            since: None,
            hears_gnss,
            place: Witness::default(),
            velocity: Witness::default(),
            heading: Witness::default(),
            gravity: Gravity::default(),
            lost: false,
            contradicted: false,
        }
    }

    /// Whether the first sample is still awaited.
    pub(crate) fn is_waiting(&self) -> bool {
        self.since.is_none()
    }

    /// The first sample is here.
    pub(crate) fn begin(&mut self, time: Time) {
        self.since = Some(time);
    }

    /// Takes what became of a measurement.
    pub(crate) fn hear(&mut self, report: &Report) {
        self.lost |= report.position_reset;
        for aid in &report.aids {
            let witness = match aid.aid {
                "gnss_position" | "gnss_velocity" if !self.hears_gnss => continue,
                "gnss_position" | "reference_position" => &mut self.place,
                "reference_heading" => &mut self.heading,
                _ => &mut self.velocity,
            };
            witness.hear(aid.time, &aid.innovation);
        }
    }

    /// Takes whether the judge finds that somebody contradicts the others, or does not believe the IMU.
    pub(crate) fn note_doubt(&mut self, is_in_doubt: bool) {
        self.contradicted |= is_in_doubt;
    }

    /// Takes an increment that the filter has just moved over.
    pub(crate) fn feel(&mut self, filter: &Filter, increment: &Increment, tilt: f64) {
        if increment.bridged.is_none() {
            self.gravity.feel(&filter.acceleration(increment), filter, increment, tilt);
        }
    }

    /// What came of it; `None` while the trial goes on.
    pub(crate) fn finding(&self, now: Time) -> Option<Finding> {
        let of = [
            (&self.place, ResumeDoubt::Position),
            (&self.velocity, ResumeDoubt::Velocity),
            (&self.heading, ResumeDoubt::Heading),
        ];
        if self.lost {
            return Some(Finding::Refuted(ResumeDoubt::Position));
        }
        if let Some((_, doubt)) = of.iter().find(|(witness, _)| witness.refutes()) {
            return Some(Finding::Refuted(*doubt));
        }
        let elapsed = (now - self.since?).as_seconds();
        let has_heard = of.iter().any(|(witness, _)| witness.epochs >= EPOCHS);
        if elapsed < TRIAL || (elapsed < PATIENCE && !has_heard) {
            return None;
        }
        if self.gravity.refutes() {
            return Some(Finding::Refuted(ResumeDoubt::Level));
        }
        if self.contradicted {
            return Some(Finding::Refuted(ResumeDoubt::Velocity));
        }
        let off = of.iter().find(|(witness, _)| witness.is_off());
        Some(off.map_or(Finding::Confirmed, |(_, doubt)| Finding::Refuted(*doubt)))
    }
}

impl Witness {
    fn hear(&mut self, time: Time, innovation: &[(f64, f64); 3]) {
        let squares = innovation.iter().filter(|(z, sigma)| z.is_finite() && *sigma > 0.0);
        let (sum, count) =
            squares.fold((0.0, 0.0), |(sum, n), (z, s)| (sum + (z / s).powi(2), n + 1.0));
        // what is not even weighed says nothing
        if count == 0.0 {
            return;
        }
        let mean: f64 = sum / count;
        self.epochs += 1;
        self.sum += mean.min(MOST);
        if mean > DISAGREES {
            self.disagreed += 1;
            self.first = self.first.or(Some(time));
            self.last = self.last.max(Some(time));
        }
    }

    fn refutes(&self) -> bool {
        let span = self.first.zip(self.last).map_or(0.0, |(a, b)| (b - a).as_seconds());
        self.disagreed >= REFUTE && 2 * self.disagreed > self.epochs && span >= SPAN
    }

    fn is_off(&self) -> bool {
        self.epochs >= EPOCHS && self.sum > LIMIT * f64::from(self.epochs)
    }
}

impl Gravity {
    fn feel(&mut self, acceleration: &Ned, filter: &Filter, increment: &Increment, tilt: f64) {
        let h = increment.duration();
        if self.seconds <= 0.0 {
            self.tilt = tilt;
        }
        let velocity = filter.view().v_n();
        // a turn at her speed: yaw x v, the turn about down taken as that about the hull's own axis
        let yaw = increment.rotation.z / h;
        let turning = Vector2::new(-velocity.y, velocity.x) * yaw;
        self.sum += (acceleration.0.xy() - turning) * h;
        self.seconds += h;
    }

    fn refutes(&self) -> bool {
        let mean = self.sum.norm() / self.seconds.max(1e-9);
        self.seconds > 0.5 * TRIAL && mean > LEFT + SURE * GRAVITY * self.tilt
    }
}
