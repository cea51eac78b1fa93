//! How the ship stands to a berth.

use serde::{Deserialize, Serialize};

use super::freshness::Freshness;

/// How the ship stands to the berth that is chosen or near. All sigmas are 1-sigma.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownDocking {
    /// Name of the berth.
    pub berth: String,
    /// How it came to be this one: `chosen`, or `nearest` where nobody has chosen.
    pub choice: String,
    /// `valid`, `doubtful`, or `not_valid`: then nothing is told below but the quay.
    pub state: String,
    /// What is wrong, in words.
    pub why: Option<String>,
    /// Time of validity, on the ship's time line, s.
    pub valid_at_s: f64,
    /// Whether that may be taken as the present.
    pub freshness: Freshness,
    /// Which side of her lies to the quay: `port`, `starboard`.
    pub side: Option<String>,
    /// Angle between her and the quay, deg, -90 to 90, positive with the bow nearer.
    pub angle_deg: Option<f64>,
    /// 1-sigma of the angle, deg.
    pub sigma_angle_deg: Option<f64>,
    /// The bow.
    pub bow: Option<ShownDockingPoint>,
    /// The stern.
    pub stern: Option<ShownDockingPoint>,
    /// The manifold, if the configuration has one.
    pub manifold: Option<ShownDockingPoint>,
    /// The first contact if she goes on as she goes now; `None` where she does not come surely nearer.
    pub contact: Option<ShownContact>,
    /// Speed of contact that is warned of, m/s.
    pub contact_speed_limit_mps: Option<f64>,
    /// Distance that is warned of, m.
    pub distance_limit_m: Option<f64>,
    /// The quay, to be drawn.
    pub quay: ShownQuay,
    /// Corners of the hull, or bow and stern: along the quay from the first point of its line, and from the line over the water, m.
    pub outline_m: Vec<[f64; 2]>,
}

/// How one part of the ship stands to the quay.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownDockingPoint {
    /// From the hull to the face of the fenders, across the quay, m; negative beyond them.
    pub distance_m: Option<f64>,
    /// 1-sigma, m.
    pub sigma_distance_m: Option<f64>,
    /// Protection level of the distance, m.
    pub level_m: Option<f64>,
    /// Speed towards the fenders, m/s.
    pub closing_mps: Option<f64>,
    /// 1-sigma, m/s.
    pub sigma_closing_mps: Option<f64>,
    /// Speed along the quay, m/s, positive ahead as she lies.
    pub along_mps: Option<f64>,
    /// 1-sigma, m/s.
    pub sigma_along_mps: Option<f64>,
    /// Where it is along the quay, m from the first point of its line.
    pub place_m: Option<f64>,
    /// Height above the edge of the quay, m, where that of the quay is configured.
    pub above_m: Option<f64>,
    /// 1-sigma, m.
    pub sigma_above_m: Option<f64>,
}

/// The first contact.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownContact {
    /// What touches: `bow`, `stern`, or `manifold` for what is between them.
    pub part: String,
    /// Its speed towards the fenders, m/s.
    pub speed_mps: Option<f64>,
    /// 1-sigma, m/s.
    pub sigma_speed_mps: Option<f64>,
    /// Until then, s.
    pub in_s: Option<f64>,
    /// 1-sigma, s.
    pub sigma_in_s: Option<f64>,
}

/// A quay, to be drawn.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownQuay {
    /// Length of its line, m.
    pub length_m: Option<f64>,
    /// On which hand the water is, from the first point to the second: `right`, `left`.
    pub water: String,
    /// Fenders: from the first point along the line, and before it, m.
    pub fenders_m: Vec<[f64; 2]>,
    /// Bollards: from the first point along the line, m.
    pub bollards_m: Vec<f64>,
}

impl ShownDocking {
    /// Lets time go on; `least` is the freshness of the navigator's word.
    pub(super) fn grow_older(&mut self, now: f64, least: Freshness) {
        self.freshness = Freshness::of_age(now - self.valid_at_s).max(least);
        if self.freshness != Freshness::Gone {
            return;
        }
        "not_valid".clone_into(&mut self.state);
        self.why.get_or_insert_with(|| "nothing new is known".to_owned());
        (self.side, self.angle_deg, self.sigma_angle_deg) = (None, None, None);
        (self.bow, self.stern, self.manifold, self.contact) = (None, None, None, None);
        self.outline_m.clear();
    }
}
