//! Which programs run, and what they have open.

use std::fs;
use std::path::{Path, PathBuf};

/// What the daemon reads if it is not told otherwise.
const INSTALLED: &str = "/etc/insd/insd.toml";

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

/// The number of an `insd run` with this configuration that is there already.
pub(super) fn daemon(config: &Path) -> Option<u32> {
    let config = fs::canonicalize(config).ok()?;
    let runs = |folder: &Path| {
        let line = fs::read(folder.join("cmdline")).unwrap_or_default();
        let words: Vec<&str> = line
            .split(|byte| *byte == 0)
            .filter_map(|word| std::str::from_utf8(word).ok())
            .collect();
        let program = words.first().and_then(|word| word.rsplit('/').next());
        let is_run = program == Some("insd") && words.get(1) == Some(&"run");
        let given = words.iter().position(|word| *word == "--config");
        let own = given.and_then(|at| words.get(at + 1)).copied().unwrap_or(INSTALLED);
        let path = folder.join("cwd").join(own);
        is_run && fs::canonicalize(path).ok().as_ref() == Some(&config)
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
