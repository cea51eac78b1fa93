//! What the navigator assumes, in the units of a configuration file: how she finds her heading, the error models of the sensors,
//! gates, and which sigmas are believed. What is left out is as the code has it.

use insd_alignment::{AlignmentConfig, InMotion};
use insd_base::Span;
use insd_base::units::DEG;
use insd_nav::berth::Method;
use insd_nav::config::Models;
use insd_nav::disturbance::ModelOrder;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How she finds her attitude and heading.
#[derive(Clone, Copy, Debug, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AlignmentSection {
    /// What keeps the sea out of the alignment at the berth: `moorings`, `autoregressive`, `as_published` or `white_noise`.
    pub moored: Moored,
    /// How a ship under way finds her heading: `eight_state` or `bank`.
    pub in_motion: UnderWay,
    /// Heading sigma on the equator that counts as aligned, deg.
    pub accuracy_deg: Option<f64>,
    /// Of `as_published`: the highest order of the model of the sea that is tried, 0 to 16.
    pub prefilter_order: Option<u8>,
    /// Of `as_published`: length of the sliding window, s.
    pub prefilter_window_s: Option<f64>,
    /// Of `as_published`: from sample to sample of the velocity, s.
    pub prefilter_interval_s: Option<f64>,
    /// Of `autoregressive`: lags of the model of the sea, 0 to 24.
    pub sea_order: Option<u8>,
    /// Of `autoregressive`: length of the sliding window, s.
    pub sea_window_s: Option<f64>,
    /// Of `autoregressive`: from sample to sample of the displacement, s.
    pub sea_spacing_s: Option<f64>,
}

/// What keeps the sea out of the alignment at the berth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Moored {
    /// A model of her displacement in a sliding window, whose whitening filter goes before the Kalman filter.
    #[default]
    Autoregressive,
    /// Her bounded displacement, with her slow swaying as states.
    Moorings,
    /// The prefilter of the velocity as its source has it.
    AsPublished,
    /// Zero velocity with the sea as white noise.
    WhiteNoise,
}

/// How a ship under way finds her heading.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum UnderWay {
    /// One filter of eight states, linear in sine and cosine of the heading.
    #[default]
    EightState,
    /// A bank of full filters, one for each heading.
    Bank,
}

/// Error models of what is measured, and of the sea.
#[derive(Clone, Copy, Debug, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ModelSection {
    /// Share of the variance of a position that varies slowly, code solutions, 0 to 1.
    pub gnss_position_slow_share: Option<f64>,
    /// How long it does, s.
    pub gnss_position_time_s: Option<f64>,
    /// Share of the variance of a position that varies slowly, fixed carrier ambiguities, 0 to 1.
    pub rtk_slow_share: Option<f64>,
    /// How long it does, s.
    pub rtk_position_time_s: Option<f64>,
    /// Share of the variance of a velocity of GNSS that varies slowly, 0 to 1.
    pub gnss_velocity_slow_share: Option<f64>,
    /// How long it does, s.
    pub gnss_velocity_time_s: Option<f64>,
    /// Delay of a receiver's velocity behind its position, 1-sigma, s.
    pub gnss_velocity_delay_std_s: Option<f64>,
    /// Scale factor of a log, 1-sigma, ratio.
    pub log_scale_std: Option<f64>,
    /// Misalignment of a log about each axis, 1-sigma, deg.
    pub log_misalignment_std_deg: Option<f64>,
    /// Current, 1-sigma of each component, m/s.
    pub current_std_mps: Option<f64>,
    /// How long it lasts, s.
    pub current_time_s: Option<f64>,
    /// Random walk of the mean height (tide, draught), m/sqrt(s).
    pub sea_level_walk_m_sqrt_s: Option<f64>,
    /// Heave averaged over 20 s, at least, and before any has been seen, 1-sigma, m.
    pub mean_heave_std_m: Option<[f64; 2]>,
}

/// What is refused.
#[derive(Clone, Copy, Debug, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct GateSection {
    /// Probability that a good measurement passes the chi-square gate.
    pub probability: Option<f64>,
    /// Error of a position at 99 % for DOP 1, code solutions, m.
    pub code_base_error_m: Option<f64>,
    /// The same for solutions with carrier ambiguities, m.
    pub rtk_base_error_m: Option<f64>,
    /// Growth of the position error without fixes at 99 %, m/s.
    pub ins_growth_mps: Option<f64>,
    /// After a receiver was found in error, seconds of agreement before it is believed again.
    pub suspect_time_s: Option<f64>,
    /// How long a receiver may be refused, before alignment and judge can tell who is wrong, s.
    pub reset_time_s: Option<f64>,
    /// The same where another sensor or good gyros vouch for the filter, s.
    pub judged_reset_time_s: Option<f64>,
}

/// Which risk protection levels are of, and how often faults begin that nobody has found; see `docs/protection.md`.
#[derive(Clone, Copy, Debug, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ProtectionSection {
    /// Probability that an error is beyond its level within the exposure.
    pub risk: Option<f64>,
    /// Exposure, h.
    pub exposure_h: Option<f64>,
    /// Errors of a position that nobody falsifies are others after so long, s.
    pub renewed_s: Option<f64>,
    /// A receiver's position fails by itself, 1/h.
    pub receiver_fails_per_h: Option<f64>,
    /// A receiver is led astray, 1/h.
    pub receiver_deceived_per_h: Option<f64>,
    /// A satellite is wrong, 1/h each.
    pub satellite_fails_per_h: Option<f64>,
    /// All satellites of one constellation other than GPS are wrong, 1/h.
    pub constellation_fails_per_h: Option<f64>,
    /// A base stands elsewhere than it says, where its `sensor` has no coordinates of it: a probability.
    pub base_misplaced: Option<f64>,
    /// A log is wrong, 1/h.
    pub log_fails_per_h: Option<f64>,
    /// A compass is wrong, 1/h.
    pub heading_fails_per_h: Option<f64>,
    /// A triad of the IMU fails, 1/h.
    pub imu_fails_per_h: Option<f64>,
}

/// The least sigma that is believed of each source; smaller ones are raised to it, and counted.
#[derive(Clone, Copy, Debug, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FloorSection {
    /// Position of a code solution, m.
    pub code_m: Option<f64>,
    /// Position of a differential solution, m.
    pub differential_m: Option<f64>,
    /// Position with float ambiguities, m.
    pub rtk_float_m: Option<f64>,
    /// Position with fixed ambiguities, m.
    pub rtk_fixed_m: Option<f64>,
    /// Velocity of GNSS, m/s.
    pub gnss_velocity_mps: Option<f64>,
    /// Each component of a log, m/s.
    pub log_mps: Option<f64>,
    /// Each component of a log that states no sigma, m/s.
    pub log_default_mps: Option<f64>,
    /// Velocity of a reference, m/s.
    pub reference_velocity_mps: Option<f64>,
    /// Position of a reference, m.
    pub reference_position_m: Option<f64>,
    /// Heading of a reference, deg.
    pub reference_heading_deg: Option<f64>,
    /// Heading of a reference that states no sigma, deg.
    pub reference_heading_default_deg: Option<f64>,
}

impl AlignmentSection {
    /// As the engine takes it.
    #[must_use]
    pub fn config(&self) -> AlignmentConfig {
        let usual = AlignmentConfig::default();
        AlignmentConfig {
            moored: match self.moored {
                Moored::Moorings => Method::Moorings,
                Moored::Autoregressive => Method::Autoregressive,
                Moored::AsPublished => Method::AsPublished,
                Moored::WhiteNoise => Method::WhiteNoise,
            },
            in_motion: match self.in_motion {
                UnderWay::EightState => InMotion::EightState,
                UnderWay::Bank => InMotion::Bank,
            },
            accuracy: self.accuracy_deg.map_or(usual.accuracy, |accuracy| accuracy * DEG),
            ..usual
        }
    }

    fn lay_over(&self, models: &mut Models) {
        let prefilter = &mut models.prefilter;
        if let Some(order) = self.prefilter_order {
            prefilter.order = ModelOrder::Chosen { max: order.into() };
        }
        let whitening = &mut models.whitening;
        whitening.order = self.sea_order.map_or(whitening.order, usize::from);
        let spans = [
            (&mut prefilter.window, self.prefilter_window_s),
            (&mut prefilter.interval, self.prefilter_interval_s),
            (&mut whitening.window, self.sea_window_s),
            (&mut whitening.spacing, self.sea_spacing_s),
        ];
        for (span, own) in spans {
            *span = own.map_or(*span, Span::from_seconds);
        }
    }

    fn ranges(&self) -> [Range; 7] {
        let order = self.prefilter_order.map(f64::from);
        let lags = self.sea_order.map(f64::from);
        [
            ("alignment.accuracy_deg", self.accuracy_deg, 0.001, 10.0),
            ("alignment.prefilter_order", order, 0.0, 16.0),
            ("alignment.prefilter_window_s", self.prefilter_window_s, 32.0, 3600.0),
            ("alignment.prefilter_interval_s", self.prefilter_interval_s, 0.1, 10.0),
            ("alignment.sea_order", lags, 0.0, 24.0),
            ("alignment.sea_window_s", self.sea_window_s, 60.0, 3600.0),
            ("alignment.sea_spacing_s", self.sea_spacing_s, 1.0, 10.0),
        ]
    }
}

/// A key with its value, if it is given, and its least and greatest.
type Range = (&'static str, Option<f64>, f64, f64);

/// The sections that say what the navigator assumes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sections<'a> {
    pub(super) alignment: &'a AlignmentSection,
    pub(super) model: &'a ModelSection,
    pub(super) gate: &'a GateSection,
    pub(super) floor: &'a FloorSection,
    pub(super) protection: &'a ProtectionSection,
}

impl Sections<'_> {
    /// The models with what the sections say.
    #[must_use]
    pub(super) fn models(&self) -> Models {
        let mut models = Models::default();
        self.alignment.lay_over(&mut models);
        self.model.keys(&mut models).into_iter().for_each(ModelKey::lay_over);
        self.gate.keys(&mut models).into_iter().for_each(ModelKey::lay_over);
        self.floor.keys(&mut models).into_iter().for_each(ModelKey::lay_over);
        self.protection.keys(&mut models).into_iter().for_each(ModelKey::lay_over);
        models
    }

    /// What of the sections is out of its range, in words.
    #[must_use]
    pub(super) fn faults(&self) -> Vec<String> {
        let wrong = self.ranges().into_iter().filter(|(_, value, least, most)| {
            value.is_some_and(|value| !(*least..=*most).contains(&value))
        });
        let told = |(key, _, least, most): Range| {
            let (section, key) = key.split_once('.').unwrap_or(("", key));
            format!("[{section}]: {key}: expected {least} to {most}")
        };
        wrong.map(told).collect()
    }

    fn ranges(&self) -> Vec<Range> {
        let mut usual = Models::default();
        let mut all = self.alignment.ranges().to_vec();
        all.extend(self.model.keys(&mut usual).iter().map(ModelKey::range));
        all.extend(self.gate.keys(&mut usual).iter().map(ModelKey::range));
        all.extend(self.floor.keys(&mut usual).iter().map(ModelKey::range));
        all.extend(self.protection.keys(&mut usual).iter().map(ModelKey::range));
        all
    }
}

/// A key of a section: its name, what is given, its range, its unit in SI, and what it sets.
struct ModelKey<'a> {
    name: &'static str,
    given: Option<f64>,
    range: [f64; 2],
    unit: f64,
    sets: &'a mut f64,
}

impl ModelKey<'_> {
    fn lay_over(self) {
        *self.sets = self.given.map_or(*self.sets, |given| given * self.unit);
    }

    fn range(&self) -> Range {
        let [least, most] = self.range;
        (self.name, self.given, least, most)
    }
}

/// A row for each key of a section: its name, its range, what it sets, and its unit if that is not of SI.
macro_rules! keys {
    ($section:literal, $own:ident: $($key:ident $range:tt => $sets:expr $(, $unit:expr)?;)*) => {
        vec![$(ModelKey {
            name: concat!($section, ".", stringify!($key)),
            given: $own.$key,
            range: $range,
            unit: 1.0 $(* $unit)?,
            sets: &mut $sets,
        }),*]
    };
}

impl ModelSection {
    fn keys<'a>(&self, models: &'a mut Models) -> Vec<ModelKey<'a>> {
        let Models { gnss, log, sea, .. } = models;
        let mut keys = keys! { "model", self:
            gnss_position_slow_share [0.0, 0.99] => gnss.position_slow_share;
            gnss_position_time_s [1.0, 1e5] => gnss.position_time;
            rtk_slow_share [0.0, 0.99] => gnss.rtk_slow_share;
            rtk_position_time_s [1.0, 1e5] => gnss.rtk_position_time;
            gnss_velocity_slow_share [0.0, 0.99] => gnss.velocity_slow_share;
            gnss_velocity_time_s [1.0, 1e5] => gnss.velocity_time;
            gnss_velocity_delay_std_s [1e-6, 10.0] => gnss.velocity_delay_std;
            log_scale_std [1e-6, 0.5] => log.scale_std;
            log_misalignment_std_deg [1e-3, 30.0] => log.misalignment_std, DEG;
            current_std_mps [1e-3, 10.0] => log.current_std;
            current_time_s [1.0, 1e6] => log.current_time;
            sea_level_walk_m_sqrt_s [1e-6, 1.0] => sea.level_walk;
        };
        let [least, initial] = self.mean_heave_std_m.map_or([None; 2], |own| own.map(Some));
        let name = "model.mean_heave_std_m";
        for (given, sets) in
            [(least, &mut sea.least_mean_heave), (initial, &mut sea.initial_mean_heave)]
        {
            keys.push(ModelKey { name, given, range: [1e-3, 10.0], unit: 1.0, sets });
        }
        keys
    }
}

impl GateSection {
    fn keys<'a>(&self, models: &'a mut Models) -> Vec<ModelKey<'a>> {
        let gate = &mut models.gate;
        keys! { "gate", self:
            probability [0.9, 0.999_999_9] => gate.probability;
            code_base_error_m [0.01, 1e3] => gate.code_base_error;
            rtk_base_error_m [0.001, 1e3] => gate.rtk_base_error;
            ins_growth_mps [1e-3, 1e3] => gate.ins_growth;
            suspect_time_s [0.1, 3600.0] => gate.suspect_time;
            reset_time_s [0.1, 3600.0] => gate.reset_time;
            judged_reset_time_s [0.1, 3600.0] => gate.judged_reset_time;
        }
    }
}

impl FloorSection {
    fn keys<'a>(&self, models: &'a mut Models) -> Vec<ModelKey<'a>> {
        let all = &mut models.floors;
        keys! { "floor", self:
            code_m [1e-4, 100.0] => all.code.least;
            differential_m [1e-4, 100.0] => all.differential.least;
            rtk_float_m [1e-4, 100.0] => all.rtk_float.least;
            rtk_fixed_m [1e-4, 100.0] => all.rtk_fixed.least;
            gnss_velocity_mps [1e-4, 10.0] => all.gnss_velocity.least;
            log_mps [1e-4, 5.0] => all.log.least;
            log_default_mps [1e-4, 5.0] => all.log.default;
            reference_velocity_mps [1e-4, 10.0] => all.reference_velocity.least;
            reference_position_m [1e-3, 1e3] => all.reference_position.least;
            reference_heading_deg [1e-4, 90.0] => all.reference_heading.least, DEG;
            reference_heading_default_deg [1e-4, 90.0] => all.reference_heading.default, DEG;
        }
    }
}

impl ProtectionSection {
    /// The risk is no greater than 10 to minus this, as sentences tell it: 1 to 9.
    #[must_use]
    pub fn exponent(&self) -> u8 {
        let risk = self.risk.unwrap_or(Models::default().risk.risk);
        // to the digits of what was written
        (-risk.log10() + 1e-9).floor().clamp(1.0, 9.0) as u8
    }

    fn keys<'a>(&self, models: &'a mut Models) -> Vec<ModelKey<'a>> {
        let own = &mut models.risk;
        keys! { "protection", self:
            risk [1e-9, 0.1] => own.risk;
            exposure_h [0.01, 1000.0] => own.exposure, 3600.0;
            renewed_s [1.0, 1e5] => own.renewed;
            receiver_fails_per_h [0.0, 1.0] => own.receiver_fails;
            receiver_deceived_per_h [0.0, 1.0] => own.receiver_deceived;
            satellite_fails_per_h [0.0, 1.0] => own.satellite_fails;
            constellation_fails_per_h [0.0, 1.0] => own.constellation_fails;
            base_misplaced [0.0, 1.0] => own.base_misplaced;
            log_fails_per_h [0.0, 1.0] => own.log_fails;
            heading_fails_per_h [0.0, 1.0] => own.heading_fails;
            imu_fails_per_h [0.0, 1.0] => own.imu_fails;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Config;

    /// The file that is installed.
    const FILE: &str = include_str!("../../../systemd/insd.toml");

    /// The same with what it says of the models, which is commented, said.
    fn said() -> String {
        let start = FILE.find("#[alignment]").unwrap();
        let end = start + FILE[start..].find("# What is plugged in").unwrap();
        let said: String = FILE[start..end]
            .lines()
            .map(|line| format!("{}\n", line.trim_start_matches('#')))
            .collect();
        format!("{}{said}{}", &FILE[..start], &FILE[end..])
    }

    #[test]
    fn the_commented_file_says_every_key_with_its_default() {
        let (silent, said) = (Config::of_text(FILE).unwrap(), Config::of_text(&said()).unwrap());
        assert_eq!(said.engine(), silent.engine());
        let count = |text: &str| text.lines().filter(|line| line.contains(" = ")).count();
        let keys = said_keys(&said);
        assert_eq!(keys, count(&said_text()), "each key is one line");
    }

    fn said_text() -> String {
        let text = said();
        let start = text.find("[alignment]").unwrap();
        let end = text.find("# What is plugged in").unwrap();
        text[start..end].to_owned()
    }

    /// How many keys the sections have that are given a value.
    fn said_keys(config: &Config) -> usize {
        let given = config.assumed().ranges().into_iter().filter(|range| range.1.is_some()).count();
        // two of the alignment are words, and two ranges of the model share a key
        2 + given - 1
    }

    #[test]
    fn what_is_said_reaches_the_engine() {
        let text = said()
            .replace("moored = \"autoregressive\"", "moored = \"moorings\"")
            .replace("in_motion = \"eight_state\"", "in_motion = \"bank\"")
            .replace("prefilter_order = 8", "prefilter_order = 3")
            .replace("prefilter_window_s = 300.0", "prefilter_window_s = 120.0")
            .replace("probability = 0.9999", "probability = 0.99")
            .replace("log_scale_std = 0.005", "log_scale_std = 0.02")
            .replace("reference_heading_deg = 0.01", "reference_heading_deg = 0.5")
            .replace("risk = 1e-5", "risk = 1e-7")
            .replace("exposure_h = 3.0", "exposure_h = 0.25")
            .replace("satellite_fails_per_h = 1e-5", "satellite_fails_per_h = 2e-5");
        let engine = Config::of_text(&text).unwrap().engine();
        assert_eq!(engine.alignment.moored, Method::Moorings);
        assert_eq!(engine.alignment.in_motion, InMotion::Bank);
        let Models { log, gate, floors, prefilter, risk, .. } = engine.models;
        assert_eq!((risk.risk, risk.exposure, risk.satellite_fails), (1e-7, 900.0, 2e-5));
        assert_eq!(prefilter.order, ModelOrder::Chosen { max: 3 });
        assert_eq!(prefilter.window, Span::from_seconds(120.0));
        assert_eq!((gate.probability, log.scale_std), (0.99, 0.02));
        assert!((floors.reference_heading.least - 0.5 * DEG).abs() < 1e-12);
    }

    #[test]
    fn what_is_out_of_its_range_is_told_with_its_place() {
        let text = said()
            .replace("accuracy_deg = 0.1", "accuracy_deg = 0.0")
            .replace("probability = 0.9999", "probability = 1.0")
            .replace("mean_heave_std_m = [0.02, 0.3]", "mean_heave_std_m = [0.02, 99.0]")
            .replace("risk = 1e-5", "risk = 0.0")
            .replace("exposure_h = 3.0", "exposure_h = 0.0");
        let message = Config::of_text(&text).unwrap_err();
        for part in [
            "[alignment]: accuracy_deg: expected 0.001 to 10",
            "[gate]: probability: expected 0.9 to 0.9999999",
            "[model]: mean_heave_std_m: expected 0.001 to 10",
            "[protection]: risk: expected 0.000000001 to 0.1",
            "[protection]: exposure_h: expected 0.01 to 1000",
        ] {
            assert!(message.contains(part), "{part} is not in: {message}");
        }
    }
}
