//! The files of a series in a folder: `NAME-000001.insdraw`, `NAME-000002.insdraw`, ...

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// How the name of every recording ends.
pub const EXTENSION: &str = "insdraw";

/// A file of a series.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Member {
    /// Name of the series.
    pub(crate) name: String,
    /// Number of the file in it.
    pub(crate) serial: u32,
    /// Where it is.
    pub(crate) path: PathBuf,
    /// Bytes.
    pub(crate) length: u64,
}

/// Path of a file.
pub(crate) fn path_of(folder: &Path, name: &str, serial: u32) -> PathBuf {
    folder.join(format!("{name}-{serial:06}.{EXTENSION}"))
}

/// Whether a series can have this name: letters, digits, `-`, `_` and `.`, and no hidden file.
pub(crate) fn is_name(name: &str) -> bool {
    let good = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
    !name.is_empty() && name.len() <= 200 && !name.starts_with('.') && name.chars().all(good)
}

/// All files of all series in a folder, ordered by name and number.
pub(crate) fn members(folder: &Path) -> io::Result<Vec<Member>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let Some((name, serial)) = entry.file_name().to_str().and_then(parse) else { continue };
        let length = match entry.metadata() {
            Ok(data) if data.is_file() => data.len(),
            // gone meanwhile, or no file
            _ => continue,
        };
        found.push(Member { name, serial, path: entry.path(), length });
    }
    found.sort();
    Ok(found)
}

fn parse(file: &str) -> Option<(String, u32)> {
    let (stem, extension) = file.rsplit_once('.')?;
    let (name, digits) = stem.rsplit_once('-')?;
    let is_number = digits.len() >= 6 && digits.bytes().all(|digit| digit.is_ascii_digit());
    (extension == EXTENSION && is_number).then_some(())?;
    Some((name.to_owned(), digits.parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_told_from_its_number() {
        assert_eq!(parse("a-b-000012.insdraw"), Some(("a-b".to_owned(), 12)));
        assert_eq!(parse("x-1234567.insdraw"), Some(("x".to_owned(), 1_234_567)));
        for other in ["x-12.insdraw", "x-000001.csv", "x.insdraw", "x-00000a.insdraw"] {
            assert_eq!(parse(other), None);
        }
        assert!(is_name("insd") && is_name("2026-11-21_ship.1"));
        assert!(!is_name("") && !is_name("../x") && !is_name(".x") && !is_name("a b"));
    }
}
