//! What would be if the clock of the IMU had stepped where its samples seem to be missing.
//!
//! Where nothing is known of when samples were received (a recording without times of arrival), a gap and a step ahead of the clock are the
//! same to look at. So an engine that takes the step back goes on beside the first for a minute. Who steers by wrong times meets
//! each wave and each turn too late: the sum of the normalised squares of the innovations tells them apart.

use insd_base::{Event, Received, Span, Time};

use crate::{Engine, Output};

/// A twin lives so long, s.
const LIFE: f64 = 60.0;
/// What is said of the gap itself, and so long after it, s, is no matter of the clock: what was made up over it is not right.
const SETTLED: f64 = 1.0;
/// By how much the squares of one must exceed those of the other, and how many times.
const MORE: f64 = 25.0;
const TIMES: f64 = 2.0;

/// The engine that takes the gap for a step.
#[derive(Clone, Debug)]
pub(crate) struct Twin {
    engine: Box<Engine>,
    since: Time,
    step: f64,
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
enum Ending {
    Right,
    Wrong,
}

impl Engine {
    /// Lets a twin begin where samples may be missing, or not.
    pub(crate) fn bear_twin(&mut self, received: &Received, step: f64) {
        if self.twin.is_some() {
            return;
        }
        let mut engine = Box::new(self.clone());
        engine.stamps.take_back(step);
        let since = received.message.time();
        let (first, own) = (Heard::default(), Heard::default());
        self.twin = Some(Twin { engine, since, step, first, own });
    }

    /// The twin hears the same; `before` outputs were there before this engine heard it.
    pub(crate) fn hear_with_twin(&mut self, received: &Received, before: usize) {
        let Some(mut twin) = self.twin.take() else { return };
        let from = twin.since + Span::from_seconds(SETTLED);
        twin.first.extend(squares(self.outputs.iter().skip(before), from));
        twin.engine.handle_alone(received);
        twin.own.extend(squares(twin.engine.outputs.iter(), from));
        twin.engine.outputs.clear();
        match twin.ending(received.message.time()) {
            None => self.twin = Some(twin),
            Some(Ending::Wrong) => {}
            Some(Ending::Right) => self.become_twin(twin),
        }
    }

    fn become_twin(&mut self, twin: Twin) {
        let (outputs, next) = (std::mem::take(&mut self.outputs), self.next_epoch);
        *self = *twin.engine;
        self.outputs = outputs;
        // what was told is not told again
        self.next_epoch = next;
        self.tell(Event::ImuClock { time: twin.since, step: twin.step });
    }
}

impl Twin {
    fn ending(&mut self, now: Time) -> Option<Ending> {
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
