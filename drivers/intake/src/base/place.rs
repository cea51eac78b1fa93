//! Where a base is: what it tells (1005, 1006), checked.

use insd_base::{Ecef, Geodetic, Time, earth};
use insd_wire::gnss::rtcm::BaseStation;
use nalgebra::Vector3;

use super::settings::{BaseSettings, HEIGHTS};
use super::status::BaseNews;

/// Coordinates that differ by more are others, m: below it is how they are rounded.
const SAME: f64 = 0.01;
/// What is told may differ from what is configured by this, m: two frames of one continent do.
const AGREES: f64 = 1.0;
/// From so far on a base is of little use, m; and is near again below a twentieth less.
const FAR: f64 = 100_000.0;
const NEAR: f64 = 0.95 * FAR;
/// For so long the position of one that moves is that of an epoch, s.
const FRESH: f64 = 2.0;

/// Where a base is, by whoever knows.
#[derive(Clone, Debug)]
pub(super) struct Place {
    settings: BaseSettings,
    configured: Option<Vector3<f64>>,
    /// What it told last: station, place, when.
    told: Option<(u16, Vector3<f64>, Time)>,
    is_implausible: bool,
    contradicts: bool,
    is_far: bool,
    distance: Option<f64>,
}

impl Place {
    pub(super) fn new(settings: BaseSettings) -> Self {
        Place {
            settings,
            configured: settings.position(),
            told: None,
            is_implausible: false,
            contradicts: false,
            is_far: false,
            distance: None,
        }
    }

    /// Whether the last that it told is no place.
    pub(super) fn is_implausible(&self) -> bool {
        self.is_implausible
    }

    pub(super) fn is_moving(&self) -> bool {
        self.settings.moving
    }

    /// Whether where it is stands in the configuration, and nothing that it tells speaks against that.
    pub(super) fn is_surveyed(&self) -> bool {
        self.configured.is_some() && !self.contradicts
    }

    /// How far it is from the ship, m.
    pub(super) fn distance(&self) -> Option<f64> {
        self.distance
    }

    /// Where it is at an instant, ECEF, m.
    pub(super) fn at(&self, now: Time) -> Option<Vector3<f64>> {
        let is_fresh = |told: &Time| !self.settings.moving || (now - *told).as_seconds() <= FRESH;
        let told = self.told.filter(|(_, _, at)| is_fresh(at)).map(|(_, place, _)| place);
        self.configured.or(told)
    }

    /// Takes what it tells, and gives what is news.
    pub(super) fn hear(&mut self, told: &BaseStation, now: Time) -> Vec<BaseNews> {
        let place = Vector3::from(told.position);
        let was_implausible = std::mem::replace(&mut self.is_implausible, !is_on_earth(&place));
        if self.is_implausible {
            return (!was_implausible).then_some(BaseNews::Implausible).into_iter().collect();
        }
        let before = self.told.replace((told.station, place, now));
        let moved = self.moved(before, told.station, &place);
        moved.into_iter().chain(self.compare(&place)).collect()
    }

    /// What is news of where it was before.
    fn moved(
        &self,
        before: Option<(u16, Vector3<f64>, Time)>,
        to: u16,
        place: &Vector3<f64>,
    ) -> Option<BaseNews> {
        let Some((from, earlier, _)) = before else {
            return Some(BaseNews::Placed { station: to });
        };
        let by = (place - earlier).norm();
        if from != to {
            Some(BaseNews::Station { from, to, by })
        } else {
            (by > SAME && !self.settings.moving).then_some(BaseNews::Moved { by })
        }
    }

    /// What is news of where it is configured to be.
    fn compare(&mut self, place: &Vector3<f64>) -> Option<BaseNews> {
        let by = (place - self.configured?).norm();
        let contradicted = std::mem::replace(&mut self.contradicts, by > AGREES);
        match (contradicted, self.contradicts) {
            (false, true) => Some(BaseNews::Contradicts { by }),
            (true, false) => Some(BaseNews::Agrees),
            _ => None,
        }
    }

    /// Measures how far it is from the ship; gives news.
    pub(super) fn look_at_distance(&mut self, ship: &Geodetic) -> Option<BaseNews> {
        let place = self.configured.or(self.told.map(|(_, place, _)| place))?;
        let distance = (place - earth::ecef(ship).0).norm();
        self.distance = Some(distance);
        let limit = if self.is_far { NEAR } else { FAR };
        let was_far = std::mem::replace(&mut self.is_far, distance > limit);
        match (was_far, self.is_far) {
            (false, true) => Some(BaseNews::Far { distance }),
            (true, false) => Some(BaseNews::Near { distance }),
            _ => None,
        }
    }
}

/// Whether somebody could have put an antenna there.
fn is_on_earth(place: &Vector3<f64>) -> bool {
    // nearer to the middle than that there is no geodetic latitude
    place.norm() > 6.0e6 && HEIGHTS.contains(&earth::geodetic(&Ecef(*place)).height)
}

#[cfg(test)]
mod tests {
    use super::*;

    const HARBOUR: (f64, f64, f64) = (53.5, 8.1, 45.0);

    fn told(station: u16, (lat, lon, height): (f64, f64, f64)) -> BaseStation {
        let position = earth::ecef(&Geodetic::from_degrees(lat, lon, height)).0.into();
        BaseStation { station, position, height: None }
    }

    fn at(seconds: f64) -> Time {
        Time::from_seconds(seconds)
    }

    #[test]
    fn what_is_no_place_on_earth_is_not_used_and_told_once() {
        let mut place = Place::new(BaseSettings::default());
        for wrong in [[0.0; 3], [1.0, 2.0, 3.0], [6.4e7, 0.0, 0.0], [0.0, 0.0, 6.3e6]] {
            let wrong = BaseStation { station: 1, position: wrong, height: None };
            let news = place.hear(&wrong, at(0.0));
            assert!(news.is_empty() || news == [BaseNews::Implausible]);
            assert!(place.is_implausible() && place.at(at(0.0)).is_none());
        }
        let news = place.hear(&told(1, HARBOUR), at(1.0));
        assert_eq!(news, [BaseNews::Placed { station: 1 }]);
        assert!(!place.is_implausible() && place.at(at(5000.0)).is_some());
    }

    #[test]
    fn a_base_that_jumps_is_told_and_one_that_moves_is_not() {
        let (lat, lon, height) = HARBOUR;
        let there = told(1, (lat, lon, height + 3.0));
        let mut fixed = Place::new(BaseSettings::default());
        fixed.hear(&told(1, HARBOUR), at(0.0));
        assert_eq!(fixed.hear(&told(1, HARBOUR), at(1.0)), []);
        let news = fixed.hear(&there, at(2.0));
        assert!(matches!(news[..], [BaseNews::Moved { by }] if (by - 3.0).abs() < 1e-6));
        let news = fixed.hear(&told(2, HARBOUR), at(3.0));
        assert!(matches!(news[..], [BaseNews::Station { from: 1, to: 2, .. }]));

        let mut moving = Place::new(BaseSettings { moving: true, ..BaseSettings::default() });
        moving.hear(&told(1, HARBOUR), at(0.0));
        assert_eq!(moving.hear(&there, at(1.0)), []);
        assert!(moving.at(at(2.9)).is_some() && moving.at(at(3.1)).is_none());
    }

    #[test]
    fn what_is_configured_holds_and_a_contradiction_is_told() {
        let (lat, lon, height) = HARBOUR;
        let settings = BaseSettings {
            lat_deg: Some(lat),
            lon_deg: Some(lon),
            height_m: Some(height),
            moving: false,
        };
        let mut place = Place::new(settings);
        let configured = place.at(at(0.0)).unwrap();
        place.hear(&told(1, HARBOUR), at(0.0));
        let news = place.hear(&told(1, (lat, lon, height + 20.0)), at(1.0));
        assert!(matches!(news[1], BaseNews::Contradicts { by } if (by - 20.0).abs() < 1e-6));
        assert_eq!(place.at(at(1.0)), Some(configured));
        assert!(!place.is_surveyed(), "one of the two is wrong");
        let news = place.hear(&told(1, HARBOUR), at(2.0));
        assert_eq!(news[1], BaseNews::Agrees);
        assert!(place.is_surveyed());
    }

    #[test]
    fn a_base_far_away_is_told_when_it_begins_and_when_it_ends() {
        let mut place = Place::new(BaseSettings::default());
        let ship = |lat| Geodetic::from_degrees(lat, 8.1, 0.0);
        assert_eq!(place.look_at_distance(&ship(53.5)), None);
        place.hear(&told(1, HARBOUR), at(0.0));
        assert_eq!(place.look_at_distance(&ship(53.6)), None);
        let far = place.look_at_distance(&ship(54.5));
        assert!(matches!(far, Some(BaseNews::Far { distance }) if distance > 1.1e5));
        assert_eq!(place.look_at_distance(&ship(54.36)), None, "97 km: not near again yet");
        assert!(matches!(place.look_at_distance(&ship(54.0)), Some(BaseNews::Near { .. })));
    }
}
