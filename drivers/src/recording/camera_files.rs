//! What a camera tells in a voyage directory: tracks of points, steps of a visual odometry, and its table in `voyage.toml`.

use std::fs::OpenOptions;
use std::io::Write;
use std::path::Path;

use super::error::RecordingError;
use super::header::FILE_NAME;
use super::writer::{Compression, guard, remove_both, to_file};

/// What a camera tells in a voyage, as text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CameraFiles {
    /// Tracks: `features.csv`.
    pub features: String,
    /// Steps of a visual odometry: `vo.csv`.
    pub odometry: String,
    /// The table `[camera]` of `voyage.toml`.
    pub table: String,
}

/// Puts what a camera tells into the directory of a voyage that [`super::write_voyage`] has written: `features.csv`, `vo.csv`, and its table
/// behind those of `voyage.toml`. Those of an older voyage are removed, also where there is none.
///
/// # Errors
/// A file cannot be written or removed.
pub fn write_camera(
    dir: &Path,
    camera: Option<&CameraFiles>,
    compression: Compression,
) -> Result<(), RecordingError> {
    let paths = ["features.csv", "vo.csv"].map(|name| dir.join(name));
    paths.iter().try_for_each(|path| remove_both(path))?;
    let Some(camera) = camera else { return Ok(()) };
    for (path, text) in paths.iter().zip([&camera.features, &camera.odometry]) {
        guard(path, to_file(path, compression, |target| target.write_all(text.as_bytes())))?;
    }
    let header = dir.join(FILE_NAME);
    let file = OpenOptions::new().append(true).open(&header);
    guard(&header, file.and_then(|mut file| write!(file, "\n{}", camera.table)))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn files_of_an_older_voyage_go_and_the_table_stands_behind_the_others() {
        let desk = tempfile::tempdir().unwrap();
        let header = desk.path().join(FILE_NAME);
        fs::write(&header, "mode = \"moored\"\n").unwrap();
        let files = CameraFiles {
            features: "t_s\n".to_owned(),
            odometry: "t_s\n".to_owned(),
            table: "[camera]\nrate_hz = 1.0\n".to_owned(),
        };
        write_camera(desk.path(), Some(&files), Compression::Zstd).unwrap();
        assert!(desk.path().join("features.csv.zst").exists());
        assert!(fs::read_to_string(&header).unwrap().ends_with("\n\n[camera]\nrate_hz = 1.0\n"));
        write_camera(desk.path(), Some(&files), Compression::None).unwrap();
        assert!(!desk.path().join("features.csv.zst").exists());
        assert_eq!(fs::read_to_string(desk.path().join("vo.csv")).unwrap(), "t_s\n");
        write_camera(desk.path(), None, Compression::None).unwrap();
        assert!(!desk.path().join("features.csv").exists());
    }
}
