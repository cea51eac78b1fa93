//! Makes voyages: a ship in a seaway, her sensors with their errors, and the truth.
//!
//! A [`Scenario`] is read from TOML and, with a seed, decides a [`Voyage`] down to the last bit.
//! Pure: no I/O, no clock, no thread, and randomness only from the seed.
//!
//! The truth does not come out of a navigator run backwards. Velocity and attitude are closed
//! formulas of time: a guidance path of smooth turns and changes of speed, plus a sum of sinusoids
//! for the waves. Their derivatives are exact, and the increments of the IMU are the integrals of
//! those derivatives. Of the navigator nothing but the vocabulary of `insd-base` is shared, so an
//! error in its mechanisation cannot hide here as well.

mod camera;
pub mod feed;
pub mod lies;
mod limit;
mod motion;
mod quadrature;
mod random;
mod scenario;
mod sensors;
mod shipped;
mod sky;
mod track;

use insd_base::earth::{c_ne, ecef, geodetic};
use insd_base::{
    Body, Ecef, Geodetic, GnssFix, ImuSample, LeverArms, Stamped, Truth, VesselKind, Voyage,
    VoyageHeader,
};
use nalgebra::Vector3;

use random::{Purpose, normal3, stream};
use scenario::{Gnss, Log};
use sensors::epochs;
use track::Track;

pub use camera::{Footage, FootageSpec, FootageTruth, InjectedCameraFault};
pub use limit::{
    CameraUse, Limit, LimitError, LimitQuestion, SegmentLimit, camera_limit, limit, limit_of,
    satellite_limit,
};
pub use scenario::{Override, Scenario, ScenarioBerth, ScenarioError, ScenarioFault};
pub use shipped::shipped;
pub use sky::{
    InjectedAntennaFault, InjectedFault, InjectedSlip, InjectedSpoof, JudgedSegment,
    RawBaseStation, RawGnss, RawSpec, RawTruth,
};

/// Simulates the voyage of a scenario. The same scenario and seed give the same voyage; every source
/// of error draws from a random stream of its own, so that a change to one leaves the others alone.
#[must_use]
pub fn simulate(scenario: &Scenario, seed: u64) -> Voyage {
    let track = Track::new(scenario, seed);
    let duration = scenario.duration();
    let berth = track::start_of(scenario);
    let gnss = |gnss| sensors::gnss::fixes(gnss, &track, duration, seed);
    let log = |log| sensors::log::velocities(log, &scenario.current, &track, duration, seed);
    let reference =
        |reference| sensors::reference::messages(reference, &berth, &track, duration, seed);
    Voyage {
        header: header(scenario, seed),
        imu: sensors::imu::samples(&scenario.imu, &track, duration, seed),
        gnss: scenario.gnss.as_ref().map(gnss).unwrap_or_default(),
        log: scenario.log.as_ref().map(log).unwrap_or_default(),
        reference: scenario.reference.as_ref().map(reference).unwrap_or_default(),
        truth: truth(&track, scenario.truth.rate_hz, duration),
    }
}

/// The raw GNSS of the voyage of a scenario with `[raw]`; `None` of one without. The voyage itself, [`simulate`], knows nothing of it.
#[must_use]
pub fn raw_gnss(scenario: &Scenario, seed: u64) -> Option<RawGnss> {
    let raw = scenario.raw.as_ref()?;
    sky::raw_gnss(scenario, raw, &Track::new(scenario, seed), seed)
}

/// What the camera of a scenario with `[camera]` makes of its voyage; `None` of one without. The voyage itself, [`simulate`], knows nothing of it.
#[must_use]
pub fn footage(scenario: &Scenario, seed: u64) -> Option<Footage> {
    let camera = camera::installed(scenario.camera.as_ref()?, seed);
    camera::footage(scenario, &camera, &Track::new(scenario, seed), seed)
}

/// The samples of a further IMU of the same kind on the same ship and voyage, `lever` from the first, body
/// axes, m. Its errors are its own: `number`, from 1, decides them.
#[must_use]
pub fn further_imu(
    scenario: &Scenario,
    seed: u64,
    number: u32,
    lever: &Body,
) -> Vec<Stamped<ImuSample>> {
    let track = Track::new(scenario, seed);
    // seeds of voyages are small numbers
    let own = seed ^ u64::from(number) << 40;
    sensors::imu::samples_at(&scenario.imu, &track, scenario.duration(), own, Some(&lever.0))
}

/// The fixes of a further receiver on the same ship and voyage. `receiver` is a scenario whose receiver it is, with its
/// rate, lever arm and errors; these are its own: `number`, from 1, decides them.
#[must_use]
pub fn further_receiver(
    scenario: &Scenario,
    seed: u64,
    number: u32,
    receiver: &Scenario,
) -> Vec<Stamped<GnssFix>> {
    let track = Track::new(scenario, seed);
    let own = seed ^ u64::from(number) << 40;
    let Some(gnss) = &receiver.gnss else { return Vec::new() };
    let lever = Some(Body(Vector3::from(gnss.lever_arm_m)));
    let mut fixes = sensors::gnss::fixes(gnss, &track, scenario.duration(), own);
    fixes.iter_mut().for_each(|fix| fix.message.lever = lever);
    fixes
}

fn header(scenario: &Scenario, seed: u64) -> VoyageHeader {
    let default = (Gnss::default().lever_arm_m, Log::default().lever_arm_m);
    let gnss = scenario.gnss.as_ref().map_or(default.0, |gnss| gnss.lever_arm_m);
    let log = scenario.log.as_ref().map_or(default.1, |log| log.lever_arm_m);
    VoyageHeader {
        start_utc: scenario.start_utc.clone(),
        start: scenario.mode.into(),
        initial: Some(stated_start(scenario, seed)),
        imu: scenario.imu.stated(),
        lever_arms: LeverArms { gnss: Body(Vector3::from(gnss)), log: Body(Vector3::from(log)) },
        vessel: VesselKind::default(),
        time_std: None,
    }
}

/// The starting position with the error that the scenario gives it.
fn stated_start(scenario: &Scenario, seed: u64) -> Geodetic {
    let start = track::start_of(scenario);
    let std = scenario.start.stated_std_m;
    if std == 0.0 {
        return start;
    }
    let error_n = normal3(&mut stream(seed, Purpose::StartPosition)) * std;
    geodetic(&Ecef(ecef(&start).0 + c_ne(&start).tr_mul(&error_n)))
}

fn truth(track: &Track, rate: f64, duration: f64) -> Vec<Truth> {
    let at = |time: insd_base::Time| {
        let ship = track.at(time.as_seconds());
        Truth {
            time,
            position: ship.point,
            velocity: Some(ship.velocity_n()),
            attitude: Some(ship.attitude()),
        }
    };
    epochs(rate, 0, duration).map(at).collect()
}

#[cfg(test)]
mod tests;
