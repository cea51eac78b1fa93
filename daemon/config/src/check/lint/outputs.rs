//! What goes out: more than a line carries, nothing at all, and simulated data that do not say so.

use insd_drivers::ports::{Destination, Transport};

use super::found::Found;
use crate::check::finding::ConfigPlace;
use crate::{Config, OutputSection};

/// Share of what a line carries from which it is told.
const NEARLY: f64 = 0.8;
/// Where `insd feed` puts its sensors.
const SIMULATED: &str = "/run/insd-sensors";
/// Rates that are tried as advice.
const RATES: [u32; 7] = [4800, 9600, 19_200, 38_400, 57_600, 115_200, 230_400];

pub(super) fn look(config: &Config, found: &mut Found) {
    let simulated = config.ports.iter().any(|port| {
        matches!(&port.transport, Transport::Serial(own) if own.device.starts_with(SIMULATED))
    });
    for output in &config.outputs {
        let place = || ConfigPlace::of("output", &output.name);
        load(output, found);
        if output.port(0).messages.is_empty() {
            found.warn("output-mute", place(), "it sends nothing: no messages are left", "");
        }
        if simulated && !output.simulated {
            found.warn(
                "simulated-unsaid",
                place().key("simulated"),
                "the sensors are simulated, and this output does not say so",
                "simulated = true",
            );
        }
        let on_board =
            matches!(output.destination, Some(Destination::Serial(_))) || output.lan.is_some();
        if output.unmarked_when_simulated && on_board {
            found.warn(
                "simulated-unmarked",
                place().key("unmarked_when_simulated"),
                "simulated data without a mark would go to the ship's equipment",
                "leave it out",
            );
        }
    }
    if config.outputs.is_empty() && config.nodes.is_empty() {
        let section = "[[output]]".to_owned();
        let place = ConfigPlace { section, ..ConfigPlace::default() };
        found.note("no-output", place, "there is none: nobody is told anything", "");
    }
    if config.recording.as_ref().is_some_and(|own| own.quota_mb.is_none()) {
        let place = ConfigPlace::one("recording").key("quota_mb");
        let text = "no quota: recordings grow until the disk is full";
        found.warn("recording-quota", place, text, "quota_mb = 20000");
    }
    if !config.state.enabled {
        let text = "nothing is kept: after a crash she aligns anew";
        found.note("state-off", ConfigPlace::one("state").key("enabled"), text, "");
    }
}

/// What its longest messages take of its line.
fn load(output: &OutputSection, found: &mut Found) {
    let Some(share) = output.share().filter(|share| *share > NEARLY) else { return };
    let percent = share * 100.0;
    let baud = match &output.destination {
        Some(Destination::Serial(own)) => own.baud,
        Some(Destination::Pty(own)) => own.baud.unwrap_or_default(),
        _ => 0,
    };
    let need = RATES.iter().find(|rate| f64::from(**rate) * NEARLY >= f64::from(baud) * share);
    let advice = match need {
        Some(rate) => format!("{rate} baud would do, or fewer messages"),
        None => "fewer messages, or fewer a second".to_owned(),
    };
    let place = ConfigPlace::of("output", &output.name).key("destination.baud");
    let text = format!("its messages take {percent:.0} % of what {baud} baud carry");
    if share > 1.0 {
        found.error("overload", place, &text, &advice);
    } else {
        found.warn("load", place, &text, &advice);
    }
}
