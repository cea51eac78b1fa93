//! Range, range rate and phase of one satellite.
//!
//! Predicted for the antenna at `r_a = r + C_eb l - v_a tau`, which moves with `v_a = v + C_eb (omega_eb x l)`, tau the delay of the epochs behind
//! the IMU's time base; e points to the satellite, c is the receiver's clock and s what it adds for another system:
//!
//! z_code = -e . (dr - [C_eb l x] phi + C_eb dl - v_a dtau) + dc + ds + sigma_slow x_slow + sigma_r x_r + white,
//!
//! slow errors of orbits and the ionosphere apart from those of reflections,
//! z_phase = the same with the constant of its arc in place of the slow error,
//! z_rate = -e . (dv - [C_eb (omega x l) x] phi + C_eb [l x] db_g + C_eb [omega x] dl) + d(drift) + white.
//!
//! Groves, 2nd ed., eqs. (14.128), (14.129), for an antenna with a lever arm; the JAE hybrid filter's 17 states (docs/systems.md, S2) are blocks 1 to 15 and the clock.
//! Held by `every_measurement_matrix_agrees_with_perturbed_predictions`.

use insd_base::attitude::skew;
use insd_base::satellites::{Constellation, Measured, SatelliteRange, time_keeper};
use insd_estimation::Jacobian;
use nalgebra::{Matrix1, RowVector2, RowVector3, SMatrix, Vector1, Vector3};

use super::View;
use crate::error_state::{
    ATTITUDE, GNSS_DELAY, GNSS_LEVER, GYRO_BIAS, GYRO_DRIFT, GYRO_SCALE, IONOSPHERE, Innovation,
    PHASE_CONSTANTS, POSITION, RANGE_ERRORS, RECEIVER_CLOCK, REFLECTIONS, SATELLITES,
    SYSTEM_OFFSETS, VELOCITY,
};

/// The antenna as the estimate has it, ECEF axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Antenna {
    /// From the IMU, m.
    pub arm: Vector3<f64>,
    /// Position, m.
    pub position: Vector3<f64>,
    /// Velocity over the Earth, m/s.
    pub velocity: Vector3<f64>,
    /// The part of it that is the ship's turning, m/s.
    pub swing: Vector3<f64>,
    /// The velocity that a delay of the epochs counts with, m/s.
    pub way: Vector3<f64>,
}

impl Antenna {
    /// At a lever arm from the IMU, body axes, m, at the instant that GNSS time calls that of the estimate; `way`: velocity of the antenna as predicted, m/s,
    /// by which epochs that are late have it elsewhere.
    #[must_use]
    pub fn of(view: &View, lever: &Vector3<f64>, way: &Vector3<f64>) -> Self {
        let arm = view.c_eb * lever;
        let swing = view.c_eb * view.rate.cross(lever);
        let velocity = view.nominal.velocity + swing;
        let position = view.nominal.position + arm - way * view.nominal.gnss_delay;
        Self { arm, position, velocity, swing, way: *way }
    }

    /// The point from which a range is measured: in the middle of several antennas that is not where the lever arm ends.
    #[must_use]
    pub fn of_range(&self, view: &View, range: &SatelliteRange) -> Self {
        let beside = view.c_eb * range.offset;
        let turned = view.c_eb * view.rate.cross(&range.offset);
        Self {
            arm: self.arm + beside,
            position: self.position + beside,
            velocity: self.velocity + turned,
            swing: self.swing + turned,
            way: self.way,
        }
    }
}

/// A satellite and its place among those in use.
#[derive(Clone, Copy, Debug)]
pub struct Sighted<'a> {
    /// What it tells.
    pub range: &'a SatelliteRange,
    /// Its number among the states of satellites, below [`SATELLITES`].
    pub slot: usize,
}

/// Its number among the states of systems; `None` for those that keep GPS time.
fn system(range: &SatelliteRange) -> Option<usize> {
    match time_keeper(range.satellite.constellation) {
        Constellation::Galileo => Some(0),
        Constellation::BeiDou => Some(1),
        Constellation::Glonass => Some(2),
        _ => None,
    }
}

/// Receiver's clock for a satellite as the estimate has it, m.
fn clock(view: &View, range: &SatelliteRange) -> f64 {
    let offset = system(range).map_or(0.0, |index| view.nominal.system_offsets[index]);
    view.nominal.receiver_clock.x + offset
}

/// Range and clock as a code or a phase should have them, without errors of their own, m.
#[must_use]
pub fn predicted(view: &View, antenna: &Antenna, range: &SatelliteRange) -> f64 {
    let antenna = antenna.of_range(view, range);
    range.transmitter.range(&antenna.position) + clock(view, range)
}

/// What a range depends on, whatever measures it.
fn geometry(view: &View, antenna: &Antenna, range: &SatelliteRange) -> Jacobian {
    let antenna = antenna.of_range(view, range);
    let mut h = Jacobian::none(1);
    let (place, attitude, lever) = by_place(view, &antenna, &gradient(&antenna, range));
    h.set(POSITION, &place);
    h.set(ATTITUDE, &attitude);
    h.set(GNSS_LEVER, &lever);
    h.set(GNSS_DELAY, &(-place * antenna.way));
    h.set(RECEIVER_CLOCK, &RowVector2::new(1.0, 0.0));
    if let Some(index) = system(range) {
        h.set(SYSTEM_OFFSETS, &unit::<3>(index, 1.0));
    }
    h
}

fn gradient(antenna: &Antenna, range: &SatelliteRange) -> RowVector3<f64> {
    range.transmitter.gradient(&antenna.position).transpose()
}

/// What depends on the antenna's place by a row depends on position, attitude and lever arm by these.
fn by_place(
    view: &View,
    antenna: &Antenna,
    row: &RowVector3<f64>,
) -> (RowVector3<f64>, RowVector3<f64>, RowVector3<f64>) {
    (*row, -row * skew(&antenna.arm), row * view.c_eb)
}

fn unit<const W: usize>(index: usize, value: f64) -> SMatrix<f64, 1, W> {
    SMatrix::from_fn(|_, column| if column == index { value } else { 0.0 })
}

/// Innovation of a code.
#[must_use]
pub fn code(view: &View, antenna: &Antenna, sighted: Sighted<'_>) -> Option<Innovation> {
    let Sighted { range, slot } = sighted;
    let code = range.code?;
    let slow = range.slow_std * view.nominal.range_errors[slot]
        + range.multipath_std * view.nominal.reflections[slot]
        + range.by_ionosphere * view.nominal.ionosphere;
    let mut h = geometry(view, antenna, range);
    h.set(RANGE_ERRORS, &unit::<SATELLITES>(slot, range.slow_std));
    h.set(IONOSPHERE, &Matrix1::new(range.by_ionosphere));
    h.set(REFLECTIONS, &unit::<SATELLITES>(slot, range.multipath_std));
    Some(scalar(code.value - predicted(view, antenna, range) - slow, h, &code))
}

/// Innovation of a phase.
#[must_use]
pub fn phase(view: &View, antenna: &Antenna, sighted: Sighted<'_>) -> Option<Innovation> {
    let Sighted { range, slot } = sighted;
    let phase = range.phase?.phase;
    let constant = view.nominal.phase_constants[slot];
    let mut h = geometry(view, antenna, range);
    h.set(PHASE_CONSTANTS, &unit::<SATELLITES>(slot, 1.0));
    Some(scalar(phase.value - predicted(view, antenna, range) - constant, h, &phase))
}

/// Innovation of a range rate.
#[must_use]
pub fn rate(
    view: &View,
    antenna: &Antenna,
    range: &SatelliteRange,
    lever: &Vector3<f64>,
) -> Option<Innovation> {
    let rate = range.rate?;
    let (antenna, lever) = (&antenna.of_range(view, range), &(lever + range.offset));
    let e = -gradient(antenna, range);
    let expected = range.transmitter.range_rate(&antenna.position, &antenna.velocity)
        + view.nominal.receiver_clock.y;
    let apart = range.transmitter.velocity - antenna.velocity;
    let across = apart.transpose() - e * (e * apart)[0];
    let far = (range.transmitter.position - antenna.position).norm();
    let (place, turned, moved) = by_place(view, antenna, &(-across / far));
    let by_gyro = -e * view.c_eb * skew(lever);
    let swing = e * skew(&antenna.swing) + by_gyro * view.earth_rate_by_attitude();
    let mut h = Jacobian::none(1);
    h.set(POSITION, &place);
    h.set(VELOCITY, &-e);
    h.set(ATTITUDE, &(turned + swing));
    h.set(GYRO_BIAS, &by_gyro);
    h.set(GYRO_DRIFT, &by_gyro);
    h.set(GYRO_SCALE, &by_gyro.component_mul(&view.inertial_rate.transpose()));
    h.set(GNSS_LEVER, &(moved - e * view.c_eb * skew(&view.rate)));
    h.set(GNSS_DELAY, &(-place * antenna.way));
    h.set(RECEIVER_CLOCK, &RowVector2::new(0.0, 1.0));
    let swing_noise = by_gyro.norm_squared() * view.rate_variance;
    let noise = Measured { variance: rate.variance + swing_noise, ..rate };
    Some(scalar(rate.value - expected, h, &noise))
}

fn scalar(z: f64, h: Jacobian, measured: &Measured) -> Innovation {
    Innovation::new(&Vector1::new(z), h, &Matrix1::new(measured.variance))
}
