//! What an engine made of its measurements lately.

use insd_base::{Event, Time};

use crate::Output;

/// Measurements count for so long, s.
const MEMORY: f64 = 20.0;
/// Fewer than so many say nothing.
const LEAST: f64 = 3.0;

/// The share of the measurements that an engine refuses, of those of the last 20 s or so.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Record {
    used: f64,
    refused: f64,
    last: Option<Time>,
}

impl Record {
    /// Takes note of what an engine says.
    pub fn hear(&mut self, output: &Output) {
        match output {
            Output::Innovation(innovation) => {
                self.pass(innovation.time);
                let count = if innovation.accepted { &mut self.used } else { &mut self.refused };
                *count += 1.0;
            }
            // it was so wrong that it gave itself up
            Output::Event(Event::PositionReset { time }) => {
                self.pass(*time);
                self.refused += self.used;
                self.used = 0.0;
            }
            _ => {}
        }
    }

    /// Share of the measurements that it refused, 0 to 1; `None` if it had hardly any.
    #[must_use]
    pub fn refused(&self, now: Time) -> Option<f64> {
        let left = self.last.map_or(0.0, |last| decay((now - last).as_seconds()));
        let all = self.used + self.refused;
        (all * left >= LEAST).then(|| self.refused / all)
    }

    fn pass(&mut self, now: Time) {
        let left = self.last.map_or(1.0, |last| decay((now - last).as_seconds()));
        self.used *= left;
        self.refused *= left;
        self.last = Some(self.last.map_or(now, |last| last.max(now)));
    }
}

fn decay(seconds: f64) -> f64 {
    (-seconds.max(0.0) / MEMORY).exp()
}
