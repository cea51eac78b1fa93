//! Four antennas on a square of 10 cm, and a MEMS IMU, going into the berth.

use std::collections::VecDeque;
use std::sync::Arc;

use insd_base::satellites::CompassReading;
use insd_base::units::DEG;
use insd_base::{
    Constellation, ExternalReference, Message, Party, Received, Source, Time, Truth, Voyage,
};
use insd_config::VoyageCalendar;
use insd_engine::EngineConfig;
use insd_gnss::{ArrayRanging, Context, Noise};
use insd_lab::ranges::{Epochs, RangeMaker};
use insd_nav::config::AntennaModel;
use insd_simulator::{RawGnss, raw_gnss, simulate};
use nalgebra::{Rotation3, Vector3};
use rand::{RngExt, SeedableRng};
use rand_distr::StandardNormal;
use rand_pcg::Pcg64Mcg;

use crate::sail::{Case, What, by_receipt, seconds};

/// What is wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Lie {
    None,
    /// From the begin, against the configuration.
    Turned,
    /// Of a sudden, by so many degrees.
    Knocked(f64),
    /// Other whole cycles for a minute: turned and tilted.
    OtherCycles,
    Bent,
    /// Not the antennas lie, but a gyrocompass.
    Gyrocompass,
    /// Both are there, and the antennas are knocked.
    BesideCompass,
}

const ARRAY: [[f64; 3]; 4] =
    [[-5.95, -0.85, -14.0], [-5.95, -0.75, -14.0], [-6.05, -0.75, -14.0], [-6.05, -0.85, -14.0]];
/// How well each is known, 1-sigma, m, as `lever_std_m` is unless given.
const LEVER_STD: f64 = 0.002;
/// When it begins, and for how long she sails, s.
const SINCE: f64 = 200.0;
const SAILS: f64 = 320.0;
/// A gyrocompass, 1-sigma, deg.
const COMPASS: f64 = 0.3;

pub(crate) fn case(seed: u64, lie: Lie) -> Option<Case> {
    let scenario = insd_lab::scenario::find("29", &[]).ok()?.scenario.with_duration(SAILS);
    let (voyage, raw) = (simulate(&scenario, seed), raw_gnss(&scenario, seed)?);
    let mut messages = honest(&voyage, &raw)?;
    for received in &mut messages {
        if let Message::Compass(reading) = &mut received.message {
            spoil(Arc::make_mut(reading), lie);
        }
    }
    if matches!(lie, Lie::Gyrocompass | Lie::BesideCompass) {
        messages.extend(compass(&voyage.truth, lie, seed));
    }
    let liar = match lie {
        Lie::None => None,
        Lie::Gyrocompass => Some(Party::Heading),
        _ => Some(Party::Antennas),
    };
    let since = if lie == Lie::Turned { 0.0 } else { SINCE };
    let mut config = EngineConfig::for_voyage(&voyage.header, 1.0);
    config.models.antennas = AntennaModel::of(&ARRAY.map(Vector3::from), LEVER_STD);
    let messages = by_receipt(messages);
    Some(Case { voyage, config, messages, what: What::Heading, liar, since })
}

fn honest(voyage: &Voyage, raw: &RawGnss) -> Option<Vec<Received>> {
    let spec = &raw.spec;
    let noise = Noise {
        code: spec.code_std_m,
        phase: spec.phase_std_m,
        rate: spec.doppler_std_mps,
        multipath: spec.multipath_code_std_m,
    };
    let mut context = Context { noise, ..Context::default() };
    for record in &raw.broadcast {
        context.ephemerides.insert(*record).ok()?;
    }
    context.ionosphere.insert(Constellation::Gps, raw.ionosphere);
    let calendar = VoyageCalendar::new(&voyage.header.start_utc)?;
    let epochs = Epochs {
        start: calendar.utc(Time::START).to_gps(),
        context,
        rover: raw.antennas.iter().map(|own| own.iter().cloned().collect()).collect(),
        array: ArrayRanging::new(&ARRAY.map(Vector3::from), &[0; 4]),
        base: VecDeque::new(),
        masks: Vec::new(),
    };
    Some(RangeMaker::new(epochs).among(voyage.received()))
}

/// How the array has been turned by then: about down, and about starboard, rad.
fn turned(at: f64, lie: Lie) -> (f64, f64) {
    let age = at - SINCE;
    let knocked = |by: f64| if age >= 0.0 { by * DEG } else { 0.0 };
    match lie {
        Lie::None | Lie::Gyrocompass => (0.0, 0.0),
        Lie::Turned => (3.0 * DEG, 0.0),
        Lie::Knocked(by) => (knocked(by), 0.0),
        Lie::BesideCompass => (knocked(3.0), 0.0),
        Lie::OtherCycles if age > 60.0 => (0.0, 0.0),
        Lie::OtherCycles => (knocked(8.0), knocked(4.0)),
        Lie::Bent => (0.1 * DEG * age.max(0.0), 0.0),
    }
}

/// An array that is turned tells the attitude with it, and its phases fit to antennas that are turned back.
fn spoil(reading: &mut CompassReading, lie: Lie) {
    let (about_down, about_starboard) = turned(seconds(reading.time), lie);
    let age = seconds(reading.time) - SINCE;
    if lie == Lie::OtherCycles && age >= 0.0 {
        reading.run += if age > 60.0 { 2000 } else { 1000 };
    }
    let Ok(told) = &mut reading.told else { return };
    let by = Rotation3::from_axis_angle(&Vector3::z_axis(), about_down)
        * Rotation3::from_axis_angle(&Vector3::y_axis(), about_starboard);
    let c_nb = told.attitude.c_nb() * by.matrix();
    told.attitude = insd_base::Attitude::from_c_nb(&c_nb);
    for phase in told.signals.iter_mut().flat_map(|own| &mut own.phases) {
        phase.lever = by.inverse() * phase.lever;
    }
}

/// A gyrocompass, once a second.
fn compass(truth: &[Truth], lie: Lie, seed: u64) -> Vec<Received> {
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let mut all = Vec::new();
    let mut next = 0.5;
    for row in truth {
        let at = seconds(row.time);
        let Some(attitude) = row.attitude.filter(|_| at >= next) else { continue };
        next += 1.0;
        let noise: f64 = rng.sample(StandardNormal);
        let off = if lie == Lie::Gyrocompass && at >= SINCE { 3.0 } else { 0.0 };
        let heading = attitude.heading + (off + COMPASS * noise) * DEG;
        let told = ExternalReference {
            time: row.time,
            v_north: None,
            v_east: None,
            velocity_std: None,
            position: None,
            position_std: None,
            position_lasting_std: None,
            heading: Some(heading.rem_euclid(std::f64::consts::TAU)),
            heading_std: Some(COMPASS * DEG),
        };
        let message = Message::Reference(told);
        all.push(Received { receipt: row.time, source: Source::Reference(0), message });
    }
    all
}
