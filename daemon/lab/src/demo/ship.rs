//! The simulated ship and the engine that navigates her. Free of clocks: it sails to the time that
//! it is told, so that a picture of it can be made again bit by bit.

use insd_base::{Body, Event, Geodetic, Message, Mode, Received, Solution, Time, Voyage};
use insd_config::VoyageCalendar;
use insd_engine::{Engine, EngineConfig, Output};
use insd_output::docking::DockingConfig;
use insd_output::{Manner, OutputPortConfig, Profile};
use insd_vessel::{OutputPlan, Outputs, Spoken};

use super::alongside;
use super::board::{Board, Phase};
use super::onlooker::{DemoSight, Onlooker};
use super::rejections;
use super::sensors::Sensors;
use super::truth::{TrueTrack, east_north};

/// Solutions per second.
const OUTPUT_RATE: f64 = 10.0;

/// Least time between points of a track, ns.
const TRACK_INTERVAL: i64 = 2_000_000_000;

/// A voyage under way.
pub struct DemoShip {
    messages: std::vec::IntoIter<Received>,
    engine: Engine,
    outputs: Outputs,
    calendar: Option<VoyageCalendar>,
    truth: TrueTrack,
    origin: Option<Geodetic>,
    sensors: Sensors,
    tracked: Time,
    board: Board,
    onlooker: Option<Box<dyn Onlooker>>,
}

/// The port of the demo: everything, marked as simulated where a sentence can be. No ship's equipment
/// listens to it.
fn bridge() -> OutputPortConfig {
    let manner = Manner { simulated: true, unmarked_when_simulated: true, ..Manner::default() };
    let bridge = Profile::named("bridge").map(Profile::port).unwrap_or_default();
    OutputPortConfig { manner, ..bridge }
}

fn outputs(berths: DockingConfig) -> Outputs {
    Outputs::new(OutputPlan {
        ports: vec![bridge()],
        points: vec![Body::default()],
        berths,
        ..OutputPlan::default()
    })
}

impl DemoShip {
    /// A ship at the start of her voyage. `board` carries title, speed and port on.
    #[must_use]
    pub fn new(voyage: Voyage, board: Board) -> Self {
        let origin = voyage.header.initial.or(voyage.truth.first().map(|truth| truth.position));
        DemoShip {
            messages: voyage.received().into_iter(),
            engine: Engine::new(EngineConfig::for_voyage(&voyage.header, OUTPUT_RATE)),
            outputs: outputs(DockingConfig::default()),
            calendar: VoyageCalendar::new(&voyage.header.start_utc),
            origin,
            sensors: Sensors::of(&voyage),
            truth: TrueTrack::new(voyage.truth),
            tracked: Time::from_nanos(-TRACK_INTERVAL),
            board: Board { phase: Phase::Sailing, ..board },
            onlooker: None,
        }
    }

    /// The same with berths to go alongside.
    #[must_use]
    pub fn with_berths(self, berths: DockingConfig) -> Self {
        DemoShip { outputs: outputs(berths), ..self }
    }

    /// The same with somebody who looks on.
    #[must_use]
    pub fn with_onlooker(self, onlooker: Option<Box<dyn Onlooker>>) -> Self {
        DemoShip { onlooker, ..self }
    }

    /// Sails to `until`: all messages received by then go through the engine, and the sentences of
    /// the solutions that come out go to `wire`.
    pub fn advance(&mut self, until: Time, wire: &mut dyn FnMut(&[u8])) {
        while let Some(received) = self.messages.as_slice().first().cloned() {
            if received.receipt > until {
                break;
            }
            self.messages.next();
            self.hear(&received);
            self.engine.handle(&received);
            while let Some(output) = self.engine.poll_output() {
                self.outputs.note(&output);
                self.onlooker.iter_mut().for_each(|own| own.hear(&output));
                self.take(output);
            }
            self.speak(received.receipt, wire);
        }
        if self.messages.as_slice().is_empty() {
            self.board.phase = Phase::Arrived;
        } else {
            self.board.now = until;
        }
        self.settle();
    }

    /// What there is to see now.
    #[must_use]
    pub fn board(&self) -> &Board {
        &self.board
    }

    /// For what the ship herself does not know: pace and port.
    pub fn board_mut(&mut self) -> &mut Board {
        &mut self.board
    }

    fn hear(&mut self, received: &Received) {
        self.board.now = received.receipt;
        self.sensors.hear(received);
        self.outputs.hear(received);
        if let (Message::Gnss(fix), Some(origin)) = (&received.message, &self.origin)
            && let Some(position) = fix.position
        {
            self.board.tracks.gnss.offer(east_north(origin, &position));
        }
    }

    fn speak(&mut self, now: Time, wire: &mut dyn FnMut(&[u8])) {
        let utc = self.calendar.map(|calendar| calendar.utc(now));
        self.outputs.speak(&self.engine, now, utc, |spoken| {
            if let Spoken::Messages(_, messages) = spoken {
                messages.iter().for_each(|message| wire(&message.content.to_bytes()));
            }
        });
    }

    fn take(&mut self, output: Output) {
        match output {
            Output::Event(event) => self.note(&event),
            Output::Innovation(_) | Output::Satellite(_) | Output::Alignment(_) => {}
            Output::Solution(solution) => {
                self.track(&solution);
                if self.board.solution.is_none_or(|last| last.mode != solution.mode) {
                    self.board.mode_since = solution.time;
                }
                self.board.solution = Some(solution);
            }
        }
    }

    fn note(&mut self, event: &Event) {
        if let (Event::ModeChanged { to: Mode::Fault, time, .. }, Some(solution)) =
            (event, &mut self.board.solution)
        {
            // after a fault no solutions come until the next alignment; the last one is void
            solution.mode = Mode::Fault;
            self.board.mode_since = *time;
        }
        self.board.events.add(self.board.now, rejections::event(event));
    }

    fn track(&mut self, solution: &Solution) {
        let due = (solution.time - self.tracked).as_nanos() >= TRACK_INTERVAL;
        if let (true, Some(origin)) = (due, &self.origin) {
            self.tracked = solution.time;
            self.board.tracks.own.offer(east_north(origin, &solution.position));
            if let Some((position, _)) = self.truth.at(solution.time) {
                self.board.tracks.truth.offer(east_north(origin, &position));
            }
        }
    }

    /// Brings the parts of the board up to date that need no message.
    fn settle(&mut self) {
        self.board.utc = self.calendar.and_then(|calendar| calendar.civil(self.board.now));
        self.board.sensors = self.sensors.status(self.board.now, self.engine.counts());
        self.board.counts.clone_from(self.engine.counts());
        let solution = self.board.solution.as_ref();
        self.board.true_error = solution.and_then(|solution| self.truth.error_of(solution));
        let motion = self.engine.motion();
        let desk = self.outputs.station().berths();
        let docking = desk.look(motion.as_ref(), self.board.now);
        self.board.alongside = docking.map(|docking| alongside::line(&docking, desk));
        if let Some(onlooker) = &mut self.onlooker {
            let (now, engine, outputs) = (self.board.now, &self.engine, &self.outputs);
            let utc = self.calendar.map(|calendar| calendar.utc(now));
            onlooker.see(&DemoSight { now, utc, engine, outputs });
        }
    }
}
