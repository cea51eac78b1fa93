//! Docking aids: `[[ranging]]`, one for each head or anchor.

use insd_base::{Body, Ecef, Geodetic, RangingBeam, RangingLine, RangingTarget, earth};
use insd_intake::config::{Kind, SensorConfig};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::berth::{BerthSection, WaterHand};

/// Half of what an axis of a local position reference is taken to be long, m.
const AXIS: f64 = 100.0;
/// A line that is shorter has no direction, and one that is longer is not one, m.
const LENGTHS: std::ops::RangeInclusive<f64> = 1.0..=5000.0;

/// A docking aid: a head or an anchor that tells how far a point of the ship is from a line or a point ashore.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RangingSection {
    /// Its name.
    pub name: String,
    /// Name of the `[[sensor]]` of kind `ranging` or `rls` that tells its distances.
    pub sensor: String,
    /// Its number in what that sensor tells, 1 to 999.
    #[serde(default = "first")]
    pub head: u32,
    /// The point of the ship to which, or from which, is measured, from the IMU: forward, starboard, down, m.
    pub lever_m: [f64; 3],
    /// Name of the `[[berth]]` to the line of which it measures.
    pub berth: Option<String>,
    /// Two points of another line instead: latitude and longitude of each, deg.
    pub line_deg: Option<[[f64; 2]; 2]>,
    /// On which hand of that line the water is, looking from its first point to the second.
    #[serde(default)]
    pub water: WaterHand,
    /// A point ashore instead, to which the straight distance is measured: latitude, longitude, deg.
    pub point_deg: Option<[f64; 2]>,
    /// The origin of the axes of a local position reference instead, whose sensor is of kind `rls`: latitude, longitude, deg.
    pub origin_deg: Option<[f64; 2]>,
    /// Where its axis A points, clockwise from true north, deg; B points 90 deg further.
    #[serde(default)]
    pub axis_deg: f64,
    /// Height of that point above the ellipsoid, m.
    #[serde(default)]
    pub height_m: f64,
    /// How the distance to a line is measured.
    #[serde(default)]
    pub beam: RangingBeamKind,
    /// Of a head ashore that measures to her flat side: how far it is from the first point of the line, m.
    pub at_m: Option<f64>,
    /// Of a head aboard: where its beam points, clockwise from ahead, deg.
    pub direction_deg: Option<f64>,
    /// 1-sigma of one reading that states none, m.
    #[serde(default = "centimetres")]
    pub std_m: f64,
    /// How well it is known where line or point is, and the zero of the instrument, 1-sigma, m. Left out: that of the berth, or 0.1.
    pub survey_std_m: Option<f64>,
    /// The same of the height of a point, m.
    #[serde(default = "decimetres")]
    pub height_std_m: f64,
}

/// How the distance to a line is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RangingBeamKind {
    /// Across the line, to the point of the ship.
    #[default]
    Across,
    /// Across the line from a head ashore at `at_m`, to her flat side, on which the point is.
    Ashore,
    /// From the point of the ship along `direction_deg` to the upright face of the quay.
    Aboard,
}

fn first() -> u32 {
    1
}
fn centimetres() -> f64 {
    0.03
}
fn decimetres() -> f64 {
    0.2
}

impl RangingSection {
    fn berth<'a>(&self, berths: &'a [BerthSection]) -> Option<&'a BerthSection> {
        berths.iter().find(|berth| Some(&berth.name) == self.berth.as_ref())
    }

    fn survey(&self, berths: &[BerthSection]) -> f64 {
        let of_berth = self.berth(berths).map(|berth| berth.std_m);
        self.survey_std_m.or(of_berth).unwrap_or(0.1)
    }

    fn ends(&self, berths: &[BerthSection]) -> Option<([Geodetic; 2], WaterHand)> {
        let own = self.line_deg.map(|line| {
            let place = |[lat, lon]: [f64; 2]| Geodetic::from_degrees(lat, lon, 0.0);
            (line.map(place), self.water)
        });
        own.or_else(|| self.berth(berths).map(|berth| (berth.line(), berth.water)))
    }

    /// What it measures to; `None` where nothing is named.
    pub(crate) fn target(&self, berths: &[BerthSection]) -> Option<RangingTarget> {
        let std = self.survey(berths);
        if let Some([lat, lon]) = self.point_deg {
            let place = Geodetic::from_degrees(lat, lon, self.height_m);
            return Some(RangingTarget::Point { place, std: [std, self.height_std_m] });
        }
        let (ends, water) = self.ends(berths)?;
        let water_right = water == WaterHand::Right;
        Some(RangingTarget::Line(RangingLine { ends, water_right, std, beam: self.beam() }))
    }

    fn beam(&self) -> RangingBeam {
        match self.beam {
            RangingBeamKind::Across => RangingBeam::Across,
            RangingBeamKind::Ashore => RangingBeam::Ashore(self.at_m.unwrap_or(0.0)),
            RangingBeamKind::Aboard => {
                let (sin, cos) = self.direction_deg.unwrap_or(0.0).to_radians().sin_cos();
                RangingBeam::Aboard(Body::new(cos, sin, 0.0))
            }
        }
    }

    /// Whether it measures to the same line or point as another: both share what its survey is off by.
    pub(crate) fn shares_mark(&self, other: &RangingSection) -> bool {
        let place =
            |own: &RangingSection| (own.berth.clone(), own.line_deg, own.point_deg, own.origin_deg);
        place(self) == place(other)
    }

    /// Of a local position reference: across the axis B she is A metres, and across A she is B.
    pub(crate) fn axes(&self, berths: &[BerthSection]) -> Option<[RangingTarget; 2]> {
        let [lat, lon] = self.origin_deg?;
        let origin = Geodetic::from_degrees(lat, lon, 0.0);
        let (place, c_en) = (earth::ecef(&origin).0, earth::c_ne(&origin).transpose());
        let std = self.survey(berths);
        let line = |turn_deg: f64, water_right: bool| {
            let (sin, cos) = (self.axis_deg + turn_deg).to_radians().sin_cos();
            let ends = [-AXIS, AXIS].map(|along| {
                let way = c_en * Vector3::new(along * cos, along * sin, 0.0);
                earth::geodetic(&Ecef(place + way))
            });
            let beam = RangingBeam::Across;
            RangingTarget::Line(RangingLine { ends, water_right, std, beam })
        };
        Some([line(90.0, false), line(0.0, true)])
    }

    /// All that is wrong with it, in words.
    pub(crate) fn faults(&self, sensors: &[SensorConfig], berths: &[BerthSection]) -> Vec<String> {
        let mut faults = Vec::new();
        let mut expect = |good: bool, fault: &str| {
            if !good {
                faults.push(fault.to_owned());
            }
        };
        let of_kind = |own: &&SensorConfig| own.name == self.sensor;
        let sensor = sensors.iter().find(of_kind);
        let (kind, fault) = match self.origin_deg {
            Some(_) => (Kind::Rls, "sensor: expected the name of a [[sensor]] of kind \"rls\""),
            None => {
                (Kind::Ranging, "sensor: expected the name of a [[sensor]] of kind \"ranging\"")
            }
        };
        expect(sensor.is_some_and(|own| own.kind == kind), fault);
        expect((1..=999).contains(&self.head), "head: expected 1 to 999");
        let near = self.lever_m.iter().all(|length| length.abs() <= 1000.0);
        expect(near, "lever_m: expected [forward, starboard, down] in m, each within +-1000");
        let known = self.berth.is_none() || self.berth(berths).is_some();
        expect(known, "berth: expected the name of a [[berth]]");
        let named = [
            self.berth.is_some(),
            self.line_deg.is_some(),
            self.point_deg.is_some(),
            self.origin_deg.is_some(),
        ];
        let one = named.iter().filter(|own| **own).count() == 1;
        expect(one, "line_deg: expected this, berth, point_deg or origin_deg, and one of them");
        self.places(berths, &mut expect);
        self.numbers(&mut expect);
        faults
    }

    fn places(&self, berths: &[BerthSection], expect: &mut impl FnMut(bool, &str)) {
        let on_earth = |[lat, lon]: [f64; 2]| lat.abs() <= 90.0 && lon.abs() <= 180.0;
        let sound = self.line_deg.iter().flatten().all(|point| on_earth(*point));
        expect(sound, "line_deg: expected two of [latitude, longitude], -90 to 90 and -180 to 180");
        let sound = self.origin_deg.is_none_or(on_earth);
        expect(sound, "origin_deg: expected [latitude, longitude], -90 to 90 and -180 to 180");
        let sound = self.point_deg.is_none_or(on_earth);
        expect(sound, "point_deg: expected [latitude, longitude], -90 to 90 and -180 to 180");
        let length = self.ends(berths).map(|(ends, _)| {
            let [from, to] = ends.map(|end| earth::ecef(&end).0);
            (to - from).norm()
        });
        let sound = self.line_deg.is_none() || length.is_none_or(|own| LENGTHS.contains(&own));
        expect(sound, "line_deg: expected two points that are 1 to 5000 m apart");
        let is_ashore = self.beam == RangingBeamKind::Ashore;
        expect(
            is_ashore == self.at_m.is_some(),
            "at_m: expected with beam = \"ashore\", and only there",
        );
        let on_line = |at: f64| length.is_none_or(|length| (0.0..=length).contains(&at));
        expect(self.at_m.is_none_or(on_line), "at_m: expected a place on the line");
    }

    fn numbers(&self, expect: &mut impl FnMut(bool, &str)) {
        let is_aboard = self.beam == RangingBeamKind::Aboard;
        expect(
            is_aboard == self.direction_deg.is_some(),
            "direction_deg: expected with beam = \"aboard\", and only there",
        );
        let turn = self.direction_deg.is_none_or(|own| own.abs() <= 360.0);
        expect(turn, "direction_deg: expected -360 to 360");
        let turn =
            self.axis_deg.abs() <= 360.0 && (self.axis_deg == 0.0 || self.origin_deg.is_some());
        expect(turn, "axis_deg: expected -360 to 360 with origin_deg, and only there");
        let straight = self.point_deg.is_none() && self.origin_deg.is_none();
        let across = self.beam == RangingBeamKind::Across;
        expect(straight || across, "beam: expected none to a point or between axes");
        let height = (-1000.0..=9000.0).contains(&self.height_m);
        expect(height, "height_m: expected -1000 to 9000");
        let sigma = |value: f64| (0.001..=100.0).contains(&value);
        expect(sigma(self.std_m), "std_m: expected 0.001 to 100");
        let survey = self.survey_std_m.is_none_or(sigma);
        expect(survey, "survey_std_m: expected 0.001 to 100");
        expect(sigma(self.height_std_m), "height_std_m: expected 0.001 to 100");
    }
}
