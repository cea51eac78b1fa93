//! A leaned ship on a wave, and an ear for what is said of her.

use insd_base::units::DEG;
use insd_base::{
    Attitude, Body, DelayedHeave, Geodetic, Heave, HeaveQuality, Mode, Ned, Solution,
    SolutionSigma, Time, UtcTime,
};
use insd_output::{Content, Manner, MessageKind, OutputEpoch, OutputPortConfig, Port, Rate};
use insd_wire::motion::em::EmAttitude;
use insd_wire::motion::kmb::Kmb;
use insd_wire::motion::seapath::{Seapath23, Seapath26};
use insd_wire::motion::tss1::Tss1;

/// Eastward off Japan, starboard down, bow up, turning to starboard.
pub(crate) fn solution() -> Solution {
    Solution {
        time: now(),
        position: Geodetic::from_degrees(35.5, -139.25, 40.0),
        velocity: Ned::new(-0.5, 5.0, 3.0),
        attitude: Attitude { roll: 10.0 * DEG, pitch: 5.0 * DEG, heading: 90.0 * DEG },
        rate: Body::new(1.0 * DEG, -2.0 * DEG, 3.0 * DEG),
        sigma: SolutionSigma {
            position: Ned::new(0.8, 0.6, 1.5),
            velocity: Ned::new(0.02, 0.02, 0.02),
            roll: 0.02 * DEG,
            pitch: 0.03 * DEG,
            heading: 0.05 * DEG,
        },
        mode: Mode::Aided,
        judgement: insd_base::Judgement::default(),
        source: None,
        hidden: insd_base::Protection::default(),
    }
}

pub(crate) fn now() -> Time {
    Time::from_seconds(1000.0)
}

/// On the crest of a wave, still going up; the wave of a minute and a half ago was a trough.
pub(crate) fn heave() -> Heave {
    Heave {
        time: now(),
        heave: 1.25,
        rate: 0.5,
        acceleration: -0.75,
        sigma: 0.04,
        quality: HeaveQuality::Settled,
        delayed: Some(DelayedHeave {
            time: Time::from_seconds(909.75),
            heave: -0.75,
            sigma: 0.02,
            quality: HeaveQuality::Settled,
        }),
    }
}

pub(crate) fn utc() -> UtcTime {
    UtcTime::from_civil((2026, 1, 2), (3, 4, 5), 0).unwrap()
}

/// Surging ahead at 0.3 m/s^2, pulled to port at 0.4, falling at 0.75.
pub(crate) fn epoch() -> OutputEpoch {
    OutputEpoch {
        solution: Some(solution()),
        acceleration: Some(Ned::new(0.4, 0.3, 0.75)),
        heave: Some(heave()),
        utc: Some(utc()),
        ..OutputEpoch::unknown(now())
    }
}

/// That epoch with another solution.
pub(crate) fn with(change: impl FnOnce(&mut Solution)) -> OutputEpoch {
    let mut solution = solution();
    change(&mut solution);
    OutputEpoch { solution: Some(solution), ..epoch() }
}

pub(crate) fn in_mode(mode: Mode) -> OutputEpoch {
    with(|solution| solution.mode = mode)
}

/// That epoch with another heave.
pub(crate) fn heaving(change: impl FnOnce(&mut Heave)) -> OutputEpoch {
    let mut heave = heave();
    change(&mut heave);
    OutputEpoch { heave: Some(heave), ..epoch() }
}

/// Heading worse than the policy has for THS A, and for THS at all.
pub(crate) fn estimated_heading() -> OutputEpoch {
    with(|solution| solution.sigma.heading = 1.0 * DEG)
}

pub(crate) fn bad_heading() -> OutputEpoch {
    with(|solution| solution.sigma.heading = 3.0 * DEG)
}

pub(crate) fn not_level() -> OutputEpoch {
    with(|solution| solution.sigma.roll = 1.0 * DEG)
}

pub(crate) fn said_by(manner: &Manner, name: &str, epoch: &OutputEpoch) -> Option<Vec<u8>> {
    let kind = MessageKind::named(name).unwrap();
    let messages = vec![(kind, Rate::from_hertz(1.0))];
    let config =
        OutputPortConfig { messages, manner: manner.clone(), ..OutputPortConfig::default() };
    let message = Port::new(config).messages(epoch).pop()?;
    assert!(matches!(message.content, Content::Binary(_)), "{name}");
    let bytes = message.content.to_bytes();
    assert_eq!(bytes.len(), kind.longest(), "{name}");
    Some(bytes)
}

pub(crate) fn said(name: &str, epoch: &OutputEpoch) -> Option<Vec<u8>> {
    said_by(&Manner::default(), name, epoch)
}

pub(crate) fn tss1(epoch: &OutputEpoch) -> Option<Tss1> {
    said("TSS1", epoch).map(|bytes| Tss1::read(&bytes).unwrap())
}

pub(crate) fn em(name: &str, epoch: &OutputEpoch) -> Option<EmAttitude> {
    said(name, epoch).map(|bytes| EmAttitude::read(&bytes).unwrap())
}

pub(crate) fn em3000(epoch: &OutputEpoch) -> EmAttitude {
    em("EM3000", epoch).unwrap()
}

pub(crate) fn kmb(epoch: &OutputEpoch) -> Option<Kmb> {
    said("KMB", epoch).map(|bytes| Kmb::read(&bytes).unwrap())
}

pub(crate) fn seapath_23(epoch: &OutputEpoch) -> Option<Seapath23> {
    said("SEAPATH.23", epoch).map(|bytes| Seapath23::read(&bytes).unwrap())
}

pub(crate) fn seapath_26(epoch: &OutputEpoch) -> Option<Seapath26> {
    said("SEAPATH.26", epoch).map(|bytes| Seapath26::read(&bytes).unwrap())
}

/// What KMB, Seapath 23 and Seapath 26 have alike.
pub(crate) fn status_formats(epoch: &OutputEpoch) -> [Seapath23; 3] {
    let Kmb { time, place, tilt, heading, vertical, rates, .. } = kmb(epoch).unwrap();
    let kmb = Seapath23 { time, place, tilt, heading, vertical, rates };
    [kmb, seapath_23(epoch).unwrap(), seapath_26(epoch).unwrap().motion]
}

#[track_caller]
pub(crate) fn near(value: f64, expected: f64, resolution: f64) {
    let off = (value - expected).abs();
    assert!(off <= 0.5001 * resolution, "{value} is not {expected}");
}

/// Units of the fields: 0.01 deg; cm; 90 deg / 2^14.
pub(crate) const HUNDREDTH: f64 = 0.01 * DEG;
pub(crate) const CENTI: f64 = 0.01;
pub(crate) const BINARY: f64 = 90.0 * DEG / 16_384.0;
