//! The thread in which the ship sails, and the clock that she keeps.

use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use anyhow::anyhow;
use insd_base::{Span, Time};
use insd_config::Config;
use insd_drivers::ports::Clock;

use super::alongside;
use super::board::{Board, DemoPort, Phase};
use super::onlooker::Onlooker;
use super::scenario::DemoVoyage;
use super::ship::DemoShip;
use crate::pty::PseudoTerminal;

/// Wall time between two looks at the clock.
const TICK: Duration = Duration::from_millis(10);

/// Most voyage time between two boards, s, so that a slow computer still shows progress.
const STRIDE: f64 = 5.0;

/// How fast the ship sails.
#[derive(Clone, Copy, Debug)]
pub struct DemoPace {
    /// Voyage seconds in one second of the clock.
    pub speed: f64,
}

/// The sailing thread as the main thread sees it.
#[derive(Debug)]
pub struct Worker {
    board: Arc<Mutex<Board>>,
    stop: Sender<()>,
    thread: JoinHandle<()>,
}

impl Worker {
    /// Starts to make the voyage and then to sail it, by her configuration.
    #[must_use]
    pub fn start(
        (choice, config): (DemoVoyage, Config),
        pty: PseudoTerminal,
        pace: DemoPace,
        clock: Arc<dyn Clock>,
        onlooker: Option<Box<dyn Onlooker>>,
    ) -> Self {
        let path = pty.path().display().to_string();
        let port = DemoPort { path, ..DemoPort::default() };
        let first = Board { title: choice.title(), speed: pace.speed, port, ..Board::default() };
        let board = Arc::new(Mutex::new(first.clone()));
        let (stop, stopped) = channel();
        let shared = Arc::clone(&board);
        let thread = std::thread::spawn(move || {
            let voyage = choice.sail();
            let berths = alongside::docking(&config, &voyage.header.imu);
            let ship = DemoShip::new(voyage, first).with_berths(berths).with_onlooker(onlooker);
            sail(ship, pty, &keeping(pace, &*clock), &shared, &stopped);
        });
        Worker { board, stop, thread }
    }

    /// The board as it is now.
    #[must_use]
    pub fn board(&self) -> Board {
        lock(&self.board).clone()
    }

    /// Whether the thread has come to its end, by itself or by accident.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.thread.is_finished()
    }

    /// Ends the voyage. One that is still being made is not waited for.
    ///
    /// # Errors
    /// If the thread panicked.
    pub fn stop(self) -> anyhow::Result<()> {
        // an error means that it has ended already
        let _ = self.stop.send(());
        let preparing = lock(&self.board).phase == Phase::Preparing;
        if preparing && !self.thread.is_finished() {
            return Ok(());
        }
        self.thread.join().map_err(|_| anyhow!("the navigation thread panicked"))
    }
}

fn lock(board: &Mutex<Board>) -> MutexGuard<'_, Board> {
    board.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The time of the voyage that is due, which begins now.
fn keeping(pace: DemoPace, clock: &dyn Clock) -> impl Fn() -> Time {
    let started = clock.now().monotonic;
    move || Time::from_seconds((clock.now().monotonic - started).as_seconds() * pace.speed)
}

/// Sails until told to stop. After the last message the board and the port stay as they are.
fn sail(
    mut ship: DemoShip,
    mut pty: PseudoTerminal,
    due: &dyn Fn() -> Time,
    shared: &Mutex<Board>,
    stopped: &Receiver<()>,
) {
    let mut sailed = Time::START;
    loop {
        let due = due();
        if ship.board().phase == Phase::Sailing {
            sailed = due.min(sailed + Span::from_seconds(STRIDE));
            ship.advance(sailed, &mut |sentences| pty.push(sentences));
            pty.pump();
            let board = ship.board_mut();
            board.behind = (due - sailed).as_seconds();
            board.port.written = pty.produced();
            board.port.dropped = pty.dropped();
            lock(shared).clone_from(board);
        }
        let wait = if sailed < due { Duration::ZERO } else { TICK };
        if stopped.recv_timeout(wait) != Err(RecvTimeoutError::Timeout) {
            return;
        }
    }
}
