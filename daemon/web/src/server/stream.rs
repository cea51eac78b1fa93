//! Server-sent events: `snapshot` at the start, once a second and when a state changes, `live` in between.
//!
//! A client is handed the newest whenever it has taken the one before: a slow one loses frames, and
//! nothing piles up for it.

use std::convert::Infallible;
use std::sync::Arc;
use std::time::Duration;

use axum::body::{Body, Bytes};
use axum::extract::{Query, State};
use axum::http::StatusCode;
use axum::http::header::{CACHE_CONTROL, CONTENT_TYPE, HeaderName};
use axum::response::{IntoResponse, Response};
use futures_util::stream::unfold;
use serde::Deserialize;
use tokio::sync::watch;

use super::frame::Frame;
use super::guard::fault;
use super::hall::Hall;

/// Time between two whole snapshots, s.
const WHOLE: f64 = 1.0;
/// By so much snapshots may come too soon, s.
const SLACK: f64 = 0.03;
/// Silence after which a comment is sent, so that a dead connection is found.
const ALIVE: Duration = Duration::from_secs(15);

/// What a client asks for.
#[derive(Debug, Deserialize)]
pub(super) struct Wish {
    hz: Option<f64>,
}

/// One client.
struct Client {
    frames: watch::Receiver<Option<Arc<Frame>>>,
    period: f64,
    greeted: bool,
    /// When the last frame was sent, on the ship's time line.
    sent: Option<f64>,
    /// The last that was sent whole.
    whole: Option<Arc<Frame>>,
}

pub(super) async fn stream(State(hall): State<Arc<Hall>>, Query(wish): Query<Wish>) -> Response {
    let hz = wish.hz.unwrap_or(10.0);
    if !(0.1..=10.0).contains(&hz) {
        return fault(StatusCode::BAD_REQUEST, "hz: from 0.1 to 10");
    }
    let mut frames = hall.follow();
    // what is there already counts as news
    frames.mark_changed();
    let client = Client { frames, period: 1.0 / hz, greeted: false, sent: None, whole: None };
    let chunks = unfold(client, |mut client| async {
        let chunk = client.next().await?;
        Some((Ok::<Bytes, Infallible>(chunk), client))
    });
    let head = [
        (CONTENT_TYPE, "text/event-stream"),
        (CACHE_CONTROL, "no-store"),
        // of nginx: what passes is to pass at once
        (HeaderName::from_static("x-accel-buffering"), "no"),
    ];
    (head, Body::from_stream(chunks)).into_response()
}

impl Client {
    /// What is sent next; `None` when the page ends.
    async fn next(&mut self) -> Option<Bytes> {
        if !self.greeted {
            self.greeted = true;
            return Some(Bytes::from_static(b"retry: 1000\n\n"));
        }
        loop {
            match tokio::time::timeout(ALIVE, self.frames.changed()).await {
                Ok(changed) => changed.ok()?,
                Err(_) => return Some(Bytes::from_static(b": alive\n\n")),
            }
            let frame = self.frames.borrow_and_update().clone();
            if let Some(chunk) = frame.and_then(|frame| self.due(frame)) {
                return Some(chunk);
            }
        }
    }

    /// The frame as it is sent, if one is due.
    fn due(&mut self, frame: Arc<Frame>) -> Option<Bytes> {
        let now = frame.snapshot().time.at_s;
        // time that goes back is that of another start
        let is_due = |last: f64, period: f64| now < last || now - last >= period - SLACK;
        if self.sent.is_some_and(|sent| !is_due(sent, self.period)) {
            return None;
        }
        self.sent = Some(now);
        let goes_on = |last: &Arc<Frame>| {
            !is_due(last.snapshot().time.at_s, WHOLE) && !frame.has_news_since(last)
        };
        if self.whole.as_ref().is_some_and(goes_on) {
            return Some(frame.live());
        }
        let event = frame.whole();
        self.whole = Some(frame);
        Some(event)
    }
}
