//! The texts of the page, in each language.

use std::collections::BTreeMap;
use std::sync::Arc;

use axum::Json;
use axum::extract::{Path, State};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use insd_languages::Language;
use serde_json::json;

use super::guard::fault;
use super::hall::Hall;

/// Groups of texts that are not of the page.
const ELSEWHERE: [&str; 2] = ["report.", "check."];

/// The languages that there are, and the configured one.
pub(super) async fn languages(State(hall): State<Arc<Hall>>) -> Response {
    let told = |own: Language| json!({ "code": own.code(), "name": own.name() });
    let languages = Language::ALL.map(told);
    Json(json!({ "configured": hall.language.code(), "languages": languages })).into_response()
}

/// All texts of a language by key.
pub(super) async fn texts(Path(code): Path<String>) -> Response {
    let Ok(language) = code.parse::<Language>() else {
        return fault(StatusCode::NOT_FOUND, "there is no such language");
    };
    let is_own = |key: &str| !ELSEWHERE.iter().any(|group| key.starts_with(group));
    let texts = language.catalogue().texts().filter(|(key, _)| is_own(key));
    Json(texts.collect::<BTreeMap<_, _>>()).into_response()
}
