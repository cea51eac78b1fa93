//! The way of a signal from a satellite to an antenna.

use std::collections::BTreeMap;

use insd_base::earth::{c_ne, geodetic};
use insd_base::satellites::{SPEED_OF_LIGHT, SatelliteId};
use insd_base::{Ecef, Geodetic, GpsTime};
use nalgebra::{Matrix3, Rotation3, Vector3};

use super::atmosphere::{Troposphere, ionosphere};
use super::constellation::number;
use super::kepler::EARTH_RATE;
use super::satellite::{Satellite, SatelliteState};
use super::wander::Wander;
use crate::random::{Purpose, normal, numbered, uniform};
use crate::scenario::RawSky;

/// An antenna at one instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Site {
    /// When, s since the start.
    pub(crate) t: f64,
    /// Where, Earth-fixed axes of that instant, m.
    pub(crate) position: Vector3<f64>,
    point: Geodetic,
    c_ne: Matrix3<f64>,
}

impl Site {
    /// The antenna at time `t`, s, and a position, ECEF, m.
    pub(crate) fn new(t: f64, position: Vector3<f64>) -> Self {
        let point = geodetic(&Ecef(position));
        Site { t, position, point, c_ne: c_ne(&point) }
    }

    /// The horizontal direction of a bearing, rad, ECEF axes.
    pub(crate) fn direction(&self, bearing: f64) -> Vector3<f64> {
        self.c_ne.tr_mul(&Vector3::new(bearing.cos(), bearing.sin(), 0.0))
    }
}

/// From an antenna to a satellite.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    /// Geometric length, Earth-fixed axes of the instant of reception, m.
    pub(crate) length: f64,
    /// Unit vector towards the satellite, ECEF.
    pub(crate) direction: Vector3<f64>,
    /// From true north, rad, in (-pi, pi].
    pub(crate) azimuth: f64,
    /// rad.
    pub(crate) elevation: f64,
    /// Its clock ahead when it was sent, m.
    pub(crate) clock: f64,
}

/// The ray by which a satellite is received at a site.
///
/// The signal left when the satellite was as far away as light goes since: found by iteration, which gains a factor of 1e5 each time. The
/// axes have turned with the Earth by then.
pub(crate) fn ray(satellite: &Satellite, site: &Site) -> Ray {
    let mut travel = 0.08;
    let mut state = satellite.at(site.t - travel);
    let mut way = way_to(&state, site, travel);
    for _ in 0..3 {
        travel = way.norm() / SPEED_OF_LIGHT;
        state = satellite.at(site.t - travel);
        way = way_to(&state, site, travel);
    }
    let length = way.norm();
    let direction = way / length;
    let local = site.c_ne * direction;
    Ray {
        length,
        direction,
        azimuth: local.y.atan2(local.x),
        elevation: (-local.z).asin(),
        clock: state.clock,
    }
}

/// From a site to where a satellite was `travel`, s, before, in the axes of now.
fn way_to(state: &SatelliteState, site: &Site, travel: f64) -> Vector3<f64> {
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), -EARTH_RATE * travel);
    turn * state.position - site.position
}

/// What becomes of a ray on its way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Path {
    /// Geometric length less the clock of the satellite, with the delay of the troposphere, m.
    pub(crate) range: f64,
    /// Delay of the code on L1 in the ionosphere, and advance of the phase, m.
    pub(crate) ionosphere: f64,
}

/// The air over the voyage.
#[derive(Debug)]
pub(crate) struct Air {
    /// Seconds of the GPS day at the start.
    start: f64,
    factor: f64,
    wanders: BTreeMap<SatelliteId, Wander>,
    troposphere: Troposphere,
}

impl Air {
    /// The air of one voyage that begins at `start`.
    pub(crate) fn new(sky: &RawSky, start: GpsTime, satellites: &[Satellite], seed: u64) -> Self {
        let [low, high] = sky.ionosphere_factor;
        let wander = |satellite: &Satellite| {
            let id = satellite.id();
            let mut rng = numbered(seed, Purpose::Ionosphere, number(id));
            (id, Wander::new(sky.ionosphere_std, sky.period_s, &mut rng))
        };
        let water = normal(&mut numbered(seed, Purpose::Troposphere, 0));
        Air {
            start: (start.to_week().1 as f64 * 1e-9) % 86_400.0,
            factor: uniform(&mut numbered(seed, Purpose::Ionosphere, 0), low, high),
            wanders: satellites.iter().map(wander).collect(),
            troposphere: Troposphere {
                factor: sky.troposphere_factor,
                wet_error: sky.wet_zenith_std_m * water,
            },
        }
    }

    /// What becomes of a ray of a satellite.
    pub(crate) fn path(&self, id: SatelliteId, site: &Site, ray: &Ray) -> Path {
        let change = self.wanders.get(&id).map_or(0.0, |wander| wander.at(site.t));
        let broadcast = ionosphere(&site.point, ray.azimuth, ray.elevation, self.start + site.t);
        let troposphere = self.troposphere.delay(&site.point, ray.elevation);
        Path {
            range: ray.length - ray.clock + troposphere,
            ionosphere: broadcast * (self.factor + change),
        }
    }
}
