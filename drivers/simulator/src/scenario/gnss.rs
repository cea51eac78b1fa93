//! The GNSS receiver: rate, error model, faults.

use serde::Deserialize;

use super::fault::Faults;
use super::when::{Delay, Spread, When};

/// A class of receiver by name.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub(crate) enum GnssGrade {
    /// Code positions with SBAS corrections, quality 2.
    #[default]
    Standard,
    /// Carrier phase with fixed ambiguities, quality 4.
    Rtk,
}

/// 1-sigma of a quantity north, east, down: white, plus first-order Gauss-Markov.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct GnssNoise {
    /// White, m or m/s.
    pub(crate) white: [f64; 3],
    /// Gauss-Markov, m or m/s.
    pub(crate) correlated: [f64; 3],
    /// Correlation time of the latter.
    pub(crate) correlation_time_s: f64,
}

impl GnssNoise {
    fn check(&self, key: &str, faults: &mut Faults) {
        faults.std3(&format!("{key}.white"), self.white);
        faults.std3(&format!("{key}.correlated"), self.correlated);
        faults.positive(format!("{key}.correlation_time_s"), self.correlation_time_s);
    }
}

/// No fix.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Outage {
    /// When.
    pub(crate) when: When,
    /// For how long.
    pub(crate) duration_s: Spread,
    /// Whether the receiver goes on sending, with quality 0 and nothing else.
    #[serde(default)]
    pub(crate) rows: bool,
}

/// A position that is off and back again; velocity and claimed sigma know nothing of it.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Jump {
    /// When.
    pub(crate) when: When,
    /// For how long.
    pub(crate) duration_s: Spread,
    /// Horizontal distance, in a random direction; or give `offset_m`.
    pub(crate) size_m: Option<Spread>,
    /// North, east, down.
    pub(crate) offset_m: Option<[f64; 3]>,
}

/// Few satellites in view: errors and claimed sigmas of position and velocity grow alike.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct DopSpike {
    /// When.
    pub(crate) when: When,
    /// For how long.
    pub(crate) duration_s: Spread,
    /// Dilution of precision meanwhile.
    pub(crate) hdop: Spread,
}

/// Position and velocity pulled away, the one consistent with the other; sigmas unchanged.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Spoofing {
    /// When.
    pub(crate) when: When,
    /// For how long; then the receiver is back at once.
    pub(crate) duration_s: Spread,
    /// Speed of the pull from its first moment.
    #[serde(default = "nothing")]
    pub(crate) speed_mps: Spread,
    /// Acceleration of the pull.
    #[serde(default = "nothing")]
    pub(crate) acceleration_mps2: Spread,
    /// Direction from true north; random unless given.
    pub(crate) direction_deg: Option<f64>,
}

fn nothing() -> Spread {
    Spread::Fixed(0.0)
}

/// What is wrong with a claimed standard deviation.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub(crate) enum StdFault {
    /// 0.
    Zero,
    /// Not given.
    Missing,
    /// Ten thousand kilometres.
    Absurd,
}

/// Claimed standard deviations that cannot be believed.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct BadStds {
    /// When.
    pub(crate) when: When,
    /// For how long.
    pub(crate) duration_s: Spread,
    /// What is wrong.
    pub(crate) fault: StdFault,
}

/// The receiver.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Gnss {
    /// Rate of fixes.
    pub(crate) rate_hz: f64,
    /// Class of receiver.
    pub(crate) grade: GnssGrade,
    /// Antenna from the IMU, body axes.
    pub(crate) lever_arm_m: [f64; 3],
    /// Position error, m; that of the grade unless given.
    pub(crate) position: Option<GnssNoise>,
    /// Velocity error, m/s; that of the grade unless given.
    pub(crate) velocity: Option<GnssNoise>,
    /// Whether the receiver gives velocity at all.
    pub(crate) with_velocity: bool,
    /// How late fixes arrive; at once if absent.
    pub(crate) arrival: Option<Delay>,
    /// No fix.
    pub(crate) outages: Vec<Outage>,
    /// Jumps of position.
    pub(crate) jumps: Vec<Jump>,
    /// Few satellites.
    pub(crate) dop_spikes: Vec<DopSpike>,
    /// Spoofing.
    pub(crate) spoofing: Vec<Spoofing>,
    /// Unbelievable sigmas.
    pub(crate) bad_stds: Vec<BadStds>,
}

impl Default for Gnss {
    fn default() -> Self {
        Gnss {
            rate_hz: 1.0,
            grade: GnssGrade::Standard,
            lever_arm_m: [-6.0, -0.8, -14.0],
            position: None,
            velocity: None,
            with_velocity: true,
            arrival: None,
            outages: Vec::new(),
            jumps: Vec::new(),
            dop_spikes: Vec::new(),
            spoofing: Vec::new(),
            bad_stds: Vec::new(),
        }
    }
}

impl Gnss {
    /// Position error, m.
    pub(crate) fn position_noise(&self) -> GnssNoise {
        self.position.unwrap_or(match self.grade {
            GnssGrade::Standard => GnssNoise {
                white: [0.5, 0.5, 0.9],
                correlated: [0.8, 0.8, 1.4],
                correlation_time_s: 300.0,
            },
            GnssGrade::Rtk => GnssNoise {
                white: [0.01, 0.01, 0.02],
                correlated: [0.01, 0.01, 0.02],
                correlation_time_s: 300.0,
            },
        })
    }

    /// Velocity error, m/s.
    pub(crate) fn velocity_noise(&self) -> GnssNoise {
        self.velocity.unwrap_or(match self.grade {
            GnssGrade::Standard => GnssNoise {
                white: [0.03, 0.03, 0.05],
                correlated: [0.01, 0.01, 0.02],
                correlation_time_s: 100.0,
            },
            GnssGrade::Rtk => GnssNoise {
                white: [0.01, 0.01, 0.02],
                correlated: [0.003, 0.003, 0.006],
                correlation_time_s: 100.0,
            },
        })
    }

    pub(super) fn check(&self, faults: &mut Faults) {
        faults.range("gnss.rate_hz", self.rate_hz, 0.001, 100.0);
        faults.lever_arm("gnss.lever_arm_m", self.lever_arm_m);
        self.position_noise().check("gnss.position", faults);
        self.velocity_noise().check("gnss.velocity", faults);
        if let Some(arrival) = self.arrival {
            arrival.check("gnss.arrival", faults);
        }
        self.check_jumps(faults);
        self.check_other_faults(faults);
        let each = |list: &str, windows: Vec<(&When, Spread)>, faults: &mut Faults| {
            for (index, (when, duration)) in windows.into_iter().enumerate() {
                let key = format!("gnss.{list}[{index}]");
                duration.check(&format!("{key}.duration_s"), 0.0, 1e6, faults);
                when.check(&format!("{key}.when"), duration.bounds()[1], faults);
            }
        };
        each("outages", self.outages.iter().map(|f| (&f.when, f.duration_s)).collect(), faults);
        each("jumps", self.jumps.iter().map(|f| (&f.when, f.duration_s)).collect(), faults);
        each(
            "dop_spikes",
            self.dop_spikes.iter().map(|f| (&f.when, f.duration_s)).collect(),
            faults,
        );
        each("spoofing", self.spoofing.iter().map(|f| (&f.when, f.duration_s)).collect(), faults);
        each("bad_stds", self.bad_stds.iter().map(|f| (&f.when, f.duration_s)).collect(), faults);
    }

    fn check_jumps(&self, faults: &mut Faults) {
        for (index, jump) in self.jumps.iter().enumerate() {
            let key = format!("gnss.jumps[{index}]");
            match (jump.size_m, jump.offset_m) {
                (Some(size), None) => size.check(&format!("{key}.size_m"), 0.0, 1e7, faults),
                (None, Some(offset)) => {
                    for (axis, value) in offset.into_iter().enumerate() {
                        faults.range(format!("{key}.offset_m[{axis}]"), value, -1e7, 1e7);
                    }
                }
                _ => faults.add(key, "expected either size_m or offset_m"),
            }
        }
    }

    fn check_other_faults(&self, faults: &mut Faults) {
        for (index, spike) in self.dop_spikes.iter().enumerate() {
            spike.hdop.check(&format!("gnss.dop_spikes[{index}].hdop"), 0.5, 100.0, faults);
        }
        for (index, spoofing) in self.spoofing.iter().enumerate() {
            let key = format!("gnss.spoofing[{index}]");
            spoofing.speed_mps.check(&format!("{key}.speed_mps"), 0.0, 1000.0, faults);
            let acceleration = spoofing.acceleration_mps2;
            acceleration.check(&format!("{key}.acceleration_mps2"), 0.0, 100.0, faults);
            faults.finite(format!("{key}.direction_deg"), spoofing.direction_deg.unwrap_or(0.0));
        }
    }
}
