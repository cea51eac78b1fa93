//! Small charts as SVG, readable on light and on dark paper.

use std::fmt::Write as _;

/// Width and height of a panel's plotting area, and the room around it, px.
const AREA: (f64, f64) = (290.0, 210.0);
const LEFT: f64 = 62.0;
const RIGHT: f64 = 14.0;
const TOP: f64 = 62.0;
const BOTTOM: f64 = 46.0;
/// Height of the headline of a row of panels, px.
const HEADLINE: f64 = 30.0;

const STYLE: &str = "\
<style>
.paper{fill:#ffffff}.area{fill:#f7f8fa}text{fill:#24292f;font-family:system-ui,'DejaVu Sans',sans-serif}
.grid{stroke:#d8dde3}.frame{stroke:#8c959f;fill:none}line,path{fill:none;stroke-width:1.5}
.grid,.frame{stroke-width:1}
.grey{stroke:#57606a}.orange{stroke:#bc4c00}.blue{stroke:#0969da}.green{stroke:#1a7f37}.purple{stroke:#8250df}
.band{stroke:none;fill:#8c959f;fill-opacity:.25}.dashed{stroke-dasharray:6 4}.strong{stroke-width:2.2}
@media (prefers-color-scheme:dark){
.paper{fill:#0d1117}.area{fill:#161b22}text{fill:#d0d7de}.grid{stroke:#30363d}.frame{stroke:#6e7681}
.grey{stroke:#b1bac4}.orange{stroke:#f0883e}.blue{stroke:#58a6ff}.green{stroke:#3fb950}.purple{stroke:#d2a8ff}
.band{fill:#8b949e}}
</style>
";

/// An axis: linear or logarithmic, with its marks.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    from: f64,
    to: f64,
    is_log: bool,
    label: &'static str,
    marks: Vec<f64>,
}

/// A curve, or what lies below it.
#[derive(Clone, Debug)]
pub(crate) struct Series {
    pub(crate) class: &'static str,
    pub(crate) label: &'static str,
    pub(crate) points: Vec<(f64, f64)>,
}

/// One chart.
#[derive(Clone, Debug)]
pub(crate) struct Panel {
    pub(crate) title: String,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    pub(crate) series: Vec<Series>,
}

impl Axis {
    /// Marks at whole multiples of `step`.
    pub(crate) fn linear(label: &'static str, from: f64, to: f64, step: f64) -> Self {
        let count = ((to - from) / step).round() as usize;
        let marks = (0..=count).map(|i| from + step * i as f64).collect();
        Axis { from, to, is_log: false, label, marks }
    }

    /// Marks at these values.
    pub(crate) fn log(label: &'static str, from: f64, to: f64, marks: &[f64]) -> Self {
        Axis { from, to, is_log: true, label, marks: marks.to_vec() }
    }

    /// Marks at the powers of ten.
    pub(crate) fn decades(label: &'static str, from: i32, to: i32) -> Self {
        let marks: Vec<f64> = (from..=to).map(|power| 10_f64.powi(power)).collect();
        Axis::log(label, marks[0], marks[marks.len() - 1], &marks)
    }

    /// 0 at the start, 1 at the end.
    fn share(&self, value: f64) -> f64 {
        if self.is_log {
            (value.max(1e-300) / self.from).ln() / (self.to / self.from).ln()
        } else {
            (value - self.from) / (self.to - self.from)
        }
    }
}

/// A number as people write it.
fn plain(value: f64) -> String {
    if value != 0.0 && value.abs() < 0.001 {
        return format!("10<tspan dy=\"-5\" font-size=\"9\">{:.0}</tspan>", value.log10());
    }
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Rows of panels, each under its headline.
pub(crate) fn picture(name: &str, rows: &[(String, Vec<Panel>)]) -> String {
    let columns = rows.iter().map(|(_, panels)| panels.len()).max().unwrap_or(0) as f64;
    let width = columns * (LEFT + AREA.0 + RIGHT);
    let row_height = TOP + AREA.1 + BOTTOM;
    let headlines = rows.iter().filter(|(headline, _)| !headline.is_empty()).count() as f64;
    let height = rows.len() as f64 * row_height + headlines * HEADLINE;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" \
         height=\"{height:.0}\" viewBox=\"0 0 {width:.0} {height:.0}\" \
         font-size=\"12\" role=\"img\" aria-label=\"{name}\">\n{STYLE}\
         <rect class=\"paper\" width=\"100%\" height=\"100%\"/>\n\
         <clipPath id=\"area\"><rect width=\"{}\" height=\"{}\"/></clipPath>\n",
        AREA.0, AREA.1
    );
    let mut top = 0.0;
    for (headline, panels) in rows {
        // writing to a String cannot fail
        if !headline.is_empty() {
            let _ = writeln!(
                svg,
                "<text x=\"14\" y=\"{:.0}\" font-size=\"15\" font-weight=\"600\">{headline}</text>",
                top + 22.0
            );
            top += HEADLINE;
        }
        for (column, panel) in panels.iter().enumerate() {
            let left = column as f64 * (LEFT + AREA.0 + RIGHT) + LEFT;
            let _ = writeln!(svg, "<g transform=\"translate({left:.0} {:.0})\">", top + TOP);
            panel.draw(&mut svg);
            svg += "</g>\n";
        }
        top += row_height;
    }
    svg + "</svg>\n"
}

impl Panel {
    fn draw(&self, svg: &mut String) {
        let (w, h) = AREA;
        let _ = writeln!(svg, "<rect class=\"area\" width=\"{w}\" height=\"{h}\"/>");
        self.draw_marks(svg);
        svg.push_str("<g clip-path=\"url(#area)\">\n");
        for series in &self.series {
            self.draw_series(svg, series);
        }
        let _ = writeln!(svg, "</g>\n<rect class=\"frame\" width=\"{w}\" height=\"{h}\"/>");
        let _ = writeln!(
            svg,
            "<text y=\"-42\" font-weight=\"600\">{}</text>\n\
             <text x=\"{:.0}\" y=\"{:.0}\" text-anchor=\"middle\">{}</text>\n\
             <text transform=\"translate(-46 {:.0}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            self.title,
            w / 2.0,
            h + 36.0,
            self.x.label,
            h / 2.0,
            self.y.label
        );
        self.draw_legend(svg);
    }

    fn draw_marks(&self, svg: &mut String) {
        let (w, h) = AREA;
        for mark in &self.x.marks {
            let x = w * self.x.share(*mark);
            let text = plain(*mark);
            let _ = writeln!(
                svg,
                "<line class=\"grid\" x1=\"{x:.1}\" x2=\"{x:.1}\" y2=\"{h}\"/>\
                 <text x=\"{x:.1}\" y=\"{:.0}\" text-anchor=\"middle\" font-size=\"11\">{text}</text>",
                h + 16.0
            );
        }
        for mark in &self.y.marks {
            let y = h * (1.0 - self.y.share(*mark));
            let text = plain(*mark);
            let _ = writeln!(
                svg,
                "<line class=\"grid\" x2=\"{w}\" y1=\"{y:.1}\" y2=\"{y:.1}\"/>\
                 <text x=\"-6\" y=\"{:.1}\" text-anchor=\"end\" font-size=\"11\">{text}</text>",
                y + 4.0
            );
        }
    }

    fn draw_series(&self, svg: &mut String, series: &Series) {
        let (w, h) = AREA;
        let place = |(x, y): &(f64, f64)| {
            let y = h * (1.0 - self.y.share(*y).clamp(-0.1, 1.1));
            format!("{:.1} {y:.1}", w * self.x.share(*x))
        };
        let points: Vec<String> = series.points.iter().map(place).collect();
        let mut path = format!("M{}", points.join("L"));
        if let ("band", Some(first), Some(last)) =
            (series.class, series.points.first(), series.points.last())
        {
            let (first, last) = (w * self.x.share(first.0), w * self.x.share(last.0));
            let _ = write!(path, "L{last:.1} {h}L{first:.1} {h}Z");
        }
        let _ = writeln!(svg, "<path class=\"{}\" d=\"{path}\"/>", series.class);
    }

    fn draw_legend(&self, svg: &mut String) {
        // two lines of it fit above the frame
        let columns = self.series.len().div_ceil(2).max(2);
        for (index, series) in self.series.iter().enumerate() {
            let x = (index % columns) as f64 * AREA.0 / columns as f64;
            let y = -24.0 + (index / columns) as f64 * 15.0;
            let sample = if series.class == "band" {
                format!(
                    "<rect class=\"band\" x=\"{x}\" y=\"{:.0}\" width=\"20\" height=\"9\"/>",
                    y - 9.0
                )
            } else {
                let (y, end) = (y - 4.0, x + 20.0);
                format!(
                    "<line class=\"{}\" x1=\"{x}\" x2=\"{end}\" y1=\"{y}\" y2=\"{y}\"/>",
                    series.class
                )
            };
            let _ = writeln!(
                svg,
                "{sample}<text x=\"{:.0}\" y=\"{y}\" font-size=\"11\">{}</text>",
                x + 26.0,
                series.label
            );
        }
    }
}
