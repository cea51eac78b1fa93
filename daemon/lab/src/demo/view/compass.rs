//! The compass card unrolled: heading in the middle, course as it lies beside it.

use insd_base::Solution;
use insd_base::units::wrap_pi;
use insd_output::Policy;
use ratatui::Frame;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};

use crate::demo::board::Board;
use crate::style::{dim, strong};

/// Degrees in one column.
const SCALE: f64 = 1.0;

/// Half-widths of the doubt that are worth showing, degrees.
const DOUBT: std::ops::Range<f64> = 1.0..90.0;

/// Draws marks, scale and labels in three lines.
pub(super) fn draw(frame: &mut Frame<'_>, area: Rect, board: &Board) {
    let Some(solution) = board.solution.filter(|s| s.attitude.heading.is_finite()) else {
        return;
    };
    let buffer = frame.buffer_mut();
    let heading = solution.attitude.heading.to_degrees();
    for column in 0..area.width {
        let offset = f64::from(column) - f64::from(area.width / 2);
        let degree = ((heading + offset * SCALE).round() as i64).rem_euclid(360);
        tick(buffer, (area.x + column, area.y + 1), degree);
        label(buffer, area, column, degree);
    }
    doubt(buffer, area, &solution);
    marks(buffer, area, &solution);
}

fn tick(buffer: &mut Buffer, (x, y): (u16, u16), degree: i64) {
    let (symbol, style) = match degree {
        d if d % 10 == 0 => ("┼", Style::new()),
        d if d % 5 == 0 => ("┴", dim()),
        _ => ("─", dim()),
    };
    buffer.set_string(x, y, symbol, style);
}

/// Centres a label of three characters below a tenth degree, if it fits.
fn label(buffer: &mut Buffer, area: Rect, column: u16, degree: i64) {
    let fits = (1..area.width.saturating_sub(1)).contains(&column);
    if degree % 10 != 0 || !fits {
        return;
    }
    let text = match degree {
        0 => " N ".to_owned(),
        90 => " E ".to_owned(),
        180 => " S ".to_owned(),
        270 => " W ".to_owned(),
        _ => format!("{degree:03}"),
    };
    let style = if degree % 90 == 0 { strong() } else { Style::new() };
    buffer.set_string(area.x + column - 1, area.y + 2, text, style);
}

/// Underlays the scale where the heading may be, if that is wide enough to see.
fn doubt(buffer: &mut Buffer, area: Rect, solution: &Solution) {
    let half = 1.96 * solution.sigma.heading.to_degrees();
    if DOUBT.contains(&half) {
        let columns = ((half / SCALE).round() as u16).min(area.width / 2);
        let from = area.width / 2 - columns;
        let width = (2 * columns + 1).min(area.width - from);
        let span = Rect { x: area.x + from, y: area.y + 1, width, height: 1 };
        buffer.set_style(span, Style::new().bg(Color::Yellow).fg(Color::Black));
    }
}

fn marks(buffer: &mut Buffer, area: Rect, solution: &Solution) {
    let centre = area.x + area.width / 2;
    let moving = Policy::default().has_course(solution);
    let drift = wrap_pi(solution.course() - solution.attitude.heading).to_degrees() / SCALE;
    let column = f64::from(centre) + drift.round();
    let inside = (f64::from(area.x)..f64::from(area.right())).contains(&column);
    if moving && inside {
        let style = Style::new().fg(Color::Cyan).bold();
        let column = column as u16;
        buffer.set_string(column, area.y, "◇", style);
        caption(buffer, area, column, "course", style);
    }
    let style = strong().fg(Color::Green);
    buffer.set_string(centre, area.y, "▼", style);
    buffer.set_string(centre.saturating_sub(8), area.y, "heading", style);
}

/// Names a mark at its right, where there is room.
fn caption(buffer: &mut Buffer, area: Rect, column: u16, text: &str, style: Style) {
    let centre = area.x + area.width / 2;
    let from = if column < centre { (centre + 2).max(column + 2) } else { column + 2 };
    if usize::from(area.right().saturating_sub(from)) > text.len() && column >= centre {
        buffer.set_string(from, area.y, text, style);
    }
}
