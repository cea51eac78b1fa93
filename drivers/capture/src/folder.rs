//! A folder of pictures with `times.csv`: `t_s,file`, one row for each, seconds since the start of the voyage.

use std::path::{Path, PathBuf};
use std::vec;

use insd_base::Time;
use insd_vision::CameraImage;

use crate::fault::CaptureFault;
use crate::image_file::read_image;

/// An image with its time, of any source.
#[derive(Clone, Debug, PartialEq)]
pub struct TimedImage {
    /// When it was exposed, as far as is known.
    pub time: Time,
    /// Width and height that it should have, px.
    pub size: [u32; 2],
    /// Grey, 8 bits; fewer than there should be if it is torn.
    pub pixels: Vec<u8>,
}

impl TimedImage {
    /// As the front end takes it.
    #[must_use]
    pub fn picture(&self) -> CameraImage<'_> {
        CameraImage { time: self.time, size: self.size, pixels: &self.pixels }
    }
}

/// The pictures of a folder in the order of the table.
#[derive(Debug)]
pub struct ImageFolder {
    rows: vec::IntoIter<(Time, PathBuf)>,
}

impl ImageFolder {
    /// Reads the table, and no picture yet.
    ///
    /// # Errors
    /// There is no table, or a row of it is wrong.
    pub fn open(folder: &Path) -> Result<Self, CaptureFault> {
        let path = folder.join("times.csv");
        let text = std::fs::read_to_string(&path)
            .map_err(|fault| CaptureFault::io(&path.display(), fault))?;
        let wrong = |line: usize, reason: String| CaptureFault::Line {
            place: path.display().to_string(),
            line,
            reason,
        };
        let mut lines = text.lines().map(str::trim).enumerate();
        if lines.next().map(|(_, head)| head) != Some("t_s,file") {
            return Err(wrong(1, "wants the head t_s,file".to_owned()));
        }
        let rows: Result<Vec<_>, _> = lines
            .filter(|(_, line)| !line.is_empty())
            .map(|(index, line)| row(folder, line).map_err(|reason| wrong(index + 1, reason)))
            .collect();
        Ok(ImageFolder { rows: rows?.into_iter() })
    }

    /// Pictures that are left.
    #[must_use]
    pub fn left(&self) -> usize {
        self.rows.len()
    }
}

fn row(folder: &Path, line: &str) -> Result<(Time, PathBuf), String> {
    let (time, file) = line.split_once(',').ok_or("wants two fields: t_s,file")?;
    let seconds: f64 = time.trim().parse().map_err(|_| format!("t_s: {time} is no number"))?;
    if !seconds.is_finite() {
        return Err(format!("t_s: {time} is no time"));
    }
    Ok((Time::from_seconds(seconds), folder.join(file.trim())))
}

impl Iterator for ImageFolder {
    type Item = Result<TimedImage, CaptureFault>;

    fn next(&mut self) -> Option<Self::Item> {
        let (time, path) = self.rows.next()?;
        let timed = |image: crate::image_file::GreyImage| TimedImage {
            time,
            size: image.size,
            pixels: image.pixels,
        };
        Some(read_image(&path).map(timed))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn open(table: &str) -> Result<Vec<TimedImage>, String> {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("times.csv"), table).unwrap();
        std::fs::write(folder.path().join("a.pgm"), b"P5 2 1 255\nxy").unwrap();
        let images = ImageFolder::open(folder.path()).map_err(|fault| fault.to_string())?;
        images.collect::<Result<_, _>>().map_err(|fault| fault.to_string())
    }

    #[test]
    fn pictures_come_with_their_times() {
        let images = open("t_s,file\n0.1,a.pgm\n0.25, a.pgm\n").unwrap();
        assert_eq!(images[1].time, Time::from_seconds(0.25));
        assert_eq!((images.len(), images[0].pixels.as_slice()), (2, &b"xy"[..]));
    }

    #[test]
    fn a_wrong_row_is_told_with_its_line() {
        for (table, complaint) in [
            ("file,t_s\n", "times.csv:1: wants the head t_s,file"),
            ("t_s,file\n0.1,a.pgm\n0.2\n", "times.csv:3: wants two fields: t_s,file"),
            ("t_s,file\nsoon,a.pgm\n", "times.csv:2: t_s: soon is no number"),
            ("t_s,file\n0.1,b.pgm\n", "b.pgm: No such file"),
        ] {
            let told = open(table).unwrap_err();
            assert!(told.contains(complaint), "{told}");
        }
    }
}
