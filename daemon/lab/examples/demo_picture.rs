//! Draws the demo's screen as an SVG picture for the README: the same seed, the same bytes.
//!
//! ```text
//! cargo run --release -p insd-lab --example demo_picture -- docs/demo.svg
//! ```

use std::fmt::Write as _;

use anyhow::Context;
use insd_base::Time;
use insd_lab::demo::board::{Board, DemoPort};
use insd_lab::demo::scenario::DemoVoyage;
use insd_lab::demo::ship::DemoShip;
use insd_lab::demo::view;
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::buffer::{Buffer, Cell};
use ratatui::style::{Color, Modifier};

/// Scenario, seed and voyage time, s, of the picture: a ship that has just refused a GNSS jump.
const SCENARIO: (&str, u64, f64) = ("05", 1, 1468.0);
/// Columns and lines of the terminal.
const SIZE: (u16, u16) = (108, 36);
/// Width and height of a character, and its distance from the line above to its foot, px.
const CHARACTER: (f64, f64, f64) = (8.4, 16.5, 13.0);
const BACKGROUND: &str = "#0f1419";
const FOREGROUND: &str = "#d6d9dc";

fn main() -> anyhow::Result<()> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "docs/demo.svg".to_owned());
    let (scenario, seed, time) = SCENARIO;
    let choice = DemoVoyage::find(scenario, seed)?;
    let port = DemoPort { path: "/dev/pts/3".to_owned(), ..DemoPort::default() };
    let board = Board { title: choice.title(), speed: 1.0, port, ..Board::default() };
    let mut ship = DemoShip::new(choice.sail(), board);
    let mut written = 0;
    for second in 1..=time as u32 {
        ship.advance(Time::from_seconds(f64::from(second)), &mut |bytes| written += bytes.len());
    }
    ship.board_mut().port.written = written as u64;
    let mut terminal = Terminal::new(TestBackend::new(SIZE.0, SIZE.1))?;
    terminal.draw(|frame| view::draw(frame, ship.board()))?;
    let picture = svg(terminal.backend().buffer());
    std::fs::write(&path, picture).with_context(|| path)
}

fn svg(buffer: &Buffer) -> String {
    let (width, height, _) = CHARACTER;
    let (w, h) = (f64::from(SIZE.0) * width + 24.0, f64::from(SIZE.1) * height + 24.0);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w:.0} {h:.0}\" \
         font-family=\"DejaVu Sans Mono, Menlo, Consolas, monospace\" font-size=\"14\">\n\
         <rect width=\"100%\" height=\"100%\" rx=\"8\" fill=\"{BACKGROUND}\"/>\n\
         <g transform=\"translate(12 12)\" xml:space=\"preserve\">\n"
    );
    for y in 0..buffer.area.height {
        for run in runs(buffer, y) {
            draw(&mut svg, &run, y);
        }
    }
    svg + "</g>\n</svg>\n"
}

/// Neighbouring cells of one style.
struct Run<'a> {
    start: u16,
    columns: u16,
    text: String,
    cell: &'a Cell,
}

fn runs(buffer: &Buffer, y: u16) -> Vec<Run<'_>> {
    let mut runs: Vec<Run<'_>> = Vec::new();
    for x in 0..buffer.area.width {
        let cell = &buffer[(x, y)];
        match runs.last_mut().filter(|run| run.cell.style() == cell.style()) {
            Some(run) => {
                run.columns += 1;
                run.text.push_str(cell.symbol());
            }
            None => {
                runs.push(Run { start: x, columns: 1, text: cell.symbol().to_owned(), cell });
            }
        }
    }
    runs
}

fn draw(svg: &mut String, run: &Run<'_>, y: u16) {
    let (width, height, foot) = CHARACTER;
    let (x, top) = (f64::from(run.start) * width, f64::from(y) * height);
    let length = f64::from(run.columns) * width;
    if let Some(fill) = colour(run.cell.bg) {
        // writing to a String cannot fail
        let _ = writeln!(
            svg,
            "<rect x=\"{x:.1}\" y=\"{top:.1}\" width=\"{length:.1}\" height=\"{height:.1}\" \
             fill=\"{fill}\"/>"
        );
    }
    if run.text.trim().is_empty() {
        return;
    }
    let fill = colour(run.cell.fg).unwrap_or(FOREGROUND);
    let bold = run.cell.modifier.contains(Modifier::BOLD);
    let weight = if bold { " font-weight=\"bold\"" } else { "" };
    let text = run.text.replace('&', "&amp;").replace('<', "&lt;");
    let _ = writeln!(
        svg,
        "<text x=\"{x:.1}\" y=\"{:.1}\" textLength=\"{length:.1}\" \
         lengthAdjust=\"spacingAndGlyphs\" fill=\"{fill}\"{weight}>{text}</text>",
        top + foot
    );
}

fn colour(color: Color) -> Option<&'static str> {
    Some(match color {
        Color::Reset => return None,
        Color::Black => "#0f1419",
        Color::Red => "#ff6b68",
        Color::Green => "#7fd962",
        Color::Yellow => "#ffcb6b",
        Color::Magenta => "#d2a6ff",
        Color::Cyan => "#73d0ff",
        Color::Gray => "#b3b9c5",
        Color::DarkGray => "#6c7680",
        _ => "#ffffff",
    })
}
