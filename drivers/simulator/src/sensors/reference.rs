//! The external reference.

use insd_base::units::{DEG, wrap_two_pi};
use insd_base::{ExternalReference, Geodetic, Stamped, Time};

use super::epochs;
use crate::random::{Purpose, normal, stream};
use crate::scenario::{PositionReference, Reference};
use crate::track::Track;

/// Smallest 1-sigma of the berth's position, m: that of the survey.
const SURVEY_STD: f64 = 0.01;

/// The messages of a voyage of `duration`, s, that starts at `berth`. Epochs at which there is
/// nothing to say (the berth left, and neither velocity nor heading) have no message.
pub(crate) fn messages(
    reference: &Reference,
    berth: &Geodetic,
    track: &Track,
    duration: f64,
    seed: u64,
) -> Vec<Stamped<ExternalReference>> {
    let mut rng = stream(seed, Purpose::ReferenceNoise);
    let motion = track.motion();
    let message = |time: Time| {
        let t = time.as_seconds();
        let noise: [f64; 3] = std::array::from_fn(|_| normal(&mut rng));
        let ship = track.at(t);
        let velocity = ship.velocity_n().0;
        let wanted = reference.position == PositionReference::Berth;
        let at_berth = wanted && motion.path().is_at_first_berth(t);
        let speed_std = reference.velocity_std_mps;
        let heading_std = reference.heading_std_deg.map(|std| std * DEG);
        let heading = |std: f64| wrap_two_pi(ship.attitude().heading + std * noise[2]);
        ExternalReference {
            time,
            v_north: speed_std.map(|std| velocity.x + std * noise[0]),
            v_east: speed_std.map(|std| velocity.y + std * noise[1]),
            velocity_std: speed_std,
            position: at_berth.then_some(*berth),
            position_std: at_berth.then(|| motion.sway_std(t).max(SURVEY_STD)),
            position_lasting_std: None,
            heading: heading_std.map(heading),
            heading_std,
        }
    };
    let has_content = |message: &ExternalReference| {
        message.position.is_some() || message.v_north.is_some() || message.heading.is_some()
    };
    let all = epochs(1.0 / reference.interval_s, 0, duration).map(message);
    all.filter(has_content).map(Stamped::prompt).collect()
}
