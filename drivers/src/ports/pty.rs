//! A pseudo terminal that programs read from as from a serial port.
//!
//! The far end is held open, so that writing never fails for want of a reader. What nobody has read for a
//! second is forgotten: who comes then gets what is new.

use std::collections::VecDeque;
use std::ffi::OsStr;
use std::io;
use std::os::fd::OwnedFd;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};
use std::time::Duration;

use insd_base::{Span, Time};
use rustix::fs::{Mode, OFlags, fcntl_getfl, fcntl_setfl, open};
use rustix::io::{Errno, ioctl_fionread, read, write};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{OptionalActions, QueueSelector, tcflush, tcgetattr, tcsetattr};
use tokio::time::sleep;

use super::attempt::Outcome;
use super::config::Pty as Config;
use super::outbox::Outbox;
use super::pace::Pace;
use super::teller::Teller;

/// Bytes that may wait for a reader in the kernel before one more message, of the 4095 that it can hold.
const HELD: u64 = 2048;

/// How often it is looked whether a reader has made room.
const LOOKING: Duration = Duration::from_millis(10);

/// What has not been read for so long is forgotten.
const FORGETTING: Span = Span::from_nanos(1_000_000_000);

/// Makes the terminal and its link, and writes messages to it.
pub(super) async fn talk(config: &Config, teller: &mut Teller, outbox: &Outbox) -> Outcome {
    let link = config.path.display();
    let mut pty = match Pty::open(&config.path) {
        Ok(pty) => pty,
        Err(error) => return Outcome::Absent(format!("{link}: {error}")),
    };
    let mut pace = config.baud.map(|baud| Pace::new(teller.clock(), Config::SYMBOLS, baud));
    outbox.clear();
    teller.open(format!("{link}, a link to {}", pty.far_path.display()));
    loop {
        if let Err(error) = pty.write_next(outbox, pace.as_mut()).await {
            return Outcome::Lost(error.to_string());
        }
    }
}

struct Pty {
    near: OwnedFd,
    far: OwnedFd,
    far_path: PathBuf,
    link: PathBuf,
    /// Slots and lengths of the last messages that the kernel took.
    taken: VecDeque<(u16, u64)>,
    /// Bytes that the kernel holds if nobody has read since it was last looked.
    unread: u64,
    /// When somebody read last, or there was nothing to read.
    read_at: Time,
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
        let (taken, unread, read_at) = (VecDeque::new(), 0, Time::START);
        Ok(Pty { near, far, far_path, link: link.to_owned(), taken, unread, read_at })
    }

    /// Writes the message that leaves next, when the line is free and a reader has made room.
    async fn write_next(
        &mut self,
        outbox: &Outbox,
        mut pace: Option<&mut Pace<'_>>,
    ) -> io::Result<()> {
        if let Some(pace) = &mut pace {
            pace.room().await;
        }
        outbox.something().await;
        self.forget_what_is_said();
        while self.look(outbox) > HELD {
            sleep(LOOKING).await;
        }
        // while it was waited for room all may have become too old
        let Some(message) = outbox.take(pace.as_deref()) else { return Ok(()) };
        self.write(message.bytes(), outbox).await?;
        let (now, length) = (outbox.now(), message.bytes().len());
        self.taken.push_back((message.slot(), length as u64));
        if self.taken.len() > HELD as usize {
            self.taken.pop_front();
        }
        message.written(pace.map_or(now, |pace| pace.carry(now, length)));
        Ok(())
    }

    /// Looks how many bytes the kernel holds, and forgets them if nobody reads.
    fn look(&mut self, outbox: &Outbox) -> u64 {
        let (now, held) = (outbox.now(), ioctl_fionread(&self.far).unwrap_or(0));
        if held == 0 || held < self.unread {
            self.read_at = now;
        }
        self.unread = held;
        if now - self.read_at > FORGETTING && tcflush(&self.far, QueueSelector::IFlush).is_ok() {
            self.forgotten(held, outbox);
            (self.unread, self.read_at) = (0, now);
        }
        self.unread
    }

    /// So many bytes, which the last messages make up, were never read.
    fn forgotten(&mut self, mut bytes: u64, outbox: &Outbox) {
        while bytes > 0 {
            let Some((slot, length)) = self.taken.pop_back() else { break };
            bytes = bytes.saturating_sub(length);
            outbox.unread(slot);
        }
        self.taken.clear();
    }

    async fn write(&mut self, message: &[u8], outbox: &Outbox) -> io::Result<()> {
        let mut rest = message;
        while !rest.is_empty() {
            match write(&self.near, rest) {
                Ok(count) => {
                    rest = rest.get(count..).unwrap_or_default();
                    self.unread += count as u64;
                }
                Err(Errno::INTR) => {}
                // only one message that is longer than the room there is
                Err(Errno::AGAIN) => {
                    sleep(LOOKING).await;
                    self.look(outbox);
                }
                Err(error) => return Err(error.into()),
            }
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
