//! A ship of which everything is known, leaned to either side, and an ear for what is said of her.

use insd_base::units::DEG;
use insd_base::{
    AlignmentPhase, AlignmentStatus, Attitude, AttitudeSigma, Body, Forecast, Geodetic, Heave,
    HeaveQuality, Integrity, Judgement, Limiting, Mode, Ned, Solution, SolutionSigma, Time,
    UtcTime,
};
use insd_n2k::pgn::TimeSource;
use insd_output::{Manner, MessageKind, OutputEpoch, OutputPortConfig, Port, Rate};
use insd_wire::nmea::{ChecksumPolicy, Frame, Sentence};

/// All kinds of makers' sentences.
pub(crate) const KINDS: [&str; 38] = [
    "PASHR.sbg",
    "PASHR.sbg_wassp",
    "PASHR.ixblue",
    "PASHR.novatel",
    "PASHR.trimble",
    "PASHR.applanix",
    "PSXN.20",
    "PSXN.21",
    "PSXN.22",
    "PSXN.23",
    "PSXN.24",
    "PRDID",
    "PFEC.GPatt",
    "PFEC.GPatt.v1",
    "PTNTHTM",
    "PHTRO",
    "PHLIN",
    "PHSPD",
    "PHCMP",
    "PHINF",
    "PHOCT",
    "PIXSE",
    "PIXSE.ATITUD",
    "PIXSE.POSITI",
    "PIXSE.SPEED_",
    "PIXSE.UTMWGS",
    "PIXSE.HEAVE_",
    "PIXSE.TIME__",
    "PIXSE.STDHRP",
    "PIXSE.STDPOS",
    "PIXSE.STDSPD",
    "PIXSE.ALGSTS",
    "PIXSE.STATUS",
    "PIXSE.HT_STS",
    "PINSD.STA",
    "PINSD.SIG",
    "PINSD.ALI",
    "PINSD.PRO",
];

pub(crate) const MODES: [Mode; 7] = [
    Mode::CoarseAlignment,
    Mode::FineAlignment,
    Mode::InMotionAlignment,
    Mode::Aided,
    Mode::DeadReckoning,
    Mode::Inertial,
    Mode::Fault,
];

pub(crate) fn now() -> Time {
    Time::from_seconds(1000.0)
}

/// In the North Sea, bound for the east, setting to the south. `side` 1: starboard down by 10 deg, bow up
/// by 5 deg, lifted 1.25 m by a wave and rising at 0.5 m/s, turning to starboard; -1: all the other way.
pub(crate) fn leaned(side: f64) -> OutputEpoch {
    let solution = Solution {
        time: now(),
        position: Geodetic::from_degrees(54.0, 8.0, 43.5),
        velocity: Ned::new(-0.5, 5.0, 0.25 * side),
        attitude: Attitude {
            roll: 10.0 * side * DEG,
            pitch: 5.0 * side * DEG,
            heading: 90.0 * DEG,
        },
        rate: Body::new(side * DEG, 2.0 * side * DEG, 3.0 * side * DEG),
        sigma: SolutionSigma {
            position: Ned::new(0.8, 0.6, 1.5),
            velocity: Ned::new(0.02, 0.03, 0.04),
            roll: 0.02 * DEG,
            pitch: 0.03 * DEG,
            heading: 0.05 * DEG,
        },
        mode: Mode::Aided,
        judgement: Judgement { integrity: Integrity::Consistent, ..Judgement::default() },
        source: None,
        hidden: insd_base::Protection::default(),
    };
    let heave = Heave {
        time: now(),
        heave: 1.25 * side,
        rate: 0.5 * side,
        acceleration: 0.0,
        sigma: 0.04,
        quality: HeaveQuality::Settled,
        delayed: None,
    };
    OutputEpoch {
        solution: Some(solution),
        covariance_north_east: Some(0.0),
        mode_since: Some(Time::from_seconds(200.5)),
        utc: UtcTime::from_civil((2026, 1, 2), (3, 4, 5), 0),
        time_source: Some(TimeSource::Gps),
        heave: Some(heave),
        geoid: Some(40.0),
        alignment: Some(alignment()),
        ..OutputEpoch::unknown(now())
    }
}

/// Told two seconds ago: aligned in eight.
fn alignment() -> AlignmentStatus {
    AlignmentStatus {
        time: Time::from_seconds(998.0),
        phase: AlignmentPhase::Fine,
        moored: true,
        sigma: Some(AttitudeSigma { roll: 0.0, pitch: 0.0, heading: 0.5 * DEG }),
        target: Some(0.17 * DEG),
        gyrocompass: Some(0.04 * DEG),
        ready: Forecast::Expected { at: Time::from_seconds(1006.0), limiting: Limiting::Sea },
        sea: None,
        fit: None,
        shifts: 0,
    }
}

pub(crate) fn epoch() -> OutputEpoch {
    leaned(1.0)
}

/// That epoch with another solution.
pub(crate) fn with(change: impl FnOnce(&mut Solution)) -> OutputEpoch {
    let mut solution = epoch().solution.unwrap();
    change(&mut solution);
    OutputEpoch { solution: Some(solution), ..epoch() }
}

pub(crate) fn in_mode(mode: Mode) -> OutputEpoch {
    with(|solution| solution.mode = mode)
}

/// That epoch with a heave of another quality.
pub(crate) fn heaving(quality: HeaveQuality) -> OutputEpoch {
    let heave = epoch().heave.map(|heave| Heave { quality, ..heave });
    OutputEpoch { heave, ..epoch() }
}

/// Heading worse than the policy has for THS A, and for THS at all.
pub(crate) fn estimated_heading() -> OutputEpoch {
    with(|solution| solution.sigma.heading = DEG)
}

pub(crate) fn bad_heading() -> OutputEpoch {
    with(|solution| solution.sigma.heading = 3.0 * DEG)
}

pub(crate) fn not_level() -> OutputEpoch {
    with(|solution| solution.sigma.roll = DEG)
}

pub(crate) fn lost() -> OutputEpoch {
    with(|solution| solution.sigma.position = Ned::new(90.0, 90.0, 1.0))
}

pub(crate) fn port(names: &[&str], manner: &Manner) -> Port {
    let kind = |name: &&str| (MessageKind::named(name).unwrap(), Rate::from_hertz(1.0));
    let messages = names.iter().map(kind).collect();
    Port::new(OutputPortConfig { messages, manner: manner.clone(), ..OutputPortConfig::default() })
}

/// What a port that has just started says, line by line.
pub(crate) fn lines(name: &str, manner: &Manner, epoch: &OutputEpoch) -> Vec<String> {
    let Some(message) = port(&[name], manner).messages(epoch).pop() else {
        return Vec::new();
    };
    let text = String::from_utf8(message.content.to_bytes()).unwrap();
    assert!(text.len() <= message.kind.longest(), "{name}: {text}");
    text.split_terminator("\r\n").map(str::to_owned).collect()
}

/// The only sentence, without its checksum.
pub(crate) fn said_by(manner: &Manner, name: &str, epoch: &OutputEpoch) -> Option<String> {
    let lines = lines(name, manner, epoch);
    assert!(lines.len() <= 1, "{lines:?}");
    Some(lines.first()?.split('*').next().unwrap().to_owned())
}

pub(crate) fn said(name: &str, epoch: &OutputEpoch) -> Option<String> {
    said_by(&Manner::default(), name, epoch)
}

pub(crate) fn parsed(line: &str) -> Sentence {
    let frame = Frame::parse_with(line.as_bytes(), ChecksumPolicy::Optional).unwrap();
    Sentence::read_frame(&frame).unwrap_or_else(|fault| panic!("{line}: {fault}"))
}

/// The only sentence, read back.
pub(crate) fn read(name: &str, epoch: &OutputEpoch) -> Sentence {
    parsed(&lines(name, &Manner::default(), epoch)[0])
}

#[track_caller]
pub(crate) fn near(value: Option<f64>, expected: f64, resolution: f64) {
    let off = value.map(|value| (value - expected).abs());
    assert!(off.is_some_and(|off| off <= 0.5001 * resolution), "{value:?} is not {expected}");
}
