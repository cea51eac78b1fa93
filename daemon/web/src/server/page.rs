//! The page itself: files that are part of the program.

use std::fmt::Write as _;

use axum::body::Body;
use axum::extract::Path;
use axum::http::header::{CACHE_CONTROL, CONTENT_TYPE, ETAG, IF_NONE_MATCH};
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use rust_embed::RustEmbed;

use super::guard;

/// The files, by their names. They are looked up in a table, so no name leads anywhere else.
#[derive(RustEmbed)]
#[folder = "assets"]
struct Assets;

pub(super) async fn index(headers: HeaderMap) -> Response {
    file("index.html", &headers)
}

pub(super) async fn fleet(headers: HeaderMap) -> Response {
    file("fleet.html", &headers)
}

pub(super) async fn icon(headers: HeaderMap) -> Response {
    file("icon.svg", &headers)
}

pub(super) async fn asset(Path(name): Path<String>, headers: HeaderMap) -> Response {
    file(&name, &headers)
}

/// Browsers keep the files and ask each time whether they are still the same: after an upgrade of the
/// program they are not.
fn file(name: &str, headers: &HeaderMap) -> Response {
    let (Some(kind), Some(file)) = (kind(name), Assets::get(name)) else {
        return guard::fault(StatusCode::NOT_FOUND, "there is no such file");
    };
    let tag = tag(&file.metadata.sha256_hash());
    let known = headers.get(IF_NONE_MATCH).is_some_and(|known| known.as_bytes() == tag.as_bytes());
    let head = [(CONTENT_TYPE, kind), (CACHE_CONTROL, "no-cache"), (ETAG, tag.as_str())];
    if known {
        return (StatusCode::NOT_MODIFIED, head).into_response();
    }
    (head, Body::from(file.data)).into_response()
}

fn kind(name: &str) -> Option<&'static str> {
    match name.rsplit_once('.')?.1 {
        "html" => Some("text/html; charset=utf-8"),
        "css" => Some("text/css; charset=utf-8"),
        "js" => Some("text/javascript; charset=utf-8"),
        "svg" => Some("image/svg+xml"),
        _ => None,
    }
}

fn tag(hash: &[u8; 32]) -> String {
    let mut tag = String::from('"');
    for byte in hash.iter().take(12) {
        // writing to a String cannot fail
        let _ = write!(tag, "{byte:02x}");
    }
    tag + "\""
}
