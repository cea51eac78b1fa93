//! One solution as each of the sentences.

use insd_base::{FixQuality, Solution};
use insd_wire::nmea::{
    CivilTime, Gga, Hdt, HeadingMode, Line, Position, PositionMode, Rot, Talker, Ths, Vtg, Zda,
};

use crate::config::{PortConfig, SentenceKind};

/// The sentence of a kind, `None` where silence is the only honest answer.
pub(crate) fn sentence(
    kind: SentenceKind,
    config: &PortConfig,
    solution: &Solution,
    utc: Option<CivilTime>,
) -> Option<Line> {
    let silent = config.simulated && !config.unmarked_when_simulated;
    match kind {
        SentenceKind::Hdt if silent => None,
        SentenceKind::Rot if silent => None,
        SentenceKind::Hdt => hdt(config, solution),
        SentenceKind::Ths => Some(ths(config, solution)),
        SentenceKind::Rot => Some(rot(solution)),
        SentenceKind::Gga => Some(gga(config, solution, utc)),
        SentenceKind::Vtg => Some(vtg(config, solution)),
        SentenceKind::Zda => Some(Zda { utc, zone: None }.write(Talker::IN)),
    }
}

/// HDT cannot say that it is wrong, so it stops when THS would say V.
fn hdt(config: &PortConfig, solution: &Solution) -> Option<Line> {
    let valid = config.policy.heading(solution) != HeadingMode::NotValid;
    let heading = solution.attitude.heading;
    (valid && heading.is_finite()).then(|| Hdt { heading: Some(heading) }.write(Talker::HE))
}

fn ths(config: &PortConfig, solution: &Solution) -> Line {
    let heading = Some(solution.attitude.heading).filter(|heading| heading.is_finite());
    let mode = match (config.policy.heading(solution), heading) {
        (HeadingMode::NotValid, _) | (_, None) => HeadingMode::NotValid,
        _ if config.simulated => HeadingMode::Simulator,
        (mode, _) => mode,
    };
    let heading = heading.filter(|_| mode != HeadingMode::NotValid);
    Ths { heading, mode }.write(Talker::HE)
}

/// The rate of turn comes from the gyros, so it needs a navigating system but no good heading.
fn rot(solution: &Solution) -> Line {
    let valid = solution.mode.is_navigating();
    Rot { rate: valid.then(|| solution.rate_of_turn()), valid }.write(Talker::TI)
}

fn gga(config: &PortConfig, solution: &Solution, utc: Option<CivilTime>) -> Line {
    let place = &solution.position;
    let finite = place.latitude.is_finite() && place.longitude.is_finite();
    let quality = match config.policy.quality(solution) {
        FixQuality::Invalid => FixQuality::Invalid,
        _ if !finite => FixQuality::Invalid,
        _ if config.simulated => FixQuality::Simulated,
        quality => quality,
    };
    let valid = quality != FixQuality::Invalid;
    let position = Position { latitude: place.latitude, longitude: place.longitude };
    let geoid = config.geoid_separation.filter(|_| valid);
    Gga {
        time: utc.map(|utc| utc.time),
        position: valid.then_some(position),
        quality,
        altitude: geoid.map(|geoid| place.height - geoid),
        geoid_separation: geoid,
        ..Gga::default()
    }
    .write(Talker::IN)
}

fn vtg(config: &PortConfig, solution: &Solution) -> Line {
    let speed = Some(solution.speed()).filter(|speed| speed.is_finite());
    let mode = match (config.policy.velocity(solution), speed) {
        (PositionMode::NotValid, _) | (_, None) => PositionMode::NotValid,
        _ if config.simulated => PositionMode::Simulator,
        (mode, _) => mode,
    };
    let speed = speed.filter(|_| mode != PositionMode::NotValid);
    let course = speed.filter(|_| config.policy.has_course(solution)).map(|_| solution.course());
    Vtg { course, course_magnetic: None, speed, mode: Some(mode) }.write(Talker::IN)
}
