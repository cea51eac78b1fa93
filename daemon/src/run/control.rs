//! Orders on their way to the engine's thread.

use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};
use std::time::Duration;

use insd_base::Order;
use insd_vessel::Obeyed;
use tokio::sync::oneshot;

/// Orders that may wait.
const WAITING: usize = 16;
/// Longest time for which it is waited what became of an order.
const PATIENCE: Duration = Duration::from_secs(5);

/// An order and who waits for what becomes of it.
pub(super) struct Control {
    pub(super) order: Order,
    pub(super) reply: oneshot::Sender<Obeyed>,
}

/// Gives orders to the engine's thread.
#[derive(Clone, Debug)]
pub(super) struct Commander(SyncSender<Control>);

/// Why an order was not obeyed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub(super) enum NotObeyed {
    #[error("too many orders wait")]
    Busy,
    #[error("the engine has ended")]
    Ended,
    #[error("the engine does not answer")]
    NoAnswer,
}

pub(super) fn channel() -> (Commander, Receiver<Control>) {
    let (sender, receiver) = sync_channel(WAITING);
    (Commander(sender), receiver)
}

impl Commander {
    /// Gives an order and waits for what becomes of it.
    pub(super) async fn give(&self, order: Order) -> Result<Obeyed, NotObeyed> {
        let (reply, answer) = oneshot::channel();
        self.0.try_send(Control { order, reply }).map_err(|fault| match fault {
            TrySendError::Full(_) => NotObeyed::Busy,
            TrySendError::Disconnected(_) => NotObeyed::Ended,
        })?;
        match tokio::time::timeout(PATIENCE, answer).await {
            Ok(answer) => answer.map_err(|_| NotObeyed::Ended),
            Err(_) => Err(NotObeyed::NoAnswer),
        }
    }
}
