//! What part of the Earth a chart shows, and where on it a place is.

use insd_base::{Geodetic, earth};

use super::WIDTH;
use super::projection::Projection;

/// Room around the frame, px.
const LEFT: f64 = 92.0;
const RIGHT: f64 = 14.0;
const TOP: f64 = 8.0;
/// Least and greatest height of the frame, px.
const HEIGHTS: (f64, f64) = (320.0, 560.0);
/// Part of the frame that the track fills.
const FILLED: f64 = 0.82;
/// Least width of what is shown, m: less is the noise of a ship at rest.
const LEAST: f64 = 60.0;

/// From the Earth to the drawing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    pub(crate) projection: Projection,
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) width: f64,
    pub(crate) height: f64,
    /// What is in the middle, m east and north, and pixels per metre.
    middle: (f64, f64),
    pub(crate) zoom: f64,
}

impl View {
    /// The view that holds these points, by latitude and longitude, rad; `None` without any.
    pub(crate) fn new(points: &[(f64, f64)]) -> Option<Self> {
        let sum = points.iter().fold(nalgebra::Vector3::zeros(), |sum, (latitude, longitude)| {
            let (latitude, longitude) = (*latitude, *longitude);
            sum + earth::ecef(&Geodetic { latitude, longitude, height: 0.0 }).0
        });
        let about = earth::geodetic(&insd_base::Ecef(sum / points.len().max(1) as f64));
        let projection = Projection::new(about.latitude, about.longitude);
        let placed =
            points.iter().map(|(latitude, longitude)| projection.plane(*latitude, *longitude));
        let ends = placed.fold(None, |ends: Option<[f64; 4]>, (x, y)| {
            let [west, east, south, north] = ends.unwrap_or([x, x, y, y]);
            Some([west.min(x), east.max(x), south.min(y), north.max(y)])
        });
        let [west, east, south, north] = ends?;
        let (across, up) = ((east - west).max(LEAST), (north - south).max(LEAST));
        let width = WIDTH - LEFT - RIGHT;
        let height = (width * up / across).clamp(HEIGHTS.0, HEIGHTS.1);
        Some(View {
            projection,
            left: LEFT,
            top: TOP,
            width,
            height,
            middle: ((west + east) / 2.0, (south + north) / 2.0),
            zoom: FILLED * (width / across).min(height / up),
        })
    }

    pub(crate) fn right(&self) -> f64 {
        self.left + self.width
    }

    pub(crate) fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// Where a point is, px.
    pub(crate) fn at(&self, latitude: f64, longitude: f64) -> (f64, f64) {
        let (east, north) = self.projection.plane(latitude, longitude);
        let x = self.left + self.width / 2.0 + (east - self.middle.0) * self.zoom;
        let y = self.top + self.height / 2.0 - (north - self.middle.1) * self.zoom;
        (x, y)
    }

    /// Where a point is whose longitude is counted from the middle.
    pub(crate) fn at_offset(&self, latitude: f64, east: f64) -> (f64, f64) {
        self.at(latitude, self.projection.longitude + east)
    }

    /// Latitude, and longitude from the middle, of a point of the frame: 0, 0 is at the top left, 1, 1 at
    /// the bottom right.
    pub(crate) fn sphere(&self, x: f64, y: f64) -> (f64, f64) {
        let east = self.middle.0 + (x - 0.5) * self.width / self.zoom;
        let north = self.middle.1 - (y - 0.5) * self.height / self.zoom;
        self.projection.sphere(east, north)
    }

    /// Whether a point of the drawing is in the frame.
    pub(crate) fn holds(&self, (x, y): (f64, f64)) -> bool {
        (self.left..=self.right()).contains(&x) && (self.top..=self.bottom()).contains(&y)
    }
}

#[cfg(test)]
mod tests {
    use super::super::graticule;
    use super::*;
    use insd_base::units::DEG;

    fn view(points: &[(f64, f64)]) -> View {
        let points: Vec<(f64, f64)> =
            points.iter().map(|(latitude, longitude)| (latitude * DEG, longitude * DEG)).collect();
        View::new(&points).unwrap()
    }

    #[test]
    fn north_is_up_east_is_right_and_everything_is_in_the_frame() {
        for shift in [0.0, 100.0, 180.0] {
            let points = [(54.0, shift), (54.1, shift + 0.3)];
            let view = view(&points);
            let [one, other] = points.map(|(lat, lon)| view.at(lat * DEG, lon * DEG));
            assert!(view.holds(one) && view.holds(other));
            assert!(other.0 > one.0 && other.1 < one.1, "{one:?} {other:?}");
        }
    }

    #[test]
    fn a_ship_that_crosses_the_pole_has_a_track_on_a_chart() {
        let view = view(&[(89.9, 10.0), (89.99, 10.0), (89.95, -170.0)]);
        let mut svg = String::new();
        graticule::draw(&mut svg, &view);
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
        assert!(svg.matches("<path").count() > 6, "{svg}");
        assert!(view.holds(view.at(90.0 * DEG, 0.0)));
    }

    #[test]
    fn a_ship_at_rest_is_a_point_and_nothing_is_no_chart() {
        assert!(view(&[(10.0, 10.0)]).zoom.is_finite());
        assert!(View::new(&[]).is_none());
    }
}
