//! Files that appear whole or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, IntoInnerError, Write};
use std::path::{Path, PathBuf};

use anyhow::Context;

/// A file in the making beside its final place. It takes that place when it is finished; a command
/// that fails leaves nothing behind. Pipes and devices are written directly.
#[derive(Debug)]
pub struct OutputFile {
    place: PathBuf,
    /// The name until it is finished; `None` for pipes and devices.
    temporary: Option<PathBuf>,
    file: Option<BufWriter<File>>,
}

impl OutputFile {
    /// A file that will take this place.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn create(place: &Path) -> anyhow::Result<Self> {
        let is_special = fs::metadata(place).is_ok_and(|about| !about.is_file());
        let temporary = (!is_special).then(|| {
            let mut name = place.as_os_str().to_owned();
            name.push(".part");
            PathBuf::from(name)
        });
        let target = temporary.as_deref().unwrap_or(place);
        let file = File::create(target)
            .with_context(|| format!("{}: cannot be written", place.display()))?;
        let file = Some(BufWriter::with_capacity(1 << 16, file));
        Ok(OutputFile { place: place.to_owned(), temporary, file })
    }

    /// Moves the file to its place.
    ///
    /// # Errors
    /// It cannot be written or moved.
    pub fn finish(mut self) -> anyhow::Result<()> {
        let written = match self.file.take() {
            Some(file) => file.into_inner().map(drop).map_err(IntoInnerError::into_error),
            None => Ok(()),
        };
        let moved = written.and_then(|()| match &self.temporary {
            Some(temporary) => fs::rename(temporary, &self.place),
            None => Ok(()),
        });
        moved.with_context(|| format!("{}: cannot be written", self.place.display()))?;
        self.temporary = None;
        Ok(())
    }
}

/// Puts a text in the place of a file, whole or not at all, and waits until the disk has it.
pub fn replace(place: &Path, text: &str) -> io::Result<()> {
    let fresh = place.with_extension("new");
    let mut file = File::create(&fresh)?;
    file.write_all(text.as_bytes())?;
    file.sync_all()?;
    fs::rename(&fresh, place)
}

impl Write for OutputFile {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        match &mut self.file {
            Some(file) => file.write(bytes),
            None => Ok(0),
        }
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.file.as_mut().map_or(Ok(()), Write::flush)
    }
}

impl Drop for OutputFile {
    fn drop(&mut self) {
        if let Some(temporary) = &self.temporary {
            let _ = fs::remove_file(temporary);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_is_not_finished_leaves_the_old_one_alone() {
        let dir = tempfile::tempdir().unwrap();
        let place = dir.path().join("nav.csv");
        fs::write(&place, "old").unwrap();
        let mut file = OutputFile::create(&place).unwrap();
        file.write_all(b"half").unwrap();
        drop(file);
        assert_eq!(fs::read_to_string(&place).unwrap(), "old");
        let mut file = OutputFile::create(&place).unwrap();
        file.write_all(b"whole").unwrap();
        file.finish().unwrap();
        assert_eq!(fs::read_to_string(&place).unwrap(), "whole");
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1);
    }
}
