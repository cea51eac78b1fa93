//! What was not used and why, and what happened last.

use insd_base::Rejection;
use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};
use ratatui::text::{Line, Span, Text};
use ratatui::widgets::Paragraph;

use crate::demo::board::Board;
use crate::demo::rejections;
use crate::style::{dim, panel, strong};
use crate::words;

/// Rejected measurements by aid and reason, most frequent first.
pub(super) fn rejected(frame: &mut Frame<'_>, area: Rect, board: &Board) {
    let mut all: Vec<(&(&'static str, Rejection), &u64)> = board.counts.rejected.iter().collect();
    all.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
    let mut lines: Vec<Line<'_>> = all
        .into_iter()
        .map(|((aid, reason), count)| {
            Line::from(vec![
                Span::styled(format!("{count:>5} "), Style::new().fg(Color::Yellow)),
                Span::raw(format!("{}: ", rejections::aid(aid))),
                Span::styled(rejections::reason(*reason), dim()),
            ])
        })
        .collect();
    if lines.is_empty() {
        lines.push(Line::styled(" none: every measurement was used", dim()));
    }
    frame.render_widget(
        Paragraph::new(Text::from(lines)).block(panel("Rejected measurements", Line::default())),
        area,
    );
}

/// The last events, newest first.
pub(super) fn events(frame: &mut Frame<'_>, area: Rect, board: &Board) {
    let lines: Vec<Line<'_>> = board
        .events
        .newest()
        .map(|event| {
            let times = if event.times > 1 { format!("  x{}", event.times) } else { String::new() };
            Line::from(vec![
                Span::styled(format!("{} ", words::clock(event.time)), dim()),
                Span::raw(event.text.as_str()),
                Span::styled(times, strong()),
            ])
        })
        .collect();
    frame.render_widget(
        Paragraph::new(Text::from(lines)).block(panel("Events", Line::default())),
        area,
    );
}
