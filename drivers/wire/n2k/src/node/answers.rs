//! Which answers are owed, and when: each kind not too often, and the last request never forgotten.

use std::collections::BTreeMap;

use insd_base::{Span, Time};

/// A kind of answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Answer {
    /// The claim of the address.
    Claim,
    /// The heartbeat.
    Heartbeat,
    /// The product information.
    Product,
    /// The configuration information.
    Configuration,
    /// The list of groups sent, to this address.
    Sends(u8),
    /// The list of groups read, to this address.
    Reads(u8),
    /// The last contents of a group.
    Stream(u32),
}

/// Time between two answers of one frame.
const SHORT: Span = Span::from_nanos(50_000_000);
/// Time between two answers of many frames.
const LONG: Span = Span::from_nanos(200_000_000);

impl Answer {
    fn spacing(self) -> Span {
        match self {
            Answer::Claim | Answer::Heartbeat | Answer::Stream(_) => SHORT,
            Answer::Product | Answer::Configuration | Answer::Sends(_) | Answer::Reads(_) => LONG,
        }
    }
}

#[derive(Clone, Copy, Debug, Default)]
struct Slot {
    given: Option<Time>,
    due: Option<Time>,
}

/// The answers of one node.
#[derive(Clone, Debug, Default)]
pub(crate) struct Answers(BTreeMap<Answer, Slot>);

impl Answers {
    /// Owes an answer, not before that time. True if it was owed already.
    pub(crate) fn owe(&mut self, answer: Answer, from: Time) -> bool {
        let slot = self.0.entry(answer).or_default();
        let owed = slot.due.is_some();
        let earliest = slot.given.map_or(from, |given| from.max(given + answer.spacing()));
        slot.due.get_or_insert(earliest);
        owed
    }

    /// An answer whose time has come. It counts as given. Without an address (`held` is false) only
    /// the claim can be sent; all others wait.
    pub(crate) fn due(&mut self, held: bool, now: Time) -> Option<Answer> {
        let is_due = |slot: &Slot| slot.due.is_some_and(|due| due <= now);
        let mut slots = self.0.iter_mut().filter(|(answer, _)| held || **answer == Answer::Claim);
        let (answer, slot) = slots.find(|(_, slot)| is_due(slot))?;
        *slot = Slot { given: Some(now), due: None };
        Some(*answer)
    }

    /// When the next is due.
    pub(crate) fn next(&self, held: bool) -> Option<Time> {
        let slots = self.0.iter().filter(|(answer, _)| held || **answer == Answer::Claim);
        slots.filter_map(|(_, slot)| slot.due).min()
    }

    /// Nothing is owed any more.
    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(milliseconds: i64) -> Time {
        Time::from_nanos(milliseconds * 1_000_000)
    }

    #[test]
    fn a_storm_gets_few_answers_and_the_last_request_gets_one() {
        let mut answers = Answers::default();
        let mut given = Vec::new();
        for now in 0..500 {
            if now < 101 {
                answers.owe(Answer::Claim, at(now));
            }
            if answers.due(true, at(now)).is_some() {
                given.push(now);
            }
        }
        assert_eq!(given, [0, 50, 100]);
        answers.owe(Answer::Claim, at(120));
        assert_eq!(answers.next(true), Some(at(150)));
    }

    #[test]
    fn kinds_do_not_wait_for_each_other() {
        let mut answers = Answers::default();
        for answer in [Answer::Claim, Answer::Sends(3), Answer::Sends(4)] {
            assert!(!answers.owe(answer, at(0)));
            assert!(answers.owe(answer, at(0)));
        }
        let given: Vec<Answer> = std::iter::from_fn(|| answers.due(true, at(0))).collect();
        assert_eq!(given, [Answer::Claim, Answer::Sends(3), Answer::Sends(4)]);
    }

    #[test]
    fn without_an_address_all_but_the_claim_wait() {
        let mut answers = Answers::default();
        answers.owe(Answer::Product, at(0));
        assert_eq!((answers.due(false, at(9)), answers.next(false)), (None, None));
        answers.owe(Answer::Claim, at(5));
        assert_eq!(answers.next(false), Some(at(5)));
        assert_eq!(answers.due(false, at(9)), Some(Answer::Claim));
        assert_eq!(answers.due(true, at(9)), Some(Answer::Product));
    }
}
