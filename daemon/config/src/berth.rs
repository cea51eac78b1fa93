//! Berths, and the ship that goes alongside: `[[berth]]` and `[docking]`.

use insd_base::{Body, Geodetic};
use insd_output::docking::{Fender, Quay, WaterSide};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::output::PointSection;

/// A line that is shorter has no direction, m.
const SHORTEST: f64 = 1.0;
/// One that is longer is no berth, m.
const LONGEST: f64 = 5000.0;
/// A fender that stands further off is none, m.
const FURTHEST: f64 = 30.0;

/// A berth to go alongside.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BerthSection {
    /// Its name.
    pub name: String,
    /// One point of the edge of the quay: latitude, longitude, deg.
    pub from_deg: [f64; 2],
    /// Another point of it: latitude, longitude, deg.
    pub to_deg: [f64; 2],
    /// On which hand the water is, looking from the first point to the second.
    #[serde(default)]
    pub water: WaterHand,
    /// How far the face of the fenders is before the edge, all along the quay, m.
    #[serde(default)]
    pub fender_m: f64,
    /// Fenders one by one, where they differ: how far from the first point, and how far before the edge, m.
    #[serde(default)]
    pub fenders_m: Vec<[f64; 2]>,
    /// Bollards: how far from the first point, m.
    #[serde(default)]
    pub bollards_m: Vec<f64>,
    /// Height of the edge above the ellipsoid, m. With it the height of the manifold above the quay is told.
    pub height_m: Option<f64>,
    /// How well line, fenders and the points of the ship are known across the line, 1-sigma, m.
    #[serde(default = "tenth")]
    pub std_m: f64,
}

/// On which hand the water is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WaterHand {
    /// To the right.
    #[default]
    Right,
    /// To the left.
    Left,
}

/// The ship that goes alongside, and when to be warned.
#[derive(Clone, Debug, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DockingSection {
    /// Name of the `[[point]]` at which her side begins forward, at the height of the fenders.
    pub bow: Option<String>,
    /// Name of the `[[point]]` at which it ends aft.
    pub stern: Option<String>,
    /// Name of the `[[point]]` of the manifold, or of whatever else is to come to its place.
    pub manifold: Option<String>,
    /// Her beam, m: she is taken as a rectangle from bow to stern. Without it and without an outline the points are those of her side.
    pub beam_m: Option<f64>,
    /// Corners of her outline at the height of the fenders from the IMU: forward, starboard, m.
    pub outline_m: Vec<[f64; 2]>,
    /// Name of the `[[berth]]` that is chosen at the start; left out: the nearest is proposed.
    pub berth: Option<String>,
    /// Speed of the first contact that is warned of, m/s.
    pub contact_speed_mps: Option<f64>,
    /// Distance at which it is warned of a part that still comes nearer, m.
    pub distance_m: Option<f64>,
    /// Protection level of a distance beyond which all is called doubtful, m.
    pub alert_limit_m: Option<f64>,
}

fn tenth() -> f64 {
    0.1
}

impl BerthSection {
    /// The two points of its line, at its height.
    pub(crate) fn line(&self) -> [Geodetic; 2] {
        let height = self.height_m.unwrap_or(0.0);
        [self.from_deg, self.to_deg].map(|[lat, lon]| Geodetic::from_degrees(lat, lon, height))
    }

    /// What goes alongside is told of it.
    #[must_use]
    pub fn quay(&self) -> Quay {
        let fender = |[at, off]: &[f64; 2]| Fender { at: *at, off: *off };
        let all_along = vec![Fender { at: 0.0, off: self.fender_m }];
        let own: Vec<Fender> = self.fenders_m.iter().map(fender).collect();
        Quay {
            name: self.name.clone(),
            line: self.line(),
            water: match self.water {
                WaterHand::Right => WaterSide::Right,
                WaterHand::Left => WaterSide::Left,
            },
            fenders: if own.is_empty() { all_along } else { own },
            bollards: self.bollards_m.clone(),
            height: self.height_m,
            sigma: self.std_m,
        }
    }

    /// All that is wrong with it, in words.
    pub(crate) fn faults(&self) -> Vec<String> {
        let mut faults = Vec::new();
        let mut expect = |good: bool, fault: String| {
            if !good {
                faults.push(fault);
            }
        };
        expect(!self.name.is_empty(), "name: expected a name".to_owned());
        let on_earth = |[lat, lon]: [f64; 2]| lat.abs() <= 90.0 && lon.abs() <= 180.0;
        for (key, point) in [("from_deg", self.from_deg), ("to_deg", self.to_deg)] {
            let text = "expected [latitude, longitude], -90 to 90 and -180 to 180";
            expect(on_earth(point), format!("{key}: {text}"));
        }
        let length = self.quay().length();
        if on_earth(self.from_deg) && on_earth(self.to_deg) {
            let text =
                format!("to_deg: expected another point than from_deg, {SHORTEST} m away or more");
            expect(length >= SHORTEST, text);
            let text = format!(
                "to_deg: expected the other end of the quay, within {LONGEST} m of from_deg, which is {length:.0} m away"
            );
            expect(length <= LONGEST, text);
        }
        let off = |value: f64| (0.0..=FURTHEST).contains(&value);
        expect(off(self.fender_m), format!("fender_m: expected 0 to {FURTHEST}"));
        let both = self.fender_m != 0.0 && !self.fenders_m.is_empty();
        expect(!both, "fenders_m: expected either fender_m or fenders_m".to_owned());
        let on_quay = |at: f64| (0.0..=length.max(SHORTEST)).contains(&at);
        let sound = self.fenders_m.iter().all(|[at, before]| on_quay(*at) && off(*before));
        let text = format!(
            "fenders_m: expected [from the first point, before the edge], 0 to {length:.0} and 0 to {FURTHEST}"
        );
        expect(sound, text);
        let rising = self.fenders_m.is_sorted_by(|one, other| one[0] < other[0]);
        expect(rising, "fenders_m: expected them in rising order along the quay".to_owned());
        let sound = self.bollards_m.iter().all(|at| on_quay(*at));
        expect(sound, format!("bollards_m: expected each from 0 to {length:.0}"));
        let sound = self.height_m.is_none_or(|height| (-1000.0..=9000.0).contains(&height));
        expect(sound, "height_m: expected -1000 to 9000".to_owned());
        expect((0.0..=100.0).contains(&self.std_m), "std_m: expected 0 to 100".to_owned());
        faults
    }
}

impl DockingSection {
    fn named(&self) -> [(&'static str, Option<&String>); 3] {
        [
            ("bow", self.bow.as_ref()),
            ("stern", self.stern.as_ref()),
            ("manifold", self.manifold.as_ref()),
        ]
    }

    /// The outline; that of a beam goes from bow to stern.
    pub(crate) fn outline(&self, bow: &Body, stern: &Body) -> Vec<[f64; 2]> {
        let Some(beam) = self.beam_m else { return self.outline_m.clone() };
        let (fore, aft, half) = (bow.0.x, stern.0.x, beam / 2.0);
        let (middle_fore, middle_aft) = (bow.0.y, stern.0.y);
        vec![
            [fore, middle_fore - half],
            [fore, middle_fore + half],
            [aft, middle_aft + half],
            [aft, middle_aft - half],
        ]
    }

    /// Where a point of this name is from the IMU.
    pub(crate) fn lever(points: &[PointSection], name: Option<&String>) -> Option<Body> {
        let name = name?;
        points.iter().find(|point| point.name == *name).map(PointSection::lever)
    }

    /// Bow and stern from the IMU, if both are told.
    pub(crate) fn ends(&self, points: &[PointSection]) -> Option<(Body, Body)> {
        let lever = |name: &Option<String>| Self::lever(points, name.as_ref());
        lever(&self.bow).zip(lever(&self.stern))
    }

    /// All that is wrong with it, in words; a bow and a stern are needed where there are berths.
    pub(crate) fn faults(&self, points: &[PointSection], berths: &[BerthSection]) -> Vec<String> {
        let mut faults = Vec::new();
        let mut expect = |good: bool, fault: &str| {
            if !good {
                faults.push(fault.to_owned());
            }
        };
        for (key, name) in self.named() {
            let known = name.is_none_or(|name| points.iter().any(|point| point.name == *name));
            expect(known, &format!("{key}: expected the name of a [[point]]"));
            let needed = key != "manifold" && !berths.is_empty();
            expect(
                name.is_some() || !needed,
                &format!("{key}: expected the name of a [[point]], as there is a [[berth]]"),
            );
        }
        if let Some((bow, stern)) = self.ends(points) {
            expect(bow.0.x > stern.0.x, "bow: expected a [[point]] that is ahead of that of stern");
        }
        let beam = self.beam_m.is_none_or(|beam| (0.5..=100.0).contains(&beam));
        expect(beam, "beam_m: expected 0.5 to 100");
        let both = self.beam_m.is_some() && !self.outline_m.is_empty();
        expect(!both, "outline_m: expected either beam_m or outline_m");
        let closed = self.outline_m.is_empty() || self.outline_m.len() >= 3;
        expect(closed, "outline_m: expected three corners or more");
        let near = self.outline_m.iter().flatten().all(|part| part.abs() <= 1000.0);
        expect(near, "outline_m: expected [forward, starboard] in m, each within +-1000");
        let known = |name: &String| berths.iter().any(|berth| berth.name == *name);
        expect(self.berth.as_ref().is_none_or(known), "berth: expected the name of a [[berth]]");
        for (key, value, most) in [
            ("contact_speed_mps", self.contact_speed_mps, 10.0),
            ("distance_m", self.distance_m, 1000.0),
            ("alert_limit_m", self.alert_limit_m, 1000.0),
        ] {
            let good = value.is_none_or(|value| value > 0.0 && value <= most);
            expect(good, &format!("{key}: expected more than 0, {most} at the most"));
        }
        faults
    }
}
