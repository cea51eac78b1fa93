//! MCAP with JSON messages of Foxglove: `/position`, `/pose` and `/log`, and on request the IMU in one of ours. Altitudes are over the ellipsoid; poses stand east, north
//! and up of the first place that is told, axes of the ship forward, left, up.
//!
//! Neither position nor pose is sent while nothing may be relied on, and no pose before the heading is found; `/log` says so when that
//! begins and when it ends.

use std::io::Write;

use insd_base::Time;
use insd_config::VoyageCalendar;
use insd_drivers::recording::NavRow;
use nalgebra::Vector3;
use serde_json::{Value, json};

use super::imu::{self, Reading, Readings};
use super::mcap_file::{Encoding, McapFile};
use super::pose::{ENU_NED, Plane};
use super::schemas::{IMU, LOCATION_FIX, LOG, POSE_IN_FRAME};
use super::stretch::{Stretch, stretches};
use super::track::{NoUtc, SolutionTrack, degrees, metres};

/// The covariance has a diagonal and nothing else: `DIAGONAL_KNOWN`.
const DIAGONAL: u8 = 2;
/// Levels of the journal.
const INFO: u8 = 2;
const WARNING: u8 = 3;

pub(super) fn write(track: &SolutionTrack<'_>, target: impl Write) -> anyhow::Result<()> {
    let calendar = track.calendar.ok_or(NoUtc)?;
    let mut journal = Journal { file: McapFile::new(target, Encoding::JSON)?, calendar };
    let [position, pose, log] = [
        journal.file.channel("/position", &LOCATION_FIX)?,
        journal.file.channel("/pose", &POSE_IN_FRAME)?,
        journal.file.channel("/log", &LOG)?,
    ];
    let mut imu = match track.imu {
        Some(_) => Some((journal.file.channel(imu::TOPIC, &IMU)?, Readings::of(track.imu))),
        None => None,
    };
    let first = stretches(track.rows).find(|stretch| stretch.is_told);
    let plane = first.map(|own| Plane::at(&own.rows[0].solution.position));
    for stretch in stretches(track.rows) {
        journal.catch_up(&mut imu, Some(stretch.rows[0].solution.time))?;
        journal.write(log, stretch.rows[0].solution.time, said(&stretch))?;
        let Some(plane) = plane.as_ref().filter(|_| stretch.is_told) else { continue };
        for row in stretch.rows {
            journal.catch_up(&mut imu, Some(row.solution.time))?;
            journal.write(position, row.solution.time, fix(row))?;
            if stretch.mode.is_navigating() {
                journal.write(pose, row.solution.time, stands(plane, row))?;
            }
        }
    }
    journal.catch_up(&mut imu, None)?;
    Ok(journal.file.finish()?)
}

/// A file with the calendar of its times.
struct Journal<W: Write> {
    file: McapFile<W>,
    calendar: VoyageCalendar,
}

impl<W: Write> Journal<W> {
    /// Tells what the IMU measured up to a time, or all that is left.
    fn catch_up(
        &mut self,
        imu: &mut Option<(u16, Readings<'_>)>,
        until: Option<Time>,
    ) -> anyhow::Result<()> {
        let Some((channel, readings)) = imu else { return Ok(()) };
        while let Some(own) = readings.next_until(until) {
            self.write(*channel, own.time, measured(&own))?;
        }
        Ok(())
    }

    /// Writes a message with its time.
    fn write(&mut self, channel: u16, time: Time, mut message: Value) -> anyhow::Result<()> {
        let nanos = u64::try_from(self.calendar.utc(time).as_nanos()).unwrap_or_default();
        message["timestamp"] =
            json!({ "sec": nanos / 1_000_000_000, "nsec": nanos % 1_000_000_000 });
        Ok(self.file.write(channel, nanos, &serde_json::to_vec(&message)?)?)
    }
}

fn fix(row: &NavRow) -> Value {
    let place = &row.solution.position;
    let [latitude, longitude] = degrees(place);
    let [east, north, up] =
        (ENU_NED.abs() * row.solution.sigma.position.0).map(|own| own * own).into();
    json!({
        "frame_id": "imu",
        "latitude": latitude,
        "longitude": longitude,
        "altitude": metres(place.height),
        "position_covariance": [east, 0.0, 0.0, 0.0, north, 0.0, 0.0, 0.0, up],
        "position_covariance_type": DIAGONAL,
    })
}

fn stands(plane: &Plane, row: &NavRow) -> Value {
    let position = plane.position(&row.solution.position);
    let turned = plane.orientation(&row.solution);
    json!({
        "frame_id": "map",
        "pose": {
            "position": { "x": position.x, "y": position.y, "z": position.z },
            "orientation": { "x": turned.i, "y": turned.j, "z": turned.k, "w": turned.w },
        },
    })
}

fn measured(own: &Reading) -> Value {
    let vector = |own: &Vector3<f64>| json!({ "x": own.x, "y": own.y, "z": own.z });
    json!({
        "frame_id": imu::FRAME,
        "angular_velocity": vector(&own.rate),
        "linear_acceleration": vector(&own.force),
    })
}

fn said(stretch: &Stretch<'_>) -> Value {
    let mode = stretch.mode.as_str();
    let (level, words) = match stretch.is_told {
        true => (INFO, format!("mode {mode}")),
        false => {
            (WARNING, format!("mode {mode}: the position may not be relied on and is not told"))
        }
    };
    json!({ "level": level, "message": words, "name": "insd", "file": "", "line": 0 })
}

#[cfg(test)]
mod tests {
    use super::super::stretch::tests::row;
    use super::*;
    use insd_base::Mode;

    #[test]
    fn a_position_has_its_digits_its_variances_and_no_more_is_known() {
        let told = fix(&row(0.1, 10.0, Mode::Aided));
        assert_eq!(told["latitude"], json!(54.123_456_789_1));
        let variances = json!([0.0625, 0.0, 0.0, 0.0, 0.25, 0.0, 0.0, 0.0, 1.0]);
        assert_eq!(told["position_covariance"], variances);
    }

    #[test]
    fn what_may_not_be_relied_on_is_a_warning_and_no_position() {
        let rows = [row(0.0, 10.0, Mode::Fault), row(0.1, 10.0, Mode::FineAlignment)];
        let calendar = VoyageCalendar::new("2026-05-01T08:00:00Z");
        let mut bytes = Vec::new();
        write(&SolutionTrack { name: "x", rows: &rows, calendar, imu: None }, &mut bytes).unwrap();
        let text = String::from_utf8_lossy(&bytes);
        // the schema, which stands there twice, names it, too
        let is_value = |(at, name): &(usize, &str)| {
            text[at + name.len()..].starts_with(|first: char| first.is_ascii_digit())
        };
        assert_eq!(text.match_indices("\"latitude\":").filter(is_value).count(), 1);
        assert_eq!(text.matches("may not be relied on").count(), 1);
        // the heading is not found yet
        assert!(!text.contains("\"orientation\":{\"w\""), "{text}");
        assert!(text.contains("\"timestamp\":{\"nsec\":100000000,\"sec\":1777622400}"), "{text}");
    }

    #[test]
    fn without_utc_nothing_is_written() {
        let rows = [row(0.0, 10.0, Mode::Aided)];
        let track = SolutionTrack { name: "x", rows: &rows, calendar: None, imu: None };
        assert!(write(&track, Vec::new()).unwrap_err().is::<NoUtc>());
    }
}
