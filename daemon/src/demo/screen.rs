//! The demo on a full screen, and the ways in which it ends.

use std::time::Duration;

use ratatui::DefaultTerminal;
use ratatui::crossterm::event::{self, Event, KeyCode, KeyEventKind, KeyModifiers};
use tokio::signal::unix::{Signal, SignalKind, signal};
use tokio::time::{MissedTickBehavior, interval};

use crate::clock::Clock;

use super::pace::Worker;
use super::view;

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

/// The terminal in full-screen mode; given back when dropped.
pub(crate) struct Screen {
    /// The terminal.
    pub(crate) terminal: DefaultTerminal,
}

impl Screen {
    /// Takes the terminal over.
    ///
    /// # Errors
    /// A terminal that fails.
    pub(crate) fn new() -> std::io::Result<Self> {
        Ok(Screen { terminal: ratatui::try_init()? })
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        ratatui::restore();
    }
}

/// Takes all keys that were pressed; true if one of them asks to end.
pub(crate) fn quit_was_pressed() -> std::io::Result<bool> {
    let mut quit = false;
    while event::poll(Duration::ZERO)? {
        if let Event::Key(key) = event::read()?
            && key.kind == KeyEventKind::Press
        {
            let control_c =
                key.code == KeyCode::Char('c') && key.modifiers.contains(KeyModifiers::CONTROL);
            quit |= control_c || matches!(key.code, KeyCode::Char('q' | 'Q') | KeyCode::Esc);
        }
    }
    Ok(quit)
}

/// The ways in which a demo is ended from outside: duration, Ctrl-C, SIGTERM, a closed terminal.
#[derive(Debug)]
pub struct Farewell {
    clock: Clock,
    duration: Option<Duration>,
    interrupt: Signal,
    terminate: Signal,
    hangup: Signal,
}

impl Farewell {
    /// Listens from now on.
    ///
    /// # Errors
    /// If the signals cannot be listened to.
    pub fn new(duration: Option<Duration>) -> std::io::Result<Self> {
        Ok(Farewell {
            clock: Clock::start(),
            duration,
            interrupt: signal(SignalKind::interrupt())?,
            terminate: signal(SignalKind::terminate())?,
            hangup: signal(SignalKind::hangup())?,
        })
    }

    /// Waits for the first of them. May be dropped and called again.
    pub async fn wait(&mut self) {
        let rest = self.duration.map(|duration| duration.saturating_sub(self.clock.elapsed()));
        let over = async {
            match rest {
                Some(rest) => tokio::time::sleep(rest).await,
                None => std::future::pending().await,
            }
        };
        tokio::select! {
            () = over => {}
            _ = self.interrupt.recv() => {}
            _ = self.terminate.recv() => {}
            _ = self.hangup.recv() => {}
        }
    }
}
