//! Which programs run, and what they have open.

use std::fs;
use std::path::{Path, PathBuf};

/// A program that has something open.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Holder {
    pub(super) number: u32,
    pub(super) name: String,
}

fn processes() -> impl Iterator<Item = (u32, PathBuf)> {
    let entries = fs::read_dir("/proc").into_iter().flatten().flatten();
    let own = std::process::id();
    entries.filter_map(move |entry| {
        let number = entry.file_name().to_str()?.parse().ok()?;
        (number != own).then(|| (number, entry.path()))
    })
}

/// The number of an `insd run` that is there already.
pub(super) fn daemon() -> Option<u32> {
    let runs = |folder: &Path| {
        let line = fs::read(folder.join("cmdline")).unwrap_or_default();
        let mut words = line.split(|byte| *byte == 0);
        let program = words.next().and_then(|word| word.rsplit(|byte| *byte == b'/').next());
        program == Some(b"insd") && words.next() == Some(b"run")
    };
    processes().find(|(_, folder)| runs(folder)).map(|(number, _)| number)
}

/// A program that has a device open, as far as this program may know.
pub(super) fn holder(device: &Path) -> Option<Holder> {
    let device = fs::canonicalize(device).ok()?;
    let holds = |folder: &Path| {
        let files = fs::read_dir(folder.join("fd")).into_iter().flatten().flatten();
        files.filter_map(|file| fs::read_link(file.path()).ok()).any(|open| open == device)
    };
    let (number, folder) = processes().find(|(_, folder)| holds(folder))?;
    let name = fs::read_to_string(folder.join("comm")).unwrap_or_default();
    Some(Holder { number, name: name.trim().to_owned() })
}
