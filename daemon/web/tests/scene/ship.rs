//! How the made-up ship moves and lies.

use std::f64::consts::TAU;

use insd_web::snapshot::{
    DisturbanceAxis, Found, Freshness, ShownAlignment, ShownDisturbance, ShownEstimate,
    ShownEstimates, ShownFit, ShownHeave, ShownMotion, ShownSource,
};

use super::{Scene, utc};

/// Metres of a degree of latitude.
const DEGREE: f64 = 111_320.0;

/// A swell: amplitude, period, and where it begins.
fn swell(t: f64, amplitude: f64, period: f64, phase: f64) -> f64 {
    amplitude * ((TAU * t / period + phase).sin() + 0.3 * (TAU * t / (period * 0.63)).sin())
}

/// Way made north and east, m, and heading, deg.
fn sailed(t: f64, scene: Scene) -> (f64, f64, f64) {
    if scene == Scene::Alignment {
        return (swell(t, 0.3, 95.0, 0.0), swell(t, 0.5, 120.0, 1.0), 341.3);
    }
    // a winding way: the heading swings about 62 degrees
    let (mut north, mut east) = (0.0, 0.0);
    let steps = (t.max(0.0) / 2.0) as u32;
    for step in 0..steps {
        let heading = (62.0 + 38.0 * (f64::from(step) * 2.0 / 55.0).sin()).to_radians();
        north += 13.0 * heading.cos();
        east += 13.0 * heading.sin();
    }
    let heading = 62.0 + 38.0 * (t / 55.0).sin();
    let rest = (t - f64::from(steps) * 2.0) * 6.5;
    north += rest * heading.to_radians().cos();
    east += rest * heading.to_radians().sin();
    (north, east, heading)
}

/// How she moves and lies.
pub(super) fn motion(t: f64, scene: Scene) -> ShownMotion {
    let (moored, fault) = (scene == Scene::Alignment, scene == Scene::Fault);
    let (north, east, course) = sailed(t, scene);
    let heading = (course + swell(t, 0.4, 11.0, 0.4)).rem_euclid(360.0);
    let sigma_heading = if moored { alignment_sigma(t) } else { 0.062 };
    let lost = if fault { (t - 240.0).max(0.0) } else { 0.0 };
    let sigma = 0.6 + 0.03 * lost;
    let speed = if moored { 0.04 } else { 12.63 + swell(t, 0.06, 30.0, 0.0) };
    let scale = if moored { 0.25 } else { 1.0 };
    let along = |part: f64| speed * 0.5144 * part;
    ShownMotion {
        valid_at_s: t - 0.004,
        valid_utc: Some(utc(t - 0.004)),
        point: None,
        lat_deg: Some(53.9213 + north / DEGREE),
        lon_deg: Some(8.6514 + east / (DEGREE * 0.589)),
        height_m: Some(41.2 + swell(t, 0.4 * scale, 9.0, 0.0)),
        velocity_north_mps: Some(along(course.to_radians().cos())),
        velocity_east_mps: Some(along(course.to_radians().sin())),
        velocity_down_mps: Some(swell(t, 0.2 * scale, 9.0, 1.2)),
        speed_kn: Some(speed),
        course_deg: (!moored).then(|| (course + 2.2).rem_euclid(360.0)),
        water_speed_kn: (!moored).then_some(speed - 0.7),
        current_speed_kn: (!moored).then_some(0.9),
        current_set_deg: (!moored).then_some(118.0),
        roll_deg: Some(swell(t, 4.2 * scale, 10.5, 0.0) + 0.4),
        pitch_deg: Some(swell(t, 1.3 * scale, 7.6, 0.8) - 0.2),
        heading_deg: Some(heading),
        rate_of_turn_deg_min: Some(if moored {
            swell(t, 0.6, 11.0, 2.0)
        } else {
            60.0 * 38.0 / 55.0 * (t / 55.0).cos() + swell(t, 3.0, 11.0, 2.0)
        }),
        heave: Some(heave(t, scale)),
        sigma_north_m: Some(sigma),
        sigma_east_m: Some(sigma * 0.8),
        sigma_height_m: Some(1.1),
        ellipse_major_m: Some(sigma * 1.05),
        ellipse_minor_m: Some(sigma * 0.74),
        ellipse_direction_deg: Some(24.0),
        sigma_velocity_north_mps: Some(0.02),
        sigma_velocity_east_mps: Some(0.02),
        sigma_velocity_down_mps: Some(0.03),
        sigma_speed_kn: Some(if fault { 0.11 } else { 0.04 }),
        sigma_course_deg: (!moored).then_some(0.2),
        sigma_roll_deg: Some(0.011),
        sigma_pitch_deg: Some(0.011),
        sigma_heading_deg: Some(sigma_heading),
        heading_quality: Some(if moored { "not_valid" } else { "autonomous" }.to_owned()),
        freshness: Freshness::Fresh,
        velocity_quality: Some("autonomous".to_owned()),
        level_quality: Some("valid".to_owned()),
        integrity: (!moored).then(|| if fault { "unavailable" } else { "available" }.to_owned()),
        excluded: fault.then(|| "gnss".to_owned()).into_iter().collect(),
        source: (!moored).then(|| source(t, fault)),
        hpl_m: Some(5.5 * sigma),
        vpl_m: Some(5.7),
        position_quality: Some(if fault { "estimated" } else { "differential" }.to_owned()),
    }
}

/// Her base is heard until the receiver lies.
fn source(t: f64, fault: bool) -> ShownSource {
    let (name, text, since, reason) = if fault {
        let reason = "nothing better is heard or used";
        ("dr", "dead reckoning, without satellites", 240.0, reason)
    } else {
        let text = "RTK: carrier phases against a base, with integers";
        ("rtk", text, 195.0, "it has come")
    };
    ShownSource {
        name: name.to_owned(),
        text: text.to_owned(),
        since_s: Some((t - since).max(0.0)),
        changed_utc: Some(utc(since)),
        reason: Some(reason.to_owned()),
    }
}

fn heave(t: f64, scale: f64) -> ShownHeave {
    ShownHeave {
        valid_at_s: t - 0.004,
        heave_m: Some(swell(t, 0.72 * scale, 9.0, 0.0)),
        sigma_heave_m: Some(0.03),
        quality: "settled".to_owned(),
        delayed_heave_m: Some(swell(t - 120.0, 0.72 * scale, 9.0, 0.0)),
        sigma_delayed_heave_m: Some(0.01),
        delay_s: Some(120.0),
    }
}

/// Heading sigma while she lies at her berth, deg.
fn alignment_sigma(t: f64) -> f64 {
    0.1 + 3.4 * (-t / 95.0).exp()
}

/// What the alignment knows.
pub(super) fn alignment(t: f64, scene: Scene) -> ShownAlignment {
    let moored = scene == Scene::Alignment;
    let sigma = if moored { alignment_sigma(t) } else { 0.062 };
    let ready = 426.0;
    let forecast = if moored { "expected" } else { "reached" };
    let target = 0.17;
    let text = if moored {
        let minutes = (ready - t) / 60.0;
        format!(
            "a heading of {target} deg, 1 sigma, is expected in {minutes:.0} min; \
             the motion of the ship at her berth limits it"
        )
    } else {
        format!("a heading of {target} deg, 1 sigma, is reached")
    };
    ShownAlignment {
        told_at_s: t,
        phase: if moored { "fine" } else { "aligned" }.to_owned(),
        moored,
        progress: Some(if moored { (t / ready).min(1.0) } else { 1.0 }),
        sigma_heading_deg: Some(sigma),
        sigma_roll_deg: Some(0.011),
        sigma_pitch_deg: Some(0.011),
        target_deg: Some(target),
        gyrocompass_deg: Some(0.067),
        forecast: forecast.to_owned(),
        ready_in_s: moored.then_some((ready - t).max(0.0)),
        ready_utc: moored.then(|| utc(ready)),
        reached_at_s: (!moored).then_some(180.0),
        best_deg: None,
        limited_by: moored.then(|| "sea".to_owned()),
        lacks: None,
        text,
        sea_period_s: Some(8.8),
        sea_heave_m: Some(0.42),
        shifts: 1,
        stored_state: Some("dropped".to_owned()),
    }
}

/// What the filter has found out.
pub(super) fn estimates(t: f64) -> ShownEstimates {
    let estimate =
        |value: f64, sigma: f64| ShownEstimate { value: Some(value), sigma: Some(sigma) };
    let settling = (-t / 600.0).exp();
    let gyro = [0.0041, -0.0062, 0.0088].map(|bias| estimate(bias, 0.002 + 0.008 * settling));
    let accel = [22.0, -31.0, 8.0].map(|bias| estimate(bias, 6.0 + 30.0 * settling));
    ShownEstimates {
        gyro_bias_deg_h: gyro.to_vec(),
        accel_bias_ug: accel.to_vec(),
        log_scale_ppm: Some(estimate(-1840.0, 420.0)),
        log_misalignment_deg: Some(estimate(0.34, 0.08)),
        gnss_lever_m: Vec::new(),
        gnss_delay_s: Some(estimate(0.004, 0.006)),
        course_less_heading_deg: Some(estimate(-1.2, 0.2)),
    }
}

/// What moves her at her berth.
pub(super) fn disturbance() -> ShownDisturbance {
    // swaying with a period of 80 s, and waves of 8.8 s
    let hump = |hz: f64, peak: f64, height: f64, sharp: f64| {
        let ratio = hz / peak;
        height / (1.0 + sharp * (ratio - 1.0 / ratio).powi(2))
    };
    let density = |hz: f64| hump(hz, 0.0125, 9.0, 30.0) + hump(hz, 0.114, 0.6, 60.0) + 0.02;
    let ripple = |hz: f64| 1.0 + 0.45 * (hz * 910.0).sin() * (hz * 527.0).cos();
    let grid = || (2..=120).map(|k| f64::from(k) * 0.001_04);
    let axis = DisturbanceAxis {
        name: "horizontal".to_owned(),
        coefficients: [1.842, 0.002, -0.003, 1.791, -1.031, 0.004, 0.006, -0.984].to_vec(),
        residual_mps: None,
        residual_m: Some(0.081),
        model: grid().map(|hz| [hz, density(hz)]).collect(),
        measured: grid().map(|hz| [hz, density(hz) * ripple(hz)]).collect(),
        dominant_period_s: Some(80.0),
    };
    ShownDisturbance {
        method: "autoregressive".to_owned(),
        quantity: "displacement".to_owned(),
        order: Some(2),
        interval_s: Some(4.0),
        window_s: Some(600.0),
        radius: Some(0.973),
        fit: Some(ShownFit {
            residual: Some("coloured".to_owned()),
            level: Some(0.48),
            slow: Some(1.26),
            correlation: Some(0.42),
            apart_s: Some(8.0),
            fallbacks: 0,
            text: "of order 2: what it leaves is not white (0.42 after 8 s), its slow part 1.26 of the claimed"
                .to_owned(),
        }),
        axes: vec![axis],
    }
}

/// In the scene of a fault the antenna sits elsewhere than configured.
pub(super) fn installation(scene: Scene) -> Vec<Found> {
    let lever = Found {
        name: "gnss_lever".to_owned(),
        text: "the GNSS antenna seems 28.0 m higher than configured: gnss_lever_m = [-6.0, -0.8, -14.0], \
               good to 0.2 m"
            .to_owned(),
        paste: Some("gnss_lever_m = [-6.0, -0.8, -14.0]".to_owned()),
        fault: true,
    };
    if scene == Scene::Fault { vec![lever] } else { Vec::new() }
}
