//! Quantities over time: their mean as a line, their extremes as an area about it.

use std::fmt::Write as _;

use insd_base::Time;

use super::axis::TimeAxis;
use super::scale::{Kind, Scale};
use super::{MODE_CLASSES, figure, key, open};
use crate::report::bins::{Bins, Extent};
use crate::report::collect::lane::Lane;

/// Height of the plotting area, and the room above and below, px.
const HEIGHT: f64 = 150.0;
const TOP: f64 = 8.0;
const BOTTOM: f64 = 34.0;
/// Height of the strip of modes at the foot, px.
const STRIP: f64 = 5.0;
/// Longest time over which points are joined, s, and widths of bins.
const JOINED: f64 = 2.0;
const JOINED_BINS: f64 = 2.5;

/// One quantity.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Curve<'a> {
    pub(crate) class: &'static str,
    pub(crate) label: &'static str,
    pub(crate) bins: &'a Bins<Extent>,
}

/// Quantities of one unit.
#[derive(Clone, Debug)]
pub(crate) struct Chart<'a> {
    pub(crate) title: &'static str,
    pub(crate) unit: &'static str,
    pub(crate) kind: Kind,
    /// Least span of values that is shown.
    pub(crate) span: f64,
    pub(crate) curves: Vec<Curve<'a>>,
}

/// Mean, least and greatest at an instant.
type Point = (Time, [f64; 3]);

impl Chart<'_> {
    /// The figure, with the modes at its foot; says so if nothing is known.
    pub(crate) fn draw(&self, axis: &TimeAxis, modes: &Lane) -> String {
        let Some(scale) = self.scale() else {
            return format!(
                "<p><b>{}</b>: <span class=\"unknown\">not known</span></p>\n",
                self.title
            );
        };
        let keys: String = match self.curves.len() {
            1 => String::new(),
            _ => self.curves.iter().map(|curve| key(curve.class, curve.label)).collect(),
        };
        let caption = format!("<b>{}</b> {}&emsp;{keys}", self.title, self.unit);
        let mut svg = open(TOP + HEIGHT + BOTTOM, self.title);
        axis.draw(&mut svg, TOP, TOP + HEIGHT, STRIP + 2.0);
        draw_marks(&mut svg, axis, &scale);
        for curve in &self.curves {
            draw_curve(&mut svg, axis, &scale, curve);
        }
        draw_modes(&mut svg, axis, modes);
        let (left, width) = (axis.left, axis.right() - axis.left);
        let _ = write!(
            svg,
            "<rect class=\"frame\" x=\"{left}\" y=\"{TOP}\" width=\"{width}\" height=\"{HEIGHT}\"/></svg>"
        );
        figure(&caption, &svg)
    }

    fn scale(&self) -> Option<Scale> {
        let values = self.curves.iter().flat_map(|curve| curve.bins.iter());
        let values = values.filter_map(|(_, bin)| bin.values());
        let shown = values.filter(|value| self.kind != Kind::Logarithmic || value[1] > 0.0);
        let ends = shown.fold(None, |ends: Option<(f64, f64)>, [_, least, greatest]| {
            let (low, high) = ends.unwrap_or((least, greatest));
            Some((low.min(least), high.max(greatest)))
        });
        ends.map(|(low, high)| Scale::new(self.kind, low, high, self.span))
    }
}

fn draw_marks(svg: &mut String, axis: &TimeAxis, scale: &Scale) {
    let (left, right) = (axis.left, axis.right());
    for (mark, label) in scale.marks() {
        let Some(y) = height(scale, mark) else { continue };
        let _ = write!(svg, "<path class=\"grid\" d=\"M{left:.1} {y:.1}H{right:.1}\"/>");
        let (x, y) = (left - 6.0, y + 4.0);
        let _ = write!(svg, "<text class=\"end\" x=\"{x:.1}\" y=\"{y:.1}\">{label}</text>");
    }
}

fn height(scale: &Scale, value: f64) -> Option<f64> {
    scale.share(value).map(|share| TOP + HEIGHT * (1.0 - share.clamp(0.0, 1.0)))
}

fn draw_curve(svg: &mut String, axis: &TimeAxis, scale: &Scale, curve: &Curve<'_>) {
    let (mut line, mut area) = (String::new(), String::new());
    for piece in pieces(curve.bins, scale) {
        let at = |time: Time, value: f64| Some((axis.x(time), height(scale, value)?));
        let points = |which: usize| {
            let pick = move |(time, values): &Point| at(*time, *values.get(which)?);
            piece.iter().filter_map(pick).collect::<Vec<_>>()
        };
        path(&mut line, &points(0));
        if piece.iter().any(|(_, [_, least, greatest])| least < greatest) {
            let mut around = points(2);
            around.extend(points(1).into_iter().rev());
            path(&mut area, &around);
            area.push('Z');
        }
    }
    let class = curve.class;
    if !area.is_empty() {
        let _ = write!(svg, "<path class=\"area {class}\" d=\"{area}\"/>");
    }
    let _ = write!(svg, "<path class=\"line {class}\" d=\"{line}\"/>");
}

/// Points that are joined: where there is a gap the line ends, and where a direction passes north.
fn pieces(bins: &Bins<Extent>, scale: &Scale) -> Vec<Vec<Point>> {
    let width = bins.width().as_seconds();
    let half = insd_base::Span::from_nanos(bins.width().as_nanos() / 2);
    let mut pieces: Vec<Vec<Point>> = Vec::new();
    let mut last: Option<(Time, f64)> = None;
    for (begin, bin) in bins.iter() {
        let Some(values) = bin.values() else { continue };
        let circles = scale.circles(values[0]);
        let point = (begin + half, values.map(|value| value - 360.0 * circles));
        let is_joined = last.is_some_and(|(before, own)| {
            own == circles && (begin - before).as_seconds() <= JOINED.max(JOINED_BINS * width)
        });
        last = Some((begin, circles));
        match pieces.last_mut() {
            Some(piece) if is_joined => piece.push(point),
            _ => pieces.push(vec![point]),
        }
    }
    pieces
}

fn path(d: &mut String, points: &[(f64, f64)]) {
    for (index, (x, y)) in points.iter().enumerate() {
        let command = if index == 0 { 'M' } else { 'L' };
        let _ = write!(d, "{command}{x:.1} {y:.1}");
    }
    if let ([(x, _)], false) = (points, d.is_empty()) {
        // a single point is a dot
        let _ = write!(d, "H{:.1}", x + 1.0);
    }
}

fn draw_modes(svg: &mut String, axis: &TimeAxis, modes: &Lane) {
    for (index, class) in MODE_CLASSES.iter().enumerate() {
        for run in modes.runs(1 << index) {
            let ((x, width), y) = (axis.extent(&run), TOP + HEIGHT + 2.0);
            let _ = write!(
                svg,
                "<rect class=\"{class}\" x=\"{x:.1}\" y=\"{y}\" width=\"{width:.1}\" height=\"{STRIP}\"/>"
            );
        }
    }
}
