//! Ports that are written to: what they send, how often, in whose name and of which point.

use std::collections::BTreeMap;

use insd_base::Body;
use insd_drivers::ports::{Destination, OutputConfig};
use insd_output::{Manner, MessageKind, OutputPortConfig, Port, Profile, Rate, Talker};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::lan::LanSection;
use super::policy::PolicySection;

/// Messages per second that a port may be asked for.
const RATES: std::ops::RangeInclusive<f64> = 0.001..=200.0;
/// The profile of a port that names none, and no messages.
const USUAL: &str = "bridge";

/// A point of the ship that a port speaks of.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointSection {
    /// Its name.
    pub name: String,
    /// Where it is from the IMU: forward, starboard, down, m.
    pub lever_m: [f64; 3],
}

/// What happens to a port that is asked for more than it can carry.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Overfull {
    /// It is told, and the newest of each message replaces the one that still waits.
    #[default]
    Warn,
    /// The configuration is refused.
    Refuse,
}

/// One port that is written to.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OutputSection {
    /// Its name.
    pub name: String,
    /// Where its messages go; either this or `lan`.
    pub destination: Option<Destination>,
    /// The ship's network after IEC 61162-450.
    pub lan: Option<LanSection>,
    /// A ready-made list of messages.
    pub profile: Option<String>,
    /// Messages per second of each kind. With a profile: what differs from it, 0 for none. Without both:
    /// those of a bridge.
    #[serde(alias = "sentences")]
    #[schemars(extend("x-alias" = "sentences"))]
    pub messages: Option<BTreeMap<String, f64>>,
    /// Talker of all sentences that have one.
    pub talker: Option<String>,
    /// Talkers of single messages.
    #[serde(default)]
    pub talkers: BTreeMap<String, String>,
    /// Name of the monitoring point; the IMU if left out.
    pub point: Option<String>,
    /// Time constant by which the rate of turn is damped, s.
    pub rot_damping_s: Option<f64>,
    /// Height of the geoid above the ellipsoid where the ship sails, m, in place of that of EGM96.
    pub geoid_m: Option<f64>,
    /// Whether the data come from a simulator, and must say so.
    #[serde(default)]
    pub simulated: bool,
    /// Send also what has no mark for simulated data, from a simulator. Only for a port that no ship's
    /// equipment listens to.
    #[serde(default)]
    pub unmarked_when_simulated: bool,
    /// How it speaks of quality.
    #[serde(default)]
    pub policy: PolicySection,
    /// What happens if it cannot carry what it is asked for.
    #[serde(default)]
    pub overfull: Overfull,
}

impl OutputSection {
    /// What makes its messages; `point` is the index of its monitoring point. What is not known is left
    /// out: see [`OutputSection::faults`].
    #[must_use]
    pub fn port(&self, point: usize) -> OutputPortConfig {
        let talker = |name: &String| Talker::new(name);
        let talkers = self
            .talkers
            .iter()
            .filter_map(|(kind, own)| Some((MessageKind::named(kind)?, Talker::new(own)?)));
        let profile = self.named_profile().map(Profile::port).unwrap_or_default();
        OutputPortConfig {
            messages: self.rates(&profile),
            manner: Manner {
                policy: self.policy.policy(profile.manner.policy),
                simulated: self.simulated,
                unmarked_when_simulated: self.unmarked_when_simulated,
            },
            talker: self.talker.as_ref().and_then(talker).or(profile.talker),
            talkers: talkers.chain(profile.talkers.iter().copied()).collect(),
            point,
            turn_damping: self.rot_damping_s.unwrap_or(profile.turn_damping),
            geoid_separation: self.geoid_m,
        }
    }

    /// What carries them; `None` for the ship's network, which needs several.
    #[must_use]
    pub fn carrier(&self) -> Option<OutputConfig> {
        self.destination.clone().map(OutputConfig::new)
    }

    /// By how much it is asked for more than it can carry: the share of the bytes per second of its
    /// line that its longest messages would take, if that is more than all of them.
    #[must_use]
    pub fn overload(&self) -> Option<f64> {
        self.share().filter(|share| *share > 1.0)
    }

    /// The share of the bytes per second of its line that its longest messages take; `None` if its
    /// carrier has no pace of its own.
    #[must_use]
    pub fn share(&self) -> Option<f64> {
        let capacity = self.carrier()?.capacity()?;
        Some(Port::new(self.port(0)).bytes_per_second() / capacity)
    }

    fn named_profile(&self) -> Option<&'static Profile> {
        match (&self.profile, &self.messages) {
            (Some(name), _) => Profile::named(name),
            (None, Some(_)) => None,
            (None, None) => Profile::named(USUAL),
        }
    }

    fn rates(&self, profile: &OutputPortConfig) -> Vec<(MessageKind, Rate)> {
        let own = |kind: MessageKind| self.messages.as_ref()?.get(kind.name()).copied();
        let usual = |kind: MessageKind| {
            let line = profile.messages.iter().find(|(other, _)| *other == kind);
            line.map(|(_, rate)| *rate)
        };
        let rate = |kind: MessageKind| match own(kind) {
            Some(hertz) => (hertz > 0.0).then(|| Rate::from_hertz(hertz)),
            None => usual(kind),
        };
        MessageKind::all().filter_map(|kind| rate(kind).map(|rate| (kind, rate))).collect()
    }

    /// All that is wrong with it, in words.
    pub(super) fn faults(&self, points: &[PointSection]) -> Vec<String> {
        let mut faults = Vec::new();
        let mut expect = |good: bool, fault: &dyn Fn() -> String| {
            if !good {
                faults.push(fault());
            }
        };
        expect(self.destination.is_some() != self.lan.is_some(), &|| {
            "expected either destination or lan".to_owned()
        });
        let profile = self.profile.as_ref().is_none_or(|name| Profile::named(name).is_some());
        expect(profile, &|| {
            let names: Vec<&str> = Profile::all().map(|profile| profile.name).collect();
            format!("profile: expected one of {}", names.join(", "))
        });
        for (kind, rate) in self.messages.iter().flatten() {
            let good = *rate == 0.0 || RATES.contains(rate);
            expect(good, &|| {
                let (least, most) = (RATES.start(), RATES.end());
                format!("messages: {kind}: expected 0, or {least} to {most} a second")
            });
        }
        let kinds = self.messages.iter().flatten().map(|(kind, _)| kind).chain(self.talkers.keys());
        for kind in kinds {
            expect(MessageKind::named(kind).is_some(), &|| {
                let names: Vec<&str> = MessageKind::all().map(MessageKind::name).collect();
                format!("{kind}: expected one of {}", names.join(", "))
            });
        }
        for talker in self.talkers.values().chain(&self.talker) {
            expect(Talker::new(talker).is_some(), &|| {
                format!("talker {talker}: expected two capital letters or digits, not P")
            });
        }
        let damping = self.rot_damping_s.is_none_or(|s| (0.0..=60.0).contains(&s));
        expect(damping, &|| "rot_damping_s: expected 0 to 60".to_owned());
        let geoid = self.geoid_m.is_none_or(|geoid| geoid.abs() <= 120.0);
        expect(geoid, &|| "geoid_m: expected -120 to 120".to_owned());
        let point =
            self.point.as_ref().is_none_or(|name| points.iter().any(|point| point.name == *name));
        expect(point, &|| "point: expected the name of a [[point]]".to_owned());
        faults.extend(self.overload().filter(|_| self.overfull == Overfull::Refuse).map(|share| {
            let percent = share * 100.0;
            format!("messages: {percent:.0} % of what the line carries, expected at most 100 %")
        }));
        faults.extend(self.policy.faults());
        faults.extend(self.carrier().iter().flat_map(OutputConfig::faults));
        faults.extend(self.lan.iter().flat_map(LanSection::faults));
        faults
    }
}

impl PointSection {
    /// From the IMU, body axes, m.
    #[must_use]
    pub fn lever(&self) -> Body {
        let [forward, starboard, down] = self.lever_m;
        Body::new(forward, starboard, down)
    }
}
