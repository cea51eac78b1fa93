//! Asks the devices of a bus who they are.

use std::collections::VecDeque;

use insd_base::{BusEvent, CanFrame, Span, Time};
use insd_drivers::can::Speaker;
use insd_n2k::groups::{IsoRequest, ProductInfo};
use insd_n2k::pgn::Group as _;
use insd_n2k::{ADDRESS_CLAIM, BROADCAST, N2kId, NULL_ADDRESS};

/// Priority of a request.
const PRIORITY: u8 = 6;
/// When after the opening of the bus what is asked of all, s. Devices that miss the first answer the
/// second.
const QUESTIONS: [(f64, u32); 4] =
    [(0.0, ADDRESS_CLAIM), (0.5, ProductInfo::PGN), (2.5, ADDRESS_CLAIM), (3.0, ProductInfo::PGN)];
/// Pause after a refusal.
const PAUSE: Span = Span::from_nanos(10_000_000);

/// Asks everybody for NAME and product, without an address of its own: nobody has to make room.
#[derive(Debug, Default)]
pub(super) struct Asker {
    questions: VecDeque<(Time, u32)>,
}

impl Asker {
    fn request(pgn: u32) -> Option<CanFrame> {
        let (source, destination) = (NULL_ADDRESS, BROADCAST);
        let id = N2kId { priority: PRIORITY, pgn: IsoRequest::PGN, source, destination };
        CanFrame::new(id.compose(), &IsoRequest { pgn }.write())
    }
}

impl Speaker for Asker {
    fn up(&mut self, now: Time) {
        let at = |(seconds, pgn): (f64, u32)| (now + Span::from_seconds(seconds), pgn);
        self.questions = QUESTIONS.into_iter().map(at).collect();
    }

    fn down(&mut self, _: Time) {
        self.questions.clear();
    }

    fn bus_event(&mut self, _: BusEvent, _: Time) {}

    fn hear(&mut self, _: &CanFrame, _: Time) {}

    fn wake(&mut self, _: Time) {}

    fn wake_at(&self) -> Option<Time> {
        self.questions.front().map(|(at, _)| *at)
    }

    fn next_frame(&mut self, now: Time) -> Option<CanFrame> {
        let (_, pgn) = self.questions.front().filter(|(at, _)| *at <= now)?;
        Self::request(*pgn)
    }

    fn sent(&mut self, _: Time) {
        self.questions.pop_front();
    }

    fn refused(&mut self, now: Time) {
        if let Some((at, _)) = self.questions.front_mut() {
            *at = now + PAUSE;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_are_asked_twice_who_and_what_they_are() {
        let mut asker = Asker::default();
        assert_eq!(asker.next_frame(Time::START), None);
        asker.up(Time::START);
        let mut asked = Vec::new();
        while let Some(at) = asker.wake_at() {
            asked.push(asker.next_frame(at).unwrap());
            asker.sent(at);
        }
        let data: Vec<&[u8]> = asked.iter().map(CanFrame::data).collect();
        assert_eq!(data, [[0, 0xEE, 0], [0x14, 0xF0, 1], [0, 0xEE, 0], [0x14, 0xF0, 1]]);
        assert!(asked.iter().all(|frame| frame.id().to_string() == "18EAFFFE"));
    }
}
