//! Binary and other telegrams of motion sensors, for echo sounders and survey equipment.
//!
//! None has a mark for simulated data, so from a simulator they are silent. Where a format gives one mark
//! to several values it stands for the worst of them.
//!
//! | | status | reduced | not valid |
//! |---|---|---|---|
//! | `TSS1` | letter, see [`aiding`]; small until the heave has settled | | not sent |
//! | `EM1000` | none | | each value by itself |
//! | `EM3000` | one for all, see [`status`] | | each value by itself |
//! | `KMB`, `SEAPATH.23`, `SEAPATH.26` | bits for each group | position: GGA 6; heading: THS E; heave: by its quality | unknown, or beyond the policy |

use insd_base::{FixQuality, Heave, HeaveQuality, Mode};
use insd_wire::motion::em::{self, EmAttitude, EmStatus};
use insd_wire::motion::kmb::{self, Kmb, KmbSigma};
use insd_wire::motion::seapath::{self, Seapath23, Seapath26};
use insd_wire::motion::tss1::{self, Tss1, Tss1Aiding};
use insd_wire::motion::{
    Rated, SensorDelayedHeave, SensorPlace, Tilt, Vertical, roll_from_horizon,
};
use insd_wire::nmea::Talker;

use super::entry::{Content, Entry};
use crate::redacted_epoch::RedactedEpoch;

pub(super) static ENTRIES: &[Entry] = &[
    Entry { name: "TSS1", talker: None, longest: tss1::LENGTH, make: tss1 },
    Entry { name: "EM1000", talker: None, longest: em::LENGTH, make: em1000 },
    Entry { name: "EM3000", talker: None, longest: em::LENGTH, make: em3000 },
    Entry { name: "KMB", talker: None, longest: kmb::LENGTH, make: kmb },
    Entry { name: "SEAPATH.23", talker: None, longest: seapath::LENGTH_23, make: seapath_23 },
    Entry { name: "SEAPATH.26", talker: None, longest: seapath::LENGTH_26, make: seapath_26 },
];

/// TSS1 cannot say that something is unknown: it is sent when all of it is known, and that includes the
/// accelerations. Roll is against the horizon, arcsin(sin roll cos pitch), as the makers' manuals have it;
/// the horizontal acceleration is the magnitude of both components.
fn tss1(said: &RedactedEpoch<'_>, _: Talker) -> Option<Content> {
    let (roll, pitch) = said.roll_and_pitch()?;
    let heave = said.any_heave()?;
    let level = said.level_acceleration()?;
    let telegram = Tss1 {
        horizontal_acceleration: level.forward.hypot(level.starboard),
        vertical_acceleration: -said.acceleration()?.0.z,
        heave: heave.heave,
        aiding: aiding(said),
        settled: heave.quality > HeaveQuality::Unsettled,
        roll: roll_from_horizon(roll, pitch),
        pitch,
    };
    binary(telegram.write()?)
}

/// What helps: the ship's speed from GNSS, a log or a reference, and her heading once it may be told.
///
/// | mode | letter |
/// |---|---|
/// | aided, dead reckoning | F, both; G, speed, if the heading is beyond the policy |
/// | inertial | H, heading; U if that is beyond the policy |
/// | alignment in motion | G, speed |
/// | levelling, alignment at the berth | U, nothing |
fn aiding(said: &RedactedEpoch<'_>) -> Tss1Aiding {
    let speed =
        matches!(said.mode(), Some(Mode::Aided | Mode::DeadReckoning | Mode::InMotionAlignment));
    match (speed, said.heading().is_some()) {
        (true, true) => Tss1Aiding::Full,
        (true, false) => Tss1Aiding::Speed,
        (false, true) => Tss1Aiding::Heading,
        (false, false) => Tss1Aiding::Unaided,
    }
}

/// EM1000 has no status: heave that has not settled is unknown, and where all is unknown nothing is sent.
fn em1000(said: &RedactedEpoch<'_>, _: Talker) -> Option<Content> {
    let telegram = em_attitude(said, None, said.heave());
    let known = [telegram.roll, telegram.heave, telegram.heading].iter().any(Option::is_some);
    known.then(|| binary(telegram.write())).flatten()
}

/// EM3000 is sent whatever is known, as its status says it.
fn em3000(said: &RedactedEpoch<'_>, _: Talker) -> Option<Content> {
    if said.is_muted() {
        return None;
    }
    let status = status(said);
    let heave = said.any_heave().filter(|_| status != EmStatus::Error);
    binary(em_attitude(said, Some(status), heave).write())
}

/// Roll is against the horizon, arcsin(sin roll cos pitch), as the maker's manuals have it.
fn em_attitude(
    said: &RedactedEpoch<'_>,
    status: Option<EmStatus>,
    heave: Option<Heave>,
) -> EmAttitude {
    let tilt = said.roll_and_pitch();
    EmAttitude {
        status,
        roll: tilt.map(|(roll, pitch)| roll_from_horizon(roll, pitch)),
        pitch: tilt.map(|(_, pitch)| pitch),
        heave: heave.map(|heave| heave.heave),
        heading: said.heading(),
    }
}

/// | | status |
/// |---|---|
/// | no solution, or a fault | A0 |
/// | aligning, not level, or no settled heave | 9A |
/// | dead reckoning, inertial, heave reduced, heading estimated or unknown | 91 |
/// | all others | 90 |
fn status(said: &RedactedEpoch<'_>) -> EmStatus {
    let Some(mode) = said.mode().filter(|mode| *mode != Mode::Fault) else {
        return EmStatus::Error;
    };
    let Some(heave) = said.heave().filter(|_| said.roll_and_pitch().is_some()) else {
        return EmStatus::Unsettled;
    };
    let good_heading = said.heading().is_some() && !said.is_heading_estimated();
    match mode {
        _ if !mode.is_navigating() => EmStatus::Unsettled,
        Mode::Aided if heave.quality == HeaveQuality::Settled && good_heading => EmStatus::Normal,
        _ => EmStatus::Reduced,
    }
}

/// Without UTC, or with a fault, there is no telegram: it cannot say that its time or its rates are
/// unknown. The acceleration to north and east is as good as the heading.
fn kmb(said: &RedactedEpoch<'_>, _: Talker) -> Option<Content> {
    let acceleration = said.acceleration().filter(|_| said.heading().is_some());
    let reduced = said.is_heading_estimated();
    let telegram = Kmb {
        time: said.utc()?,
        place: place(said),
        tilt: tilt(said),
        heading: heading(said),
        vertical: vertical(said),
        rates: said.any_rates()?.0.into(),
        acceleration: acceleration.map(|value| Rated { value: value.0.into(), reduced }),
        delayed_heave: delayed_heave(said),
        sigma: kmb_sigma(said),
    };
    binary(telegram.write()?)
}

fn seapath_23(said: &RedactedEpoch<'_>, _: Talker) -> Option<Content> {
    binary(seapath(said)?.write()?)
}

/// It has no mark for a reduced delayed heave, which is told as it is.
fn seapath_26(said: &RedactedEpoch<'_>, _: Talker) -> Option<Content> {
    let delayed_heave = delayed_heave(said).map(|delayed| delayed.value);
    binary(Seapath26 { motion: seapath(said)?, delayed_heave }.write()?)
}

/// Without UTC, or with a fault, there is no telegram, as for KMB.
fn seapath(said: &RedactedEpoch<'_>) -> Option<Seapath23> {
    Some(Seapath23 {
        time: said.utc()?,
        place: place(said),
        tilt: tilt(said),
        heading: heading(said),
        vertical: vertical(said),
        rates: said.any_rates()?.0.into(),
    })
}

/// Position and velocity have one mark: they are told together or not at all.
fn place(said: &RedactedEpoch<'_>) -> Option<Rated<SensorPlace>> {
    let (position, velocity) = (said.position()?, said.velocity()?);
    let value = SensorPlace {
        latitude: position.latitude,
        longitude: position.longitude,
        height: position.height,
        north_velocity: velocity.0.x,
        east_velocity: velocity.0.y,
    };
    Some(Rated { value, reduced: said.quality() == FixQuality::Estimated })
}

fn tilt(said: &RedactedEpoch<'_>) -> Option<Rated<Tilt>> {
    let (roll, pitch) = said.roll_and_pitch()?;
    Some(Rated { value: Tilt { roll, pitch }, reduced: false })
}

fn heading(said: &RedactedEpoch<'_>) -> Option<Rated<f64>> {
    Some(Rated { value: said.heading()?, reduced: said.is_heading_estimated() })
}

/// The vertical velocity shares its mark with the heave, so it is that of the heave.
fn vertical(said: &RedactedEpoch<'_>) -> Option<Rated<Vertical>> {
    let heave = said.heave()?;
    let value = Vertical { heave: heave.heave, down_velocity: -heave.rate };
    Some(Rated { value, reduced: heave.quality == HeaveQuality::Reduced })
}

fn delayed_heave(said: &RedactedEpoch<'_>) -> Option<Rated<SensorDelayedHeave>> {
    let (time, delayed) = said.delayed_heave()?;
    let value = SensorDelayedHeave { time, heave: delayed.heave };
    Some(Rated { value, reduced: delayed.quality == HeaveQuality::Reduced })
}

/// The errors of what is told.
fn kmb_sigma(said: &RedactedEpoch<'_>) -> KmbSigma {
    let position = place(said).and_then(|_| said.position_sigma());
    let level = said.sigma().filter(|_| said.roll_and_pitch().is_some());
    KmbSigma {
        north: position.map(|sigma| sigma.0.x),
        east: position.map(|sigma| sigma.0.y),
        height: position.map(|sigma| sigma.0.z),
        roll: level.map(|sigma| sigma.roll),
        pitch: level.map(|sigma| sigma.pitch),
        heading: said.sigma().filter(|_| said.heading().is_some()).map(|sigma| sigma.heading),
        heave: said.heave().map(|heave| heave.sigma),
    }
}

fn binary<const N: usize>(telegram: [u8; N]) -> Option<Content> {
    Some(Content::Binary(telegram.to_vec()))
}
