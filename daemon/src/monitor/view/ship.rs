//! The ship, her alignment and her time.

use insd_web::snapshot::{Motion, Snapshot};
use ratatui::Frame;
use ratatui::layout::{Constraint, Rect};
use ratatui::text::{Line, Text};
use ratatui::widgets::{Paragraph, Row, Table, Wrap};

use super::super::text::{bytes, fixed, place, span, state as word_of, word};
use super::{dim, panel, strong};

/// Where she is and how she moves, with 1-sigma.
pub(super) fn ship(frame: &mut Frame<'_>, area: Rect, snapshot: &Snapshot) {
    let nothing = Motion::default();
    let motion = snapshot.motion.as_ref().unwrap_or(&nothing);
    let [lat, lon] = place(motion);
    let heave = motion.heave.as_ref();
    let row = |name: &'static str, value: String, sigma: Option<f64>, digits: usize| {
        let sigma = sigma.map(|sigma| format!("± {}", fixed(Some(sigma), digits)));
        Row::new([
            Line::styled(format!(" {name}"), dim()),
            Line::styled(value, strong()),
            Line::from(sigma.unwrap_or_default()).right_aligned(),
        ])
    };
    let rows = [
        row("Position", lat, motion.ellipse_major_m, 2),
        row("", lon, motion.ellipse_minor_m, 2),
        row("Heading", format!("{}°", fixed(motion.heading_deg, 2)), motion.sigma_heading_deg, 3),
        row("Roll", format!("{}°", fixed(motion.roll_deg, 2)), motion.sigma_roll_deg, 3),
        row("Pitch", format!("{}°", fixed(motion.pitch_deg, 2)), motion.sigma_pitch_deg, 3),
        row("Turning", format!("{}°/min", fixed(motion.rate_of_turn_deg_min, 1)), None, 1),
        row("Speed", format!("{} kn", fixed(motion.speed_kn, 2)), motion.sigma_speed_kn, 2),
        row(
            "Heave",
            format!("{} m", fixed(heave.and_then(|heave| heave.heave_m), 2)),
            heave.and_then(|heave| heave.sigma_heave_m),
            2,
        ),
    ];
    let widths = [Constraint::Length(10), Constraint::Min(16), Constraint::Length(9)];
    let table = Table::new(rows, widths).column_spacing(0).block(panel("Ship, 1-sigma"));
    frame.render_widget(table, area);
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
    let time = &snapshot.time;
    let sigma = time.sigma_s.map_or_else(String::new, |sigma| format!(", within {sigma:.1e} s"));
    tell("UTC by", format!("{}{sigma}", word(&time.quality)));
    for engine in snapshot.engines.iter().filter(|engine| !engine.differs.is_empty()) {
        tell(&engine.name, format!("differs in {}", engine.differs.join(", ")));
    }
    if let Some(recording) = &snapshot.recording {
        let written = bytes(recording.bytes);
        tell("Recording:", format!("{}, {written}", word_of(&recording.state)));
    }
    let text = Paragraph::new(Text::from(lines)).wrap(Wrap { trim: true });
    frame.render_widget(text.block(panel("State")), area);
}
