//! `insd limit`: how well the optimal filter could do in a scenario.

use insd_base::units::DEG;
use insd_config::BadInput;
use insd_simulator::{
    CameraUse, JudgedSegment, Limit, LimitError, LimitQuestion, Override, Scenario, SegmentLimit,
    camera_limit, limit_of, satellite_limit,
};
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
    /// In place of instants the segments of a scenario with raw GNSS, by satellites and, where there is one, the camera, in the sky of this seed
    #[arg(long, value_name = "SEED", conflicts_with = "at")]
    segments: Option<u64>,
    /// Take the fixes away while FROM <= t < TO; may be repeated
    #[arg(long = "outage", value_name = "FROM..TO", value_parser = stretch, conflicts_with = "segments")]
    outages: Vec<(f64, f64)>,
    /// Of who knows the whole voyage, as after `insd smooth`, and not its past alone
    #[arg(long, conflicts_with = "segments")]
    smoothed: bool,
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
    if let Some(seed) = args.segments {
        return run_segments(args, &named, seed);
    }
    let at = if args.at.is_empty() { instants(&named.scenario) } else { args.at.clone() };
    let asked = LimitQuestion { at, outages: args.outages.clone(), is_afterwards: args.smoothed };
    let limits = limit_of(&named.scenario, &asked)
        .map_err(|fault| BadInput(format!("{}: {fault}", named.name)))?;
    let report =
        LimitReport { scenario: named.name, limits: limits.iter().map(Row::new).collect() };
    if args.json {
        crate::terminal::print(&(serde_json::to_string_pretty(&report)? + "\n"))?;
    } else {
        let whose = if args.smoothed { "smoother" } else { "filter" };
        let head = format!("{}: 1-sigma of the optimal {whose}\n\n", report.scenario);
        crate::terminal::print(&(head + &table(&report.limits).to_string()))?;
    }
    Ok(())
}

/// FROM..TO, s.
fn stretch(text: &str) -> Result<(f64, f64), String> {
    let expected = || "expected FROM..TO with FROM < TO in seconds".to_owned();
    let (from, to) = text.split_once("..").ok_or_else(expected)?;
    let (from, to) = (super::seconds(from)?, super::seconds(to)?);
    if from < to { Ok((from, to)) } else { Err(expected()) }
}

/// The limits of segments in the shape of a voyage's `limit.json`.
#[derive(Clone, Debug, Serialize)]
struct SegmentsReport {
    scenario: String,
    seed: u64,
    note: &'static str,
    segments: Vec<SegmentRow>,
    /// By tracks of points.
    #[serde(skip_serializing_if = "Option::is_none")]
    segments_with_camera: Option<Vec<SegmentRow>>,
    /// By the steps of a visual odometry.
    #[serde(skip_serializing_if = "Option::is_none")]
    segments_with_odometry: Option<Vec<SegmentRow>>,
}

#[derive(Clone, Debug, Serialize)]
struct SegmentRow {
    label: String,
    t0_s: f64,
    t1_s: f64,
    hpos_end_m: f64,
    relative_end_m: f64,
    relative_rms_m: f64,
    hvel_end_mps: f64,
    heading_rms_deg: f64,
    roll_rms_deg: f64,
    pitch_rms_deg: f64,
}

fn run_segments(args: &LimitArgs, named: &scenario::Named, seed: u64) -> anyhow::Result<()> {
    let rows = |limits: Result<Vec<SegmentLimit>, LimitError>| -> anyhow::Result<Vec<SegmentRow>> {
        let limits = limits.map_err(|fault| BadInput(format!("{}: {fault}", named.name)))?;
        Ok(limits.iter().map(SegmentRow::new).collect())
    };
    let seen = |by: CameraUse| {
        let has_camera = named.scenario.has_camera();
        has_camera.then(|| rows(camera_limit(&named.scenario, seed, by))).transpose()
    };
    let report = SegmentsReport {
        scenario: named.name.clone(),
        seed,
        note: "1-sigma; position is horizontal (root of north plus east variance); relative: since the start of the segment",
        segments: rows(satellite_limit(&named.scenario, seed))?,
        segments_with_camera: seen(CameraUse::Tracks)?,
        segments_with_odometry: seen(CameraUse::Odometry)?,
    };
    if args.json {
        return Ok(crate::terminal::print(&(serde_json::to_string(&report)? + "\n"))?);
    }
    Ok(crate::terminal::print(&segment_text(&report))?)
}

fn segment_text(report: &SegmentsReport) -> String {
    let SegmentsReport { scenario, seed, segments, .. } = report;
    let table = segment_table(segments);
    let mut text = format!("{scenario}, seed {seed}: 1-sigma of the optimal filter\n\n{table}");
    for (what, rows) in [
        ("with the camera, by tracks of points", &report.segments_with_camera),
        ("with the camera, by the steps of its visual odometry", &report.segments_with_odometry),
    ] {
        if let Some(rows) = rows {
            text += &format!("\n{what}\n\n{}", segment_table(rows));
        }
    }
    text
}

impl SegmentRow {
    fn new(limit: &SegmentLimit) -> Self {
        let JudgedSegment { t0_s, t1_s, label, .. } = limit.segment.clone();
        let [heading, roll, pitch] = limit.attitude_rms.map(|own| own / DEG);
        SegmentRow {
            label,
            t0_s,
            t1_s,
            hpos_end_m: limit.position_end,
            relative_end_m: limit.relative_end,
            relative_rms_m: limit.relative_rms,
            hvel_end_mps: limit.velocity_end,
            heading_rms_deg: heading,
            roll_rms_deg: roll,
            pitch_rms_deg: pitch,
        }
    }
}

fn segment_table(rows: &[SegmentRow]) -> Table {
    let names = [
        "segment",
        "from s",
        "to s",
        "position m",
        "relative m",
        "RMS m",
        "velocity m/s",
        "heading deg",
        "roll deg",
        "pitch deg",
    ];
    let mut table = Table::new(&names.map(|name| (name, Align::Right)));
    for row in rows {
        let figures = [
            row.hpos_end_m,
            row.relative_end_m,
            row.relative_rms_m,
            row.hvel_end_mps,
            row.heading_rms_deg,
            row.roll_rms_deg,
            row.pitch_rms_deg,
        ];
        let mut cells = vec![row.label.clone(), format!("{}", row.t0_s), format!("{}", row.t1_s)];
        cells.extend(figures.map(|figure| significant(figure, 3)));
        table.push(cells);
    }
    table
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
