//! Campaigns in parts: shares of many voyages on many computers, files with a line for each, and all of it put together again.
//!
//! What a campaign is says a [`CampaignDeclaration`]; what comes of its voyages stands in a file of runs, with which a job that was killed
//! goes on. Runs are told by their keys, so that the result of any partition is that of one run.

mod args;
mod cases;
mod declaration;
mod kept;
mod merge;
mod shard;
#[cfg(test)]
mod tests;

use std::sync::{Mutex, PoisonError};

use indicatif::{ProgressBar, ProgressStyle};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

pub use self::args::PartsArgs;
pub use self::cases::{CaseList, CaseRun, CaseRuns};
pub use self::declaration::CampaignDeclaration;
pub(crate) use self::declaration::checksum;
use self::kept::Keeper;
pub use self::kept::KeptRuns;
pub use self::shard::{Shard, ShardChoice};

/// Sails what belongs to this shard and is not in the file of runs yet, or, with `--merge`, puts files together and sails nothing.
///
/// `sail` is given the index of a declaration and the key of one of its runs.
///
/// # Errors
/// A file of runs is faulty or of another campaign, or a voyage cannot be sailed.
pub fn gather<D: CampaignDeclaration>(
    args: &PartsArgs,
    declared: Vec<D>,
    sail: impl Fn(usize, &D::Key) -> anyhow::Result<D::Run> + Sync,
) -> anyhow::Result<KeptRuns<D>> {
    if args.is_merge() {
        let kept = merge::merge(&args.merge)?;
        if let Some(path) = &args.runs {
            Keeper::create(path, &kept.declared)?.keep_all(&kept)?;
        }
        return Ok(kept);
    }
    let (keeper, mut kept) = keeper(args, &declared)?;
    let open = open_runs(&declared, args.own_shard()?, &kept);
    let bar = progress_bar(open.len() as u64)?;
    let keeper = Mutex::new(keeper);
    let score = |(index, key): (usize, D::Key)| {
        let run = sail(index, &key)?;
        if let Some(keeper) = keeper.lock().unwrap_or_else(PoisonError::into_inner).as_mut() {
            keeper.keep(&declared[index], &run)?;
        }
        bar.inc(1);
        Ok((index, run))
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(args.jobs_at_once()).build()?;
    let sailed: anyhow::Result<Vec<(usize, D::Run)>> =
        pool.install(|| open.into_par_iter().map(score).collect());
    bar.finish_and_clear();
    sailed?.into_iter().for_each(|(index, run)| kept.add(&declared[index], run));
    kept.declared = declared;
    Ok(kept)
}

fn keeper<D: CampaignDeclaration>(
    args: &PartsArgs,
    declared: &[D],
) -> anyhow::Result<(Option<Keeper>, KeptRuns<D>)> {
    match &args.runs {
        Some(path) if args.resume => {
            Keeper::resume(path, declared).map(|(keeper, kept)| (Some(keeper), kept))
        }
        Some(path) => Ok((Some(Keeper::create(path, declared)?), KeptRuns::default())),
        None => Ok((None, KeptRuns::default())),
    }
}

/// The runs of a shard, as declaration and key, without those that are kept.
fn open_runs<D: CampaignDeclaration>(
    declared: &[D],
    shard: Shard,
    kept: &KeptRuns<D>,
) -> Vec<(usize, D::Key)> {
    let all = declared.iter().enumerate();
    let all = all.flat_map(|(index, own)| own.keys().into_iter().map(move |key| (index, key)));
    let own = all.enumerate().filter(|(number, _)| shard.holds(*number));
    own.map(|(_, run)| run).filter(|(index, key)| !kept.has(&declared[*index], key)).collect()
}

fn progress_bar(length: u64) -> anyhow::Result<ProgressBar> {
    let style = "{wide_bar:.cyan/blue} {pos}/{len} voyages, {elapsed} gone, {eta} to go";
    Ok(ProgressBar::new(length).with_style(ProgressStyle::with_template(style)?))
}
