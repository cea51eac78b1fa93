//! The sea.

use serde::Deserialize;

use super::fault::Faults;

/// Significant height, m, and peak period, s, of the sea states 0 to 8: most probable values of the
/// open North Atlantic (NATO STANAG 4194; Faltinsen, Sea Loads on Ships and Offshore Structures,
/// table 2.1).
const SEA_STATES: [(f64, f64); 9] = [
    (0.0, 5.0),
    (0.05, 5.0),
    (0.3, 6.3),
    (0.88, 7.5),
    (1.88, 8.8),
    (3.25, 9.7),
    (5.0, 12.4),
    (7.5, 15.0),
    (11.5, 16.4),
];

/// A point of the exposure to the sea: 0 in full shelter, 1 on the open sea.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct ExposurePoint {
    /// Instant.
    pub(crate) at_s: f64,
    /// Factor on all motion in the waves.
    pub(crate) factor: f64,
}

/// A moored ship shifted on her lines, by a gust or a tug. Her mean position is another from then on,
/// or until she comes back; the reference goes on stating the berth.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Shift {
    /// When it begins.
    pub(crate) at_s: f64,
    /// How long it takes to build up, and to go away.
    #[serde(default = "twenty")]
    pub(crate) over_s: f64,
    /// When she begins to come back; never if absent.
    pub(crate) until_s: Option<f64>,
    /// Forward.
    #[serde(default)]
    pub(crate) forward_m: f64,
    /// To starboard.
    #[serde(default)]
    pub(crate) starboard_m: f64,
}

fn twenty() -> f64 {
    20.0
}

impl Shift {
    fn check(&self, key: &str, faults: &mut Faults) {
        faults.not_negative(format!("{key}.at_s"), self.at_s);
        faults.range(format!("{key}.over_s"), self.over_s, 5.0, 1000.0);
        faults.range(format!("{key}.forward_m"), self.forward_m, -100.0, 100.0);
        faults.range(format!("{key}.starboard_m"), self.starboard_m, -100.0, 100.0);
        if self
            .until_s
            .is_some_and(|until| !(until.is_finite() && until >= self.at_s + self.over_s))
        {
            faults.add(format!("{key}.until_s"), "expected at_s + over_s or later");
        }
    }
}

/// The waves.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Sea {
    /// Sea state; or give height and period.
    pub(crate) state: Option<u8>,
    /// Significant height; that of the state unless given.
    pub(crate) significant_height_m: Option<f64>,
    /// Period of the spectrum's peak; that of the state unless given.
    pub(crate) peak_period_s: Option<f64>,
    /// Peak enhancement of the JONSWAP spectrum; 1 makes it Pierson-Moskowitz.
    pub(crate) gamma: f64,
    /// Where the waves come from, counted like the headings of the legs.
    pub(crate) from_deg: f64,
    /// Standard deviation of the direction over the components.
    pub(crate) spreading_deg: f64,
    /// Number of wave components.
    pub(crate) components: u16,
    /// Slow surge and sway of a moored ship, 1-sigma each; grows with the waves unless given.
    pub(crate) mooring_sway_m: Option<f64>,
    /// Slow yaw of a moored ship, 1-sigma; grows with the waves unless given.
    pub(crate) mooring_yaw_deg: Option<f64>,
    /// Shortest and longest period of that motion; as in the moored voyages that we compare with unless given: those have
    /// nothing slower than 150 s, and a mean period of 86 s.
    pub(crate) mooring_period_s: [f64; 2],
    /// How open the place is to the sea, in order of time, smooth between the points; 1 if empty.
    pub(crate) exposure: Vec<ExposurePoint>,
    /// Shifts of the moored ship.
    pub(crate) shifts: Vec<Shift>,
}

impl Default for Sea {
    fn default() -> Self {
        Sea {
            state: None,
            significant_height_m: None,
            peak_period_s: None,
            gamma: 3.3,
            from_deg: 0.0,
            spreading_deg: 15.0,
            components: 40,
            mooring_sway_m: None,
            mooring_yaw_deg: None,
            mooring_period_s: [60.0, 150.0],
            exposure: Vec::new(),
            shifts: Vec::new(),
        }
    }
}

impl Sea {
    fn of_state(&self) -> Option<(f64, f64)> {
        SEA_STATES.get(usize::from(self.state?)).copied()
    }

    /// Significant height, m.
    pub(crate) fn significant_height(&self) -> f64 {
        self.significant_height_m.or(self.of_state().map(|(height, _)| height)).unwrap_or(0.0)
    }

    /// Period of the spectrum's peak, s.
    pub(crate) fn peak_period(&self) -> f64 {
        self.peak_period_s.or(self.of_state().map(|(_, period)| period)).unwrap_or(8.0)
    }

    /// Slow surge and sway in the moorings, 1-sigma, m: 0.34 Hs^0.7, which meets the moored voyages
    /// of sea states 3 and 5 that we compare with (0.3 m and 0.8 m).
    pub(crate) fn mooring_sway(&self) -> f64 {
        self.mooring_sway_m.unwrap_or(0.34 * self.significant_height().powf(0.7))
    }

    /// Slow yaw in the moorings, 1-sigma, deg: 0.32 Hs^0.8 (0.3 and 0.8 deg in the same voyages).
    pub(crate) fn mooring_yaw_deg(&self) -> f64 {
        self.mooring_yaw_deg.unwrap_or(0.32 * self.significant_height().powf(0.8))
    }

    pub(super) fn check(&self, faults: &mut Faults) {
        if self.state.is_some() && self.of_state().is_none() {
            faults.add("sea.state", "expected a sea state from 0 to 8");
        }
        let both = self.significant_height_m.is_some() && self.peak_period_s.is_some();
        if self.state.is_none() && !both {
            faults.add("sea", "expected state, or significant_height_m and peak_period_s");
        }
        faults.range("sea.significant_height_m", self.significant_height(), 0.0, 20.0);
        faults.range("sea.peak_period_s", self.peak_period(), 2.0, 25.0);
        faults.range("sea.gamma", self.gamma, 1.0, 10.0);
        faults.finite("sea.from_deg", self.from_deg);
        faults.range("sea.spreading_deg", self.spreading_deg, 0.0, 60.0);
        faults.range("sea.components", f64::from(self.components), 1.0, 1000.0);
        faults.range("sea.mooring_sway_m", self.mooring_sway(), 0.0, 20.0);
        faults.range("sea.mooring_yaw_deg", self.mooring_yaw_deg(), 0.0, 20.0);
        let [shortest, longest] = self.mooring_period_s;
        faults.range("sea.mooring_period_s[0]", shortest, 10.0, 600.0);
        faults.range("sea.mooring_period_s[1]", longest, shortest.max(10.0), 600.0);
        for (index, point) in self.exposure.iter().enumerate() {
            let key = format!("sea.exposure[{index}]");
            faults.not_negative(format!("{key}.at_s"), point.at_s);
            faults.range(format!("{key}.factor"), point.factor, 0.0, 1.0);
        }
        for (index, shift) in self.shifts.iter().enumerate() {
            shift.check(&format!("sea.shifts[{index}]"), faults);
        }
        let mut pairs = self.exposure.iter().zip(self.exposure.iter().skip(1));
        if pairs.any(|(a, b)| b.at_s - a.at_s < 10.0) {
            faults.add("sea.exposure", "expected points in order of time, 10 s apart or more");
        }
    }
}
