//! The guest and its interfaces.

use std::path::Path;
use std::process::Command;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use super::tap::BUFFER;

/// Present in the guest only. Nothing here is to be done to a computer that is used.
const GUEST: &str = "/run/insd-vm";

pub(crate) const SECOND: Duration = Duration::from_secs(1);

/// One test at a time.
pub(crate) fn turn() -> MutexGuard<'static, ()> {
    static TURN: Mutex<()> = Mutex::new(());
    assert!(Path::new(GUEST).is_dir(), "this needs the guest, see tests/vm/README.md");
    let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    std::fs::write("/proc/sys/net/core/rmem_max", BUFFER.to_string()).unwrap();
    // what is read from the host for the first time makes the clock leap
    ip("link");
    turn
}

pub(crate) fn ip(arguments: &str) {
    run("ip", arguments);
}

pub(crate) fn run(program: &str, arguments: &str) {
    let output = Command::new(program).args(arguments.split(' ')).output().unwrap();
    assert!(output.status.success(), "{program} {arguments}");
}

/// A virtual interface that is up.
pub(crate) fn make(name: &str) {
    ip(&format!("link add {name} type vcan"));
    ip(&format!("link set {name} up"));
}
