//! What came of a voyage.

use std::fmt;

use insd_base::units::{DEG, wrap_pi};
use insd_base::{Attitude, Event, Mode, Solution, Truth, Voyage, earth};
use insd_engine::{Engine, EngineConfig, Output};

use crate::mistakes::Mistake;

/// What is beyond so many claimed sigmas misleads.
const CLAIMED: f64 = 3.0;
/// What is traced is printed so often, s.
const TRACED: f64 = 1.0;

/// Errors of one voyage, or of all seeds together.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outcome {
    name: String,
    horizontal: f64,
    vertical: f64,
    nees: f64,
    heading_nees: f64,
    /// Greatest horizontal error while told valid that is beyond three claimed sigmas, m, and the greatest in claimed
    /// sigmas, from the start.
    misled: f64,
    worst_sigmas: f64,
    /// The greatest in claimed sigmas since it is judged.
    late_sigmas: f64,
    /// Greatest horizontal error of the last minute while told valid, m, and in claimed sigmas.
    end: f64,
    end_sigmas: f64,
    told: Option<f64>,
    voyages: f64,
    told_in: f64,
}

impl Outcome {
    pub(crate) const HEAD: &'static str = "mistake            horiz. m  down m   NEES  hdg NEES  misled m sigmas  judged  ends m sigmas  told in   after s";

    /// Mean squares over voyages, the worst of all.
    pub(crate) fn of(name: &str, all: &[Outcome]) -> Outcome {
        let n = all.len() as f64;
        let mean = |of: fn(&Outcome) -> f64| all.iter().map(of).sum::<f64>() / n;
        let greatest = |of: fn(&Outcome) -> f64| all.iter().map(of).fold(0.0, f64::max);
        let mut told: Vec<f64> = all.iter().filter_map(|one| one.told).collect();
        told.sort_by(f64::total_cmp);
        Outcome {
            name: name.to_owned(),
            horizontal: mean(|one| one.horizontal.powi(2)).sqrt(),
            vertical: mean(|one| one.vertical.powi(2)).sqrt(),
            nees: mean(|one| one.nees),
            heading_nees: mean(|one| one.heading_nees),
            misled: greatest(|one| one.misled),
            worst_sigmas: greatest(|one| one.worst_sigmas),
            late_sigmas: greatest(|one| one.late_sigmas),
            end: greatest(|one| one.end),
            end_sigmas: greatest(|one| one.end_sigmas),
            told: told.last().copied(),
            voyages: n,
            told_in: told.len() as f64,
        }
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let told = self.told.map_or("-".to_owned(), |at| format!("{at:.0}"));
        write!(
            f,
            "{:<18} {:>8.2} {:>7.2} {:>6.2} {:>9.2} {:>8.1} {:>7.1} {:>7.1} {:>7.1} {:>6.1} {:>4}/{:<3} {:>8}",
            self.name,
            self.horizontal,
            self.vertical,
            self.nees,
            self.heading_nees,
            self.misled,
            self.worst_sigmas,
            self.late_sigmas,
            self.end,
            self.end_sigmas,
            self.told_in,
            self.voyages,
            told
        )
    }
}

/// Sails a voyage with a mistake.
pub(crate) fn sail(voyage: Voyage, mistake: &Mistake, from: f64) -> Outcome {
    let mut voyage = voyage;
    (mistake.make)(&mut voyage);
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, 1.0));
    let mut outcome = Outcome::default();
    let ends = voyage.truth.last().map_or(0.0, |truth| truth.time.as_seconds()) - 60.0;
    let mut judged = Judged { from, ends, ..Judged::default() };
    let mut truth = voyage.truth.iter().peekable();
    for received in voyage.received() {
        engine.handle(&received);
        while let Some(output) = engine.poll_output() {
            match output {
                Output::Solution(solution) => {
                    while truth.next_if(|truth| truth.time < solution.time).is_some() {}
                    if let Some(truth) = truth.peek().filter(|t| t.time == solution.time) {
                        judged.judge(&solution, truth, &mut outcome);
                    }
                }
                Output::Event(Event::Judged { stands, .. })
                    if std::env::var_os("WORDS").is_some() =>
                {
                    let since = stands.since.as_seconds();
                    eprintln!("{}: {since:.0} s: {stands}", mistake.name);
                }
                Output::Event(Event::InstallationFound { time, finding }) => {
                    if std::env::var_os("WORDS").is_some() {
                        eprintln!("{}: {:.0} s: {finding}", mistake.name, time.as_seconds());
                    }
                    if finding.as_str() == mistake.cause || mistake.cause.is_empty() {
                        outcome.told.get_or_insert(time.as_seconds());
                    }
                }
                Output::Event(event) if std::env::var_os("TRACE").is_some() => {
                    eprintln!("{event:?}");
                }
                _ => {}
            }
        }
    }
    judged.finish(outcome)
}

/// Prints errors, of the place, m, and of the heading, rad, and claims once a second, where that is asked for.
fn trace(solution: &Solution, off: f64, turned: Option<f64>) {
    let at = solution.time.as_seconds();
    if at % TRACED > 0.0 || std::env::var_os("TRACE").is_none() {
        return;
    }
    let std = solution.sigma.position.0.xy().norm();
    let [turned, claimed] = [turned.unwrap_or(f64::NAN), solution.sigma.heading].map(|a| a / DEG);
    let (mode, judgement) = (solution.mode, solution.judgement.integrity);
    eprintln!(
        "{at} s: {off:.1} m off, {std:.1} claimed; heading {turned:.1} deg, {claimed:.1}; {mode:?} {judgement:?}"
    );
}

#[derive(Default)]
struct Judged {
    /// From when on it is judged, and when the last minute begins, s.
    from: f64,
    ends: f64,
    n: f64,
    horizontal: f64,
    vertical: f64,
    nees: f64,
    heading_nees: f64,
}

impl Judged {
    fn judge(&mut self, solution: &Solution, truth: &Truth, outcome: &mut Outcome) {
        let apart = earth::ecef(&solution.position).0 - earth::ecef(&truth.position).0;
        let error = earth::c_ne(&truth.position) * apart;
        let std = solution.sigma.position.0;
        let (off, at) = (error.xy().norm(), solution.time.as_seconds());
        let heading = |truth: Attitude| wrap_pi(solution.attitude.heading - truth.heading);
        let turned = truth.attitude.map(heading);
        trace(solution, off, turned);
        if !matches!(solution.mode, Mode::CoarseAlignment | Mode::Standby | Mode::Fault) {
            let sigmas = off / std.xy().norm();
            let raise = |greatest: &mut f64, to: f64| *greatest = greatest.max(to);
            raise(&mut outcome.worst_sigmas, sigmas);
            raise(&mut outcome.misled, if sigmas > CLAIMED { off } else { 0.0 });
            raise(&mut outcome.late_sigmas, if at < self.from { 0.0 } else { sigmas });
            raise(&mut outcome.end, if at < self.ends { 0.0 } else { off });
            raise(&mut outcome.end_sigmas, if at < self.ends { 0.0 } else { sigmas });
        }
        if at < self.from {
            return;
        }
        self.n += 1.0;
        self.horizontal += off * off;
        self.vertical += error.z * error.z;
        let scaled = error.component_div(&std);
        self.nees += scaled.xy().norm_squared() / 2.0;
        if let Some(turned) = turned {
            self.heading_nees += (turned / solution.sigma.heading).powi(2);
        }
    }

    fn finish(&self, outcome: Outcome) -> Outcome {
        Outcome {
            horizontal: (self.horizontal / self.n).sqrt(),
            vertical: (self.vertical / self.n).sqrt(),
            nees: self.nees / self.n,
            heading_nees: self.heading_nees / self.n,
            ..outcome
        }
    }
}
