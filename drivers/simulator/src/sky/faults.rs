//! What single satellites do that their records do not say.

use insd_base::satellites::SatelliteId;
use insd_base::units::DEG;

use super::path::{Site, ray};
use super::satellite::Satellite;
use super::truth::InjectedFault;
use crate::random::{Purpose, numbered, uniform};
use crate::scenario::RawFault;

/// A satellite that is not named is at least so high at both ends of the fault, rad.
const SEEN_FROM: f64 = 25.0 * DEG;

/// What a fault adds.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Effect {
    /// To the code, m.
    pub(crate) code: f64,
    /// To the phase, m.
    pub(crate) phase: f64,
    /// To the rate of the phase, m/s.
    pub(crate) rate: f64,
}

/// A fault of one satellite.
#[derive(Clone, Debug)]
pub(crate) struct SatelliteFault {
    satellite: SatelliteId,
    span: [f64; 2],
    fault: RawFault,
}

/// The faults of a voyage of `duration`, s, each with its satellite.
pub(crate) fn faults(
    list: &[RawFault],
    satellites: &[Satellite],
    site: impl Fn(f64) -> Site,
    duration: f64,
    seed: u64,
) -> Vec<SatelliteFault> {
    let mut taken: Vec<SatelliteId> =
        list.iter().filter_map(|fault| fault.satellite).map(|own| own.0).collect();
    let mut all = Vec::new();
    for (index, fault) in list.iter().enumerate() {
        let span = [fault.t0_s, fault.t1_s.unwrap_or(f64::INFINITY)];
        let drawn = || {
            let sites = [site(span[0].min(duration)), site(span[1].min(duration))];
            let is_high = |satellite: &&Satellite| {
                sites.iter().all(|site| ray(satellite, site).elevation > SEEN_FROM)
            };
            let high = satellites.iter().filter(is_high).map(Satellite::id);
            let high: Vec<SatelliteId> = high.filter(|id| !taken.contains(id)).collect();
            let mut rng = numbered(seed, Purpose::RawScene, 1000 + index as u64);
            high.get(uniform(&mut rng, 0.0, high.len() as f64) as usize).copied()
        };
        let satellite = fault.satellite.map(|own| own.0).or_else(drawn);
        taken.extend(satellite);
        all.extend(satellite.map(|satellite| SatelliteFault { satellite, span, fault: *fault }));
    }
    all
}

impl SatelliteFault {
    /// The satellite.
    pub(crate) fn satellite(&self) -> SatelliteId {
        self.satellite
    }

    /// Where it leaves its orbit: when, s, and how it is accelerated, m/s^2.
    pub(crate) fn leaves(&self) -> Option<(f64, f64)> {
        self.fault.stale_mps2.map(|acceleration| (self.span[0], acceleration))
    }

    /// What it adds to what is received at time `t`, s.
    pub(crate) fn effect(&self, t: f64) -> Effect {
        if !(self.span[0]..self.span[1]).contains(&t) {
            return Effect::default();
        }
        let rate = self.fault.ramp_mps.unwrap_or(0.0);
        let phase = rate * (t - self.span[0]) + self.fault.clock_jump_m.unwrap_or(0.0);
        Effect { code: phase + self.fault.jump_m.unwrap_or(0.0), phase, rate }
    }

    /// The same for those who judge, in a voyage of `duration`, s.
    pub(crate) fn injected(&self, duration: f64) -> InjectedFault {
        let RawFault { ramp_mps, jump_m, clock_jump_m, stale_mps2, .. } = self.fault;
        let sizes = [
            ("ramp_mps", ramp_mps),
            ("jump_m", jump_m),
            ("clock_jump_m", clock_jump_m),
            ("stale_mps2", stale_mps2),
        ];
        let given = sizes.into_iter().find_map(|(kind, size)| size.map(|size| (kind, size)));
        let (kind, size) = given.unwrap_or_default();
        let t1_s = self.span[1].min(duration);
        InjectedFault {
            satellite: self.satellite,
            kind: kind.to_owned(),
            t0_s: self.span[0],
            t1_s,
            size,
        }
    }
}
