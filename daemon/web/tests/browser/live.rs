//! A page whose scene goes on by itself.

use std::net::{SocketAddr, TcpListener};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use insd_languages::Language;
use insd_web::{Listen, OrderSender, Viewer, WebConfig, WebHandle};

use crate::recorded::{REPORTER, record};
use crate::scene::{STEP, Scene, Show};

pub(crate) const TOKEN: &str = "a token for the tests";

/// A page whose scene goes on by itself until this is dropped.
pub(crate) struct Live {
    address: SocketAddr,
    viewer: Viewer,
    sender: OrderSender,
    handle: Option<WebHandle>,
    language: Language,
    /// Where the front end of its camera would write, and recordings lie.
    folder: tempfile::TempDir,
    stop: Arc<AtomicBool>,
    still: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Live {
    /// Serves a scene at any free port.
    pub(crate) fn new(scene: Scene) -> Self {
        Live::of(Show::new(scene))
    }

    /// In a language that is configured.
    pub(crate) fn in_language(show: Show, language: Language) -> Self {
        let mut live = Live::of(show);
        live.language = language;
        live.close();
        live.open();
        live
    }

    /// The same; what has been before is gone through at twenty times its pace.
    pub(crate) fn of(mut show: Show) -> Self {
        let (publisher, viewer) = insd_web::channel();
        let (sender, mut orders) = insd_web::orders::channel();
        let listener = TcpListener::bind(("127.0.0.1", 0)).unwrap();
        let address = listener.local_addr().unwrap();
        drop(listener);
        let (stop, still) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicBool::new(false)));
        let thread = std::thread::spawn({
            let (stop, still) = (Arc::clone(&stop), Arc::clone(&still));
            move || {
                while !stop.load(Ordering::Relaxed) {
                    show.obey(&mut orders);
                    let past = show.is_past();
                    if !still.load(Ordering::Relaxed) {
                        publisher.publish(if past { show.skip() } else { show.next() });
                    }
                    std::thread::sleep(Duration::from_secs_f64(if past { 0.055 } else { STEP }));
                }
            }
        });
        let thread = Some(thread);
        let language = Language::default();
        let folder = tempfile::tempdir().unwrap();
        let handle = None;
        let mut live =
            Live { address, viewer, sender, handle, language, folder, stop, still, thread };
        live.open();
        live
    }

    /// A recording, and what is to be done for a report of it, as a script.
    pub(crate) fn record(&self, script: &str) {
        record(self.folder.path(), script);
    }

    /// The picture of its camera.
    pub(crate) fn picture(&self) -> PathBuf {
        self.folder.path().join("seen.png")
    }

    /// Opens the page, again and at the same address.
    pub(crate) fn open(&mut self) {
        let config = WebConfig {
            listen: Listen::Address(self.address),
            token: Some(TOKEN.to_owned()),
            language: self.language,
            picture: Some(self.picture()),
            recordings: Some(self.folder.path().to_owned()),
            reporter: Some(REPORTER.into()),
            ..WebConfig::default()
        };
        let page = insd_web::start(config, self.viewer.clone(), self.sender.clone());
        self.handle = Some(page.unwrap());
    }

    /// Closes it.
    pub(crate) fn close(&mut self) {
        drop(self.handle.take());
    }

    /// The navigator falls silent, or speaks again.
    pub(crate) fn be_still(&self, still: bool) {
        self.still.store(still, Ordering::Relaxed);
    }

    pub(crate) fn url(&self) -> String {
        format!("http://{}/", self.address)
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        let _ = self.thread.take().map(JoinHandle::join);
    }
}
