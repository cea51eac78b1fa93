//! The track on a north-up map.

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};
use ratatui::symbols::Marker;
use ratatui::text::{Line, Span};
use ratatui::widgets::canvas::{self, Canvas, Context, Points};

use crate::demo::board::{Board, Tracks};
use crate::style::{dim, panel};
use crate::words;

/// Least half-width of the map, m, so that a ship at her berth does not fill it.
const LEAST: f64 = 50.0;

/// Height of a terminal's character over its width.
const CHARACTER: f64 = 2.0;

/// A square region of the sea: centre and half-height, m.
#[derive(Clone, Copy)]
struct Region {
    east: f64,
    north: f64,
    half: f64,
}

/// Draws the box.
pub(super) fn draw(frame: &mut Frame<'_>, area: Rect, board: &Board) {
    let region = region(&board.tracks, aspect(area));
    let height = words::distance(2.0 * region.half);
    let note = Line::from(vec![
        Span::styled(" own", Style::new().fg(Color::Green)),
        Span::styled(" truth", Style::new().fg(Color::Magenta)),
        Span::styled(" GNSS", Style::new().fg(Color::Yellow)),
        Span::styled(format!(" · north up, {height} high "), dim()),
    ]);
    let half_width = region.half * aspect(area);
    let canvas = Canvas::default()
        .block(panel("Track", note))
        .marker(Marker::Braille)
        .x_bounds([region.east - half_width, region.east + half_width])
        .y_bounds([region.north - region.half, region.north + region.half])
        .paint(|context| paint(context, &board.tracks, region.half));
    frame.render_widget(canvas, area);
}

/// Width over height of the box's inside.
fn aspect(area: Rect) -> f64 {
    let inside = |length: u16| f64::from(length.saturating_sub(2).max(1));
    inside(area.width) / (CHARACTER * inside(area.height))
}

fn paint(context: &mut Context<'_>, tracks: &Tracks, half: f64) {
    context.draw(&Points { coords: tracks.gnss.points(), color: Color::Yellow });
    context.layer();
    join(context, tracks.truth.points(), Color::Magenta);
    context.layer();
    join(context, tracks.own.points(), Color::Green);
    if let Some((east, north)) = tracks.own.points().last() {
        let arm = half / 25.0;
        let mut stroke = |x1, y1, x2, y2| {
            context.draw(&canvas::Line { x1, y1, x2, y2, color: Color::White });
        };
        stroke(east - arm, *north, east + arm, *north);
        stroke(*east, north - arm, *east, north + arm);
    }
}

fn join(context: &mut Context<'_>, points: &[(f64, f64)], color: Color) {
    for pair in points.windows(2) {
        let [(x1, y1), (x2, y2)] = [pair[0], pair[1]];
        context.draw(&canvas::Line { x1, y1, x2, y2, color });
    }
}

/// The smallest region that holds own and true track with some margin; GNSS outliers may lie
/// outside.
fn region(tracks: &Tracks, aspect: f64) -> Region {
    let points = || tracks.own.points().iter().chain(tracks.truth.points());
    let span = |values: &mut dyn Iterator<Item = f64>| {
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(value), high.max(value))
        })
    };
    let (west, east) = span(&mut points().map(|point| point.0));
    let (south, north) = span(&mut points().map(|point| point.1));
    if !(west <= east && south <= north) {
        return Region { east: 0.0, north: 0.0, half: LEAST };
    }
    let half = ((north - south) / 2.0).max((east - west) / 2.0 / aspect) * 1.15;
    Region { east: (west + east) / 2.0, north: (south + north) / 2.0, half: half.max(LEAST) }
}
