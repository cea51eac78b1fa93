//! The Stanford chart, and levels and errors over time.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::bail;
use kuva::plot::{BandPlot, LinePlot, ScatterPlot};
use kuva::prelude::*;
use kuva::render::figure::Figure;
use kuva::render::render::Scene;

use super::super::stanford::{IntegrityReport, LevelsOfAxis, StanfordPoint, Tally};
use super::decimate::extremes;
use super::panel::{Panel, SOLUTION, TRUTH, TimeAxis, styled};
use super::write;
use crate::table::significant;

const CHART: f64 = 620.0;
const STRIP: f64 = 300.0;
/// Cells of the chart in a decade.
const PER_DECADE: f64 = 24.0;
/// Errors and levels beyond these are drawn at the border, m.
const WORLD: (f64, f64) = (1e-3, 1e6);
/// Colour and size of a cell that holds so many epochs or fewer.
const DENSITY: [(u64, &str, f64, &str); 4] = [
    (9, "#a9c4e4", 2.6, "1 to 9 epochs"),
    (99, "#5f93cb", 2.8, "10 to 99"),
    (999, "#1f5fa8", 3.0, "100 to 999"),
    (u64::MAX, "#0b2545", 3.2, "1000 and more"),
];
const LEVEL: &str = "#ef8a17";
const UNAVAILABLE: &str = "#9aa5b1";
const MISLEADING: &str = "#f2b441";
const HAZARDOUS: &str = "#d64545";

/// What is drawn.
#[derive(Clone, Copy, Debug)]
pub struct StanfordChart<'a> {
    /// Title above all panels.
    pub title: &'a str,
    /// Errors and levels.
    pub report: &'a IntegrityReport,
}

impl StanfordChart<'_> {
    /// Draws to a `.png` or `.svg` file.
    ///
    /// # Errors
    /// Another ending, nothing to draw, or a file that cannot be written.
    pub fn draw(&self, file: &Path) -> anyhow::Result<()> {
        if self.report.horizontal.points.is_empty() {
            bail!("nothing to draw: solution and truth have no common time");
        }
        write(&self.scene(), file)
    }

    /// A chart for each axis, and below it levels and errors over time.
    fn scene(&self) -> Scene {
        let report = self.report;
        let axis = TimeAxis::between(report.from_s, report.to_s);
        let axes =
            [("horizontal", Some(&report.horizontal)), ("vertical", report.vertical.as_ref())];
        let axes: Vec<(&str, &LevelsOfAxis)> =
            axes.into_iter().filter_map(|(name, own)| Some((name, own?))).collect();
        let charts = axes.iter().map(|(name, own)| chart(name, own));
        let strips = axes.iter().map(|(name, own)| strip(name, own, axis));
        let (plots, layouts): (Vec<_>, Vec<_>) =
            charts.chain(strips).map(|Panel { plots, layout }| (plots, layout)).unzip();
        let columns = axes.len();
        let requirement = report.alert_limit.requirement;
        let title =
            requirement.map_or(self.title.to_owned(), |own| format!("{}: {own}", self.title));
        Figure::new(2, columns)
            .with_title(title)
            .with_title_size(20)
            .with_plots(plots)
            .with_layouts(layouts)
            .with_cell_size(CHART, CHART)
            .with_row_height(1, STRIP)
            .with_spacing(14.0)
            .render()
    }
}

/// Both axes of a chart: whole decades that hold nearly all errors, all levels and the limit.
fn range(own: &LevelsOfAxis) -> (f64, f64) {
    let mut errors: Vec<f64> = own.points.iter().map(|point| point.error).collect();
    errors.sort_by(f64::total_cmp);
    let levels = || own.points.iter().filter_map(|point| point.level);
    let small = super::quantile(&errors, 0.02).min(levels().fold(0.01 * own.limit_m, f64::min));
    let large = levels().chain(errors.last().copied()).fold(10.0 * own.limit_m, f64::max);
    let decade = |value: f64, round: fn(f64) -> f64| 10_f64.powf(round(value.log10()));
    let low = decade(small.clamp(WORLD.0, WORLD.1), f64::floor);
    let high = decade(large.clamp(WORLD.0, WORLD.1), f64::ceil);
    (low, high)
}

/// Errors across, levels upwards.
fn chart(name: &str, own: &LevelsOfAxis) -> Panel {
    let (low, high) = range(own);
    let limit = own.limit_m;
    let band = |x: [f64; 2], lower: [f64; 2], upper: [f64; 2], color: &str| {
        BandPlot::new(x, lower, upper).with_color(color).with_opacity(0.22)
    };
    let mut plots: Vec<Plot> = vec![
        band([low, high], [limit; 2], [high; 2], UNAVAILABLE).into(),
        band([low, limit], [low; 2], [low, limit], MISLEADING).into(),
        band([limit, high], [low; 2], [limit; 2], HAZARDOUS).into(),
        LinePlot::new()
            .with_data([(low, low), (high, high)])
            .with_color(TRUTH)
            .with_stroke_width(1.2)
            .into(),
    ];
    plots.extend(density(&own.points, (low, high)));
    // where seldom anything lies, in parts of the width and the height
    let part = |value: f64| (value / low).log10() / (high / low).log10();
    let middle = 0.5 * (1.0 + part(limit));
    let words = [
        ("unavailable", &own.unavailable, (0.16, 0.5 * (middle + 1.0)), "#52606d"),
        ("nominal", &own.nominal, (0.16, 0.36_f64.min(0.8 * part(limit))), "#1d6b3a"),
        ("misleading", &own.misleading, (0.33, 0.12), "#8a5a00"),
        ("hazardous", &own.hazardous, (middle, 0.2), "#9b1c1c"),
    ];
    let layout = styled(Layout::auto_from_plots(&plots))
        .with_title(format!("{name}: error against level, alert limit {limit} m"))
        .with_x_label("error, m")
        .with_y_label("protection level, m")
        .with_log_scale()
        .with_x_axis_min(low)
        .with_x_axis_max(high)
        .with_y_axis_min(low)
        .with_y_axis_max(high)
        .with_legend_position(LegendPosition::OutsideBottomColumns);
    let at = |part: f64| low * (high / low).powf(part);
    let line = |text: String, (x, y): (f64, f64), color: &str| {
        TextAnnotation::new(text, at(x), at(y)).with_color(color).with_font_size(13)
    };
    let layout = words.into_iter().fold(layout, |layout, (what, tally, (x, y), color)| {
        layout.with_annotation(line(what.to_owned(), (x, y), color)).with_annotation(line(
            told(tally),
            (x, y - 0.04),
            color,
        ))
    });
    Panel { plots, layout }
}

/// `12.3 %`, or nothing seen and what that allows.
fn told(tally: &Tally) -> String {
    if tally.epochs == 0 {
        return format!("0 (below {} %)", significant(100.0 * tally.high, 2));
    }
    format!("{} %", significant(100.0 * tally.share, 3))
}

/// The cells of the chart that hold epochs, by how many.
fn density(points: &[StanfordPoint], (low, high): (f64, f64)) -> Vec<Plot> {
    let cell = |value: f64| (value.clamp(low, high).log10() * PER_DECADE).round() as i64;
    let mut counts: BTreeMap<(i64, i64), u64> = BTreeMap::new();
    for point in points {
        let Some(level) = point.level else { continue };
        *counts.entry((cell(point.error), cell(level))).or_default() += 1;
    }
    let metres = |cell: i64| 10_f64.powf(cell as f64 / PER_DECADE).clamp(low, high);
    let mut least = 1;
    let mut plots = Vec::new();
    for (most, color, size, name) in DENSITY {
        let cells = counts.iter().filter(|(_, count)| (least..=most).contains(*count));
        let dots: Vec<(f64, f64)> = cells.map(|((x, y), _)| (metres(*x), metres(*y))).collect();
        if !dots.is_empty() {
            let dots = ScatterPlot::new().with_data(dots).with_color(color).with_size(size);
            plots.push(dots.with_legend(name).into());
        }
        least = most.saturating_add(1);
    }
    plots
}

/// Level and error over time, with the limit.
fn strip(name: &str, own: &LevelsOfAxis, axis: TimeAxis) -> Panel {
    let (low, high) = range(own);
    let at = |point: &StanfordPoint| axis.of(point.time.as_seconds());
    let errors: Vec<(f64, f64)> =
        own.points.iter().map(|point| (at(point), point.error.clamp(low, high))).collect();
    let level = |point: &StanfordPoint| Some((at(point), point.level?.clamp(low, high)));
    let levels: Vec<(f64, f64)> = own.points.iter().filter_map(level).collect();
    let line = |points: &[(f64, f64)], color: &str, name: &str| {
        LinePlot::new()
            .with_data(extremes(points))
            .with_color(color)
            .with_stroke_width(1.2)
            .with_legend(name)
    };
    let plots: Vec<Plot> =
        vec![line(&errors, SOLUTION, "error").into(), line(&levels, LEVEL, "level").into()];
    let layout = axis
        .layout(&plots, &format!("{name}: error and level over time"), (low, high))
        .with_y_label("m")
        .with_log_y()
        .with_reference_line(
            ReferenceLine::horizontal(own.limit_m).with_color(HAZARDOUS).with_label("alert limit"),
        )
        .with_legend_position(LegendPosition::OutsideBottomColumns);
    Panel { plots, layout }
}
