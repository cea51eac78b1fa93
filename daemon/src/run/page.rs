//! What is shown of the ship: to browsers by the status page, and to fleets.

use insd_config::Config;
use insd_web::orders::{self, OrderReceiver};
use insd_web::{Listen, Viewer, WebConfig, WebHandle};

use super::showcase::{Origin, Showcase};
use crate::logging::Log;

/// This very program, be it replaced by another version meanwhile.
const OWN_PROGRAM: &str = "/proc/self/exe";

/// What is shown, and who may look.
pub(super) struct Page {
    pub(super) showcase: Showcase,
    pub(super) viewer: Viewer,
    /// Orders of the status page, if there is one.
    pub(super) orders: Option<OrderReceiver>,
    /// Held to keep it open.
    pub(super) handle: Option<WebHandle>,
}

/// Opens what is asked for; `None` if nobody is to look. A ship sails without it, too: what is wrong is told.
pub(super) fn open(config: &Config, origin: Origin, log: &Log) -> Option<Page> {
    let (publisher, viewer) = insd_web::channel();
    let (handle, orders) = serve(config, &viewer).unzip();
    if handle.is_none() && config.fleets.is_empty() {
        return None;
    }
    let showcase = Showcase::new(publisher, log.clone(), config, origin);
    Some(Page { showcase, viewer, orders, handle })
}

/// Opens the status page.
fn serve(config: &Config, viewer: &Viewer) -> Option<(WebHandle, OrderReceiver)> {
    if !config.web.enabled {
        return None;
    }
    let (sender, orders) = orders::channel();
    match insd_web::start(web_config(config), viewer.clone(), sender) {
        Ok(handle) => {
            tracing::info!(address = %handle.address(), "status page");
            Some((handle, orders))
        }
        Err(fault) => {
            tracing::error!(%fault, "no status page");
            None
        }
    }
}

fn web_config(config: &Config) -> WebConfig {
    let section = &config.web;
    WebConfig {
        listen: Listen::Address(section.listen),
        token: section.token_file.as_deref().and_then(token),
        allowed_hosts: section.hosts.clone(),
        max_per_address: section.max_per_address,
        picture: config.camera.as_ref().and_then(|camera| camera.picture.clone()),
        recordings: config.recording.as_ref().map(|section| section.folder.clone()),
        reporter: Some(OWN_PROGRAM.into()),
        language: config.ship.language,
        ..WebConfig::default()
    }
}

/// The word of a file; without it nothing can be changed, which is told.
fn token(file: &std::path::Path) -> Option<String> {
    match std::fs::read_to_string(file) {
        Ok(text) => Some(text.trim().to_owned()).filter(|word| !word.is_empty()),
        Err(error) => {
            tracing::warn!(file = %file.display(), %error, "no token: nothing can be changed on the page");
            None
        }
    }
}
