//! Raw recordings on the disk.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::UNIX_EPOCH;

use serde::Serialize;
use tokio::fs::File;
use tokio::sync::{OwnedSemaphorePermit, Semaphore};

/// How the names of recordings end.
const ENDING: &str = ".insdraw";
/// Most that are listed, the newest.
const LISTED: usize = 1000;
/// Most that are fetched at a time: the disk is there for recording.
const AT_ONCE: usize = 2;

/// Where they lie.
#[derive(Debug)]
pub(super) struct Recordings {
    folder: PathBuf,
    turns: Arc<Semaphore>,
}

/// One of them.
#[derive(Debug, PartialEq, Serialize)]
pub(super) struct Listed {
    name: String,
    bytes: u64,
    /// When it was written last, s since 1970.
    written_s: Option<u64>,
}

impl Recordings {
    pub(super) fn of(folder: PathBuf) -> Self {
        Recordings { folder, turns: Arc::new(Semaphore::new(AT_ONCE)) }
    }

    /// One of the few turns at which a file is fetched; `None` while others have them.
    pub(super) fn turn(&self) -> Option<OwnedSemaphorePermit> {
        Arc::clone(&self.turns).try_acquire_owned().ok()
    }

    /// Which there are, newest first.
    pub(super) async fn listed(&self) -> io::Result<Vec<Listed>> {
        let mut files = Vec::new();
        let mut entries = tokio::fs::read_dir(&self.folder).await?;
        while let Some(entry) = entries.next_entry().await? {
            let Some(name) =
                entry.file_name().to_str().filter(|name| is_name(name)).map(str::to_owned)
            else {
                continue;
            };
            // one may go while it is looked at
            let Ok(told) = entry.metadata().await else { continue };
            let since = told.modified().ok().and_then(|at| at.duration_since(UNIX_EPOCH).ok());
            let written_s = since.map(|since| since.as_secs());
            if told.is_file() {
                files.push(Listed { name, bytes: told.len(), written_s });
            }
        }
        files.sort_by(|one, other| (other.written_s, &other.name).cmp(&(one.written_s, &one.name)));
        files.truncate(LISTED);
        Ok(files)
    }

    /// Where the one of this name lies, which must be one.
    pub(super) fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Nothing but an ordinary file is opened, and no link to one.
    pub(super) async fn open(&self, name: &str) -> io::Result<(File, u64)> {
        let path = self.path(name);
        if !tokio::fs::symlink_metadata(&path).await?.is_file() {
            return Err(io::ErrorKind::NotFound.into());
        }
        let file = File::open(path).await?;
        let length = file.metadata().await?.len();
        Ok((file, length))
    }
}

/// Whether it is the name of a recording, and nothing but a name.
pub(super) fn is_name(name: &str) -> bool {
    let sound = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
    name.ends_with(ENDING) && !name.starts_with('.') && name.chars().all(sound)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_leads_nowhere_else() {
        assert!(is_name("insd-000001.insdraw"));
        for name in
            ["../insd-000001.insdraw", ".insdraw", "a/b.insdraw", "insd.toml", "a\"b.insdraw"]
        {
            assert!(!is_name(name), "{name}");
        }
    }

    #[test]
    fn the_newest_is_listed_first_and_nothing_but_recordings() {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in
            [("insd-000001.insdraw", "one"), ("insd-000002.insdraw", "two!"), ("token", "secret")]
        {
            std::fs::write(folder.path().join(name), text).unwrap();
        }
        std::fs::create_dir(folder.path().join("folder.insdraw")).unwrap();
        std::os::unix::fs::symlink("token", folder.path().join("link.insdraw")).unwrap();
        let own = Recordings::of(folder.path().to_owned());
        let runtime = tokio::runtime::Builder::new_current_thread().build().unwrap();
        let files = runtime.block_on(own.listed()).unwrap();
        let told: Vec<(&str, u64)> =
            files.iter().map(|own| (own.name.as_str(), own.bytes)).collect();
        assert_eq!(told, [("insd-000002.insdraw", 4), ("insd-000001.insdraw", 3)]);
        assert!(files.iter().all(|own| own.written_s.is_some()));
        assert!(runtime.block_on(own.open("link.insdraw")).is_err());
    }
}
