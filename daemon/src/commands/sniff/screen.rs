//! The report redrawn in place, and the terminal given back afterwards.

use std::io::{self, Write};

use ratatui::crossterm::cursor::{Hide, MoveTo, Show};

use ratatui::crossterm::terminal::{
    Clear, ClearType, EnterAlternateScreen, LeaveAlternateScreen, size,
};
use ratatui::crossterm::{execute, queue};

/// The other screen of the terminal, so that what stood there before comes back.
#[derive(Debug)]
pub(super) struct Screen;

impl Screen {
    /// Goes to the other screen.
    ///
    /// # Errors
    /// A terminal that fails.
    pub(super) fn open() -> io::Result<Self> {
        execute!(io::stdout(), EnterAlternateScreen, Hide)?;
        Ok(Screen)
    }

    /// Shows as much of a text as there is room for.
    ///
    /// # Errors
    /// A terminal that fails.
    pub(super) fn draw(&self, text: &str) -> io::Result<()> {
        let (columns, rows) = size().unwrap_or((80, 24));
        let text = fitted(text, usize::from(columns), usize::from(rows));
        let mut out = io::stdout().lock();
        queue!(out, MoveTo(0, 0), Clear(ClearType::All))?;
        out.write_all(text.as_bytes())?;
        out.flush()
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        let _ = execute!(io::stdout(), Show, LeaveAlternateScreen);
    }
}

/// The first lines and columns of a text; the last line tells how much is left out.
fn fitted(text: &str, columns: usize, rows: usize) -> String {
    let lines: Vec<String> =
        text.lines().map(|line| line.chars().take(columns).collect()).collect();
    if lines.len() < rows {
        return lines.join("\n");
    }
    let shown = rows.saturating_sub(2);
    let left = lines.len() - shown.min(lines.len());
    let mut kept: Vec<String> = lines.into_iter().take(shown).collect();
    kept.push(format!("... {left} more lines, in the report at the end"));
    kept.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_cut_to_the_terminal_and_says_so() {
        let text = "0123456789\n".repeat(30);
        let fitted = fitted(&text, 5, 10);
        assert_eq!(fitted.lines().count(), 9);
        assert!(fitted.starts_with("01234\n") && fitted.ends_with("at the end"), "{fitted}");
        assert_eq!(super::fitted("a\nb\n", 80, 24), "a\nb");
    }
}
