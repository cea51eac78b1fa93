//! The walk as a voyage directory.

use std::error::Error;
use std::path::Path;

use insd_base::{
    Body, Ecef, FixQuality, GnssFix, ImuSpec, LeverArms, Ned, Stamped, StartCondition, Time, Triad,
    VesselKind, Voyage, VoyageHeader, earth,
};
use insd_drivers::recording::{Compression, RawFiles, write_raw, write_voyage};
use insd_gnss::{Context, Guess, Noise, Ranged, Ranging};
use insd_rinex::{ObservationHeader, write_navigation, write_observations};
use nalgebra::Matrix3;

use crate::log::{Heard, RATE, START_UTC, hear, imu, start};

/// GPS - UTC, s.
const LEAP_SECONDS: i8 = 18;

/// What the receiver is taken for: one of two bands with a small antenna in a hand.
const NOISE: Noise = Noise { code: 0.5, phase: 0.003, rate: 0.1, multipath: 1.5 };
/// Random walks of its clock, m/sqrt(s), and of the clock's drift, (m/s)/sqrt(s). By Doppler shifts the drift changes by 0.5 m/s in two seconds and by
/// 2 m/s in ten while it is carried.
const CLOCK_WALKS: [f64; 2] = [0.05, 0.5];

/// Makes the voyage of the files of a folder.
pub(crate) fn make(folder: &Path, dir: &Path) -> Result<(), Box<dyn Error>> {
    let heard = hear(folder)?;
    let voyage = Voyage {
        header: header(),
        imu: imu(folder)?,
        gnss: fixes(&heard)?,
        log: Vec::new(),
        reference: Vec::new(),
        truth: Vec::new(),
    };
    write_voyage(dir, &voyage, Compression::None)?;
    write_raw(dir, Some(&raw(&heard)), Compression::None)?;
    Ok(())
}

/// A MEMS IMU as consumers buy it, its times those of a computer, and an antenna beside it: to which side, the publisher's words and his program say
/// otherwise. The program is right: with it the IMU alone goes half as far astray, whether it had fixes or ranges before.
fn header() -> VoyageHeader {
    VoyageHeader {
        start_utc: START_UTC.to_owned(),
        start: StartCondition::Underway,
        initial: None,
        imu: ImuSpec {
            rate: RATE,
            gyro: Triad::of_gyros([1000.0, 20.0, 300.0, 0.3, 3000.0]),
            accel: Triad::of_accelerometers([20_000.0, 200.0, 300.0, 0.15, 3000.0]),
        },
        lever_arms: LeverArms { gnss: Body::new(0.0, 0.05, 0.0), log: Body::default() },
        vessel: VesselKind::Boat,
        time_std: Some(0.2),
    }
}

/// What `insd` makes of each epoch alone: single points and velocities by Doppler shifts.
fn fixes(heard: &Heard) -> Result<Vec<Stamped<GnssFix>>, Box<dyn Error>> {
    let mut context = Context { noise: NOISE, ..Context::default() };
    for record in &heard.records {
        context.ephemerides.insert(*record).map_err(|refusal| refusal.to_string())?;
    }
    context.ionosphere.extend(heard.ionosphere.iter().copied());
    let mut ranging = Ranging::default();
    let fix = |epoch| fix(&ranging.take(&context, epoch, Guess::default()));
    Ok(heard.epochs.iter().filter_map(fix).collect())
}

fn fix(ranged: &Ranged) -> Option<Stamped<GnssFix>> {
    let point = ranged.point.as_ref().ok()?;
    let position = earth::geodetic(&Ecef(point.position));
    let axes = earth::c_ne(&position);
    let std = |covariance: &Matrix3<f64>| {
        let covariance = axes * covariance * axes.transpose();
        Ned(covariance.diagonal().map(f64::sqrt))
    };
    let velocity = ranged.velocity.as_ref();
    let message = GnssFix {
        time: Time::START + ranged.sampled.since(start()),
        position: Some(position),
        velocity: velocity.map(|velocity| Ned(axes * velocity.velocity)),
        position_std: Some(std(&point.covariance)),
        velocity_std: velocity.map(|velocity| std(&velocity.covariance)),
        satellites: u16::try_from(point.used().count()).ok(),
        quality: FixQuality::Autonomous,
        ..GnssFix::default()
    };
    Some(Stamped { message, arrival: None })
}

fn raw(heard: &Heard) -> RawFiles {
    let header = ObservationHeader {
        leap_seconds: Some(LEAP_SECONDS),
        ..ObservationHeader::of_marker("walk")
    };
    let Noise { code, phase, rate, multipath } = NOISE;
    let [clock, drift] = CLOCK_WALKS;
    RawFiles {
        antennas: vec![write_observations(&header, &heard.epochs)],
        base: None,
        navigation: write_navigation(&heard.records, &heard.ionosphere, Some(LEAP_SECONDS)),
        truth: Some("{}".to_owned()),
        tables: format!(
            "[raw]\nrate_hz = 4.0\ncode_std_m = {code}\nphase_std_m = {phase}\ndoppler_std_mps = {rate}\nmultipath_code_std_m = {multipath}\n\
             clock_bias_walk_m_sqrt_s = {clock}\nclock_drift_walk_mps_sqrt_s = {drift}\n"
        ),
    }
}
