//! The command line of what can be done in parts.

use std::path::PathBuf;

use insd_config::BadInput;

use super::shard::{Shard, ShardChoice};

/// Options of a campaign that can be sailed in parts.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct PartsArgs {
    /// Voyages at once; if not given SLURM_CPUS_PER_TASK, or what the system grants of its processors
    #[arg(long, value_name = "N")]
    pub jobs: Option<usize>,
    /// Write a line of JSON with the scores of each voyage as soon as it is done
    #[arg(long, value_name = "FILE")]
    pub runs: Option<PathBuf>,
    /// Go on with the file of --runs: what is in it is not sailed again
    #[arg(long, requires = "runs", conflicts_with = "merge")]
    pub resume: bool,
    /// Sail every Nth voyage only, from the Kth on (0 to N - 1); auto takes K and N from Slurm, auto/N takes K
    /// from Slurm or Kubernetes
    #[arg(long, value_name = "K/N", conflicts_with = "merge")]
    pub shard: Option<ShardChoice>,
    /// Sail nothing: put the runs of these files together
    #[arg(long, value_name = "FILE", num_args = 1..)]
    pub merge: Vec<PathBuf>,
}

impl PartsArgs {
    /// Whether nothing is sailed and files are put together.
    #[must_use]
    pub fn is_merge(&self) -> bool {
        !self.merge.is_empty()
    }

    /// The shard that is meant.
    ///
    /// # Errors
    /// It is to be given out by a job system, and none has.
    pub(super) fn own_shard(&self) -> Result<Shard, BadInput> {
        let Some(chosen) = self.shard else { return Ok(Shard::ALL) };
        chosen.resolve(|name| std::env::var(name).ok()).map_err(BadInput)
    }

    /// Voyages at once; 0 for what the system grants.
    pub(super) fn jobs_at_once(&self) -> usize {
        let granted = || std::env::var("SLURM_CPUS_PER_TASK").ok()?.parse().ok();
        self.jobs.or_else(granted).unwrap_or(0)
    }
}
