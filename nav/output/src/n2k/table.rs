//! The groups that can be sent, in the order in which they leave, and how often they are by default.

use insd_base::{Span, Time};
use insd_n2k::fast_packet;
use insd_n2k::node::Transmit;
use insd_n2k::pgn::{
    Attitude, CourseSpeed, Dops, GnssPosition, Heading, Heave, MagneticVariation, PositionRapid,
    PseudorangeNoise, RateOfTurn, SetDrift, Speed, SpeedComponents, SystemTime, TimeDate,
};

use super::groups::Say;
use crate::epoch::OutputEpoch;
use crate::manner::Manner;
use crate::redacted_epoch::RedactedEpoch;

const MILLISECOND: i64 = 1_000_000;
/// Where no interval is named, which is for heave alone: that of the satellite compasses in canboat's logs
/// (`furuno-130842*.raw`). A wave of five seconds then has fifty points.
const UNSTATED: Span = Span::from_nanos(100 * MILLISECOND);
/// No group is sent more often than one frame of it in this time.
const LEAST_PER_FRAME: i64 = 10 * MILLISECOND;

/// One group that can be sent.
pub(crate) struct Entry {
    pub(crate) pgn: u32,
    /// Its name in the configuration.
    pub(crate) name: &'static str,
    priority: u8,
    interval: Span,
    enabled: bool,
    /// Its contents at an epoch.
    pub(crate) contents: fn(&RedactedEpoch<'_>) -> Vec<u8>,
}

/// Off by default are those that would say nothing on most ships: a group that is there but empty can
/// win a display's choice of source over one that has the data.
pub(crate) static GROUPS: [Entry; 15] = [
    on::<Heading>("heading"),
    on::<RateOfTurn>("rate_of_turn"),
    on::<PositionRapid>("position_rapid"),
    on::<CourseSpeed>("course_speed"),
    on::<SpeedComponents>("speed_components"),
    on::<Speed>("speed"),
    on::<Heave>("heave"),
    on::<Attitude>("attitude"),
    on::<GnssPosition>("gnss_position"),
    on::<SystemTime>("system_time"),
    on::<TimeDate>("time_date"),
    off::<SetDrift>("set_drift"),
    on::<PseudorangeNoise>("position_noise"),
    off::<Dops>("dops"),
    on::<MagneticVariation>("magnetic_variation"),
];

const fn on<G: Say>(name: &'static str) -> Entry {
    let interval = match G::INTERVAL {
        Some(interval) => interval,
        None => UNSTATED,
    };
    Entry {
        pgn: G::PGN,
        name,
        priority: G::PRIORITY,
        interval,
        enabled: true,
        contents: |said| G::say(said).write(),
    }
}

const fn off<G: Say>(name: &'static str) -> Entry {
    Entry { enabled: false, ..on::<G>(name) }
}

impl Entry {
    /// The group of a number.
    pub(crate) fn of(pgn: u32) -> Option<&'static Entry> {
        GROUPS.iter().find(|entry| entry.pgn == pgn)
    }

    /// Frames of one message.
    pub(crate) fn frames(&self) -> usize {
        let (epoch, manner) = (OutputEpoch::unknown(Time::START), Manner::default());
        let length = (self.contents)(&RedactedEpoch::new(&epoch, &manner)).len();
        if fast_packet::is_fast(self.pgn) { fast_packet::frames(length) } else { 1 }
    }

    fn transmit(&self) -> Transmit {
        Transmit {
            pgn: self.pgn,
            priority: self.priority,
            interval: self.interval,
            enabled: self.enabled,
        }
    }
}

/// All groups that a [`super::PgnSchedule`] can send, in the order in which they leave: priority and interval
/// of canboat's list, 100 ms for heave, for which it has none.
#[must_use]
pub fn default_transmit() -> Vec<Transmit> {
    GROUPS.iter().map(Entry::transmit).collect()
}

/// The least time from one message of a group to the next: 10 ms for each of its frames. `None` for a
/// group that a [`super::PgnSchedule`] does not send.
#[must_use]
pub fn least_interval(pgn: u32) -> Option<Span> {
    let frames = i64::try_from(Entry::of(pgn)?.frames()).ok()?;
    Some(Span::from_nanos(frames * LEAST_PER_FRAME))
}
