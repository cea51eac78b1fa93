//! The ship, her alignment and her time.

use insd_web::snapshot::{ShownMotion, SkyState, Snapshot};
use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::text::{Line, Text};
use ratatui::widgets::{Paragraph, Row, Table, Wrap};

use super::super::text::{DASH, bytes, fixed, place, satellites, span, state as word_of, word};
use insd_lab::style::{dim, strong, titled};

/// Rows of what is told of the ship.
pub(super) const ROWS: u16 = 5;

/// Where she is and how she moves, with 1-sigma, in two columns.
pub(super) fn ship(frame: &mut Frame<'_>, area: Rect, snapshot: &Snapshot) {
    let nothing = ShownMotion::default();
    let motion = snapshot.present().unwrap_or(&nothing);
    let block = titled("Ship, 1-sigma");
    let inner = block.inner(area);
    frame.render_widget(block, area);
    let halves = Layout::horizontal([Constraint::Fill(1), Constraint::Fill(1)]).areas(inner);
    let widths = [Constraint::Length(10), Constraint::Min(16), Constraint::Length(9)];
    let [left, right]: [Rect; 2] = halves;
    for (rows, area) in [(place_and_level(motion), left), (way(motion), right)] {
        frame.render_widget(Table::new(rows, widths).column_spacing(0), area);
    }
}

fn row(name: &'static str, value: String, sigma: Option<f64>, digits: usize) -> Row<'static> {
    let sigma = sigma.map(|sigma| format!("± {}", fixed(Some(sigma), digits)));
    Row::new([
        Line::styled(format!(" {name}"), dim()),
        Line::styled(value, strong()),
        Line::from(sigma.unwrap_or_default()).right_aligned(),
    ])
}

/// A number with its unit; without a number there is no unit.
fn with_unit(value: Option<f64>, digits: usize, unit: &str) -> String {
    let text = fixed(value, digits);
    if text == DASH { text } else { text + unit }
}

fn place_and_level(motion: &ShownMotion) -> [Row<'static>; ROWS as usize] {
    let [lat, lon] = place(motion);
    [
        row("Position", lat, motion.ellipse_major_m, 2),
        row("", lon, motion.ellipse_minor_m, 2),
        row("Heading", with_unit(motion.heading_deg, 2, "°"), motion.sigma_heading_deg, 3),
        row("Roll", with_unit(motion.roll_deg, 2, "°"), motion.sigma_roll_deg, 3),
        row("Pitch", with_unit(motion.pitch_deg, 2, "°"), motion.sigma_pitch_deg, 3),
    ]
}

fn way(motion: &ShownMotion) -> [Row<'static>; ROWS as usize] {
    let heave = motion.heave.as_ref();
    let drift = with_unit(motion.current_speed_kn, 1, " kn");
    let current = match motion.current_set_deg {
        Some(set) => format!("{drift} to {set:.0}°"),
        None => DASH.to_owned(),
    };
    [
        row("Speed", with_unit(motion.speed_kn, 2, " kn"), motion.sigma_speed_kn, 2),
        row("Course", with_unit(motion.course_deg, 1, "°"), motion.sigma_course_deg, 1),
        row("Turning", with_unit(motion.rate_of_turn_deg_min, 1, "°/min"), None, 1),
        row("Current", current, None, 1),
        row(
            "Heave",
            with_unit(heave.and_then(|heave| heave.heave_m), 2, " m"),
            heave.and_then(|heave| heave.sigma_heave_m),
            2,
        ),
    ]
}

/// Alignment, time, recording.
pub(super) fn state(frame: &mut Frame<'_>, area: Rect, snapshot: &Snapshot) {
    let mut lines = Vec::new();
    let mut tell = |name: &str, value: String| {
        lines.push(Line::from(vec![format!("{name} ").into(), value.into()]));
    };
    if let Some(alignment) = &snapshot.alignment {
        tell("Alignment:", alignment.text.clone());
        if let Some(ready) = alignment.ready_in_s {
            tell("Ready in", span(ready));
        }
    }
    if let Some(source) = snapshot.present().and_then(|motion| motion.source.as_ref()) {
        let since =
            source.since_s.map_or_else(String::new, |since| format!(" for {}", span(since)));
        let why = source.reason.as_ref().map_or_else(String::new, |why| format!(" ({why})"));
        tell("Lives by", format!("{}{since}{why}", source.text));
    }
    let time = &snapshot.time;
    let sigma = time.sigma_s.map_or_else(String::new, |sigma| format!(", within {sigma:.1e} s"));
    tell("UTC by", format!("{}{sigma}", word(&time.quality)));
    if snapshot.sky.state != SkyState::Unknown {
        tell("Satellites:", satellites(&snapshot.sky));
    }
    for engine in snapshot.engines.iter().filter(|engine| !engine.differs.is_empty()) {
        tell(&engine.name, format!("differs in {}", engine.differs.join(", ")));
    }
    if let Some(recording) = &snapshot.recording {
        let written = bytes(recording.bytes);
        tell("Recording:", format!("{}, {written}", word_of(&recording.state)));
    }
    let text = Paragraph::new(Text::from(lines)).wrap(Wrap { trim: true });
    frame.render_widget(text.block(titled("State")), area);
}
