//! What surrounds the engine's thread: signals, the word to systemd, configurations that are read again.

use std::path::PathBuf;
use std::time::Duration;

use insd_base::{AlertOrder, Order};
use insd_config::Config;
use insd_vessel::Obeyed;
use insd_web::{OrderReceiver, Request, SECURITY};
use tokio::signal::unix::{SignalKind, signal};
use tokio::sync::{oneshot, watch};

use super::control::Commander;
use super::heart::Heart;
use super::manager::{Manager, Word};
use crate::logging::Log;

/// Time between two looks where no watchdog asks for shorter ones.
const LOOK: Duration = Duration::from_secs(1);

/// What surrounds the engine's thread.
pub(super) struct Service {
    /// The file of the configuration, to be read again.
    pub(super) config: Option<PathBuf>,
    pub(super) log: Log,
    pub(super) commander: Commander,
    pub(super) manager: Manager,
    pub(super) heart: Heart,
    /// How everything stands, in one line.
    pub(super) headline: watch::Receiver<String>,
    /// Gone when the engine's thread has ended.
    pub(super) ended: oneshot::Receiver<()>,
    /// Orders of the page.
    pub(super) orders: Option<OrderReceiver>,
    /// Stop after so long.
    pub(super) limit: Option<Duration>,
}

impl Service {
    /// Attends to the engine until it is time to stop.
    pub(super) async fn attend(mut self) -> std::io::Result<()> {
        let mut interrupt = signal(SignalKind::interrupt())?;
        let mut terminate = signal(SignalKind::terminate())?;
        let mut hangup = signal(SignalKind::hangup())?;
        let watchdog = sd_notify::watchdog_enabled();
        let mut look = tokio::time::interval(watchdog.map_or(LOOK, |limit| limit / 4).min(LOOK));
        let limit =
            tokio::time::sleep(self.limit.unwrap_or(Duration::from_secs(u64::from(u32::MAX))));
        tokio::pin!(limit);
        let mut beats = self.heart.beats();
        self.manager.tell([Word::Ready]);
        let why = loop {
            tokio::select! {
                _ = interrupt.recv() => break "interrupted",
                _ = terminate.recv() => break "told to stop",
                () = &mut limit => break "time is up",
                _ = &mut self.ended => break "the engine has ended",
                _ = hangup.recv() => self.read_again().await,
                Some(request) = next(&mut self.orders) => self.obey(request),
                _ = look.tick() => self.look(&mut beats),
            }
        };
        tracing::info!(target: SECURITY, why, "insd stops");
        self.manager.tell([Word::Stopping]);
        Ok(())
    }

    /// Feeds the watchdog if the engine has advanced since the last look.
    fn look(&mut self, beats: &mut u64) {
        let now = self.heart.beats();
        if now != *beats {
            *beats = now;
            self.manager.tell([Word::Alive]);
        }
        if self.headline.has_changed().unwrap_or(false) {
            let headline = self.headline.borrow_and_update().clone();
            self.manager.tell([Word::Status(headline)]);
        }
        self.log.repeats().tell();
    }

    /// Obeys an order of the page; the answer is sent when there is one.
    fn obey(&self, request: Request) {
        let order = |identifier, command| Order::Alert { identifier, command };
        let ordered = match &request.order {
            insd_web::PageOrder::Acknowledge { id, .. } => order(*id, AlertOrder::Acknowledge),
            insd_web::PageOrder::Silence { id, .. } => order(*id, AlertOrder::Silence),
            insd_web::PageOrder::Berth(name) => Order::Berth(name.clone()),
            insd_web::PageOrder::UseLearnt(is_wanted) => Order::UseLearnt(*is_wanted),
            insd_web::PageOrder::LogLevel(level) => {
                tracing::info!(target: SECURITY, level, "what is logged is changed on the page");
                let outcome = self.log.set(level);
                return request.answer(outcome);
            }
        };
        let commander = self.commander.clone();
        tokio::spawn(async move {
            let outcome = match commander.give(ordered).await {
                Ok(
                    Obeyed::Alert { done: true, .. }
                    | Obeyed::Berth { done: true, .. }
                    | Obeyed::LearntUse(_),
                ) => Ok(()),
                Ok(Obeyed::Berth { .. }) => Err("there is no such berth".to_owned()),
                Ok(_) => Err("there is no such alert, or it cannot be done to it".to_owned()),
                Err(fault) => Err(fault.to_string()),
            };
            request.answer(outcome);
        });
    }

    async fn read_again(&self) {
        let Some(path) = self.config.clone() else { return };
        self.manager.tell([Word::Reloading]);
        let file = path.display().to_string();
        tracing::info!(target: SECURITY, file, "told to read the configuration again");
        let read = tokio::task::spawn_blocking(move || Config::load(&path)).await;
        let status = match read {
            Ok(Ok((config, text))) => self.take_over(&config, text).await,
            Ok(Err(faults)) => {
                let text = "the configuration is not taken, the old one holds";
                tracing::error!(target: SECURITY, "{text}: {faults:#}");
                "configuration has faults: the old one holds".to_owned()
            }
            Err(error) => error.to_string(),
        };
        self.manager.tell([Word::Ready, Word::Status(status)]);
    }

    async fn take_over(&self, config: &Config, text: String) -> String {
        if !self.log.is_told_by_environment
            && let Err(fault) = self.log.set(&config.log.level)
        {
            tracing::warn!(fault, "what is logged stays as it is");
        }
        match self.commander.give(Order::Configuration(text)).await {
            Ok(Obeyed::Configured(change)) if change.waiting.is_empty() => {
                "configuration read again".to_owned()
            }
            Ok(Obeyed::Configured(change)) => {
                let sections = change.waiting.join(", ");
                format!("configuration read again; for the next start: {sections}")
            }
            Ok(_) => "configuration has faults: the old one holds".to_owned(),
            Err(fault) => {
                tracing::error!(%fault, "the configuration is not taken");
                fault.to_string()
            }
        }
    }
}

/// The next order of the page; never anything without a page.
async fn next(orders: &mut Option<OrderReceiver>) -> Option<Request> {
    match orders {
        Some(orders) => orders.recv().await,
        None => std::future::pending().await,
    }
}
