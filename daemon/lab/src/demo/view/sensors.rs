//! The sensors: age, rate, used, rejected.

use insd_base::Span;
use ratatui::Frame;
use ratatui::layout::{Constraint, Rect};
use ratatui::style::{Color, Style};
use ratatui::text::Line;
use ratatui::widgets::{Row, Table};

use crate::demo::board::Board;
use crate::demo::sensors::DemoSensorStatus;
use crate::style::{alarm, dim, panel};

/// Draws the box.
pub(super) fn draw(frame: &mut Frame<'_>, area: Rect, board: &Board) {
    let right = |text: String| Line::from(text).right_aligned();
    let head = ["age", "per s", "used", "rejected"];
    let head = std::iter::once(Line::raw("")).chain(head.map(|name| right(name.to_owned())));
    let mut rows = vec![Row::new(head).style(dim())];
    rows.extend(board.sensors.iter().map(row));
    rows.extend(bridged(board));
    let widths = [11, 6, 6, 6, 9].map(Constraint::Length);
    let table = Table::new(rows, widths).column_spacing(0).block(panel("Sensors", Line::default()));
    frame.render_widget(table, area);
}

fn row(status: &DemoSensorStatus) -> Row<'static> {
    let right = |text: String, style| Line::styled(text, style).right_aligned();
    let (mark, style) = match (status.silent, status.age) {
        (true, None) => ("○ ", dim()),
        (true, Some(_)) => ("● ", alarm()),
        (false, _) => ("● ", Style::new().fg(Color::Green)),
    };
    let age_style = if status.silent { alarm() } else { Style::new() };
    let rejected = if status.rejected > 0 { Style::new().fg(Color::Yellow) } else { dim() };
    Row::new([
        Line::styled(format!("{mark}{}", status.kind.name()), style),
        right(status.age.map_or_else(|| "never".to_owned(), age), age_style),
        right(rate(status.rate), Style::new()),
        right(count(status.used), Style::new()),
        right(count(status.rejected), rejected),
    ])
}

/// What happened to the IMU's stream, if anything.
fn bridged(board: &Board) -> Option<Row<'static>> {
    let gaps = board.counts.imu_gaps;
    let text = format!("  {gaps} gaps bridged");
    (gaps > 0).then(|| Row::new([Line::styled(text, Style::new().fg(Color::Yellow))]))
}

fn age(age: Span) -> String {
    match age.as_seconds() {
        s if s < 10.0 => format!("{s:.1} s"),
        s if s < 100.0 => format!("{s:.0} s"),
        s if s < 6000.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.0} h", s / 3600.0),
    }
}

fn rate(rate: f64) -> String {
    if rate > 0.0 && rate < 9.5 { format!("{rate:.1}") } else { format!("{rate:.0}") }
}

fn count(count: u64) -> String {
    match count {
        0..100_000 => count.to_string(),
        100_000..10_000_000 => format!("{}k", count / 1000),
        _ => format!("{}M", count / 1_000_000),
    }
}
