//! Short voyages, with checkpoints taken on the way, and engines that go on from them.

use std::sync::Arc;

use insd_base::units::wrap_pi;
use insd_base::{Event, Message, Received, ResumeDoubt, Solution, Span, Time, Truth, Voyage};
use insd_engine::{Engine, EngineConfig, Output};
use insd_simulator::{Scenario, simulate};

/// Solutions per second: that of the truth.
pub(crate) const RATE: f64 = 20.0;

/// What the ship does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Way {
    Steady,
    Turning,
    Moored,
}

/// A voyage of some minutes: the first three are for finding the heading.
pub(crate) fn scenario(way: Way, sea: u8, grade: &str, duration: f64) -> Scenario {
    let leg = |heading: f64, speed: f64, seconds: f64, more: &str| {
        format!(
            "[[route.legs]]\nheading_deg = {heading:.1}\nspeed_kn = {speed:.1}\n\
             duration_s = {seconds:.1}\n{more}\n"
        )
    };
    let (mode, legs) = match way {
        Way::Moored => ("moored", leg(204.0, 0.0, duration, "moored = true")),
        Way::Steady => {
            let end = leg(75.0, 10.0, duration - 180.0, "");
            ("underway", leg(120.0, 10.0, 60.0, "") + &leg(30.0, 10.0, 120.0, "") + &end)
        }
        Way::Turning => {
            let rates = [1.0, 3.0, 2.0, 1.5];
            let turn = |i: u32| {
                let heading = (f64::from(i) * 130.0).rem_euclid(360.0);
                let rate: f64 = rates[i as usize % rates.len()];
                let seconds = 130.0 / rate + 35.0;
                leg(heading, 10.0, seconds, &format!("turn_rate_deg_s = {rate:.1}"))
            };
            ("underway", (0..=(duration / 78.0) as u32).map(turn).collect())
        }
    };
    let reference = if way == Way::Moored { "[reference]\n" } else { "[gnss]\n" };
    let text = format!(
        "name = \"crash\"\ndescription = \"short\"\nmode = \"{mode}\"\n\
         [start]\nlat_deg = 35.0\nlon_deg = 139.0\nheight_m = 20.0\nstated_std_m = 3.0\n\
         {legs}[sea]\nstate = {sea}\nfrom_deg = 160.0\n[imu]\ngrade = \"{grade}\"\n\
         {reference}[truth]\nrate_hz = {RATE}\n"
    );
    Scenario::from_toml(&text).unwrap().with_duration(duration)
}

/// A voyage, its messages in order of receipt, and checkpoints taken on the way.
pub(crate) struct Watched {
    pub(crate) voyage: Voyage,
    pub(crate) messages: Vec<Received>,
    pub(crate) config: EngineConfig,
    /// Message after which it was taken, its time, the bytes.
    pub(crate) kept: Vec<(usize, Time, Vec<u8>)>,
}

/// Sails and keeps a checkpoint every so many seconds from an instant on, s.
pub(crate) fn watch(scenario: &Scenario, seed: u64, from: f64, every: f64) -> Watched {
    let voyage = simulate(scenario, seed);
    let messages = voyage.received();
    let config = EngineConfig::for_voyage(&voyage.header, RATE);
    let mut engine = Engine::new(config.clone());
    let mut kept = Vec::new();
    let mut next = from;
    for (index, received) in messages.iter().enumerate() {
        engine.handle(received);
        while engine.poll_output().is_some() {}
        let time = received.message.time();
        if matches!(received.message, Message::Imu(_)) && time.as_seconds() >= next {
            next += every;
            kept.extend(engine.checkpoint().map(|bytes| (index, time, bytes)));
        }
    }
    Watched { voyage, messages, config, kept }
}

/// What a resumed engine said.
#[derive(Debug, Default)]
pub(crate) struct After {
    pub(crate) solutions: Vec<Solution>,
    pub(crate) events: Vec<Event>,
}

impl Watched {
    /// Goes on from a checkpoint after a gap, for so many seconds of data; the new time line has its
    /// zero where the program started.
    pub(crate) fn resume(
        &self,
        kept: &(usize, Time, Vec<u8>),
        gap: f64,
        seconds: f64,
    ) -> Result<After, ResumeDoubt> {
        self.resume_into(kept, gap, seconds, |received| received)
    }

    /// The same in a world that is not what it was.
    pub(crate) fn resume_into(
        &self,
        (index, time, bytes): &(usize, Time, Vec<u8>),
        gap: f64,
        seconds: f64,
        changed: impl Fn(Received) -> Received,
    ) -> Result<After, ResumeDoubt> {
        let zero = *time + Span::from_seconds(gap);
        let by = Time::START - zero;
        let mut engine = Engine::new(self.config.clone());
        engine.resume(bytes, Time::START, Span::from_seconds(gap))?;
        let mut after = After::default();
        let end = zero + Span::from_seconds(seconds);
        let rest = self.messages.iter().skip(*index + 1);
        for received in rest.filter(|m| m.receipt >= zero).take_while(|m| m.receipt < end) {
            engine.handle(&changed(shifted(received, by)));
            while let Some(output) = engine.poll_output() {
                match output {
                    Output::Solution(s) => {
                        after.solutions.push(Solution { time: s.time - by, ..s });
                    }
                    Output::Event(event) => after.events.push(event),
                    _ => {}
                }
            }
        }
        Ok(after)
    }

    /// The truth at the time of a solution.
    pub(crate) fn truth(&self, solution: &Solution) -> Option<&Truth> {
        let near = |truth: &Truth| (truth.time - solution.time).as_seconds().abs() < 1e-4;
        let truth = &self.voyage.truth;
        let place = truth.partition_point(|t| t.time < solution.time - Span::from_seconds(1e-4));
        truth.get(place).filter(|truth| near(truth))
    }

    /// Errors of roll, pitch and heading over their claims, and the claims, rad.
    pub(crate) fn errors(&self, solution: &Solution) -> Option<[(f64, f64); 3]> {
        let truth = self.truth(solution)?.attitude?;
        let (is, sigma) = (&solution.attitude, &solution.sigma);
        Some([
            (is.roll - truth.roll, sigma.roll),
            (is.pitch - truth.pitch, sigma.pitch),
            (wrap_pi(is.heading - truth.heading), sigma.heading),
        ])
    }
}

fn shifted(received: &Received, by: Span) -> Received {
    let mut moved = received.clone();
    moved.receipt = moved.receipt + by;
    let time = match &mut moved.message {
        Message::Imu(m) => &mut m.time,
        Message::Gnss(m) => &mut m.time,
        Message::Log(m) => &mut m.time,
        Message::Reference(m) => &mut m.time,
        Message::Ranges(m) => &mut Arc::make_mut(m).time,
        Message::Base(m) => &mut Arc::make_mut(m).time,
        Message::Rtk(m) => &mut m.time,
        Message::Compass(m) => &mut Arc::make_mut(m).time,
        Message::Ranging(m) => &mut m.time,
        Message::Camera(m) => &mut Arc::make_mut(m).time,
        Message::Odometry(m) => &mut m.time,
    };
    *time = *time + by;
    moved
}
