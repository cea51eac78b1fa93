//! `insd batch`: the voyages and raw recordings of an archive through the engine, one line for each, on one computer or on many.

mod archive;
mod args;
mod report;
mod score;

use std::collections::BTreeMap;

use insd_config::BadInput;

use self::archive::Recording;
pub use self::args::BatchArgs;
use self::report::BatchReport;
pub use self::score::{RecordingScore, TruthScore};
use crate::parts::{CaseList, CaseRun, gather};

/// Runs the command.
///
/// # Errors
/// There is no recording at all, none could be replayed, or a file of runs is faulty.
pub fn run(args: &BatchArgs) -> anyhow::Result<()> {
    let recordings = archive::find(&args.archives)?;
    let is_sailed = !args.parts.is_merge();
    if is_sailed && recordings.is_empty() {
        let places: Vec<String> =
            args.archives.iter().map(|place| place.display().to_string()).collect();
        return Err(BadInput(format!("{}: no recording there", places.join(", "))).into());
    }
    let by_name: BTreeMap<&str, &Recording> =
        recordings.iter().map(|own| (own.name.as_str(), own)).collect();
    let kept = gather(&args.parts, declared(args, &recordings)?, |_, name: &String| {
        let missing = || anyhow::anyhow!("{name}: no such recording");
        let recording = by_name.get(name.as_str()).ok_or_else(missing)?;
        Ok(CaseRun { case: name.clone(), score: score::score(recording, args) })
    })?;
    let report = BatchReport::new(kept.into_cases());
    let text =
        if args.json { serde_json::to_string_pretty(&report)? + "\n" } else { report.to_string() };
    crate::terminal::print(&text)?;
    if report.is_vain() {
        return Err(BadInput("no recording could be replayed".to_owned()).into());
    }
    Ok(())
}

fn declared(
    args: &BatchArgs,
    recordings: &[Recording],
) -> anyhow::Result<Vec<CaseList<RecordingScore>>> {
    let names = recordings.iter().map(|own| own.name.clone()).collect();
    let config = args.config.as_ref().map(std::fs::read_to_string).transpose();
    let config = config.map_err(|fault| BadInput(format!("--config: {fault}")))?;
    let from = args.from.map_or(String::new(), |from| format!(" --from {from}"));
    let limit = format!(" --alert-limit {}{from}", args.alert_limit.limit_m);
    let options = args.words().join(" ") + &limit;
    Ok(vec![CaseList::new("batch", &options, names, &config.unwrap_or_default())])
}
