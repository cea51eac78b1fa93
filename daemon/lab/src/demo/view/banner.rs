//! The lines across the whole width: what this is, how far it may be trusted, where its NMEA goes.

use insd_base::{Mode, Time};
use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};
use ratatui::text::{Line, Span};

use crate::demo::board::{Board, Phase};
use crate::style::{dim, strong};
use crate::words;

/// Age of a solution that is no longer worth showing as the present, s.
const STALE: f64 = 2.0;

/// Program, scenario and time.
pub(super) fn title(frame: &mut Frame<'_>, area: Rect, board: &Board) {
    let left = Line::from(vec![
        Span::styled(" insd demo ", strong()),
        Span::styled(" SIMULATED SHIP ", Style::new().fg(Color::Black).bg(Color::Magenta)),
        Span::raw(format!(" {}", board.title)),
    ]);
    let time = board.utc.map_or_else(|| words::clock(board.now), words::utc);
    frame.render_widget(left, area);
    frame.render_widget(Line::raw(format!(" {time} ")).right_aligned(), area);
}

/// The mode, over the whole width and in its colour.
pub(super) fn mode(frame: &mut Frame<'_>, area: Rect, board: &Board) {
    let mode = board.solution.map(|solution| solution.mode);
    let age = board.solution.map(|solution| (board.now - solution.time).as_seconds());
    let stale = age.is_some_and(|age| age > STALE) && board.phase == Phase::Sailing;
    let (words, colour) = match (board.phase, mode) {
        (Phase::Preparing, _) => ("PREPARING  making the voyage", Color::Gray),
        (_, Some(_)) if stale => ("NO NEW SOLUTION  the IMU is silent: do not use", Color::Red),
        (_, mode) => (words::mode_advice(mode), colour(mode)),
    };
    let style = Style::new().fg(Color::Black).bg(colour).bold();
    let since = Time::START + (board.now - board.mode_since);
    let since = mode.map(|_| format!("for {} ", words::clock(since))).unwrap_or_default();
    frame.render_widget(Line::styled(format!(" {words}"), style).style(style), area);
    frame.render_widget(Line::styled(since, style).right_aligned(), area);
}

/// How she stands to the berth that she goes to, where she goes to one.
pub(super) fn alongside(frame: &mut Frame<'_>, area: Rect, board: &Board) {
    let text = board.alongside.as_deref().unwrap_or_default();
    frame.render_widget(Line::styled(format!(" {text}"), strong()), area);
}

/// Green may be used, yellow with care, cyan not yet, red not at all.
fn colour(mode: Option<Mode>) -> Color {
    match mode {
        None => Color::Gray,
        Some(Mode::Aided) => Color::Green,
        Some(Mode::DeadReckoning | Mode::Inertial) => Color::Yellow,
        Some(Mode::Fault) => Color::Red,
        Some(_) => Color::Cyan,
    }
}

/// Where the sentences go.
pub(super) fn port(frame: &mut Frame<'_>, area: Rect, board: &Board) {
    let port = &board.port;
    let unread = match port.dropped {
        0 => String::new(),
        dropped => format!(", {} dropped unread", bytes(dropped)),
    };
    let line = Line::from(vec![
        Span::styled(" NMEA 0183 ", strong()),
        Span::raw("try "),
        Span::styled(format!("cat {}", port.path), Style::new().fg(Color::Cyan)),
        Span::styled(format!("   {} written{unread}", bytes(port.written)), dim()),
    ]);
    frame.render_widget(line, area);
}

/// What the user can do, and how fast time runs.
pub(super) fn keys(frame: &mut Frame<'_>, area: Rect, board: &Board) {
    frame.render_widget(Line::styled(" q or Ctrl-C ends the demo", dim()), area);
    let pace = match board.phase {
        Phase::Arrived => "the voyage has ended ".to_owned(),
        _ if board.behind > 2.0 => {
            format!("time x {}, this computer is {:.0} s behind ", board.speed, board.behind)
        }
        _ => format!("voyage {}, time x {} ", words::clock(board.now), board.speed),
    };
    frame.render_widget(Line::styled(pace, dim()).right_aligned(), area);
}

fn bytes(count: u64) -> String {
    match count {
        0..10_000 => format!("{count} B"),
        10_000..10_000_000 => format!("{} kB", count / 1000),
        _ => format!("{} MB", count / 1_000_000),
    }
}
