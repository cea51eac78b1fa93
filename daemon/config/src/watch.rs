//! References that are watched and not used: `[[watch]]`.

use insd_base::Span;
use insd_base::units::DEG;
use insd_intake::config::{Role, SensorConfig};
use insd_vessel::{WatchLimits, WatchPlan};
use schemars::JsonSchema;
use serde::Deserialize;

/// A sensor that is watched: what it says is held against the ship's own word, and not used.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WatchSection {
    /// Name of the `[[sensor]]`: a compass, a motion sensor, or a position from elsewhere.
    pub sensor: String,
    /// Difference of headings beyond which it is told, deg.
    #[serde(default = "heading")]
    pub heading_deg: f64,
    /// Distance of positions beyond which it is told, m.
    #[serde(default = "position")]
    pub position_m: f64,
    /// Difference of roll or of pitch beyond which it is told, deg.
    #[serde(default = "attitude")]
    pub attitude_deg: f64,
    /// 1-sigma of its roll and pitch, deg.
    #[serde(default = "attitude_std")]
    pub attitude_std_deg: f64,
    /// Time over which a difference is averaged, s.
    #[serde(default = "seconds")]
    pub smooth_s: f64,
    /// Time for which it must be beyond the limit before it is told, s.
    #[serde(default = "seconds")]
    pub after_s: f64,
}

/// What a gyrocompass may be off in a seaway (ISO 8728), deg.
fn heading() -> f64 {
    1.5
}
fn position() -> f64 {
    100.0
}
fn attitude() -> f64 {
    1.0
}
fn attitude_std() -> f64 {
    0.1
}
fn seconds() -> f64 {
    3.0
}

impl WatchSection {
    pub(crate) fn plan(&self, index: usize, sensor: &SensorConfig) -> WatchPlan {
        WatchPlan {
            sensor: index,
            name: self.sensor.clone(),
            lever: sensor.lever().unwrap_or_default(),
            limits: WatchLimits {
                heading: self.heading_deg * DEG,
                position: self.position_m,
                attitude: self.attitude_deg * DEG,
            },
            attitude_std: self.attitude_std_deg * DEG,
            smooth: Span::from_seconds(self.smooth_s),
            hold: Span::from_seconds(self.after_s),
        }
    }

    /// All that is wrong with it, in words.
    pub(crate) fn faults(&self, sensors: &[SensorConfig], all: &[WatchSection]) -> Vec<String> {
        let mut faults = Vec::new();
        let mut expect = |good: bool, key: &str, expected: &str| {
            if !good {
                faults.push(format!("{key}: expected {expected}"));
            }
        };
        let own = sensors.iter().find(|sensor| sensor.name == self.sensor);
        let is_comparable = own.is_some_and(|own| {
            matches!(own.kind.role(), Role::Heading | Role::Attitude | Role::Position)
        });
        let expected = "the name of a [[sensor]] that tells a heading or a position from elsewhere";
        expect(is_comparable, "sensor", expected);
        let others = all.iter().filter(|other| other.sensor == self.sensor);
        expect(others.count() == 1, "sensor", "a sensor that is not watched already");
        for (key, value, most, expected) in [
            ("heading_deg", self.heading_deg, 180.0, "more than 0, 180 at the most"),
            ("position_m", self.position_m, 1e5, "more than 0, 100000 at the most"),
            ("attitude_deg", self.attitude_deg, 90.0, "more than 0, 90 at the most"),
            ("attitude_std_deg", self.attitude_std_deg, 90.0, "more than 0, 90 at the most"),
        ] {
            expect(value > 0.0 && value <= most, key, expected);
        }
        expect((0.0..=300.0).contains(&self.smooth_s), "smooth_s", "0 to 300");
        expect((0.0..=3600.0).contains(&self.after_s), "after_s", "0 to 3600");
        faults
    }
}
