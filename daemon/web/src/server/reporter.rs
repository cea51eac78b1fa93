//! Who makes reports of raw recordings: another process, which gives way to the navigator in everything.

use std::ffi::OsStr;
use std::fs::DirBuilder;
use std::num::NonZeroU32;
use std::os::unix::fs::DirBuilderExt;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use insd_languages::Language;
use tempfile::TempDir;
use tokio::process::Command;

/// How long a report may be in the making: one of a day takes a few minutes.
const PATIENCE: Duration = Duration::from_secs(1800);
/// A report of a recording that has grown since is told as long as this; then it is made anew.
const STANDS: Duration = Duration::from_secs(600);

/// Of what, in which language.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Subject {
    pub(super) name: String,
    /// Of a recording that spans restarts of the program: which run, from 1.
    pub(super) run: NonZeroU32,
    pub(super) language: Language,
}

/// The last one that was asked for.
#[derive(Debug)]
struct Last {
    subject: Subject,
    /// How long the recording was.
    bytes: u64,
    /// What became of it; nothing while it is made.
    outcome: Option<Result<PathBuf, String>>,
}

/// Who makes reports, one after the other, and the last one.
#[derive(Debug)]
pub(super) struct Reports {
    program: PathBuf,
    folder: TempDir,
    last: Arc<Mutex<Option<Last>>>,
}

/// What is said to who asks.
pub(super) enum Answer {
    Made(PathBuf),
    BeingMade,
    AnotherIsBeingMade,
    Failed(String),
}

impl Reports {
    /// Made by `PROGRAM report`; `None` where there is no folder for them.
    pub(super) fn by(program: PathBuf) -> Option<Self> {
        let folder = tempfile::Builder::new().prefix("insd-reports").tempdir();
        let folder =
            folder.inspect_err(|fault| tracing::warn!(%fault, "no reports: no folder for them"));
        Some(Reports { program, folder: folder.ok()?, last: Arc::new(Mutex::new(None)) })
    }

    /// What there is of a report; it is begun if nothing else is in the making. One that has failed is told once.
    pub(super) fn ask(&self, subject: Subject, recording: &Path, bytes: u64) -> Answer {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(answer) = last.as_ref().and_then(|own| own.answer(&subject, bytes)) {
            last.take_if(|_| matches!(answer, Answer::Failed(_)));
            return answer;
        }
        let (order, out) = self.order(&subject, recording);
        *last = Some(Last { subject, bytes, outcome: None });
        let told = Arc::clone(&self.last);
        tokio::spawn(async move {
            let outcome = carry_out(order, out).await;
            if let Some(own) = told.lock().unwrap_or_else(PoisonError::into_inner).as_mut() {
                own.outcome = Some(outcome);
            }
        });
        Answer::BeingMade
    }

    /// The order, and where the report will be. What this process was told by its environment is nothing to the other.
    fn order(&self, subject: &Subject, recording: &Path) -> (Command, PathBuf) {
        self.renew_folder();
        let out = self.folder.path().join("report.html");
        let mut order = Command::new(&self.program);
        let (language, run) = (subject.language.code(), subject.run.to_string());
        let of_whom = ["--language", language, "--run", &run, "--out"];
        order
            .args(["report", "--background"])
            .args(of_whom.map(OsStr::new))
            .args([out.as_os_str(), OsStr::new("--"), recording.as_os_str()])
            .env_clear()
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .kill_on_drop(true);
        (order, out)
    }

    /// Whoever tidies up temporary files may have taken the folder. Where it cannot be made the report says so.
    fn renew_folder(&self) {
        let made = DirBuilder::new().recursive(true).mode(0o700).create(self.folder.path());
        if let Err(fault) = made {
            tracing::warn!(%fault, "no folder for reports");
        }
    }
}

impl Last {
    /// What it tells who asks for a report of a recording that is so long now; nothing if that is to be made.
    fn answer(&self, subject: &Subject, bytes: u64) -> Option<Answer> {
        let is_it = self.subject == *subject;
        match &self.outcome {
            None if is_it => Some(Answer::BeingMade),
            None => Some(Answer::AnotherIsBeingMade),
            Some(Ok(made)) => {
                let stands = made.is_file() && (self.bytes == bytes || is_recent(made));
                (is_it && stands).then(|| Answer::Made(made.clone()))
            }
            Some(Err(why)) => is_it.then(|| Answer::Failed(why.clone())),
        }
    }
}

/// Whether a report stands for a recording that has grown since.
fn is_recent(made: &Path) -> bool {
    let written = made.metadata().and_then(|told| told.modified()).ok();
    written.and_then(|at| at.elapsed().ok()).is_some_and(|age| age < STANDS)
}

async fn carry_out(mut order: Command, out: PathBuf) -> Result<PathBuf, String> {
    let ended = tokio::time::timeout(PATIENCE, order.output()).await;
    let output = ended.map_err(|_| "it took too long".to_owned())?;
    let output = output.map_err(|error| error.to_string())?;
    if output.status.success() {
        return Ok(out);
    }
    let said = String::from_utf8_lossy(&output.stderr);
    let last = said.lines().rev().map(str::trim).find(|line| !line.is_empty());
    Err(last.map_or_else(|| output.status.to_string(), str::to_owned))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reports_whose_folder_was_tidied_away_are_made_again() {
        let reports = Reports::by(PathBuf::from("insd")).unwrap();
        let folder = reports.folder.path();
        std::fs::remove_dir(folder).unwrap();
        let run = NonZeroU32::MIN;
        let subject = Subject { name: "today".to_owned(), run, language: Language::English };
        let (_, out) = reports.order(&subject, Path::new("today.insdraw"));
        assert!(folder.is_dir());
        std::fs::write(&out, "a report").unwrap();
        let outcome = Some(Ok(out.clone()));
        let last = Last { subject: subject.clone(), bytes: 5, outcome };
        assert!(matches!(last.answer(&subject, 5), Some(Answer::Made(_))));
        std::fs::remove_file(out).unwrap();
        assert!(last.answer(&subject, 5).is_none());
    }
}
