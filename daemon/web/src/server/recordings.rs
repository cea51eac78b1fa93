//! Raw recordings for who asks: which there are on this computer, and each as a file.

use std::sync::Arc;

use axum::Json;
use axum::body::{Body, Bytes};
use axum::extract::{Path as Asked, State};
use axum::http::StatusCode;
use axum::http::header::{CONTENT_DISPOSITION, CONTENT_LENGTH, CONTENT_TYPE};
use axum::response::{IntoResponse, Response};
use futures_util::stream::unfold;
use tokio::fs::File;
use tokio::io::{AsyncReadExt, Take};
use tokio::sync::OwnedSemaphorePermit;

use super::archive::is_name;
use super::guard::fault;
use super::hall::Hall;

/// Bytes that are read at once.
const CHUNK: usize = 64 * 1024;

/// Which there are, newest first.
pub(super) async fn list(State(hall): State<Arc<Hall>>) -> Response {
    let Some(own) = &hall.recordings else { return off() };
    match own.listed().await {
        Ok(files) => Json(files).into_response(),
        Err(error) => {
            let text = format!("the recordings cannot be listed: {error}");
            fault(StatusCode::INTERNAL_SERVER_ERROR, &text)
        }
    }
}

/// One of them, as long as it was when it was asked for.
pub(super) async fn fetch(State(hall): State<Arc<Hall>>, Asked(name): Asked<String>) -> Response {
    let Some(own) = &hall.recordings else { return off() };
    if !is_name(&name) {
        return fault(StatusCode::NOT_FOUND, "there is no such recording");
    }
    let Some(turn) = own.turn() else {
        let text = "other recordings are being fetched: one after the other";
        return fault(StatusCode::SERVICE_UNAVAILABLE, text);
    };
    match own.open(&name).await {
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
