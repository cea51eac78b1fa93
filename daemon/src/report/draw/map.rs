//! The track on a plain chart: no coast, no depth, equal scale in all directions, north up.

use std::fmt::Write as _;

use insd_base::units::DEG;
use insd_base::{Geodetic, earth};

use super::projection::Projection;
use super::scale::round_step;
use super::{MODE_CLASSES, WIDTH, graticule, open};
use crate::report::bins::Bins;
use crate::report::collect::modes::MODES;
use crate::report::collect::motion::{Fix, Place};
use crate::report::page::html::escape;

/// Room around the frame, px.
const LEFT: f64 = 92.0;
const RIGHT: f64 = 14.0;
const TOP: f64 = 8.0;
const BOTTOM: f64 = 26.0;
/// Least and greatest height of the frame, px.
const HEIGHTS: (f64, f64) = (320.0, 560.0);
/// Part of the frame that the track fills.
const FILLED: f64 = 0.82;
/// Least width of what is shown, m: less is the noise of a ship at rest.
const LEAST: f64 = 60.0;
/// Longest scale bar, px, and the longest distance that is given in metres.
const BAR: f64 = 180.0;
const NEAR: f64 = 2000.0;
/// Nautical mile, m.
const MILE: f64 = 1852.0;

/// From the Earth to the drawing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    pub(crate) projection: Projection,
    pub(crate) left: f64,
    pub(crate) top: f64,
    width: f64,
    height: f64,
    /// What is in the middle, m east and north, and pixels per metre.
    middle: (f64, f64),
    zoom: f64,
}

impl View {
    /// The view that holds these points, by latitude and longitude, rad; `None` without any.
    fn new(points: &[(f64, f64)]) -> Option<Self> {
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
    fn at(&self, latitude: f64, longitude: f64) -> (f64, f64) {
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

/// The drawing; `None` if no position is known.
pub(crate) fn draw(track: &Bins<Place>, berth: Option<Geodetic>) -> Option<String> {
    let fixes: Vec<Fix> = track.iter().filter_map(|(_, place)| place.0).collect();
    let (first, last) = (fixes.first()?, fixes.last()?);
    let mut points: Vec<(f64, f64)> =
        fixes.iter().map(|fix| (fix.latitude, fix.longitude)).collect();
    points.extend(berth.map(|berth| (berth.latitude, berth.longitude)));
    let view = View::new(&points)?;
    let mut svg = open(view.bottom() + BOTTOM, "Track");
    let frame = format!(
        "x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\"",
        view.left, view.top, view.width, view.height
    );
    let _ = write!(
        svg,
        "<clipPath id=\"chart\"><rect {frame}/></clipPath><rect class=\"sea\" {frame}/>"
    );
    graticule::draw(&mut svg, &view);
    draw_track(&mut svg, &view, &fixes);
    if let Some(berth) = berth {
        let at = view.at(berth.latitude, berth.longitude);
        mark(&mut svg, at, "M-6 0L0 -6L6 0L0 6Z", (-10.0, 4.0, "end"), "berth");
    }
    let at = |fix: &Fix| view.at(fix.latitude, fix.longitude);
    let circle = "M-5 0A5 5 0 1 0 5 0A5 5 0 1 0 -5 0Z";
    mark(&mut svg, at(first), circle, (10.0, -7.0, "start"), "start");
    mark(&mut svg, at(last), "M-5 -5H5V5H-5Z", (10.0, 15.0, "start"), "end");
    let _ = write!(svg, "<rect class=\"frame\" {frame}/>");
    draw_north(&mut svg, &view);
    draw_bar(&mut svg, &view);
    svg.push_str("</svg>");
    Some(svg)
}

/// A line for each stretch of one mode; each begins where the one before ended.
fn draw_track(svg: &mut String, view: &View, fixes: &[Fix]) {
    let mut before = None;
    for stretch in fixes.chunk_by(|one, other| one.mode == other.mode) {
        let Some(fix) = stretch.first() else { continue };
        let index = MODES.iter().position(|own| *own == fix.mode);
        let class = index.and_then(|index| MODE_CLASSES.get(index)).copied().unwrap_or_default();
        let mut d = String::new();
        for fix in before.into_iter().chain(stretch) {
            let (x, y) = view.at(fix.latitude, fix.longitude);
            let command = if d.is_empty() { 'M' } else { 'L' };
            let _ = write!(d, "{command}{x:.1} {y:.1}");
        }
        before = stretch.last();
        let _ = write!(svg, "<path class=\"track {class}\" d=\"{d}\"/>");
    }
}

fn mark(svg: &mut String, at: (f64, f64), shape: &str, label: (f64, f64, &str), words: &str) {
    let ((x, y), (right, down, class)) = (at, label);
    let words = escape(words);
    let _ = write!(
        svg,
        "<g transform=\"translate({x:.1} {y:.1})\"><path class=\"mark\" d=\"{shape}\"/>\
         <text class=\"{class} on\" x=\"{right}\" y=\"{down}\">{words}</text></g>"
    );
}

/// True north at the upper right corner.
fn draw_north(svg: &mut String, view: &View) {
    let (x, y) = (view.right() - 30.0, view.top + 44.0);
    let (latitude, east) = view.sphere((x - view.left) / view.width, (y - view.top) / view.height);
    let (here, there) = (view.at_offset(latitude, east), view.at_offset(latitude + 1e-6, east));
    let angle = (there.0 - here.0).atan2(here.1 - there.1) / DEG;
    let _ = write!(
        svg,
        "<g transform=\"translate({x:.1} {y:.1}) rotate({angle:.1})\">\
         <path class=\"mark\" d=\"M0 -18L6 12L0 6L-6 12Z\"/>\
         <text class=\"mid on\" x=\"0\" y=\"-22\">N</text></g>"
    );
}

fn draw_bar(svg: &mut String, view: &View) {
    let room = BAR / view.zoom;
    let (unit, name) = if room < NEAR { (1.0, "m") } else { (MILE, "NM") };
    // the largest round length that fits
    let length = round_step(room / unit / 2.6);
    let (x, y, width) = (view.left + 16.0, view.bottom() - 18.0, length * unit * view.zoom);
    let _ = write!(
        svg,
        "<path class=\"bar\" d=\"M{x:.1} {:.1}v8h{width:.1}v-8\"/>\
         <text class=\"mid on\" x=\"{:.1}\" y=\"{:.1}\">{length} {name}</text>",
        y - 4.0,
        x + width / 2.0,
        y - 4.0
    );
}

#[cfg(test)]
mod tests {
    use super::*;

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
