//! Time and what belongs to it.

use insd_wire::nmea::{Datum, Dtm, Talker, Zda};

use super::entry::{Content, Entry, one};
use crate::redacted_epoch::RedactedEpoch;

pub(super) static ENTRIES: &[Entry] = &[
    Entry { name: "ZDA", talker: Some(Talker::IN), longest: Zda::LONGEST, make: zda },
    Entry { name: "DTM", talker: Some(Talker::IN), longest: Dtm::LONGEST, make: dtm },
];

fn zda(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    one(Zda { utc: said.civil(), zone: None }.write(talker))
}

/// Positions are given in WGS-84, as they are.
fn dtm(_: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    let wgs84 = Datum::new("W84");
    one(Dtm {
        datum: wgs84,
        subdivision: None,
        latitude_offset: Some(0.0),
        longitude_offset: Some(0.0),
        altitude_offset: Some(0.0),
        reference: wgs84,
    }
    .write(talker))
}
