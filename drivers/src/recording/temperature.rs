//! The temperature of an IMU on a voyage: `temperature.csv`.

use std::path::Path;

use insd_base::Time;

use super::ahead::Ahead;
use super::error::RecordingError;
use super::fields::Fields;
use super::report::{BadRow, FileReport};
use super::table::Row;

/// Temperature at an instant.
struct TemperatureRow {
    time: Time,
    celsius: f64,
}

impl Row for TemperatureRow {
    const COLUMNS: &'static [&'static str] = &["t_s", "imu_c"];
    const OPTIONAL: &'static [&'static [&'static str]] = &[];

    fn parse(fields: &Fields<'_>) -> Result<Self, BadRow> {
        Ok(TemperatureRow { time: fields.time(0)?, celsius: fields.required(1)? })
    }

    fn time(&self) -> Time {
        self.time
    }
}

/// The temperatures of a voyage, one after another, in constant memory.
pub struct TemperatureReader(Ahead<TemperatureRow>);

impl TemperatureReader {
    /// Opens `temperature.csv`, plain or compressed; `None` where there is none.
    ///
    /// # Errors
    /// It cannot be read, or lacks a column.
    pub fn open(dir: &Path) -> Result<Option<Self>, RecordingError> {
        Ok(Ahead::open(dir, "temperature.csv")?.map(TemperatureReader))
    }

    /// The newest temperature up to an instant that was not told yet, degrees Celsius.
    ///
    /// # Errors
    /// The file cannot be read on, or most of it is faulty.
    pub fn until(&mut self, now: Time) -> Result<Option<(Time, f64)>, RecordingError> {
        let mut newest = None;
        while self.0.time().is_some_and(|time| time <= now) {
            newest = self.0.take()?.map(|row| (row.time, row.celsius));
        }
        Ok(newest)
    }

    /// What was read and skipped so far.
    #[must_use]
    pub fn report(&self) -> &FileReport {
        self.0.report()
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn of_the_temperatures_up_to_an_instant_the_newest_is_told_once() {
        let desk = tempfile::tempdir().unwrap();
        assert!(TemperatureReader::open(desk.path()).unwrap().is_none());
        let text = "t_s,imu_c\n0.0,27.5\n1.0,27.6\n2.0,27.8\n";
        fs::write(desk.path().join("temperature.csv"), text).unwrap();
        let mut own = TemperatureReader::open(desk.path()).unwrap().unwrap();
        let at = Time::from_seconds;
        assert_eq!(own.until(at(1.5)).unwrap(), Some((at(1.0), 27.6)));
        assert_eq!(own.until(at(1.6)).unwrap(), None);
        assert_eq!(own.until(at(9.0)).unwrap(), Some((at(2.0), 27.8)));
        assert_eq!(own.report().lines, 4);
    }
}
