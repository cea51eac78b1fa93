//! Where the ship has been, in bounded memory.

use std::collections::VecDeque;

use axum::body::Bytes;
use serde::Serialize;

use crate::snapshot::Snapshot;

use super::frame::json;
use super::history::BACK;

/// Most points: five and a half hours under way, days at the berth.
const POINTS: usize = 4000;
/// Least time between two points, s.
const SOON: f64 = 5.0;
/// Time after which there is a point even if the ship does not move, s.
const LATE: f64 = 60.0;
/// Least way between two points, m.
const STEP: f64 = 2.0;
/// Mean radius of the Earth, m.
const RADIUS: f64 = 6_371_000.0;

/// The track.
#[derive(Debug, Default)]
pub(super) struct Track {
    points: VecDeque<Point>,
    json: Option<Bytes>,
}

#[derive(Clone, Copy, Debug)]
struct Point {
    at: f64,
    lat: f64,
    lon: f64,
}

/// As it leaves: one list for each column.
#[derive(Serialize)]
struct Columns {
    version: u32,
    at_s: Vec<f64>,
    lat_deg: Vec<f64>,
    lon_deg: Vec<f64>,
}

impl Track {
    /// Takes note of a snapshot, if the ship has moved or time has gone.
    pub(super) fn note(&mut self, snapshot: &Snapshot) {
        let place = snapshot.present().and_then(|motion| motion.lat_deg.zip(motion.lon_deg));
        let Some((lat, lon)) = place.filter(|(lat, lon)| lat.is_finite() && lon.is_finite()) else {
            return;
        };
        let point = Point { at: snapshot.time.at_s, lat, lon };
        if self.points.back().is_none_or(|last| is_due(last, &point)) {
            if self.points.len() == POINTS {
                self.points.pop_front();
            }
            self.points.push_back(point);
            self.json = None;
        }
    }

    /// All points as JSON, the oldest first.
    pub(super) fn json(&mut self) -> Bytes {
        let points = &self.points;
        let column = |of: fn(&Point) -> f64, unit: f64| -> Vec<f64> {
            points.iter().map(|point| (of(point) * unit).round() / unit).collect()
        };
        let make = || {
            let columns = Columns {
                version: crate::snapshot::VERSION,
                at_s: column(|point| point.at, 10.0),
                lat_deg: column(|point| point.lat, 1e7),
                lon_deg: column(|point| point.lon, 1e7),
            };
            Bytes::from(json(&columns))
        };
        self.json.get_or_insert_with(make).clone()
    }
}

/// Time that goes back is that of another start: it counts as gone.
fn is_due(last: &Point, next: &Point) -> bool {
    let passed = next.at - last.at;
    !(BACK..LATE).contains(&passed) || (passed >= SOON && way(last, next) >= STEP)
}

/// Way between two points close by, m, as if the Earth were flat there.
fn way(from: &Point, to: &Point) -> f64 {
    let east = (to.lon - from.lon + 540.0).rem_euclid(360.0) - 180.0;
    let north = (to.lat - from.lat).to_radians();
    RADIUS * north.hypot(east.to_radians() * to.lat.to_radians().cos())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::snapshot::ShownMotion;

    fn at(seconds: f64, lon: f64) -> Snapshot {
        let motion =
            ShownMotion { lat_deg: Some(0.0), lon_deg: Some(lon), ..ShownMotion::default() };
        let mut snapshot = Snapshot { motion: Some(motion), ..Snapshot::default() };
        snapshot.time.at_s = seconds;
        snapshot
    }

    #[test]
    fn a_ship_at_her_berth_leaves_a_point_a_minute_and_one_under_way_every_five_seconds() {
        let (mut moored, mut sailing) = (Track::default(), Track::default());
        for tick in 0..1200 {
            let seconds = f64::from(tick) * 0.1;
            moored.note(&at(seconds, 0.0));
            sailing.note(&at(seconds, seconds * 1e-4));
        }
        assert_eq!((moored.points.len(), sailing.points.len()), (2, 24));
    }

    #[test]
    fn the_oldest_points_give_way() {
        let mut track = Track::default();
        for tick in 0..5000 {
            track.note(&at(f64::from(tick) * 10.0, f64::from(tick) * 1e-3));
        }
        assert_eq!(track.points.len(), POINTS);
        assert_eq!(track.points.front().unwrap().at, 10_000.0);
        let json: serde_json::Value = serde_json::from_slice(&track.json()).unwrap();
        assert_eq!(json["lon_deg"].as_array().unwrap().len(), POINTS);
    }

    #[test]
    fn the_antimeridian_is_no_leap() {
        let (west, east) = (Point { at: 0.0, lat: 0.0, lon: 179.999_99 }, -179.999_99);
        assert!(way(&west, &Point { lon: east, ..west }) < 3.0);
    }
}
