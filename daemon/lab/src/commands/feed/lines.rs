//! Pseudo terminals in the place of serial lines, with links that keep their names.

use std::fs;
use std::io;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};

use anyhow::Context;
use insd_simulator::feed::LineSending;

use crate::pty::PseudoTerminal;

/// One terminal for each sensor.
pub(super) struct Lines {
    lines: Vec<Line>,
}

struct Line {
    pty: PseudoTerminal,
    link: PathBuf,
}

impl Lines {
    /// Makes the terminals, and links to them in a folder, which is made if it is not there.
    pub(super) fn open<'a>(
        folder: &Path,
        names: impl Iterator<Item = &'a str>,
    ) -> anyhow::Result<Self> {
        fs::create_dir_all(folder).with_context(|| format!("{}", folder.display()))?;
        let open = |name: &str| {
            let link = folder.join(name);
            Line::open(link.clone()).with_context(|| format!("{}", link.display()))
        };
        Ok(Lines { lines: names.map(open).collect::<Result<_, _>>()? })
    }

    /// Sends a message; what nobody reads makes room for what is new.
    pub(super) fn send(&mut self, sending: &LineSending) {
        if let Some(line) = self.lines.get_mut(sending.port) {
            line.pty.release();
            line.pty.push(sending.bytes());
            line.pty.pump();
        }
    }
}

impl Line {
    fn open(link: PathBuf) -> io::Result<Self> {
        let pty = PseudoTerminal::open()?;
        pty.share()?;
        // a link that an earlier run has left is replaced; anything else is not ours
        if link.symlink_metadata().is_ok_and(|found| found.is_symlink()) {
            fs::remove_file(&link)?;
        }
        symlink(pty.path(), &link)?;
        Ok(Line { pty, link })
    }
}

impl Drop for Line {
    fn drop(&mut self) {
        // another run may have made it its own
        if fs::read_link(&self.link).is_ok_and(|to| to == self.pty.path()) {
            let _ = fs::remove_file(&self.link);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;

    use insd_base::{Input, Time};

    fn sending(port: usize, bytes: &[u8]) -> LineSending {
        LineSending { at: Time::START, port, input: Input::Bytes(bytes.to_vec()) }
    }

    #[test]
    fn each_sensor_is_read_at_its_link_which_goes_with_it() {
        let folder = tempfile::tempdir().unwrap();
        let mut lines = Lines::open(folder.path(), ["imu", "gnss"].into_iter()).unwrap();
        lines.send(&sending(1, b"$GPZDA\r\n"));
        lines.send(&sending(7, b"of nobody"));
        let mut read = [0; 8];
        fs::File::open(folder.path().join("gnss")).unwrap().read_exact(&mut read).unwrap();
        assert_eq!(&read, b"$GPZDA\r\n");
        drop(lines);
        assert!(!folder.path().join("gnss").is_symlink());
    }

    #[test]
    fn a_file_that_is_no_link_is_left_alone() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("imu"), "mine").unwrap();
        assert!(Lines::open(folder.path(), ["imu"].into_iter()).is_err());
        assert_eq!(fs::read_to_string(folder.path().join("imu")).unwrap(), "mine");
    }
}
