//! Position, and how good it is.

use insd_wire::nmea::{
    Gbs, Gga, Gll, Gns, Gst, MAX_SYSTEMS, NavStatus, Position, PositionMode, Rmc, Talker,
};

use super::entry::{Content, Entry, one};
use crate::redacted_epoch::RedactedEpoch;

pub(super) static ENTRIES: &[Entry] = &[
    Entry { name: "GGA", talker: Some(Talker::IN), longest: Gga::LONGEST, make: gga },
    Entry { name: "GNS", talker: Some(Talker::IN), longest: Gns::LONGEST, make: gns },
    Entry { name: "GLL", talker: Some(Talker::IN), longest: Gll::LONGEST, make: gll },
    Entry { name: "GST", talker: Some(Talker::IN), longest: Gst::LONGEST, make: gst },
    Entry { name: "GBS", talker: Some(Talker::IN), longest: Gbs::LONGEST, make: gbs },
];

/// RMC alone, which leaves after all other sentences of position and speed. gpsd takes the last one that bears
/// a time for the end of an epoch and publishes its fix there and then, with all that came before: altitude of
/// GGA, magnetic course of VTG. GGA, the other one, says that there is no fix where a ship sails by dead
/// reckoning and so names no satellites.
pub(super) static LAST: &[Entry] =
    &[Entry { name: "RMC", talker: Some(Talker::IN), longest: Rmc::LONGEST, make: rmc }];

fn place(said: &RedactedEpoch<'_>) -> Option<Position> {
    let place = said.position()?;
    Some(Position { latitude: place.latitude, longitude: place.longitude })
}

fn satellites(said: &RedactedEpoch<'_>) -> Option<u8> {
    said.receiver().satellites.map(|count| u8::try_from(count).unwrap_or(u8::MAX).min(99))
}

fn gga(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    let said = said.marked();
    one(Gga {
        time: said.civil().map(|utc| utc.time),
        position: place(&said),
        quality: said.marked_quality(),
        satellites: satellites(&said),
        hdop: said.receiver().hdop,
        altitude: said.altitude(),
        geoid_separation: said.geoid(),
        ..Gga::default()
    }
    .write(talker))
}

fn gns(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    let said = said.marked();
    let mode = said.position_mode();
    let mut modes = [None; MAX_SYSTEMS];
    // GPS and GLONASS must have a letter, and the solution is one of all that is received
    modes[0] = Some(mode);
    modes[1] = Some(mode);
    one(Gns {
        time: said.civil().map(|utc| utc.time),
        position: place(&said),
        modes,
        satellites: satellites(&said),
        hdop: said.receiver().hdop,
        altitude: said.altitude(),
        geoid_separation: said.geoid(),
        nav_status: Some(nav_status(mode)),
        ..Gns::default()
    }
    .write(talker))
}

/// Variation is always told where it is known: consumers that make it up themselves differ.
fn rmc(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    let said = said.marked();
    let mode = said.position_mode();
    let (course, speed) = said.course_and_speed().unzip();
    one(Rmc {
        time: said.civil().map(|utc| utc.time),
        valid: said.is_valid(mode),
        position: place(&said),
        speed,
        course: course.flatten(),
        date: said.civil().map(|utc| utc.date),
        variation: said.variation().map(|variation| variation.value),
        mode: Some(mode),
        nav_status: Some(nav_status(mode)),
    }
    .write(talker))
}

fn gll(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    let said = said.marked();
    let mode = said.position_mode();
    one(Gll {
        position: place(&said),
        time: said.civil().map(|utc| utc.time),
        valid: said.is_valid(mode),
        mode: Some(mode),
    }
    .write(talker))
}

/// The root mean square of range residuals is empty: an inertial solution has none.
fn gst(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    if said.is_muted() {
        return None;
    }
    let (sigma, ellipse) = (said.position_sigma(), said.ellipse());
    one(Gst {
        time: said.civil().map(|utc| utc.time),
        range_rms: None,
        major_std: ellipse.map(|ellipse| ellipse.major),
        minor_std: ellipse.map(|ellipse| ellipse.minor),
        orientation: ellipse.map(|ellipse| ellipse.orientation),
        latitude_std: sigma.map(|sigma| sigma.0.x),
        longitude_std: sigma.map(|sigma| sigma.0.y),
        altitude_std: sigma.map(|sigma| sigma.0.z),
    }
    .write(talker))
}

/// The expected errors are 1-sigma. Of failing satellites an inertial solution says nothing.
fn gbs(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    if said.is_muted() {
        return None;
    }
    let sigma = said.position_sigma();
    one(Gbs {
        time: said.civil().map(|utc| utc.time),
        latitude_error: sigma.map(|sigma| sigma.0.x),
        longitude_error: sigma.map(|sigma| sigma.0.y),
        altitude_error: sigma.map(|sigma| sigma.0.z),
        ..Gbs::default()
    }
    .write(talker))
}

/// Safe is what is within the policy's limits with GNSS in use; estimated and simulated positions ask for
/// caution.
fn nav_status(mode: PositionMode) -> NavStatus {
    match mode {
        PositionMode::NotValid => NavStatus::NotProvided,
        PositionMode::Estimated | PositionMode::Simulator | PositionMode::Manual => {
            NavStatus::Caution
        }
        _ => NavStatus::Safe,
    }
}
