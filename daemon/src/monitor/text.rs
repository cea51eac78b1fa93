//! The state of the ship as plain text: many lines at once, or one a second.

use std::fmt::Write as _;

use insd_lab::words;
use insd_web::snapshot::{ShownAlertState, ShownMotion, ShownSky, SkyState, Snapshot};
use serde::Serialize;

/// What is not known.
pub(super) const DASH: &str = "-";

/// A number with so many decimals.
pub(super) fn fixed(value: Option<f64>, digits: usize) -> String {
    let known = value.filter(|value| value.is_finite());
    known.map_or_else(|| DASH.to_owned(), |value| format!("{value:.digits$}"))
}

/// A number and its 1-sigma.
pub(super) fn sure(value: Option<f64>, sigma: Option<f64>, digits: usize, unit: &str) -> String {
    let sigma = sigma.map(|sigma| format!(" ± {}", fixed(Some(sigma), digits)));
    format!("{}{} {unit}", fixed(value, digits), sigma.unwrap_or_default())
}

/// A word of the interface as people write it.
pub(super) fn word(text: &str) -> String {
    if text.is_empty() { DASH.to_owned() } else { text.replace('_', " ") }
}

/// The word of a state.
pub(super) fn state(state: &impl Serialize) -> String {
    let value = serde_json::to_value(state).unwrap_or_default();
    word(value.as_str().unwrap_or_default())
}

/// A time span, s, with its two largest units.
pub(super) fn span(seconds: f64) -> String {
    let seconds = seconds.clamp(0.0, 1e12) as u64;
    match (seconds / 86400, seconds / 3600 % 24, seconds / 60 % 60) {
        (0, 0, 0) => format!("{seconds} s"),
        (0, 0, minutes) => format!("{minutes} min {} s", seconds % 60),
        (0, hours, minutes) => format!("{hours} h {minutes} min"),
        (days, hours, _) => format!("{days} d {hours} h"),
    }
}

/// A count of bytes.
pub(super) fn bytes(count: u64) -> String {
    match count {
        0..10_000 => format!("{count} B"),
        10_000..10_000_000 => format!("{} kB", count / 1000),
        10_000_000..10_000_000_000 => format!("{} MB", count / 1_000_000),
        _ => format!("{} GB", count / 1_000_000_000),
    }
}

/// The time of the day of an instant that is told as of RFC 3339.
pub(super) fn time_of_day(utc: Option<&str>) -> &str {
    utc.and_then(|utc| utc.get(11..19)).unwrap_or(DASH)
}

/// Latitude and longitude.
pub(super) fn place(motion: &ShownMotion) -> [String; 2] {
    let told = |angle: Option<f64>, write: fn(f64) -> String| {
        angle.map_or_else(|| DASH.to_owned(), |angle| write(angle.to_radians()))
    };
    [told(motion.lat_deg, words::latitude), told(motion.lon_deg, words::longitude)]
}

/// How many satellites are used, or why nothing is known of them.
pub(super) fn satellites(sky: &ShownSky) -> String {
    match (sky.state, sky.used) {
        (SkyState::Raw, Some(used)) => format!("{used} of {} used", sky.satellites.len()),
        (state, _) => word_of(state),
    }
}

fn word_of(state: SkyState) -> String {
    match state {
        SkyState::Unknown => "not known".to_owned(),
        SkyState::Silent => "no longer told".to_owned(),
        other => self::state(&other),
    }
}

/// One line.
#[must_use]
pub fn line(snapshot: &Snapshot) -> String {
    let nothing = ShownMotion::default();
    let motion = snapshot.present().unwrap_or(&nothing);
    let [lat, lon] = place(motion);
    format!(
        "{} {}  {lat} {lon}  heading {}  roll {}  pitch {}  {}  course {}  alerts {}",
        time_of_day(snapshot.time.utc.as_deref()),
        word(&snapshot.mode.name),
        sure(motion.heading_deg, motion.sigma_heading_deg, 2, "deg"),
        fixed(motion.roll_deg, 2),
        fixed(motion.pitch_deg, 2),
        sure(motion.speed_kn, None, 2, "kn"),
        fixed(motion.course_deg, 1),
        snapshot.alerts.len(),
    )
}

/// All that matters.
#[must_use]
pub fn summary(snapshot: &Snapshot) -> String {
    let mut text = String::new();
    let mut row = |name: &str, value: &str| {
        // writing to a String cannot fail
        let _ = writeln!(text, "{name:<11} {value}");
    };
    let program = &snapshot.program;
    row("program", &format!("insd {}, up {}", program.version, span(program.uptime_s)));
    let sigma = snapshot.time.sigma_s.map(|sigma| format!(", within {sigma:.1e} s"));
    let utc = snapshot.time.utc.as_deref().unwrap_or("unknown");
    row("utc", &format!("{utc}, {}{}", snapshot.time.quality, sigma.unwrap_or_default()));
    let mode = &snapshot.mode;
    let reason = mode.reason.as_deref().map(|reason| format!(": {reason}"));
    let since = span(mode.since_s);
    row("mode", &format!("{} for {since}{}", word(&mode.name), reason.unwrap_or_default()));
    let nothing = ShownMotion::default();
    ship(snapshot.present().unwrap_or(&nothing), &mut row);
    if let Some(alignment) = &snapshot.alignment {
        row("alignment", &alignment.text);
    }
    for sensor in &snapshot.sensors {
        let (kind, rate) = (word(&sensor.kind), fixed(sensor.rate_hz, 1));
        row("sensor", &format!("{}: {}, {kind}, {rate} Hz", sensor.name, state(&sensor.state)));
    }
    row("satellites", &satellites(&snapshot.sky));
    let unused = snapshot.sky.satellites.iter().filter(|own| !own.fate.is_used());
    for own in unused {
        let why = own.text.as_deref().unwrap_or(DASH);
        row("", &format!("{}: {}, {why}", own.name, state(&own.fate)));
    }
    for port in &snapshot.inputs {
        let damage = format!("{} damaged, {} overrun", port.damaged, bytes(port.overrun_bytes));
        row(
            "input",
            &format!("{}: {}, {}, {damage}", port.name, state(&port.state), bytes(port.bytes)),
        );
    }
    for port in &snapshot.outputs {
        let fate = format!("{} sent, {} dropped", port.sent, port.dropped);
        row("output", &format!("{}: {}, {fate}", port.name, state(&port.state)));
    }
    for alert in snapshot.alerts.iter().filter(|alert| alert.state != ShownAlertState::Normal) {
        let (priority, state) = (state(&alert.priority), state(&alert.state));
        row("alert", &format!("{} {}: {priority}, {state}", alert.id, alert.title));
    }
    text
}

fn ship(motion: &ShownMotion, row: &mut impl FnMut(&str, &str)) {
    let [lat, lon] = place(motion);
    let within = fixed(motion.ellipse_major_m, 1);
    row("position", &format!("{lat} {lon}, 1-sigma {within} m"));
    row("heading", &sure(motion.heading_deg, motion.sigma_heading_deg, 2, "deg"));
    row("roll", &sure(motion.roll_deg, motion.sigma_roll_deg, 2, "deg"));
    row("pitch", &sure(motion.pitch_deg, motion.sigma_pitch_deg, 2, "deg"));
    row("turning", &sure(motion.rate_of_turn_deg_min, None, 1, "deg/min"));
    row("speed", &sure(motion.speed_kn, motion.sigma_speed_kn, 2, "kn"));
    row("course", &sure(motion.course_deg, motion.sigma_course_deg, 1, "deg"));
    if let Some(heave) = &motion.heave {
        row("heave", &sure(heave.heave_m, heave.sigma_heave_m, 2, "m"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_unknown_is_a_dash() {
        let mut snapshot = Snapshot { motion: Some(ShownMotion::default()), ..Snapshot::default() };
        snapshot.mode.name = "fine_alignment".to_owned();
        let text = summary(&snapshot);
        assert!(text.contains("heading     - deg\n"), "{text}");
        assert!(text.contains("mode        fine alignment for 0 s\n"), "{text}");
        assert!(line(&snapshot).starts_with("- fine alignment  - -  heading - deg"));
    }

    #[test]
    fn values_come_with_their_sigmas() {
        let motion = ShownMotion {
            lat_deg: Some(53.5),
            lon_deg: Some(-8.25),
            heading_deg: Some(62.041),
            sigma_heading_deg: Some(0.062),
            ..ShownMotion::default()
        };
        let text = summary(&Snapshot { motion: Some(motion), ..Snapshot::default() });
        assert!(text.contains("heading     62.04 ± 0.06 deg\n"), "{text}");
        assert!(text.contains("position    53°30.000' N 008°15.000' W"), "{text}");
        assert_eq!(span(3.0 * 86400.0 + 7300.0), "3 d 2 h");
    }
}
