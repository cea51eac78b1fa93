//! What a configuration that is read again may change while the ship sails.

use insd_alignment::StoredState;
use insd_vessel::{Change, OrderReader, Plan};

use super::Config;
use crate::stored;

/// The configuration that holds reads the next one.
impl OrderReader for Config {
    fn replan(&mut self, text: &str) -> Result<(Plan, Change), String> {
        let (config, change) = Config::of_text(text)?.succeeding(self);
        *self = config;
        Ok((self.plan(), change))
    }

    fn stored_state(&self, text: &str) -> Result<StoredState, String> {
        stored::parse(text)
    }
}

impl Config {
    /// The configuration that holds after this one was given while `before` held: ports, sensors, points
    /// and outputs are the new ones; all else stays as it was until the next start.
    #[must_use]
    pub fn succeeding(mut self, before: &Config) -> (Config, Change) {
        let mut waiting = Vec::new();
        let mut keep = |section: &'static str, is_same: bool| {
            if !is_same {
                waiting.push(section);
            }
        };
        keep("ship", self.ship == before.ship);
        keep("imu", self.imu == before.imu);
        keep("alignment", self.alignment == before.alignment);
        keep("model", self.model == before.model);
        keep("gate", self.gate == before.gate);
        keep("floor", self.floor == before.floor);
        keep("protection", self.protection == before.protection);
        keep("spare", self.spares == before.spares);
        keep("node", self.nodes == before.nodes);
        keep("fleet", self.fleets == before.fleets);
        keep("recording", self.recording == before.recording);
        keep("chrony", self.chrony == before.chrony);
        keep("state", self.state == before.state);
        keep("learning", self.learning == before.learning);
        keep("web", self.web == before.web);
        self.ship.clone_from(&before.ship);
        self.imu.clone_from(&before.imu);
        (self.alignment, self.model) = (before.alignment, before.model);
        (self.gate, self.floor) = (before.gate, before.floor);
        self.protection = before.protection;
        self.spares.clone_from(&before.spares);
        self.nodes.clone_from(&before.nodes);
        self.fleets.clone_from(&before.fleets);
        self.recording.clone_from(&before.recording);
        self.chrony.clone_from(&before.chrony);
        self.state.clone_from(&before.state);
        self.learning = before.learning;
        self.web.clone_from(&before.web);
        let inputs = self.ports != before.ports
            || self.sensors != before.sensors
            || self.watches != before.watches;
        let outputs = self.outputs != before.outputs
            || self.points != before.points
            || self.berths != before.berths
            || self.docking != before.docking
            || self.ports.iter().map(|port| port.alerts).ne(before.ports.iter().map(|p| p.alerts));
        (self, Change { inputs, outputs, waiting })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHIPPED: &str = include_str!("../../../systemd/insd.toml");

    fn change(from: &str, to: &str) -> (Config, Change) {
        assert!(SHIPPED.contains(from), "{from}");
        let before = Config::of_text(SHIPPED).unwrap();
        Config::of_text(&SHIPPED.replacen(from, to, 1)).unwrap().succeeding(&before)
    }

    #[test]
    fn the_same_text_changes_nothing() {
        assert!(change("[ship]", "[ship]").1.is_nothing());
    }

    #[test]
    fn a_port_may_change_while_she_sails() {
        let (config, change) = change("baud = 115200", "baud = 57600");
        assert_eq!(change, Change { inputs: true, ..Change::default() });
        assert_ne!(config.ports, Config::of_text(SHIPPED).unwrap().ports);
    }

    #[test]
    fn what_navigation_is_built_on_waits_for_the_next_start_and_is_named() {
        let (config, change) = change("gyro_bias_std_deg_h = 0.01", "gyro_bias_std_deg_h = 0.02");
        assert_eq!(change, Change { waiting: vec!["imu"], ..Change::default() });
        assert_eq!(config, Config::of_text(SHIPPED).unwrap());
    }

    #[test]
    fn so_does_what_the_navigator_assumes() {
        let sections = "[alignment]\nmoored = \"white_noise\"\n[model]\ncurrent_std_mps = 1.0\n\
                        [gate]\nprobability = 0.99\n[floor]\nlog_mps = 0.01\n[protection]\nrisk = 1e-6\n[imu]";
        let (config, change) = change("[imu]", sections);
        assert_eq!(change.waiting, ["alignment", "model", "gate", "floor", "protection"]);
        assert_eq!(config, Config::of_text(SHIPPED).unwrap());
    }
}
