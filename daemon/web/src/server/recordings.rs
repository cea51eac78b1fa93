//! Raw recordings: which there are on this computer, and each as a file.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::UNIX_EPOCH;

use axum::Json;
use axum::body::{Body, Bytes};
use axum::extract::{Path as Asked, State};
use axum::http::StatusCode;
use axum::http::header::{CONTENT_DISPOSITION, CONTENT_LENGTH, CONTENT_TYPE};
use axum::response::{IntoResponse, Response};
use futures_util::stream::unfold;
use serde::Serialize;
use tokio::fs::File;
use tokio::io::{AsyncReadExt, Take};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};

use super::guard::fault;
use super::hall::Hall;

/// How the names of recordings end.
const ENDING: &str = ".insdraw";
/// Most that are listed, the newest.
const LISTED: usize = 1000;
/// Bytes that are read at once.
const CHUNK: usize = 64 * 1024;
/// Most that are fetched at a time: the disk is there for recording.
const AT_ONCE: usize = 2;

/// Where they lie.
#[derive(Debug)]
pub(super) struct Recordings {
    folder: PathBuf,
    turns: Arc<Semaphore>,
}

/// One of them.
#[derive(Debug, PartialEq, Serialize)]
struct Listed {
    name: String,
    bytes: u64,
    /// When it was written last, s since 1970.
    written_s: Option<u64>,
}

impl Recordings {
    pub(super) fn of(folder: PathBuf) -> Self {
        Recordings { folder, turns: Arc::new(Semaphore::new(AT_ONCE)) }
    }
}

/// Which there are, newest first.
pub(super) async fn list(State(hall): State<Arc<Hall>>) -> Response {
    let Some(own) = &hall.recordings else { return off() };
    match listed(&own.folder).await {
        Ok(files) => Json(files).into_response(),
        Err(error) => {
            let text = format!("the recordings cannot be listed: {error}");
            fault(StatusCode::INTERNAL_SERVER_ERROR, &text)
        }
    }
}

async fn listed(folder: &Path) -> io::Result<Vec<Listed>> {
    let mut files = Vec::new();
    let mut entries = tokio::fs::read_dir(folder).await?;
    while let Some(entry) = entries.next_entry().await? {
        let Some(name) = entry.file_name().to_str().filter(|name| is_name(name)).map(str::to_owned)
        else {
            continue;
        };
        // one may go while it is looked at
        let Ok(told) = entry.metadata().await else { continue };
        let since = told.modified().ok().and_then(|at| at.duration_since(UNIX_EPOCH).ok());
        let written_s = since.map(|since| since.as_secs());
        if told.is_file() {
            files.push(Listed { name, bytes: told.len(), written_s });
        }
    }
    files.sort_by(|one, other| (other.written_s, &other.name).cmp(&(one.written_s, &one.name)));
    files.truncate(LISTED);
    Ok(files)
}

/// Whether it is the name of a recording, and nothing but a name.
fn is_name(name: &str) -> bool {
    let sound = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
    name.ends_with(ENDING) && !name.starts_with('.') && name.chars().all(sound)
}

/// One of them, as long as it was when it was asked for.
pub(super) async fn fetch(State(hall): State<Arc<Hall>>, Asked(name): Asked<String>) -> Response {
    let Some(own) = &hall.recordings else { return off() };
    if !is_name(&name) {
        return fault(StatusCode::NOT_FOUND, "there is no such recording");
    }
    let Ok(turn) = Arc::clone(&own.turns).try_acquire_owned() else {
        let text = "other recordings are being fetched: one after the other";
        return fault(StatusCode::SERVICE_UNAVAILABLE, text);
    };
    match open(&own.folder.join(&name)).await {
        Ok((file, length)) => {
            let kind = "application/octet-stream".to_owned();
            let saved = format!("attachment; filename=\"{name}\"");
            let head = [
                (CONTENT_TYPE, kind),
                (CONTENT_LENGTH, length.to_string()),
                (CONTENT_DISPOSITION, saved),
            ];
            (head, body(file.take(length), turn)).into_response()
        }
        Err(_) => fault(StatusCode::NOT_FOUND, "there is no such recording"),
    }
}

/// Nothing but an ordinary file is opened, and no link to one.
async fn open(path: &Path) -> io::Result<(File, u64)> {
    if !tokio::fs::symlink_metadata(path).await?.is_file() {
        return Err(io::ErrorKind::NotFound.into());
    }
    let file = File::open(path).await?;
    let length = file.metadata().await?.len();
    Ok((file, length))
}

/// A file piece by piece; its turn is over when it is read, or nobody wants more of it.
fn body(file: Take<File>, turn: OwnedSemaphorePermit) -> Body {
    Body::from_stream(unfold((file, turn), |(mut file, turn)| async {
        let mut piece = vec![0; CHUNK];
        match file.read(&mut piece).await {
            Ok(0) => None,
            Ok(length) => {
                piece.truncate(length);
                Some((Ok(Bytes::from(piece)), (file, turn)))
            }
            Err(error) => Some((Err(error), (file, turn))),
        }
    }))
}

fn off() -> Response {
    fault(StatusCode::NOT_FOUND, "nothing is recorded: there is no section [recording]")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_leads_nowhere_else() {
        assert!(is_name("insd-000001.insdraw"));
        for name in
            ["../insd-000001.insdraw", ".insdraw", "a/b.insdraw", "insd.toml", "a\"b.insdraw"]
        {
            assert!(!is_name(name), "{name}");
        }
    }

    #[test]
    fn the_newest_is_listed_first_and_nothing_but_recordings() {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in
            [("insd-000001.insdraw", "one"), ("insd-000002.insdraw", "two!"), ("token", "secret")]
        {
            std::fs::write(folder.path().join(name), text).unwrap();
        }
        std::fs::create_dir(folder.path().join("folder.insdraw")).unwrap();
        std::os::unix::fs::symlink("token", folder.path().join("link.insdraw")).unwrap();
        let runtime = tokio::runtime::Builder::new_current_thread().build().unwrap();
        let files = runtime.block_on(listed(folder.path())).unwrap();
        let told: Vec<(&str, u64)> =
            files.iter().map(|own| (own.name.as_str(), own.bytes)).collect();
        assert_eq!(told, [("insd-000002.insdraw", 4), ("insd-000001.insdraw", 3)]);
        assert!(files.iter().all(|own| own.written_s.is_some()));
        assert!(runtime.block_on(open(&folder.path().join("link.insdraw"))).is_err());
    }
}
