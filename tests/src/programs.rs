//! Programs that examples run.

use std::io;
use std::process::Command;

/// Runs a program to its end.
///
/// # Errors
/// It cannot be started, or it fails: what it says of that.
pub fn run(command: &mut Command) -> io::Result<()> {
    let output = command.output()?;
    let why = || io::Error::other(String::from_utf8_lossy(&output.stderr).into_owned());
    output.status.success().then_some(()).ok_or_else(why)
}
