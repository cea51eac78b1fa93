//! Plain drawings: SVG whose colours are the page's.

pub(crate) mod axis;
pub(crate) mod chart;
mod graticule;
pub(crate) mod map;
mod projection;
pub(crate) mod scale;
pub(crate) mod strips;
mod view;

use super::collect::modes::MODES;

/// Width of every drawing, in its own units.
pub(crate) const WIDTH: f64 = 1000.0;

/// Class of a mode by its place in [`MODES`].
pub(crate) const MODE_CLASSES: [&str; MODES.len()] =
    ["m0", "m1", "m2", "m3", "m4", "m5", "m7", "m6"];

/// The beginning of a drawing; its title is for who cannot see it.
fn open(height: f64, title: &str) -> String {
    let title = super::page::html::escape(title);
    format!("<svg viewBox=\"0 0 {WIDTH} {height:.0}\" role=\"img\" aria-label=\"{title}\">")
}

/// A key to the colours, for the caption of a figure.
pub(crate) fn key(class: &str, label: &str) -> String {
    format!(
        "<span class=\"key\"><i class=\"{class}\"></i>{}</span>",
        super::page::html::escape(label)
    )
}

/// A figure with a caption that is already HTML.
pub(crate) fn figure(caption: &str, drawing: &str) -> String {
    format!("<figure><figcaption>{caption}</figcaption>{drawing}</figure>\n")
}
