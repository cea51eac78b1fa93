//! Whose fault it is when a command cannot do what it is asked.

use insd_config::BadInput;
use insd_drivers::recording::RecordingError;

/// Whether the input is to blame, not the machine.
#[must_use]
pub fn is_bad_input(fault: &anyhow::Error) -> bool {
    fault.chain().any(|cause| {
        cause.is::<BadInput>()
            || cause.is::<csv::Error>()
            || cause.downcast_ref::<RecordingError>().is_some_and(is_about_input)
    })
}

fn is_about_input(fault: &RecordingError) -> bool {
    !matches!(fault, RecordingError::Write { .. })
}
