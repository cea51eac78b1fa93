//! The word to systemd (sd_notify(3)), on a thread of its own: a manager that does not listen hinders nobody.

use std::io;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::Builder;

use sd_notify::NotifyState;

/// Words that may wait to be said.
const WAITING: usize = 16;

/// Something to say.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Word {
    /// All is started, or read again.
    Ready,
    /// The configuration is read again.
    Reloading,
    /// It is about to end.
    Stopping,
    /// The engine lives.
    Alive,
    /// How everything stands, in one line.
    Status(String),
}

/// Speaks to systemd, if it has started us.
#[derive(Clone, Debug)]
pub(super) struct Manager(SyncSender<Vec<Word>>);

impl Manager {
    /// Starts the thread. It ends with the last of those who speak; nobody waits for it.
    pub(super) fn start() -> io::Result<Self> {
        let (sender, receiver) = sync_channel(WAITING);
        Builder::new().name("manager".to_owned()).spawn(move || speak(&receiver))?;
        Ok(Manager(sender))
    }

    /// Says something; it is lost if the manager has not listened for long.
    pub(super) fn tell(&self, words: impl IntoIterator<Item = Word>) {
        // a manager that has stopped listening misses its watchdog, which is all that can be done
        let _ = self.0.try_send(words.into_iter().collect());
    }
}

fn speak(words: &Receiver<Vec<Word>>) {
    for words in words {
        let mut states: Vec<NotifyState<'_>> = words.iter().map(state).collect();
        if words.contains(&Word::Reloading) {
            states.extend(NotifyState::monotonic_usec_now());
        }
        if let Err(error) = sd_notify::notify(&states) {
            tracing::debug!(%error, "systemd does not listen");
        }
    }
}

fn state(word: &Word) -> NotifyState<'_> {
    match word {
        Word::Ready => NotifyState::Ready,
        Word::Reloading => NotifyState::Reloading,
        Word::Stopping => NotifyState::Stopping,
        Word::Alive => NotifyState::Watchdog,
        Word::Status(line) => NotifyState::Status(line),
    }
}
