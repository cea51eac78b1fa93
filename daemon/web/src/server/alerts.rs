//! The orders: what may be changed with a token.

use std::sync::Arc;

use axum::body::Bytes;
use axum::extract::{Extension, Path, State};
use axum::http::header::{RETRY_AFTER, WWW_AUTHENTICATE};
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use serde::de::DeserializeOwned;

use crate::orders::{Failure, PageOrder};

use super::accept::Peer;
use super::access::Denied;
use super::guard::fault;
use super::hall::Hall;
use crate::SECURITY;

/// Longest name of a berth, characters.
const LONGEST_NAME: usize = 200;
/// Longest filter of the journal, characters.
const LONGEST_LEVEL: usize = 200;

/// The body of an order about an alert; it may be left out.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct AlertBody {
    #[serde(default)]
    instance: Option<u32>,
}

/// The body of an order about the berth.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct BerthBody {
    name: Option<String>,
}

/// The body of an order about what is learnt.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct LearningBody {
    #[serde(rename = "use")]
    is_used: bool,
}

/// The body of an order about the journal.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct LevelBody {
    level: String,
}

pub(super) async fn acknowledge(
    State(hall): State<Arc<Hall>>,
    Extension(peer): Extension<Peer>,
    Path(id): Path<u32>,
    headers: HeaderMap,
    body: Bytes,
) -> Response {
    let order = || {
        let AlertBody { instance } = alert_body(&body)?;
        Ok(PageOrder::Acknowledge { id, instance })
    };
    give(&hall, &headers, peer, order).await
}

pub(super) async fn silence(
    State(hall): State<Arc<Hall>>,
    Extension(peer): Extension<Peer>,
    Path(id): Path<u32>,
    headers: HeaderMap,
    body: Bytes,
) -> Response {
    let order = || {
        let AlertBody { instance } = alert_body(&body)?;
        Ok(PageOrder::Silence { id, instance })
    };
    give(&hall, &headers, peer, order).await
}

pub(super) async fn log_level(
    State(hall): State<Arc<Hall>>,
    Extension(peer): Extension<Peer>,
    headers: HeaderMap,
    body: Bytes,
) -> Response {
    let order = || {
        let LevelBody { level } = parse(&body)?;
        let good = |c: char| c.is_ascii_alphanumeric() || "_:=,-".contains(c);
        if level.is_empty() || level.len() > LONGEST_LEVEL || !level.chars().all(good) {
            return Err("level: a level such as \"debug\", or a filter by module".to_owned());
        }
        Ok(PageOrder::LogLevel(level))
    };
    give(&hall, &headers, peer, order).await
}

pub(super) async fn berth(
    State(hall): State<Arc<Hall>>,
    Extension(peer): Extension<Peer>,
    headers: HeaderMap,
    body: Bytes,
) -> Response {
    let order = || {
        let BerthBody { name } = parse(&body)?;
        let good = |name: &String| !name.is_empty() && name.chars().count() <= LONGEST_NAME;
        if !name.as_ref().is_none_or(good) {
            return Err("name: the name of a berth, or null for the nearest".to_owned());
        }
        Ok(PageOrder::Berth(name))
    };
    give(&hall, &headers, peer, order).await
}

pub(super) async fn learning(
    State(hall): State<Arc<Hall>>,
    Extension(peer): Extension<Peer>,
    headers: HeaderMap,
    body: Bytes,
) -> Response {
    let order = || {
        let LearningBody { is_used } = parse(&body)?;
        Ok(PageOrder::UseLearnt(is_used))
    };
    give(&hall, &headers, peer, order).await
}

/// Whoever may not change anything is not told what is wrong with the order.
async fn give(
    hall: &Hall,
    headers: &HeaderMap,
    peer: Peer,
    order: impl FnOnce() -> Result<PageOrder, String>,
) -> Response {
    let host = peer.0.ip().to_canonical();
    if let Err(denied) = hall.access.check(headers, peer.0.ip()) {
        tracing::warn!(target: SECURITY, %host, why = denied.as_str(), "an order over the network is refused");
        return deny(denied, hall.access.read_only());
    }
    let order = match order() {
        Ok(order) => order,
        Err(text) => return fault(StatusCode::BAD_REQUEST, &text),
    };
    let words = order.to_string();
    let outcome = hall.orders.send(order).await;
    let obeyed = outcome.is_ok();
    tracing::info!(target: SECURITY, %host, order = words, obeyed, "an order over the network");
    match outcome {
        Ok(()) => StatusCode::NO_CONTENT.into_response(),
        Err(Failure::Refused(reason)) => fault(StatusCode::CONFLICT, &reason),
        Err(Failure::Busy) => fault(StatusCode::SERVICE_UNAVAILABLE, "too many orders wait"),
        Err(Failure::Silent) => fault(StatusCode::GATEWAY_TIMEOUT, "the navigator did not answer"),
    }
}

fn deny(denied: Denied, read_only: Option<&str>) -> Response {
    match denied {
        Denied::Disabled => {
            let why = read_only.unwrap_or_default();
            fault(StatusCode::FORBIDDEN, &format!("nothing can be changed here: {why}"))
        }
        Denied::WrongToken => {
            let text = "a token is needed: Authorization: Bearer TOKEN";
            ([(WWW_AUTHENTICATE, "Bearer")], fault(StatusCode::UNAUTHORIZED, text)).into_response()
        }
        Denied::TooMany => {
            let text = "too many wrong tokens from this address";
            ([(RETRY_AFTER, "60")], fault(StatusCode::TOO_MANY_REQUESTS, text)).into_response()
        }
    }
}

fn alert_body(body: &[u8]) -> Result<AlertBody, String> {
    if body.is_empty() { Ok(AlertBody::default()) } else { parse(body) }
}

fn parse<T: DeserializeOwned>(body: &[u8]) -> Result<T, String> {
    serde_json::from_slice(body).map_err(|fault| format!("the body: {fault}"))
}
