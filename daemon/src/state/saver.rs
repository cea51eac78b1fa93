//! Saving on a thread of its own, so that a slow disk delays nobody.

use std::io;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{Builder, JoinHandle};

use insd_base::Span;
use insd_config::{learning, output_file};
use insd_engine::KeptModel;

use super::{Boot, Kept, NAVIGATION, Store, berth, learnt};

/// Where is saved, and how often.
#[derive(Clone, Debug, PartialEq)]
pub struct Folders {
    /// In memory: everything.
    pub memory: Option<PathBuf>,
    /// On the disk: what comes after the interval.
    pub disk: Option<PathBuf>,
    /// Time between two states on the disk.
    pub interval: Span,
}

/// How saving is going.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct SaverState {
    /// States written on the disk.
    pub saved: u64,
    /// States that could not be written.
    pub failed: u64,
    /// What the system said the last time, cleared when it works again.
    pub fault: Option<String>,
}

#[derive(Debug)]
enum Message {
    Navigation(Kept),
    Berth(String),
    Learnt(Box<KeptModel>),
}

/// Saves on a thread of its own. No call waits for the disk, apart from [`Saver::finish`].
#[derive(Debug)]
pub struct Saver {
    sender: Option<SyncSender<Message>>,
    thread: Option<JoinHandle<()>>,
    state: Arc<Mutex<SaverState>>,
}

impl Saver {
    /// Starts the thread.
    ///
    /// # Errors
    /// The system grants no thread.
    pub fn start(folders: &Folders) -> io::Result<Self> {
        // one that waits and one that is written: what is older is not worth writing
        let (sender, receiver) = sync_channel(2);
        let state = Arc::new(Mutex::new(SaverState::default()));
        let worker = Worker {
            memory: folders.memory.as_deref().map(|folder| Store::new(folder, NAVIGATION)),
            disk: folders.disk.as_deref().map(|folder| Store::new(folder, NAVIGATION)),
            berth: folders.disk.as_deref().map(berth),
            learnt: folders.disk.as_deref().map(learnt),
            interval: folders.interval,
            last: None,
            state: Arc::clone(&state),
        };
        let thread =
            Builder::new().name("saver".to_owned()).spawn(move || worker.run(&receiver))?;
        Ok(Saver { sender: Some(sender), thread: Some(thread), state })
    }

    /// Hands over the navigation; left out if the disk is busy with the one before.
    pub fn navigation(&self, kept: Kept) {
        self.send(Message::Navigation(kept));
    }

    /// Hands over the state of a ship at her berth, as its file is to have it.
    pub fn berth(&self, text: String) {
        self.send(Message::Berth(text));
    }

    /// Hands over what was learnt of the sensors.
    pub fn learnt(&self, model: KeptModel) {
        self.send(Message::Learnt(Box::new(model)));
    }

    /// How it is going.
    #[must_use]
    pub fn state(&self) -> SaverState {
        self.state.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Writes what is waiting, and ends.
    pub fn finish(mut self) {
        self.close();
    }

    fn send(&self, message: Message) {
        if let Some(sender) = &self.sender {
            // where there is no room something newer comes soon
            let _ = sender.try_send(message);
        }
    }

    fn close(&mut self) {
        drop(self.sender.take());
        if let Some(thread) = self.thread.take() {
            // a thread that panicked has nothing more to say
            let _ = thread.join();
        }
    }
}

impl Drop for Saver {
    fn drop(&mut self) {
        self.close();
    }
}

/// The thread's side.
struct Worker {
    memory: Option<Store>,
    disk: Option<Store>,
    berth: Option<PathBuf>,
    learnt: Option<PathBuf>,
    interval: Span,
    /// When the disk was given a state last.
    last: Option<Boot>,
    state: Arc<Mutex<SaverState>>,
}

impl Worker {
    fn run(mut self, receiver: &Receiver<Message>) {
        for message in receiver {
            match message {
                Message::Navigation(kept) => self.keep(&kept),
                Message::Berth(text) => {
                    let place = self.berth.as_deref();
                    let written = place.map(|place| output_file::replace(place, &text));
                    written.into_iter().for_each(|written| self.judge(written));
                }
                Message::Learnt(model) => {
                    let place = self.learnt.as_deref();
                    let written = place.map(|place| learning::keep(place, &model));
                    written.into_iter().for_each(|written| self.judge(written));
                }
            }
        }
    }

    fn keep(&mut self, kept: &Kept) {
        if let Some(memory) = &mut self.memory {
            let saved = memory.save(kept, false);
            if saved.is_err() {
                self.judge(saved);
            }
        }
        let passed = self.last.as_ref().and_then(|last| kept.made.since(last));
        if passed.is_some_and(|passed| passed < self.interval) {
            return;
        }
        if let Some(disk) = &mut self.disk {
            self.last = Some(kept.made.clone());
            let saved = disk.save(kept, true);
            self.judge(saved);
        }
    }

    fn judge(&self, saved: io::Result<()>) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        match saved {
            Ok(()) => {
                state.saved += 1;
                if state.fault.take().is_some() {
                    tracing::info!("what the next start goes on from is saved again");
                }
            }
            Err(error) => {
                state.failed += 1;
                if state.fault.is_none() {
                    tracing::warn!(%error, "what the next start goes on from cannot be saved");
                }
                state.fault = Some(error.to_string());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_gets_every_state_and_the_disk_one_in_an_interval() {
        let (memory, disk) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let folders = Folders {
            memory: Some(memory.path().to_owned()),
            disk: Some(disk.path().to_owned()),
            interval: Span::from_seconds(5.0),
        };
        let saver = Saver::start(&folders).unwrap();
        for tenth in 0..10_u8 {
            let kept = Kept { made: Boot::made_up(1, f64::from(tenth)), state: vec![tenth] };
            saver.navigation(kept);
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
        let state = saver.state();
        saver.finish();
        let load = |folder: &tempfile::TempDir| Store::new(folder.path(), NAVIGATION).load();
        assert_eq!(load(&memory).kept.unwrap().state, [9]);
        assert_eq!(load(&disk).kept.unwrap().state, [5]);
        assert_eq!((state.failed, state.fault), (0, None));
    }

    #[test]
    fn a_disk_that_fails_is_told_and_hinders_nobody() {
        let folders = Folders {
            memory: None,
            disk: Some(PathBuf::from("/proc/nowhere")),
            interval: Span::from_seconds(1.0),
        };
        let saver = Saver::start(&folders).unwrap();
        saver.navigation(Kept { made: Boot::made_up(1, 1.0), state: vec![1] });
        while saver.state().failed == 0 {
            std::thread::sleep(std::time::Duration::from_millis(1));
        }
        assert!(saver.state().fault.is_some());
        saver.finish();
    }
}
