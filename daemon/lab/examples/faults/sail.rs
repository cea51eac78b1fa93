//! A voyage as rows: how far off she was, what she claimed, and whom she named.

use insd_base::{Event, GnssFix, Integrity, Mode, Party, Stamped, Truth, Voyage, earth};
use insd_engine::{Engine, EngineConfig, Output};
use insd_nav::judge::Judge;

/// Once a second.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    /// s.
    pub(crate) time: f64,
    /// Horizontal error, m.
    pub(crate) off: f64,
    /// Its protection level, m.
    pub(crate) level: f64,
    /// Error of the heading, and its claimed 1-sigma, rad.
    pub(crate) heading: (f64, f64),
    /// Whether it is told as a solution.
    pub(crate) told: bool,
    /// How far off the receiver's lie is, m.
    pub(crate) lie: f64,
    /// Whom she names.
    pub(crate) excluded: Vec<&'static str>,
    /// Distance run, m.
    pub(crate) run: f64,
}

/// Sails a voyage; `honest` is the same without lies.
pub(crate) fn sail(voyage: &Voyage, honest: &Voyage) -> Vec<Row> {
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, 1.0));
    let mut rows: Vec<Row> = Vec::new();
    let mut truth = voyage.truth.iter().peekable();
    let mut lies = Lies::new(&voyage.gnss, &honest.gnss);
    let mut last = None;
    for received in voyage.received() {
        engine.handle(&received);
        while let Some(output) = engine.poll_output() {
            trace_event(&output);
            let Output::Solution(solution) = output else { continue };
            while truth.next_if(|truth| truth.time < solution.time).is_some() {}
            let Some(truth) = truth.peek().filter(|row| row.time == solution.time) else {
                continue;
            };
            let run = run_since(&mut last, truth) + rows.last().map_or(0.0, |row| row.run);
            let excluded: Vec<&'static str> =
                solution.judgement.excluded.iter().map(Party::as_str).collect();
            let lie = lies.at(solution.time.as_seconds());
            rows.push(Row { run, lie, excluded, ..row(&solution, truth) });
            if let Some(row) = rows.last() {
                trace(row, &engine);
            }
        }
    }
    rows
}

/// Whether every second is told.
fn is_traced() -> bool {
    std::env::var_os("TRACE").is_some()
}

fn trace(row: &Row, engine: &Engine) {
    if is_traced() {
        let (off, sigma) = row.heading;
        let evidence = engine.judge().map(Judge::evidence).unwrap_or_default();
        println!(
            "{:.0} s off {:.1} m level {:.1} m heading {:.2} of {:.2} deg {:?} {evidence}",
            row.time,
            row.off,
            row.level,
            off.to_degrees(),
            sigma.to_degrees(),
            row.excluded
        );
    }
}

fn trace_event(output: &Output) {
    if let Output::Event(event) = output
        && is_traced()
        && !matches!(event, Event::Rejected { .. })
    {
        println!("{event:?}");
    }
}

fn run_since(last: &mut Option<Truth>, now: &Truth) -> f64 {
    let before = last.replace(*now).unwrap_or(*now);
    (earth::ecef(&now.position).0 - earth::ecef(&before.position).0).norm()
}

fn row(solution: &insd_base::Solution, truth: &Truth) -> Row {
    let apart = earth::ecef(&solution.position).0 - earth::ecef(&truth.position).0;
    let off = (earth::c_ne(&truth.position) * apart).xy().norm();
    let true_heading = truth.attitude.map_or(0.0, |attitude| attitude.heading);
    let heading = insd_base::units::wrap_pi(solution.attitude.heading - true_heading).abs();
    Row {
        time: solution.time.as_seconds(),
        off,
        level: solution.protection().horizontal,
        heading: (heading, solution.sigma.heading),
        told: !matches!(solution.mode, Mode::Fault | Mode::Standby | Mode::CoarseAlignment)
            && solution.judgement.integrity != Integrity::Contradiction,
        lie: 0.0,
        excluded: Vec::new(),
        run: 0.0,
    }
}

/// How far the fixes of one voyage are from those of another.
struct Lies {
    off: Vec<(f64, f64)>,
    next: usize,
}

impl Lies {
    fn new(told: &[Stamped<GnssFix>], honest: &[Stamped<GnssFix>]) -> Self {
        let apart = |fix: &Stamped<GnssFix>| {
            let after = honest.partition_point(|own| own.message.time < fix.message.time);
            let own = honest.get(after)?.message.position?;
            let apart = earth::ecef(&fix.message.position?).0 - earth::ecef(&own).0;
            Some((fix.message.time.as_seconds(), apart.norm()))
        };
        Lies { off: told.iter().filter_map(apart).collect(), next: 0 }
    }

    /// The greater one of those about an instant.
    fn at(&mut self, time: f64) -> f64 {
        while self.off.get(self.next).is_some_and(|(at, _)| *at <= time) {
            self.next += 1;
        }
        let before = self.next.checked_sub(1).and_then(|last| self.off.get(last));
        let about = [before, self.off.get(self.next)];
        about.into_iter().flatten().map(|(_, off)| *off).fold(0.0, f64::max)
    }
}
