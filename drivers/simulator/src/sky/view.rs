//! Who is heard when, and from where: for those who reckon what could be known.

use insd_base::satellites::SatelliteId;
use insd_base::{Body, Ecef, earth};
use nalgebra::Vector3;

use super::channel::weight;
use super::path::{Site, ray};
use super::receiver::World;
use super::scene::{Reception, Scene};
use super::truth::JudgedSegment;
use super::voyage::setting;
use crate::scenario::{Raw, Scenario};
use crate::track::Track;

/// The sky of a voyage as its first antenna sees it.
#[derive(Debug)]
pub(crate) struct SkyView<'a> {
    track: &'a Track,
    lever: Body,
    world: World,
    scene: Scene,
}

/// A satellite that is heard.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    /// Which.
    pub(crate) id: SatelliteId,
    /// Unit vector towards it, north, east, down.
    pub(crate) towards: Vector3<f64>,
    /// Factor on all noise: 1 at the zenith.
    pub(crate) weight: f64,
    /// Delay of the code in the ionosphere, m.
    pub(crate) ionosphere: f64,
}

impl<'a> SkyView<'a> {
    /// The sky of the voyage of one seed; `None` where the start is no instant.
    pub(crate) fn new(scenario: &Scenario, raw: &Raw, track: &'a Track, seed: u64) -> Option<Self> {
        let (world, scene) = setting(scenario, raw, track, seed)?;
        let lever = Body(Vector3::from(raw.antennas_m.first().copied().unwrap_or_default()));
        Some(SkyView { track, lever, world, scene })
    }

    /// Who is heard at time `t`, s, as he should be.
    pub(crate) fn at(&self, t: f64) -> Vec<Seen> {
        let position = self.track.at(t).at_lever(&self.lever).0.0;
        let site = Site::new(t, position);
        let c_ne = earth::c_ne(&earth::geodetic(&Ecef(position)));
        let seen = |satellite: &super::satellite::Satellite| {
            let (id, ray) = (satellite.id(), ray(satellite, &site));
            let is_heard = matches!(self.scene.reception(id, &ray, t), Reception::Direct);
            is_heard.then(|| Seen {
                id,
                towards: c_ne * ray.direction,
                weight: weight(ray.elevation),
                ionosphere: self.world.air.path(id, &site, &ray).ionosphere,
            })
        };
        self.world.satellites.iter().filter_map(seen).collect()
    }

    /// The spans of time that are judged apart.
    pub(crate) fn segments(&self) -> Vec<JudgedSegment> {
        self.scene.segments()
    }
}
