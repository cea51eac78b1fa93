//! What an Octans sends behind its heading (HDT): PHTRO, PHLIN, PHSPD, PHCMP, PHINF; and PHOCT.
//!
//! Surge and sway are not known and empty. Heave that has not settled is told by PHOCT alone, which can say
//! so. None has a mark for simulated data, so from a simulator they are silent.
//!
//! PHINF has the bits of an Octans, of which these are known; all others are 0:
//!
//! | bit | set |
//! |---|---|
//! | 0 heading invalid | THS V |
//! | 1, 2 roll, pitch invalid | beyond the policy |
//! | 3 heave settles | heave is unsettled or unknown |
//! | 5 alignment | until it navigates, but for a fault |
//! | 27 an angle is invalid | with any of 0 to 2 |

use insd_base::HeaveQuality;
use insd_wire::nmea::{
    Marked, NmeaLine, OctansStatus, Phcmp, Phinf, Phlin, Phoct, PhoctState, Phspd, Phtro,
    SurgeSwayHeave,
};

use super::entry::{Entry, unmarked};
use crate::redacted_epoch::RedactedEpoch;

pub(super) static ENTRIES: &[Entry] = &[
    Entry::own("PHTRO", Phtro::LONGEST, |said, _| unmarked(said, phtro)),
    Entry::own("PHLIN", Phlin::LONGEST, |said, _| unmarked(said, phlin)),
    Entry::own("PHSPD", Phspd::LONGEST, |said, _| unmarked(said, phspd)),
    Entry::own("PHCMP", Phcmp::LONGEST, |said, _| unmarked(said, phcmp)),
    Entry::own("PHINF", Phinf::LONGEST, |said, _| unmarked(said, phinf)),
    Entry::own("PHOCT", Phoct::LONGEST, |said, _| unmarked(said, phoct)),
];

fn phtro(said: &RedactedEpoch<'_>) -> NmeaLine {
    let (roll, pitch) = said.roll_and_pitch().unzip();
    Phtro { roll, pitch }.write()
}

fn phlin(said: &RedactedEpoch<'_>) -> NmeaLine {
    let heave = said.heave().map(|heave| heave.heave);
    Phlin { heave, ..Phlin::default() }.write()
}

fn phspd(said: &RedactedEpoch<'_>) -> NmeaLine {
    let heave = said.heave().map(|heave| heave.rate);
    Phspd { heave, ..Phspd::default() }.write()
}

/// The speed is that over ground.
fn phcmp(said: &RedactedEpoch<'_>) -> NmeaLine {
    let latitude = said.position().map(|place| place.latitude);
    let speed = said.course_and_speed().map(|(_, speed)| speed);
    Phcmp { latitude, speed }.write()
}

fn phinf(said: &RedactedEpoch<'_>) -> NmeaLine {
    use OctansStatus as Bit;
    let (heading, level) = (said.heading().is_some(), said.roll_and_pitch().is_some());
    let status = Bit::default()
        .with(Bit::HEADING_INVALID, !heading)
        .with(Bit::ROLL_INVALID | Bit::PITCH_INVALID, !level)
        .with(Bit::HEAVE_INITIALISATION, said.heave().is_none())
        .with(Bit::ALIGNMENT, said.is_aligning())
        .with(Bit::ATTITUDE_INVALID, !(heading && level));
    Phinf::of_octans(status).write()
}

/// The values are those of the instant that it tells, so they have no latency against it. The heave at the
/// primary lever arm and that at the chosen one are both that of the port's monitoring point.
fn phoct(said: &RedactedEpoch<'_>) -> NmeaLine {
    let time = said.civil().map(|utc| utc.time);
    let (roll, pitch) = said.roll_and_pitch().unzip();
    let heave = heave(said);
    let rate = said.any_heave().map(|heave| heave.rate);
    Phoct {
        time,
        time_valid: time.is_some(),
        latency_ms: time.map(|_| 0),
        heading: angle(said, said.heading()),
        roll: angle(said, roll),
        pitch: angle(said, pitch),
        heave,
        motion: SurgeSwayHeave { heave: heave.value, ..SurgeSwayHeave::default() },
        rates: SurgeSwayHeave { heave: rate, ..SurgeSwayHeave::default() },
        rate_of_turn: said.rate_of_turn(),
    }
    .write()
}

/// An angle that is not known yet is initialising while the system aligns.
fn angle(said: &RedactedEpoch<'_>, value: Option<f64>) -> Marked {
    let state = match value {
        Some(_) => PhoctState::Valid,
        None if said.is_aligning() => PhoctState::Initialising,
        None => PhoctState::Invalid,
    };
    Marked { value, state }
}

/// Heave of any quality; until it has settled it is initialising.
fn heave(said: &RedactedEpoch<'_>) -> Marked {
    let heave = said.any_heave();
    let state = match heave.map(|heave| heave.quality) {
        Some(HeaveQuality::Unsettled) => PhoctState::Initialising,
        Some(HeaveQuality::Reduced | HeaveQuality::Settled) => PhoctState::Valid,
        None => PhoctState::Invalid,
    };
    Marked { value: heave.map(|heave| heave.heave), state }
}
