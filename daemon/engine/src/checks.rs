//! Plausibility of messages and of our own solution: what is not finite or not physical never
//! reaches the filter and never leaves it.

use insd_base::{Geodetic, Message, Ned, Received, Solution, VesselKind};

/// Speeds beyond this are no craft's, m/s.
const MAX_SPEED: f64 = 500.0;
/// Heights beyond this are no ship's, m.
const MAX_HEIGHT: f64 = 20_000.0;

/// The message without its implausible parts, and the names of the aids they belonged to.
pub(crate) fn checked(received: &Received, vessel: VesselKind) -> (Received, Vec<&'static str>) {
    let mut faults = Vec::new();
    let fastest = vessel.greatest_speed();
    let is_speed = |speed: &f64| speed.abs() < fastest;
    let mut clean = received.clone();
    match &mut clean.message {
        // ranges are judged one by one where they are made
        Message::Imu(_)
        | Message::Ranges(_)
        | Message::Base(_)
        | Message::Rtk(_)
        | Message::Compass(_) => {}
        // the filter asks whether a distance can be one
        Message::Ranging(_) => {}
        // and looks at each point of an image, and at a step
        Message::Camera(_) | Message::Odometry(_) => {}
        Message::Gnss(fix) => {
            keep(&mut fix.position, is_place, "gnss_position", &mut faults);
            keep(&mut fix.velocity, |v| v.0.iter().all(is_speed), "gnss_velocity", &mut faults);
        }
        Message::Log(log) => {
            for component in [&mut log.u, &mut log.v, &mut log.w] {
                keep(component, is_speed, "log", &mut faults);
            }
        }
        Message::Reference(reference) => {
            keep(&mut reference.position, is_place, "reference_position", &mut faults);
            keep(&mut reference.v_north, is_speed, "reference_velocity", &mut faults);
            keep(&mut reference.v_east, is_speed, "reference_velocity", &mut faults);
            let is_angle = |angle: &f64| angle.abs() < 10.0;
            keep(&mut reference.heading, is_angle, "reference_heading", &mut faults);
        }
    }
    (clean, faults)
}

fn keep<T>(
    value: &mut Option<T>,
    is_plausible: impl Fn(&T) -> bool,
    aid: &'static str,
    faults: &mut Vec<&'static str>,
) {
    if value.as_ref().is_some_and(|v| !is_plausible(v)) {
        *value = None;
        faults.push(aid);
    }
}

fn is_place(place: &Geodetic) -> bool {
    place.latitude.abs() <= std::f64::consts::FRAC_PI_2
        && place.longitude.abs() <= std::f64::consts::TAU
        && place.height.abs() < MAX_HEIGHT
}

fn is_velocity(velocity: &Ned) -> bool {
    velocity.0.iter().all(|v| v.abs() < MAX_SPEED)
}

/// Whether a solution can be shown to anyone: finite, on the Earth, with finite sigmas.
pub(crate) fn is_sound(solution: &Solution) -> bool {
    let sigma = &solution.sigma;
    let angles = [solution.attitude.roll, solution.attitude.pitch, solution.attitude.heading];
    is_place(&solution.position)
        && is_velocity(&solution.velocity)
        && angles.iter().all(|angle| angle.is_finite())
        && sigma.position.0.iter().chain(sigma.velocity.0.iter()).all(|s| s.is_finite())
        && [sigma.roll, sigma.pitch, sigma.heading].iter().all(|s| s.is_finite())
}
