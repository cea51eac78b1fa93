//! Fleets that are told.

use super::found::Found;
use crate::check::finding::ConfigPlace;
use crate::{Config, FleetSection};

/// What a state and a record of the history come to on the line, bytes, as measured in docs/fleet.md.
const STATE: f64 = 1200.0;
const RECORD: f64 = 60.0;

pub(super) fn look(config: &Config, found: &mut Found) {
    for fleet in &config.fleets {
        let place = |key: &str| ConfigPlace::of("fleet", &fleet.name).key(key);
        let is_near = ["localhost", "127.0.0.1", "::1"].contains(&fleet.host.as_str());
        if fleet.user.is_some() && !fleet.tls && !is_near {
            let text = "the password goes over the network for everybody to read";
            found.warn(
                "fleet-open",
                place("tls"),
                text,
                "tls = true, or a tunnel that ends on this computer",
            );
        }
        let needed = needed(fleet);
        if let Some(budget) = fleet.budget_bytes_h.filter(|own| needed > *own as f64) {
            let text = format!(
                "about {needed:.0} bytes/h are to be sent, and {budget} may: the oldest history will be lost"
            );
            found.warn(
                "fleet-budget",
                place("budget_bytes_h"),
                &text,
                "a longer history_s and state_s",
            );
        }
    }
}

/// What it comes to in an hour, bytes.
fn needed(fleet: &FleetSection) -> f64 {
    let each = |period: f64, bytes: f64| if period > 0.0 { 3600.0 / period * bytes } else { 0.0 };
    each(fleet.state_s, STATE) + each(fleet.history_s, RECORD)
}
