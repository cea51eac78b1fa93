//! The GNSS receiver.

use nalgebra::Vector3;
use rand_pcg::Pcg64;

use insd_base::earth::{c_ne, geodetic};
use insd_base::{Body, Ecef, FixQuality, GnssFix, Ned, Stamped, Time};

use super::gnss_faults::{GnssFaults, Trouble};
use super::{delayed, epochs};
use crate::random::{GaussMarkov, Purpose, normal3, stream, uniform};
use crate::scenario::{Gnss, GnssGrade, GnssNoise, StdFault};
use crate::track::{Kinematics, Track};

/// The dilution of precision to which the noise of the scenario belongs.
const NOMINAL_HDOP: f64 = 0.9;
/// What a receiver claims that claims nonsense, m or m/s.
const ABSURD_STD: f64 = 1e7;

/// White plus slow noise of three components, north, east, down.
#[derive(Debug)]
struct Noise {
    white: Vector3<f64>,
    slow: GaussMarkov,
    rng: Pcg64,
    /// 1-sigma of both together.
    std: Vector3<f64>,
}

impl Noise {
    fn new(noise: &GnssNoise, white: Pcg64, slow: Pcg64) -> Self {
        let correlated = Vector3::from(noise.correlated);
        let both = Vector3::from(noise.white).zip_map(&correlated, f64::hypot);
        Noise {
            white: Vector3::from(noise.white),
            slow: GaussMarkov::new(correlated, noise.correlation_time_s, slow),
            rng: white,
            std: both,
        }
    }

    fn next(&mut self, dt: f64) -> Vector3<f64> {
        self.slow.advance(dt) + self.white.component_mul(&normal3(&mut self.rng))
    }
}

/// The constellation: a dilution of precision that changes slowly, and satellites that go with it.
#[derive(Debug)]
struct Sky {
    mean: f64,
    change: GaussMarkov,
}

impl Sky {
    fn new(mut rng: Pcg64) -> Self {
        let mean = uniform(&mut rng, 0.82, 0.98);
        Sky { mean, change: GaussMarkov::new(Vector3::repeat(0.05), 600.0, rng) }
    }

    /// Dilution of precision and number of satellites after another `dt`, s.
    fn next(&mut self, dt: f64) -> (f64, u16) {
        let hdop = (self.mean + self.change.advance(dt).x).clamp(0.7, 1.1);
        let satellites = (14.0 - (hdop - NOMINAL_HDOP) * 15.0).round().clamp(12.0, 16.0);
        (hdop, satellites as u16)
    }
}

struct Receiver {
    lever_arm: Body,
    quality: FixQuality,
    with_velocity: bool,
    position: Noise,
    velocity: Noise,
    sky: Sky,
}

impl Receiver {
    fn new(gnss: &Gnss, seed: u64) -> Self {
        Receiver {
            lever_arm: Body(Vector3::from(gnss.lever_arm_m)),
            quality: match gnss.grade {
                GnssGrade::Standard => FixQuality::Differential,
                GnssGrade::Rtk => FixQuality::RtkFixed,
            },
            with_velocity: gnss.with_velocity,
            position: Noise::new(
                &gnss.position_noise(),
                stream(seed, Purpose::GnssPositionWhite),
                stream(seed, Purpose::GnssPositionCorrelated),
            ),
            velocity: Noise::new(
                &gnss.velocity_noise(),
                stream(seed, Purpose::GnssVelocityWhite),
                stream(seed, Purpose::GnssVelocityCorrelated),
            ),
            sky: Sky::new(stream(seed, Purpose::GnssDop)),
        }
    }

    /// The fix at an epoch that comes `dt`, s, after the one before. The noises go on through
    /// outages, so that the same fixes come after them as would have without.
    fn fix(&mut self, time: Time, ship: &Kinematics, dt: f64, trouble: &Trouble) -> GnssFix {
        let (sky_hdop, sky_satellites) = self.sky.next(dt);
        let (position_noise, velocity_noise) = (self.position.next(dt), self.velocity.next(dt));
        if trouble.outage.is_some() {
            return GnssFix { time, satellites: Some(2), ..GnssFix::default() };
        }
        let (hdop, satellites) = trouble.spike.unwrap_or((sky_hdop, sky_satellites));
        let factor = trouble.spike.map_or(1.0, |(hdop, _)| hdop / NOMINAL_HDOP);
        let (antenna, antenna_velocity) = ship.at_lever(&self.lever_arm);
        let c_ne = c_ne(&geodetic(&antenna));
        let shifted = c_ne.tr_mul(&(position_noise * factor + trouble.position));
        let velocity = c_ne * antenna_velocity + velocity_noise * factor + trouble.velocity;
        let claim = |std: Vector3<f64>| claimed(std * factor, trouble.std);
        GnssFix {
            time,
            position: Some(geodetic(&Ecef(antenna.0 + shifted))),
            velocity: self.with_velocity.then_some(Ned(velocity)),
            position_std: claim(self.position.std),
            velocity_std: if self.with_velocity { claim(self.velocity.std) } else { None },
            hdop: Some(hdop),
            satellites: Some(satellites),
            quality: self.quality,
            lever: None,
            redated: 0.0,
            rank: 0,
        }
    }
}

fn claimed(std: Vector3<f64>, fault: Option<StdFault>) -> Option<Ned> {
    match fault {
        None => Some(Ned(std)),
        Some(StdFault::Zero) => Some(Ned::default()),
        Some(StdFault::Missing) => None,
        Some(StdFault::Absurd) => Some(Ned(Vector3::repeat(ABSURD_STD))),
    }
}

/// The fixes of a voyage of `duration`, s.
pub(crate) fn fixes(gnss: &Gnss, track: &Track, duration: f64, seed: u64) -> Vec<Stamped<GnssFix>> {
    let mut receiver = Receiver::new(gnss, seed);
    let faults = GnssFaults::new(gnss, seed);
    let mut lateness = stream(seed, Purpose::GnssArrival);
    let mut fixes = Vec::with_capacity((duration * gnss.rate_hz) as usize + 1);
    for time in epochs(gnss.rate_hz, 0, duration) {
        let t = time.as_seconds();
        let trouble = faults.at(t);
        let fix = receiver.fix(time, &track.at(t), 1.0 / gnss.rate_hz, &trouble);
        let stamped = delayed(fix, time, gnss.arrival, &mut lateness);
        if trouble.outage != Some(false) {
            fixes.push(stamped);
        }
    }
    fixes
}
