//! Opening of plain and compressed files.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use flate2::read::MultiGzDecoder;

use super::error::RecordingError;

/// `NAME.csv` or `NAME.csv.zst` in a directory, the plain one first; `None` if neither is there.
pub(super) fn find(dir: &Path, name: &str) -> Option<PathBuf> {
    let plain = dir.join(name);
    if plain.is_file() {
        return Some(plain);
    }
    let compressed = compressed_form(&plain);
    compressed.is_file().then_some(compressed)
}

/// The path itself or, if it is not there, its compressed form.
pub(super) fn find_path(path: &Path) -> Result<PathBuf, RecordingError> {
    if path.exists() {
        return Ok(path.to_owned());
    }
    let compressed = compressed_form(path);
    if compressed.exists() {
        return Ok(compressed);
    }
    Err(RecordingError::Missing { file: path.to_owned(), or_compressed: !is_compressed(path) })
}

/// The same path with `.zst` added.
pub(super) fn compressed_form(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".zst");
    PathBuf::from(name)
}

/// As [`find`], and then `NAME.gz`: what others recorded comes so.
pub(super) fn find_or_gzipped(dir: &Path, name: &str) -> Option<PathBuf> {
    let gzipped = || Some(gzipped_form(&dir.join(name))).filter(|path| path.is_file());
    find(dir, name).or_else(gzipped)
}

/// The same path with `.gz` added.
pub(super) fn gzipped_form(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".gz");
    PathBuf::from(name)
}

/// Bytes of a file, decompressed if its name ends in `.zst` or `.gz`.
pub(super) fn open(path: &Path) -> Result<Box<dyn Read + Send>, RecordingError> {
    let fault = |source: io::Error| RecordingError::Read { file: path.to_owned(), line: 0, source };
    let file = File::open(path).map_err(fault)?;
    if is_compressed(path) {
        Ok(Box::new(zstd::stream::read::Decoder::new(file).map_err(fault)?))
    } else if path.extension().is_some_and(|extension| extension == "gz") {
        // a file may be of several pieces, one behind the other
        Ok(Box::new(MultiGzDecoder::new(file)))
    } else {
        Ok(Box::new(file))
    }
}

fn is_compressed(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "zst")
}
