//! Pseudo terminals in place of serial lines.

use std::fs::{self, File};
use std::io::Write;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};

use rustix::fs::{Mode, OFlags};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};

/// The device's end of a line.
#[derive(Debug)]
pub struct Wire {
    end: File,
    /// Keeps the line up while nobody reads it.
    _other: File,
    path: PathBuf,
}

impl Wire {
    /// A line whose other end is opened under this path.
    ///
    /// # Errors
    /// What the system says.
    pub fn new(path: &Path) -> std::io::Result<Self> {
        let end = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY)?;
        grantpt(&end)?;
        unlockpt(&end)?;
        let name = ptsname(&end, Vec::new())?.into_string().unwrap_or_default();
        let other = rustix::fs::open(&name, OFlags::RDWR | OFlags::NOCTTY, Mode::empty())?;
        let mut settings = rustix::termios::tcgetattr(&other)?;
        settings.make_raw();
        rustix::termios::tcsetattr(&other, rustix::termios::OptionalActions::Now, &settings)?;
        let _ = fs::remove_file(path);
        symlink(&name, path)?;
        Ok(Wire { end: File::from(end), _other: File::from(other), path: path.to_owned() })
    }

    /// The device's end, for whoever reads or writes it by other means.
    ///
    /// # Errors
    /// What the system says.
    pub fn file(&self) -> std::io::Result<File> {
        self.end.try_clone()
    }

    /// Sends bytes.
    ///
    /// # Errors
    /// What the system says.
    pub fn send(&mut self, bytes: &[u8]) -> std::io::Result<()> {
        self.end.write_all(bytes)
    }
}

impl Drop for Wire {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.path);
    }
}
