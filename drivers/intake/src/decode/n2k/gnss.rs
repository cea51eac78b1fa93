//! Receivers of NMEA 2000.
//!
//! The fix (129029) tells the time of its epoch; velocity (129026), dilutions (129539) and sigmas
//! (129542) do not. They belong to the fix with the same SID, before or after it. Not all receivers
//! count so: some send no SID, some always the same, some count each group for itself (recordings hold
//! all three). Where SIDs do not link, a message belongs to the fix it came with, so the velocity may
//! be as old as the time between two of them.
//!
//! System time (126992) and date (129033) are not needed where the fix tells both. A fix without a time
//! takes that of the system time with its SID; else they tell UTC, if a satellite system is its source.

use insd_base::{FixQuality, Geodetic, Time};
use insd_n2k::pgn::{
    CourseSpeed, Dops, FixMethod, GnssPosition, Integrity, Known, North, PseudorangeNoise, Sid,
    SystemTime, TimeSource, utc,
};
use insd_wire::gnss::{EpochTime, GnssPart};
use insd_wire::nmea::{Position, TimeOfDay};

use crate::config::SensorConfig;
use crate::decode::reading::Reading;
use crate::event::Refusal;

/// Messages with the same SID that are farther apart than this are of different epochs, s: the count
/// starts again after 253.
const LINKED: f64 = 1.0;
/// Fixes without a message of their SID, though some came, after which SIDs are taken not to link.
const UNLINKED: u8 = 3;
/// Course is not told at rest; a speed below this is none, m/s.
const REST: f64 = 0.005;

/// Groups beside the fix.
#[derive(Clone, Copy, Debug)]
enum Beside {
    Velocity,
    Dilution,
    Sigmas,
}

/// What a receiver said before.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct GnssState {
    beside: [Linked; 3],
    fix: Option<(Sid, EpochTime, Time)>,
    /// Time told by a system time.
    clock: Option<(Sid, EpochTime, Time)>,
    /// When a fix last told date and time of its own.
    timed: Option<Time>,
    /// When the first message of the last fix came, if that was another.
    first: Option<Time>,
}

/// The messages of one group, and how they link to fixes.
#[derive(Clone, Copy, Debug, Default)]
struct Linked {
    last: Sid,
    /// Waits for its fix.
    held: Option<(Sid, GnssPart, Time)>,
    /// Since the last fix: whether one came, and whether one was linked to a fix.
    came: bool,
    linked: bool,
    /// Fixes in a row to which none was linked.
    missed: u8,
}

impl GnssState {
    pub(super) fn known(
        &mut self,
        known: &Known,
        begun: Time,
        config: &SensorConfig,
    ) -> Result<Vec<Reading>, Refusal> {
        match known {
            Known::GnssPosition(fix) => self.fix(fix, begun, config),
            Known::CourseSpeed(own) => {
                let part = velocity(own)?;
                Ok(self.enter(Beside::Velocity, own.sid, part, begun))
            }
            Known::Dops(dops) => Ok(self.enter(Beside::Dilution, dops.sid, dilution(dops), begun)),
            Known::PseudorangeNoise(noise) => {
                Ok(self.enter(Beside::Sigmas, noise.sid, sigmas(noise), begun))
            }
            Known::SystemTime(own) => Ok(self.system_time(own, begun, config)),
            Known::TimeDate(own) => {
                let told = utc(own.date, own.time).map(EpochTime::Utc);
                Ok(self.clock_reading(told, begun, config))
            }
            _ => Ok(vec![Reading::Idle]),
        }
    }

    fn fix(
        &mut self,
        fix: &GnssPosition,
        begun: Time,
        config: &SensorConfig,
    ) -> Result<Vec<Reading>, Refusal> {
        let own = utc(fix.date, fix.time).map(EpochTime::Utc);
        if own.is_some() {
            self.timed = Some(begun);
        }
        let lent = self.clock.filter(|(sid, _, at)| is_linked(*sid, fix.sid, *at, begun));
        let clock = fix.time.and_then(time_of_day).map(EpochTime::TimeOfDay);
        let epoch = own.or(lent.map(|(_, epoch, _)| epoch)).or(clock);
        let epoch = epoch.ok_or(Refusal::NoTime)?;
        self.fix = Some((fix.sid, epoch, begun));
        let held = self.beside.each_mut().map(|own| own.fix(fix.sid, begun));
        let (held, came): (Vec<_>, Vec<_>) = held.into_iter().flatten().unzip();
        self.first = came.into_iter().min();
        let parts = std::iter::once(part(fix, config)).chain(held);
        let timed = parts.map(|part| GnssPart { epoch: Some(epoch), ..part });
        Ok(timed.map(Reading::Gnss).collect())
    }

    /// When the first message came of the fix that has just been told, if that was another.
    pub(super) fn first(&mut self) -> Option<Time> {
        self.first.take()
    }

    /// A part beside the fix: of the last fix, of the next, or of the one it came with.
    fn enter(&mut self, group: Beside, sid: Sid, part: GnssPart, begun: Time) -> Vec<Reading> {
        let own = &mut self.beside[group as usize];
        if !own.links(sid) {
            return vec![Reading::Gnss(part)];
        }
        let fix = self.fix.filter(|(other, _, at)| is_linked(*other, sid, *at, begun));
        if let Some((_, epoch, _)) = fix {
            own.linked = true;
            return vec![Reading::Gnss(GnssPart { epoch: Some(epoch), ..part })];
        }
        own.held = Some((sid, part, begun));
        vec![Reading::Idle]
    }

    fn system_time(
        &mut self,
        own: &SystemTime,
        begun: Time,
        config: &SensorConfig,
    ) -> Vec<Reading> {
        let by_satellites = matches!(own.source, Some(TimeSource::Gps | TimeSource::Glonass));
        let told = utc(own.date, own.time).filter(|_| by_satellites).map(EpochTime::Utc);
        self.clock = told.map(|epoch| (own.sid, epoch, begun));
        self.clock_reading(told, begun, config)
    }

    fn clock_reading(
        &self,
        told: Option<EpochTime>,
        begun: Time,
        config: &SensorConfig,
    ) -> Vec<Reading> {
        let needed = !config.is_recent(self.timed, begun);
        vec![told.filter(|_| needed).map_or(Reading::Idle, Reading::Clock)]
    }
}

impl Linked {
    /// Takes the SID of a message and says whether SIDs link messages of its group.
    fn links(&mut self, sid: Sid) -> bool {
        let counts = sid.is_some() && sid != self.last;
        self.last = sid;
        self.came = true;
        counts && self.missed < UNLINKED
    }

    /// A fix has come; gives the part that waited for it, and when it came.
    fn fix(&mut self, sid: Sid, begun: Time) -> Option<(GnssPart, Time)> {
        if self.linked {
            self.missed = 0;
        } else if self.came {
            self.missed = self.missed.saturating_add(1).min(UNLINKED);
        }
        let held = self.held.take().filter(|(own, _, at)| is_linked(*own, sid, *at, begun));
        (self.came, self.linked) = (false, held.is_some());
        held.map(|(_, part, at)| (part, at))
    }
}

fn is_linked(own: Sid, other: Sid, at: Time, now: Time) -> bool {
    own.is_some() && own == other && (now - at).as_seconds() < LINKED
}

fn part(fix: &GnssPosition, config: &SensorConfig) -> GnssPart {
    let place = fix.latitude.zip(fix.longitude);
    let height = if config.altitude_above_geoid {
        fix.altitude.zip(fix.geoid).map(|(altitude, geoid)| altitude + geoid)
    } else {
        fix.altitude
    };
    let (position, horizontal) = geodetic(place, height);
    let quality = if place.is_some() { fix.method.map(quality) } else { Some(FixQuality::Invalid) };
    GnssPart {
        kind: "129029",
        position,
        horizontal,
        hdop: fix.hdop,
        satellites: fix.satellites.map(u16::from),
        quality,
        invalid: fix.integrity == Some(Integrity::Unsafe),
        ..GnssPart::default()
    }
}

fn quality(method: FixMethod) -> FixQuality {
    match method {
        FixMethod::NoFix | FixMethod::Other(_) => FixQuality::Invalid,
        FixMethod::Gnss => FixQuality::Autonomous,
        FixMethod::Differential => FixQuality::Differential,
        FixMethod::Precise => FixQuality::Precise,
        FixMethod::RtkFixed => FixQuality::RtkFixed,
        FixMethod::RtkFloat => FixQuality::RtkFloat,
        FixMethod::DeadReckoning => FixQuality::Estimated,
        FixMethod::Manual => FixQuality::Manual,
        FixMethod::Simulated => FixQuality::Simulated,
    }
}

/// North and east; a course from magnetic north cannot be turned into them.
fn velocity(own: &CourseSpeed) -> Result<GnssPart, Refusal> {
    let velocity = match (own.speed, own.course, own.reference) {
        (Some(speed), ..) if speed < REST => [Some(0.0), Some(0.0), None],
        (Some(_), Some(_), Some(North::Magnetic)) => return Err(Refusal::Magnetic),
        (Some(speed), Some(course), Some(North::True)) => {
            [Some(speed * course.cos()), Some(speed * course.sin()), None]
        }
        _ => [None; 3],
    };
    Ok(GnssPart { kind: "129026", velocity, ..GnssPart::default() })
}

fn dilution(dops: &Dops) -> GnssPart {
    GnssPart { kind: "129539", hdop: dops.hdop, ..GnssPart::default() }
}

fn sigmas(noise: &PseudorangeNoise) -> GnssPart {
    let position_std = [noise.latitude_std, noise.longitude_std, noise.altitude_std];
    GnssPart { kind: "129542", position_std, ..GnssPart::default() }
}

/// Seconds of the day as hours, minutes and seconds.
fn time_of_day(seconds: f64) -> Option<TimeOfDay> {
    let whole = (0.0..86_401.0).contains(&seconds).then_some(seconds as u32)?;
    // a leap second is the last second of its day
    let minutes = (whole / 60).min(1439);
    Some(TimeOfDay {
        hour: (minutes / 60) as u8,
        minute: (minutes % 60) as u8,
        second: (whole - minutes * 60) as u8,
        nanosecond: ((seconds - f64::from(whole)) * 1e9) as u32,
    })
}

/// The parts of a place; without a height only the first two.
fn geodetic(
    place: Option<(f64, f64)>,
    height: Option<f64>,
) -> (Option<Geodetic>, Option<Position>) {
    let whole = place.zip(height);
    let position =
        whole.map(|((latitude, longitude), height)| Geodetic { latitude, longitude, height });
    (position, place.map(|(latitude, longitude)| Position { latitude, longitude }))
}
