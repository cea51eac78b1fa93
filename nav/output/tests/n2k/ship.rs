//! A ship of which everything is known, and an ear for what is said of her.

use insd_base::units::DEG;
use insd_base::{
    Attitude, Body, Geodetic, Heave, HeaveQuality, Integrity, Judgement, Mode, Ned, Solution,
    SolutionSigma, Span, Time, UtcTime,
};
use insd_n2k::node::Transmit;
use insd_n2k::pgn::{Group, TimeSource};
use insd_output::n2k::{PgnSchedule, default_transmit};
use insd_output::{Manner, OutputEpoch, SatelliteGeometry, Variation};

/// East of Tokyo at 10 knots on 085, heeling to starboard, turning to port.
pub(crate) fn solution() -> Solution {
    Solution {
        time: Time::START,
        position: Geodetic::from_degrees(35.5, 140.9, 40.0),
        velocity: Ned::new(0.45, 5.12, 0.1),
        attitude: Attitude { roll: 2.0 * DEG, pitch: -0.5 * DEG, heading: 87.0 * DEG },
        rate: Body::new(0.001, 0.002, -0.01),
        sigma: SolutionSigma {
            position: Ned::new(0.8, 0.6, 1.5),
            velocity: Ned::new(0.02, 0.02, 0.02),
            roll: 0.02 * DEG,
            pitch: 0.02 * DEG,
            heading: 0.05 * DEG,
        },
        mode: Mode::Aided,
        judgement: Judgement { integrity: Integrity::Consistent, ..Judgement::default() },
        source: None,
        hidden: insd_base::Protection::default(),
    }
}

/// A settled heave, m, up.
pub(crate) fn heaving(heave: f64) -> Heave {
    Heave {
        time: Time::START,
        heave,
        rate: 0.0,
        acceleration: 0.0,
        sigma: 0.02,
        quality: HeaveQuality::Settled,
        delayed: None,
    }
}

/// That ship with everything else that can be known.
pub(crate) fn epoch() -> OutputEpoch {
    OutputEpoch {
        solution: Some(solution()),
        covariance_north_east: Some(0.1),
        utc: UtcTime::from_civil((2026, 1, 2), (3, 4, 5), 600_000_000),
        time_source: Some(TimeSource::Gps),
        heave: Some(heaving(-0.42)),
        variation: Some(Variation { value: -7.6 * DEG, model: 2025, day: Some(20_455) }),
        geoid: Some(36.7),
        current: Some(Ned::new(0.3, -0.4, 0.0)),
        receiver: Some(SatelliteGeometry {
            satellites: Some(14),
            hdop: Some(0.8),
            vdop: Some(1.2),
            pdop: Some(1.44),
            tdop: Some(0.7),
        }),
        ..OutputEpoch::unknown(Time::START)
    }
}

/// That epoch with another solution.
pub(crate) fn with(change: impl FnOnce(&mut Solution)) -> OutputEpoch {
    let mut solution = solution();
    change(&mut solution);
    OutputEpoch { solution: Some(solution), ..epoch() }
}

/// Every group, ten times a second.
pub(crate) fn all() -> Vec<Transmit> {
    let interval = Span::from_seconds(0.1);
    default_transmit()
        .into_iter()
        .map(|line| Transmit { enabled: true, interval, ..line })
        .collect()
}

/// What a voice says first of an epoch in one of the groups.
pub(crate) fn said_by<G: Group>(config: &Manner, epoch: &OutputEpoch) -> G {
    let messages = PgnSchedule::new(config.clone()).messages(epoch, &all());
    let (_, contents) = messages.into_iter().find(|(pgn, _)| *pgn == G::PGN).unwrap();
    G::read(&contents).unwrap()
}

/// The same by the default policy.
pub(crate) fn said<G: Group>(epoch: &OutputEpoch) -> G {
    said_by(&Manner::default(), epoch)
}

/// Fails unless a value is there and as near as the resolution of its field allows.
#[track_caller]
pub(crate) fn near(value: Option<f64>, expected: f64, resolution: f64) {
    let value = value.unwrap();
    let off = (value - expected).abs();
    assert!(off <= 0.5001 * resolution + 1e-12 * expected.abs(), "{value} is not {expected}");
}
