//! Where the voyage starts, what ship it is, where she goes and how often truth is written.

use serde::Deserialize;

use insd_base::StartCondition;
use insd_base::units::{DEG, KNOT, wrap_pi};

use super::fault::Faults;
use crate::motion::length_for_slope;

/// What the navigator is told of the ship's motion at the start.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Mode {
    /// At the berth.
    Moored,
    /// Under way, or unknown.
    Underway,
}

impl From<Mode> for StartCondition {
    fn from(mode: Mode) -> Self {
        match mode {
            Mode::Moored => StartCondition::Moored,
            Mode::Underway => StartCondition::Underway,
        }
    }
}

/// Mean position at the start, at the IMU.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Start {
    /// Geodetic latitude.
    pub(crate) lat_deg: f64,
    /// Longitude.
    pub(crate) lon_deg: f64,
    /// Height above the ellipsoid, geoid included.
    #[serde(default)]
    pub(crate) height_m: f64,
    /// 1-sigma, each axis, of the error of the position that the header states.
    #[serde(default)]
    pub(crate) stated_std_m: f64,
}

impl Start {
    pub(super) fn check(&self, faults: &mut Faults) {
        faults.range("start.lat_deg", self.lat_deg, -90.0, 90.0);
        faults.range("start.lon_deg", self.lon_deg, -360.0, 360.0);
        faults.range("start.height_m", self.height_m, -1000.0, 20_000.0);
        faults.not_negative("start.stated_std_m", self.stated_std_m);
    }
}

/// The hull and how it answers to helm and waves.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Ship {
    /// Length at the waterline.
    pub(crate) length_m: f64,
    /// Beam.
    pub(crate) beam_m: f64,
    /// Draught.
    pub(crate) draught_m: f64,
    /// Natural period of roll.
    pub(crate) roll_period_s: f64,
    /// Damping of roll, share of critical.
    pub(crate) roll_damping: f64,
    /// How long the course lags behind the heading in a turn.
    pub(crate) course_lag_s: f64,
    /// Outward heel in a turn over centripetal acceleration in g.
    pub(crate) heel_gain: f64,
}

impl Default for Ship {
    fn default() -> Self {
        Ship {
            length_m: 80.0,
            beam_m: 14.0,
            draught_m: 4.5,
            roll_period_s: 9.5,
            roll_damping: 0.1,
            course_lag_s: 3.0,
            heel_gain: 2.0,
        }
    }
}

impl Ship {
    pub(super) fn check(&self, faults: &mut Faults) {
        faults.range("ship.length_m", self.length_m, 1.0, 500.0);
        faults.range("ship.beam_m", self.beam_m, 0.5, 100.0);
        faults.range("ship.draught_m", self.draught_m, 0.1, 50.0);
        faults.range("ship.roll_period_s", self.roll_period_s, 1.0, 60.0);
        faults.range("ship.roll_damping", self.roll_damping, 0.01, 2.0);
        faults.range("ship.course_lag_s", self.course_lag_s, 0.0, 60.0);
        faults.range("ship.heel_gain", self.heel_gain, 0.0, 10.0);
    }
}

/// From which north headings of legs, waves and current count.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub(crate) enum HeadingReference {
    /// True north. Not within a degree of a pole.
    #[default]
    True,
    /// Grid north: the direction of true north on the meridian `grid_longitude_deg`, carried
    /// everywhere. For voyages near the poles; not within a degree of the points on the equator
    /// where that meridian and its opposite cross it.
    Grid,
}

/// Legs one after the other.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Route {
    /// From which north headings count.
    #[serde(default)]
    pub(crate) heading_reference: HeadingReference,
    /// The meridian of grid north; that of the start unless given.
    pub(crate) grid_longitude_deg: Option<f64>,
    /// The legs.
    pub(crate) legs: Vec<Leg>,
}

/// To which side a turn goes.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub(crate) enum TurnSide {
    /// Whichever is nearer.
    #[default]
    Shortest,
    /// To port.
    Port,
    /// To starboard.
    Starboard,
}

/// One leg: it begins with the change of heading and speed from the leg before.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Leg {
    /// Heading of the hull.
    pub(crate) heading_deg: f64,
    /// Speed over ground.
    pub(crate) speed_kn: f64,
    /// Duration; or give a distance.
    pub(crate) duration_s: Option<f64>,
    /// Distance over ground, along the course.
    pub(crate) distance_m: Option<f64>,
    /// Angle of the course to starboard of the heading: leeway, current, thrusters.
    #[serde(default)]
    pub(crate) drift_deg: f64,
    /// To which side the turn goes.
    #[serde(default)]
    pub(crate) turn: TurnSide,
    /// Steady rate of the turn.
    #[serde(default = "one")]
    pub(crate) turn_rate_deg_s: f64,
    /// Largest acceleration when the speed changes.
    #[serde(default = "gentle")]
    pub(crate) acceleration_mps2: f64,
    /// Made fast: no way on, but free to work slowly in her moorings.
    #[serde(default)]
    pub(crate) moored: bool,
}

fn one() -> f64 {
    1.0
}

fn gentle() -> f64 {
    0.05
}

/// Shortest change of speed, drift or seaway from one leg to the next, s.
pub(crate) const SHORTEST_CHANGE: f64 = 20.0;
/// How long a turn takes to reach its steady rate, s.
pub(crate) const TURN_ENTRY: f64 = 15.0;

impl Leg {
    /// The turn from the leg before, rad, starboard positive.
    pub(crate) fn turn_angle(&self, before: &Leg) -> f64 {
        let nearest = wrap_pi((self.heading_deg - before.heading_deg) * DEG);
        match self.turn {
            TurnSide::Starboard if nearest < 0.0 => nearest + std::f64::consts::TAU,
            TurnSide::Port if nearest > 0.0 => nearest - std::f64::consts::TAU,
            _ => nearest,
        }
    }

    /// How long the turn from the leg before takes, s.
    pub(crate) fn turn_time(&self, before: &Leg) -> f64 {
        let angle = self.turn_angle(before).abs();
        if angle < 1e-9 { 0.0 } else { angle / (self.turn_rate_deg_s * DEG) + TURN_ENTRY }
    }

    /// How long the change of speed takes, s.
    pub(crate) fn speed_time(&self, before: &Leg) -> f64 {
        let change = (self.speed_kn - before.speed_kn) * KNOT;
        length_for_slope(change, self.acceleration_mps2, SHORTEST_CHANGE)
    }

    /// How long it takes until turn, change of speed and drift are complete, s.
    pub(crate) fn change_time(&self, before: &Leg) -> f64 {
        self.turn_time(before).max(self.speed_time(before))
    }

    /// Duration, s. A distance is run with the speed of the leg, after the change from that of the
    /// leg before, during which the mean of both is made good.
    pub(crate) fn duration(&self, before: &Leg) -> f64 {
        let lost = (self.speed_kn - before.speed_kn) * KNOT * self.speed_time(before) / 2.0;
        self.duration_s
            .or_else(|| Some((self.distance_m? + lost) / (self.speed_kn * KNOT)))
            .unwrap_or(0.0)
    }

    fn check(&self, key: &str, before: Option<&Leg>, faults: &mut Faults) {
        faults.finite(format!("{key}.heading_deg"), self.heading_deg);
        faults.range(format!("{key}.speed_kn"), self.speed_kn, 0.0, 100.0);
        faults.range(format!("{key}.drift_deg"), self.drift_deg, -180.0, 180.0);
        faults.range(format!("{key}.turn_rate_deg_s"), self.turn_rate_deg_s, 0.001, 20.0);
        faults.range(format!("{key}.acceleration_mps2"), self.acceleration_mps2, 0.001, 5.0);
        if self.moored && self.speed_kn != 0.0 {
            faults.add(format!("{key}.speed_kn"), "expected 0 on a leg with moored = true");
        }
        match (self.duration_s, self.distance_m) {
            (Some(duration), None) => faults.positive(format!("{key}.duration_s"), duration),
            (None, Some(distance)) => {
                faults.positive(format!("{key}.distance_m"), distance);
                if self.speed_kn <= 0.0 {
                    faults.add(
                        format!("{key}.distance_m"),
                        "expected duration_s where speed_kn is 0",
                    );
                    return;
                }
            }
            _ => return faults.add(key, "expected either duration_s or distance_m"),
        }
        let needed = before.map_or(0.0, |before| self.change_time(before));
        let duration = before.map_or_else(|| self.duration(self), |before| self.duration(before));
        if duration < needed {
            let given = if self.duration_s.is_some() { "duration_s" } else { "distance_m" };
            let problem = format!(
                "the leg lasts {duration:.1} s, but its turn and change of speed take {needed:.1} s"
            );
            faults.add(format!("{key}.{given}"), problem);
        }
    }
}

impl Route {
    /// Each leg with the one before it; the first with itself, from which nothing changes.
    pub(crate) fn steps(&self) -> impl Iterator<Item = (&Leg, &Leg)> {
        let before = self.legs.first().into_iter().chain(&self.legs);
        before.zip(&self.legs)
    }

    /// Sum of the legs, s.
    pub(crate) fn duration(&self) -> f64 {
        self.steps().map(|(before, leg)| leg.duration(before)).sum()
    }

    pub(super) fn check(&self, faults: &mut Faults) {
        if self.legs.is_empty() {
            faults.add("route.legs", "expected at least one leg");
        }
        for (index, leg) in self.legs.iter().enumerate() {
            let before = index.checked_sub(1).map(|i| &self.legs[i]);
            leg.check(&format!("route.legs[{index}]"), before, faults);
        }
        if let Some(longitude) = self.grid_longitude_deg {
            faults.range("route.grid_longitude_deg", longitude, -360.0, 360.0);
        }
        if self.grid_longitude_deg.is_some() && self.heading_reference == HeadingReference::True {
            faults.add("route.grid_longitude_deg", "needs heading_reference = \"grid\"");
        }
    }
}

/// Truth.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Truth {
    /// Rate.
    pub(crate) rate_hz: f64,
}

impl Default for Truth {
    fn default() -> Self {
        Truth { rate_hz: 10.0 }
    }
}

impl Truth {
    pub(super) fn check(&self, faults: &mut Faults) {
        faults.range("truth.rate_hz", self.rate_hz, 0.01, 1000.0);
    }
}
