//! The thread of the page and what runs on it.

mod accept;
mod access;
mod alerts;
mod api;
mod archive;
mod door;
mod fleet;
mod frame;
mod guard;
mod hall;
mod history;
mod metrics;
mod page;
mod picture;
mod recordings;
mod reporter;
mod reports;
mod room;
mod stall;
mod stream;
mod texts;
mod track;

use std::net::SocketAddr;
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;

use axum::Router;
use axum::extract::DefaultBodyLimit;
use axum::routing::{get, post};
use tokio::runtime::{Builder, Runtime};
use tokio::sync::watch;

use crate::channel::Viewer;
use crate::config::{WebConfig, WebError};
use crate::orders::OrderSender;

use archive::Recordings;
use door::Door;
pub use fleet::FleetBoardText;
use hall::Hall;
use reporter::Reports;
use room::Room;

/// Longest body of a request, bytes.
const MAX_BODY: usize = 4096;

/// The running page. It ends when this is dropped.
#[derive(Debug)]
pub struct WebHandle {
    address: SocketAddr,
    stop: watch::Sender<bool>,
    thread: Option<JoinHandle<()>>,
}

impl WebHandle {
    /// Where it listens, or will.
    #[must_use]
    pub fn address(&self) -> SocketAddr {
        self.address
    }
}

impl Drop for WebHandle {
    fn drop(&mut self) {
        self.stop.send_replace(true);
        if let Some(thread) = self.thread.take() {
            // a panic there was told by the panic hook, and nothing hangs on the page
            let _ = thread.join();
        }
    }
}

/// Starts the page on a thread of its own. While somebody else has its address, or this computer does not have it yet, the
/// page waits for it.
///
/// # Errors
/// The address cannot be listened at for another reason, or the system grants no thread.
pub fn start(
    config: WebConfig,
    viewer: Viewer,
    orders: OrderSender,
) -> Result<WebHandle, WebError> {
    let door = Door::new(config.listen)?;
    let mut hall = Hall::new(config.token, &config.allowed_hosts, config.language, orders);
    hall.picture = config.picture;
    hall.recordings = config.recordings.map(Recordings::of);
    hall.reports = config.reporter.and_then(Reports::by);
    let hall = Arc::new(hall);
    let house = House {
        door,
        router: router(&hall),
        viewer: Some(viewer),
        hall,
        room: Room::new(config.max_clients, config.max_per_address),
    };
    house.open()
}

/// Starts a page that shows a fleet, on a thread of its own, with the guards of the status page. `board` tells the ships
/// as an object of JSON; nothing can be changed there.
///
/// # Errors
/// As of [`start`].
pub fn start_fleet(config: WebConfig, board: FleetBoardText) -> Result<WebHandle, WebError> {
    let door = Door::new(config.listen)?;
    let (orders, _) = crate::orders::channel();
    let hall = Arc::new(Hall::new(None, &config.allowed_hosts, config.language, orders));
    let house = House {
        door,
        router: guarded(fleet::routes(board), &hall),
        viewer: None,
        hall,
        room: Room::new(config.max_clients, config.max_per_address),
    };
    house.open()
}

/// What the thread needs.
struct House {
    door: Door,
    router: Router,
    /// Whose snapshots are shown, if any are.
    viewer: Option<Viewer>,
    hall: Arc<Hall>,
    room: Room,
}

impl House {
    fn open(self) -> Result<WebHandle, WebError> {
        let address = self.door.address()?;
        let runtime = Builder::new_current_thread().enable_all().build()?;
        let (stop, stopped) = watch::channel(false);
        let run = move || run(runtime, self, stopped);
        let thread = std::thread::Builder::new().name("web".to_owned()).spawn(run)?;
        Ok(WebHandle { address, stop, thread: Some(thread) })
    }
}

fn run(runtime: Runtime, house: House, mut stopped: watch::Receiver<bool>) {
    let House { door, router, viewer, hall, room } = house;
    let show = async {
        match &viewer {
            Some(viewer) => hall::pump(viewer, &hall).await,
            None => std::future::pending().await,
        }
    };
    runtime.block_on(async {
        tokio::select! {
            () = show => {}
            ended = accept::accept(door, router, &hall, &room) => {
                if let Err(fault) = ended {
                    tracing::warn!(%fault, "the status page cannot be served");
                }
            }
            _ = stopped.wait_for(|stopped| *stopped) => {}
        }
    });
    // connections that are open are cut: browsers come back by themselves
    runtime.shutdown_timeout(Duration::from_millis(100));
}

fn router(hall: &Arc<Hall>) -> Router {
    let routes = Router::new()
        .route("/", get(page::index))
        .route("/favicon.ico", get(page::icon))
        .route("/assets/{name}", get(page::asset))
        .route("/health", get(api::health))
        .route("/metrics", get(api::metrics))
        .route("/api/v1/status", get(api::status))
        .route("/api/v1/stream", get(stream::stream))
        .route("/api/v1/track", get(api::track))
        .route("/api/v1/history", get(api::history))
        .route("/api/v1/orders", get(api::orders))
        .route("/api/v1/camera", get(picture::picture))
        .route("/api/v1/recordings", get(recordings::list))
        .route("/api/v1/recordings/{name}", get(recordings::fetch))
        .route("/api/v1/recordings/{name}/report", get(reports::report))
        .route("/api/v1/schema", get(api::schema))
        .route("/api/v1/texts", get(texts::languages))
        .route("/api/v1/texts/{language}", get(texts::texts))
        .route("/api/v1/alerts/{id}/acknowledge", post(alerts::acknowledge))
        .route("/api/v1/alerts/{id}/silence", post(alerts::silence))
        .route("/api/v1/berth", post(alerts::berth))
        .route("/api/v1/learning", post(alerts::learning))
        .route("/api/v1/log-level", post(alerts::log_level));
    guarded(routes, hall)
}

/// What holds for every request.
fn guarded(routes: Router<Arc<Hall>>, hall: &Arc<Hall>) -> Router {
    routes
        .fallback(guard::not_found)
        .layer(DefaultBodyLimit::max(MAX_BODY))
        .layer(axum::middleware::from_fn_with_state(Arc::clone(hall), guard::guard))
        .with_state(Arc::clone(hall))
}
