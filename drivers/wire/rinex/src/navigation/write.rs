//! Records to text: RINEX 3.05.

use insd_base::{BroadcastRecord, Constellation, IonosphereModel};

use crate::navigation::{glonass, ionosphere, kepler};
use crate::text::push_header;

/// Writes a file of navigation messages of version 3.05, mixed, that [`super::read_navigation`] reads back to the same
/// records as far as the format holds them: thirteen digits, five of the ionosphere, reference times of clocks and of
/// GLONASS to the second, and no more than half a week between the times of a record.
#[must_use]
pub fn write_navigation(
    records: &[BroadcastRecord],
    models: &[(Constellation, IonosphereModel)],
    leap_seconds: Option<i8>,
) -> String {
    let mut out = String::new();
    let contents = format!("{:>9}{:11}{:20}{:20}", "3.05", "", "NAVIGATION DATA", "M (MIXED)");
    push_header(&mut out, &contents, "RINEX VERSION / TYPE");
    push_header(&mut out, "insd", "PGM / RUN BY / DATE");
    for (own, model) in models {
        ionosphere::push(&mut out, *own, model);
    }
    if let Some(leaps) = leap_seconds {
        push_header(&mut out, &format!("{leaps:6}"), "LEAP SECONDS");
    }
    push_header(&mut out, "", "END OF HEADER");
    for record in records {
        match record {
            BroadcastRecord::Kepler(record) => kepler::push(&mut out, record),
            BroadcastRecord::Glonass(record) => glonass::push(&mut out, record, leap_seconds),
        }
    }
    out
}
