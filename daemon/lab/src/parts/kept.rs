//! The file of runs: JSON, a line for what the campaign is (one for each variation of a sweep) and a line for each voyage.
//!
//! A line is written at once when its voyage is done, so that a job that is killed loses no more than the voyages it was at.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{BufRead as _, BufReader, Write as _};
use std::path::{Path, PathBuf};

use insd_config::BadInput;
use serde::{Deserialize, Serialize};

use super::declaration::CampaignDeclaration;

/// One line. Its own names come first, so that people can read it.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Line<D, R> {
    /// What the campaign is.
    Campaign {
        /// One variation of it.
        campaign: D,
    },
    /// A voyage.
    Run {
        /// Of which campaign.
        id: String,
        /// Its scores.
        run: R,
    },
}

/// What stands in a file of runs.
pub struct KeptRuns<D: CampaignDeclaration> {
    /// What the campaign is, one for each variation.
    pub declared: Vec<D>,
    /// The line and the run of each key, by the campaign's id.
    pub(super) runs: BTreeMap<String, RunsByKey<D>>,
}

/// Line and run by key.
pub(super) type RunsByKey<D> =
    BTreeMap<<D as CampaignDeclaration>::Key, (usize, <D as CampaignDeclaration>::Run)>;

impl<D: CampaignDeclaration> Default for KeptRuns<D> {
    fn default() -> Self {
        KeptRuns { declared: Vec::new(), runs: BTreeMap::new() }
    }
}

impl<D: CampaignDeclaration> KeptRuns<D> {
    /// Reads a file.
    ///
    /// # Errors
    /// What is wrong with it, with file and line.
    pub(super) fn read(path: &Path) -> anyhow::Result<Self> {
        let file =
            File::open(path).map_err(|fault| BadInput(format!("{}: {fault}", path.display())))?;
        let mut kept = KeptRuns::default();
        for (index, line) in BufReader::new(file).lines().enumerate() {
            let said = line
                .map_err(|fault| fault.to_string())
                .and_then(|line| kept.take(index + 1, &line));
            said.map_err(|fault| BadInput(format!("{}:{}: {fault}", path.display(), index + 1)))?;
        }
        Ok(kept)
    }

    fn take(&mut self, number: usize, line: &str) -> Result<(), String> {
        let read = serde_json::from_str::<Line<D, D::Run>>(line);
        match read.map_err(|fault| format!("no line of a campaign's runs: {fault}"))? {
            Line::Campaign { campaign } if self.declared.contains(&campaign) => Ok(()),
            Line::Campaign { campaign } => {
                self.declared.push(campaign);
                Ok(())
            }
            Line::Run { id, run } => self.take_run(number, id, run),
        }
    }

    fn take_run(&mut self, number: usize, id: String, run: D::Run) -> Result<(), String> {
        let key = D::key_of(&run);
        let of = self.declared.iter().find(|declared| declared.id() == id);
        let of = of.ok_or_else(|| format!("no line before it says what campaign {id} is"))?;
        if !of.has_key(&key) {
            return Err(format!("{} {key} is not one of {}", D::KEY, of.range()));
        }
        match self.runs.entry(id).or_default().insert(key.clone(), (number, run)) {
            None => Ok(()),
            Some((before, _)) => Err(format!("{} {key} stands in line {before} already", D::KEY)),
        }
    }

    /// Whether a run of a variation is there.
    pub fn has(&self, of: &D, key: &D::Key) -> bool {
        self.runs.get(of.id()).is_some_and(|runs| runs.contains_key(key))
    }

    /// Adds a run that was just sailed.
    pub(super) fn add(&mut self, of: &D, run: D::Run) {
        self.runs.entry(of.id().to_owned()).or_default().insert(D::key_of(&run), (0, run));
    }

    /// The runs of a variation, in the order of its keys.
    pub fn take_runs(&mut self, of: &D) -> Vec<D::Run> {
        let mut runs = self.runs.remove(of.id()).unwrap_or_default();
        of.keys().iter().filter_map(|key| Some(runs.remove(key)?.1)).collect()
    }
}

/// A file of runs that is written to.
#[derive(Debug)]
pub(super) struct Keeper {
    path: PathBuf,
    file: File,
}

impl Keeper {
    /// Makes a file and says what the campaign is.
    ///
    /// # Errors
    /// It is there already, or cannot be written.
    pub(super) fn create<D: CampaignDeclaration>(
        path: &Path,
        declared: &[D],
    ) -> anyhow::Result<Self> {
        let made = OpenOptions::new().append(true).create_new(true).open(path);
        let file = made.map_err(|fault| match fault.kind() {
            std::io::ErrorKind::AlreadyExists => {
                BadInput(format!("{} is there already: --resume goes on with it", path.display()))
            }
            _ => BadInput(format!("{}: {fault}", path.display())),
        })?;
        let mut keeper = Keeper { path: path.to_owned(), file };
        keeper.lock()?;
        declared.iter().try_for_each(|declared| keeper.declare(declared))?;
        Ok(keeper)
    }

    /// Goes on with a file; makes it if there is none. A last line that was cut off is taken away and told.
    ///
    /// # Errors
    /// It is not of this campaign, somebody else writes to it, or it cannot be read or written.
    pub(super) fn resume<D: CampaignDeclaration>(
        path: &Path,
        declared: &[D],
    ) -> anyhow::Result<(Self, KeptRuns<D>)> {
        if !path.exists() {
            return Ok((Self::create(path, declared)?, KeptRuns::default()));
        }
        let opened = OpenOptions::new().read(true).append(true).open(path);
        let file = opened.map_err(|fault| BadInput(format!("{}: {fault}", path.display())))?;
        let mut keeper = Keeper { path: path.to_owned(), file };
        keeper.lock()?;
        keeper.drop_torn_line()?;
        let kept = KeptRuns::<D>::read(path)?;
        for own in declared {
            match kept.declared.iter().find(|there| there.is_counterpart_of(own)) {
                Some(there) => own.is_same(there, "this campaign", &path.display().to_string())?,
                None => keeper.declare(own)?,
            }
        }
        Ok((keeper, kept))
    }

    fn lock(&self) -> anyhow::Result<()> {
        match self.file.try_lock() {
            Ok(()) => Ok(()),
            Err(TryLockError::WouldBlock) => {
                let path = self.path.display();
                Err(BadInput(format!("{path}: another campaign writes to it")).into())
            }
            // a file system without locks is no reason not to write
            Err(TryLockError::Error(_)) => Ok(()),
        }
    }

    fn drop_torn_line(&self) -> anyhow::Result<()> {
        let content = std::fs::read(&self.path)?;
        let whole = content.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
        if whole < content.len() {
            eprintln!("{}: the last line was cut off and is left out", self.path.display());
            self.file.set_len(whole as u64)?;
        }
        Ok(())
    }

    fn declare<D: CampaignDeclaration>(&mut self, declared: &D) -> anyhow::Result<()> {
        self.write(&Line::<D, D::Run>::Campaign { campaign: declared.clone() })
    }

    /// Writes a run.
    ///
    /// # Errors
    /// The file cannot be written.
    pub(super) fn keep<D: CampaignDeclaration>(
        &mut self,
        of: &D,
        run: &D::Run,
    ) -> anyhow::Result<()> {
        self.write(&Line::<D, D::Run>::Run { id: of.id().to_owned(), run: run.clone() })
    }

    /// Writes all runs, in the order of variations and their keys.
    ///
    /// # Errors
    /// The file cannot be written.
    pub(super) fn keep_all<D: CampaignDeclaration>(
        &mut self,
        kept: &KeptRuns<D>,
    ) -> anyhow::Result<()> {
        for declared in &kept.declared {
            let runs = kept.runs.get(declared.id());
            let keys = declared.keys();
            let runs = keys.iter().filter_map(|key| runs?.get(key));
            runs.map(|(_, run)| run).try_for_each(|run| self.keep(declared, run))?;
        }
        Ok(())
    }

    fn write(&mut self, line: &impl Serialize) -> anyhow::Result<()> {
        let text = serde_json::to_string(line)? + "\n";
        let written = self.file.write_all(text.as_bytes()).and_then(|()| self.file.flush());
        written.map_err(|fault| anyhow::anyhow!("{}: {fault}", self.path.display()))
    }
}
