//! A ship with a base on the quay: centimetres while it holds, and a word when it does not.

use std::sync::Arc;

use insd_base::satellites::{RtkSilence, RtkTurn};
use insd_base::{
    BaseEpoch, Ecef, Event, Message, Received, SolutionSource, Source, SourceReason, Time, Truth,
    earth,
};
use insd_engine::EngineConfig;
use insd_lab::ranges::RangeMaker;
use insd_simulator::{raw_gnss, simulate};
use insd_tests::sailing::{Logbook, sail_messages};
use nalgebra::Vector3;

use crate::figure;
use crate::satellites::{epochs, errors};

/// A sail of the first minutes of the shipped port, with what the base says changed, and then whatever is made of it.
fn sail(
    base: impl Fn(f64, &mut BaseEpoch),
    mut told: impl FnMut(&mut Received),
) -> (Logbook, Vec<Truth>) {
    let scenario = insd_tests::port_with_base(&[]).with_duration(290.0);
    let (voyage, raw) = (simulate(&scenario, 1), raw_gnss(&scenario, 1).unwrap());
    let mut epochs = epochs(&voyage, &raw);
    let station = raw.base.as_ref().unwrap();
    let place = Some(earth::ecef(&station.position));
    let of_base = station.epochs.iter().map(|epoch| {
        let time = Time::START + epoch.tag.since(epochs.start);
        let epoch = epoch.clone();
        let mut own = BaseEpoch {
            time,
            station: None,
            position: place,
            is_surveyed: true,
            is_moving: false,
            epoch,
        };
        base(time.as_seconds(), &mut own);
        Received { receipt: time, source: Source::Base(0), message: Message::Base(Arc::new(own)) }
    });
    epochs.base = of_base.collect();
    let mut all = RangeMaker::new(epochs).among(voyage.received());
    all.iter_mut().for_each(&mut told);
    let config = EngineConfig::for_voyage(&voyage.header, 1.0);
    (sail_messages(&config, &all, 7), voyage.truth)
}

/// The greatest horizontal error within a stretch, m.
fn worst(log: &Logbook, truth: &[Truth], from: f64, to: f64) -> f64 {
    let all = errors(&log.solutions, truth);
    let within = all.iter().filter(|(at, ..)| (from..to).contains(at));
    within.map(|(_, off, _)| off.norm()).fold(0.0, f64::max)
}

fn turns(log: &Logbook) -> Vec<RtkTurn> {
    let turn = |event: &Event| match event {
        Event::RtkJudged { turn, .. } => Some(*turn),
        _ => None,
    };
    log.events.iter().filter_map(turn).collect()
}

#[test]
fn a_base_brings_centimetres_and_one_that_says_it_has_moved_is_not_followed() {
    let east = |base: &Ecef| earth::c_ne(&earth::geodetic(base)).row(1).transpose();
    let moved = |at: f64, base: &mut BaseEpoch| {
        if at > 200.0 {
            base.position.iter_mut().for_each(|place| place.0 += east(place) * 0.5);
        }
    };
    let (log, truth) = sail(moved, |_| ());
    let (held, after) = (worst(&log, &truth, 150.0, 200.0), worst(&log, &truth, 210.0, 285.0));
    figure!("worst {held:.3} m with the base, {after:.3} m after it moved; {:?}", log.counts.rtk);
    assert!(held < 0.08 && after < 0.15, "{held} {after}");
    assert_eq!(turns(&log), [RtkTurn::Contradicted]);
    // another place is another base, whose integers are new
    let is_told = |event: &Event| {
        let why = SourceReason::NoRtk(RtkSilence::Settling);
        let from_rtk = Some(SolutionSource::Rtk);
        matches!(event, Event::SourceChanged { from, why: own, .. } if *own == why && *from == from_rtk)
    };
    assert!(log.events.iter().any(is_told), "{:?}", log.events);
}

#[test]
fn wrong_integers_that_are_withdrawn_are_forgotten_told_and_counted() {
    let mut wrong = 0;
    let spoil = |received: &mut Received| {
        let Message::Rtk(told) = &mut received.message else { return };
        if told.time > Time::from_seconds(150.0) {
            told.is_withdrawal = wrong > 0;
            wrong = 0;
        } else if let Ok(place) = &mut told.place {
            place.antenna += Vector3::new(0.3, 0.2, -0.2);
            wrong += 1;
        }
    };
    let (log, truth) = sail(|_, _| (), spoil);
    let (misled, after) = (worst(&log, &truth, 140.0, 150.0), worst(&log, &truth, 180.0, 285.0));
    figure!("worst {misled:.3} m while misled, {after:.3} m after; {:?}", log.counts.rtk);
    assert!(misled > 0.2 && after < 0.1, "{misled} {after}");
    assert_eq!(turns(&log), [RtkTurn::Withdrawn]);
    assert_eq!(log.counts.rtk.get("withdrawn"), Some(&1));
}

#[test]
fn the_same_epochs_of_a_base_give_the_same_bits() {
    let all = || sail(|_, _| (), |_| ()).0;
    let (one, other) = (all(), all());
    assert_eq!(one.solutions, other.solutions);
    assert_eq!(one.events, other.events);
}
