//! An epoch as each of the groups.

use insd_base::{self as base, FixQuality};
use insd_n2k::pgn::{
    Attitude, CourseSpeed, Direction, Dops, FixMethod, FixMode, GnssPosition, GnssSystem, Group,
    Heading, Heave, Integrity, MagneticVariation, North, PositionRapid, PseudorangeNoise,
    RateOfTurn, SetDrift, Speed, SpeedComponents, SystemTime, TimeDate, VariationSource,
};

use crate::redacted_epoch::{Level, RedactedEpoch};

/// Resolution of times on the bus: 100 us.
const TICK: i64 = 100_000;
const TICKS_PER_SECOND: f64 = 1e4;

/// Days since 1970-01-01 and seconds of the day, UTC. Rounded to the resolution of the bus before it is
/// taken apart, so that no day has a second 86400.
fn utc(said: &RedactedEpoch<'_>) -> Option<(u16, f64)> {
    let ticks = said.utc()?.as_nanos().saturating_add(TICK / 2).div_euclid(TICK);
    let day = 86_400 * 1_000_000_000 / TICK;
    let date = u16::try_from(ticks.div_euclid(day)).ok()?;
    Some((date, ticks.rem_euclid(day) as f64 / TICKS_PER_SECOND))
}

/// A group that is made from an epoch.
pub(crate) trait Say: Group {
    /// What it says of the epoch.
    fn say(said: &RedactedEpoch<'_>) -> Self;
}

impl Say for Heading {
    fn say(said: &RedactedEpoch<'_>) -> Self {
        let heading = said.heading();
        Heading {
            sid: said.sid,
            heading,
            deviation: None,
            variation: said.variation().map(|variation| variation.value),
            reference: heading.map(|_| North::True),
        }
    }
}

impl Say for RateOfTurn {
    fn say(said: &RedactedEpoch<'_>) -> Self {
        RateOfTurn { sid: said.sid, rate: said.rate_of_turn() }
    }
}

impl Say for Heave {
    fn say(said: &RedactedEpoch<'_>) -> Self {
        Heave { sid: said.sid, heave: said.heave().map(|heave| heave.heave) }
    }
}

impl Say for Attitude {
    fn say(said: &RedactedEpoch<'_>) -> Self {
        let (roll, pitch) = said.roll_and_pitch().unzip();
        Attitude { sid: said.sid, yaw: said.heading(), pitch, roll }
    }
}

impl Say for MagneticVariation {
    fn say(said: &RedactedEpoch<'_>) -> Self {
        let variation = said.variation();
        MagneticVariation {
            sid: said.sid,
            source: variation.map(|variation| VariationSource::Wmm(variation.model)),
            date: variation.and_then(|variation| variation.day),
            variation: variation.map(|variation| variation.value),
        }
    }
}

impl Say for Speed {
    fn say(said: &RedactedEpoch<'_>) -> Self {
        let forward = [said.through_water(), said.over_ground()]
            .map(|level| level.map(|level| level.forward));
        let [water, ground] = forward.map(|speed| speed.map(f64::abs));
        Speed { sid: said.sid, water, ground, kind: None, direction: way(said, &forward) }
    }
}

/// The way she goes, if both speeds that are known agree on it. The group has one sign for both, and a
/// ship that drifts astern over ground may well make way through the water.
fn way(said: &RedactedEpoch<'_>, forward: &[Option<f64>]) -> Option<Direction> {
    let mut ways = forward.iter().flatten().filter_map(|speed| said.directed(*speed));
    let ahead = ways.next()? > 0.0;
    let way = if ahead { Direction::Forward } else { Direction::Reverse };
    ways.all(|speed| (speed > 0.0) == ahead).then_some(way)
}

impl Say for SpeedComponents {
    fn say(said: &RedactedEpoch<'_>) -> Self {
        let parts = |level: Level| (level.forward, level.starboard);
        let (forward_water, starboard_water) = said.through_water().map(parts).unzip();
        let (forward_ground, starboard_ground) = said.over_ground().map(parts).unzip();
        SpeedComponents {
            forward_water,
            starboard_water,
            forward_ground,
            starboard_ground,
            stern_starboard_water: said.stern_through_water().map(|level| level.starboard),
            stern_starboard_ground: said.stern_over_ground().map(|level| level.starboard),
        }
    }
}

impl Say for PositionRapid {
    fn say(said: &RedactedEpoch<'_>) -> Self {
        let (latitude, longitude) =
            said.position().map(|place| (place.latitude, place.longitude)).unzip();
        PositionRapid { latitude, longitude }
    }
}

impl Say for CourseSpeed {
    fn say(said: &RedactedEpoch<'_>) -> Self {
        let (course, speed) = said.course_and_speed().unzip();
        let course = course.flatten();
        CourseSpeed { sid: said.sid, reference: course.map(|_| North::True), course, speed }
    }
}

impl Say for GnssPosition {
    fn say(said: &RedactedEpoch<'_>) -> Self {
        let marked = said.marked();
        let (place, quality, receiver) = (marked.position(), marked.quality(), marked.receiver());
        let watch = marked.judgement().map(|judgement| judgement.integrity).unwrap_or_default();
        let (date, time) = utc(said).unzip();
        GnssPosition {
            sid: said.sid,
            date,
            time,
            latitude: place.map(|place| place.latitude),
            longitude: place.map(|place| place.longitude),
            altitude: place.map(|place| place.height),
            system: Some(GnssSystem::Integrated),
            method: Some(method(quality, said.is_simulated())),
            integrity: Some(integrity(quality, watch)),
            satellites: receiver.satellites.and_then(|satellites| u8::try_from(satellites).ok()),
            hdop: receiver.hdop,
            pdop: receiver.pdop,
            geoid: marked.geoid(),
            stations: Vec::new(),
        }
    }
}

fn method(quality: FixQuality, simulated: bool) -> FixMethod {
    match quality {
        FixQuality::Invalid => FixMethod::NoFix,
        _ if simulated => FixMethod::Simulated,
        FixQuality::Autonomous => FixMethod::Gnss,
        FixQuality::Differential => FixMethod::Differential,
        FixQuality::Precise => FixMethod::Precise,
        FixQuality::RtkFixed => FixMethod::RtkFixed,
        FixQuality::RtkFloat => FixMethod::RtkFloat,
        FixQuality::Estimated => FixMethod::DeadReckoning,
        FixQuality::Manual => FixMethod::Manual,
        FixQuality::Simulated => FixMethod::Simulated,
    }
}

/// Safe is what bridge equipment trusts, and what the sensors bear out; where nobody compares them nobody can say so.
/// Unsafe is also what all ones say, so that a field that is not available can be taken for nothing better.
fn integrity(quality: FixQuality, watch: base::Integrity) -> Integrity {
    match (quality, watch) {
        (FixQuality::Invalid, _) => Integrity::Unsafe,
        (FixQuality::Estimated | FixQuality::Manual | FixQuality::Simulated, _) => {
            Integrity::Caution
        }
        (_, base::Integrity::Unproven | base::Integrity::Contradiction) => Integrity::Caution,
        (_, base::Integrity::Unwatched) => Integrity::NoChecking,
        (_, base::Integrity::Consistent) => Integrity::Safe,
    }
}

impl Say for TimeDate {
    fn say(said: &RedactedEpoch<'_>) -> Self {
        let (date, time) = utc(said).unzip();
        TimeDate { date, time, local_offset: None }
    }
}

impl Say for SystemTime {
    fn say(said: &RedactedEpoch<'_>) -> Self {
        let (date, time) = utc(said).unzip();
        SystemTime { sid: said.sid, source: said.time_source(), date, time }
    }
}

impl Say for Dops {
    fn say(said: &RedactedEpoch<'_>) -> Self {
        let receiver = said.receiver();
        Dops {
            sid: said.sid,
            desired: None,
            // only a fix with height has a vertical dilution
            actual: receiver.vdop.map(|_| FixMode::ThreeD),
            hdop: receiver.hdop,
            vdop: receiver.vdop,
            tdop: receiver.tdop,
        }
    }
}

impl Say for SetDrift {
    fn say(said: &RedactedEpoch<'_>) -> Self {
        let current = said.current().map(|current| current.0);
        let drift = current.map(|current| current.xy().norm());
        let set = current
            .filter(|_| drift.is_some_and(|drift| said.directed(drift).is_some()))
            .map(|current| current.y.atan2(current.x));
        SetDrift { sid: said.sid, reference: set.map(|_| North::True), set, drift }
    }
}

impl Say for PseudorangeNoise {
    fn say(said: &RedactedEpoch<'_>) -> Self {
        let sigma = said.position_sigma().map(|sigma| sigma.0);
        let ellipse = said.ellipse();
        PseudorangeNoise {
            sid: said.sid,
            range_rms: None,
            major: ellipse.map(|ellipse| ellipse.major),
            minor: ellipse.map(|ellipse| ellipse.minor),
            orientation: ellipse.map(|ellipse| ellipse.orientation),
            latitude_std: sigma.map(|sigma| sigma.x),
            longitude_std: sigma.map(|sigma| sigma.y),
            altitude_std: sigma.map(|sigma| sigma.z),
        }
    }
}
