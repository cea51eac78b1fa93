//! The demo's picture. Laid out for 80 x 24 and better; a larger terminal also shows the track.

mod banner;
mod compass;
mod notes;
mod sensors;
mod ship;
mod track;

#[cfg(test)]
mod tests;

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::widgets::Paragraph;

use super::board::Board;
use super::plain;

/// Smallest terminal that the picture fits into.
const LEAST: (u16, u16) = (80, 24);

/// From this size on there is room for the track.
const ROOMY: (u16, u16) = (100, 32);

/// Draws the board over the whole frame.
pub fn draw(frame: &mut Frame<'_>, board: &Board) {
    let area = frame.area();
    if area.width < LEAST.0 || area.height < LEAST.1 {
        let hint = format!("please make the window larger: {} x {}\n\n", LEAST.0, LEAST.1);
        let text = hint + &plain::line(board);
        frame.render_widget(Paragraph::new(text).wrap(ratatui::widgets::Wrap { trim: true }), area);
        return;
    }
    let [title, mode, alongside, upper, strip, lower, port, keys] = Layout::vertical([
        Constraint::Length(1),
        Constraint::Length(1),
        Constraint::Length(u16::from(board.alongside.is_some())),
        Constraint::Length(11),
        Constraint::Length(3),
        Constraint::Min(5),
        Constraint::Length(1),
        Constraint::Length(1),
    ])
    .areas(area);
    let [left, right] = Layout::horizontal([Constraint::Fill(1), Constraint::Fill(1)]).areas(upper);
    banner::title(frame, title, board);
    banner::mode(frame, mode, board);
    banner::alongside(frame, alongside, board);
    ship::draw(frame, left, board);
    sensors::draw(frame, right, board);
    compass::draw(frame, strip, board);
    draw_lower(frame, lower, board);
    banner::port(frame, port, board);
    banner::keys(frame, keys, board);
}

fn draw_lower(frame: &mut Frame<'_>, area: Rect, board: &Board) {
    let whole = frame.area();
    let notes = if whole.width >= ROOMY.0 && whole.height >= ROOMY.1 {
        let halves = [Constraint::Percentage(58), Constraint::Percentage(42)];
        let [map, notes] = Layout::horizontal(halves).areas(area);
        track::draw(frame, map, board);
        Layout::vertical([Constraint::Percentage(50), Constraint::Percentage(50)]).split(notes)
    } else {
        Layout::horizontal([Constraint::Percentage(50), Constraint::Percentage(50)]).split(area)
    };
    notes::rejected(frame, notes[0], board);
    notes::events(frame, notes[1], board);
}
