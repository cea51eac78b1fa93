//! What the navigator assumes, in the units of a configuration file: how she finds her heading, the error models of the sensors,
//! gates, and which sigmas are believed. What is left out is as the code has it.

use insd_alignment::{AlignmentConfig, InMotion};
use insd_base::Span;
use insd_base::units::DEG;
use insd_nav::berth::Method;
use insd_nav::config::Models;
use insd_nav::disturbance::ModelOrder;
use insd_nav::floors::Believable;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How she finds her attitude and heading.
#[derive(Clone, Copy, Debug, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AlignmentSection {
    /// What keeps the sea out of the alignment at the berth: `moorings`, `autoregressive` or `white_noise`.
    pub moored: Moored,
    /// How a ship under way finds her heading: `eight_state` or `bank`.
    pub in_motion: UnderWay,
    /// Heading sigma on the equator that counts as aligned, deg.
    pub accuracy_deg: Option<f64>,
    /// Of `autoregressive`: the highest order of the model of the sea that is tried, 0 to 16.
    pub prefilter_order: Option<u8>,
    /// Of `autoregressive`: length of the sliding window, s.
    pub prefilter_window_s: Option<f64>,
    /// Of `autoregressive`: from sample to sample of the velocity, s.
    pub prefilter_interval_s: Option<f64>,
}

/// What keeps the sea out of the alignment at the berth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Moored {
    /// Her bounded displacement, with her slow swaying as states.
    #[default]
    Moorings,
    /// A model of the sea in a sliding window, before the filter.
    Autoregressive,
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
        let spans = [
            (&mut prefilter.window, self.prefilter_window_s),
            (&mut prefilter.interval, self.prefilter_interval_s),
        ];
        for (span, own) in spans {
            *span = own.map_or(*span, Span::from_seconds);
        }
    }

    fn ranges(&self) -> [Range; 4] {
        let order = self.prefilter_order.map(f64::from);
        [
            ("alignment.accuracy_deg", self.accuracy_deg, 0.001, 10.0),
            ("alignment.prefilter_order", order, 0.0, 16.0),
            ("alignment.prefilter_window_s", self.prefilter_window_s, 32.0, 3600.0),
            ("alignment.prefilter_interval_s", self.prefilter_interval_s, 0.1, 10.0),
        ]
    }
}

/// A key with its value, if it is given, and its least and greatest.
type Range = (&'static str, Option<f64>, f64, f64);

/// The models with what the sections say.
#[must_use]
pub(super) fn models(
    alignment: &AlignmentSection,
    model: &ModelSection,
    gate: &GateSection,
    floor: &FloorSection,
) -> Models {
    let mut models = Models::default();
    alignment.lay_over(&mut models);
    model.lay_over(&mut models);
    gate.lay_over(&mut models);
    floor.lay_over(&mut models);
    models
}

/// What of the sections is out of its range, in words.
#[must_use]
pub(super) fn faults(
    alignment: &AlignmentSection,
    model: &ModelSection,
    gate: &GateSection,
    floor: &FloorSection,
) -> Vec<String> {
    let all = alignment.ranges().into_iter().chain(model.ranges()).chain(gate.ranges());
    let wrong = all.chain(floor.ranges()).filter(|(_, value, least, most)| {
        value.is_some_and(|value| !(*least..=*most).contains(&value))
    });
    let told = |(key, _, least, most): Range| {
        let (section, key) = key.split_once('.').unwrap_or(("", key));
        format!("[{section}]: {key}: expected {least} to {most}")
    };
    wrong.map(told).collect()
}

fn lay_over<const N: usize>(all: [(&mut f64, Option<f64>); N]) {
    for (value, own) in all {
        *value = own.unwrap_or(*value);
    }
}

impl ModelSection {
    fn lay_over(&self, models: &mut Models) {
        let Models { gnss, log, sea, .. } = models;
        let [least, initial] = self.mean_heave_std_m.map_or([None; 2], |own| own.map(Some));
        lay_over([
            (&mut gnss.position_slow_share, self.gnss_position_slow_share),
            (&mut gnss.position_time, self.gnss_position_time_s),
            (&mut gnss.rtk_slow_share, self.rtk_slow_share),
            (&mut gnss.rtk_position_time, self.rtk_position_time_s),
            (&mut gnss.velocity_slow_share, self.gnss_velocity_slow_share),
            (&mut gnss.velocity_time, self.gnss_velocity_time_s),
            (&mut gnss.velocity_delay_std, self.gnss_velocity_delay_std_s),
            (&mut log.scale_std, self.log_scale_std),
            (&mut log.misalignment_std, self.log_misalignment_std_deg.map(|own| own * DEG)),
            (&mut log.current_std, self.current_std_mps),
            (&mut log.current_time, self.current_time_s),
            (&mut sea.level_walk, self.sea_level_walk_m_sqrt_s),
            (&mut sea.least_mean_heave, least),
            (&mut sea.initial_mean_heave, initial),
        ]);
    }

    fn ranges(&self) -> [Range; 14] {
        let [least, initial] = self.mean_heave_std_m.map_or([None; 2], |own| own.map(Some));
        [
            ("model.gnss_position_slow_share", self.gnss_position_slow_share, 0.0, 0.99),
            ("model.gnss_position_time_s", self.gnss_position_time_s, 1.0, 1e5),
            ("model.rtk_slow_share", self.rtk_slow_share, 0.0, 0.99),
            ("model.rtk_position_time_s", self.rtk_position_time_s, 1.0, 1e5),
            ("model.gnss_velocity_slow_share", self.gnss_velocity_slow_share, 0.0, 0.99),
            ("model.gnss_velocity_time_s", self.gnss_velocity_time_s, 1.0, 1e5),
            ("model.gnss_velocity_delay_std_s", self.gnss_velocity_delay_std_s, 1e-6, 10.0),
            ("model.log_scale_std", self.log_scale_std, 1e-6, 0.5),
            ("model.log_misalignment_std_deg", self.log_misalignment_std_deg, 1e-3, 30.0),
            ("model.current_std_mps", self.current_std_mps, 1e-3, 10.0),
            ("model.current_time_s", self.current_time_s, 1.0, 1e6),
            ("model.sea_level_walk_m_sqrt_s", self.sea_level_walk_m_sqrt_s, 1e-6, 1.0),
            ("model.mean_heave_std_m", least, 1e-3, 10.0),
            ("model.mean_heave_std_m", initial, 1e-3, 10.0),
        ]
    }
}

impl GateSection {
    fn lay_over(&self, models: &mut Models) {
        let gate = &mut models.gate;
        lay_over([
            (&mut gate.probability, self.probability),
            (&mut gate.code_base_error, self.code_base_error_m),
            (&mut gate.rtk_base_error, self.rtk_base_error_m),
            (&mut gate.ins_growth, self.ins_growth_mps),
            (&mut gate.suspect_time, self.suspect_time_s),
            (&mut gate.reset_time, self.reset_time_s),
            (&mut gate.judged_reset_time, self.judged_reset_time_s),
        ]);
    }

    fn ranges(&self) -> [Range; 7] {
        [
            ("gate.probability", self.probability, 0.9, 0.999_999_9),
            ("gate.code_base_error_m", self.code_base_error_m, 0.01, 1e3),
            ("gate.rtk_base_error_m", self.rtk_base_error_m, 0.001, 1e3),
            ("gate.ins_growth_mps", self.ins_growth_mps, 1e-3, 1e3),
            ("gate.suspect_time_s", self.suspect_time_s, 0.1, 3600.0),
            ("gate.reset_time_s", self.reset_time_s, 0.1, 3600.0),
            ("gate.judged_reset_time_s", self.judged_reset_time_s, 0.1, 3600.0),
        ]
    }
}

impl FloorSection {
    fn lay_over(&self, models: &mut Models) {
        let all = &mut models.floors;
        let degrees = |own: Option<f64>| own.map(|own| own * DEG);
        let each: [(&mut Believable, Option<f64>); 9] = [
            (&mut all.code, self.code_m),
            (&mut all.differential, self.differential_m),
            (&mut all.rtk_float, self.rtk_float_m),
            (&mut all.rtk_fixed, self.rtk_fixed_m),
            (&mut all.gnss_velocity, self.gnss_velocity_mps),
            (&mut all.log, self.log_mps),
            (&mut all.reference_velocity, self.reference_velocity_mps),
            (&mut all.reference_position, self.reference_position_m),
            (&mut all.reference_heading, degrees(self.reference_heading_deg)),
        ];
        for (range, own) in each {
            range.least = own.unwrap_or(range.least);
        }
        lay_over([
            (&mut all.log.default, self.log_default_mps),
            (&mut all.reference_heading.default, degrees(self.reference_heading_default_deg)),
        ]);
    }

    fn ranges(&self) -> [Range; 11] {
        let heading = self.reference_heading_default_deg;
        [
            ("floor.code_m", self.code_m, 1e-4, 100.0),
            ("floor.differential_m", self.differential_m, 1e-4, 100.0),
            ("floor.rtk_float_m", self.rtk_float_m, 1e-4, 100.0),
            ("floor.rtk_fixed_m", self.rtk_fixed_m, 1e-4, 100.0),
            ("floor.gnss_velocity_mps", self.gnss_velocity_mps, 1e-4, 10.0),
            ("floor.log_mps", self.log_mps, 1e-4, 5.0),
            ("floor.log_default_mps", self.log_default_mps, 1e-4, 5.0),
            ("floor.reference_velocity_mps", self.reference_velocity_mps, 1e-4, 10.0),
            ("floor.reference_position_m", self.reference_position_m, 1e-3, 1e3),
            ("floor.reference_heading_deg", self.reference_heading_deg, 1e-4, 90.0),
            ("floor.reference_heading_default_deg", heading, 1e-4, 90.0),
        ]
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
        let (model, gate, floor) = (&config.model, &config.gate, &config.floor);
        let given = |ranges: &[Range]| ranges.iter().filter(|range| range.1.is_some()).count();
        // two of the alignment are words, and two ranges of the model share a key
        2 + given(&config.alignment.ranges()) + given(&model.ranges()) - 1
            + given(&gate.ranges())
            + given(&floor.ranges())
    }

    #[test]
    fn what_is_said_reaches_the_engine() {
        let text = said()
            .replace("moored = \"moorings\"", "moored = \"autoregressive\"")
            .replace("in_motion = \"eight_state\"", "in_motion = \"bank\"")
            .replace("prefilter_order = 8", "prefilter_order = 3")
            .replace("prefilter_window_s = 300.0", "prefilter_window_s = 120.0")
            .replace("probability = 0.9999", "probability = 0.99")
            .replace("log_scale_std = 0.005", "log_scale_std = 0.02")
            .replace("reference_heading_deg = 0.01", "reference_heading_deg = 0.5");
        let engine = Config::of_text(&text).unwrap().engine();
        assert_eq!(engine.alignment.moored, Method::Autoregressive);
        assert_eq!(engine.alignment.in_motion, InMotion::Bank);
        let Models { log, gate, floors, prefilter, .. } = engine.models;
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
            .replace("mean_heave_std_m = [0.02, 0.3]", "mean_heave_std_m = [0.02, 99.0]");
        let message = Config::of_text(&text).unwrap_err();
        for part in [
            "[alignment]: accuracy_deg: expected 0.001 to 10",
            "[gate]: probability: expected 0.9 to 0.9999999",
            "[model]: mean_heave_std_m: expected 0.001 to 10",
        ] {
            assert!(message.contains(part), "{part} is not in: {message}");
        }
    }
}
