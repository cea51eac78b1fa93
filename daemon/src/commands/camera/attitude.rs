//! The attitude of the ship at any instant, from a table.

use std::path::Path;

use insd_base::{Attitude, Time};
use insd_config::BadInput;
use insd_vision::{CameraAttitude, Hints};
use nalgebra::Rotation3;

/// Attitudes of the camera, in the order of time.
#[derive(Debug, Default)]
pub(super) struct Attitudes {
    rows: Vec<(Time, CameraAttitude)>,
}

/// Columns that are read.
const COLUMNS: [&str; 4] = ["t_s", "roll_deg", "pitch_deg", "heading_deg"];
/// Rows that are farther apart say nothing of what was between them, s.
const LONGEST_GAP: f64 = 1.0;

impl Attitudes {
    /// Reads a table.
    pub(super) fn read(path: &Path, c_bc: &Rotation3<f64>) -> anyhow::Result<Self> {
        let mut reader = csv::Reader::from_path(path)?;
        let head = reader.headers()?.clone();
        let wrong = |what: String| BadInput(format!("{}: {what}", path.display()));
        let mut columns = [0; 4];
        for (column, name) in columns.iter_mut().zip(COLUMNS) {
            let found = head.iter().position(|own| own.trim() == name);
            *column = found.ok_or_else(|| wrong(format!("has no column {name}")))?;
        }
        let mut rows = Vec::new();
        for (index, row) in reader.records().enumerate() {
            let row = row?;
            let number = |i: usize| {
                row.get(columns[i])?.trim().parse::<f64>().ok().filter(|n| n.is_finite())
            };
            let [Some(t), Some(roll), Some(pitch), Some(heading)] = [0, 1, 2, 3].map(number) else {
                return Err(wrong(format!(
                    "row {}: wants numbers in {}",
                    index + 1,
                    COLUMNS.join(", ")
                ))
                .into());
            };
            let [roll, pitch, heading] = [roll, pitch, heading].map(f64::to_radians);
            let ship = Attitude { roll, pitch, heading };
            rows.push((Time::from_seconds(t), CameraAttitude::new(&ship, c_bc)));
        }
        rows.sort_by_key(|(time, _)| *time);
        Ok(Attitudes { rows })
    }

    /// At an instant, between two rows that are near enough.
    fn at(&self, time: Time) -> Option<CameraAttitude> {
        let later = self.rows.partition_point(|(t, _)| *t < time);
        let (after, attitude) = self.rows.get(later)?;
        if *after == time {
            return Some(*attitude);
        }
        let (before, earlier) = self.rows.get(later.checked_sub(1)?)?;
        let gap = (*after - *before).as_seconds();
        (gap <= LONGEST_GAP).then(|| earlier.towards(attitude, (time - *before).as_seconds() / gap))
    }

    /// What is known for an image, of which the one before was at `since`.
    pub(super) fn hints(&self, now: Time, since: Option<Time>) -> Hints {
        let attitude = self.at(now);
        let earlier = since.and_then(|since| self.at(since));
        let rotation = attitude.zip(earlier).map(|(now, earlier)| now.since(&earlier));
        Hints { rotation, down: attitude.map(|attitude| attitude.down()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(table: &str) -> anyhow::Result<Attitudes> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("nav.csv");
        std::fs::write(&path, table).unwrap();
        Attitudes::read(&path, &Rotation3::identity())
    }

    #[test]
    fn attitudes_between_rows_are_between_them() {
        let attitudes = read(
            "t_s,heading_deg,pitch_deg,roll_deg,mode\n1.0,350,0,0,a\n1.1,10,0,0,a\n9,0,0,0,a\n",
        )
        .unwrap();
        let hints = attitudes.hints(Time::from_seconds(1.05), Some(Time::from_seconds(1.0)));
        assert!((hints.rotation.unwrap().angle().to_degrees() - 10.0).abs() < 1e-6);
        assert!((hints.down.unwrap().z - 1.0).abs() < 1e-12);
        assert!(attitudes.hints(Time::from_seconds(5.0), None).down.is_none());
        assert!(attitudes.hints(Time::from_seconds(0.5), None).down.is_none());
    }

    #[test]
    fn a_table_without_a_heading_is_told() {
        let told = read("t_s,roll_deg,pitch_deg\n1,2,3\n").unwrap_err().to_string();
        assert!(told.ends_with("nav.csv: has no column heading_deg"), "{told}");
        let told = read("t_s,roll_deg,pitch_deg,heading_deg\n1,2,3,\n").unwrap_err().to_string();
        assert!(told.contains("row 1: wants numbers"), "{told}");
    }
}
