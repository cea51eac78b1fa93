//! A pseudo terminal that programs read from as from a serial port.
//!
//! The far end is held open, so that writing never fails for want of a reader. What nobody reads is
//! forgotten after a second: who comes then gets what is new.

use std::collections::VecDeque;
use std::ffi::OsStr;
use std::io;
use std::os::fd::OwnedFd;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};
use std::time::Duration;

use rustix::fs::{Mode, OFlags, fcntl_getfl, fcntl_setfl, open};
use rustix::io::{Errno, ioctl_fionread, read, write};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{OptionalActions, QueueSelector, tcflush, tcgetattr, tcsetattr};
use tokio::time::sleep;

use super::config::File;
use super::outbox::Outbox;
use super::run::Outcome;
use super::teller::Teller;

/// Bytes that may wait for a reader in the kernel, which can hold 4095.
const HELD: u64 = 3000;

/// How often it is looked whether somebody reads, and how often before giving up.
const LOOKING: Duration = Duration::from_millis(10);
const LOOKS: u32 = 100;

/// Makes the terminal and its link, and writes messages to it.
pub(super) async fn talk(config: &File, teller: &mut Teller, outbox: &Outbox) -> Outcome {
    let link = config.path.display();
    let mut pty = match Pty::open(&config.path) {
        Ok(pty) => pty,
        Err(error) => return Outcome::Absent(format!("{link}: {error}")),
    };
    outbox.clear();
    teller.open(format!("{link}, a link to {}", pty.far_path.display()));
    loop {
        let message = outbox.next().await;
        pty.forget_what_is_said();
        let forgotten = pty.make_room(message.bytes.len() as u64).await;
        if forgotten > 0 {
            // this message has waited for as long, and is dropped with the others
            outbox.count(forgotten);
            continue;
        }
        match pty.write(&message.bytes).await {
            Ok(()) => message.written(),
            Err(error) => return Outcome::Lost(error.to_string()),
        }
    }
}

struct Pty {
    near: OwnedFd,
    far: OwnedFd,
    far_path: PathBuf,
    link: PathBuf,
    /// Lengths of the last messages that the kernel took.
    lengths: VecDeque<u64>,
}

impl Pty {
    fn open(link: &Path) -> io::Result<Self> {
        let near = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC)?;
        grantpt(&near)?;
        unlockpt(&near)?;
        let name = ptsname(&near, Vec::new())?;
        let far_path = PathBuf::from(OsStr::from_bytes(name.as_bytes()));
        let flags = OFlags::RDWR | OFlags::NOCTTY | OFlags::CLOEXEC | OFlags::NONBLOCK;
        let far = open(&far_path, flags, Mode::empty())?;
        let mut settings = tcgetattr(&far)?;
        settings.make_raw();
        tcsetattr(&far, OptionalActions::Now, &settings)?;
        fcntl_setfl(&near, fcntl_getfl(&near)? | OFlags::NONBLOCK)?;
        // a link that an earlier run has left is replaced; anything else is not ours
        if link.symlink_metadata().is_ok_and(|found| found.is_symlink()) {
            std::fs::remove_file(link)?;
        }
        std::os::unix::fs::symlink(&far_path, link)?;
        Ok(Pty { near, far, far_path, link: link.to_owned(), lengths: VecDeque::new() })
    }

    /// Waits for a reader to make room; if there is none, forgets what the kernel holds. Gives how
    /// many messages were forgotten.
    async fn make_room(&mut self, length: u64) -> u64 {
        let mut before = u64::MAX;
        let mut looks = 0;
        loop {
            let held = ioctl_fionread(&self.far).unwrap_or(0);
            if held == 0 || held + length <= HELD {
                return 0;
            }
            looks = if held < before { 0 } else { looks + 1 };
            if looks > LOOKS {
                let forgotten = tcflush(&self.far, QueueSelector::IFlush).is_ok();
                return if forgotten { self.forgotten(held) } else { 0 };
            }
            before = held;
            sleep(LOOKING).await;
        }
    }

    /// How many of the last messages make up so many bytes.
    fn forgotten(&mut self, mut bytes: u64) -> u64 {
        let mut messages = 0;
        while bytes > 0 {
            let Some(length) = self.lengths.pop_back() else { break };
            bytes = bytes.saturating_sub(length);
            messages += 1;
        }
        self.lengths.clear();
        messages
    }

    async fn write(&mut self, message: &[u8]) -> io::Result<()> {
        let mut rest = message;
        while !rest.is_empty() {
            match write(&self.near, rest) {
                Ok(count) => rest = rest.get(count..).unwrap_or_default(),
                Err(Errno::INTR) => {}
                Err(Errno::AGAIN) => sleep(LOOKING).await,
                Err(error) => return Err(error.into()),
            }
        }
        self.lengths.push_back(message.len() as u64);
        if self.lengths.len() > HELD as usize {
            self.lengths.pop_front();
        }
        Ok(())
    }

    /// What programs write into their end must not pile up.
    fn forget_what_is_said(&self) {
        let mut bytes = [0; 4096];
        while matches!(read(&self.near, &mut bytes), Ok(1..)) {}
    }
}

impl Drop for Pty {
    fn drop(&mut self) {
        if std::fs::read_link(&self.link).is_ok_and(|target| target == self.far_path) {
            // a link that stays is replaced next time
            let _ = std::fs::remove_file(&self.link);
        }
    }
}
