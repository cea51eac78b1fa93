//! Whether something is plugged into a serial line, as far as its control lines tell.

use std::path::Path;

use tokio_serial::SerialPort;

/// What the control lines of a serial line say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cable {
    /// The other end holds one of them: it is plugged in and has power.
    Held,
    /// None is held: nothing is plugged in, or the cable has no such wires, as those of IEC 61162-1.
    Quiet,
    /// The driver does not tell.
    Unknown,
}

/// Looks at the control lines of a serial line. It is opened for a moment, which raises DTR and RTS, and
/// nothing is written.
///
/// # Errors
/// What the system says if it cannot be opened.
pub fn cable(device: &Path) -> Result<Cable, tokio_serial::Error> {
    /// Any rate: nothing is sent.
    const BAUD: u32 = 4800;
    let mut line = tokio_serial::new(device.to_string_lossy(), BAUD).open_native()?;
    let lines = [line.read_data_set_ready(), line.read_clear_to_send(), line.read_carrier_detect()];
    Ok(match lines.iter().flatten().any(|held| *held) {
        true => Cable::Held,
        false if lines.iter().all(Result::is_err) => Cable::Unknown,
        false => Cable::Quiet,
    })
}
