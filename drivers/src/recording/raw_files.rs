//! Raw GNSS in a voyage directory: files of RINEX, what was done to it, and its tables in `voyage.toml`.

use std::fs::{self, OpenOptions};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use super::error::RecordingError;
use super::header::FILE_NAME;
use super::input::{find_or_gzipped, gzipped_form, open};
use super::writer::{Compression, guard, remove, remove_both, to_file};

/// The folder of the files of RINEX.
const FOLDER: &str = "raw";
/// What was done to the raw GNSS, for those who judge.
const TRUTH: &str = "truth.json";
/// Most antennas whose files of an older voyage are looked for.
const ANTENNAS: usize = 9;

/// The raw GNSS of a voyage as text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RawFiles {
    /// Observations of each antenna, RINEX.
    pub antennas: Vec<String>,
    /// Observations of the base station, RINEX.
    pub base: Option<String>,
    /// What the satellites broadcast, RINEX.
    pub navigation: String,
    /// What was done to it, JSON, where somebody knows.
    pub truth: Option<String>,
    /// The tables `[raw]` and `[base]` of `voyage.toml`.
    pub tables: String,
}

/// Puts raw GNSS into the directory of a voyage that [`super::write_voyage`] has written: `raw/a1.obs` and so on, `raw/base.obs`, `raw/nav.rnx`,
/// `truth.json` where there is one, and its tables behind those of `voyage.toml`. Those of an older voyage are removed, also where there is none.
///
/// # Errors
/// A file cannot be written or removed.
pub fn write_raw(
    dir: &Path,
    raw: Option<&RawFiles>,
    compression: Compression,
) -> Result<(), RecordingError> {
    let folder = dir.join(FOLDER);
    let antennas = (1..=ANTENNAS).map(|number| format!("a{number}.obs"));
    for name in antennas.chain(["base.obs".to_owned(), "nav.rnx".to_owned()]) {
        let path = folder.join(name);
        remove_both(&path)?;
        remove(&gzipped_form(&path))?;
    }
    remove_both(&dir.join(TRUTH))?;
    let Some(raw) = raw else { return Ok(()) };
    guard(&folder, fs::create_dir_all(&folder))?;
    let antennas =
        raw.antennas.iter().zip(1..).map(|(text, number)| (format!("a{number}.obs"), text));
    let base = raw.base.iter().map(|text| ("base.obs".to_owned(), text));
    let navigation = ("nav.rnx".to_owned(), &raw.navigation);
    for (name, text) in antennas.chain(base).chain([navigation]) {
        let path = folder.join(name);
        guard(&path, to_file(&path, compression, |target| target.write_all(text.as_bytes())))?;
    }
    let truth = dir.join(TRUTH);
    raw.truth.iter().try_for_each(|text| guard(&truth, fs::write(&truth, text)))?;
    let header = dir.join(FILE_NAME);
    let file = OpenOptions::new().append(true).open(&header);
    guard(&header, file.and_then(|mut file| write!(file, "\n{}", raw.tables)))
}

/// The observations of one antenna and what the satellites broadcast, RINEX as it stands in the files, with their paths for whoever finds fault with them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RawTexts {
    /// Observations.
    pub observations: (PathBuf, Vec<u8>),
    /// Messages.
    pub navigation: (PathBuf, Vec<u8>),
}

/// Reads the raw GNSS of an antenna, counted from 1, out of the directory of a voyage; `None` where there is none. Each file is plain, or has
/// `.zst` or `.gz` behind its name.
///
/// # Errors
/// A file cannot be read, or there are observations of the antenna and no messages.
pub fn read_raw(dir: &Path, antenna: usize) -> Result<Option<RawTexts>, RecordingError> {
    let folder = dir.join(FOLDER);
    let Some(observations) = find_or_gzipped(&folder, &format!("a{antenna}.obs")) else {
        return Ok(None);
    };
    let navigation = find_or_gzipped(&folder, "nav.rnx").ok_or_else(|| {
        RecordingError::Missing { file: folder.join("nav.rnx"), or_compressed: true }
    })?;
    Ok(Some(RawTexts { observations: text(&observations)?, navigation: text(&navigation)? }))
}

/// Reads the observations of the base station, `raw/base.obs`, with the path; `None` where there are none. It may be compressed as the others.
///
/// # Errors
/// The file cannot be read.
pub fn read_raw_base(dir: &Path) -> Result<Option<(PathBuf, Vec<u8>)>, RecordingError> {
    find_or_gzipped(&dir.join(FOLDER), "base.obs").map(|path| text(&path)).transpose()
}

fn text(path: &Path) -> Result<(PathBuf, Vec<u8>), RecordingError> {
    let mut text = Vec::new();
    let read = open(path)?.read_to_end(&mut text);
    let fault = |source| RecordingError::Read { file: path.to_owned(), line: 0, source };
    read.map_err(fault).map(|_| (path.to_owned(), text))
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::write::GzEncoder;

    fn files(antennas: usize) -> RawFiles {
        RawFiles {
            antennas: vec!["observations\n".to_owned(); antennas],
            navigation: "navigation\n".to_owned(),
            truth: Some("{}".to_owned()),
            tables: "[raw]\nrate_hz = 1.0\n".to_owned(),
            ..RawFiles::default()
        }
    }

    fn gzip(path: &Path) {
        let mut pressed = GzEncoder::new(Vec::new(), flate2::Compression::fast());
        pressed.write_all(&fs::read(path).unwrap()).unwrap();
        fs::write(gzipped_form(path), pressed.finish().unwrap()).unwrap();
        fs::remove_file(path).unwrap();
    }

    #[test]
    fn files_are_read_plain_or_compressed_either_way_and_a_broken_one_is_told() {
        let desk = tempfile::tempdir().unwrap();
        fs::write(desk.path().join(FILE_NAME), "").unwrap();
        let read = || {
            let texts = read_raw(desk.path(), 1)?.unwrap();
            Ok::<_, RecordingError>([texts.observations.1, texts.navigation.1])
        };
        let expected = [b"observations\n".to_vec(), b"navigation\n".to_vec()];
        write_raw(desk.path(), Some(&files(1)), Compression::Zstd).unwrap();
        assert_eq!(read().unwrap(), expected);
        write_raw(desk.path(), Some(&files(1)), Compression::None).unwrap();
        assert_eq!(read().unwrap(), expected);
        let folder = desk.path().join(FOLDER);
        gzip(&folder.join("a1.obs"));
        gzip(&folder.join("nav.rnx"));
        assert_eq!(names(desk.path()), ["a1.obs.gz", "nav.rnx.gz"]);
        assert_eq!(read().unwrap(), expected);

        let path = folder.join("a1.obs.gz");
        let whole = fs::read(&path).unwrap();
        fs::write(&path, &whole[..whole.len() - 5]).unwrap();
        assert!(read().unwrap_err().to_string().contains("a1.obs.gz"));
        write_raw(desk.path(), None, Compression::None).unwrap();
        assert!(names(desk.path()).is_empty());
    }

    fn names(dir: &Path) -> Vec<String> {
        let entries = fs::read_dir(dir.join(FOLDER)).unwrap();
        let name = |entry: std::io::Result<fs::DirEntry>| entry.unwrap().file_name();
        let mut names: Vec<String> =
            entries.map(|entry| name(entry).to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    #[test]
    fn files_of_an_older_voyage_go_and_the_tables_stand_behind_the_others() {
        let desk = tempfile::tempdir().unwrap();
        let header = desk.path().join(FILE_NAME);
        fs::write(&header, "mode = \"moored\"\n").unwrap();
        write_raw(desk.path(), Some(&files(2)), Compression::Zstd).unwrap();
        assert_eq!(names(desk.path()), ["a1.obs.zst", "a2.obs.zst", "nav.rnx.zst"]);
        assert!(fs::read_to_string(&header).unwrap().ends_with("\n\n[raw]\nrate_hz = 1.0\n"));
        write_raw(desk.path(), Some(&files(1)), Compression::None).unwrap();
        assert_eq!(names(desk.path()), ["a1.obs", "nav.rnx"]);
        write_raw(desk.path(), None, Compression::None).unwrap();
        assert!(names(desk.path()).is_empty() && !desk.path().join(TRUTH).exists());
    }
}
