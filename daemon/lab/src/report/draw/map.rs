//! The track on a plain chart: no coast, no depth, equal scale in all directions, north up.

use std::fmt::Write as _;

use insd_base::Geodetic;
use insd_base::units::DEG;

use super::scale::round_step;
use super::view::View;
use super::{MODE_CLASSES, graticule, open};
use crate::report::bins::Bins;
use crate::report::collect::modes::MODES;
use crate::report::collect::motion::{Fix, Place};
use crate::report::page::html::escape;

/// Room below the frame, px.
const BOTTOM: f64 = 26.0;
/// Longest scale bar, px, and the longest distance that is given in metres.
const BAR: f64 = 180.0;
const NEAR: f64 = 2000.0;
/// Nautical mile, m.
const MILE: f64 = 1852.0;

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
