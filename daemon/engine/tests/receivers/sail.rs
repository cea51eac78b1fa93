//! A ship with two receivers on a voyage: what she makes of them.

use insd_base::{
    Event, GnssFix, Integrity, Message, Party, Received, ReceiverChange, Source, Stamped, Time,
    Truth, Voyage, earth,
};
use insd_engine::{Engine, EngineConfig, Output};
use insd_simulator::lies::{Case, Grade, Suite, case, catalogue};

/// After so long without a valid fix the intake leaves a receiver, s.
const PATIENCE: f64 = 2.0;

/// Receivers that go with the voyages: keys of a scenario.
pub const SINGLE_POINT: &str = "rate_hz = 5.0\nlever_arm_m = [-25.0, 4.0, -14.0]\n\
    position = { white = [0.5, 0.5, 0.9], correlated = [1.5, 1.5, 2.5], correlation_time_s = 300.0 }\n";
pub const RTK: &str = "grade = \"rtk\"\nlever_arm_m = [12.0, -3.0, -20.0]\n";

/// A voyage with honest sensors, and a second receiver.
pub struct Ship {
    pub case: Case,
    pub voyage: Voyage,
    pub spare: Vec<Stamped<GnssFix>>,
}

/// Once a second.
#[derive(Debug)]
pub struct Row {
    /// s.
    pub time: f64,
    /// Horizontal error of the position, m, and its claimed 1-sigma.
    pub off: f64,
    pub sigma: f64,
    pub integrity: Integrity,
    pub excluded: Vec<&'static str>,
}

/// All of it.
pub struct Sailed {
    pub rows: Vec<Row>,
    pub changes: Vec<(f64, ReceiverChange)>,
    pub verdicts: Vec<String>,
}

impl Ship {
    pub fn new(grade: Grade, suite: Suite, seed: u64, spare: &str) -> Self {
        let case = case(&catalogue()[0], grade, suite, seed);
        let voyage = case.honest().unwrap();
        let spare = case.receiver(spare, 1).unwrap();
        Ship { case, voyage, spare }
    }

    /// With another receiver in the first place.
    pub fn with_first(mut self, gnss: &str) -> Self {
        self.voyage.gnss = self.case.receiver(gnss, 2).unwrap();
        self
    }

    /// What reaches the engine, as the intake ranks it.
    pub fn received(&self) -> Vec<Received> {
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

    pub fn sail(&self) -> Sailed {
        let mut sailed = Sailed { rows: Vec::new(), changes: Vec::new(), verdicts: Vec::new() };
        let mut engine = Engine::new(EngineConfig::for_voyage(&self.voyage.header, 1.0));
        for received in self.received() {
            engine.handle(&received);
            while let Some(output) = engine.poll_output() {
                match output {
                    Output::Solution(solution) => {
                        if std::env::var_os("TRACE").is_some() {
                            let t = solution.time.as_seconds();
                            if t > 1530.0 && t < 1700.0 {
                                println!(
                                    "{t:.0} {:?} {}",
                                    solution.judgement,
                                    engine
                                        .judge()
                                        .map(insd_nav::judge::Judge::evidence)
                                        .unwrap_or_default()
                                );
                            }
                        }
                        let at = self.voyage.truth.binary_search_by_key(&solution.time, |t| t.time);
                        let truth = at.ok().map(|at| &self.voyage.truth[at]);
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
}

fn row(solution: &insd_base::Solution, truth: &Truth) -> Row {
    let apart = earth::ecef(&solution.position).0 - earth::ecef(&truth.position).0;
    Row {
        time: solution.time.as_seconds(),
        off: (earth::c_ne(&truth.position) * apart).xy().norm(),
        sigma: solution.sigma.position.0.xy().norm(),
        integrity: solution.judgement.integrity,
        excluded: solution.judgement.excluded.iter().map(Party::as_str).collect(),
    }
}

impl Sailed {
    pub fn since(&self, from: f64) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(move |row| row.time >= from)
    }

    /// The greatest error of the position from an instant on, m.
    pub fn worst(&self, from: f64) -> f64 {
        self.since(from).map(|row| row.off).fold(0.0, f64::max)
    }

    /// Root of the mean square of the error of the position from an instant on, m.
    pub fn rms(&self, from: f64) -> f64 {
        let squares: Vec<f64> = self.since(from).map(|row| row.off * row.off).collect();
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    }

    /// When somebody is named for the first time, s.
    pub fn named(&self, word: &str) -> Option<f64> {
        self.rows.iter().find(|row| row.excluded.contains(&word)).map(|row| row.time)
    }

    /// Seconds in which nobody says who is wrong though somebody is.
    pub fn in_doubt(&self) -> usize {
        self.rows.iter().filter(|row| row.integrity == Integrity::Contradiction).count()
    }

    /// Everybody who is ever named.
    pub fn all_named(&self) -> Vec<&'static str> {
        let mut all: Vec<_> = self.rows.iter().flat_map(|row| row.excluded.clone()).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    pub fn summary(&self, from: f64) -> String {
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
