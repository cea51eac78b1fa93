//! A compass of antennas while the heading is still being found: a heading like that of any other compass. What has one takes its phases.

use insd_base::satellites::CompassReading;
use insd_base::{Event, ExternalReference, Message, Received, Time};

use crate::Engine;

/// A heading that is less sure than this tells an alignment nothing, rad, 1-sigma.
const UNSURE: f64 = 0.1;

/// What is silent for so long, s, is told to be.
const SILENT: f64 = 10.0;

/// Whether antennas tell how the hull stands, as it was told last.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Antennas {
    is_told: bool,
    /// When they last did.
    last: Option<Time>,
    /// Since when they have been heard.
    begun: Option<Time>,
}

impl Antennas {
    /// Takes an epoch. Gives what is news.
    fn hear(&mut self, reading: &CompassReading) -> Option<Event> {
        let time = reading.time;
        let begun = *self.begun.get_or_insert(time);
        match &reading.told {
            Ok(_) => {
                self.last = Some(time);
                let is_new = !std::mem::replace(&mut self.is_told, true);
                is_new.then_some(Event::CompassJudged { time, why_not: None })
            }
            Err(why) => {
                let silent = (time - self.last.unwrap_or(begun)).as_seconds() >= SILENT;
                let was_told = self.is_told || self.last.is_none();
                if !silent || !was_told {
                    return None;
                }
                (self.is_told, self.last) = (false, Some(time));
                Some(Event::CompassJudged { time, why_not: Some(*why) })
            }
        }
    }
}

impl Engine {
    /// Takes note of what antennas tell.
    pub(crate) fn hear_antennas(&mut self, reading: &CompassReading) {
        if let Some(news) = self.antennas.hear(reading) {
            self.tell(news);
        }
    }
}

/// What an alignment is told of a message.
pub(crate) fn as_heading(received: &Received) -> Received {
    let Message::Compass(reading) = &received.message else { return received.clone() };
    let told = reading.told.as_ref().ok();
    let told = told.map(|own| (own.attitude.heading, own.covariance[(2, 2)].sqrt()));
    let Some((heading, std)) = told.filter(|(_, std)| *std < UNSURE) else {
        return received.clone();
    };
    let reference = ExternalReference {
        time: reading.time,
        v_north: None,
        v_east: None,
        velocity_std: None,
        position: None,
        position_std: None,
        heading: Some(heading),
        heading_std: Some(std),
    };
    Received { message: Message::Reference(reference), ..*received }
}
