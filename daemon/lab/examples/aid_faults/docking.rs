//! The shipped berthing with a MEMS IMU, and two lasers on the quay, which tell bow and stern.

use insd_base::{
    Body, Ecef, Geodetic, Message, Party, RangingBeam, RangingLine, RangingReading, RangingTarget,
    Received, Source, Truth, Voyage, earth,
};
use insd_engine::EngineConfig;
use insd_simulator::{Override, simulate};
use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_distr::StandardNormal;
use rand_pcg::Pcg64Mcg;

use crate::sail::{Case, What, by_receipt, seconds};

/// What is wrong with the head at the bow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Lie {
    None,
    /// Its zero, from the begin.
    Off,
    /// Not it, but the line of both.
    Line,
    Frozen,
    Jump,
    Drift,
}

const SIDE: [[f64; 3]; 2] = [[60.0, 11.0, 4.0], [-58.0, 11.0, 4.0]];
/// One reading, 1-sigma, m, and how well each end of the line is known.
const WHITE: f64 = 0.03;
const SURVEY: f64 = 0.03;
/// When the lasers are heard first, and when a lie begins that is not there from the begin, s.
const HEARD: f64 = 545.0;
const SINCE: f64 = 590.0;

/// With centimetre fixes.
pub(crate) fn case(seed: u64, lie: Lie) -> Option<Case> {
    sailed(seed, lie, "gnss.grade=\"rtk\"")
}

/// With a receiver that is good to metres.
pub(crate) fn by_codes(seed: u64, lie: Lie) -> Option<Case> {
    sailed(seed, lie, "gnss.grade=\"standard\"")
}

fn sailed(seed: u64, lie: Lie, grade: &str) -> Option<Case> {
    let east: Vec<Override> =
        ["imu.grade=\"mems\"", grade].iter().filter_map(|own| own.parse().ok()).collect();
    let scenario = insd_lab::scenario::find("06", &east).ok()?.scenario;
    let voyage = simulate(&scenario, seed);
    let mut messages = voyage.received();
    messages.extend(readings(&voyage, lie, seed)?);
    let config = EngineConfig::for_voyage(&voyage.header, 1.0);
    let liar = (lie != Lie::None).then_some(Party::Docking);
    let since = if matches!(lie, Lie::Off | Lie::Line) { HEARD } else { SINCE };
    let messages = by_receipt(messages);
    Some(Case { voyage, config, messages, what: What::North, liar, since })
}

fn place_of(truth: &Truth, lever: &[f64; 3]) -> Option<Vector3<f64>> {
    let (place, attitude) = (&truth.position, truth.attitude?);
    let arm = earth::c_ne(place).transpose() * (attitude.c_nb() * Vector3::from(*lever));
    Some(earth::ecef(place).0 + arm)
}

/// The two ends of a quay that runs east, 80 m south of where she stops.
fn quay(voyage: &Voyage) -> Option<[Geodetic; 2]> {
    let last = voyage.truth.last()?;
    let (here, c_en) = (earth::ecef(&last.position).0, earth::c_ne(&last.position).transpose());
    let end = |along| earth::geodetic(&Ecef(here + c_en * Vector3::new(-80.0, along, 0.0)));
    Some([-150.0, 150.0].map(end))
}

fn readings(voyage: &Voyage, lie: Lie, seed: u64) -> Option<Vec<Received>> {
    let ends = quay(voyage)?;
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let mut normal = move || -> f64 { rng.sample(StandardNormal) };
    let off = [0, 1].map(|_| SURVEY * normal());
    let (origin, c_ne) = (earth::ecef(&ends[0]).0, earth::c_ne(&ends[0]));
    let beam = RangingBeam::Across;
    let line = RangingLine { ends, water_right: false, std: SURVEY, beam };
    let target = RangingTarget::Line(line);
    let mut frozen = None;
    let mut all = Vec::new();
    for truth in voyage.truth.iter().filter(|truth| seconds(truth.time) > HEARD) {
        for (head, lever) in SIDE.iter().enumerate() {
            let from_origin = c_ne * (place_of(truth, lever)? - origin);
            let share = from_origin.y / 300.0;
            let beyond = off[0] * (1.0 - share) + off[1] * share;
            let age = seconds(truth.time) - SINCE;
            let honest = from_origin.x - beyond + WHITE * normal();
            let wrong = wrong(lie, head, age);
            let mut distance = honest + wrong;
            if lie == Lie::Frozen && head == 0 && age >= 0.0 {
                distance = *frozen.get_or_insert(distance);
            }
            let reading = RangingReading {
                time: truth.time,
                mark: 1,
                target,
                lever: Body(Vector3::from(*lever)),
                distance,
                std: WHITE,
            };
            all.push(Received {
                receipt: truth.time,
                source: Source::Ranging(head as u8),
                message: Message::Ranging(reading),
            });
        }
    }
    Some(all)
}

/// What a lie adds to a distance of a head, so long after it began, s.
fn wrong(lie: Lie, head: usize, age: f64) -> f64 {
    match (lie, head) {
        (Lie::Line, _) | (Lie::Off, 0) => 5.0,
        (Lie::Jump, 0) if age >= 0.0 => 2.0,
        (Lie::Drift, 0) => 0.05 * age.max(0.0),
        _ => 0.0,
    }
}
