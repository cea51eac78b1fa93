//! The recordings of an archive: voyage directories and folders with raw recordings, wherever they lie.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use insd_config::BadInput;

use crate::raw_run::is_recording;

/// One of them.
pub(super) struct Recording {
    /// The name of its archive and the way to it from there, the same on each computer.
    pub(super) name: String,
    /// Where it lies here.
    pub(super) path: PathBuf,
}

/// All recordings, in the order of their names within each archive.
///
/// # Errors
/// A folder cannot be read, or two recordings have the same name.
pub(super) fn find(archives: &[PathBuf]) -> anyhow::Result<Vec<Recording>> {
    let mut all = Vec::new();
    for archive in archives {
        let name = archive.file_name().unwrap_or(archive.as_os_str()).to_string_lossy();
        search(archive, &name, &mut all)?;
    }
    let mut names = BTreeSet::new();
    match all.iter().find(|own| !names.insert(own.name.as_str())) {
        None => Ok(all),
        Some(twice) => {
            let path = twice.path.display();
            Err(BadInput(format!("{path}: another recording is called {} too", twice.name)).into())
        }
    }
}

fn search(place: &Path, name: &str, all: &mut Vec<Recording>) -> anyhow::Result<()> {
    if place.join("voyage.toml").exists() || is_recording(place) {
        all.push(Recording { name: name.to_owned(), path: place.to_owned() });
        return Ok(());
    }
    let said = |fault: std::io::Error| BadInput(format!("{}: {fault}", place.display()));
    let mut folders = Vec::new();
    for entry in fs::read_dir(place).map_err(said)? {
        let entry = entry.map_err(said)?;
        // of links nobody knows where they end
        if entry.file_type().map_err(said)?.is_dir() {
            folders.push(entry.file_name());
        }
    }
    folders.sort_unstable();
    folders.iter().try_for_each(|folder| {
        search(&place.join(folder), &format!("{name}/{}", folder.to_string_lossy()), all)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn voyages_and_recordings_are_found_wherever_they_lie_and_others_are_not() {
        let desk = tempfile::tempdir().unwrap();
        let archive = desk.path().join("archive");
        for folder in ["2026/05/b", "2026/05/a/inside", "2026/empty"] {
            fs::create_dir_all(archive.join(folder)).unwrap();
        }
        fs::write(archive.join("2026/05/b/x-000001.insdraw"), "").unwrap();
        fs::write(archive.join("2026/05/a/voyage.toml"), "").unwrap();
        fs::write(archive.join("2026/notes.txt"), "").unwrap();
        // a voyage may have anything in it
        fs::write(archive.join("2026/05/a/inside/voyage.toml"), "").unwrap();
        let names =
            |all: &[Recording]| -> Vec<String> { all.iter().map(|own| own.name.clone()).collect() };
        let found = find(std::slice::from_ref(&archive)).unwrap();
        assert_eq!(names(&found), ["archive/2026/05/a", "archive/2026/05/b"]);
        let one = find(&[archive.join("2026/05/b/x-000001.insdraw")]).unwrap();
        assert_eq!(names(&one), ["x-000001.insdraw"]);
        let twice = find(&[archive.clone(), archive]).err().unwrap().to_string();
        assert!(twice.contains("archive/2026/05/a too"), "{twice}");
        assert!(find(&[desk.path().join("none")]).is_err());
    }
}
