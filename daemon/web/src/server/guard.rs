//! What holds for every request: the name it asks for, the time it may take, and what browsers are told.

use std::sync::Arc;
use std::time::Duration;

use axum::Json;
use axum::extract::{Request, State};
use axum::http::StatusCode;
use axum::http::header::{
    CACHE_CONTROL, CONTENT_SECURITY_POLICY, HOST, HeaderName, HeaderValue, REFERRER_POLICY,
    X_CONTENT_TYPE_OPTIONS, X_FRAME_OPTIONS,
};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use serde_json::json;

use super::hall::Hall;

/// How long an answer may take; the stream's begins at once.
const PATIENCE: Duration = Duration::from_secs(10);

/// What is said to who asks for the page under another name; `hosts` is a key of the configuration.
const UNKNOWN_HOST: &str = "unknown host name: the page is served under names that the key `hosts` of the section [web] lists";

/// Scripts, styles and pictures come from here and nowhere else, and nobody puts the page in a frame.
const POLICY: &str = "default-src 'self'; base-uri 'none'; form-action 'none'; \
    frame-ancestors 'none'; object-src 'none'";

const HEADERS: [(HeaderName, HeaderValue); 5] = [
    (CONTENT_SECURITY_POLICY, HeaderValue::from_static(POLICY)),
    (X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff")),
    (X_FRAME_OPTIONS, HeaderValue::from_static("DENY")),
    (REFERRER_POLICY, HeaderValue::from_static("no-referrer")),
    (
        HeaderName::from_static("cross-origin-resource-policy"),
        HeaderValue::from_static("same-origin"),
    ),
];

/// Stands before every route.
pub(super) async fn guard(State(hall): State<Arc<Hall>>, request: Request, next: Next) -> Response {
    let mut response = if is_meant(&hall, &request) {
        let answer = tokio::time::timeout(PATIENCE, next.run(request)).await;
        answer.unwrap_or_else(|_| fault(StatusCode::REQUEST_TIMEOUT, "the request took too long"))
    } else {
        fault(StatusCode::MISDIRECTED_REQUEST, UNKNOWN_HOST)
    };
    let headers = response.headers_mut();
    headers.extend(HEADERS);
    headers.entry(CACHE_CONTROL).or_insert(HeaderValue::from_static("no-store"));
    response
}

/// Whether a request is for a name that the page may have: exactly one is told, and that of the line of
/// the request, if any, is as good.
fn is_meant(hall: &Hall, request: &Request) -> bool {
    let mut hosts = request.headers().get_all(HOST).iter();
    let (Some(host), None) = (hosts.next(), hosts.next()) else { return false };
    let known = |host: &str| hall.access.knows_host(host);
    host.to_str().is_ok_and(known) && request.uri().host().is_none_or(known)
}

/// An answer that says what is wrong.
pub(super) fn fault(status: StatusCode, text: &str) -> Response {
    (status, Json(json!({ "error": text }))).into_response()
}

/// There is nothing of that name.
pub(super) async fn not_found() -> Response {
    fault(StatusCode::NOT_FOUND, "there is nothing here; /api/v1/schema tells what there is")
}
