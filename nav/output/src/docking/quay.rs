//! The quay: a line of two points, the fenders before it, and where a point of the ship is by it.

use insd_base::Geodetic;
use insd_base::earth::{c_ne, ecef};
use nalgebra::{Matrix3, Vector3};

/// Which side of the line is water, looking from its first point to the second.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum WaterSide {
    /// The right-hand side.
    #[default]
    Right,
    /// The left-hand side.
    Left,
}

/// A fender.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fender {
    /// Where it is along the quay, m from the first point.
    pub at: f64,
    /// How far its face is before the quay line, m.
    pub off: f64,
}

/// A berth as it is configured.
#[derive(Clone, Debug, PartialEq)]
pub struct Quay {
    /// Its name.
    pub name: String,
    /// The two points of its line.
    pub line: [Geodetic; 2],
    /// Where the water is.
    pub water: WaterSide,
    /// Fenders in rising order along the line; without any the line itself is told of.
    pub fenders: Vec<Fender>,
    /// Bollards, m from the first point.
    pub bollards: Vec<f64>,
    /// Height of its edge above the ellipsoid, m, if known.
    pub height: Option<f64>,
    /// 1-sigma of where the line, the fenders and the points of the ship are, across the line, m.
    pub sigma: f64,
}

impl Quay {
    /// Length of the line, m.
    #[must_use]
    pub fn length(&self) -> f64 {
        let [from, to] = self.line.map(|point| ecef(&point).0);
        (to - from).norm()
    }
}

/// The axes of a quay.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct QuayAxes {
    /// The first point, ECEF, m, and its height above the ellipsoid.
    origin: Vector3<f64>,
    height: f64,
    /// From ECEF to north, east, down of the first point.
    c_ne: Matrix3<f64>,
    /// Horizontal units in the same axes: along the line, and from it to the water.
    along: Vector3<f64>,
    across: Vector3<f64>,
    /// Length of the line, m.
    pub(super) length: f64,
    fenders: Vec<Fender>,
}

/// Where a point of the ship is by the quay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Beside {
    /// Along the line, m from the first point.
    pub(super) place: f64,
    /// From the face of the fenders to the point, m, positive on the water.
    pub(super) distance: f64,
    /// What moves the distance: its gradient along north, east and down of the ship.
    pub(super) gradient: Vector3<f64>,
    /// The unit along the line in the same axes.
    pub(super) along: Vector3<f64>,
}

impl QuayAxes {
    /// Those of a berth. Two equal points have no axes: nothing finite comes of them.
    pub(super) fn of(quay: &Quay) -> Self {
        let height = quay.height.unwrap_or(0.0);
        let [from, to] = quay.line.map(|point| Geodetic { height, ..point });
        let (origin, c_ne) = (ecef(&from).0, c_ne(&from));
        let mut way = c_ne * (ecef(&to).0 - origin);
        way.z = 0.0;
        let (along, length) = (way / way.norm(), way.norm());
        let right = Vector3::new(-along.y, along.x, 0.0);
        let across = if quay.water == WaterSide::Right { right } else { -right };
        QuayAxes { origin, height, c_ne, along, across, length, fenders: quay.fenders.clone() }
    }

    /// Where a point is. It is held against the line at the line's own height: that of a mast is none of its distance.
    pub(super) fn beside(&self, point: &Geodetic) -> Beside {
        let [place, across] = self.plan(point);
        let (off, slope) = self.face(place);
        let turn = c_ne(point) * self.c_ne.transpose();
        Beside {
            place,
            distance: across - off,
            gradient: turn * (self.across - slope * self.along),
            along: turn * self.along,
        }
    }

    /// Along the line from its first point, and from it over the water, m.
    pub(super) fn plan(&self, point: &Geodetic) -> [f64; 2] {
        let level = Geodetic { height: self.height, ..*point };
        let from_origin = self.c_ne * (ecef(&level).0 - self.origin);
        [self.along.dot(&from_origin), self.across.dot(&from_origin)]
    }

    /// How far the face of the fenders is before the line, m, and how that changes along it. Between two fenders it is the straight
    /// line from one to the other, beyond the last that of the last.
    fn face(&self, place: f64) -> (f64, f64) {
        let after = self.fenders.iter().position(|fender| fender.at > place);
        let (before, next) = match after {
            Some(0) => (None, self.fenders.first()),
            Some(index) => (self.fenders.get(index - 1), self.fenders.get(index)),
            None => (self.fenders.last(), None),
        };
        match (before, next) {
            (Some(one), Some(other)) => {
                let slope = (other.off - one.off) / (other.at - one.at);
                (one.off + slope * (place - one.at), slope)
            }
            (Some(one), None) | (None, Some(one)) => (one.off, 0.0),
            (None, None) => (0.0, 0.0),
        }
    }

    /// From a place to the nearest point of the line itself, horizontally, m.
    pub(super) fn range(&self, point: &Geodetic) -> f64 {
        let [place, across] = self.plan(point);
        (place - place.clamp(0.0, self.length)).hypot(across)
    }

    /// Whether the water is to the right of the line.
    pub(super) fn has_water_right(&self) -> bool {
        self.along.x * self.across.y - self.along.y * self.across.x > 0.0
    }
}
