//! The status page, if there is to be one.

use insd_config::Config;
use insd_web::orders::{self, OrderReceiver};
use insd_web::{Listen, WebConfig, WebHandle};

use super::showcase::{Origin, Showcase};
use crate::logging::Log;

/// The page, and its two ends inside.
pub(super) struct Page {
    pub(super) showcase: Showcase,
    pub(super) orders: OrderReceiver,
    /// Held to keep it open.
    pub(super) handle: WebHandle,
}

/// Opens the page. A ship sails without it, too: what is wrong is told.
pub(super) fn open(config: &Config, origin: Origin, log: &Log) -> Option<Page> {
    if !config.web.enabled {
        return None;
    }
    let (publisher, viewer) = insd_web::channel();
    let (sender, orders) = orders::channel();
    match insd_web::start(web_config(config), viewer, sender) {
        Ok(handle) => {
            tracing::info!(address = %handle.address(), "status page");
            let showcase = Showcase::new(publisher, log.clone(), config, origin);
            Some(Page { showcase, orders, handle })
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
