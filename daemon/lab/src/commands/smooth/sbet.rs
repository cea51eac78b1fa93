//! A trajectory in the manner of an SBET file ("smoothed best estimate of trajectory"): the same seventeen quantities of each epoch in the same order, as text.

use insd_base::Solution;
use nalgebra::Vector3;
use serde::Serialize;

/// An epoch. Angles in rad, wander angle zero: the axes of the velocity are north, east and down.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct SbetRow {
    t_s: f64,
    latitude_rad: f64,
    longitude_rad: f64,
    height_m: f64,
    vn_mps: f64,
    ve_mps: f64,
    vd_mps: f64,
    roll_rad: f64,
    pitch_rad: f64,
    heading_rad: f64,
    wander_rad: f64,
    ax_mps2: f64,
    ay_mps2: f64,
    az_mps2: f64,
    rate_x_rad_s: f64,
    rate_y_rad_s: f64,
    rate_z_rad_s: f64,
}

impl SbetRow {
    /// All epochs of a voyage; acceleration over the Earth, body axes, from the velocities before and after.
    pub(super) fn all(solutions: &[Solution]) -> impl Iterator<Item = SbetRow> + '_ {
        let last = solutions.len().saturating_sub(1);
        solutions.iter().enumerate().map(move |(at, own)| {
            let (before, after) =
                (&solutions[at.saturating_sub(1)], &solutions[(at + 1).min(last)]);
            SbetRow::of(own, &acceleration(before, after))
        })
    }

    /// `acceleration` north, east and down, m/s^2.
    fn of(own: &Solution, acceleration: &Vector3<f64>) -> Self {
        let body = own.attitude.c_nb().transpose() * acceleration;
        let (velocity, rate) = (&own.velocity.0, &own.rate.0);
        SbetRow {
            t_s: own.time.as_seconds(),
            latitude_rad: own.position.latitude,
            longitude_rad: own.position.longitude,
            height_m: own.position.height,
            vn_mps: velocity.x,
            ve_mps: velocity.y,
            vd_mps: velocity.z,
            roll_rad: own.attitude.roll,
            pitch_rad: own.attitude.pitch,
            heading_rad: own.attitude.heading,
            wander_rad: 0.0,
            ax_mps2: body.x,
            ay_mps2: body.y,
            az_mps2: body.z,
            rate_x_rad_s: rate.x,
            rate_y_rad_s: rate.y,
            rate_z_rad_s: rate.z,
        }
    }
}

fn acceleration(before: &Solution, after: &Solution) -> Vector3<f64> {
    let dt = (after.time - before.time).as_seconds();
    if dt > 0.0 { (after.velocity.0 - before.velocity.0) / dt } else { Vector3::zeros() }
}
