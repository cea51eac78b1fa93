//! Reports of raw recordings, made by another process that gives way to the navigator in everything.

use std::ffi::OsStr;
use std::num::NonZeroU32;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use axum::Json;
use axum::extract::{Path as Asked, Query, State};
use axum::http::StatusCode;
use axum::http::header::{CONTENT_SECURITY_POLICY, CONTENT_TYPE};
use axum::response::{IntoResponse, Response};
use insd_languages::Language;
use serde::Deserialize;
use serde_json::json;
use tempfile::TempDir;
use tokio::process::Command;
use tokio::time::Instant;

use super::archive::{Recordings, is_name};
use super::guard::fault;
use super::hall::Hall;

/// How long a report may be in the making: one of a day takes a few minutes.
const PATIENCE: Duration = Duration::from_secs(1800);
/// A report brings its styles with it, asks nobody for anything and runs nothing.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; \
    base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// A report of a recording that has grown since is told as long as this; then it is made anew.
const STANDS: Duration = Duration::from_secs(600);

/// Of what, in which language.
#[derive(Clone, Debug, PartialEq)]
struct Subject {
    name: String,
    /// Of a recording that spans restarts of the program: which run, from 1.
    run: NonZeroU32,
    language: Language,
}

/// The last one that was asked for.
#[derive(Debug)]
struct Last {
    subject: Subject,
    /// How long the recording was.
    bytes: u64,
    begun: Instant,
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
enum Answer {
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
    fn ask(&self, subject: Subject, recording: &Path, bytes: u64) -> Answer {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(answer) = last.as_ref().and_then(|own| own.answer(&subject, bytes)) {
            last.take_if(|_| matches!(answer, Answer::Failed(_)));
            return answer;
        }
        let (order, out) = self.order(&subject, recording);
        *last = Some(Last { subject, bytes, begun: Instant::now(), outcome: None });
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
}

impl Last {
    /// What it tells who asks for a report of a recording that is so long now; nothing if that is to be made.
    fn answer(&self, subject: &Subject, bytes: u64) -> Option<Answer> {
        let is_it = self.subject == *subject;
        match &self.outcome {
            None if is_it => Some(Answer::BeingMade),
            None => Some(Answer::AnotherIsBeingMade),
            Some(Ok(made)) => {
                let stands = self.bytes == bytes || self.begun.elapsed() < STANDS;
                (is_it && stands).then(|| Answer::Made(made.clone()))
            }
            Some(Err(why)) => is_it.then(|| Answer::Failed(why.clone())),
        }
    }
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

/// What may be asked for.
#[derive(Debug, Deserialize)]
pub(super) struct Wish {
    language: Option<String>,
    run: Option<NonZeroU32>,
}

/// The report of a recording; begins it, and says so, where there is none yet.
pub(super) async fn report(
    State(hall): State<Arc<Hall>>,
    Asked(name): Asked<String>,
    Query(wish): Query<Wish>,
) -> Response {
    let Some((own, reports)) = hall.recordings.as_ref().zip(hall.reports.as_ref()) else {
        return fault(StatusCode::NOT_FOUND, "no reports are made here");
    };
    let asked = wish.language.map(|code| code.parse()).transpose();
    let Ok(language) = asked.map(|asked| asked.unwrap_or(hall.language)) else {
        return fault(StatusCode::BAD_REQUEST, "there is no such language");
    };
    let Some(bytes) = length(own, &name).await else {
        return fault(StatusCode::NOT_FOUND, "there is no such recording");
    };
    let recording = own.path(&name);
    let subject = Subject { name, run: wish.run.unwrap_or(NonZeroU32::MIN), language };
    match reports.ask(subject, &recording, bytes) {
        Answer::Made(made) => page(&made).await,
        Answer::BeingMade => {
            (StatusCode::ACCEPTED, Json(json!({ "state": "being_made" }))).into_response()
        }
        Answer::AnotherIsBeingMade => {
            let text = "another report is being made: one after the other";
            fault(StatusCode::SERVICE_UNAVAILABLE, text)
        }
        Answer::Failed(why) => {
            let text = format!("the report cannot be made: {why}");
            fault(StatusCode::INTERNAL_SERVER_ERROR, &text)
        }
    }
}

async fn length(own: &Recordings, name: &str) -> Option<u64> {
    if !is_name(name) {
        return None;
    }
    own.open(name).await.ok().map(|(_, length)| length)
}

async fn page(made: &Path) -> Response {
    match tokio::fs::read(made).await {
        Ok(text) => {
            let head = [
                (CONTENT_TYPE, "text/html; charset=utf-8"),
                (CONTENT_SECURITY_POLICY, POLICY),
            ];
            (head, text).into_response()
        }
        Err(error) => {
            let text = format!("the report cannot be made: {error}");
            fault(StatusCode::INTERNAL_SERVER_ERROR, &text)
        }
    }
}
