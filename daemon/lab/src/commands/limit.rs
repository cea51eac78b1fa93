//! `insd limit`: how well the optimal filter could do in a scenario.

use insd_base::units::DEG;
use insd_config::BadInput;
use insd_simulator::{Limit, Override, Scenario, limit};
use serde::Serialize;

use crate::scenario;
use crate::table::{Align, Table, significant};

/// The instants of the moored bars, s.
const INSTANTS: [f64; 6] = [60.0, 120.0, 300.0, 600.0, 900.0, 1800.0];

/// Options of `insd limit`.
///
/// The 1-sigma of the linear filter that knows every error model of the scenario and the spectrum of
/// the ship's motion in waves and moorings, but not the motion: nobody can do better on average.
#[derive(Clone, Debug, clap::Args)]
pub struct LimitArgs {
    /// Scenario file, or name or number of a shipped scenario
    scenario: String,
    /// Instant, s; may be repeated; 60, 120, 300, 600, 900 and 1800 if not given
    #[arg(long, value_name = "T", value_parser = super::seconds)]
    at: Vec<f64>,
    /// Set a key of the scenario to another value, as start.lat_deg=60; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    sets: Vec<Override>,
    /// Print JSON instead of a table
    #[arg(long)]
    json: bool,
}

/// The limits of a scenario in the units people read. The field names are the keys of the JSON.
#[derive(Clone, Debug, Serialize)]
struct LimitReport {
    scenario: String,
    limits: Vec<Row>,
}

#[derive(Clone, Copy, Debug, Serialize)]
struct Row {
    at_s: f64,
    heading_deg: f64,
    roll_deg: f64,
    pitch_deg: f64,
    horizontal_m: f64,
    horizontal_velocity_mps: f64,
}

/// Runs the command.
///
/// # Errors
/// The scenario is faulty, or has something that the limit is not known for.
pub fn run(args: &LimitArgs) -> anyhow::Result<()> {
    let named = scenario::find(&args.scenario, &args.sets)?;
    let at = if args.at.is_empty() { instants(&named.scenario) } else { args.at.clone() };
    let limits = limit(&named.scenario, &at)
        .map_err(|fault| BadInput(format!("{}: {fault}", named.name)))?;
    let report =
        LimitReport { scenario: named.name, limits: limits.iter().map(Row::new).collect() };
    if args.json {
        crate::terminal::print(&(serde_json::to_string_pretty(&report)? + "\n"))?;
    } else {
        let head = format!("{}: 1-sigma of the optimal filter\n\n", report.scenario);
        crate::terminal::print(&(head + &table(&report.limits).to_string()))?;
    }
    Ok(())
}

/// The instants that are looked at unless others are asked for: those of the bars that come before
/// the end, or the end.
pub(super) fn instants(scenario: &Scenario) -> Vec<f64> {
    let end = scenario.duration();
    let within: Vec<f64> = INSTANTS.into_iter().filter(|at| *at <= end).collect();
    if within.is_empty() { vec![end] } else { within }
}

impl Row {
    fn new(limit: &Limit) -> Self {
        Row {
            at_s: limit.at,
            heading_deg: limit.heading / DEG,
            roll_deg: limit.roll / DEG,
            pitch_deg: limit.pitch / DEG,
            horizontal_m: limit.horizontal_position,
            horizontal_velocity_mps: limit.horizontal_velocity,
        }
    }
}

fn table(rows: &[Row]) -> Table {
    let names = ["at s", "heading deg", "roll deg", "pitch deg", "horizontal m", "velocity m/s"];
    let mut table = Table::new(&names.map(|name| (name, Align::Right)));
    for row in rows {
        let figures = [
            row.heading_deg,
            row.roll_deg,
            row.pitch_deg,
            row.horizontal_m,
            row.horizontal_velocity_mps,
        ];
        let mut cells = vec![format!("{}", row.at_s)];
        cells.extend(figures.map(|figure| significant(figure, 3)));
        table.push(cells);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_simulator::shipped;

    #[test]
    fn instants_end_with_the_scenario() {
        let scenario = |length| Scenario::from_toml(shipped()[6].1).unwrap().with_duration(length);
        assert_eq!(instants(&scenario(600.0)), [60.0, 120.0, 300.0, 600.0]);
        assert_eq!(instants(&scenario(30.0)), [30.0]);
    }
}
