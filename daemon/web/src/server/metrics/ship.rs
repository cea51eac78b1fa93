//! The ship, the navigator and her time.

use crate::snapshot::{ShownMotion, Snapshot};

use super::sheet::Sheet;

/// Name, help, and where it is found.
type Reading = (&'static str, &'static str, fn(&ShownMotion) -> Option<f64>);

const READINGS: [Reading; 19] = [
    ("latitude_degrees", "Latitude, WGS-84, north positive", |m| m.lat_deg),
    ("longitude_degrees", "Longitude, WGS-84, east positive", |m| m.lon_deg),
    ("height_meters", "Height above the ellipsoid", |m| m.height_m),
    ("speed_knots", "Speed over ground", |m| m.speed_kn),
    ("course_degrees", "Course over ground, true", |m| m.course_deg),
    ("heading_degrees", "True heading", |m| m.heading_deg),
    ("roll_degrees", "Roll, starboard side down positive", |m| m.roll_deg),
    ("pitch_degrees", "Pitch, bow up positive", |m| m.pitch_deg),
    ("rate_of_turn_degrees_per_minute", "Rate of turn, to starboard positive", |m| {
        m.rate_of_turn_deg_min
    }),
    ("heave_meters", "Heave, up positive", |m| m.heave.as_ref()?.heave_m),
    ("heading_sigma_degrees", "1-sigma of the heading", |m| m.sigma_heading_deg),
    ("roll_sigma_degrees", "1-sigma of the roll", |m| m.sigma_roll_deg),
    ("pitch_sigma_degrees", "1-sigma of the pitch", |m| m.sigma_pitch_deg),
    ("north_sigma_meters", "1-sigma of the position to the north", |m| m.sigma_north_m),
    ("east_sigma_meters", "1-sigma of the position to the east", |m| m.sigma_east_m),
    ("height_sigma_meters", "1-sigma of the height", |m| m.sigma_height_m),
    ("horizontal_protection_level_meters", "Horizontal protection level", |m| m.hpl_m),
    ("vertical_protection_level_meters", "Protection level of the height", |m| m.vpl_m),
    ("speed_sigma_knots", "1-sigma of the speed", |m| m.sigma_speed_kn),
];

/// Enters all of it.
pub(super) fn write(sheet: &mut Sheet, snapshot: &Snapshot) {
    // a metric cannot be marked as old
    if let Some(motion) = snapshot.present() {
        for (name, help, of) in READINGS {
            sheet.value(name, help, of(motion));
        }
        reliance(sheet, motion);
    }
    program(sheet, snapshot);
    alignment(sheet, snapshot);
    let alerts = sheet.gauge(
        "alert_active",
        "Alerts that are not normal, by identifier, title, priority and state",
        ["id", "title", "priority", "state"],
    );
    for alert in &snapshot.alerts {
        let (priority, state) = (word(&alert.priority), word(&alert.state));
        alerts.set(&[&alert.id.to_string(), &alert.title, &priority, &state], 1.0);
    }
}

fn reliance(sheet: &mut Sheet, motion: &ShownMotion) {
    if let Some(integrity) = &motion.integrity {
        sheet
            .gauge("integrity", "Whether the position may be relied on: 1", ["state"])
            .set(&[integrity], 1.0);
    }
    if let Some(source) = &motion.source {
        sheet
            .gauge("source", "What the position lives by: 1", ["source"])
            .set(&[&source.name], 1.0);
        sheet.value("source_seconds", "How long it has lived by that", source.since_s);
    }
    let excluded = sheet.gauge("sensor_excluded", "Who is left out: 1", ["party"]);
    for party in &motion.excluded {
        excluded.set(&[party], 1.0);
    }
}

fn program(sheet: &mut Sheet, snapshot: &Snapshot) {
    let program = &snapshot.program;
    let hash = program.configuration_hash.as_deref().unwrap_or("");
    sheet
        .gauge("build_info", "Version and configuration", ["version", "configuration"])
        .set(&[&program.version, hash], 1.0);
    sheet.value("uptime_seconds", "Time since the start", program.uptime_s);
    let memory = program.memory_bytes.map(|bytes| bytes as f64);
    sheet.value("memory_bytes", "Resident memory", memory);
    sheet.value("processor_seconds", "Processor time used", program.processor_s);
    sheet.gauge("mode", "What the system is doing: 1", ["mode"]).set(&[&snapshot.mode.name], 1.0);
    sheet.value(
        "told_ago_seconds",
        "How long ago the navigator told all this",
        snapshot.time.told_ago_s,
    );
    let navigating = f64::from(u8::from(snapshot.is_navigating()));
    sheet.value("navigating", "Whether the heading is good enough to navigate by", navigating);
    let time = &snapshot.time;
    sheet
        .gauge("utc_sigma_seconds", "1-sigma of UTC", ["quality"])
        .set(&[&time.quality], time.sigma_s);
}

fn alignment(sheet: &mut Sheet, snapshot: &Snapshot) {
    let Some(alignment) = &snapshot.alignment else { return };
    let target = alignment.target_deg;
    sheet.value("alignment_target_degrees", "Heading sigma that is asked for", target);
    sheet.value("alignment_ready_in_seconds", "Time until it is expected", alignment.ready_in_s);
}

/// The word of a state, as in JSON.
pub(super) fn word(state: &impl serde::Serialize) -> String {
    let word = serde_json::to_value(state).unwrap_or_default();
    word.as_str().unwrap_or_default().to_owned()
}
