//! What is wrong with the fleets that are told.

use crate::file::Config;
use crate::fleet::FleetSection;

/// All that is wrong with those that are told, with their places.
pub(crate) fn faults(config: &Config) -> Vec<String> {
    let of_one = |own: &FleetSection| {
        let place = format!("[[fleet]] \"{}\"", own.name);
        own.faults(&config.fleets).into_iter().map(move |fault| format!("{place}: {fault}"))
    };
    config.fleets.iter().flat_map(of_one).collect()
}
