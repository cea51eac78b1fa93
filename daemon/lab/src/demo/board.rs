//! All that is shown at one moment. The ship publishes it, the view draws it.

use std::collections::VecDeque;

use insd_base::{Counts, Solution, Time};
use insd_output::CivilTime;

use super::sensors::DemoSensorStatus;
use super::trail::Trail;
use super::truth::TrueError;

/// Events that are remembered.
const EVENTS: usize = 40;

/// Newest events among which a repetition is looked for.
const RECENT: usize = 4;

/// Something that happened, and how many times in a row.
#[derive(Clone, Debug, PartialEq)]
pub struct BoardEntry {
    /// When it happened last.
    pub time: Time,
    /// What.
    pub text: String,
    /// How many times lately.
    pub times: u64,
}

/// The last events, newest last; a repetition moves up and is counted.
#[derive(Clone, Debug, Default)]
pub struct Happenings(VecDeque<BoardEntry>);

impl Happenings {
    /// Adds one.
    pub fn add(&mut self, time: Time, text: String) {
        let recent = self.0.len().saturating_sub(RECENT);
        let same = (recent..self.0.len()).find(|index| self.0[*index].text == text);
        let before = same.and_then(|index| self.0.remove(index)).map_or(0, |same| same.times);
        if self.0.len() == EVENTS {
            self.0.pop_front();
        }
        self.0.push_back(BoardEntry { time, text, times: before + 1 });
    }

    /// Newest first.
    pub fn newest(&self) -> impl Iterator<Item = &BoardEntry> {
        self.0.iter().rev()
    }
}

/// Where the demo is between command and farewell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Phase {
    /// The voyage is being simulated.
    #[default]
    Preparing,
    /// The ship sails.
    Sailing,
    /// The voyage has come to its end.
    Arrived,
}

/// The NMEA port and what went through it.
#[derive(Clone, Debug, Default)]
pub struct DemoPort {
    /// Path that programs open.
    pub path: String,
    /// Bytes written.
    pub written: u64,
    /// Bytes that nobody read and that made room for newer ones.
    pub dropped: u64,
}

/// The tracks on the map: east and north of the start, m.
#[derive(Clone, Debug, Default)]
pub struct Tracks {
    /// Of the solution.
    pub own: Trail,
    /// Of the truth.
    pub truth: Trail,
    /// Of the GNSS fixes.
    pub gnss: Trail,
}

/// All that is shown at one moment.
#[derive(Clone, Debug, Default)]
pub struct Board {
    /// Scenario and seed.
    pub title: String,
    /// Speed of time.
    pub speed: f64,
    /// How far the computation has fallen behind the clock, s of voyage time.
    pub behind: f64,
    /// Where the demo is.
    pub phase: Phase,
    /// Voyage time.
    pub now: Time,
    /// The same on the calendar.
    pub utc: Option<CivilTime>,
    /// The newest solution.
    pub solution: Option<Solution>,
    /// When the mode was entered.
    pub mode_since: Time,
    /// Error of that solution.
    pub true_error: Option<TrueError>,
    /// How she stands to the berth that she goes to, in words.
    pub alongside: Option<String>,
    /// One line for each sensor.
    pub sensors: Vec<DemoSensorStatus>,
    /// The engine's counters.
    pub counts: Counts,
    /// The last events.
    pub events: Happenings,
    /// Tracks.
    pub tracks: Tracks,
    /// The NMEA port.
    pub port: DemoPort,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repeated_events_are_counted_and_do_not_push_others_out() {
        let mut happenings = Happenings::default();
        happenings.add(Time::START, "Mode: aided".to_owned());
        for second in 0..100 {
            happenings.add(Time::from_seconds(f64::from(second)), "GNSS rejected".to_owned());
        }
        let all: Vec<_> = happenings.newest().collect();
        assert_eq!(all.len(), 2);
        assert_eq!((all[0].times, all[0].time), (100, Time::from_seconds(99.0)));
    }
}
