//! Cases with names through files of runs, in parts.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use serde::{Deserialize, Serialize};

use super::*;

/// A score with digits that must come back to the bit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Sine {
    of: f64,
}

fn catalogue(options: &str) -> CaseList<Sine> {
    let cases = (0..23).map(|number| format!("case {number}")).collect();
    CaseList::new("sines", options, cases, "")
}

fn sail(case: &str) -> Sine {
    let number: f64 = case.trim_start_matches("case ").parse().unwrap();
    Sine { of: (number + 0.1).sin() / 3.0 }
}

fn gathered(args: &PartsArgs) -> anyhow::Result<CaseRuns<Sine>> {
    let run = |_, case: &String| Ok(CaseRun { case: case.clone(), score: sail(case) });
    Ok(gather(args, vec![catalogue("")], run)?.into_cases())
}

fn shard(dir: &Path, k: u64, of: u64) -> PartsArgs {
    PartsArgs {
        runs: Some(dir.join(format!("{k}-{of}.jsonl"))),
        shard: Some(format!("{k}/{of}").parse().unwrap()),
        ..PartsArgs::default()
    }
}

fn merge(files: &[PathBuf]) -> anyhow::Result<CaseRuns<Sine>> {
    gathered(&PartsArgs { merge: files.to_vec(), ..PartsArgs::default() })
}

#[test]
fn any_partition_of_named_cases_is_put_together_to_the_bits_of_one_run() {
    let desk = tempfile::tempdir().unwrap();
    let whole = gathered(&PartsArgs::default()).unwrap();
    assert_eq!((whole.runs.len(), whole.lack().as_str()), (23, ""));
    for of in [1, 2, 5, 40] {
        let parts = (0..of).rev().map(|k| shard(desk.path(), k, of));
        let files: Vec<PathBuf> = parts
            .map(|args| {
                gathered(&args).unwrap();
                args.runs.unwrap()
            })
            .collect();
        assert_eq!(merge(&files).unwrap().runs, whole.runs);
    }
}

#[test]
fn what_is_kept_already_is_not_sailed_again() {
    let desk = tempfile::tempdir().unwrap();
    let whole = shard(desk.path(), 0, 1);
    gathered(&whole).unwrap();
    let path = whole.runs.clone().unwrap();
    let text = fs::read_to_string(&path).unwrap();
    let cut = text.match_indices('\n').nth(8).unwrap().0 + 20;
    fs::write(&path, &text[..cut]).unwrap();
    let sailed = AtomicUsize::new(0);
    let args = PartsArgs { resume: true, ..whole };
    let run = |_, case: &String| {
        sailed.fetch_add(1, Ordering::Relaxed);
        Ok(CaseRun { case: case.clone(), score: sail(case) })
    };
    let kept = gather(&args, vec![catalogue("")], run).unwrap().into_cases();
    assert_eq!(kept.runs, gathered(&PartsArgs::default()).unwrap().runs);
    // nine lines stood: what the campaign is, and eight cases
    assert_eq!(sailed.into_inner(), 23 - 8);
}

#[test]
fn cases_that_are_missing_are_named_and_other_catalogues_refused() {
    let desk = tempfile::tempdir().unwrap();
    let part = shard(desk.path(), 1, 2);
    gathered(&part).unwrap();
    let path = part.runs.clone().unwrap();
    let lack = merge(std::slice::from_ref(&path)).unwrap().lack();
    assert!(lack.starts_with("12 cases of the campaign are missing: case 0, case 2,"), "{lack}");
    assert!(lack.ends_with(" and 2 more\n"), "{lack}");
    let twice = merge(&[path.clone(), path.clone()]).unwrap_err().to_string();
    assert!(twice.ends_with("case case 1 is in a file before it already"), "{twice}");
    let args = PartsArgs { resume: true, ..part };
    let never = |_, _: &String| anyhow::bail!("nothing is to be sailed");
    let other = gather(&args, vec![catalogue("--rate 2")], never).err().unwrap().to_string();
    assert!(other.contains("options is  there and --rate 2 here"), "{other}");
}
