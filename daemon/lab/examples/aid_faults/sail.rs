//! A voyage through the engine, second by second, and what it comes to.

use insd_base::units::{DEG, wrap_pi};
use insd_base::{Integrity, Mode, Party, Received, Solution, Time, Truth, Voyage, earth};
use insd_engine::{Engine, EngineConfig, Output};
use insd_nav::judge::Judge;
use serde::{Deserialize, Serialize};

/// What is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum What {
    Heading,
    /// The place, across a quay that runs east.
    North,
}

/// One of them.
pub(crate) struct Case {
    pub(crate) voyage: Voyage,
    pub(crate) config: EngineConfig,
    pub(crate) messages: Vec<Received>,
    pub(crate) what: What,
    /// Who lies, if anybody, and since when, s.
    pub(crate) liar: Option<Party>,
    pub(crate) since: f64,
}

/// What it came to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Score {
    /// When it was told that somebody lies, or who, after it began, s.
    told: Option<f64>,
    named: Option<f64>,
    /// For how long somebody else was named, s.
    innocent: f64,
    /// Greatest error, and over its claim, since then.
    worst: f64,
    claims: f64,
}

/// Head of the table.
pub(crate) const HEAD: &str = "\
| kind | seeds | told | named | told after s, middle | latest | somebody else named, s | worst error | worst error over claim, sigmas |
|---|---|---|---|---|---|---|---|---|";

pub(crate) fn sail(case: &Case) -> Score {
    let mut engine = Engine::new(case.config.clone());
    let mut score = Score::default();
    let mut truth = case.voyage.truth.iter().peekable();
    for received in &case.messages {
        engine.handle(received);
        while let Some(output) = engine.poll_output() {
            trace_event(&output);
            let Output::Solution(solution) = output else { continue };
            while truth.next_if(|truth| truth.time < solution.time).is_some() {}
            let Some(truth) = truth.peek().filter(|row| row.time == solution.time) else {
                continue;
            };
            score.enter(case, &solution, truth);
            trace(case, &solution, truth, &engine);
        }
    }
    score
}

fn error(what: What, solution: &Solution, truth: &Truth) -> (f64, f64) {
    if what == What::Heading {
        let own = truth.attitude.map_or(0.0, |own| own.heading);
        let off = wrap_pi(solution.attitude.heading - own);
        return (off.abs() / DEG, solution.sigma.heading / DEG);
    }
    let apart = earth::ecef(&solution.position).0 - earth::ecef(&truth.position).0;
    let off = (earth::c_ne(&truth.position) * apart).x;
    (off.abs(), solution.sigma.position.0.x)
}

impl Score {
    fn enter(&mut self, case: &Case, solution: &Solution, truth: &Truth) {
        let own = solution.time.as_seconds() - case.since;
        if own < 0.0 {
            return;
        }
        let judgement = solution.judgement;
        let is_named = case.liar.is_some_and(|liar| judgement.excluded.contains(liar));
        let is_told = is_named || judgement.integrity == Integrity::Contradiction;
        self.named = self.named.or(is_named.then_some(own));
        self.told = self.told.or(is_told.then_some(own));
        if judgement.excluded.iter().any(|party| Some(party) != case.liar) {
            self.innocent += 1.0;
        }
        if !matches!(solution.mode, Mode::Fault | Mode::Standby | Mode::CoarseAlignment) {
            let (off, sigma) = error(case.what, solution, truth);
            (self.worst, self.claims) = (self.worst.max(off), self.claims.max(off / sigma));
        }
    }
}

/// The row of a kind.
pub(crate) fn row(name: &str, all: &[Score]) -> String {
    let mut told: Vec<f64> = all.iter().filter_map(|own| own.told).collect();
    told.sort_by(f64::total_cmp);
    let named = all.iter().filter(|own| own.named.is_some()).count();
    let greatest = |of: fn(&Score) -> f64| all.iter().map(of).fold(0.0, f64::max);
    let seconds = |own: Option<&f64>| own.map_or_else(String::new, |own| format!("{own:.0}"));
    format!(
        "| {name} | {} | {} | {named} | {} | {} | {:.0} | {:.2} | {:.1} |",
        all.len(),
        told.len(),
        seconds(told.get(told.len() / 2)),
        seconds(told.last()),
        greatest(|own| own.innocent),
        greatest(|own| own.worst),
        greatest(|own| own.claims),
    )
}

fn is_traced() -> bool {
    std::env::var_os("TRACE").is_some()
}

fn trace(case: &Case, solution: &Solution, truth: &Truth, engine: &Engine) {
    if is_traced() {
        let (off, sigma) = error(case.what, solution, truth);
        let evidence = engine.judge().map(Judge::evidence).unwrap_or_default();
        let Judged { at, integrity, excluded } = Judged::of(solution);
        println!("{at:.0} s off {off:.2} of {sigma:.2} {integrity:?} {excluded:?} {evidence}");
    }
}

/// What is told of the sensors.
struct Judged {
    at: f64,
    integrity: Integrity,
    excluded: Vec<&'static str>,
}

impl Judged {
    fn of(solution: &Solution) -> Self {
        let Solution { time, judgement, .. } = solution;
        let excluded = judgement.excluded.iter().map(Party::as_str).collect();
        Judged { at: time.as_seconds(), integrity: judgement.integrity, excluded }
    }
}

fn trace_event(output: &Output) {
    if let Output::Event(event) = output
        && is_traced()
    {
        println!("{event:?}");
    }
}

/// In the order of their receipt.
pub(crate) fn by_receipt(mut all: Vec<Received>) -> Vec<Received> {
    all.sort_by_key(|received| received.receipt);
    all
}

/// An instant, s.
pub(crate) fn seconds(time: Time) -> f64 {
    time.as_seconds()
}
