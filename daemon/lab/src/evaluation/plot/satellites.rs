//! Panels of satellites: where they stood, what each told beside what was expected, and what their number does to the position.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use kuva::plot::annotations::TextAnnotation;
use kuva::plot::{LinePlot, ScatterPlot};
use kuva::prelude::*;

use super::super::by_satellites::WithSatellites;
use super::super::errors::EpochError;
use super::super::innovation::InnovationRow;
use super::super::sky::SkyRow;
use super::decimate::thinned;
use super::panel::{INNOVATION_LIMIT, Panel, REJECTED, SOLUTION, TRUTH, TimeAxis, styled};

const PHASE: &str = "#2e7d32";
const RATE: &str = "#ef8a17";
const FAINT: &str = "#b9c6d6";
const GRID: &str = "#cfcfcf";
/// Elevations of the circles, deg.
const CIRCLES: [f64; 3] = [0.0, 30.0, 60.0];
/// Half the width of the sky, deg from the zenith: room for the names of the horizon.
const SKY: f64 = 106.0;
/// Points of one kind in a panel.
const POINTS: usize = 6000;
/// Errors are drawn from here on, m: the scale is logarithmic.
const SMALLEST: f64 = 1e-3;

/// A point of the sky, deg from the zenith, east and north.
fn placed(azimuth: f64, elevation: f64) -> (f64, f64) {
    let (away, azimuth) = (90.0 - elevation, azimuth.to_radians());
    (away * azimuth.sin(), away * azimuth.cos())
}

/// Where the satellites stood, and whether they were used; `None` where no direction is known.
pub(super) fn sky(rows: &[SkyRow], axis: TimeAxis) -> Option<Panel> {
    let (mut used, mut judged, mut idle) = (Vec::new(), Vec::new(), Vec::new());
    let mut last: BTreeMap<&str, (f64, f64)> = BTreeMap::new();
    for row in rows.iter().filter(|row| axis.holds(row.t_s)) {
        let (Some(azimuth), Some(elevation)) = (row.azimuth_deg, row.elevation_deg) else {
            continue;
        };
        if elevation < 0.0 {
            continue;
        }
        let point = placed(azimuth, elevation);
        let own = match row.state.as_str() {
            "left_out" => &mut judged,
            _ if row.is_used() => &mut used,
            _ => &mut idle,
        };
        own.push(point);
        last.insert(&row.satellite, point);
    }
    if last.is_empty() {
        return None;
    }
    let mut plots: Vec<Plot> = CIRCLES.iter().map(|elevation| circle(*elevation)).collect();
    plots.extend(spokes());
    for (points, color, size, name) in [
        (idle, FAINT, 1.6, "not used"),
        (used, SOLUTION, 1.8, "used"),
        (judged, REJECTED, 2.4, "left out"),
    ] {
        plots.extend(dots(&points, color, size, name));
    }
    let ends: Vec<_> = last.values().copied().collect();
    plots.push(ScatterPlot::new().with_data(ends).with_color(TRUTH).with_size(3.0).into());
    let layout = last.iter().fold(sky_layout(&plots), |layout, (name, (x, y))| {
        layout.with_annotation(note(name, *x, *y + 5.0, TRUTH, 11))
    });
    Some(Panel { plots, layout })
}

fn sky_layout(plots: &[Plot]) -> Layout {
    let names = [("N", 0.0), ("E", 90.0), ("S", 180.0), ("W", 270.0)];
    let layout = styled(Layout::auto_from_plots(plots))
        .with_title("sky: tracks, names where they end")
        .with_x_axis_min(-SKY)
        .with_x_axis_max(SKY)
        .with_y_axis_min(-SKY)
        .with_y_axis_max(SKY)
        .with_show_grid(false)
        .with_tick_format(TickFormat::Custom(Arc::new(|_| String::new())))
        .with_tick_length(0.0)
        .with_equal_aspect();
    let layout = names.iter().fold(layout, |layout, (name, azimuth)| {
        let (x, y) = placed(*azimuth, -7.0);
        layout.with_annotation(note(name, x, y - 3.0, TRUTH, 13))
    });
    CIRCLES.iter().skip(1).fold(layout, |layout, elevation| {
        let (x, y) = placed(15.0, *elevation);
        layout.with_annotation(note(&format!("{elevation}°"), x, y, TRUTH, 10))
    })
}

fn note(text: &str, x: f64, y: f64, color: &str, size: u32) -> TextAnnotation {
    TextAnnotation::new(text, x, y).with_color(color).with_font_size(size)
}

fn circle(elevation: f64) -> Plot {
    let points: Vec<_> = (0..=120).map(|at| placed(f64::from(at) * 3.0, elevation)).collect();
    line(points, GRID, 1.0).into()
}

fn spokes() -> impl Iterator<Item = Plot> {
    [0.0, 90.0].into_iter().map(|azimuth| {
        let across = vec![placed(azimuth, 0.0), placed(azimuth + 180.0, 0.0)];
        line(across, GRID, 1.0).into()
    })
}

fn line(points: Vec<(f64, f64)>, color: &str, width: f64) -> LinePlot {
    LinePlot::new().with_data(points).with_color(color).with_stroke_width(width)
}

fn dots(points: &[(f64, f64)], color: &str, size: f64, name: &str) -> Option<Plot> {
    let points = thinned(points, POINTS);
    let is_there = !points.is_empty();
    let plot = ScatterPlot::new().with_data(points).with_color(color).with_size(size);
    is_there.then(|| plot.with_legend(name).into())
}

/// What each satellite told beside what was expected, over the sigma of that, a lane for each; `None` where none did.
pub(super) fn residuals(rows: &[InnovationRow], axis: TimeAxis) -> Option<Panel> {
    let own = |row: &&InnovationRow| {
        let is_sound = row.sigma > 0.0 && row.innovation.is_finite();
        row.is_of_satellite() && is_sound && axis.holds(row.t_s)
    };
    let rows: Vec<_> = rows.iter().filter(own).collect();
    let names: BTreeSet<&str> = rows.iter().map(|row| row.component.as_str()).collect();
    let names: Vec<String> = names.into_iter().rev().map(str::to_owned).collect();
    if names.is_empty() {
        return None;
    }
    let kinds = [
        ("satellite_code", "code", SOLUTION, 1.1),
        ("satellite_phase", "phase", PHASE, 1.1),
        ("satellite_rate", "range rate", RATE, 1.1),
    ];
    let of = |aid: &str, accepted: bool| -> Vec<(f64, f64)> {
        let own = rows.iter().filter(|row| row.accepted == accepted);
        let own = own.filter(|row| !accepted || row.aid == aid);
        own.filter_map(|row| {
            let lane = names.iter().position(|name| *name == row.component)?;
            let sigmas = (row.innovation / row.sigma).clamp(-INNOVATION_LIMIT, INNOVATION_LIMIT);
            Some((axis.of(row.t_s), lane as f64 + 0.5 * sigmas / INNOVATION_LIMIT))
        })
        .collect()
    };
    let mut plots: Vec<Plot> = kinds
        .iter()
        .filter_map(|(aid, name, color, size)| dots(&of(aid, true), color, *size, name))
        .collect();
    plots.extend(dots(&of("", false), REJECTED, 1.8, "left out"));
    let limits = (-0.7, names.len() as f64 - 0.3);
    let (lanes, named) = (names.len(), names.clone());
    let layout = axis
        .layout(
            &plots,
            "innovations of satellites over their predicted sigma: a lane is ±6σ",
            limits,
        )
        .with_y_tick_step(1.0)
        .with_y_tick_format(TickFormat::Custom(Arc::new(move |at| lane_name(&named, at))));
    let layout = (0..lanes).fold(layout, |layout, lane| {
        let middle = ReferenceLine::horizontal(lane as f64).with_color(GRID).with_dasharray("");
        layout.with_reference_line(middle.with_stroke_width(0.8))
    });
    Some(Panel { plots, layout })
}

/// The satellite of a lane, at its middle.
fn lane_name(names: &[String], at: f64) -> String {
    let is_lane = at >= 0.0 && (at - at.round()).abs() < 1e-6;
    let name = is_lane.then(|| names.get(at.round() as usize)).flatten();
    name.cloned().unwrap_or_default()
}

/// The horizontal error and its claim by the number of satellites in use; `None` where no number is known.
pub(super) fn by_number(
    epochs: &BTreeMap<u32, Vec<EpochError>>,
    figures: &[WithSatellites],
) -> Option<Panel> {
    let most = epochs.keys().last()?;
    let at = |count: u32, value: f64| (f64::from(count), value.max(SMALLEST));
    let each: Vec<(f64, f64)> = epochs
        .iter()
        .flat_map(|(count, own)| own.iter().map(|epoch| (*count, epoch)))
        .filter_map(|(count, epoch)| Some(at(count, epoch.horizontal()?)))
        .collect();
    let of = |value: fn(&WithSatellites) -> f64| -> Vec<(f64, f64)> {
        figures.iter().map(|own| at(own.satellites, value(own))).collect()
    };
    let (rms, claims) = (of(|own| own.horizontal.rms), of(|own| own.horizontal.mean_sigma));
    let all = each.iter().chain(&claims).map(|(_, value)| *value);
    let (low, high) = all.fold((f64::MAX, SMALLEST), |(low, high), v| (low.min(v), high.max(v)));
    let mut plots: Vec<Plot> = Vec::new();
    plots.extend(dots(&each, FAINT, 1.5, "each epoch"));
    plots.extend(dots(&claims, TRUTH, 5.0, "claimed σ"));
    plots.extend(dots(&rms, SOLUTION, 5.0, "RMS error"));
    let layout = styled(Layout::auto_from_plots(&plots))
        .with_title("horizontal position by satellites in use")
        .with_x_label("satellites in use")
        .with_y_label("m")
        .with_log_y()
        .with_x_tick_step(if *most < 30 { 1.0 } else { 5.0 })
        .with_x_axis_min(-0.5)
        .with_x_axis_max(f64::from(*most) + 0.5)
        .with_y_axis_min(low / 1.5)
        .with_y_axis_max(high * 1.5);
    Some(Panel { plots, layout })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn north_is_up_and_east_is_right() {
        let (x, y) = placed(0.0, 0.0);
        assert!(x.abs() < 1e-9 && (y - 90.0).abs() < 1e-9);
        let (x, y) = placed(90.0, 60.0);
        assert!((x - 30.0).abs() < 1e-9 && y.abs() < 1e-9);
    }

    #[test]
    fn a_lane_has_its_name_in_its_middle_and_nowhere_else() {
        let names = ["G07".to_owned(), "E11".to_owned()];
        assert_eq!(lane_name(&names, 1.0), "E11");
        assert_eq!(lane_name(&names, 0.5) + &lane_name(&names, 2.0) + &lane_name(&names, -1.0), "");
    }
}
