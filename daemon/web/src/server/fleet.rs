//! The sheet of a fleet: all ships, a row each.

use std::fmt;
use std::sync::Arc;

use axum::Router;
use axum::http::header::CONTENT_TYPE;
use axum::response::IntoResponse;
use axum::routing::get;

use super::hall::Hall;
use super::page;

/// Tells the ships of a fleet as an object of JSON.
#[derive(Clone)]
pub struct FleetBoardText(Arc<dyn Fn() -> String + Send + Sync>);

impl FleetBoardText {
    /// That which a function tells whenever somebody asks.
    pub fn new(tell: impl Fn() -> String + Send + Sync + 'static) -> Self {
        FleetBoardText(Arc::new(tell))
    }
}

impl fmt::Debug for FleetBoardText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("FleetBoardText")
    }
}

pub(super) fn routes(board: FleetBoardText) -> Router<Arc<Hall>> {
    let told = move || {
        let text = (board.0)();
        async move { ([(CONTENT_TYPE, "application/json")], text).into_response() }
    };
    Router::new()
        .route("/", get(page::fleet))
        .route("/favicon.ico", get(page::icon))
        .route("/assets/{name}", get(page::asset))
        .route("/health", get(|| async { "ok\n" }))
        .route("/api/v1/fleet", get(told))
}
