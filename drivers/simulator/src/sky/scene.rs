//! What stands between an antenna and the sky, and what sends it false signals.

use insd_base::satellites::SatelliteId;
use insd_base::units::{DEG, wrap_two_pi};
use nalgebra::Vector3;
use rand_pcg::Pcg64;

use super::path::{Ray, Site, ray};
use super::satellite::Satellite;
use super::truth::{InjectedSpoof, JudgedSegment};
use crate::random::{Purpose, numbered, uniform};
use crate::scenario::{Raw, RawCrane, RawSegment, RawSpoof};

/// Satellites that are left in a segment are at least so high at both its ends, rad.
const KEPT_FROM: f64 = 20.0 * DEG;
/// Those that are reflected are lower, rad.
const REFLECTED_TO: f64 = 55.0 * DEG;
/// Shortest and longest detour of a reflection, m.
const DETOUR: [f64; 2] = [5.0, 60.0];

/// A wall from which a satellite is heard that is hidden itself.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reflector {
    /// Detour at the first moment, m.
    detour: f64,
    /// Where the antenna was then, ECEF, m.
    origin: Vector3<f64>,
    /// Gradient of the detour, 2 (n.e) n, n the normal of the wall, e towards the satellite.
    gradient: Vector3<f64>,
}

impl Reflector {
    /// The detour to a site, m. A ship that would come too near to the wall or too far from it has the next one at hand: the detour is
    /// folded back.
    pub(crate) fn detour(&self, site: &Site) -> f64 {
        let [low, high] = DETOUR;
        let plain = self.detour + self.gradient.dot(&(site.position - self.origin));
        let folded = (plain - low).rem_euclid(2.0 * (high - low));
        low + folded.min(2.0 * (high - low) - folded)
    }
}

/// A segment with its satellites.
#[derive(Clone, Debug)]
struct Span {
    segment: RawSegment,
    kept: Option<Vec<SatelliteId>>,
    reflected: Vec<(SatelliteId, Reflector)>,
}

/// How a satellite is received.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Reception<'a> {
    /// Not at all.
    Hidden,
    /// As it should.
    Direct,
    /// By its reflection only.
    Reflected(&'a Reflector),
}

/// All that is between the ship's antennas and the sky.
#[derive(Clone, Debug)]
pub(crate) struct Scene {
    mask: f64,
    spans: Vec<Span>,
    cranes: Vec<RawCrane>,
    spoofs: Vec<RawSpoof>,
}

impl Scene {
    /// The scene of the ship, whose place at a time `site` tells.
    pub(crate) fn new(
        raw: &Raw,
        satellites: &[Satellite],
        site: impl Fn(f64) -> Site,
        seed: u64,
    ) -> Self {
        let span = |(index, segment): (usize, &RawSegment)| {
            let mut rng = numbered(seed, Purpose::RawScene, index as u64);
            let sites = [site(segment.t0_s), site(segment.t1_s)];
            Span::new(segment, satellites, &sites, raw.mask_deg * DEG, &mut rng)
        };
        Scene {
            mask: raw.mask_deg * DEG,
            spans: raw.segment.iter().enumerate().map(span).collect(),
            cranes: raw.crane.clone(),
            spoofs: raw.spoof.clone(),
        }
    }

    /// An open sky above a mask, rad.
    pub(crate) fn open(mask: f64) -> Self {
        Scene { mask, spans: Vec::new(), cranes: Vec::new(), spoofs: Vec::new() }
    }

    /// How a satellite is received at time `t`, s, by a ray.
    pub(crate) fn reception(&self, id: SatelliteId, ray: &Ray, t: f64) -> Reception<'_> {
        let mut now =
            self.spans.iter().filter(|span| (span.segment.t0_s..span.segment.t1_s).contains(&t));
        let is_behind = |crane: &RawCrane| {
            let [from, to] = crane.azimuth_deg.map(|bearing| bearing * DEG);
            let holds = t >= crane.t0_s && crane.t1_s.is_none_or(|end| t < end);
            let inside = wrap_two_pi(ray.azimuth - from) <= wrap_two_pi(to - from);
            holds && inside && ray.elevation < crane.elevation_deg * DEG
        };
        let is_left = |span: &Span| span.kept.as_ref().is_none_or(|kept| kept.contains(&id));
        if ray.elevation < self.mask
            || self.cranes.iter().any(is_behind)
            || !now.clone().all(is_left)
        {
            return Reception::Hidden;
        }
        let reflector = now.find_map(|span| span.reflected.iter().find(|(own, _)| *own == id));
        reflector.map_or(Reception::Direct, |(_, reflector)| Reception::Reflected(reflector))
    }

    /// How many times as large as stated multipath is at time `t`, s.
    pub(crate) fn multipath(&self, t: f64) -> f64 {
        let now =
            self.spans.iter().filter(|span| (span.segment.t0_s..span.segment.t1_s).contains(&t));
        now.map(|span| span.segment.multipath).product()
    }

    /// The spoofer at work at time `t`, s.
    pub(crate) fn spoof(&self, t: f64) -> Option<&RawSpoof> {
        self.spoofs.iter().find(|spoof| (spoof.t0_s..spoof.t1_s).contains(&t))
    }

    /// Its segments, for those who judge.
    pub(crate) fn segments(&self) -> Vec<JudgedSegment> {
        let judged = |span: &Span| JudgedSegment {
            t0_s: span.segment.t0_s,
            t1_s: span.segment.t1_s,
            label: span.segment.label.clone(),
            satellites: span.kept.clone(),
        };
        self.spans.iter().map(judged).collect()
    }

    /// Its spoofers, for those who judge.
    pub(crate) fn injected_spoofs(&self) -> Vec<InjectedSpoof> {
        let injected = |spoof: &RawSpoof| InjectedSpoof {
            t0_s: spoof.t0_s,
            t1_s: spoof.t1_s,
            speed_mps: spoof.speed_mps,
            direction_deg: spoof.direction_deg,
            clock_m: spoof.clock_m,
        };
        self.spoofs.iter().map(injected).collect()
    }
}

impl Span {
    fn new(
        segment: &RawSegment,
        satellites: &[Satellite],
        sites: &[Site; 2],
        mask: f64,
        rng: &mut Pcg64,
    ) -> Self {
        let seen = |satellite: &Satellite| {
            let [first, last] = [ray(satellite, &sites[0]), ray(satellite, &sites[1])];
            (
                satellite.id(),
                first,
                first.elevation.min(last.elevation),
                first.elevation.max(last.elevation),
            )
        };
        let seen: Vec<_> = satellites.iter().map(seen).collect();
        let high = seen.iter().filter(|(_, _, low, _)| *low > KEPT_FROM.max(mask)).map(|own| own.0);
        let kept = segment.satellites.map(|count| {
            let mut kept = some(high.collect(), count, rng);
            kept.sort();
            kept
        });
        let is_low = |own: &&(SatelliteId, Ray, f64, f64)| own.2 > mask && own.3 < REFLECTED_TO;
        let low = seen.iter().filter(is_low).map(|own| (own.0, own.1)).collect();
        let chosen = some(low, segment.reflected, rng).into_iter();
        let reflected = chosen.map(|(id, ray)| (id, reflector(&ray, &sites[0], rng))).collect();
        Span { segment: segment.clone(), kept, reflected }
    }
}

/// So many out of a list, at random; all if there are no more.
fn some<T>(mut list: Vec<T>, count: usize, rng: &mut Pcg64) -> Vec<T> {
    let mut chosen = Vec::new();
    while chosen.len() < count && !list.is_empty() {
        let index = uniform(rng, 0.0, list.len() as f64) as usize;
        chosen.push(list.swap_remove(index.min(list.len() - 1)));
    }
    chosen
}

/// A wall beyond the ship as seen from a satellite, within 60 degrees.
fn reflector(ray: &Ray, site: &Site, rng: &mut Pcg64) -> Reflector {
    let bearing = ray.azimuth + uniform(rng, -60.0, 60.0) * DEG;
    let normal = site.direction(bearing);
    Reflector {
        detour: uniform(rng, DETOUR[0], DETOUR[1]),
        origin: site.position,
        gradient: normal * (2.0 * normal.dot(&ray.direction)),
    }
}
