//! Sensors, ports, alerts and the journal.

use insd_web::snapshot::{
    GONE, SensorState, ShownAlertState, ShownPortState, ShownPriority, ShownSeverity, Snapshot,
};
use ratatui::Frame;
use ratatui::layout::{Constraint, Rect};
use ratatui::style::{Color, Style};
use ratatui::text::{Line, Text};
use ratatui::widgets::{Paragraph, Row, Table};

use super::super::text::{bytes, fixed, state, time_of_day};
use insd_lab::style::{alarm, dim, strong, titled};

fn right(text: String) -> Line<'static> {
    Line::from(text).right_aligned()
}

/// Counts of what should not happen.
fn fault(count: u64) -> Line<'static> {
    let style = if count > 0 { Style::new().fg(Color::Yellow) } else { dim() };
    Line::styled(count.to_string(), style).right_aligned()
}

fn good(is_good: bool) -> Style {
    if is_good { Style::new().fg(Color::Green) } else { alarm() }
}

/// The sensors.
pub(super) fn sensors(frame: &mut Frame<'_>, area: Rect, snapshot: &Snapshot) {
    let rows = snapshot.sensors.iter().map(|sensor| {
        let style = match sensor.state {
            SensorState::Waiting | SensorState::Received | SensorState::Unknown => dim(),
            other => good(other == SensorState::Valid),
        };
        let refused: u64 = sensor.refused.iter().map(|cause| cause.count).sum();
        Row::new([
            Line::styled(format!(" {}", sensor.name), strong()),
            Line::from(sensor.kind.clone()),
            Line::styled(state(&sensor.state), style),
            right(fixed(sensor.rate_hz, 1)),
            right(fixed(sensor.age_s, 1)),
            fault(refused),
            fault(sensor.lost),
            Line::from(format!(" {}", sensor.used_for.join(", "))),
        ])
    });
    let head = ["", "", "", "Hz", "age s", "refused", "lost", " used for"].map(heading);
    let widths = [
        Constraint::Length(16),
        Constraint::Length(11),
        Constraint::Length(9),
        Constraint::Length(7),
        Constraint::Length(7),
        Constraint::Length(8),
        Constraint::Length(6),
        Constraint::Fill(1),
    ];
    let table = Table::new(rows, widths).column_spacing(0).header(Row::new(head).style(dim()));
    frame.render_widget(table.block(titled("Sensors")), area);
}

fn heading(text: &'static str) -> Line<'static> {
    let line = Line::from(text);
    if text.starts_with(' ') { line } else { line.right_aligned() }
}

/// The ports, first those that are listened to.
pub(super) fn ports(frame: &mut Frame<'_>, area: Rect, snapshot: &Snapshot) {
    let style = |state: ShownPortState| match state {
        ShownPortState::Waiting | ShownPortState::Ended | ShownPortState::Unknown => dim(),
        other => good(other == ShownPortState::Open),
    };
    let inputs = snapshot.inputs.iter().map(|port| {
        Row::new([
            Line::styled(format!(" < {}", port.name), strong()),
            Line::styled(state(&port.state), style(port.state)),
            right(format!("{} B/s", fixed(port.rate_bytes_s, 0))),
            right(bytes(port.bytes)),
            fault(port.damaged + port.overrun_bytes),
            Line::from(format!(" {}", port.last_error.as_deref().unwrap_or(&port.what))),
        ])
    });
    let outputs = snapshot.outputs.iter().map(|port| {
        Row::new([
            Line::styled(format!(" > {}", port.name), strong()),
            Line::styled(state(&port.state), style(port.state)),
            right(format!("{} B/s", fixed(port.rate_bytes_s, 0))),
            right(bytes(port.bytes)),
            fault(port.dropped),
            Line::from(format!(" {}", port.last_error.as_deref().unwrap_or(&port.what))),
        ])
    });
    let head = ["", "", "", "", "bad", ""].map(heading);
    let widths = [
        Constraint::Length(18),
        Constraint::Length(8),
        Constraint::Length(11),
        Constraint::Length(9),
        Constraint::Length(7),
        Constraint::Fill(1),
    ];
    let rows = inputs.chain(outputs);
    let table = Table::new(rows, widths).column_spacing(0).header(Row::new(head).style(dim()));
    frame.render_widget(table.block(titled("Ports")), area);
}

/// Alerts in their colours.
pub(super) fn alerts(frame: &mut Frame<'_>, area: Rect, snapshot: &Snapshot) {
    let lines: Vec<Line<'_>> = snapshot
        .alerts
        .iter()
        .map(|alert| {
            let colour = match alert.priority {
                ShownPriority::EmergencyAlarm | ShownPriority::Alarm => Color::Red,
                ShownPriority::Warning => Color::LightRed,
                ShownPriority::Caution | ShownPriority::Unknown => Color::Yellow,
            };
            let asks = matches!(alert.state, ShownAlertState::Unacknowledged);
            let style = Style::new().fg(colour);
            let style = if asks { style.bold() } else { style };
            let text =
                format!(" {} {}: {}", state(&alert.priority), alert.title, state(&alert.state));
            Line::styled(text, style)
        })
        .collect();
    let room = usize::from(area.height.saturating_sub(2));
    let mut lines = lines;
    if lines.len() > room {
        lines.truncate(room.saturating_sub(1));
        let more = snapshot.alerts.len() - lines.len();
        lines.push(Line::styled(format!(" and {more} more"), alarm()));
    }
    let none = if snapshot.time.told_ago_s > GONE { " not known" } else { " none" };
    let text = if lines.is_empty() { Text::from(none) } else { Text::from(lines) };
    frame.render_widget(Paragraph::new(text).block(titled("Alerts")), area);
}

/// The last lines of the journal, newest first.
pub(super) fn events(frame: &mut Frame<'_>, area: Rect, snapshot: &Snapshot) {
    let lines: Vec<Line<'_>> = snapshot
        .events
        .iter()
        .rev()
        .take(usize::from(area.height))
        .map(|event| {
            let style = match event.severity {
                ShownSeverity::Error => alarm(),
                ShownSeverity::Warn => Style::new().fg(Color::Yellow),
                _ => Style::new(),
            };
            let time = time_of_day(event.utc.as_deref());
            Line::styled(format!(" {time} {}", event.text), style)
        })
        .collect();
    frame.render_widget(Paragraph::new(Text::from(lines)).block(titled("Journal")), area);
}
