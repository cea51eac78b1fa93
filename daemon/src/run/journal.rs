//! What is told of the navigation: to the journal, and to whoever looks on. On a thread of its own, so that
//! a journal that is slow to take a line, or a page that is costly to make, delays nobody.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{Builder, JoinHandle};

use insd_config::Config;
use insd_vessel::{Names, Product};

use super::report::Report;
use super::told::tell;

/// What may wait to be told: some seconds of a ship in trouble.
const WAITING: usize = 1024;

/// Something to tell.
#[derive(Debug)]
pub(super) enum Note {
    /// From here on this configuration holds; its text.
    Configuration(Box<Config>, String),
    /// What an arrival led to.
    Product(Product),
    /// How everything stands.
    Report(Box<Report>),
}

/// Takes what is to be told, and never waits.
#[derive(Debug)]
pub(super) struct Journal {
    sender: Option<SyncSender<Note>>,
    thread: Option<JoinHandle<()>>,
    lost: Arc<AtomicU64>,
}

/// Shows what is told to somebody else, too.
pub(super) trait Audience: Send {
    /// From here on another configuration holds.
    fn configure(&mut self, _config: &Config, _text: &str) {}
    /// Something happened.
    fn hear(&mut self, names: &Names, product: &Product);
    /// How everything stands.
    fn see(&mut self, report: &Report);
}

impl Journal {
    /// Starts the thread.
    pub(super) fn start(mut audience: Vec<Box<dyn Audience>>) -> io::Result<Self> {
        let (sender, receiver) = sync_channel(WAITING);
        let thread = Builder::new()
            .name("journal".to_owned())
            .spawn(move || write(&receiver, &mut audience))?;
        Ok(Journal { sender: Some(sender), thread: Some(thread), lost: Arc::default() })
    }

    /// Tells something, or counts it as lost.
    pub(super) fn tell(&self, note: Note) {
        let taken = self.sender.as_ref().is_some_and(|sender| sender.try_send(note).is_ok());
        self.lost.fetch_add(u64::from(!taken), Ordering::Relaxed);
    }

    /// What could not be told because the journal was too slow.
    pub(super) fn lost(&self) -> u64 {
        self.lost.load(Ordering::Relaxed)
    }
}

impl Drop for Journal {
    fn drop(&mut self) {
        drop(self.sender.take());
        if let Some(thread) = self.thread.take() {
            // a thread that panicked has nothing more to say
            let _ = thread.join();
        }
    }
}

fn write(receiver: &Receiver<Note>, audience: &mut [Box<dyn Audience>]) {
    let mut names = Names::default();
    for note in receiver {
        match note {
            Note::Configuration(config, text) => {
                names = Names::of(&config.intake());
                audience.iter_mut().for_each(|one| one.configure(&config, &text));
            }
            Note::Product(product) => {
                tell(&names, &product);
                audience.iter_mut().for_each(|one| one.hear(&names, &product));
            }
            Note::Report(report) => audience.iter_mut().for_each(|one| one.see(&report)),
        }
    }
}
