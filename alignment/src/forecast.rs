//! When a ship at her berth will know her heading: the covariance of the filter run ahead without data.
//!
//! Each step takes the samples at the berth that fall into it as one of as much less noise; the steps
//! grow, as what is learnt later is learnt more slowly. What limits the heading is the largest of
//! three shares of its variance at the end:
//!
//! * the bias of the gyros to the east, (b / (omega_ie cos lat))^2;
//! * their random walk N over the time T that it takes, (N / (omega_ie cos lat))^2 / T: the mean rate
//!   over T is known no better than N / sqrt(T);
//! * the rest, which is the motion of the ship.
//!
//! Cost: about 60,000 instructions for a step, 30 to 60 steps where the heading is reached within a
//! quarter of an hour, 120 where it never is. Measured (callgrind), all forecasts of scenario 7 together
//! are 16 million instructions, of which a navigator alone spends as many in half a minute.

use insd_base::alignment::gyrocompass_sigma;
use insd_base::{Forecast, ImuSpec, Lack, Limiting, Span, Time, earth};
use insd_nav::Navigator;
use insd_nav::berth::BerthSample;

use crate::progress::Progress;

/// No forecast goes further, s.
const HORIZON: f64 = 7200.0;
/// Length of a step as share of the time gone, and its bounds, s.
const STEP_SHARE: f64 = 0.05;
const STEPS: (f64, f64) = (6.0, 60.0);
/// Where the heading improves by less than this share in [`PATIENCE`], it will not improve much more.
const IMPROVEMENT: f64 = 0.02;
/// See [`IMPROVEMENT`], s.
const PATIENCE: f64 = 600.0;

/// When the heading of a ship at her berth will have this sigma, rad, if all stays as it is. Its covariance must be
/// settled.
#[must_use]
pub fn at_the_berth(navigator: &Navigator, imu: &ImuSpec, target: f64) -> Forecast {
    let Some(BerthSample { innovation: mut sample, spacing, start }) = navigator.berth_sample()
    else {
        return Forecast::Unknown { lacks: Lack::Method };
    };
    let (filter, waves) = (navigator.filter(), navigator.waves());
    let mut ahead = filter.ahead();
    let white = sample.r.clone();
    let speed = waves.map_or(0.0, |waves| waves.velocity.xy().norm());
    let latitude = ahead.view().geodetic.latitude;
    let mut gone = 0.0;
    let mut sigma = ahead.heading_std();
    let mut progress = Progress::begin((PATIENCE, IMPROVEMENT), gone, sigma);
    while sigma >= target {
        let step = (STEP_SHARE * gone).clamp(STEPS.0, STEPS.1);
        ahead.advance(step);
        sample.r = &white * (spacing / step);
        ahead.observe(&sample);
        ahead.observe_gnss_velocity(speed, step);
        gone += step;
        let last = std::mem::replace(&mut sigma, ahead.heading_std());
        if sigma < target {
            // between the two steps, as if the sigma fell evenly
            gone -= step * ((target - sigma) / (last - sigma).max(f64::MIN_POSITIVE)).min(1.0);
            break;
        }
        if progress.stalls(gone, sigma) || gone > HORIZON {
            let limiting = limiting(imu, latitude, sigma, gone);
            return Forecast::Unreachable { best: sigma, limiting };
        }
    }
    let at = filter.time() + Span::from_seconds(gone);
    let since = (at - start).as_seconds();
    Forecast::Expected { at, limiting: limiting(imu, latitude, target, since) }
}

/// What can be said before any data: that the bias of the gyros alone keeps the heading from its
/// target, or that it is too early to tell.
#[must_use]
pub fn of_the_gyros(imu: &ImuSpec, latitude: f64, target: f64) -> Forecast {
    let best = gyrocompass_sigma(imu, latitude);
    if best < target {
        return Forecast::Unknown { lacks: Lack::Time };
    }
    // nearer to the equator the same gyros would have done
    let there = insd_base::alignment::NO_HEADING;
    let by_latitude = best >= there && gyrocompass_sigma(imu, MIDDLE_LATITUDE) < there;
    let limiting = if by_latitude { Limiting::Latitude } else { Limiting::GyroBias };
    Forecast::Unreachable { best, limiting }
}

/// Where gyros that tell no heading are too coarse, not too far north, rad.
const MIDDLE_LATITUDE: f64 = std::f64::consts::FRAC_PI_4;

fn limiting(imu: &ImuSpec, latitude: f64, sigma: f64, elapsed: f64) -> Limiting {
    let east = earth::RATE * latitude.cos().abs().max(1e-9);
    let bias = gyrocompass_sigma(imu, latitude).powi(2);
    let walk = (imu.gyro.random_walk / east).powi(2) / elapsed.max(1.0);
    let rest = sigma * sigma - bias - walk;
    if rest > bias && rest > walk {
        Limiting::Sea
    } else if walk > bias {
        Limiting::RandomWalk
    } else {
        Limiting::GyroBias
    }
}

/// When the next forecast is worth its cost, after one made `now`: as often as things change, which
/// is ever more seldom; and one that finds no end, which costs most, changes least.
#[must_use]
pub fn next_look(start: Time, now: Time, forecast: Forecast) -> Time {
    const LEAST: f64 = 30.0;
    let share = if matches!(forecast, Forecast::Unreachable { .. }) { 1.0 } else { 0.25 };
    now + Span::from_seconds(((now - start).as_seconds() * share).max(LEAST))
}
