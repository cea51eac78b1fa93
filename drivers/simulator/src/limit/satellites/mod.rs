//! The limit of a scenario with raw GNSS: what the optimal filter could know of a ship with an IMU and any number of antennas, in the sky
//! of one seed.
//!
//! A covariance analysis like [`super`], in three dimensions. Codes, phases and Doppler shifts of all satellites that are heard, in all
//! antennas, with the states that the simulator gives them: clocks by group, offsets of constellations, lines, cycles, reflections by
//! satellite and antenna, orbits, clocks of satellites and the air. Smooth errors, there sums of a few sinusoids, are damped oscillators.
//! Integers between antennas are taken for known and slips for found; fixes of the receiver, which are of the same signals, add nothing.

mod eyes;
mod inertial;
mod knowledge;
mod states;

use std::collections::BTreeSet;

use insd_base::ImuSpec;
use insd_base::earth::c_ne;
use insd_base::satellites::{SPEED_OF_LIGHT, SatelliteId};
use nalgebra::{DMatrix, Vector3};

use super::covariance::discrete;
use super::model::cross;
use super::{LimitError, covered};
use crate::camera::installed;
use crate::scenario::{Raw, Scenario};
use crate::sky::{JudgedSegment, Seen, SkyView};
use crate::track::Track;

pub use eyes::CameraUse;
use eyes::Eyes;
use inertial::{ATTITUDE, POSITION, VELOCITY};
use knowledge::Knowledge;
use states::{OfSatellite, States};

/// Damping of what stands for smooth errors.
const DAMPING: f64 = 0.2;
/// What is so near is taken together, s.
const SAME: f64 = 1e-6;
/// 1-sigma of cycles of which nothing is known, m.
const CYCLES: f64 = 100.0;
/// Of a clock's bias and drift, m and m/s.
const CLOCK: [f64; 2] = [3e5, 100.0];
/// Of a line's delay: anywhere in a cycle of L1, m.
const LINE: f64 = SPEED_OF_LIGHT / 1_575_420_000.0 / 3.464;

/// The 1-sigma of the optimal filter in a segment that is judged apart.
#[derive(Clone, Debug, PartialEq)]
pub struct SegmentLimit {
    /// The segment.
    pub segment: JudgedSegment,
    /// Horizontal position at its end as a radius: the root of the sum of both variances, m.
    pub position_end: f64,
    /// Change of it since the first epoch of the segment, at its end, m.
    pub relative_end: f64,
    /// The same, root of the mean square over its epochs, m.
    pub relative_rms: f64,
    /// Horizontal velocity at its end, m/s.
    pub velocity_end: f64,
    /// Heading, roll and pitch, RMS over its epochs, rad.
    pub attitude_rms: [f64; 3],
}

/// The limits of the segments of a scenario with raw GNSS, in the sky of a seed.
///
/// # Errors
/// The scenario has no raw GNSS, or something that is not modelled: see [`LimitError`].
pub fn satellite_limit(scenario: &Scenario, seed: u64) -> Result<Vec<SegmentLimit>, LimitError> {
    analysed(scenario, seed, None)
}

/// The same of a scenario with a camera, by what it tells of a kind. What is mismatched is taken for found; mounting and clock
/// for known, but for what they are drawn from where tracks are used.
///
/// # Errors
/// The scenario has no raw GNSS, no camera, or something that is not modelled: see [`LimitError`].
pub fn camera_limit(
    scenario: &Scenario,
    seed: u64,
    by: CameraUse,
) -> Result<Vec<SegmentLimit>, LimitError> {
    analysed(scenario, seed, Some(by))
}

fn analysed(
    scenario: &Scenario,
    seed: u64,
    by: Option<CameraUse>,
) -> Result<Vec<SegmentLimit>, LimitError> {
    let raw = scenario.raw.as_ref().ok_or(LimitError::NotCovered("no raw GNSS"))?;
    let camera = || scenario.camera.as_ref().ok_or(LimitError::NotCovered("no camera"));
    let camera = by.map(|_| camera()).transpose()?;
    check(scenario, raw)?;
    if camera.is_some_and(|camera| !camera.fault.is_empty()) {
        return Err(LimitError::NotCovered("faults of the camera"));
    }
    let track = Track::new(scenario, seed);
    let sky = SkyView::new(scenario, raw, &track, seed)
        .ok_or(LimitError::NotCovered("a start that is no instant"))?;
    let camera = camera.map(|camera| installed(camera, seed));
    let eyes = camera.as_ref().zip(by).map(|(camera, by)| {
        Eyes::new(scenario, camera, &track, seed, by).ok_or(LimitError::NotCovered("no quay"))
    });
    Ok(Analysis::new(scenario, raw, &track, &sky, eyes.transpose()?).run())
}

fn check(scenario: &Scenario, raw: &Raw) -> Result<(), LimitError> {
    let refused = [
        (scenario.log.is_some(), "a velocity log"),
        (scenario.reference.is_some(), "a reference"),
        (raw.frequencies > 1, "raw GNSS of two frequencies"),
        (raw.base.is_some(), "a base"),
        (!raw.fault.is_empty() || !raw.spoof.is_empty(), "faults of satellites"),
        (!raw.antenna_fault.is_empty() || raw.swapped.is_some(), "faults of antennas"),
    ];
    covered(scenario, &refused)
}

/// What is gathered of a segment.
#[derive(Debug, Default)]
struct Sums {
    epochs: f64,
    relative: f64,
    attitude: [f64; 3],
    end: [f64; 3],
}

/// Everything that the recursion goes through again and again.
struct Analysis<'a> {
    raw: &'a Raw,
    spec: ImuSpec,
    track: &'a Track,
    sky: &'a SkyView<'a>,
    states: States,
    knowledge: Knowledge,
    /// Transition and noise of a clock, of a change of orbit and satellite clock, and of the ionosphere over an interval.
    smooth: [(DMatrix<f64>, DMatrix<f64>); 3],
    /// From epoch to epoch, s, and how many epochs there are.
    interval: f64,
    count: usize,
    heard: BTreeSet<SatelliteId>,
    eyes: Option<Eyes<'a>>,
}

impl<'a> Analysis<'a> {
    fn new(
        scenario: &Scenario,
        raw: &'a Raw,
        track: &'a Track,
        sky: &'a SkyView<'a>,
        eyes: Option<Eyes<'a>>,
    ) -> Self {
        let interval = 1.0 / raw.rate_hz;
        let count = (scenario.duration() * raw.rate_hz) as usize;
        let all = (1..=count).flat_map(|epoch| sky.at(epoch as f64 * interval));
        let states = States::new(
            raw,
            &all.map(|seen| seen.id).collect(),
            eyes.as_ref().map_or(0, Eyes::states),
        );
        let spec = scenario.imu.simulated();
        let mut own = Analysis {
            knowledge: Knowledge::new(states.size()),
            smooth: smooth(raw, interval),
            heard: BTreeSet::new(),
            raw,
            spec,
            track,
            sky,
            states,
            interval,
            count,
            eyes,
        };
        own.begin();
        own
    }

    /// What is known at the start.
    fn begin(&mut self) {
        let (raw, knowledge) = (self.raw, &mut self.knowledge);
        let sky = &raw.sky;
        for (place, variance) in inertial::initial(&self.spec).into_iter().enumerate() {
            knowledge.reset(place, variance);
        }
        let mut set = |place: usize, std: f64| knowledge.reset(place, std * std);
        for place in self.states.clocks() {
            set(place, CLOCK[0]);
            set(place + 1, CLOCK[1]);
        }
        self.states.offsets().for_each(|place| set(place, raw.constellation_offset_std_m));
        let antennas = raw.antennas_m.len();
        (0..antennas).flat_map(|own| self.states.lines_of(own)).for_each(|own| set(own, LINE));
        let [low, high] = sky.ionosphere_factor;
        set(self.states.factor, (high - low) / 12.0_f64.sqrt());
        set(self.states.water, sky.wet_zenith_std_m);
        if let Some(eyes) = &self.eyes {
            eyes.begin(self.states.eyes).for_each(|(place, std)| set(place, std));
        }
        let omega = omega(raw);
        for own in self.states.satellites() {
            let slow = slow_std(raw);
            set(own.slow, slow);
            set(own.slow + 1, slow * omega);
            set(own.ionosphere, sky.ionosphere_std);
            set(own.ionosphere + 1, sky.ionosphere_std * omega);
            for antenna in 0..antennas {
                set(own.reflections + 2 * antenna, raw.multipath_code_std_m);
                set(own.reflections + 2 * antenna + 1, raw.multipath_phase_std_m);
            }
        }
    }

    fn run(mut self) -> Vec<SegmentLimit> {
        let segments = self.sky.segments();
        let mut sums: Vec<Sums> = segments.iter().map(|_| Sums::default()).collect();
        for epoch in 1..=self.count {
            let t = epoch as f64 * self.interval;
            self.predict(t - self.interval, t);
            for seen in self.hear(t) {
                self.measure(t, &seen);
            }
            for (segment, sums) in segments.iter().zip(&mut sums) {
                if (segment.t0_s..segment.t1_s).contains(&t) {
                    self.gather(t, sums);
                }
            }
        }
        segments.into_iter().zip(sums).map(|(own, sums)| sums.limit(own)).collect()
    }

    /// Carries the inertial system on, from image to image where there is a camera.
    fn sail(&mut self, from: f64, to: f64) {
        let mut stops = vec![(from + to) / 2.0, to];
        stops.extend(self.eyes.iter().flat_map(|eyes| eyes.until(to)));
        stops.sort_by(f64::total_cmp);
        stops.dedup_by(|late, early| *late - *early < SAME);
        let mut begin = from;
        for stop in stops {
            let (phi, added) = inertial::carried_on(&self.spec, self.track, [begin, stop]);
            self.knowledge.carry(0, &phi, &added);
            if let Some(eyes) = &mut self.eyes {
                eyes.look(stop + SAME, self.states.eyes, &mut self.knowledge);
            }
            begin = stop;
        }
    }

    // an image has to do with the ship and what it shows alone, so that it may come before all else is carried on
    fn predict(&mut self, from: f64, to: f64) {
        self.sail(from, to);
        let [clock, slow, ionosphere] = &self.smooth;
        for place in self.states.clocks() {
            self.knowledge.carry(place, &clock.0, &clock.1);
        }
        let raw = self.raw;
        let memory = (-self.interval / raw.multipath_time_constant_s).exp();
        let fresh = 1.0 - memory * memory;
        let reflections = [raw.multipath_code_std_m, raw.multipath_phase_std_m];
        let antennas = raw.antennas_m.len();
        for own in self.states.satellites() {
            self.knowledge.carry(own.slow, &slow.0, &slow.1);
            self.knowledge.carry(own.ionosphere, &ionosphere.0, &ionosphere.1);
            for index in 0..2 * antennas {
                let variance = reflections[index % 2].powi(2) * fresh;
                self.knowledge.decay(own.reflections + index, memory, variance);
            }
        }
        self.walk_lines();
    }

    /// The delay of an antenna's line changes for all of its satellites alike.
    fn walk_lines(&mut self) {
        let variance = self.raw.line_bias_walk_m_sqrt_s.powi(2) * self.interval;
        for antenna in 0..self.raw.antennas_m.len() {
            let places: Vec<usize> = self.states.lines_of(antenna).collect();
            self.knowledge.add_together(&places, variance);
        }
    }

    /// Who is heard; the cycles of one that was not heard before are unknown.
    fn hear(&mut self, t: f64) -> Vec<Seen> {
        let all = self.sky.at(t);
        for seen in all.iter().filter(|seen| !self.heard.contains(&seen.id)) {
            if let Some(own) = self.states.satellite(seen.id) {
                self.knowledge.reset(own.cycles, CYCLES * CYCLES);
            }
        }
        self.heard = all.iter().map(|seen| seen.id).collect();
        all
    }

    /// Code, phase and rate of a satellite in all antennas.
    fn measure(&mut self, t: f64, seen: &Seen) {
        let Some(own) = self.states.satellite(seen.id) else { return };
        let ship = self.track.at(t);
        let c_nb = c_ne(&ship.point) * ship.c_eb;
        for (antenna, lever) in self.raw.antennas_m.iter().enumerate() {
            let lever = Vector3::from(*lever);
            let [at, moving] = [c_nb * lever, c_nb * ship.omega_eb.cross(&lever)];
            let clock = self.states.clock(antenna);
            let place = towards(seen, POSITION.at(0), &at);
            let rate = towards(seen, VELOCITY.at(0), &moving);
            let common = [&place[..], &self.common(seen, own, antenna, clock)].concat();
            let reflection = own.reflections + 2 * antenna;
            let air = |sign: f64| {
                let delay = sign * seen.ionosphere;
                [(self.states.factor, delay), (own.ionosphere, delay)]
            };
            let code = [&common[..], &air(1.0), &[(reflection, seen.weight)]].concat();
            let mut phase = [&common[..], &air(-1.0), &[(reflection + 1, seen.weight)]].concat();
            phase.push((own.cycles, 1.0));
            phase.extend(self.states.line(antenna, seen.id.constellation).map(|own| (own, 1.0)));
            let doppler = [&rate[..], &[(clock + 1, 1.0), (own.slow + 1, 1.0)]].concat();
            for (h, std) in [
                (code, self.raw.code_std_m),
                (phase, self.raw.phase_std_m),
                (doppler, self.raw.doppler_std_mps),
            ] {
                self.knowledge.measure(&h, (std * seen.weight).powi(2));
            }
        }
    }

    /// What code and phase have in common beside the ship.
    fn common(
        &self,
        seen: &Seen,
        own: OfSatellite,
        antenna: usize,
        clock: usize,
    ) -> Vec<(usize, f64)> {
        let sine = -seen.towards.z;
        let mut common = vec![(clock, 1.0), (own.slow, 1.0), (self.states.water, 1.0 / sine)];
        common
            .extend(self.states.offset(antenna, seen.id.constellation).map(|offset| (offset, 1.0)));
        common
    }

    /// Adds what is known at an epoch of a segment.
    fn gather(&mut self, t: f64, sums: &mut Sums) {
        let begin = self.states.begin;
        if sums.epochs == 0.0 {
            (0..2).for_each(|axis| self.knowledge.copy(POSITION.at(axis), begin.at(axis)));
        }
        let knowledge = &self.knowledge;
        let both = |of: &dyn Fn(usize) -> Vec<(usize, f64)>| -> f64 {
            (0..2).map(|axis| knowledge.variance(&of(axis))).sum()
        };
        let relative = both(&|axis| vec![(POSITION.at(axis), 1.0), (begin.at(axis), -1.0)]);
        let (sin, cos) = self.track.at(t).attitude().heading.sin_cos();
        let [north, east, down] = [0, 1, 2].map(|axis| ATTITUDE.at(axis));
        let attitude =
            [vec![(down, 1.0)], vec![(north, cos), (east, sin)], vec![(north, -sin), (east, cos)]];
        sums.epochs += 1.0;
        sums.relative += relative;
        for (sum, own) in sums.attitude.iter_mut().zip(&attitude) {
            *sum += knowledge.variance(own);
        }
        let position = both(&|axis| vec![(POSITION.at(axis), 1.0)]);
        sums.end = [position, relative, both(&|axis| vec![(VELOCITY.at(axis), 1.0)])];
    }
}

impl Sums {
    fn limit(self, segment: JudgedSegment) -> SegmentLimit {
        let [position_end, relative_end, velocity_end] = self.end.map(f64::sqrt);
        SegmentLimit {
            segment,
            position_end,
            relative_end,
            relative_rms: (self.relative / self.epochs).sqrt(),
            velocity_end,
            attitude_rms: self.attitude.map(|sum| (sum / self.epochs).sqrt()),
        }
    }
}

/// How a range, or its rate, changes with an error of position, or velocity, from the state `first` on, and with one of attitude, which
/// turns the lever `lever`, north, east, down: C l is off by l x phi.
fn towards(seen: &Seen, first: usize, lever: &Vector3<f64>) -> [(usize, f64); 6] {
    let turned = -(seen.towards.transpose() * cross(lever));
    std::array::from_fn(|index| match index {
        0..3 => (first + index, -seen.towards[index]),
        _ => (ATTITUDE.at(index - 3), turned[index - 3]),
    })
}

/// 1-sigma of orbit, satellite clock and record along the line of sight, m.
fn slow_std(raw: &Raw) -> f64 {
    let sky = &raw.sky;
    (sky.orbit_std_m.powi(2) / 3.0 + sky.clock_std_m.powi(2) + sky.record_step_m.powi(2)).sqrt()
}

/// Frequency of what stands for smooth errors, rad/s: their periods are strewn evenly from half to one and a half times the mean one, of
/// which the mean square of the frequency is 4/3 of that of the mean period.
fn omega(raw: &Raw) -> f64 {
    std::f64::consts::TAU / raw.sky.period_s * (4.0_f64 / 3.0).sqrt()
}

/// Transition and noise of a clock, of orbit and satellite clock, and of the ionosphere.
fn smooth(raw: &Raw, interval: f64) -> [(DMatrix<f64>, DMatrix<f64>); 3] {
    let walks = [raw.clock_bias_walk_m_sqrt_s, raw.clock_drift_walk_mps_sqrt_s];
    let density = DMatrix::from_row_slice(2, 2, &[walks[0].powi(2), 0.0, 0.0, walks[1].powi(2)]);
    let clock = discrete(&DMatrix::from_row_slice(2, 2, &[0.0, 1.0, 0.0, 0.0]), &density, interval);
    let omega = omega(raw);
    let oscillator = |std: f64| {
        let dynamics = [0.0, 1.0, -omega * omega, -2.0 * DAMPING * omega];
        let white = 4.0 * DAMPING * omega.powi(3) * std * std;
        let density = DMatrix::from_row_slice(2, 2, &[0.0, 0.0, 0.0, white]);
        discrete(&DMatrix::from_row_slice(2, 2, &dynamics), &density, interval)
    };
    [clock, oscillator(slow_std(raw)), oscillator(raw.sky.ionosphere_std)]
}

#[cfg(test)]
mod tests;
