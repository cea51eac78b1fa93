//! A compass of antennas while the heading is still being found: a heading like that of any other compass. What has one takes its phases.

use insd_base::{ExternalReference, Message, Received};

/// A heading that is less sure than this tells an alignment nothing, rad, 1-sigma.
const UNSURE: f64 = 0.1;

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
