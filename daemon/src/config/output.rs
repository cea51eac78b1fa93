//! Ports that are written to: which sentences, how often.

use insd_drivers::ports::{Destination, OutputConfig};
use insd_output::{PortConfig, Rate, SentenceKind};
use serde::Deserialize;

/// One port that is written to.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OutputSection {
    /// Its name.
    pub name: String,
    /// Where its sentences go.
    pub destination: Destination,
    /// Sentences per second of each kind; left out: those of a bridge.
    pub sentences: Option<Sentences>,
    /// Height of the geoid above the ellipsoid where the ship sails, m, for the altitude in GGA.
    pub geoid_m: Option<f64>,
    /// Whether the data come from a simulator, and must say so.
    #[serde(default)]
    pub simulated: bool,
}

/// Sentences per second; none of those that are left out.
#[derive(Clone, Copy, Debug, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields, default, rename_all = "UPPERCASE")]
pub struct Sentences {
    /// Heading.
    pub hdt: Option<f64>,
    /// Heading and status.
    pub ths: Option<f64>,
    /// Rate of turn.
    pub rot: Option<f64>,
    /// Position.
    pub gga: Option<f64>,
    /// Course and speed over ground.
    pub vtg: Option<f64>,
    /// Date and time.
    pub zda: Option<f64>,
}

impl Sentences {
    /// Those that are sent, with their rates, Hz.
    #[must_use]
    pub fn rates(&self) -> Vec<(SentenceKind, f64)> {
        let all = [
            (SentenceKind::Hdt, self.hdt),
            (SentenceKind::Ths, self.ths),
            (SentenceKind::Rot, self.rot),
            (SentenceKind::Zda, self.zda),
            (SentenceKind::Gga, self.gga),
            (SentenceKind::Vtg, self.vtg),
        ];
        all.into_iter().filter_map(|(kind, rate)| rate.map(|rate| (kind, rate))).collect()
    }
}

impl OutputSection {
    /// What makes its sentences.
    #[must_use]
    pub fn port(&self) -> PortConfig {
        let bridge = PortConfig::bridge();
        let sentences = self.sentences.map_or(bridge.sentences.clone(), |own| {
            own.rates().into_iter().map(|(kind, rate)| (kind, Rate::from_hertz(rate))).collect()
        });
        PortConfig {
            sentences,
            geoid_separation: self.geoid_m,
            simulated: self.simulated,
            ..bridge
        }
    }

    /// What carries them.
    #[must_use]
    pub fn carrier(&self) -> OutputConfig {
        OutputConfig::new(self.destination.clone())
    }
}
