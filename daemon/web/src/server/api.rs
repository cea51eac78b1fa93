//! What programs ask for: the snapshot, the past, metrics, and whether the engine is alive.

use std::sync::Arc;
use std::sync::atomic::Ordering;

use axum::Json;
use axum::body::{Body, Bytes};
use axum::extract::{Query, State};
use axum::http::StatusCode;
use axum::http::header::CONTENT_TYPE;
use axum::response::{IntoResponse, Response};

use serde::Deserialize;
use serde_json::json;

use super::guard::fault;
use super::hall::Hall;

const JSON: &str = "application/json";
const TEXT: &str = "text/plain; charset=utf-8";
const OPENMETRICS: &str = "application/openmetrics-text; version=1.0.0; charset=utf-8";

/// The description of the interface, which is a page of the documentation.
const SCHEMA: &str = include_str!("../../../../docs/api.md");

pub(super) async fn status(State(hall): State<Arc<Hall>>) -> Response {
    hall.latest().map_or_else(nothing_yet, |frame| body(JSON, frame.json()))
}

pub(super) async fn track(State(hall): State<Arc<Hall>>) -> Response {
    body(JSON, hall.track())
}

/// Which history is asked for: `step` is the time between its rows, s.
#[derive(Debug, Deserialize)]
pub(super) struct Past {
    step: Option<u32>,
}

pub(super) async fn history(State(hall): State<Arc<Hall>>, Query(past): Query<Past>) -> Response {
    match past.step {
        None | Some(1) => body(JSON, hall.history(false)),
        Some(10) => body(JSON, hall.history(true)),
        Some(_) => fault(StatusCode::BAD_REQUEST, "step: 1 or 10"),
    }
}

/// Whether anything can be changed here, with a token, and why not.
pub(super) async fn orders(State(hall): State<Arc<Hall>>) -> Response {
    let why = hall.access.read_only();
    Json(json!({ "enabled": why.is_none(), "why": why })).into_response()
}

pub(super) async fn schema() -> Response {
    ([(CONTENT_TYPE, "text/markdown; charset=utf-8")], SCHEMA).into_response()
}

/// Metrics of the last snapshot, and of the page itself.
pub(super) async fn metrics(State(hall): State<Arc<Hall>>) -> Response {
    let Some(frame) = hall.latest() else { return nothing_yet() };
    let own = super::metrics::of_the_page(hall.is_alive(), hall.clients.load(Ordering::Relaxed));
    let all = [frame.metrics().as_ref(), own.as_bytes()].concat();
    body(OPENMETRICS, all.into())
}

/// 200 only while the engine publishes.
pub(super) async fn health(State(hall): State<Arc<Hall>>) -> Response {
    let head = [(CONTENT_TYPE, TEXT)];
    if hall.is_alive() {
        return (head, "ok\n").into_response();
    }
    let text = "the navigator has published nothing for 2 s\n";
    (StatusCode::SERVICE_UNAVAILABLE, head, text).into_response()
}

fn body(kind: &'static str, bytes: Bytes) -> Response {
    ([(CONTENT_TYPE, kind)], Body::from(bytes)).into_response()
}

fn nothing_yet() -> Response {
    fault(StatusCode::SERVICE_UNAVAILABLE, "the navigator has published nothing yet")
}
