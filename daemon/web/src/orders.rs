//! From the page back to the engine's thread: the few things that may be changed, if a token is
//! configured and was sent.

use std::fmt;
use std::time::Duration;

use tokio::sync::mpsc::{self, Receiver, Sender};
use tokio::sync::oneshot;

/// Orders that may wait for the engine.
const WAITING: usize = 16;
/// How long an order waits for its answer.
const PATIENCE: Duration = Duration::from_secs(2);

/// Something that is to be changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PageOrder {
    /// An alert was seen.
    Acknowledge {
        /// Its identifier.
        id: u32,
        /// Its instance, if it has one.
        instance: Option<u32>,
    },
    /// An alert is to be silent for a while.
    Silence {
        /// Its identifier.
        id: u32,
        /// Its instance, if it has one.
        instance: Option<u32>,
    },
    /// The berth of this name is gone alongside; without a name the nearest is proposed.
    Berth(Option<String>),
    /// Whether what is learnt of the sensors may be used.
    UseLearnt(bool),
    /// What the journal tells from now on: a level, or a filter by module.
    LogLevel(String),
}

impl fmt::Display for PageOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            PageOrder::Acknowledge { id, .. } => write!(f, "acknowledge alert {id}"),
            PageOrder::Silence { id, .. } => write!(f, "silence alert {id}"),
            PageOrder::Berth(Some(name)) => write!(f, "choose berth {name}"),
            PageOrder::Berth(None) => f.write_str("choose the nearest berth"),
            PageOrder::UseLearnt(true) => f.write_str("use what is learnt of the sensors"),
            PageOrder::UseLearnt(false) => f.write_str("do not use what is learnt of the sensors"),
            PageOrder::LogLevel(level) => write!(f, "log at level {level}"),
        }
    }
}

/// An order that waits for its answer.
#[derive(Debug)]
pub struct Request {
    /// What is to be changed.
    pub order: PageOrder,
    answer: oneshot::Sender<Result<(), String>>,
}

/// Why an order came to nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Failure {
    /// It was refused, for this reason.
    Refused(String),
    /// Too many wait.
    Busy,
    /// No answer in time; it may still be obeyed.
    Silent,
}

/// The page's end.
#[derive(Clone, Debug)]
pub struct OrderSender(Sender<Request>);

/// The engine's end.
#[derive(Debug)]
pub struct OrderReceiver(Receiver<Request>);

/// A bounded channel of orders.
#[must_use]
pub fn channel() -> (OrderSender, OrderReceiver) {
    let (sender, receiver) = mpsc::channel(WAITING);
    (OrderSender(sender), OrderReceiver(receiver))
}

impl Request {
    /// Tells that it was obeyed, or why not. It does not matter whether anybody still waits.
    pub fn answer(self, outcome: Result<(), String>) {
        // who asked may have gone
        let _ = self.answer.send(outcome);
    }
}

impl OrderReceiver {
    /// The next order; `None` when the page has ended.
    pub async fn recv(&mut self) -> Option<Request> {
        self.0.recv().await
    }

    /// The next order, if one waits.
    pub fn poll(&mut self) -> Option<Request> {
        self.0.try_recv().ok()
    }
}

impl OrderSender {
    /// Gives an order and waits for its answer, but not for long.
    pub(crate) async fn send(&self, order: PageOrder) -> Result<(), Failure> {
        let (answer, answered) = oneshot::channel();
        self.0.try_send(Request { order, answer }).map_err(|_| Failure::Busy)?;
        match tokio::time::timeout(PATIENCE, answered).await {
            Ok(Ok(outcome)) => outcome.map_err(Failure::Refused),
            Ok(Err(_)) | Err(_) => Err(Failure::Silent),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn runtime() -> tokio::runtime::Runtime {
        tokio::runtime::Builder::new_current_thread()
            .enable_time()
            .start_paused(true)
            .build()
            .unwrap()
    }

    #[test]
    fn an_order_is_answered_by_the_engine() {
        let (sender, mut receiver) = channel();
        let engine = std::thread::spawn(move || {
            let request = loop {
                if let Some(request) = receiver.poll() {
                    break request;
                }
                std::thread::yield_now();
            };
            assert_eq!(request.order, PageOrder::LogLevel("debug".to_owned()));
            request.answer(Err("not now".to_owned()));
        });
        let plain = tokio::runtime::Builder::new_current_thread().enable_time().build().unwrap();
        let outcome = plain.block_on(sender.send(PageOrder::LogLevel("debug".to_owned())));
        assert_eq!(outcome, Err(Failure::Refused("not now".to_owned())));
        engine.join().unwrap();
    }

    #[test]
    fn an_engine_that_does_not_look_makes_nobody_wait_for_long() {
        let (sender, _receiver) = channel();
        let order = PageOrder::Acknowledge { id: 3062, instance: None };
        for _ in 0..WAITING {
            let outcome = runtime().block_on(sender.send(order.clone()));
            assert_eq!(outcome, Err(Failure::Silent));
        }
        assert_eq!(runtime().block_on(sender.send(order)), Err(Failure::Busy));
    }
}
