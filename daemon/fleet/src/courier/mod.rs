//! The thread that tells a fleet: what is due goes into the spool, and from there to the broker.

mod clerk;
mod sender;
mod status;

use std::io;
use std::sync::{Arc, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use insd_base::Stamp;
use insd_web::Viewer;
use tokio::runtime::{Builder, Runtime};
use tokio::sync::watch;
use tokio::time::{MissedTickBehavior, interval};

use crate::plan::FleetPlan;
use clerk::Clerk;
use sender::Sender;
pub use status::FleetStatus;
use status::Shared;

/// Tells the time.
pub type FleetNow = Arc<dyn Fn() -> Stamp + Send + Sync>;

/// How often is looked what is due.
const LOOK: Duration = Duration::from_millis(200);
/// What a farewell may take.
const FAREWELL: Duration = Duration::from_millis(300);

/// The running courier. It ends when this is dropped; what waits stays on the disk.
#[derive(Debug)]
pub struct FleetHandle {
    status: Shared,
    stop: watch::Sender<bool>,
    thread: Option<JoinHandle<()>>,
}

impl FleetHandle {
    /// How it is going.
    #[must_use]
    pub fn status(&self) -> FleetStatus {
        self.status.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

impl Drop for FleetHandle {
    fn drop(&mut self) {
        self.stop.send_replace(true);
        if let Some(thread) = self.thread.take() {
            // a panic there was told by the panic hook, and nothing hangs on it
            let _ = thread.join();
        }
    }
}

/// Starts to tell a fleet, on a thread of its own.
///
/// # Errors
/// The kernel gives no random numbers or no thread. A disk or broker that is not there is no error: it is told,
/// and tried again.
pub fn start(plan: FleetPlan, viewer: Viewer, now: FleetNow) -> io::Result<FleetHandle> {
    let status = Shared::default();
    let clerk = Clerk::new(&plan, viewer, Arc::clone(&status))?;
    let sender = Sender::new(&plan, Arc::clone(&status));
    let runtime = Builder::new_current_thread().enable_all().build()?;
    let (stop, stopped) = watch::channel(false);
    let run = move || run(runtime, &plan, clerk, sender, &now, stopped);
    let thread = std::thread::Builder::new().name("fleet".to_owned()).spawn(run)?;
    Ok(FleetHandle { status, stop, thread: Some(thread) })
}

fn run(
    runtime: Runtime,
    plan: &FleetPlan,
    mut clerk: Clerk,
    mut sender: Sender,
    now: &FleetNow,
    mut stopped: watch::Receiver<bool>,
) {
    runtime.block_on(async {
        let mut ticks = interval(LOOK);
        ticks.set_missed_tick_behavior(MissedTickBehavior::Delay);
        loop {
            tokio::select! {
                _ = ticks.tick() => {
                    clerk.look(plan, now().monotonic);
                    sender.look(plan, now().monotonic);
                }
                event = sender.event() => sender.hear(event, &mut clerk, now().monotonic),
                _ = stopped.wait_for(|stopped| *stopped) => break,
            }
            sender.send(plan, &mut clerk, now().monotonic);
        }
        clerk.close();
        if sender.close() {
            tokio::time::sleep(FAREWELL).await;
        }
    });
    runtime.shutdown_timeout(FAREWELL);
}
