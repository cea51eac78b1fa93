//! A pseudo terminal that programs read NMEA from as from a serial port.
//!
//! The far end is held open, so that writing never fails for want of a reader, and writing never
//! waits: what nobody has read within a few seconds makes room for what is new, and is counted.

use std::collections::VecDeque;
use std::ffi::OsStr;
use std::os::fd::OwnedFd;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};

use rustix::fs::{Mode, OFlags, fchmod, fcntl_getfl, fcntl_setfl, open};
use rustix::io::{Errno, ioctl_fionread, write};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{
    OptionalActions, QueueSelector, ioctl_tiocnxcl, tcflush, tcgetattr, tcsetattr,
};

/// Bytes that may wait for a reader: about three seconds at the pace of a ship. The kernel can
/// hold and count 4095.
const WAITING_LIMIT: u64 = 3000;

/// The near end, and the far end held open.
#[derive(Debug)]
pub struct PseudoTerminal {
    near: OwnedFd,
    far: OwnedFd,
    path: PathBuf,
    /// Groups of whole sentences that the kernel has not got yet.
    queue: VecDeque<Vec<u8>>,
    /// Unread bytes that the kernel held after the last pump.
    left: u64,
    produced: u64,
    dropped: u64,
}

impl PseudoTerminal {
    /// Opens a pair and puts it into raw mode, so that bytes pass unchanged and without echo.
    ///
    /// # Errors
    /// Those of the kernel, for example when no pseudo terminal is left.
    pub fn open() -> std::io::Result<Self> {
        let near = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC)?;
        grantpt(&near)?;
        unlockpt(&near)?;
        let name = ptsname(&near, Vec::new())?;
        let path = PathBuf::from(OsStr::from_bytes(name.as_bytes()));
        let flags = OFlags::RDWR | OFlags::NOCTTY | OFlags::CLOEXEC | OFlags::NONBLOCK;
        let far = open(&path, flags, Mode::empty())?;
        let mut settings = tcgetattr(&far)?;
        settings.make_raw();
        tcsetattr(&far, OptionalActions::Now, &settings)?;
        fcntl_setfl(&near, fcntl_getfl(&near)? | OFlags::NONBLOCK)?;
        Ok(PseudoTerminal {
            near,
            far,
            path,
            queue: VecDeque::new(),
            left: 0,
            produced: 0,
            dropped: 0,
        })
    }

    /// Path of the end that programs open.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Lets every user of this computer read it.
    ///
    /// # Errors
    /// Those of the kernel.
    pub fn share(&self) -> std::io::Result<()> {
        Ok(fchmod(&self.far, Mode::from_raw_mode(0o666))?)
    }

    /// Lets the next reader in after one who took the terminal for himself (`TIOCEXCL`) and was killed: a
    /// serial line forgets that with its last user, this one has us as another.
    pub fn release(&self) {
        // it fails on what is no terminal
        let _ = ioctl_tiocnxcl(&self.far);
    }

    /// Bytes pushed, read or not.
    #[must_use]
    pub fn produced(&self) -> u64 {
        self.produced
    }

    /// Bytes that nobody will ever read.
    #[must_use]
    pub fn dropped(&self) -> u64 {
        self.dropped
    }

    /// Takes whole sentences; they leave with the next [`PseudoTerminal::pump`].
    pub fn push(&mut self, sentences: &[u8]) {
        self.produced += sentences.len() as u64;
        self.queue.push_back(sentences.to_vec());
    }

    /// Hands what was pushed to the kernel, without waiting. If that is more than may wait, the
    /// oldest goes: also what the kernel holds, unless somebody is just reading it. To be called
    /// some milliseconds apart, as the kernel counts what it holds with a delay.
    pub fn pump(&mut self) {
        let mut held = ioctl_fionread(&self.far).unwrap_or(0);
        let nobody_reads = held >= self.left;
        let queued: u64 = self.queue.iter().map(|group| group.len() as u64).sum();
        if held + queued > WAITING_LIMIT
            && nobody_reads
            && tcflush(&self.far, QueueSelector::IFlush).is_ok()
        {
            self.dropped += held;
            held = 0;
        }
        let mut excess = (held + queued).saturating_sub(WAITING_LIMIT);
        while let Some(group) = self.queue.pop_front() {
            let length = group.len() as u64;
            if excess == 0 {
                held += self.write(&group);
            } else {
                excess = excess.saturating_sub(length);
                self.dropped += length;
            }
        }
        self.left = held;
    }

    /// Writes as much as the kernel takes at once; the rest is dropped.
    fn write(&mut self, bytes: &[u8]) -> u64 {
        let mut rest = bytes;
        while !rest.is_empty() {
            match write(&self.near, rest) {
                Ok(count) => rest = &rest[count.min(rest.len())..],
                Err(Errno::INTR) => {}
                Err(_) => break,
            }
        }
        self.dropped += rest.len() as u64;
        (bytes.len() - rest.len()) as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;

    fn reader(pty: &PseudoTerminal) -> std::fs::File {
        let flags = OFlags::RDONLY | OFlags::NOCTTY | OFlags::NONBLOCK;
        open(pty.path(), flags, Mode::empty()).unwrap().into()
    }

    fn settle() {
        std::thread::sleep(std::time::Duration::from_millis(2));
    }

    /// Waits until the kernel has handed over what was written, which on a busy machine takes its time.
    fn arrive(pty: &PseudoTerminal) {
        const PATIENCE: u32 = 500;
        for _ in 0..PATIENCE {
            settle();
            if ioctl_fionread(&pty.far).unwrap() >= pty.left {
                return;
            }
        }
    }

    fn read_all(reader: &mut std::fs::File) -> String {
        // the kernel hands bytes over when it gets to it, on a busy machine some time later
        const PATIENCE: u32 = 10;
        let mut text = String::new();
        let mut bytes = [0; 4096];
        let mut waited = 0;
        while waited < PATIENCE {
            settle();
            match reader.read(&mut bytes) {
                Ok(count @ 1..) => {
                    text.push_str(std::str::from_utf8(&bytes[..count]).unwrap());
                    waited = 0;
                }
                _ => waited += 1,
            }
        }
        text
    }

    /// 492 bytes that end in a number.
    fn group(number: u32) -> String {
        format!("$IIXXX,{number:0483}\r\n")
    }

    #[test]
    fn what_is_written_is_read_unchanged() {
        let mut pty = PseudoTerminal::open().unwrap();
        pty.push(b"$HETHS,316.70,E*1A\r\n");
        pty.pump();
        assert_eq!(read_all(&mut reader(&pty)), "$HETHS,316.70,E*1A\r\n");
        assert_eq!((pty.produced(), pty.dropped()), (20, 0));
    }

    #[test]
    fn writing_without_a_reader_never_waits_and_the_newest_bytes_stay() {
        let mut pty = PseudoTerminal::open().unwrap();
        for number in 0..200 {
            pty.push(group(number).as_bytes());
            pty.push(group(number).as_bytes());
            pty.pump();
            arrive(&pty);
        }
        let text = read_all(&mut reader(&pty));
        assert!(text.ends_with(&group(199)), "{text:?}");
        assert!(text.len() as u64 <= WAITING_LIMIT);
        assert_eq!(pty.dropped() + text.len() as u64, pty.produced());
    }

    #[test]
    fn a_reader_gets_whole_sentences_even_when_there_are_too_many() {
        let mut pty = PseudoTerminal::open().unwrap();
        let mut reader = reader(&pty);
        let mut text = String::new();
        for number in 0..50 {
            (0..20).for_each(|_| pty.push(group(number).as_bytes()));
            pty.pump();
            text.push_str(&read_all(&mut reader));
        }
        assert!(text.split_terminator("\r\n").all(|line| line.len() == group(0).len() - 2));
        assert_eq!(pty.dropped() + text.len() as u64, pty.produced());
        assert!(pty.dropped() > 0 && text.ends_with(&group(49)));
    }
}
