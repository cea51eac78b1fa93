//! A compass of antennas while the heading is still being found: a heading like that of any other compass. What has one takes its phases.

use insd_base::satellites::CompassReading;
use insd_base::{Event, ExternalReference, Message, Received, Time};

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
    pub(crate) fn hear(&mut self, reading: &CompassReading) -> Option<Event> {
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
        heading: Some(heading),
        heading_std: Some(std),
        ..ExternalReference::default()
    };
    Received { message: Message::Reference(reference), ..*received }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    use insd_base::Attitude;
    use insd_base::satellites::{CompassPhases, CompassRefusal};
    use nalgebra::Matrix3;

    fn reading(second: u32, std: Option<f64>) -> CompassReading {
        let told = std.map(|std| CompassPhases {
            attitude: Attitude { heading: 1.0, ..Attitude::default() },
            covariance: Matrix3::from_diagonal_element(std * std),
            signals: Vec::new(),
        });
        let told = told.ok_or(CompassRefusal::NoPlace);
        let time = Time::from_seconds(f64::from(second));
        CompassReading { time, run: 0, told, faults: Vec::new() }
    }

    #[test]
    fn antennas_that_tell_and_that_fall_silent_are_told_once() {
        let mut antennas = Antennas::default();
        let news = |second: u32| antennas.hear(&reading(second, (second < 20).then_some(0.01)));
        let told: Vec<_> = (0..60).filter_map(news).collect();
        let [Event::CompassJudged { why_not: None, .. }, Event::CompassJudged { time, why_not }] =
            told[..]
        else {
            unreachable!("{told:?}")
        };
        assert_eq!((time, why_not), (Time::from_seconds(29.0), Some(CompassRefusal::NoPlace)));
    }

    #[test]
    fn an_alignment_is_told_a_heading_only_where_one_is_known() {
        let heard = |std: Option<f64>| {
            let message = Message::Compass(Arc::new(reading(1, std)));
            let source = insd_base::Source::Gnss(0);
            as_heading(&Received { receipt: Time::from_seconds(1.1), source, message }).message
        };
        let Message::Reference(told) = heard(Some(0.02)) else { unreachable!() };
        assert_eq!((told.heading, told.heading_std), (Some(1.0), Some(0.02)));
        assert!(matches!(heard(Some(10.0)), Message::Compass(_)));
        assert!(matches!(heard(None), Message::Compass(_)));
    }
}
