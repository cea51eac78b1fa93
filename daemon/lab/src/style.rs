//! How terminals of ours look: boxes, and what stands out of them.

use ratatui::style::{Color, Style};
use ratatui::text::Line;
use ratatui::widgets::{Block, BorderType};

/// A box with a title at its left.
#[must_use]
pub fn titled(title: &str) -> Block<'_> {
    Block::bordered()
        .border_type(BorderType::Rounded)
        .border_style(dim())
        .title(Line::styled(format!(" {title} "), Style::new().bold().fg(Color::Reset)))
}

/// The same with a note at its right, if there is any.
#[must_use]
pub fn panel<'a>(title: &'a str, note: Line<'a>) -> Block<'a> {
    titled(title).title(note.right_aligned())
}

/// Of what matters less.
#[must_use]
pub fn dim() -> Style {
    Style::new().fg(Color::DarkGray)
}

/// Of what the eye should find first.
#[must_use]
pub fn strong() -> Style {
    Style::new().bold()
}

/// Of what is wrong.
#[must_use]
pub fn alarm() -> Style {
    Style::new().fg(Color::Red).bold()
}
