//! Reports of raw recordings for who asks.

use std::num::NonZeroU32;
use std::path::Path;
use std::sync::Arc;

use axum::Json;
use axum::extract::{Path as Asked, Query, State};
use axum::http::StatusCode;
use axum::http::header::{CONTENT_SECURITY_POLICY, CONTENT_TYPE};
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use serde_json::json;

use super::archive::{Recordings, is_name};
use super::guard::fault;
use super::hall::Hall;
use super::reporter::{Answer, Subject};

/// A report brings its styles with it, asks nobody for anything and runs nothing.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; \
    base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

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
        Answer::Failed(why) => failed(&why),
    }
}

fn failed(why: &str) -> Response {
    fault(StatusCode::INTERNAL_SERVER_ERROR, &format!("the report cannot be made: {why}"))
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
            let head =
                [(CONTENT_TYPE, "text/html; charset=utf-8"), (CONTENT_SECURITY_POLICY, POLICY)];
            (head, text).into_response()
        }
        Err(error) => failed(&error.to_string()),
    }
}
