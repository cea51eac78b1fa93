//! A ship with two receivers on a voyage: what she makes of them.

use insd_base::{
    Event, GnssFix, Integrity, Message, Party, Received, ReceiverChange, Solution, Source, Span,
    Stamped, Time, Truth, Voyage, earth,
};
use insd_engine::{Engine, EngineConfig, Output};
use insd_simulator::lies::{Case, GnssLie, Grade, Lie, Suite, Told, Window, case, catalogue};
use nalgebra::Vector2;

/// After so long without a valid fix the intake leaves a receiver, s.
const PATIENCE: f64 = 2.0;

/// Receivers that go with the voyages: keys of a scenario.
pub(crate) const SINGLE_POINT: &str = "rate_hz = 5.0\nlever_arm_m = [-25.0, 4.0, -14.0]\n\
    position = { white = [0.5, 0.5, 0.9], correlated = [1.5, 1.5, 2.5], correlation_time_s = 300.0 }\n";
pub(crate) const RTK: &str = "grade = \"rtk\"\nlever_arm_m = [12.0, -3.0, -20.0]\n";

/// A voyage with honest sensors, and a second receiver.
#[derive(Clone)]
pub(crate) struct Ship {
    pub(crate) case: Case,
    pub(crate) voyage: Voyage,
    pub(crate) spare: Vec<Stamped<GnssFix>>,
}

/// Once a second.
#[derive(Debug, PartialEq)]
pub(crate) struct Row {
    /// s.
    pub(crate) time: f64,
    /// Horizontal error of the position, m.
    pub(crate) off: f64,
    /// The same, north and east.
    pub(crate) error: Vector2<f64>,
    pub(crate) integrity: Integrity,
    pub(crate) excluded: Vec<&'static str>,
}

/// All of it.
pub(crate) struct Sailed {
    pub(crate) rows: Vec<Row>,
    pub(crate) changes: Vec<(f64, ReceiverChange)>,
    pub(crate) verdicts: Vec<String>,
}

impl Ship {
    pub(crate) fn new(grade: Grade, suite: Suite, seed: u64, spare: &str) -> Self {
        let case = case(&catalogue()[0], grade, suite, seed);
        let voyage = case.honest().unwrap();
        let spare = case.receiver(spare, 1).unwrap();
        Ship { case, voyage, spare }
    }

    /// With another receiver in the first place.
    pub(crate) fn with_first(mut self, gnss: &str) -> Self {
        self.voyage.gnss = self.case.receiver(gnss, 2).unwrap();
        self
    }

    /// What reaches the engine, as the intake ranks it.
    pub(crate) fn received(&self) -> Vec<Received> {
        let mut all = self.voyage.received();
        let mut heard: Option<Time> = None;
        let mut first = self.voyage.gnss.iter().map(|fix| fix.message.time).peekable();
        for fix in &self.spare {
            let now = fix.message.time;
            while let Some(time) = first.next_if(|time| *time <= now) {
                heard = Some(time);
            }
            let is_silent = heard.is_none_or(|last| (now - last).as_seconds() > PATIENCE);
            let message = Message::Gnss(GnssFix { rank: u8::from(!is_silent), ..fix.message });
            let receipt = fix.arrival.unwrap_or(now);
            all.push(Received { receipt, source: Source::Gnss(1), message });
        }
        all.sort_by_key(|received| received.receipt);
        all
    }

    /// With a lie of the first receiver.
    pub(crate) fn with_first_spoilt(mut self, lie: GnssLie, window: Window) -> Self {
        spoil(&mut self.voyage, lie, window);
        self
    }

    /// With a lie of the spare.
    pub(crate) fn with_spare_spoilt(mut self, lie: GnssLie, window: Window) -> Self {
        let mut other = self.voyage.clone();
        other.gnss = self.spare;
        spoil(&mut other, lie, window);
        self.spare = other.gnss;
        self
    }

    /// With a first receiver that says nothing for a while.
    pub(crate) fn without_first(mut self, window: Window) -> Self {
        self.voyage.gnss.retain(|fix| !window.holds(fix.message.time));
        self
    }

    /// With receivers of which every fix comes late, s.
    pub(crate) fn arriving_late(mut self, by: f64) -> Self {
        for fix in self.voyage.gnss.iter_mut().chain(&mut self.spare) {
            fix.arrival = Some(fix.message.time + Span::from_seconds(by));
        }
        self
    }
}

fn spoil(voyage: &mut Voyage, lie: GnssLie, window: Window) {
    Told { lie: Lie::Gnss(lie), window }.spoil_by(voyage, 3);
}

/// Sails a ship to the end of her voyage.
pub(crate) fn sail(ship: &Ship) -> Sailed {
    let mut sailed = Sailed { rows: Vec::new(), changes: Vec::new(), verdicts: Vec::new() };
    let mut engine = Engine::new(EngineConfig::for_voyage(&ship.voyage.header, 1.0));
    for received in ship.received() {
        engine.handle(&received);
        while let Some(output) = engine.poll_output() {
            match output {
                Output::Solution(solution) => {
                    let at = ship.voyage.truth.binary_search_by_key(&solution.time, |t| t.time);
                    let truth = at.ok().map(|at| &ship.voyage.truth[at]);
                    sailed.rows.extend(truth.map(|truth| row(&solution, truth)));
                }
                Output::Event(Event::ReceiverUsed { time, change }) => {
                    sailed.changes.push((time.as_seconds(), change));
                }
                Output::Event(Event::Judged { time, stands }) => {
                    let time = time.as_seconds();
                    sailed.verdicts.push(format!("{time:.0} s: {stands}"));
                }
                _ => {}
            }
        }
    }
    sailed
}

fn error(solution: &Solution, truth: &Truth) -> Vector2<f64> {
    let apart = earth::ecef(&solution.position).0 - earth::ecef(&truth.position).0;
    (earth::c_ne(&truth.position) * apart).xy()
}

/// Horizontal error of a position, m.
pub(crate) fn apart(solution: &Solution, truth: &Truth) -> f64 {
    error(solution, truth).norm()
}

fn row(solution: &Solution, truth: &Truth) -> Row {
    let error = error(solution, truth);
    Row {
        time: solution.time.as_seconds(),
        off: error.norm(),
        error,
        integrity: solution.judgement.integrity,
        excluded: solution.judgement.excluded.iter().map(Party::as_str).collect(),
    }
}

impl Sailed {
    pub(crate) fn since(&self, from: f64) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(move |row| row.time >= from)
    }

    /// The greatest error of the position from an instant on, m.
    pub(crate) fn worst(&self, from: f64) -> f64 {
        self.since(from).map(|row| row.off).fold(0.0, f64::max)
    }

    /// Root of the mean square of the error of the position from an instant on, m.
    pub(crate) fn rms(&self, from: f64) -> f64 {
        let squares: Vec<f64> = self.since(from).map(|row| row.off * row.off).collect();
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    }

    /// The most by which the error of the position changes within a second, from an instant on, m.
    pub(crate) fn greatest_step(&self, from: f64) -> f64 {
        let rows: Vec<&Row> = self.since(from).collect();
        let steps = rows.windows(2).map(|two| (two[1].error - two[0].error).norm());
        steps.fold(0.0, f64::max)
    }

    /// When somebody is named for the first time, s.
    pub(crate) fn named(&self, word: &str) -> Option<f64> {
        self.rows.iter().find(|row| row.excluded.contains(&word)).map(|row| row.time)
    }

    /// Seconds in which nobody says who is wrong though somebody is.
    pub(crate) fn in_doubt(&self) -> usize {
        self.rows.iter().filter(|row| row.integrity == Integrity::Contradiction).count()
    }

    /// Everybody who is ever named.
    pub(crate) fn all_named(&self) -> Vec<&'static str> {
        let mut all: Vec<_> = self.rows.iter().flat_map(|row| row.excluded.clone()).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    pub(crate) fn summary(&self, from: f64) -> String {
        let changes: Vec<String> =
            self.changes.iter().map(|(at, change)| format!("{at:.0} s {change}")).collect();
        format!(
            "worst {:.1} m rms {:.2} m, worst from +60 s {:.1} m, doubt {} s, named {:?}; {changes:?}; {:?}",
            self.worst(from),
            self.rms(from),
            self.worst(from + 60.0),
            self.in_doubt(),
            self.all_named(),
            self.verdicts
        )
    }
}
