//! Berths.

use insd_base::Geodetic;
use insd_base::earth::ecef;

use super::found::Found;
use crate::Config;
use crate::check::finding::ConfigPlace;

/// A berth that is further from where the ship starts is probably mistyped, km.
const FAR: f64 = 300.0;

pub(super) fn look(config: &Config, found: &mut Found) {
    let ends = config.ends_of_ship();
    let length = ends.map(|(bow, stern)| bow.0.x - stern.0.x);
    for berth in &config.berths {
        let place = || ConfigPlace::of("berth", &berth.name).key("to_deg");
        let quay = berth.quay().length();
        if let Some(ship) = length.filter(|ship| *ship > quay) {
            found.warn(
                "quay-short",
                place(),
                &format!("the line is {quay:.0} m long, the ship from stern to bow {ship:.0} m"),
                "lengthen the line along the quay: a contact beyond its ends is not foretold",
            );
        }
        if let Some(km) = distance(config, &berth.line()[0]).filter(|km| *km > FAR) {
            found.warn(
                "berth-far",
                ConfigPlace::of("berth", &berth.name).key("from_deg"),
                &format!("{km:.0} km from lat_deg, lon_deg of [ship]"),
                "latitude comes first, and south and west are negative",
            );
        }
    }
    let docking = &config.docking;
    if ends.is_some() && docking.beam_m.is_none() && docking.outline_m.is_empty() {
        found.note(
            "no-beam",
            ConfigPlace::one("docking").key("bow"),
            "without beam_m and outline_m the points are taken as those of the side that goes alongside",
            "",
        );
    }
}

/// From where the ship starts, straight through the Earth, km.
fn distance(config: &Config, to: &Geodetic) -> Option<f64> {
    let (lat, lon) = config.ship.lat_deg.zip(config.ship.lon_deg)?;
    let ship = Geodetic::from_degrees(lat, lon, 0.0);
    Some((ecef(&ship).0 - ecef(to).0).norm() / 1000.0)
}
