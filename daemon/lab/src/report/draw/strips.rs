//! What was the case when, one strip above the other.

use std::fmt::Write as _;

use super::axis::TimeAxis;
use super::open;
use crate::report::collect::lane::Lane;
use crate::report::page::html::escape;
use crate::report::times::Times;

/// Height of a strip and its distance from the next, px.
const HEIGHT: f64 = 14.0;
const PITCH: f64 = 22.0;
const TOP: f64 = 4.0;
const BOTTOM: f64 = 24.0;
/// Room for the names of strips, px, and characters that fit into it.
pub(crate) const NAMES: f64 = 170.0;
const LONGEST: usize = 24;

/// What a bit of a lane means.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Meaning {
    pub(crate) bit: u16,
    pub(crate) class: &'static str,
    pub(crate) words: &'static str,
}

/// A strip with its name; meanings that matter more come later and cover the others.
#[derive(Clone, Debug)]
pub(crate) struct Strip<'a> {
    pub(crate) name: String,
    pub(crate) lane: &'a Lane,
    pub(crate) meanings: &'a [Meaning],
}

/// The drawing.
pub(crate) fn draw(title: &str, strips: &[Strip<'_>], times: &Times) -> String {
    let axis = TimeAxis::new(times, NAMES);
    let bottom = TOP + PITCH * strips.len() as f64;
    let mut svg = open(bottom + BOTTOM, title);
    axis.draw(&mut svg, TOP, bottom, 0.0);
    let mut y = TOP + (PITCH - HEIGHT) / 2.0;
    for strip in strips {
        let name: String = strip.name.chars().take(LONGEST).collect();
        let (x, below, name) = (axis.left - 8.0, y + 11.0, escape(&name));
        let _ = write!(svg, "<text class=\"end\" x=\"{x}\" y=\"{below:.1}\">{name}</text>");
        let width = axis.right() - axis.left;
        let _ = write!(
            svg,
            "<rect class=\"ground\" x=\"{}\" y=\"{y:.1}\" width=\"{width}\" height=\"{HEIGHT}\"/>",
            axis.left
        );
        strip.meanings.iter().for_each(|meaning| {
            draw_runs(&mut svg, &axis, strip.lane, meaning, y, times);
        });
        y += PITCH;
    }
    svg.push_str("</svg>");
    svg
}

fn draw_runs(
    svg: &mut String,
    axis: &TimeAxis,
    lane: &Lane,
    meaning: &Meaning,
    y: f64,
    times: &Times,
) {
    let Meaning { bit, class, words } = meaning;
    for run in lane.runs(*bit) {
        let (x, width) = axis.extent(&run);
        let (from, to) = (times.clock(run.from), times.clock(run.to.min(times.end())));
        let _ = write!(
            svg,
            "<rect class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" \
             height=\"{HEIGHT}\"><title>{words}, {from} to {to}</title></rect>"
        );
    }
}
