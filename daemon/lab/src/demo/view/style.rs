//! How things look: boxes, and what stands out of them.

use ratatui::style::{Color, Style};
use ratatui::text::Line;
use ratatui::widgets::{Block, BorderType};

/// A box with a title at its left and, if any, a note at its right.
pub(super) fn panel<'a>(title: &'a str, note: Line<'a>) -> Block<'a> {
    Block::bordered()
        .border_type(BorderType::Rounded)
        .border_style(dim())
        .title(Line::styled(format!(" {title} "), Style::new().bold().fg(Color::Reset)))
        .title(note.right_aligned())
}

/// Of what matters less.
pub(super) fn dim() -> Style {
    Style::new().fg(Color::DarkGray)
}

/// Of what the eye should find first.
pub(super) fn strong() -> Style {
    Style::new().bold()
}

/// Of what is wrong.
pub(super) fn alarm() -> Style {
    Style::new().fg(Color::Red).bold()
}
