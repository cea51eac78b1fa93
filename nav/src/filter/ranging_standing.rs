//! How far a docking aid is believed, by whether it agrees with the ship; and which lines and points have which states.

use insd_base::{RangingReading, RangingTurn, Time};

use crate::error_state::RANGING_MARKS;

/// One that contradicts the ship with so many readings in a row, over so long, s, is wrong: somebody who walks through its beam is not.
const CONTRADICTIONS: u8 = 5;
const CONTRADICTS: f64 = 2.0;
/// It is believed again after so many that agree, over so long, s.
const AGREEING: u8 = 10;
const AGREES: f64 = 5.0;
/// After such a silence, s, it begins anew: but one that was not believed is not yet.
const SILENT: f64 = 10.0;

/// Docking aids that are told apart.
const AIDS: usize = 16;
/// What was measured to so recently, s, has a part in where the ship is taken to be.
const RECENT: f64 = 60.0;

/// How far one is believed.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RangingStanding {
    heard: Option<Time>,
    /// Since when it has told the same in a row, and how often: that it agrees, or that it does not.
    run: Option<(bool, Time, u8)>,
    is_contradicted: bool,
}

impl RangingStanding {
    /// Takes note of whether a reading agrees; tells whether it may be used, and what is new of how far the aid is believed.
    pub(super) fn hear(&mut self, now: Time, agrees: bool) -> (bool, Option<RangingTurn>) {
        let before = self.heard.replace(now);
        let is_new = before.is_none_or(|before| (now - before).as_seconds() > SILENT);
        let run = self.run.filter(|(own, ..)| *own == agrees && !is_new);
        let (_, since, count) = run.unwrap_or((agrees, now, 0));
        let count = count.saturating_add(1);
        self.run = Some((agrees, since, count));
        let lasts = (now - since).as_seconds();
        let turns = match agrees {
            false => !self.is_contradicted && count >= CONTRADICTIONS && lasts >= CONTRADICTS,
            true => self.is_contradicted && count >= AGREEING && lasts >= AGREES,
        };
        if turns {
            self.is_contradicted = !agrees;
        }
        let turn = if agrees { RangingTurn::Agrees } else { RangingTurn::Contradicted };
        (agrees && !self.is_contradicted, turns.then_some(turn))
    }
}

/// A line or point with states.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mark {
    number: u16,
    pub(super) heard: Time,
    pub(super) used: Option<Time>,
    /// 1-sigma of its survey, m.
    std: f64,
}

/// Docking aids, and what they measure to.
#[derive(Clone, Debug, Default)]
pub(super) struct Rangings {
    pub(super) marks: [Option<Mark>; RANGING_MARKS],
    pub(super) standings: [RangingStanding; AIDS],
}

impl Rangings {
    /// None has states any more.
    pub(super) fn forget_marks(&mut self) {
        self.marks = [None; RANGING_MARKS];
    }

    /// The place of a mark among the states; `None` where all are taken.
    pub(super) fn place(&mut self, reading: &RangingReading, now: Time) -> Option<usize> {
        let is_own = |mark: &Option<Mark>| mark.is_some_and(|mark| mark.number == reading.mark);
        let known = self.marks.iter().position(is_own);
        let place = known.or_else(|| self.marks.iter().position(Option::is_none))?;
        let used = self.marks[place].and_then(|mark| mark.used);
        let std = reading.target.survey_std();
        self.marks[place] = Some(Mark { number: reading.mark, heard: now, used, std });
        Some(place)
    }

    /// Places and survey of those that were used of late.
    pub(super) fn used(&self, now: Time) -> impl Iterator<Item = (usize, f64)> {
        let of_late = move |mark: Mark| {
            let is_recent = |used: Time| (now - used).as_seconds() < RECENT;
            mark.used.is_some_and(is_recent).then_some(mark.std)
        };
        let all = self.marks.into_iter().enumerate();
        all.filter_map(move |(place, mark)| Some((place, of_late(mark?)?)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Readings ten times a second from an instant on.
    fn heard(
        standing: &mut RangingStanding,
        from: f64,
        agrees: bool,
        times: u32,
    ) -> Vec<(bool, Option<RangingTurn>)> {
        let at = |i| Time::from_seconds(from + 0.1 * f64::from(i));
        (0..times).map(|i| standing.hear(at(i), agrees)).collect()
    }

    #[test]
    fn somebody_who_walks_through_the_beam_changes_nothing() {
        let mut standing = RangingStanding::default();
        assert_eq!(heard(&mut standing, 0.0, false, 19), [(false, None); 19]);
        assert_eq!(heard(&mut standing, 1.9, true, 1), [(true, None)]);
    }

    #[test]
    fn who_contradicts_for_two_seconds_is_believed_again_after_five_that_agree() {
        let mut standing = RangingStanding::default();
        let turns = heard(&mut standing, 0.0, false, 22);
        assert!(turns.contains(&(false, Some(RangingTurn::Contradicted))), "{turns:?}");
        let back = heard(&mut standing, 2.2, true, 60);
        let first = back.iter().position(|(used, _)| *used).unwrap();
        assert!((49..=52).contains(&first), "{first}");
        assert_eq!(back[first].1, Some(RangingTurn::Agrees));
        assert!(back[first + 1..].iter().all(|told| *told == (true, None)));
    }

    #[test]
    fn a_silence_excuses_nobody() {
        let mut standing = RangingStanding::default();
        heard(&mut standing, 0.0, false, 30);
        assert_eq!(heard(&mut standing, 100.0, true, 9), [(false, None); 9]);
    }
}
