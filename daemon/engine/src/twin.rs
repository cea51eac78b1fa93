//! What would be if the clock of the IMU had stepped where its samples seem to be missing.
//!
//! Where nothing is known of when samples were received (a recording without times of arrival), a gap and a step ahead of the clock are the
//! same to look at. So an engine that takes the step back goes on beside the first for a minute. Who steers by wrong times meets
//! each wave and each turn too late: the sum of the normalised squares of the innovations tells them apart.

use insd_base::{Span, Time};

use crate::output::Output;

/// A twin lives so long, s.
const LIFE: f64 = 60.0;
/// What is said of the gap itself, and so long after it, s, is no matter of the clock: what was made up over it is not right.
const SETTLED: f64 = 1.0;
/// By how much the squares of one must exceed those of the other, and how many times.
const MORE: f64 = 25.0;
const TIMES: f64 = 2.0;

/// The engine that takes the gap for a step.
#[derive(Clone, Debug)]
pub(crate) struct Twin<E> {
    pub(crate) engine: Box<E>,
    pub(crate) since: Time,
    pub(crate) step: f64,
    /// What the first has heard, and what this has.
    first: Heard,
    own: Heard,
}

/// Innovations of an engine.
#[derive(Clone, Debug, Default)]
struct Heard {
    latest: Option<Time>,
    /// When each was valid, and its normalised square, of those that the other engine has not come to.
    pending: Vec<(Time, f64)>,
    /// Sum of the others'.
    misfit: f64,
}

/// How it ended.
pub(crate) enum Ending {
    Right,
    Wrong,
}

impl<E> Twin<E> {
    pub(crate) fn new(engine: E, since: Time, step: f64) -> Self {
        let (first, own) = (Heard::default(), Heard::default());
        Twin { engine: Box::new(engine), since, step, first, own }
    }

    /// What the first and this one have made of a message.
    pub(crate) fn compare<'a>(
        &mut self,
        first: impl Iterator<Item = &'a Output>,
        own: impl Iterator<Item = &'a Output>,
    ) {
        let from = self.since + Span::from_seconds(SETTLED);
        self.first.extend(squares(first, from));
        self.own.extend(squares(own, from));
    }

    pub(crate) fn ending(&mut self, now: Time) -> Option<Ending> {
        let until = self.first.latest.min(self.own.latest);
        let (first, own) = (self.first.misfit_until(until), self.own.misfit_until(until));
        let is_old = (now - self.since).as_seconds() > LIFE;
        if first - own > MORE && first > TIMES * own {
            Some(Ending::Right)
        } else {
            (is_old || own - first > MORE).then_some(Ending::Wrong)
        }
    }
}

impl Heard {
    fn extend(&mut self, squares: impl Iterator<Item = (Time, f64)>) {
        self.pending.extend(squares);
        self.latest = self.latest.max(self.pending.last().map(|(time, _)| *time));
    }

    /// The sum of the squares up to an instant to which both have come.
    fn misfit_until(&mut self, until: Option<Time>) -> f64 {
        let misfit = &mut self.misfit;
        self.pending.retain(|(time, square)| {
            let is_compared = Some(*time) <= until;
            *misfit += if is_compared { *square } else { 0.0 };
            !is_compared
        });
        *misfit
    }
}

/// Innovations from an instant on, and their normalised squares.
fn squares<'a>(
    outputs: impl Iterator<Item = &'a Output>,
    from: Time,
) -> impl Iterator<Item = (Time, f64)> {
    let all = outputs.filter_map(move |output| match output {
        Output::Innovation(own) if own.time > from => {
            Some((own.time, (own.innovation / own.sigma).powi(2)))
        }
        _ => None,
    });
    all.filter(|(_, square)| square.is_finite())
}
