//! The picture of what a camera sees. Its front end writes it, a process of its own; here it is only handed on, to who asks.

use std::io::{self, ErrorKind};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use axum::body::Body;
use axum::extract::State;
use axum::http::StatusCode;
use axum::http::header::CONTENT_TYPE;
use axum::response::{IntoResponse, Response};
use tokio::io::AsyncReadExt;

use super::guard::fault;
use super::hall::Hall;

/// Longest picture that is handed on, bytes.
const MAX_PICTURE: u64 = 4 << 20;
/// A picture that was written so long ago shows nothing of now.
const STALE: Duration = Duration::from_secs(30);

/// What a file begins with, and what it is then.
const KINDS: [(&[u8], &str); 2] =
    [(b"\x89PNG\r\n\x1a\n", "image/png"), (b"\xff\xd8\xff", "image/jpeg")];

/// Why there is no picture.
enum NoPicture {
    Stale,
    TooLong,
    NotOne,
    Unread(io::Error),
}

pub(super) async fn picture(State(hall): State<Arc<Hall>>) -> Response {
    let Some(path) = &hall.picture else {
        let text = "no picture: the key `picture` of the section [camera] names none";
        return fault(StatusCode::NOT_FOUND, text);
    };
    match read(path).await {
        Ok((kind, bytes)) => ([(CONTENT_TYPE, kind)], Body::from(bytes)).into_response(),
        Err(why) => fault(StatusCode::NOT_FOUND, &why.text()),
    }
}

/// The picture and what it is. Nothing but an ordinary file is read: opening a pipe would wait for its writer.
async fn read(path: &Path) -> Result<(&'static str, Vec<u8>), NoPicture> {
    if !tokio::fs::metadata(path).await?.is_file() {
        return Err(NoPicture::NotOne);
    }
    let file = tokio::fs::File::open(path).await?;
    let written = file.metadata().await?.modified()?;
    if written.elapsed().is_ok_and(|age| age > STALE) {
        return Err(NoPicture::Stale);
    }
    let mut bytes = Vec::new();
    file.take(MAX_PICTURE + 1).read_to_end(&mut bytes).await?;
    if bytes.len() as u64 > MAX_PICTURE {
        return Err(NoPicture::TooLong);
    }
    let kind = KINDS.iter().find(|(head, _)| bytes.starts_with(head));
    kind.map(|(_, kind)| (*kind, bytes)).ok_or(NoPicture::NotOne)
}

impl From<io::Error> for NoPicture {
    fn from(fault: io::Error) -> Self {
        NoPicture::Unread(fault)
    }
}

impl NoPicture {
    fn text(&self) -> String {
        match self {
            NoPicture::Stale => {
                "the picture is older than 30 s: the front end of the camera writes no more"
                    .to_owned()
            }
            NoPicture::TooLong => "the picture is longer than 4 MB".to_owned(),
            NoPicture::NotOne => "the file is neither PNG nor JPEG".to_owned(),
            NoPicture::Unread(fault) if fault.kind() == ErrorKind::NotFound => {
                "there is no picture yet: the front end of the camera has written none".to_owned()
            }
            NoPicture::Unread(fault) => format!("the picture cannot be read: {fault}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PNG: &[u8] = b"\x89PNG\r\n\x1a\nand so on";

    fn read_of(path: &Path) -> Result<(&'static str, Vec<u8>), String> {
        let runtime = tokio::runtime::Builder::new_current_thread().build().unwrap();
        runtime.block_on(read(path)).map_err(|why| why.text())
    }

    #[test]
    fn a_picture_is_handed_on_as_it_is() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("seen.png");
        std::fs::write(&path, PNG).unwrap();
        assert_eq!(read_of(&path), Ok(("image/png", PNG.to_vec())));
    }

    #[test]
    fn what_is_no_picture_is_not_handed_on() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("seen.png");
        assert!(read_of(&path).unwrap_err().contains("has written none"));
        assert!(read_of(folder.path()).unwrap_err().contains("neither PNG nor JPEG"));
        std::fs::write(&path, "token = \"secret\"").unwrap();
        assert!(read_of(&path).unwrap_err().contains("neither PNG nor JPEG"));
        std::fs::write(&path, [PNG, &[0; 4 << 20]].concat()).unwrap();
        assert!(read_of(&path).unwrap_err().contains("longer than"));
    }

    #[test]
    fn a_picture_of_long_ago_is_none_of_now() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("seen.png");
        std::fs::write(&path, PNG).unwrap();
        let file = std::fs::File::options().write(true).open(&path).unwrap();
        let written = file.metadata().unwrap().modified().unwrap();
        file.set_modified(written - Duration::from_secs(40)).unwrap();
        assert!(read_of(&path).unwrap_err().contains("older than 30 s"));
    }
}
