//! References that are watched.

use insd_base::Time;
use insd_base::units::DEG;
use insd_vessel::{WatchComparison, WatchQuantity};
use insd_web::snapshot::ShownWatch;

pub(super) fn shown(own: &WatchComparison, now: Time) -> ShownWatch {
    let is_position = own.quantity == WatchQuantity::Position;
    let angle = |value: f64| Some(value / DEG).filter(|_| !is_position);
    let length = |value: f64| Some(value).filter(|_| is_position);
    ShownWatch {
        sensor: own.sensor.clone(),
        against: own.against.clone(),
        quantity: own.quantity.as_str().to_owned(),
        difference_deg: angle(own.difference),
        sigma_deg: angle(own.sigma),
        limit_deg: angle(own.limit),
        difference_m: length(own.difference),
        sigma_m: length(own.sigma),
        limit_m: length(own.limit),
        differs: own.differ,
        wrong: own.wrong.clone(),
        age_s: Some((now - own.time).as_seconds()),
    }
}
