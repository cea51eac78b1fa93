//! The ports of a raw recording.

use std::path::Path;

use anyhow::Context;
use insd_base::{PortId, Time};
use insd_config::BadInput;
use insd_drivers::raw::{FileHeader, RawReader};
use insd_lab::sniff::{PortToHear, SniffReport, Sniffed};
use insd_wire::stream::Protocol;

use super::frames;

/// What the ports of a recording heard. Faults of its files are told on standard error.
pub(super) fn read(
    path: &Path,
    name: &str,
    protocols: &[Protocol],
    form: frames::Form,
) -> anyhow::Result<SniffReport> {
    let reader = RawReader::open(path).map_err(|fault| BadInput(fault.to_string()))?;
    let mut sniffed = Sniffed::new(protocols);
    let ports = reader.header().map(port_names).unwrap_or_default();
    for (id, port) in (0..).zip(ports) {
        let plan = PortToHear { name: format!("{name}: {port}"), timed: true, transport: None };
        sniffed.announce(PortId(id), plan);
    }
    let mut shown = frames::Printer::new(form);
    for arrival in reader {
        match arrival {
            Ok(arrival) => {
                sniffed.take_and_show(&arrival, |seen| shown.show(seen));
                if shown.outcome().context("cannot print")? {
                    break;
                }
            }
            Err(fault) => eprintln!("insd: {fault}"),
        }
    }
    Ok(sniffed.report(sniffed.last().unwrap_or(Time::START)))
}

/// Names of the ports in the configuration that a recording carries.
fn port_names(header: &FileHeader) -> Vec<String> {
    let config: toml::Table = header.config.parse().unwrap_or_default();
    let ports = config.get("port").and_then(toml::Value::as_array).into_iter().flatten();
    let name =
        |port: &toml::Value| port.get("name").and_then(toml::Value::as_str).map(str::to_owned);
    ports.map(|port| name(port).unwrap_or_default()).collect()
}
