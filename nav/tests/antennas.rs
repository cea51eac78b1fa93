//! Two receivers whose antennas are far apart, one filter.

#![allow(clippy::unwrap_used)]

use insd_base::units::{DEG_PER_HOUR, DEG_PER_SQRT_HOUR, MICRO_G, MPS_PER_SQRT_HOUR};
use insd_base::{
    Body, Ecef, FixQuality, Geodetic, GnssFix, ImuSpec, LeverArms, Message, Ned, Received, Source,
    Time, Triad, earth,
};
use insd_nav::error_state::{ATTITUDE, GNSS_LEVER, POSITION, VELOCITY};
use insd_nav::initial::sensor_covariance;
use insd_nav::{
    AidReport, Estimator, Filter, Increment, InitialState, NavConfig, Nominal, Outcome,
};
use nalgebra::{Matrix3, Vector3};

const IMU: ImuSpec = ImuSpec {
    rate: 100.0,
    gyro: Triad {
        bias_std: 0.01 * DEG_PER_HOUR,
        instability_std: 0.003 * DEG_PER_HOUR,
        instability_time: 3600.0,
        random_walk: 0.003 * DEG_PER_SQRT_HOUR,
        scale_std: 1e-5,
    },
    accel: Triad {
        bias_std: 50.0 * MICRO_G,
        instability_std: 10.0 * MICRO_G,
        instability_time: 3600.0,
        random_walk: 0.005_884 * MPS_PER_SQRT_HOUR,
        scale_std: 5e-5,
    },
};

const MAST: Body = Body(Vector3::new(-6.0, -0.8, -14.0));
const BRIDGE: Body = Body(Vector3::new(34.0, 3.0, -9.0));

fn place() -> Geodetic {
    Geodetic::from_degrees(35.0, 139.0, 20.0)
}

/// A ship that lies still with her bow to the north.
fn filter() -> Filter {
    filter_with(MAST, 1e-3)
}

/// The same with her antenna there and an attitude known to so much, rad.
fn filter_with(gnss: Body, attitude: f64) -> Filter {
    let config = NavConfig::new(IMU, LeverArms { gnss, log: Body::default() });
    let mut covariance = sensor_covariance(&config);
    for (block, std) in [(POSITION, 3.0_f64), (VELOCITY, 0.1), (ATTITUDE, attitude)] {
        block.renew(&mut covariance, &Matrix3::from_diagonal_element(std * std));
    }
    let initial = InitialState::new(
        Time::START,
        Nominal::at(&place(), &Vector3::zeros(), &Matrix3::identity()),
        covariance,
        Vector3::zeros(),
    );
    let mut filter = Filter::new(&config, &initial);
    filter.begin_navigation();
    filter
}

/// Of an antenna that is there, as the receiver `number` tells it.
fn fix(seconds: f64, number: u8, antenna: &Body, lever: Option<Body>) -> Received {
    let time = Time::from_seconds(seconds);
    let there = earth::ecef(&place()).0 + earth::c_ne(&place()).tr_mul(&antenna.0);
    let message = Message::Gnss(GnssFix {
        time,
        position: Some(earth::geodetic(&Ecef(there))),
        velocity: Some(Ned::new(0.0, 0.0, 0.0)),
        position_std: Some(Ned::new(0.5, 0.5, 1.0)),
        velocity_std: Some(Ned::new(0.03, 0.03, 0.05)),
        quality: FixQuality::Differential,
        lever,
        ..GnssFix::default()
    });
    Received { receipt: time, source: Source::Gnss(number), message }
}

/// Two minutes with a fix a second, of the bridge from the second minute on: distance from the truth, m,
/// and how many of its positions were refused.
fn after_the_change(lever: Option<Body>) -> (f64, usize) {
    let (mut filter, mut refused) = (filter(), 0);
    let gravity = earth::gravity_e(&place()).norm();
    let turn = earth::c_ne(&place()) * Vector3::z() * earth::RATE;
    for step in 0..12_000_u32 {
        let from = f64::from(step) / IMU.rate;
        let to = f64::from(step + 1) / IMU.rate;
        filter.advance(&Increment {
            from: Time::from_seconds(from),
            to: Time::from_seconds(to),
            rotation: turn / IMU.rate,
            velocity: Vector3::new(0.0, 0.0, -gravity / IMU.rate),
            end_rate: turn,
            end_rate_variance: 0.0,
            angular_acceleration: Vector3::zeros(),
            rate_noise: Vector3::zeros(),
            force_noise: Vector3::zeros(),
            bridged: None,
            celsius: None,
        });
        if step % 100 == 99 {
            let received = match to < 60.5 {
                true => fix(to, 0, &MAST, None),
                false => fix(to, 1, &BRIDGE, lever),
            };
            let report = filter.apply(&received);
            let bad = |aid: &&AidReport| matches!(aid.outcome, Outcome::Rejected(_));
            refused += report.aids.iter().filter(bad).count();
        }
    }
    ((filter.nominal().position - earth::ecef(&place()).0).norm(), refused)
}

#[test]
fn a_receiver_with_an_antenna_of_its_own_moves_the_ship_nowhere() {
    let (error, refused) = after_the_change(Some(BRIDGE));
    assert!(error < 0.3 && refused == 0, "{error} m, {refused} refused");
    let (_, refused) = after_the_change(None);
    assert!(refused > 50, "taken for the other antenna: {refused} refused");
}

/// Claimed 1-sigma of the antenna to the north, m, after one fix of centimetres, of a ship that knows her attitude to so much, rad.
fn antenna_is_known_to(gnss: Body, attitude: f64) -> f64 {
    let mut filter = filter_with(gnss, attitude);
    let mut received = fix(0.0, 0, &gnss, None);
    let Message::Gnss(told) = &mut received.message else { unreachable!() };
    (told.position_std, told.quality) = (Some(Ned::new(0.01, 0.01, 0.02)), FixQuality::RtkFixed);
    filter.apply(&received);
    let c_ne = earth::c_ne(&place());
    let p = filter.covariance();
    let both = c_ne * POSITION.covariance_with(GNSS_LEVER, p);
    let antenna = POSITION.covariance_in(p, &c_ne) + both + both.transpose();
    (antenna + GNSS_LEVER.covariance(p))[(0, 0)].sqrt()
}

#[test]
fn a_fix_is_worth_no_more_than_an_unmeasured_arm_at_an_unknown_attitude_lets_it() {
    let (vague, sure) = (0.05, 1e-6);
    let unmeasured = Body::default();
    assert!(antenna_is_known_to(unmeasured, vague) > 0.5);
    assert!(antenna_is_known_to(unmeasured, sure) < 0.03);
    let lever = 20.0 * vague;
    assert!(antenna_is_known_to(unmeasured, vague) < 2.0 * lever);
}
