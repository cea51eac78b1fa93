//! Where the page listens: at once, or as soon as the address is to be had.

use std::io::{self, ErrorKind};
use std::net::{SocketAddr, TcpListener as StdListener};
use std::time::Duration;

use tokio::net::TcpListener;

use crate::config::{Listen, WebError};

/// Pause between two tries.
const PAUSE: Duration = Duration::from_secs(1);

/// The place where clients come in.
pub(super) enum Door {
    Open(StdListener),
    /// Somebody else has the address, or this computer does not have it yet.
    Awaited(SocketAddr),
}

impl Door {
    /// # Errors
    /// The address cannot be listened at, and will not be by waiting.
    pub(super) fn new(listen: Listen) -> Result<Self, WebError> {
        let address = match listen {
            Listen::Inherited(listener) => return Ok(Door::Open(listener)),
            Listen::Address(address) => address,
        };
        match StdListener::bind(address) {
            Ok(listener) => Ok(Door::Open(listener)),
            Err(source) if may_pass(&source) => {
                tracing::warn!(%address, fault = %source, "the status page waits for its address");
                Ok(Door::Awaited(address))
            }
            Err(source) => Err(WebError::Bind { address, source }),
        }
    }

    /// Where that is.
    pub(super) fn address(&self) -> io::Result<SocketAddr> {
        match self {
            Door::Open(listener) => listener.local_addr(),
            Door::Awaited(address) => Ok(*address),
        }
    }

    /// Waits until it is open.
    pub(super) async fn opened(self) -> io::Result<TcpListener> {
        let address = match self {
            Door::Open(listener) => {
                listener.set_nonblocking(true)?;
                return TcpListener::from_std(listener);
            }
            Door::Awaited(address) => address,
        };
        loop {
            tokio::time::sleep(PAUSE).await;
            match TcpListener::bind(address).await {
                Ok(listener) => {
                    tracing::info!(%address, "the status page has its address");
                    return Ok(listener);
                }
                Err(fault) if may_pass(&fault) => {}
                Err(fault) => return Err(fault),
            }
        }
    }
}

/// Whether waiting may help.
fn may_pass(fault: &io::Error) -> bool {
    matches!(fault.kind(), ErrorKind::AddrInUse | ErrorKind::AddrNotAvailable)
}
