//! The terminal of who looks on: what is printed, the full screen, and the ways in which a look ends.

use std::io::{self, Write as _};
use std::pin::Pin;
use std::time::Duration;

use ratatui::DefaultTerminal;
use ratatui::crossterm::event::{self, Event, KeyCode, KeyEventKind, KeyModifiers};
use tokio::signal::unix::{Signal, SignalKind, signal};
use tokio::time::{Sleep, sleep};

/// Writes to standard output. A reader that has seen enough (`| head`) is an error like any other, which
/// ends the program quietly.
///
/// # Errors
/// What standard output says.
pub fn print(text: &str) -> io::Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes()).and_then(|()| out.flush())
}

/// The terminal in full-screen mode; given back when dropped.
pub struct Screen {
    /// The terminal.
    pub terminal: DefaultTerminal,
}

impl Screen {
    /// Takes the terminal over.
    ///
    /// # Errors
    /// A terminal that fails.
    pub fn new() -> io::Result<Self> {
        Ok(Screen { terminal: ratatui::try_init()? })
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        ratatui::restore();
    }
}

/// Takes all keys that were pressed; true if one of them asks to end.
///
/// # Errors
/// A terminal that fails.
pub fn quit_was_pressed() -> io::Result<bool> {
    Ok(pressed()?.quit)
}

/// What was pressed since it was looked last.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Pressed {
    /// What ends the program: q, escape or Ctrl-C.
    pub quit: bool,
    /// Other letters, small ones, in their order.
    pub letters: String,
}

/// All that was pressed since it was looked last.
///
/// # Errors
/// A terminal that fails.
pub fn pressed() -> io::Result<Pressed> {
    let mut pressed = Pressed::default();
    while event::poll(Duration::ZERO)? {
        let Event::Key(key) = event::read()? else { continue };
        if key.kind != KeyEventKind::Press {
            continue;
        }
        let with_control = key.modifiers.contains(KeyModifiers::CONTROL);
        match key.code {
            KeyCode::Char('c') if with_control => pressed.quit = true,
            KeyCode::Char('q' | 'Q') | KeyCode::Esc => pressed.quit = true,
            KeyCode::Char(letter) if !with_control => {
                pressed.letters.push(letter.to_ascii_lowercase());
            }
            _ => {}
        }
    }
    Ok(pressed)
}

/// The ways in which a look is ended from outside: duration, Ctrl-C, SIGTERM, a closed terminal.
#[derive(Debug)]
pub struct Farewell {
    over: Option<Pin<Box<Sleep>>>,
    interrupt: Signal,
    terminate: Signal,
    hangup: Signal,
}

impl Farewell {
    /// Listens from now on.
    ///
    /// # Errors
    /// If the signals cannot be listened to.
    pub fn new(duration: Option<Duration>) -> io::Result<Self> {
        Ok(Farewell {
            over: duration.map(|duration| Box::pin(sleep(duration))),
            interrupt: signal(SignalKind::interrupt())?,
            terminate: signal(SignalKind::terminate())?,
            hangup: signal(SignalKind::hangup())?,
        })
    }

    /// Waits for the first of them. May be dropped and called again.
    pub async fn wait(&mut self) {
        let over = async {
            match &mut self.over {
                Some(over) => over.as_mut().await,
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
