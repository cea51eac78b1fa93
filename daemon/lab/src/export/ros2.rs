//! A bag of ROS 2 without ROS: `/fix` (`sensor_msgs/NavSatFix`) and `/odom` (`nav_msgs/Odometry`) in an MCAP file
//! with `metadata.yaml` beside it; on request `/imu/data_raw` (`sensor_msgs/Imu`).
//!
//! Axes are those of REP 103. Where nothing may be relied on `/fix` says `STATUS_NO_FIX` with numbers that are none (NaN), and no
//! odometry is sent, nor before the heading is found. Rates of turn are not told (NaN): `nav.csv` does not hold them.

use std::io::{self, Write};
use std::path::Path;

use insd_base::Time;
use insd_config::{OutputFile, VoyageCalendar};
use insd_drivers::recording::NavRow;
use nalgebra::{Matrix3, Vector3};

use super::cdr::Cdr;
use super::imu::{self, Reading, Readings};
use super::mcap_file::{Encoding, McapFile};
use super::pose::{ENU_NED, FRD_FLU, Plane};
use super::ros2_schemas::{IMU, NAV_SAT_FIX, ODOMETRY};
use super::schemas::Schema;
use super::stretch::stretches;
use super::track::{NoUtc, SolutionTrack, degrees, metres};

/// `sensor_msgs/NavSatStatus`: `STATUS_NO_FIX`, as a byte with its sign, and `STATUS_FIX`.
const NO_FIX: u8 = 0xFF;
const FIX: u8 = 0;
/// `COVARIANCE_TYPE_UNKNOWN` and `COVARIANCE_TYPE_DIAGONAL_KNOWN`.
const UNKNOWN: u8 = 0;
const DIAGONAL: u8 = 2;
const BAG: &str = "bag.mcap";

/// Writes the folder of a bag.
pub(super) fn write(track: &SolutionTrack<'_>, folder: &Path) -> anyhow::Result<()> {
    let calendar = track.calendar.ok_or(NoUtc)?;
    std::fs::create_dir_all(folder)?;
    let mut target = OutputFile::create(&folder.join(BAG))?;
    let (topics, span) = messages(track, calendar, &mut target)?;
    target.finish()?;
    let mut metadata = OutputFile::create(&folder.join("metadata.yaml"))?;
    metadata.write_all(described(&topics, span).as_bytes())?;
    metadata.finish()
}

/// What a bag has of a topic.
struct Topic {
    name: &'static str,
    schema: &'static Schema,
    count: u64,
}

/// Writes the messages; gives how many there are of each topic, and when the first and the last one is, ns.
fn messages(
    track: &SolutionTrack<'_>,
    calendar: VoyageCalendar,
    target: impl Write,
) -> io::Result<(Vec<Topic>, (u64, u64))> {
    let mut bag = Bag {
        file: McapFile::new(target, Encoding::ROS2)?,
        calendar,
        topics: Vec::new(),
        span: None,
    };
    let fix = bag.topic("/fix", &NAV_SAT_FIX)?;
    let odometry = bag.topic("/odom", &ODOMETRY)?;
    let mut imu = match track.imu {
        Some(_) => Some((bag.topic(imu::TOPIC, &IMU)?, Readings::of(track.imu))),
        None => None,
    };
    let first = stretches(track.rows).find(|stretch| stretch.is_told);
    let plane = first.map(|own| Plane::at(&own.rows[0].solution.position));
    for stretch in stretches(track.rows) {
        for row in stretch.rows {
            let time = row.solution.time;
            bag.catch_up(&mut imu, Some(time))?;
            bag.write(fix, time, |nanos| fixed(row, nanos, stretch.is_told))?;
            if let Some(plane) = &plane
                && stretch.is_told
                && stretch.mode.is_navigating()
            {
                bag.write(odometry, time, |nanos| moving(plane, row, nanos))?;
            }
        }
    }
    bag.catch_up(&mut imu, None)?;
    bag.file.finish()?;
    Ok((bag.topics, bag.span.unwrap_or_default()))
}

/// A bag in the making.
struct Bag<W: Write> {
    file: McapFile<W>,
    calendar: VoyageCalendar,
    topics: Vec<Topic>,
    /// First and last message, ns.
    span: Option<(u64, u64)>,
}

impl<W: Write> Bag<W> {
    /// Declares a topic, and gives its number.
    fn topic(&mut self, name: &'static str, schema: &'static Schema) -> io::Result<u16> {
        self.topics.push(Topic { name, schema, count: 0 });
        self.file.channel(name, schema)
    }

    fn write(
        &mut self,
        topic: u16,
        time: Time,
        message: impl FnOnce(u64) -> Vec<u8>,
    ) -> io::Result<()> {
        let nanos = nanos(self.calendar, time);
        let (first, last) = self.span.unwrap_or((nanos, nanos));
        self.span = Some((first.min(nanos), last.max(nanos)));
        // channels are numbered from 1
        if let Some(own) = self.topics.get_mut(usize::from(topic) - 1) {
            own.count += 1;
        }
        self.file.write(topic, nanos, &message(nanos))
    }

    /// Tells what the IMU measured up to a time, or all that is left.
    fn catch_up(
        &mut self,
        imu: &mut Option<(u16, Readings<'_>)>,
        until: Option<Time>,
    ) -> io::Result<()> {
        let Some((topic, readings)) = imu else { return Ok(()) };
        while let Some(own) = readings.next_until(until) {
            self.write(*topic, own.time, |nanos| measured(&own, nanos))?;
        }
        Ok(())
    }
}

fn nanos(calendar: VoyageCalendar, time: Time) -> u64 {
    u64::try_from(calendar.utc(time).as_nanos()).unwrap_or_default()
}

/// `std_msgs/Header`.
fn headed(nanos: u64, frame: &str) -> Cdr {
    let mut message = Cdr::new();
    message.u32((nanos / 1_000_000_000) as u32);
    message.u32((nanos % 1_000_000_000) as u32);
    message.text(frame);
    message
}

fn fixed(row: &NavRow, nanos: u64, is_told: bool) -> Vec<u8> {
    let (place, sigma) = (&row.solution.position, ENU_NED.abs() * row.solution.sigma.position.0);
    let known = |value: f64| if is_told { value } else { f64::NAN };
    let mut message = headed(nanos, "imu");
    message.byte(if is_told { FIX } else { NO_FIX });
    // what the position was made of is not said: no service
    message.u16(0);
    message.f64s(&degrees(place).map(known));
    message.f64(known(metres(place.height)));
    message.f64s(&Matrix3::from_diagonal(&sigma.component_mul(&sigma).map(known)));
    message.byte(if is_told { DIAGONAL } else { UNKNOWN });
    message.into_bytes()
}

fn moving(plane: &Plane, row: &NavRow, nanos: u64) -> Vec<u8> {
    let solution = &row.solution;
    let (position, turned) = (plane.position(&solution.position), plane.orientation(solution));
    let c_nb = solution.attitude.c_nb();
    let to_flu = FRD_FLU * c_nb.transpose();
    let mut message = headed(nanos, "map");
    message.text("base_link");
    message.f64s(&position);
    message.f64s(&[turned.i, turned.j, turned.k, turned.w]);
    let place = ENU_NED * squared(&solution.sigma.position.0) * ENU_NED.transpose();
    message.f64s(&both(&place, &turning(row)));
    message.f64s(&(to_flu * solution.velocity.0));
    message.f64s(&[f64::NAN; 3]);
    let velocity = to_flu * squared(&solution.sigma.velocity.0) * to_flu.transpose();
    message.f64s(&both(&velocity, &Matrix3::repeat(f64::NAN)));
    message.into_bytes()
}

/// `sensor_msgs/Imu`: no orientation, which its first covariance says with -1, and covariances that are not known, which are zero.
fn measured(own: &Reading, nanos: u64) -> Vec<u8> {
    let mut message = headed(nanos, imu::FRAME);
    message.f64s(&[0.0, 0.0, 0.0, 1.0]);
    message.f64s(&[-1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    message.f64s(&own.rate);
    message.f64s(&[0.0; 9]);
    message.f64s(&own.force);
    message.f64s(&[0.0; 9]);
    message.into_bytes()
}

fn squared(sigma: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::from_diagonal(&sigma.component_mul(sigma))
}

/// Covariance of small rotations about east, north and up, rad^2, of those of roll, pitch and heading.
fn turning(row: &NavRow) -> Matrix3<f64> {
    let sigma = &row.solution.sigma;
    let angles = squared(&Vector3::new(sigma.roll, sigma.pitch, sigma.heading));
    let of_ned = row.solution.attitude.jacobian_of_ned_rotation().try_inverse();
    let turned = ENU_NED * of_ned.unwrap_or_else(Matrix3::identity);
    turned * angles * turned.transpose()
}

/// Six rows of six: two covariances that know nothing of each other.
fn both(first: &Matrix3<f64>, second: &Matrix3<f64>) -> [f64; 36] {
    std::array::from_fn(|at| match (at / 6, at % 6) {
        (row @ 0..3, column @ 0..3) => first[(row, column)],
        (row @ 3.., column @ 3..) => second[(row - 3, column - 3)],
        _ => 0.0,
    })
}

/// `metadata.yaml` of rosbag2, version 5.
fn described(topics: &[Topic], (begin, end): (u64, u64)) -> String {
    let (span, all) = (end - begin, topics.iter().map(|topic| topic.count).sum::<u64>());
    let topic = |topic: &Topic| {
        format!(
            "    - topic_metadata:\n        name: {}\n        type: {}\n        serialization_format: cdr\n        \
             offered_qos_profiles: \"\"\n      message_count: {}\n",
            topic.name, topic.schema.name, topic.count
        )
    };
    let topics: String = topics.iter().map(topic).collect();
    format!(
        "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: mcap\n  duration:\n    nanoseconds: {span}\n  \
         starting_time:\n    nanoseconds_since_epoch: {begin}\n  message_count: {all}\n  topics_with_message_count:\n{topics}  \
         compression_format: \"\"\n  compression_mode: \"\"\n  relative_file_paths:\n    - {BAG}\n  files:\n    - path: {BAG}\n      \
         starting_time:\n        nanoseconds_since_epoch: {begin}\n      duration:\n        nanoseconds: {span}\n      \
         message_count: {all}\n"
    )
}
