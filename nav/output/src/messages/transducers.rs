//! Roll, pitch and heave as measurements of transducers.
//!
//! Their names are the consumer's choice: `XDR` has those that OpenCPN and gpsd read, `XDR.PTCH` the
//! four letters of many sensors. The bow up and the starboard side down are positive, as OpenCPN's
//! dashboard shows them ("Nose up", "to Starboard"), and so is heave upwards.

use insd_wire::nmea::{Talker, Text, Xdr, XdrMeasurement};

use super::entry::{Content, Entry, one};
use crate::redacted_epoch::RedactedEpoch;

pub(super) static ENTRIES: &[Entry] = &[
    Entry { name: "XDR", talker: Some(Talker::IN), longest: Xdr::LONGEST, make: xdr },
    Entry { name: "XDR.PTCH", talker: Some(Talker::IN), longest: Xdr::LONGEST, make: ptch },
];

fn xdr(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    let (roll, pitch) = said.roll_and_pitch().unzip();
    let heave = said.heave().map(|heave| heave.heave);
    let displacement = |metres| {
        let name = Text::new("HEAVE")?;
        Some(XdrMeasurement::of_displacement(name, Some(metres), 2))
    };
    let measurements =
        [angle("PITCH", pitch, 2), angle("ROLL", roll, 2), heave.and_then(displacement)];
    known(measurements, talker)
}

/// To a tenth of a degree, as sensors with these names have it.
fn ptch(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    let (roll, pitch) = said.roll_and_pitch().unzip();
    known([angle("PTCH", pitch, 1), angle("ROLL", roll, 1), None], talker)
}

fn angle(name: &str, angle: Option<f64>, decimals: u8) -> Option<XdrMeasurement> {
    Some(XdrMeasurement::of_angle(Text::new(name)?, Some(angle?), decimals))
}

/// What is known of them; nothing if nothing is.
fn known(measurements: [Option<XdrMeasurement>; 3], talker: Talker) -> Option<Content> {
    let mut sentence = Xdr::default();
    let known = measurements.into_iter().flatten();
    for (place, measurement) in sentence.measurements.iter_mut().zip(known) {
        *place = Some(measurement);
    }
    sentence.measurements[0]?;
    one(sentence.write(talker))
}
