//! Where the ship is and how she moves, each with the interval that holds it in 95 of 100 cases.

use insd_base::Solution;
use insd_output::Policy;
use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::{Color, Style};
use ratatui::text::Line;
use ratatui::widgets::{Row, Table};

use crate::demo::board::Board;
use crate::style::{dim, panel, strong};
use crate::words;

/// Draws the box.
pub(super) fn draw(frame: &mut Frame<'_>, area: Rect, board: &Board) {
    let block = panel("Ship", Line::styled(" 95 % within ", dim()));
    let inside = block.inner(area);
    frame.render_widget(block, area);
    let Some(solution) = &board.solution else {
        frame.render_widget(Line::styled(" nothing is known yet", dim()), inside);
        return;
    };
    let [upper, lower] =
        Layout::vertical([Constraint::Min(8), Constraint::Length(1)]).areas(inside);
    let widths = [Constraint::Length(10), Constraint::Min(17), Constraint::Length(10)];
    frame.render_widget(Table::new(figures(solution), widths).column_spacing(0), upper);
    frame.render_widget(truth(board), lower);
}

fn figures(solution: &Solution) -> Vec<Row<'static>> {
    let (attitude, sigma) = (&solution.attitude, &solution.sigma);
    let velocity_sigma = sigma.velocity.0.xy().max();
    let speed = solution.speed();
    let (course, course_95) = if Policy::default().has_course(solution) {
        (words::bearing(solution.course()), words::angle_95(velocity_sigma / speed))
    } else {
        ("at rest".to_owned(), String::new())
    };
    let radius = words::distance(words::radius_95(&sigma.position));
    vec![
        row("Position", words::latitude(solution.position.latitude), format!("± {radius}")),
        row("", words::longitude(solution.position.longitude), String::new()),
        row("Speed", words::speed(speed), words::speed_95(velocity_sigma)),
        row("Course", course, course_95),
        row("Heading", words::bearing(attitude.heading), words::angle_95(sigma.heading)),
        row("Roll", words::roll(attitude.roll), words::angle_95(sigma.roll)),
        row("Pitch", words::pitch(attitude.pitch), words::angle_95(sigma.pitch)),
        row("Turning", words::rate_of_turn(solution.rate_of_turn()), String::new()),
    ]
}

fn row(name: &'static str, value: String, sure: String) -> Row<'static> {
    Row::new([
        Line::styled(format!(" {name}"), dim()),
        Line::styled(value, strong()),
        Line::from(sure).right_aligned(),
    ])
}

/// The comparison that only a simulated ship allows.
fn truth(board: &Board) -> Line<'static> {
    let text = match &board.true_error {
        None => " True error unknown".to_owned(),
        Some(error) => {
            let heading = error.heading.map(|heading| heading.to_degrees().abs());
            let heading = heading.map(|error| format!(", heading {error:.2}°")).unwrap_or_default();
            format!(" True error {}{heading}", words::distance(error.horizontal))
        }
    };
    Line::styled(text, Style::new().fg(Color::Magenta))
}
