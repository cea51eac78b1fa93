//! The little that the writer asks of a disk; tests put a bad one in its place.

use std::fmt::Debug;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::os::unix::fs::MetadataExt;
use std::path::Path;

/// A place for files.
pub(crate) trait Disk: Debug + Send {
    /// Makes a new, empty file, and its folder if need be. The file's name is on the disk when this
    /// returns.
    fn create(&self, path: &Path) -> io::Result<Box<dyn Output>>;
    /// Removes a file.
    fn remove(&self, path: &Path) -> io::Result<()>;
}

/// A file that grows.
pub(crate) trait Output: Debug + Send {
    /// Appends bytes; they are on the disk when this returns.
    fn append(&mut self, bytes: &[u8]) -> io::Result<()>;
    /// Takes back what a failed append left beyond a length.
    fn cut(&mut self, length: u64) -> io::Result<()>;
    /// Whether nobody has deleted it: what is appended then is lost, and the system says nothing.
    fn is_there(&self) -> bool;
}

/// The disk of the computer.
#[derive(Debug)]
pub(crate) struct LocalDisk;

impl Disk for LocalDisk {
    fn create(&self, path: &Path) -> io::Result<Box<dyn Output>> {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new("."));
        fs::create_dir_all(folder)?;
        let file = OpenOptions::new().append(true).create_new(true).open(path)?;
        if let Err(fault) = File::open(folder).and_then(|folder| folder.sync_all()) {
            let _ = fs::remove_file(path);
            return Err(fault);
        }
        Ok(Box::new(file))
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        fs::remove_file(path)
    }
}

impl Output for File {
    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.write_all(bytes)?;
        self.sync_data()
    }

    fn cut(&mut self, length: u64) -> io::Result<()> {
        self.set_len(length)
    }

    fn is_there(&self) -> bool {
        self.metadata().is_ok_and(|about| about.nlink() > 0)
    }
}
