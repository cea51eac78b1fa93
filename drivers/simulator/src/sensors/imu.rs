//! The inertial measurement unit: increments of the true motion, and what goes wrong with them.

use nalgebra::Vector3;
use rand_pcg::Pcg64;

use insd_base::earth::{gravity_e, rate_e};
use insd_base::units::DEG;
use insd_base::{Body, ImuSample, ImuSpec, Stamped, Time};

use super::epochs;
use super::vibration::Engine;
use super::windows::{Window, windows};
use crate::quadrature::{NODES, WEIGHTS};
use crate::random::{GaussMarkov, Purpose, normal, normal3, stream, uniform};
use crate::scenario::{Imu, Spread};
use crate::track::{Kinematics, Track};

/// Longest interval that is integrated in one step, s.
const LONGEST_STEP: f64 = 0.05;

/// Angular rate with respect to inertial space, rad/s, and specific force, m/s^2, body axes:
///
/// omega_ib = omega_eb + C_be omega_ie, f = C_be (dv_e/dt + 2 omega_ie x v_e - g_e), g_e being
/// gravity with its centrifugal part.
fn inertial(ship: &Kinematics) -> (Vector3<f64>, Vector3<f64>) {
    let omega_ie = rate_e();
    let coriolis = omega_ie.cross(&ship.velocity) * 2.0;
    let force_e = ship.acceleration + coriolis - gravity_e(&ship.point);
    (ship.omega_eb + ship.c_eb.tr_mul(&omega_ie), ship.c_eb.tr_mul(&force_e))
}

/// The true increments over (from, to], s.
pub(crate) fn increments(track: &Track, from: f64, to: f64) -> (Vector3<f64>, Vector3<f64>) {
    let steps = ((to - from) / LONGEST_STEP).ceil().max(1.0) as u32;
    let dt = (to - from) / f64::from(steps);
    let mut sums = (Vector3::zeros(), Vector3::zeros());
    for step in 0..steps {
        let start = from + dt * f64::from(step);
        for (node, weight) in NODES.into_iter().zip(WEIGHTS) {
            let (omega, force) = inertial(&track.at(start + node * dt));
            sums.0 += omega * (weight * dt);
            sums.1 += force * (weight * dt);
        }
    }
    sums
}

/// What the increment of velocity at a point of the hull is beyond that at the IMU, `lever` from it, body
/// axes, over (from, to], s: the integral of the angular acceleration's part, d(omega x l)/dt, is what
/// omega x l has gained, and omega x (omega x l) is integrated.
pub(crate) fn swing(track: &Track, (from, to): (f64, f64), lever: &Vector3<f64>) -> Vector3<f64> {
    let rate = |time: f64| inertial(&track.at(time)).0;
    let swings = |time: f64| rate(time).cross(lever);
    let dt = to - from;
    let inward = |node: f64| {
        let omega = rate(from + node * dt);
        omega.cross(&omega.cross(lever))
    };
    let nodes = NODES.into_iter().zip(WEIGHTS);
    let turned: Vector3<f64> = nodes.map(|(node, weight)| inward(node) * (weight * dt)).sum();
    swings(to) - swings(from) + turned
}

/// The errors of three gyros or three accelerometers:
/// measured = true (1 + scale) + (turn-on + in-run) dt + random walk.
#[derive(Debug)]
struct TriadErrors {
    scale: Vector3<f64>,
    turn_on: Vector3<f64>,
    in_run: GaussMarkov,
    random_walk: f64,
    white: Pcg64,
}

impl TriadErrors {
    /// One axis' increments of `true_increment` over `dt`, s, as measured.
    fn measure(&mut self, true_increment: &Vector3<f64>, dt: f64) -> Vector3<f64> {
        let scaled = true_increment + self.scale.component_mul(true_increment);
        let bias = self.turn_on + self.in_run.advance(dt);
        scaled + bias * dt + normal3(&mut self.white) * (self.random_walk * dt.sqrt())
    }
}

fn gyro_errors(spec: &ImuSpec, seed: u64) -> TriadErrors {
    let gyro = &spec.gyro;
    TriadErrors {
        scale: normal3(&mut stream(seed, Purpose::GyroScale)) * gyro.scale_std,
        turn_on: normal3(&mut stream(seed, Purpose::GyroTurnOn)) * gyro.bias_std,
        in_run: GaussMarkov::new(
            Vector3::repeat(gyro.instability_std),
            gyro.instability_time,
            stream(seed, Purpose::GyroInRun),
        ),
        random_walk: gyro.random_walk,
        white: stream(seed, Purpose::GyroWhite),
    }
}

fn accel_errors(spec: &ImuSpec, seed: u64) -> TriadErrors {
    let accel = &spec.accel;
    TriadErrors {
        scale: normal3(&mut stream(seed, Purpose::AccelScale)) * accel.scale_std,
        turn_on: normal3(&mut stream(seed, Purpose::AccelTurnOn)) * accel.bias_std,
        in_run: GaussMarkov::new(
            Vector3::repeat(accel.instability_std),
            accel.instability_time,
            stream(seed, Purpose::AccelInRun),
        ),
        random_walk: accel.random_walk,
        white: stream(seed, Purpose::AccelWhite),
    }
}

/// Counts in steps: what is left of one goes into the next increment, so that the sum of the increments is
/// never off by more than half a step.
#[derive(Debug)]
struct Quantiser {
    step: f64,
    rest: Vector3<f64>,
}

impl Quantiser {
    /// Steps in the unit of the increments; none if zero.
    fn new(step: f64) -> Self {
        Quantiser { step, rest: Vector3::zeros() }
    }

    fn count(&mut self, increment: &Vector3<f64>) -> Vector3<f64> {
        if self.step == 0.0 {
            return *increment;
        }
        let due = increment + self.rest;
        let counted = due.map(|value| (value / self.step).round() * self.step);
        self.rest = due - counted;
        counted
    }
}

/// The faults of the data line.
#[derive(Debug)]
struct LineFaults {
    gaps: Vec<Window>,
    /// Instants at and after which the next sample is sent twice, latest first.
    duplicates: Vec<f64>,
    /// Share of the samples lost one by one.
    lost_share: f64,
    losses: Pcg64,
}

impl LineFaults {
    fn new(imu: &Imu, seed: u64) -> Self {
        let mut rng = stream(seed, Purpose::ImuGaps);
        let gaps = imu.gaps.iter().flat_map(|gap| windows(&gap.when, gap.duration_s, &mut rng));
        let gaps = gaps.collect();
        let mut rng = stream(seed, Purpose::ImuDuplicates);
        let instants = imu.duplicates.iter().flat_map(|w| windows(w, Spread::Fixed(0.0), &mut rng));
        let mut duplicates: Vec<f64> = instants.map(|window| window.start).collect();
        duplicates.sort_by(|a, b| b.total_cmp(a));
        let losses = stream(seed, Purpose::ImuLosses);
        LineFaults { gaps, duplicates, lost_share: imu.lost_share, losses }
    }

    /// How often a sample of time `t`, s, arrives.
    fn copies(&mut self, t: f64) -> usize {
        let lost = uniform(&mut self.losses, 0.0, 1.0) < self.lost_share;
        if lost || self.gaps.iter().any(|gap| gap.contains(t)) {
            return 0;
        }
        match self.duplicates.last() {
            Some(at) if *at <= t => {
                self.duplicates.pop();
                2
            }
            _ => 1,
        }
    }
}

/// The samples of a voyage of `duration`, s.
pub(crate) fn samples(
    imu: &Imu,
    track: &Track,
    duration: f64,
    seed: u64,
) -> Vec<Stamped<ImuSample>> {
    samples_at(imu, track, duration, seed, None)
}

/// The samples of an IMU `lever` from the one whose track it is, body axes, m.
pub(crate) fn samples_at(
    imu: &Imu,
    track: &Track,
    duration: f64,
    seed: u64,
    lever: Option<&Vector3<f64>>,
) -> Vec<Stamped<ImuSample>> {
    let spec = imu.simulated();
    let mut gyro = gyro_errors(&spec, seed);
    let mut accel = accel_errors(&spec, seed);
    let engine = Engine::new(&imu.vibration, seed);
    let mut angle = Quantiser::new(imu.quantisation.gyro_arcsec * DEG / 3600.0);
    let mut speed = Quantiser::new(imu.quantisation.accel_mps);
    let mut line = LineFaults::new(imu, seed);
    let mut jitter = stream(seed, Purpose::ImuJitter);
    let mut samples = Vec::with_capacity((duration * imu.rate_hz) as usize + 1);
    let mut from = 0.0;
    for epoch in epochs(imu.rate_hz, 1, duration) {
        let limit = 0.4 / imu.rate_hz;
        let shift = (normal(&mut jitter) * imu.jitter_std_s).clamp(-limit, limit);
        let time = Time::from_seconds(epoch.as_seconds() + shift);
        let to = time.as_seconds();
        let (theta, mut velocity) = increments(track, from, to);
        if let Some(lever) = lever {
            velocity += swing(track, (from, to), lever);
        }
        let shaken = engine.increments(from, to);
        let theta = gyro.measure(&theta, to - from) + shaken.0;
        let velocity = accel.measure(&velocity, to - from) + shaken.1;
        let message = ImuSample {
            time,
            delta_theta: Body(angle.count(&theta)),
            delta_velocity: Body(speed.count(&velocity)),
        };
        samples.extend(std::iter::repeat_n(Stamped::prompt(message), line.copies(to)));
        from = to;
    }
    samples
}
