//! A voyage's header as the text of `voyage.toml`.

use std::fmt::Write;

use insd_base::units::{DEG_PER_HOUR, DEG_PER_SQRT_HOUR, MICRO_G, MPS_PER_SQRT_HOUR, PPM};
use insd_base::{Body, StartCondition, VesselKind, VoyageHeader};

/// The text of `voyage.toml`.
pub(super) fn header_text(header: &VoyageHeader) -> String {
    let mode = match header.start {
        StartCondition::Moored => "moored",
        StartCondition::Underway => "underway",
    };
    let mut text = format!("start_utc = \"{}\"\nmode = \"{mode}\"\n", header.start_utc);
    if let Some(initial) = &header.initial {
        text.push_str("\n[initial]\n");
        push_number(&mut text, "lat_deg", initial.latitude.to_degrees());
        push_number(&mut text, "lon_deg", initial.longitude.to_degrees());
        push_number(&mut text, "height_m", initial.height);
    }
    if header.vessel != VesselKind::default() || header.time_std.is_some() {
        let _ = writeln!(text, "\n[ship]\nkind = \"{}\"", header.vessel.as_str());
    }
    header.time_std.iter().for_each(|std| push_number(&mut text, "gnss_delay_std_s", *std));
    text.push_str("\n[imu]\n");
    let (gyro, accel) = (&header.imu.gyro, &header.imu.accel);
    for (key, value) in [
        ("rate_hz", header.imu.rate),
        ("gyro_bias_std_deg_h", gyro.bias_std / DEG_PER_HOUR),
        ("gyro_bias_instability_deg_h", gyro.instability_std / DEG_PER_HOUR),
        ("gyro_bias_time_constant_s", gyro.instability_time),
        ("angle_random_walk_deg_sqrt_h", gyro.random_walk / DEG_PER_SQRT_HOUR),
        ("gyro_scale_factor_std_ppm", gyro.scale_std / PPM),
        ("accel_bias_std_ug", accel.bias_std / MICRO_G),
        ("accel_bias_instability_ug", accel.instability_std / MICRO_G),
        ("accel_bias_time_constant_s", accel.instability_time),
        ("velocity_random_walk_mps_sqrt_h", accel.random_walk / MPS_PER_SQRT_HOUR),
        ("accel_scale_factor_std_ppm", accel.scale_std / PPM),
    ] {
        push_number(&mut text, key, value);
    }
    text.push_str("\n[lever_arms_m]\n");
    push_arm(&mut text, "gnss", &header.lever_arms.gnss);
    push_arm(&mut text, "log", &header.lever_arms.log);
    text
}

fn push_number(text: &mut String, key: &str, value: f64) {
    let _ = writeln!(text, "{key} = {:?}", tidy(value));
}

fn push_arm(text: &mut String, key: &str, arm: &Body) {
    let [x, y, z] = [arm.0.x, arm.0.y, arm.0.z].map(tidy);
    let _ = writeln!(text, "{key} = [{x:?}, {y:?}, {z:?}]");
}

/// The value with 14 digits, so that a change of units leaves 0.003 and not 0.0029999999999999996.
fn tidy(value: f64) -> f64 {
    format!("{value:.13e}").parse().unwrap_or(value)
}
