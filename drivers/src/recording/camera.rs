//! What a camera has seen on a voyage: `features.csv`, points of images.

use std::path::Path;

use insd_base::{CameraFrame, ImagePoint, Time};
use nalgebra::Vector2;

use super::ahead::Ahead;
use super::error::RecordingError;
use super::fields::Fields;
use super::report::{BadRow, FileReport, RowFault};
use super::table::Row;

/// An image of more points than this is cut: a file whose time stands still is no image.
const MOST_POINTS: usize = 4096;

/// Head of `features.csv`.
pub const FEATURES_HEAD: &str = "t_s,id,u_px,v_px";

/// Rows of `features.csv` for one image: seconds to 3 decimals, pixels to 2.
#[must_use]
pub fn feature_rows(frame: &CameraFrame) -> String {
    let t = frame.time.as_seconds();
    let row = |p: &ImagePoint| format!("{t:.3},{},{:.2},{:.2}\n", p.track, p.at.x, p.at.y);
    frame.points.iter().map(row).collect()
}

/// A point of an image.
struct PointRow {
    time: Time,
    point: ImagePoint,
}

impl Row for PointRow {
    const COLUMNS: &'static [&'static str] = &["t_s", "id", "u_px", "v_px"];
    const OPTIONAL: &'static [&'static [&'static str]] = &[];

    fn parse(fields: &Fields<'_>) -> Result<Self, BadRow> {
        let time = fields.time(0)?;
        let track = whole(fields, 1)?;
        let at = Vector2::new(fields.required(2)?, fields.required(3)?);
        Ok(PointRow { time, point: ImagePoint { track, at } })
    }

    fn time(&self) -> Time {
        self.time
    }
}

/// A whole number that is not negative.
pub(super) fn whole(fields: &Fields<'_>, column: usize) -> Result<u64, BadRow> {
    let value = fields.required(column)?;
    let is_whole = value >= 0.0 && value.fract() == 0.0 && value < 9e15;
    if is_whole { Ok(value as u64) } else { Err(fields.bad(column, RowFault::OutOfRange)) }
}

/// The images of a voyage, one after another, in constant memory.
pub struct ImageReader(Ahead<PointRow>);

impl ImageReader {
    /// Opens `features.csv`, plain or compressed; `None` where there is none.
    ///
    /// # Errors
    /// It cannot be read, or lacks a column.
    pub fn open(dir: &Path) -> Result<Option<Self>, RecordingError> {
        Ok(Ahead::open(dir, "features.csv")?.map(ImageReader))
    }

    /// When the next image was taken.
    #[must_use]
    pub fn time(&self) -> Option<Time> {
        self.0.time()
    }

    /// The next image: rows of one time in a row.
    ///
    /// # Errors
    /// The file cannot be read on, or most of it is faulty.
    pub fn next_frame(&mut self) -> Result<Option<CameraFrame>, RecordingError> {
        let Some(first) = self.0.take()? else { return Ok(None) };
        let mut frame = CameraFrame { time: first.time, points: vec![first.point] };
        while self.0.time() == Some(frame.time) {
            let point = self.0.take()?.map(|row| row.point);
            frame.points.extend(point.filter(|_| frame.points.len() < MOST_POINTS));
        }
        Ok(Some(frame))
    }

    /// What was read and skipped so far.
    #[must_use]
    pub fn report(&self) -> &FileReport {
        self.0.report()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_one_time_are_an_image_and_a_bad_one_is_told_with_its_place() {
        let desk = tempfile::tempdir().unwrap();
        let text = "t_s,id,u_px,v_px\n1.0,7,10.5,20.5\n1.0,8,30,wet\n1.0,9,50,60\n1.5,7,11,21\n";
        std::fs::write(desk.path().join("features.csv"), text).unwrap();
        let mut reader = ImageReader::open(desk.path()).unwrap().unwrap();
        let frame = reader.next_frame().unwrap().unwrap();
        let tracks: Vec<u64> = frame.points.iter().map(|point| point.track).collect();
        assert_eq!((frame.time, tracks), (Time::from_seconds(1.0), vec![7, 9]));
        assert_eq!(reader.time(), Some(Time::from_seconds(1.5)));
        assert_eq!(reader.next_frame().unwrap().unwrap().points.len(), 1);
        assert_eq!(reader.next_frame().unwrap(), None);
        let report = reader.report();
        let told = report.examples[0].to_string();
        assert!(report.file == "features.csv" && told.starts_with("3:"), "{told}");
        assert!(told.contains("v_px"), "{told}");
    }
}
