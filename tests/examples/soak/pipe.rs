//! What the sensors send, on its way from one process to the other.

use std::io::{self, Read, Write};

use insd_base::{Arrival, Input, PortId, Stamp, Time, UtcTime};

/// Writes bytes that arrive.
pub(crate) fn write(to: &mut impl Write, arrival: &Arrival) -> io::Result<()> {
    let Input::Bytes(bytes) = &arrival.input else { return Ok(()) };
    to.write_all(&arrival.stamp.monotonic.as_nanos().to_le_bytes())?;
    to.write_all(&arrival.stamp.system.as_nanos().to_le_bytes())?;
    to.write_all(&arrival.port.0.to_le_bytes())?;
    to.write_all(&(bytes.len() as u32).to_le_bytes())?;
    to.write_all(bytes)
}

/// Reads what [`write`] wrote; `None` at the end.
pub(crate) fn read(from: &mut impl Read) -> Option<Arrival> {
    let monotonic = Time::from_nanos(i64::from_le_bytes(array(from)?));
    let system = UtcTime::from_nanos(i64::from_le_bytes(array(from)?));
    let port = PortId(u16::from_le_bytes(array(from)?));
    let mut bytes = vec![0; u32::from_le_bytes(array(from)?) as usize];
    from.read_exact(&mut bytes).ok()?;
    Some(Arrival { stamp: Stamp { monotonic, system }, port, input: Input::Bytes(bytes) })
}

fn array<const LENGTH: usize>(from: &mut impl Read) -> Option<[u8; LENGTH]> {
    let mut bytes = [0; LENGTH];
    from.read_exact(&mut bytes).ok()?;
    Some(bytes)
}
