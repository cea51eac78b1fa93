//! The monitor's picture: as much as the terminal has room for, what matters most first.

mod lists;
mod ship;
mod sky;

#[cfg(test)]
mod tests;

use insd_web::snapshot::Snapshot;
use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::{Color, Style};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Paragraph, Wrap};

use super::board::{Board, Link};
use super::text::{line, span, time_of_day, word};
use insd_lab::style::{alarm, dim, strong};

/// Smallest terminal that the picture fits into.
const LEAST: (u16, u16) = (72, 20);

/// What is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum MonitorView {
    /// The ship, her sensors and her ports.
    #[default]
    Ship,
    /// The satellites.
    Satellites,
}

impl MonitorView {
    /// What is looked at after a letter was pressed.
    #[must_use]
    pub fn after(self, letter: char) -> Self {
        match (letter, self) {
            ('s', MonitorView::Ship) => MonitorView::Satellites,
            ('s', MonitorView::Satellites) => MonitorView::Ship,
            _ => self,
        }
    }
}

/// Draws what the board knows over the whole frame.
pub fn draw(frame: &mut Frame<'_>, board: &Board, url: &str, view: MonitorView) {
    let area = frame.area();
    let (link, age) = board.link();
    let Some(snapshot) = board.snapshot() else {
        let fault = board.fault().unwrap_or_else(|| "connecting".to_owned());
        let text = format!("{url}\n\n{fault}\n\nq or Ctrl-C ends");
        frame.render_widget(Paragraph::new(text).wrap(Wrap { trim: true }), area);
        return;
    };
    if area.width < LEAST.0 || area.height < LEAST.1 {
        let text = format!("please make the window larger: {} x {}\n\n", LEAST.0, LEAST.1);
        let text = text + &line(&snapshot);
        frame.render_widget(Paragraph::new(text).wrap(Wrap { trim: true }), area);
        return;
    }
    let [title, mode, rest, keys] = Layout::vertical([
        Constraint::Length(1),
        Constraint::Length(1),
        Constraint::Fill(1),
        Constraint::Length(1),
    ])
    .areas(area);
    head(frame, title, &snapshot, link);
    banner(frame, mode, &snapshot, link, age.as_secs_f64());
    let other = match view {
        MonitorView::Ship => "satellites",
        MonitorView::Satellites => "ship",
    };
    match view {
        MonitorView::Ship => parts(frame, rest, &snapshot),
        MonitorView::Satellites => sky::satellites(frame, rest, &snapshot),
    }
    let text = format!(" {url}   s: {other}   q or Ctrl-C ends");
    frame.render_widget(Line::styled(text, dim()), keys);
}

/// The ship and what she has on board.
fn parts(frame: &mut Frame<'_>, area: Rect, snapshot: &Snapshot) {
    let wanted = [
        2 + ship::ROWS,
        2 + (snapshot.alerts.len() as u16).clamp(4, 8),
        3 + snapshot.sensors.len() as u16,
        3 + (snapshot.inputs.len() + snapshot.outputs.len()) as u16,
    ];
    let [ship, middle, sensors, ports] = granted(wanted, area.height);
    let [ship, middle, sensors, ports, journal] = Layout::vertical([
        Constraint::Length(ship),
        Constraint::Length(middle),
        Constraint::Length(sensors),
        Constraint::Length(ports),
        Constraint::Fill(1),
    ])
    .areas(area);
    ship::ship(frame, ship, snapshot);
    let [left, right] =
        Layout::horizontal([Constraint::Fill(1), Constraint::Fill(1)]).areas(middle);
    lists::alerts(frame, left, snapshot);
    ship::state(frame, right, snapshot);
    lists::sensors(frame, sensors, snapshot);
    lists::ports(frame, ports, snapshot);
    if journal.height > 2 {
        lists::events(frame, journal, snapshot);
    }
}

/// Gives each part the rows that it wants as long as there are any, the first ones first. A part of which
/// not even a line would be seen gets none.
fn granted<const N: usize>(wanted: [u16; N], mut rows: u16) -> [u16; N] {
    wanted.map(|own| {
        let given = if rows > 3 { own.min(rows) } else { 0 };
        rows -= given;
        given
    })
}

fn head(frame: &mut Frame<'_>, area: Rect, snapshot: &Snapshot, link: Link) {
    let program = &snapshot.program;
    let mut parts = vec![
        Span::styled(format!(" {} ", program.unit.as_deref().unwrap_or("insd")), strong()),
        Span::raw(format!("insd {} up {} ", program.version, span(program.uptime_s))),
    ];
    if program.simulated {
        let style = Style::new().fg(Color::Black).bg(Color::Magenta);
        parts.push(Span::styled(" SIMULATED ", style));
    }
    frame.render_widget(Line::from(parts), area);
    let utc = snapshot.time.utc.as_deref();
    let date = utc.and_then(|utc| utc.get(..10)).unwrap_or("");
    let text = format!("{date} {} UTC ", time_of_day(utc));
    let style = if link == Link::Live { Style::new() } else { alarm() };
    frame.render_widget(Line::styled(text, style).right_aligned(), area);
}

/// The mode in its colour; in red what is old.
fn banner(frame: &mut Frame<'_>, area: Rect, snapshot: &Snapshot, link: Link, age: f64) {
    let mode = &snapshot.mode;
    let old = match link {
        Link::Lost => Some("CONNECTION LOST"),
        Link::Silent => Some("NO NEW DATA"),
        Link::Live | Link::Connecting => None,
    };
    let (text, colour) = match old {
        Some(what) => (format!(" {what}: nothing is known for {}", span(age)), Color::Red),
        None => {
            let reason = mode.reason.as_deref().unwrap_or_default();
            (format!(" {}  {reason}", word(&mode.name).to_uppercase()), colour(&mode.name))
        }
    };
    let style = Style::new().fg(Color::Black).bg(colour).bold();
    frame.render_widget(Line::styled(text, style).style(style), area);
    if old.is_none() {
        let since = format!("for {} ", span(mode.since_s));
        frame.render_widget(Line::styled(since, style).right_aligned(), area);
    }
}

/// Green may be used, yellow with care, cyan not yet, red not at all.
fn colour(mode: &str) -> Color {
    match mode {
        "aided" => Color::Green,
        "dead_reckoning" | "inertial" => Color::Yellow,
        "fault" => Color::Red,
        "" | "standby" => Color::Gray,
        _ => Color::Cyan,
    }
}
