//! How far what was told could be relied on, and who was left out.

use insd_base::{Event, Party, Solution, Span, Time};

use crate::evaluation::FaultsTold;
use crate::report::bounded::Bounded;

/// Verdicts kept at each end of the recording.
const VERDICTS: usize = 50;

/// What was made of the sensors' words.
#[derive(Clone, Debug)]
pub(crate) struct Trust {
    /// States and who was left out, by the time of solutions.
    pub(crate) told: FaultsTold,
    /// Each change of how somebody stands, in words.
    pub(crate) verdicts: Bounded<(Time, String)>,
}

impl Trust {
    pub(crate) fn new() -> Self {
        Trust { told: FaultsTold::default(), verdicts: Bounded::new(VERDICTS) }
    }

    /// A solution so long after the one before, s; nothing after a gap.
    pub(crate) fn solution(&mut self, solution: &Solution, passed: Option<f64>) {
        if passed.is_none() {
            self.told.cut();
        }
        let held = Span::from_seconds(passed.unwrap_or(0.0));
        let excluded: Vec<&str> = solution.judgement.excluded.iter().map(Party::as_str).collect();
        self.told.enter(solution.time, held, Some(solution.availability()), &excluded);
    }

    /// Takes note of a verdict.
    pub(crate) fn event(&mut self, event: &Event) {
        if let Event::Judged { time, stands } = event {
            self.verdicts.push((*time, stands.to_string()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::{Integrity, Judgement};

    use crate::evaluation::testing::solution;

    #[test]
    fn solutions_count_for_the_time_since_the_last_and_gaps_for_nobody() {
        let mut trust = Trust::new();
        for second in [0, 1, 2, 3, 60, 61] {
            let excluded = [Party::Gnss].into_iter().collect();
            let judgement = Judgement { integrity: Integrity::Contradiction, excluded };
            let own = solution(f64::from(second), insd_base::Geodetic::default());
            let passed = (second != 0 && second != 60).then_some(1.0);
            trust.solution(&Solution { judgement, ..own }, passed);
        }
        let gnss = &trust.told.exclusions()[0];
        assert_eq!((gnss.source.as_str(), gnss.total_s, gnss.pieces), ("gnss", 4.0, 2));
        assert_eq!((gnss.first_s, gnss.last_s), (0.0, 61.0));
        assert_eq!(trust.told.states()[0].0, insd_base::Availability::Fault);
    }
}
