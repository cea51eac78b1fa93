//! The demo without a full screen: one line a second.

use std::fmt::Write as _;
use std::io::{ErrorKind, Write};
use std::time::Duration;

use insd_output::Policy;
use tokio::time::{MissedTickBehavior, interval};

use super::board::{Board, Phase};
use super::pace::Worker;
use crate::terminal::Farewell;
use crate::words;

/// Prints until the voyage, the duration or the user ends it, or nobody reads any more.
///
/// # Errors
/// An output that fails in another way than by being closed.
pub async fn show(worker: &Worker, duration: Option<Duration>) -> anyhow::Result<()> {
    let mut farewell = Farewell::new(duration)?;
    let mut ticks = interval(Duration::from_secs(1));
    ticks.set_missed_tick_behavior(MissedTickBehavior::Delay);
    let mut output = std::io::stdout();
    let board = worker.board();
    let mut text = format!(
        "simulated ship: {}\nNMEA 0183 (HDT THS ROT GGA VTG ZDA) on {}\n",
        board.title, board.port.path
    );
    loop {
        match output.write_all(text.as_bytes()).and_then(|()| output.flush()) {
            Err(error) if error.kind() == ErrorKind::BrokenPipe => return Ok(()),
            written => written?,
        }
        let board = worker.board();
        if board.phase == Phase::Arrived || worker.is_finished() {
            return Ok(());
        }
        tokio::select! {
            _ = ticks.tick() => {}
            () = farewell.wait() => return Ok(()),
        }
        text = line(&worker.board());
    }
}

/// The board in one line.
#[must_use]
pub fn line(board: &Board) -> String {
    let mut line = words::clock(board.now);
    let Some(solution) = &board.solution else {
        let state = match board.phase {
            Phase::Preparing => "making the voyage",
            _ => "waiting for the first solution",
        };
        return format!("{line}  {state}\n");
    };
    let course = match Policy::default().has_course(solution) {
        true => format!("course {}", words::bearing(solution.course())),
        false => "at rest".to_owned(),
    };
    // writing to a String cannot fail
    let _ = write!(
        line,
        "  {:<14} {} {} ± {}  {}  {}  heading {} {}  roll {:+.1}° pitch {:+.1}°",
        solution.mode.as_str(),
        words::latitude(solution.position.latitude),
        words::longitude(solution.position.longitude),
        words::distance(words::radius_95(&solution.sigma.position)),
        words::speed(solution.speed()),
        course,
        words::bearing(solution.attitude.heading),
        words::angle_95(solution.sigma.heading),
        unsigned_zero(solution.attitude.roll.to_degrees()),
        unsigned_zero(solution.attitude.pitch.to_degrees()),
    );
    if let Some(error) = &board.true_error {
        let _ = write!(line, "  true error {}", words::distance(error.horizontal));
    }
    if let Some(alongside) = &board.alongside {
        let _ = write!(line, "  {alongside}");
    }
    let _ = writeln!(line, "  rejected {}", board.counts.rejected_total());
    line
}

/// A value whose first decimal is zero, without the sign of a zero.
fn unsigned_zero(value: f64) -> f64 {
    if value.abs() < 0.05 { 0.0 } else { value }
}
