//! A ship under way whose bytes go through intake and engine, and what a fault may do to her solution.

use std::sync::OnceLock;

use insd_base::units::wrap_pi;
use insd_base::{
    Arrival, Input, Message, PortId, Solution, Source, Span, Stamp, Time, Voyage, earth,
};
use insd_engine::{Engine, EngineConfig, Output};
use insd_intake::config::IntakeConfig;
use insd_intake::event::Happening;
use insd_intake::{Intake, Intaken};
use insd_tests::feed::{Encoding, FeedConfig, Reception, arrivals, feed};

/// Ports of the sensors.
pub(crate) const IMU: u16 = 0;
pub(crate) const GNSS: u16 = 1;
pub(crate) const LOG: u16 = 2;
pub(crate) const COMPASS: u16 = 3;
/// Length of the voyage, s.
const DURATION: f64 = 150.0;
/// Solutions per second.
const RATE: f64 = 5.0;

/// A ship with what reaches her computer.
#[derive(Clone)]
pub(crate) struct Ship {
    pub(crate) voyage: Voyage,
    pub(crate) feed: FeedConfig,
    pub(crate) reception: Reception,
    pub(crate) arrivals: Vec<Arrival>,
}

/// What came of a passage.
pub(crate) struct Passage {
    pub(crate) solutions: Vec<Solution>,
    /// What happened at the border, s of the voyage, and what the engine noted of the IMU.
    pub(crate) events: Vec<(f64, Happening)>,
    /// Measurements of IMU, receiver, log and reference.
    pub(crate) counts: [usize; 4],
    pub(crate) intake: Intake,
    pub(crate) noted: insd_base::Counts,
}

/// A coaster in a moderate sea with all sensors.
fn voyage() -> Voyage {
    let text = "[gnss]\nrate_hz = 5.0\n[log]\n[reference]\ninterval_s = 1.0\nposition = \"none\"\n\
                heading_std_deg = 0.2";
    let scenario = insd_tests::variant(10, &[("[gnss]", text)]);
    insd_simulator::simulate(&scenario.with_duration(DURATION), 3)
}

impl Ship {
    /// A ship with these encodings, changed before she sails.
    pub(crate) fn new(
        encodings: &[Encoding; 4],
        change: impl Fn(&mut Voyage, &mut FeedConfig),
    ) -> Self {
        let mut voyage = voyage();
        let mut feed_config = FeedConfig::new(&voyage, encodings);
        change(&mut voyage, &mut feed_config);
        let reception = Reception::new(feed_config.sensors[0].calendar.start, 11);
        let arrivals = arrivals(&feed(&voyage, &feed_config), &reception);
        Ship { voyage, feed: feed_config, reception, arrivals }
    }

    /// The usual ship: SBG IMU of 100 Hz, u-blox receiver of 5 Hz, VBW, THS.
    pub(crate) fn usual() -> &'static Ship {
        static SHIP: OnceLock<Ship> = OnceLock::new();
        let encodings = [Encoding::Sbg, Encoding::Ubx, Encoding::Vbw, Encoding::Ths];
        SHIP.get_or_init(|| Ship::new(&encodings, |_, _| {}))
    }

    /// The stamp of an instant of the voyage, s.
    pub(crate) fn at(&self, seconds: f64) -> Stamp {
        self.reception.stamp(Time::from_seconds(seconds))
    }

    /// Instant of the voyage of an arrival, s.
    pub(crate) fn when(&self, arrival: &Arrival) -> f64 {
        (arrival.stamp.monotonic - self.reception.offset).as_seconds()
    }

    /// Whether an arrival is from a port and in a span of time, s.
    pub(crate) fn is_of(&self, arrival: &Arrival, port: u16, (from, to): (f64, f64)) -> bool {
        arrival.port == PortId(port) && (from..to).contains(&self.when(arrival))
    }

    /// Each arrival replaced by others; they are put in order of receipt.
    pub(crate) fn changed(&self, mut change: impl FnMut(&Arrival) -> Vec<Arrival>) -> Self {
        let mut arrivals: Vec<Arrival> = self.arrivals.iter().flat_map(&mut change).collect();
        arrivals.sort_by_key(|arrival| arrival.stamp.monotonic);
        Ship { arrivals, ..self.clone() }
    }

    /// The bytes of a port in a span of time replaced by others.
    pub(crate) fn with_bytes(
        &self,
        port: u16,
        span: (f64, f64),
        mut change: impl FnMut(&[u8]) -> Vec<u8>,
    ) -> Self {
        self.changed(|arrival| match &arrival.input {
            Input::Bytes(bytes) if self.is_of(arrival, port, span) => {
                vec![Arrival { input: Input::Bytes(change(bytes)), ..arrival.clone() }]
            }
            _ => vec![arrival.clone()],
        })
    }

    /// With further arrivals.
    pub(crate) fn with(&self, more: Vec<Arrival>) -> Self {
        let mut arrivals = self.arrivals.clone();
        arrivals.extend(more);
        arrivals.sort_by_key(|arrival| arrival.stamp.monotonic);
        Ship { arrivals, ..self.clone() }
    }

    /// Sails her.
    pub(crate) fn sail(&self) -> Passage {
        self.sail_with(|_| {})
    }

    /// Sails her with another description of her sensors.
    pub(crate) fn sail_with(&self, change: impl Fn(&mut IntakeConfig)) -> Passage {
        let mut intake = self.feed.intake(&self.voyage);
        change(&mut intake);
        assert_eq!(intake.faults(), []);
        let config = EngineConfig::for_voyage(&self.voyage.header, RATE);
        let mut engine = Engine::new(config);
        let mut passage = Passage {
            solutions: Vec::new(),
            events: Vec::new(),
            counts: [0; 4],
            intake: Intake::new(&intake),
            noted: insd_base::Counts::default(),
        };
        for arrival in &self.arrivals {
            passage.intake.handle(arrival);
            while let Some(taken) = passage.intake.poll_output() {
                match taken {
                    Intaken::Watched(_) => {}
                    Intaken::Event(event) => {
                        let when = (event.time - self.reception.offset).as_seconds();
                        passage.events.push((when, event.what));
                    }
                    Intaken::Temperature(..) => {}
                    Intaken::Measured(received) => {
                        passage.counts[kind(received.source)] += 1;
                        let early = matches!(received.message, Message::Imu(_));
                        assert!(early || received.message.time() <= received.receipt);
                        engine.handle(&received);
                        let outputs = std::iter::from_fn(|| engine.poll_output());
                        passage.solutions.extend(outputs.filter_map(|output| match output {
                            Output::Solution(solution) => Some(solution),
                            _ => None,
                        }));
                    }
                }
            }
        }
        passage.noted = engine.counts().clone();
        passage
    }
}

fn kind(source: Source) -> usize {
    match source {
        Source::Imu(_) => 0,
        Source::Gnss(_) => 1,
        Source::Log(_) => 2,
        Source::Reference(_) => 3,
        Source::Base(_) => 4,
        Source::Ranging(_) => 5,
        Source::Camera(_) => 6,
    }
}

/// The usual ship without a fault.
pub(crate) fn usual() -> &'static Passage {
    static PASSAGE: OnceLock<Passage> = OnceLock::new();
    PASSAGE.get_or_init(|| Ship::usual().sail())
}

/// Greatest difference of position, velocity and heading, in sigmas of the one that had the fault.
pub(crate) fn apart(faulty: &Passage, sound: &Passage) -> f64 {
    assert!(sound.solutions.last().unwrap().mode.is_navigating());
    let mut others = sound.solutions.iter();
    let mut worst = 0.0_f64;
    let mut compared = 0;
    for own in &faulty.solutions {
        let Some(other) = others.find(|other| other.time >= own.time) else { break };
        if other.time == own.time {
            worst = worst.max(sigmas_apart(own, other));
            compared += 1;
        }
    }
    assert!(compared as f64 > 0.6 * sound.solutions.len() as f64, "{compared} epochs");
    worst
}

fn sigmas_apart(own: &Solution, other: &Solution) -> f64 {
    let c_ne = earth::c_ne(&own.position);
    let moved = c_ne * (earth::ecef(&own.position).0 - earth::ecef(&other.position).0);
    let position = moved.component_div(&own.sigma.position.0);
    let velocity = (own.velocity.0 - other.velocity.0).component_div(&own.sigma.velocity.0);
    let turned = wrap_pi(own.attitude.heading - other.attitude.heading).abs();
    position.amax().max(velocity.amax()).max(turned / own.sigma.heading)
}

/// Greatest step of the position from one solution to the next beyond what the velocity says, in sigmas.
pub(crate) fn greatest_step(passage: &Passage) -> f64 {
    let steps = passage.solutions.windows(2).map(|pair| {
        let [a, b] = pair else { return 0.0 };
        let dt = (b.time - a.time).as_seconds();
        let c_ne = earth::c_ne(&a.position);
        let moved = c_ne * (earth::ecef(&b.position).0 - earth::ecef(&a.position).0);
        let beyond = moved - (a.velocity.0 + b.velocity.0) * (0.5 * dt);
        beyond.component_div(&a.sigma.position.0.sup(&b.sigma.position.0)).amax()
    });
    steps.fold(0.0, f64::max)
}

impl Passage {
    /// Happenings that are not part of every passage: those of the first seconds are left out.
    pub(crate) fn news(&self) -> Vec<&Happening> {
        self.events.iter().filter(|(when, _)| *when > 10.0).map(|(_, what)| what).collect()
    }

    /// Whether something happened.
    pub(crate) fn has(&self, is: impl Fn(&Happening) -> bool) -> bool {
        self.events.iter().any(|(_, what)| is(what))
    }

    /// What a fault on one port must leave alone: the measurements of the other ports, and a solution
    /// that does not step.
    pub(crate) fn holds_against(&self, sound: &Passage, port: u16) {
        self.loses_nothing_beside(sound, port);
        self.does_not_step(sound);
    }

    /// The other ports have given what they give without the fault.
    pub(crate) fn loses_nothing_beside(&self, sound: &Passage, port: u16) {
        for other in (0..4).filter(|other| *other != usize::from(port)) {
            assert_eq!(self.counts[other], sound.counts[other], "port {other}");
        }
    }

    /// No solution is more than three of its sigmas from that without the fault, nor from the one before.
    pub(crate) fn does_not_step(&self, sound: &Passage) {
        let (apart, step) = (apart(self, sound), greatest_step(self));
        println!("{apart:.3} sigma apart, steps of {step:.3} sigma, {:?}", self.counts);
        println!("  {:?}", self.news());
        assert!(apart < 3.0, "{apart} sigma apart");
        assert!(step < 3.0, "a step of {step} sigma");
    }

    /// UTC at an instant of the voyage, s, minus that by a calendar that is right, s.
    pub(crate) fn utc_error(&self, ship: &Ship, seconds: f64) -> f64 {
        let time = Time::from_seconds(seconds);
        let told = self.intake.utc_at(time + ship.reception.offset).unwrap();
        let gps = told.to_gps().as_nanos();
        let right = ship.reception.system.to_gps().as_nanos() + (time - Time::START).as_nanos();
        Span::from_nanos(gps - right).as_seconds()
    }
}
