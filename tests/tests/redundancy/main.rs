//! Several engines: faults of IMUs through the whole pipeline, from bytes to what the ports are told.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

mod choice;
mod faults;
mod sound;
mod watched;

use std::sync::OnceLock;

use insd_base::units::DEG;
use insd_base::{Body, Mode};
use insd_engine::vote::VoteEvent;
use insd_tests::engines::{Fleet, Log, Told};

/// When something goes wrong, s.
const FAULT: f64 = 240.0;
/// Length of her voyage, s.
const VOYAGE: f64 = 900.0;

/// A coaster in a moderate sea with a receiver, a log, and three IMUs of 0.01 deg/h.
fn fleet() -> &'static Fleet {
    static FLEET: OnceLock<Fleet> = OnceLock::new();
    FLEET.get_or_init(|| {
        let sensors = [("[gnss]", "[gnss]\nrate_hz = 5.0\n[log]")];
        let scenario = insd_tests::variant(10, &sensors).with_duration(VOYAGE);
        Fleet::new(&scenario, 1, &[[-12.0, 2.0, 0.5], [3.0, -1.0, 2.0]])
    })
}

/// The ship with her first so many IMUs, an engine on each, and a fault of one of them.
fn faulty(count: usize, imu: usize, fault: Fault, until: f64) -> Fleet {
    let mut fleet = fleet().clone().until(until);
    fleet.imus.truncate(count);
    fleet.engines.truncate(count);
    let stuck = fleet.imus[imu].iter().find(|own| own.message.time.as_seconds() >= FAULT);
    let stuck = stuck.unwrap().message;
    fleet.with_fault(imu, FAULT, |_, sample| match fault {
        Fault::Bias(rate) => {
            let rate = nalgebra::Vector3::from(rate.map(|rate| rate * DEG / 3600.0));
            sample.delta_theta = Body(sample.delta_theta.0 + rate * 0.01);
        }
        Fault::Stuck => sample.delta_theta = stuck.delta_theta,
        Fault::Scale(factor) => sample.delta_theta = Body(sample.delta_theta.0 * factor),
        Fault::Force(force) => {
            sample.delta_velocity.0.x += force * 0.01;
        }
    })
}

/// What can be wrong with an IMU.
#[derive(Clone, Copy, Debug)]
enum Fault {
    /// Of the gyros, deg/h.
    Bias([f64; 3]),
    /// The gyros say what they said last.
    Stuck,
    /// Of the gyros.
    Scale(f64),
    /// Of the forward accelerometer, m/s^2.
    Force(f64),
}

/// When an alert is first up, s after the fault: that engines differ, or that an engine has found its own IMU
/// wrong. Gyros that stand still are found by their own engine.
fn alert(log: &Log, fault: Fault) -> Option<f64> {
    let is_stuck = matches!(fault, Fault::Stuck);
    let is_up = |told: &&Told| told.doubt || (told.alert && !is_stuck);
    log.told.iter().find(is_up).map(|told| told.at - FAULT)
}

/// When the engine in use is changed first, s after the fault.
fn switch(log: &Log) -> Option<f64> {
    let is_switch = |event: &VoteEvent| matches!(event, VoteEvent::Switched { .. });
    log.votes.iter().find(|(_, event)| is_switch(event)).map(|(at, _)| at - FAULT)
}

/// Greatest error of the heading from an instant on, deg and in claimed sigmas.
fn heading(log: &Log, from: f64) -> (f64, f64) {
    let told = log.told.iter().filter(|told| told.at >= from && told.at < VOYAGE - 1.0);
    told.fold((0.0, 0.0), |(most, sigmas): (f64, f64), told| {
        let (error, sigma) = (told.heading_error.unwrap().abs(), told.solution.unwrap().sigma);
        (most.max(error / DEG), sigmas.max(error / sigma.heading))
    })
}

/// Greatest error of a heading that is told from an instant on, deg: an engine that has given itself up tells none.
fn heading_told(log: &Log, from: f64) -> f64 {
    let is_told = |told: &&Told| told.solution.is_some_and(|own| own.mode != Mode::Standby);
    let told = log.told.iter().filter(|told| told.at >= from).filter(is_told);
    told.filter_map(|told| told.heading_error).fold(0.0, |most, error| error.abs().max(most)) / DEG
}

/// Whether no heading that is told is off by more than a degree without its sigma saying so.
fn is_covered(log: &Log, from: f64) -> bool {
    let told = log.told.iter().filter(|told| told.at >= from);
    told.filter_map(|told| told.heading_error.zip(told.solution))
        .all(|(error, own)| error.abs() < 1.0 * DEG || error.abs() < 3.0 * own.sigma.heading)
}

/// Greatest error of the horizontal position from an instant on, m.
fn position(log: &Log, from: f64) -> f64 {
    let told = log.told.iter().filter(|told| told.at >= from);
    told.filter_map(|told| told.position_error).fold(0.0, f64::max)
}
