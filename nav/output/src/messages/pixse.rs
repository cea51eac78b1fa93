//! PIXSE: the set that a Phins sends behind its heading (HDT), whole, as receivers want it, or each sentence
//! by itself.
//!
//! What is beyond the policy is empty, and so is its 1-sigma. The altitude is that above mean sea level, and
//! empty without a geoid. Surge and sway are not known and empty; heave is told once it has settled. The
//! sentences have no mark for simulated data, so from a simulator they are silent; a port that sends
//! everything says so in its status words.
//!
//! Of the status words these bits are known, and all others are 0:
//!
//! | word | bit | set |
//! |---|---|---|
//! | ALGSTS | 0 navigation | navigating |
//! | | 1 alignment | until then, but for a fault |
//! | | 2 fine alignment, 52 alignment at rest | fine alignment at the berth |
//! | | 3 dead reckoning | navigating without GNSS |
//! | | 12, 13 GNSS 1 received and valid | GNSS in use, of whatever receiver |
//! | | 31 heave settles | heave is unsettled or unknown |
//! | | 55 emulation | simulated |
//! | STATUS | 34 GNSS 1 detected | GNSS in use |
//! | | 41 UTC detected | UTC known |
//! | | 48 simulation | simulated |
//! | | 49 heading, roll, pitch not valid | any of them is beyond the policy |
//! | HT_STS | 0 to 3 | one of them: 2 error with a fault or without a solution; 1 aligning; 3 warning while heading or position is estimated, or any of heading, roll, pitch and position beyond the policy; else 0 good |
//! | | 18 to 31 no ... | everything of which nothing is known; not GNSS 1 when in use, nor UTC when known |
//!
//! The pairs of HT_STS for good and bad parts of the unit are both 0: nothing is known of them. Which log or
//! reference aids the dead reckoning is not known here either.

use insd_base::{FixQuality, Mode, Utm};
use insd_wire::nmea::{
    NmeaLine, Pixse, PixseAlgorithmStatus, PixseHighLevelStatus, PixseSystemStatus, Position,
};

use super::entry::{Content, Entry, unmarked};
use crate::redacted_epoch::RedactedEpoch;

pub(super) static ENTRIES: &[Entry] = &[
    Entry::own("PIXSE", WHOLE, |said, _| whole(said)),
    Entry::own("PIXSE.ATITUD", ATITUD, |said, _| unmarked(said, attitude)),
    Entry::own("PIXSE.POSITI", POSITI, |said, _| unmarked(said, position)),
    Entry::own("PIXSE.SPEED_", SPEED, |said, _| unmarked(said, velocity)),
    Entry::own("PIXSE.UTMWGS", UTMWGS, |said, _| unmarked(said, grid)),
    Entry::own("PIXSE.HEAVE_", HEAVE, |said, _| unmarked(said, motion)),
    Entry::own("PIXSE.TIME__", TIME, |said, _| unmarked(said, time)),
    Entry::own("PIXSE.STDHRP", STDHRP, |said, _| unmarked(said, attitude_sigma)),
    Entry::own("PIXSE.STDPOS", STDPOS, |said, _| unmarked(said, position_sigma)),
    Entry::own("PIXSE.STDSPD", STDSPD, |said, _| unmarked(said, velocity_sigma)),
    Entry::own("PIXSE.ALGSTS", ALGSTS, |said, _| unmarked(said, algorithm)),
    Entry::own("PIXSE.STATUS", STATUS, |said, _| unmarked(said, system)),
    Entry::own("PIXSE.HT_STS", HT_STS, |said, _| unmarked(said, high_level)),
];

/// The set in the order in which a unit sends it.
const SET: [fn(&RedactedEpoch<'_>) -> NmeaLine; 12] = [
    attitude,
    position,
    velocity,
    grid,
    motion,
    time,
    attitude_sigma,
    position_sigma,
    velocity_sigma,
    algorithm,
    system,
    high_level,
];

// greatest lengths, bytes
const ATITUD: usize = Pixse::Attitude { roll: None, pitch: None }.longest();
const POSITI: usize = Pixse::Position { position: None, altitude: None }.longest();
const SPEED: usize = Pixse::Velocity { north: None, east: None, down: None }.longest();
const UTMWGS: usize = Pixse::Grid { utm: None, altitude: None }.longest();
const HEAVE: usize = Pixse::Motion { surge: None, sway: None, heave: None }.longest();
const TIME: usize = Pixse::Time(None).longest();
const STDHRP: usize = Pixse::AttitudeSigma { heading: None, roll: None, pitch: None }.longest();
const STDPOS: usize = Pixse::PositionSigma { north: None, east: None, altitude: None }.longest();
const STDSPD: usize = Pixse::VelocitySigma { north: None, east: None, down: None }.longest();
const ALGSTS: usize = Pixse::Algorithm(None).longest();
const STATUS: usize = Pixse::System(None).longest();
const HT_STS: usize = Pixse::HighLevel(None).longest();
const WHOLE: usize = ATITUD
    + (POSITI + SPEED + UTMWGS + HEAVE + TIME)
    + (STDHRP + STDPOS + STDSPD)
    + (ALGSTS + STATUS + HT_STS);

fn whole(said: &RedactedEpoch<'_>) -> Option<Content> {
    let lines = || SET.iter().map(|write| write(said)).collect();
    (!said.is_muted()).then(|| Content::Lines(lines()))
}

fn attitude(said: &RedactedEpoch<'_>) -> NmeaLine {
    let (roll, pitch) = said.roll_and_pitch().unzip();
    Pixse::Attitude { roll, pitch }.write()
}

fn position(said: &RedactedEpoch<'_>) -> NmeaLine {
    let place = said.position();
    let position =
        place.map(|place| Position { latitude: place.latitude, longitude: place.longitude });
    Pixse::Position { position, altitude: said.altitude() }.write()
}

fn velocity(said: &RedactedEpoch<'_>) -> NmeaLine {
    let velocity = said.velocity().map(|velocity| velocity.0);
    Pixse::Velocity {
        north: velocity.map(|velocity| velocity.x),
        east: velocity.map(|velocity| velocity.y),
        down: velocity.map(|velocity| velocity.z),
    }
    .write()
}

fn grid(said: &RedactedEpoch<'_>) -> NmeaLine {
    let utm = said.position().and_then(|place| Utm::of(place.latitude, place.longitude));
    Pixse::Grid { utm, altitude: said.altitude() }.write()
}

fn motion(said: &RedactedEpoch<'_>) -> NmeaLine {
    let heave = said.heave().map(|heave| heave.heave);
    Pixse::Motion { surge: None, sway: None, heave }.write()
}

fn time(said: &RedactedEpoch<'_>) -> NmeaLine {
    Pixse::Time(said.civil().map(|utc| utc.time)).write()
}

fn attitude_sigma(said: &RedactedEpoch<'_>) -> NmeaLine {
    let [roll, pitch, heading] = said.attitude_sigma();
    Pixse::AttitudeSigma { heading, roll, pitch }.write()
}

fn position_sigma(said: &RedactedEpoch<'_>) -> NmeaLine {
    let sigma = said.position_sigma().map(|sigma| sigma.0);
    Pixse::PositionSigma {
        north: sigma.map(|sigma| sigma.x),
        east: sigma.map(|sigma| sigma.y),
        altitude: sigma.map(|sigma| sigma.z),
    }
    .write()
}

fn velocity_sigma(said: &RedactedEpoch<'_>) -> NmeaLine {
    let sigma = said.sigma().filter(|_| said.velocity().is_some()).map(|sigma| sigma.velocity.0);
    Pixse::VelocitySigma {
        north: sigma.map(|sigma| sigma.x),
        east: sigma.map(|sigma| sigma.y),
        down: sigma.map(|sigma| sigma.z),
    }
    .write()
}

fn algorithm(said: &RedactedEpoch<'_>) -> NmeaLine {
    use PixseAlgorithmStatus as Bit;
    let mode = said.mode();
    let navigating = mode.is_some_and(Mode::is_navigating);
    let at_berth = mode == Some(Mode::FineAlignment);
    let status = Bit::default()
        .with(Bit::NAVIGATION, navigating)
        .with(Bit::ALIGNMENT, said.is_aligning())
        .with(Bit::FINE_ALIGNMENT | Bit::STATIC_ALIGNMENT, at_berth)
        .with(Bit::DEAD_RECKONING, navigating && !said.uses_gnss())
        .with(Bit::GPS1_RECEIVED | Bit::GPS1_VALID, said.uses_gnss())
        .with(Bit::HEAVE_INITIALISATION, said.heave().is_none())
        .with(Bit::EMULATION, said.is_simulated());
    Pixse::Algorithm(Some(status)).write()
}

fn system(said: &RedactedEpoch<'_>) -> NmeaLine {
    use PixseSystemStatus as Bit;
    let status = Bit::default()
        .with(Bit::GPS1_DETECTED, said.uses_gnss())
        .with(Bit::UTC_DETECTED, said.civil().is_some())
        .with(Bit::SIMULATION, said.is_simulated())
        .with(Bit::ATTITUDE_INVALID, !has_attitude(said));
    Pixse::System(Some(status)).write()
}

fn high_level(said: &RedactedEpoch<'_>) -> NmeaLine {
    use PixseHighLevelStatus as Bit;
    let status = ABSENT
        .with(health(said), true)
        .with(Bit::NO_GPS1, !said.uses_gnss())
        .with(Bit::NO_UTC, said.civil().is_none());
    Pixse::HighLevel(Some(status)).write()
}

/// What nothing is known of counts as absent: the bit's contrary would say that it is there.
const ABSENT: PixseHighLevelStatus = {
    use PixseHighLevelStatus as Bit;
    Bit(0)
        .with(Bit::NO_GPS2, true)
        .with(Bit::NO_MANUAL_GPS, true)
        .with(Bit::NO_BOTTOM_TRACK, true)
        .with(Bit::NO_WATER_TRACK, true)
        .with(Bit::NO_EM_LOG, true)
        .with(Bit::NO_DEPTH, true)
        .with(Bit::NO_USBL, true)
        .with(Bit::NO_LBL, true)
        .with(Bit::NO_ALTITUDE, true)
        .with(Bit::NO_PPS, true)
        .with(Bit::NO_SOUND_VELOCITY, true)
        .with(Bit::NO_ZERO_VELOCITY_MODE, true)
};

fn health(said: &RedactedEpoch<'_>) -> PixseHighLevelStatus {
    let estimated = said.is_heading_estimated()
        || matches!(said.quality(), FixQuality::Estimated | FixQuality::Invalid);
    match said.mode() {
        None | Some(Mode::Fault) => PixseHighLevelStatus::ERROR,
        Some(mode) if !mode.is_navigating() => PixseHighLevelStatus::ALIGNING,
        Some(_) if estimated || !has_attitude(said) => PixseHighLevelStatus::WARNING,
        Some(_) => PixseHighLevelStatus::GOOD,
    }
}

fn has_attitude(said: &RedactedEpoch<'_>) -> bool {
    said.heading().is_some() && said.roll_and_pitch().is_some()
}
