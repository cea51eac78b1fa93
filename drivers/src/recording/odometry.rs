//! What a visual odometry has told on a voyage: `vo.csv`, steps from keyframe to keyframe.

use std::path::Path;

use insd_base::{Time, VisualOdometry};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::ahead::Ahead;
use super::camera::whole;
use super::error::RecordingError;
use super::fields::Fields;
use super::report::{BadRow, FileReport, RowFault};
use super::table::Row;

/// By how much a quaternion of rounded numbers is other than of length one.
const ROUNDED: f64 = 1e-3;

struct StepRow(VisualOdometry);

impl Row for StepRow {
    const COLUMNS: &'static [&'static str] = &[
        "t_s",
        "t_prev_s",
        "map",
        "qw",
        "qx",
        "qy",
        "qz",
        "tx",
        "ty",
        "tz",
        "std_rot_rad",
        "std_trans",
    ];
    const OPTIONAL: &'static [&'static [&'static str]] = &[];

    fn parse(fields: &Fields<'_>) -> Result<Self, BadRow> {
        let (time, since) = (fields.time(0)?, fields.time(1)?);
        if since >= time {
            return Err(fields.bad(1, RowFault::OutOfRange));
        }
        let map = whole(fields, 2)?;
        let map = u32::try_from(map).map_err(|_| fields.bad(2, RowFault::OutOfRange))?;
        let q = (fields.required(3)?, three(fields, 4)?);
        let q = Quaternion::from_parts(q.0, q.1);
        if (q.norm() - 1.0).abs() > ROUNDED {
            return Err(fields.bad(3, RowFault::OutOfRange));
        }
        let step = VisualOdometry {
            time,
            since,
            map,
            rotation: UnitQuaternion::from_quaternion(q),
            translation: three(fields, 7)?,
            rotation_std: fields.required(10)?,
            translation_std: fields.required(11)?,
        };
        Ok(StepRow(step))
    }

    fn time(&self) -> Time {
        self.0.time
    }
}

fn three(fields: &Fields<'_>, first: usize) -> Result<Vector3<f64>, BadRow> {
    Ok(Vector3::new(
        fields.required(first)?,
        fields.required(first + 1)?,
        fields.required(first + 2)?,
    ))
}

/// The steps of a voyage, one after another, in constant memory.
pub struct StepReader(Ahead<StepRow>);

impl StepReader {
    /// Opens `vo.csv`, plain or compressed; `None` where there is none.
    ///
    /// # Errors
    /// It cannot be read, or lacks a column.
    pub fn open(dir: &Path) -> Result<Option<Self>, RecordingError> {
        Ok(Ahead::open(dir, "vo.csv")?.map(StepReader))
    }

    /// The end of the next step.
    #[must_use]
    pub fn time(&self) -> Option<Time> {
        self.0.time()
    }

    /// The next step.
    ///
    /// # Errors
    /// The file cannot be read on, or most of it is faulty.
    pub fn next_step(&mut self) -> Result<Option<VisualOdometry>, RecordingError> {
        Ok(self.0.take()?.map(|StepRow(step)| step))
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
    fn each_row_is_a_step_and_a_bad_one_is_told_with_its_place() {
        let desk = tempfile::tempdir().unwrap();
        let text = "t_s,t_prev_s,keyframe,map,qw,qx,qy,qz,tx,ty,tz,std_rot_rad,std_trans\n\
            1.0,0.5,1,0,0.8,0.0,0.6,0.0,0.7,-0.1,0.2,0.0003,0.02\n\
            1.5,1.0,2,0,2.0,0.0,0.6,0.0,0.7,-0.1,0.2,0.0003,0.02\n\
            2.0,2.0,3,0,1.0,0.0,0.0,0.0,0.7,-0.1,0.2,0.0003,0.02\n\
            2.5,2.0,4,1,1.0,0.0,0.0,0.0,0.7,-0.1,0.2,0.0003,0.02\n";
        std::fs::write(desk.path().join("vo.csv"), text).unwrap();
        let mut reader = StepReader::open(desk.path()).unwrap().unwrap();
        assert_eq!(reader.time(), Some(Time::from_seconds(1.0)));
        let step = reader.next_step().unwrap().unwrap();
        assert_eq!((step.since, step.map), (Time::from_seconds(0.5), 0));
        assert!((step.rotation.j - 0.6).abs() < 1e-12 && step.translation.y == -0.1);
        let step = reader.next_step().unwrap().unwrap();
        assert_eq!((step.time, step.map), (Time::from_seconds(2.5), 1));
        assert_eq!(reader.next_step().unwrap(), None);
        let told: Vec<String> = reader.report().examples.iter().map(ToString::to_string).collect();
        assert!(told[0].contains("qw") && told[1].contains("t_prev_s"), "{told:?}");
    }
}
