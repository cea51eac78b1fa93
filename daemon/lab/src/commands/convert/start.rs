//! When a recording begins.

use insd_base::{Time, UtcTime};
use insd_intake::Intake;

/// UTC of the start of a recording, RFC 3339, as it was known at the end; `None` if it never was.
pub(super) fn start_utc(intake: &Intake) -> anyhow::Result<Option<String>> {
    let utc = |start: UtcTime| jiff::Timestamp::from_nanosecond(start.as_nanos().into());
    Ok(intake.utc_at(Time::START).map(utc).transpose()?.map(|utc| utc.to_string()))
}
