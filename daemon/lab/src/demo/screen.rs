//! The demo on a full screen.

use std::time::Duration;

use tokio::time::{MissedTickBehavior, interval};

use super::pace::Worker;
use super::view;
use crate::terminal::{Farewell, Screen, quit_was_pressed};

/// Wall time between two pictures.
const FRAME: Duration = Duration::from_millis(100);

/// Draws until the duration or the user ends it. The terminal is given back in every case.
///
/// # Errors
/// A terminal that fails.
pub async fn show(worker: &Worker, duration: Option<Duration>) -> anyhow::Result<()> {
    let mut farewell = Farewell::new(duration)?;
    let mut screen = Screen::new()?;
    let mut ticks = interval(FRAME);
    ticks.set_missed_tick_behavior(MissedTickBehavior::Delay);
    loop {
        let board = worker.board();
        screen.terminal.draw(|frame| view::draw(frame, &board))?;
        tokio::select! {
            _ = ticks.tick() => {}
            () = farewell.wait() => return Ok(()),
        }
        if quit_was_pressed()? || worker.is_finished() {
            return Ok(());
        }
    }
}
