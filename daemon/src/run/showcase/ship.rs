//! Where the ship is, how she moves and lies.

use std::f64::consts::PI;

use insd_base::units::{DEG, KNOT, wrap_two_pi};
use insd_base::{
    HeaveQuality, Integrity, Judgement, Mode, Motion, Solution, SolutionSource, SourceReason, Time,
};
use insd_output::{Ellipse, Policy};
use insd_web::snapshot::{Freshness, ShownHeave, ShownMotion as Shown, ShownSource};
use nalgebra::Vector3;

/// The last change of the source of the solutions: when, to which, why.
pub(super) type SourceTold = (Time, SolutionSource, SourceReason);

/// What the position lives by at an instant; since when and why is known of a change that was told.
pub(super) fn source(
    solution: &Solution,
    told: Option<&SourceTold>,
    now: Time,
    utc: impl Fn(Time) -> Option<String>,
) -> Option<ShownSource> {
    let own = solution.source?;
    let told = told.filter(|(_, to, _)| *to == own);
    Some(ShownSource {
        name: own.as_str().to_owned(),
        text: own.text().to_owned(),
        since_s: told.map(|(since, ..)| (now - *since).as_seconds()),
        changed_utc: told.and_then(|(since, ..)| utc(*since)),
        reason: told.map(|(.., why)| why.to_string()),
    })
}

/// What is shown of a motion, at the IMU.
pub(super) fn motion(
    motion: &Motion,
    heave: Option<insd_base::Heave>,
    utc: impl Fn(Time) -> Option<String>,
) -> Shown {
    let solution = &motion.solution;
    let (position, velocity, attitude) =
        (&solution.position, &solution.velocity.0, &solution.attitude);
    let sigma = &solution.sigma;
    let policy = Policy::default();
    // what receivers and compass say in place of an IMU knows nothing of these
    let inertial = |value: f64| (solution.mode != Mode::Standby).then_some(value);
    let course = policy.has_course(solution).then(|| solution.course() / DEG);
    let speed = solution.speed();
    let speed_sigma = sigma.velocity.0.x.hypot(sigma.velocity.0.y) / std::f64::consts::SQRT_2;
    let ellipse = motion.covariance_north_east().and_then(|own| Ellipse::new(&sigma.position, own));
    let current = motion.current.map(|current| current.velocity.0);
    let ahead = current.map(|current| ahead(&(velocity - current), attitude.heading));
    Shown {
        valid_at_s: solution.time.as_seconds(),
        freshness: Freshness::Fresh,
        valid_utc: utc(solution.time),
        point: None,
        lat_deg: Some(position.latitude / DEG),
        lon_deg: Some(position.longitude / DEG),
        height_m: Some(position.height),
        velocity_north_mps: Some(velocity.x),
        velocity_east_mps: Some(velocity.y),
        velocity_down_mps: Some(velocity.z),
        speed_kn: Some(speed / KNOT),
        course_deg: course,
        water_speed_kn: ahead.map(|ahead| ahead / KNOT),
        current_speed_kn: current.map(|current| current.x.hypot(current.y) / KNOT),
        current_set_deg: current.map(|current| wrap_two_pi(current.y.atan2(current.x)) / DEG),
        roll_deg: inertial(attitude.roll / DEG),
        pitch_deg: inertial(attitude.pitch / DEG),
        heading_deg: (sigma.heading < PI).then_some(attitude.heading / DEG),
        rate_of_turn_deg_min: inertial(solution.rate_of_turn() / DEG * 60.0),
        heave: heave.map(|heave| shown_heave(&heave)),
        sigma_north_m: Some(sigma.position.0.x),
        sigma_east_m: Some(sigma.position.0.y),
        sigma_height_m: Some(sigma.position.0.z),
        ellipse_major_m: ellipse.map(|own| own.major),
        ellipse_minor_m: ellipse.map(|own| own.minor),
        ellipse_direction_deg: ellipse.map(|own| own.orientation / DEG),
        sigma_velocity_north_mps: Some(sigma.velocity.0.x),
        sigma_velocity_east_mps: Some(sigma.velocity.0.y),
        sigma_velocity_down_mps: Some(sigma.velocity.0.z),
        sigma_speed_kn: Some(speed_sigma / KNOT),
        sigma_course_deg: course.map(|_| (speed_sigma / speed).atan() / DEG),
        sigma_roll_deg: inertial(sigma.roll / DEG),
        sigma_pitch_deg: inertial(sigma.pitch / DEG),
        sigma_heading_deg: (sigma.heading < PI).then_some(sigma.heading / DEG),
        heading_quality: Some(word(&policy.heading(solution))),
        position_quality: Some(word(&policy.quality(solution))),
        velocity_quality: Some(word(&policy.velocity(solution))),
        level_quality: Some(level(&policy, solution)),
        ..reliance(solution)
    }
}

/// How far the position may be relied on, and who is left out.
fn reliance(solution: &Solution) -> Shown {
    let Judgement { integrity, excluded } = solution.judgement;
    let is_watched = integrity != Integrity::Unwatched;
    let levels = solution.protection();
    Shown {
        integrity: is_watched.then(|| solution.availability().as_str().to_owned()),
        excluded: excluded.iter().map(|party| party.as_str().to_owned()).collect(),
        hpl_m: Some(levels.horizontal),
        vpl_m: Some(levels.vertical),
        ..Shown::default()
    }
}

/// The component of a velocity, north and east, along the bow.
fn ahead(velocity: &Vector3<f64>, heading: f64) -> f64 {
    let (sin, cos) = heading.sin_cos();
    velocity.x * cos + velocity.y * sin
}

fn level(policy: &Policy, solution: &Solution) -> String {
    if policy.is_level(solution) { "valid" } else { "not_valid" }.to_owned()
}

fn shown_heave(heave: &insd_base::Heave) -> ShownHeave {
    let delayed = heave.delayed.as_ref();
    ShownHeave {
        valid_at_s: heave.time.as_seconds(),
        heave_m: Some(heave.heave),
        sigma_heave_m: Some(heave.sigma),
        quality: match heave.quality {
            HeaveQuality::Settled => "settled",
            HeaveQuality::Reduced => "reduced",
            HeaveQuality::Unsettled => "unsettled",
        }
        .to_owned(),
        delayed_heave_m: delayed.map(|delayed| delayed.heave),
        sigma_delayed_heave_m: delayed.map(|delayed| delayed.sigma),
        delay_s: delayed.map(|delayed| (heave.time - delayed.time).as_seconds()),
    }
}

/// The name of a variant in small letters: `NotValid` as `not_valid`.
fn word(variant: &impl std::fmt::Debug) -> String {
    let mut word = String::new();
    for letter in format!("{variant:?}").chars() {
        if letter.is_uppercase() && !word.is_empty() {
            word.push('_');
        }
        word.extend(letter.to_lowercase());
    }
    word
}
