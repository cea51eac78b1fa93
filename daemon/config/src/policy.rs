//! How a port speaks of quality, in the units of a configuration file.

use insd_base::Requirement;
use insd_base::units::DEG;
use insd_output::Policy;
use schemars::JsonSchema;
use serde::Deserialize;

/// Limits of a port that differ from the usual ones, all of them 1-sigma; see [`Policy`].
#[derive(Clone, Debug, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PolicySection {
    /// Position: RTK fixed (4, R), m.
    pub rtk_fixed_m: Option<f64>,
    /// Position: RTK float (5, F), m.
    pub rtk_float_m: Option<f64>,
    /// Position: differential (2, D), m.
    pub differential_m: Option<f64>,
    /// Position: autonomous (1, A), m.
    pub autonomous_m: Option<f64>,
    /// Position: estimated (6, E); beyond it invalid, m.
    pub estimated_m: Option<f64>,
    /// Whether a position without GNSS is estimated at best.
    pub estimated_without_gnss: Option<bool>,
    /// Whether a sentence's status is A also for estimated and simulated data.
    pub estimated_is_valid: Option<bool>,
    /// Heading for THS A, deg.
    pub heading_autonomous_deg: Option<f64>,
    /// Heading for THS E; beyond it V, and HDT stops, deg.
    pub heading_estimated_deg: Option<f64>,
    /// Roll and pitch; beyond it they are not told, deg.
    pub level_deg: Option<f64>,
    /// Velocity; beyond it there is neither course nor speed, m/s.
    pub velocity_mps: Option<f64>,
    /// Course; beyond it only the speed is told, deg.
    pub course_deg: Option<f64>,
    /// Speed below which there is no course, m/s.
    pub least_speed_mps: Option<f64>,
    /// Whose alert limit the protection level is held against, by name: `ocean`, `harbour`, `coastal`, `port`, `docking`, `circ1575-a` to
    /// `circ1575-d`. `alert_limit_m` goes before it.
    pub requirement: Option<String>,
    /// Horizontal alert limit that the protection level in PINSD,PRO is held against, m.
    pub alert_limit_m: Option<f64>,
}

impl PolicySection {
    /// A policy with these changes.
    #[must_use]
    pub fn policy(&self, usual: Policy) -> Policy {
        let mut policy = usual;
        let position = &mut policy.position;
        let lengths = [
            (&mut position.rtk_fixed, self.rtk_fixed_m),
            (&mut position.rtk_float, self.rtk_float_m),
            (&mut position.differential, self.differential_m),
            (&mut position.autonomous, self.autonomous_m),
            (&mut position.estimated, self.estimated_m),
            (&mut policy.velocity, self.velocity_mps),
            (&mut policy.least_speed, self.least_speed_mps),
        ];
        let angles = [
            (&mut policy.heading_autonomous, self.heading_autonomous_deg),
            (&mut policy.heading_estimated, self.heading_estimated_deg),
            (&mut policy.level, self.level_deg),
            (&mut policy.course, self.course_deg),
        ];
        for (limit, own) in lengths {
            *limit = own.unwrap_or(*limit);
        }
        for (limit, own) in angles {
            *limit = own.map_or(*limit, |own| own * DEG);
        }
        let gnss = self.estimated_without_gnss;
        policy.estimated_without_gnss = gnss.unwrap_or(policy.estimated_without_gnss);
        let valid = self.estimated_is_valid;
        policy.estimated_is_valid = valid.unwrap_or(policy.estimated_is_valid);
        let named = self.requirement.as_deref().and_then(Requirement::by_name);
        let required = named.map(|own| own.alert_limit);
        policy.alert_limit = self.alert_limit_m.or(required).or(policy.alert_limit);
        policy
    }

    /// All that is wrong with it, in words.
    #[must_use]
    pub fn faults(&self) -> Vec<String> {
        let limits = [
            ("rtk_fixed_m", self.rtk_fixed_m, 1e6),
            ("rtk_float_m", self.rtk_float_m, 1e6),
            ("differential_m", self.differential_m, 1e6),
            ("autonomous_m", self.autonomous_m, 1e6),
            ("estimated_m", self.estimated_m, 1e6),
            ("heading_autonomous_deg", self.heading_autonomous_deg, 180.0),
            ("heading_estimated_deg", self.heading_estimated_deg, 180.0),
            ("level_deg", self.level_deg, 90.0),
            ("velocity_mps", self.velocity_mps, 1000.0),
            ("course_deg", self.course_deg, 180.0),
            ("least_speed_mps", self.least_speed_mps, 1000.0),
            ("alert_limit_m", self.alert_limit_m, 1e6),
        ];
        let wrong = limits
            .iter()
            .filter(|(_, value, most)| value.is_some_and(|value| !(0.0..=*most).contains(&value)));
        let mut faults: Vec<String> =
            wrong.map(|(key, _, most)| format!("policy: {key}: expected 0 to {most}")).collect();
        if let Some(name) = &self.requirement
            && Requirement::by_name(name).is_none()
        {
            let names = Requirement::names();
            faults.push(format!("policy: requirement: expected one of {names}, not {name}"));
        }
        let position = self.policy(Policy::default()).position;
        let order = [
            position.rtk_fixed,
            position.rtk_float,
            position.differential,
            position.autonomous,
            position.estimated,
        ];
        if !order.is_sorted() {
            let names = "rtk_fixed_m, rtk_float_m, differential_m, autonomous_m, estimated_m";
            faults.push(format!("policy: expected {names} in rising order"));
        }
        faults
    }
}
