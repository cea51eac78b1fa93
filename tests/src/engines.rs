//! A ship with several IMUs and an engine on each: her bytes through the whole pipeline.

use insd_base::units::wrap_pi;
use insd_base::{
    Arrival, Body, ImuSample, Input, LeverArms, PortId, Received, Solution, Stamped, Time, Truth,
    Voyage, earth,
};
use insd_config::Config;
use insd_engine::vote::{Gyros, Record, Testimony, Voice, VoteEvent, Voter};
use insd_engine::{Engine, EngineConfig, Output};
use insd_intake::config::{IntakeConfig, Role};
use insd_output::alerts::Condition;
use insd_output::{MessageKind, OutputPortConfig, Rate};
use insd_simulator::{Scenario, further_imu, simulate};
use insd_vessel::{OutputPlan, Pipeline, Plan, Product, Spare, Spoken, loosened};
use insd_wire::nmea::AlertState;
use nalgebra::Vector3;

use crate::feed::{Encoding, FeedConfig, LineSending, Reception, arrivals, feed};

/// Port of a receiver and a log; the first IMU has port 0, the others those from 3 on.
pub const GNSS: usize = 1;
/// See [`GNSS`].
pub const LOG: usize = 2;

/// A ship with so many IMUs.
#[derive(Clone, Debug)]
pub struct Fleet {
    /// Her voyage with her first IMU.
    pub voyage: Voyage,
    /// The samples of each IMU.
    pub imus: Vec<Vec<Stamped<ImuSample>>>,
    /// Where each sits from the first, body axes, m.
    pub offsets: Vec<Body>,
    /// Which IMU each engine has, by its index.
    pub engines: Vec<usize>,
}

/// What the ports are told at an epoch, beside the truth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Told {
    /// When, s of the voyage.
    pub at: f64,
    /// What is known of the first IMU.
    pub solution: Option<Solution>,
    /// Error of its heading, rad.
    pub heading_error: Option<f64>,
    /// Error of its horizontal position, m.
    pub position_error: Option<f64>,
    /// Whether the alert is up that engines differ.
    pub alert: bool,
    /// Whether the one is that an IMU is found wrong.
    pub doubt: bool,
}

/// What came of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Log {
    /// What the voter found, and when, s of the voyage.
    pub votes: Vec<(f64, VoteEvent)>,
    /// What the ports were told, ten times a second.
    pub told: Vec<Told>,
    /// Solutions of the engine in use.
    pub solutions: Vec<Solution>,
    /// What was sent, byte by byte.
    pub sent: Vec<u8>,
    /// Indices of the engines in use, in their order.
    pub used: Vec<usize>,
}

impl Fleet {
    /// A ship with IMUs of the scenario's kind at some offsets from the first, m, and an engine on each.
    #[must_use]
    pub fn new(scenario: &Scenario, seed: u64, offsets: &[[f64; 3]]) -> Self {
        let voyage = simulate(scenario, seed);
        let offsets = offsets.iter().map(|[f, s, d]| Body::new(*f, *s, *d));
        let offsets: Vec<Body> = std::iter::once(Body::default()).chain(offsets).collect();
        let further = offsets.iter().zip(0..).skip(1);
        let further = further.map(|(offset, number)| further_imu(scenario, seed, number, offset));
        let imus = std::iter::once(voyage.imu.clone()).chain(further).collect();
        let engines = (0..offsets.len()).collect();
        Fleet { voyage, imus, offsets, engines }
    }

    /// The same with something done to the samples of an IMU from an instant on, s.
    #[must_use]
    pub fn with_fault(
        mut self,
        imu: usize,
        from: f64,
        fault: impl Fn(f64, &mut ImuSample),
    ) -> Self {
        for sample in &mut self.imus[imu] {
            let seconds = sample.message.time.as_seconds();
            if seconds >= from {
                fault(seconds - from, &mut sample.message);
            }
        }
        self
    }

    /// The same voyage up to an instant, s.
    #[must_use]
    pub fn until(mut self, seconds: f64) -> Self {
        let end = Time::from_seconds(seconds);
        self.imus.iter_mut().for_each(|imu| imu.retain(|sample| sample.message.time <= end));
        self.voyage.gnss.retain(|fix| fix.message.time <= end);
        self.voyage.log.retain(|log| log.message.time <= end);
        self
    }

    /// What each engine beside the first is told.
    fn spares(&self, feeds: &FeedConfig) -> Vec<Spare> {
        let first = self.engine();
        let spare = |(index, imu): (usize, usize)| {
            let offset = self.offsets[imu];
            let from_own = |point: &Body| Body(point.0 - offset.0);
            let (gnss, log) = (from_own(&first.lever_arms.gnss), from_own(&first.lever_arms.log));
            let points = std::iter::once(Body::default()).chain(first.points.iter().map(from_own));
            Spare {
                name: format!("spare {index}"),
                intake: self.intake(feeds, imu),
                engine: EngineConfig {
                    lever_arms: LeverArms { gnss, log },
                    points: points.collect(),
                    ..first.clone()
                },
                offset,
                voice: self.voice(imu),
            }
        };
        self.engines.iter().copied().enumerate().skip(1).map(spare).collect()
    }

    /// Sails her without bytes: the engines are handed what the sensors measured. Calls with each look of
    /// the voter, ten a second, with what the engines said and what it found.
    pub fn watch(&self, mut look: impl FnMut(f64, &[Testimony], &[VoteEvent])) {
        let voices = self.engines.iter().map(|imu| self.voice(*imu));
        let mut voter = Voter::new(voices.collect());
        let mut crews: Vec<Crew> = self.engines.iter().map(|imu| self.crew(*imu)).collect();
        let end = self.voyage.imu.last().map_or(0.0, |last| last.message.time.as_seconds());
        for tenth in 1..(end * 10.0) as u32 {
            let seconds = f64::from(tenth) / 10.0;
            let now = Time::from_seconds(seconds);
            let said: Vec<Testimony> = crews.iter_mut().map(|crew| crew.sail_to(now)).collect();
            let found = voter.look(now, &said);
            look(seconds, &said, &found);
        }
    }

    fn voice(&self, imu: usize) -> Voice {
        Voice { imu, mounting_std: 0.0, distance: self.offsets[imu].0.norm() }
    }

    fn crew(&self, imu: usize) -> Crew {
        let mut voyage = self.voyage.clone();
        voyage.imu.clone_from(&self.imus[imu]);
        let offset = self.offsets[imu];
        let mut config = EngineConfig::for_voyage(&voyage.header, 1.0);
        for arm in [&mut config.lever_arms.gnss, &mut config.lever_arms.log] {
            arm.0 -= offset.0;
        }
        Crew {
            messages: voyage.received(),
            next: 0,
            engine: Engine::new(config),
            record: Record::default(),
            gyros: Gyros::default(),
            home: Body(-offset.0),
        }
    }

    fn engine(&self) -> EngineConfig {
        let points = vec![Body::default()];
        EngineConfig { points, ..EngineConfig::for_voyage(&self.voyage.header, 10.0) }
    }

    /// All plugs, but of the IMUs only this one.
    fn intake(&self, feeds: &FeedConfig, imu: usize) -> IntakeConfig {
        let mut intake = feeds.intake(&self.voyage);
        let own = format!("sensor {}", port(imu));
        intake.sensors.retain(|sensor| sensor.kind.role() != Role::Imu || sensor.name == own);
        intake
    }

    fn feeds(&self) -> FeedConfig {
        let further = self.imus.iter().skip(1).map(|_| Encoding::Sbg);
        let all = [Encoding::Sbg, Encoding::Ubx, Encoding::Vbw].into_iter().chain(further);
        FeedConfig::new(&self.voyage, &all.collect::<Vec<_>>())
    }

    /// The arrivals of her voyage, and what they are told against.
    #[must_use]
    pub fn arrivals(&self) -> (Vec<Arrival>, Reception) {
        let feeds = self.feeds();
        let reception = Reception::new(feeds.sensors[0].calendar.start, 11);
        let mut voyage = self.voyage.clone();
        let mut all: Vec<LineSending> = Vec::new();
        for (imu, samples) in self.imus.iter().enumerate() {
            voyage.imu.clone_from(samples);
            // of each voyage what its own IMU sends, and of the first all the rest
            let own = |sending: &LineSending| {
                let is_imu = sending.port != GNSS && sending.port != LOG;
                sending.port == port(imu) || (imu == 0 && !is_imu)
            };
            all.extend(feed(&voyage, &feeds).into_iter().filter(own));
        }
        all.sort_by_key(|sending| sending.at);
        (arrivals(&all, &reception), reception)
    }

    /// A pipeline for her.
    #[must_use]
    pub fn pipeline(&self) -> Pipeline<Config> {
        Pipeline::new(self.plan(), Self::reader())
    }

    /// Who reads her orders.
    #[must_use]
    pub fn reader() -> Config {
        Config::of_text(include_str!("../../systemd/examples/minimal.toml")).unwrap()
    }

    /// What her pipeline is told.
    #[must_use]
    pub fn plan(&self) -> Plan {
        let rate = Rate::from_hertz(10.0);
        let kinds = ["HDT", "GGA", "ALF"];
        let messages = kinds.map(|kind| (MessageKind::named(kind).unwrap(), rate)).to_vec();
        let bridge = OutputPortConfig { messages, ..OutputPortConfig::default() };
        let (ports, points) = (vec![bridge], vec![Body::default()]);
        let outputs = OutputPlan { ports, points, groups: Some(rate), ..OutputPlan::default() };
        let feeds = self.feeds();
        let imu = Some(format!("sensor {}", port(self.engines[0])));
        let intake = IntakeConfig { imu, ..feeds.intake(&self.voyage) };
        let (engine, spares) = (self.engine(), self.spares(&feeds));
        Plan { intake, engine, spares, outputs, watched: Vec::new() }
    }

    /// Sails her.
    #[must_use]
    pub fn sail(&self) -> Log {
        let (arrivals, reception) = self.arrivals();
        self.sail_on(&arrivals, &reception)
    }

    /// Sails her on what arrives.
    #[must_use]
    pub fn sail_on(&self, arrivals: &[Arrival], reception: &Reception) -> Log {
        self.record(arrivals, reception).0
    }

    /// Sails her, and gives all that her pipeline took: what arrives, and the ticks of the outputs.
    #[must_use]
    pub fn record(&self, arrivals: &[Arrival], reception: &Reception) -> (Log, Vec<Arrival>) {
        let mut pipeline = self.pipeline();
        let (mut log, mut taken) = (Log::default(), Vec::new());
        for arrival in arrivals {
            self.hand(&mut pipeline, arrival, reception, &mut log);
            taken.push(arrival.clone());
            let now = arrival.stamp;
            if pipeline.wake_up(now.monotonic).is_some_and(|due| due.at <= now.monotonic) {
                let tick = Arrival { stamp: now, port: PortId(u16::MAX), input: Input::Tick };
                self.hand(&mut pipeline, &tick, reception, &mut log);
                taken.push(tick);
            }
        }
        (log, taken)
    }

    /// Sails her again on what a pipeline took.
    #[must_use]
    pub fn replay(&self, taken: &[Arrival], reception: &Reception) -> Log {
        let (mut pipeline, mut log) = (self.pipeline(), Log::default());
        for arrival in taken {
            self.hand(&mut pipeline, arrival, reception, &mut log);
        }
        log
    }

    fn hand(
        &self,
        pipeline: &mut Pipeline<Config>,
        arrival: &Arrival,
        reception: &Reception,
        log: &mut Log,
    ) {
        let when = |time: Time| (time - reception.offset).as_seconds();
        let mut epochs = Vec::new();
        pipeline.handle(arrival, |product| match product {
            Product::Vote(vote) => log.votes.push((when(arrival.stamp.monotonic), vote.event)),
            Product::Engine(Output::Solution(solution)) => log.solutions.push(solution),
            Product::Spoken(Spoken::Epochs(own)) => epochs.extend(own.first().copied()),
            Product::Spoken(Spoken::Messages(_, messages)) => {
                log.sent.extend(messages.iter().flat_map(|message| message.content.to_bytes()));
            }
            _ => {}
        });
        let used = pipeline.engines().iter().position(|own| own.chosen).unwrap();
        if log.used.last() != Some(&used) {
            log.used.push(used);
        }
        let alerts = pipeline.outputs().station().alerts();
        let is_up = |condition| {
            !matches!(alerts.state(condition), AlertState::Normal | AlertState::Rectified)
        };
        let alert = is_up(Condition::EnginesDiffer);
        let doubt = is_up(Condition::MountingDoubt) || is_up(Condition::ImuDoubt);
        log.told.extend(epochs.into_iter().map(|epoch| {
            let at = when(epoch.time);
            let both = epoch.solution.zip(truth_at(&self.voyage.truth, at));
            Told {
                at,
                solution: epoch.solution,
                heading_error: both
                    .map(|(own, (heading, _))| wrap_pi(own.attitude.heading - heading)),
                position_error: both.map(|(own, (_, place))| {
                    let apart = earth::ecef(&own.position).0 - place;
                    (earth::c_ne(&own.position) * apart).xy().norm()
                }),
                alert,
                doubt,
            }
        }));
    }
}

/// An engine with what it is still to be told.
struct Crew {
    messages: Vec<Received>,
    next: usize,
    engine: Engine,
    record: Record,
    gyros: Gyros,
    home: Body,
}

impl Crew {
    fn sail_to(&mut self, now: Time) -> Testimony {
        while let Some(received) = self.messages.get(self.next).filter(|own| own.receipt <= now) {
            self.next += 1;
            self.gyros.hear(&received.message);
            self.engine.handle(&loosened(received, &self.home));
            while let Some(output) = self.engine.poll_output() {
                self.record.hear(&output);
            }
        }
        let motion = self.engine.motion().map(|motion| motion.at_point(&self.home));
        let (refused, turned) = (self.record.refused(now), self.gyros.take());
        Testimony { motion, imu_valid: true, refused, turned, odds: None }
    }
}

/// Port of an IMU.
fn port(imu: usize) -> usize {
    if imu == 0 { 0 } else { LOG + imu }
}

/// True heading, rad, and place, ECEF, m, between the rows of the truth.
#[must_use]
pub fn truth_at(truth: &[Truth], seconds: f64) -> Option<(f64, Vector3<f64>)> {
    let next = truth.partition_point(|row| row.time.as_seconds() <= seconds);
    let (one, other) = (truth.get(next.checked_sub(1)?)?, truth.get(next)?);
    let (first, second) = (one.attitude?.heading, other.attitude?.heading);
    let share = (seconds - one.time.as_seconds()) / (other.time - one.time).as_seconds();
    let (from, to) = (earth::ecef(&one.position).0, earth::ecef(&other.position).0);
    Some((first + wrap_pi(second - first) * share, from + (to - from) * share))
}
