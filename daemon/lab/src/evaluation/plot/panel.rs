//! Panels over time: errors within their claimed bands, innovations.

use std::collections::BTreeMap;
use std::sync::Arc;

use kuva::plot::{BandPlot, LinePlot, ScatterPlot};
use kuva::prelude::*;

use super::super::component::Component;
use super::super::errors::{EpochError, VoyageErrors};
use super::super::innovation::InnovationRow;
use super::super::statistics::{mean, quantile};
use super::decimate::{extremes, thinned};
use crate::table::significant;

pub(super) const SOLUTION: &str = "#1f5fa8";
pub(super) const TRUTH: &str = "#4d4d4d";
const BAND: &str = "#8fb4dc";
pub(super) const REJECTED: &str = "#c62828";
const AIDS: [&str; 6] = ["#1f5fa8", "#2e7d32", "#ef8a17", "#6a4c93", "#00838f", "#8d6e63"];
/// Innovations beyond so many sigmas are drawn at the border.
pub(super) const INNOVATION_LIMIT: f64 = 6.0;
const POINTS_PER_AID: usize = 3000;

/// One cell of the figure.
pub(super) struct Panel {
    pub(super) plots: Vec<Plot>,
    pub(super) layout: Layout,
}

/// The time axis that all panels share.
#[derive(Clone, Copy, Debug)]
pub(super) struct TimeAxis {
    unit: &'static str,
    seconds: f64,
    from: f64,
    to: f64,
}

impl TimeAxis {
    pub(super) fn covering(epochs: &[EpochError]) -> Self {
        let at = |epoch: Option<&EpochError>| epoch.map_or(0.0, |epoch| epoch.time.as_seconds());
        Self::between(at(epochs.first()), at(epochs.last()))
    }

    /// From one instant to another, s.
    pub(super) fn between(first: f64, last: f64) -> Self {
        let (unit, seconds) = match last - first {
            length if length > 5.0 * 3600.0 => ("h", 3600.0),
            length if length > 600.0 => ("min", 60.0),
            _ => ("s", 1.0),
        };
        let from = first / seconds;
        TimeAxis { unit, seconds, from, to: (last / seconds).max(from + 1e-3) }
    }

    /// Whether an instant is on it.
    pub(super) fn holds(&self, seconds: f64) -> bool {
        (self.from..=self.to).contains(&self.of(seconds))
    }

    pub(super) fn of(&self, seconds: f64) -> f64 {
        seconds / self.seconds
    }

    pub(super) fn layout(&self, plots: &[Plot], title: &str, limits: (f64, f64)) -> Layout {
        styled(Layout::auto_from_plots(plots))
            .with_title(title)
            .with_x_label(format!("time, {}", self.unit))
            .with_x_axis_min(self.from)
            .with_x_axis_max(self.to)
            .with_y_axis_min(limits.0)
            .with_y_axis_max(limits.1)
    }
}

/// What all panels have in common.
pub(super) fn styled(layout: Layout) -> Layout {
    layout
        .with_title_size(15)
        .with_label_size(13)
        .with_tick_size(12)
        .with_body_size(12)
        .with_ticks(6)
        .with_tick_format(TickFormat::Custom(Arc::new(plain)))
        .with_box_axes()
}

/// A tick without exponent and without needless zeros.
fn plain(value: f64) -> String {
    let text = format!("{value:.6}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" { "0".to_owned() } else { short.to_owned() }
}

/// Error of one component within its claimed 3-sigma band; `None` where truth knows nothing.
pub(super) fn error(errors: &VoyageErrors, component: Component, axis: TimeAxis) -> Option<Panel> {
    let scale = component.scale();
    let point = |epoch: &EpochError| {
        let (error, sigma) = (epoch.of(component)?, epoch.sigma_of(component));
        Some((axis.of(epoch.time.as_seconds()), error * scale, 3.0 * sigma * scale))
    };
    let points: Vec<_> = errors.epochs.iter().filter_map(point).collect();
    if points.is_empty() {
        return None;
    }
    let limit = limit(&points);
    let plots = curves(&points, -limit, limit);
    let (name, unit) = (component.name().replace('_', " "), component.unit().as_str());
    let kind = if unit == "m" { "position " } else { "" };
    let title = title(&format!("{kind}{name}"), unit, &points);
    let layout = axis.layout(&plots, &title, (-limit, limit)).with_y_label(unit);
    Some(Panel { plots, layout })
}

/// Horizontal distance from truth below its claimed 3-sigma radius.
pub(super) fn horizontal(errors: &VoyageErrors, axis: TimeAxis) -> Panel {
    let point = |epoch: &EpochError| {
        let time = axis.of(epoch.time.as_seconds());
        Some((time, epoch.horizontal()?, 3.0 * epoch.horizontal_sigma()))
    };
    let points: Vec<_> = errors.epochs.iter().filter_map(point).collect();
    let limit = limit(&points);
    let plots = curves(&points, 0.0, limit);
    let title = title("horizontal position", "m", &points);
    let layout = axis.layout(&plots, &title, (0.0, limit)).with_y_label("m");
    Panel { plots, layout }
}

fn title(name: &str, unit: &str, points: &[(f64, f64, f64)]) -> String {
    let largest = points.iter().map(|(_, error, _)| error.abs()).fold(0.0, f64::max);
    let (rms, largest) = (significant(rms(points), 3), significant(largest, 3));
    format!("{name}: RMS {rms} {unit}, largest {largest} {unit}")
}

/// Half the height of a panel: room for nearly all errors and bands, but neither for the first
/// moments of an alignment, when the claims are as wide as the world, nor for claims so wide that
/// the errors would look like zero.
fn limit(points: &[(f64, f64, f64)]) -> f64 {
    let mut errors: Vec<f64> = points.iter().map(|(_, error, _)| error.abs()).collect();
    let mut bands: Vec<f64> = points.iter().map(|(_, _, band)| *band).collect();
    errors.sort_by(f64::total_cmp);
    bands.sort_by(f64::total_cmp);
    let wide = quantile(&errors, 0.999).max(quantile(&bands, 0.97));
    let typical = 25.0 * quantile(&errors, 0.5).max(quantile(&bands, 0.5));
    (1.15 * wide.min(typical).min(20.0 * rms(points))).max(1e-9)
}

fn rms(points: &[(f64, f64, f64)]) -> f64 {
    mean(points.iter().map(|(_, error, _)| error * error)).sqrt()
}

/// Band and error, cut at the borders of the panel.
fn curves(points: &[(f64, f64, f64)], low: f64, high: f64) -> Vec<Plot> {
    let bands: Vec<_> = points.iter().map(|(t, _, band)| (*t, band.min(high))).collect();
    let bands = extremes(&bands);
    let times = bands.iter().map(|(t, _)| *t);
    let upper = bands.iter().map(|(_, band)| *band);
    let lower = bands.iter().map(|(_, band)| (-*band).max(low));
    let band = BandPlot::new(times, lower, upper).with_color(BAND).with_opacity(0.45);
    let errors: Vec<_> = points.iter().map(|(t, error, _)| (*t, error.clamp(low, high))).collect();
    let line =
        LinePlot::new().with_data(extremes(&errors)).with_color(SOLUTION).with_stroke_width(1.1);
    vec![band.into(), line.into()]
}

/// Innovations over their predicted sigma, by aid, with rejected ones in red. Satellites have a panel of their own.
pub(super) fn innovations(rows: &[InnovationRow], axis: TimeAxis) -> Option<Panel> {
    let mut by_aid: BTreeMap<&str, Vec<(f64, f64)>> = BTreeMap::new();
    let mut rejected = Vec::new();
    let of_ship = rows.iter().filter(|row| !row.is_of_satellite() && axis.holds(row.t_s));
    for row in of_ship.filter(|row| row.sigma > 0.0 && row.innovation.is_finite()) {
        let time = axis.of(row.t_s);
        let ratio = (row.innovation / row.sigma).clamp(-INNOVATION_LIMIT, INNOVATION_LIMIT);
        if row.accepted {
            by_aid.entry(&row.aid).or_default().push((time, ratio));
        } else {
            rejected.push((time, ratio));
        }
    }
    if by_aid.is_empty() && rejected.is_empty() {
        return None;
    }
    let dots = |points: &[(f64, f64)], color: &str, size: f64, name: String| {
        let points = thinned(points, POINTS_PER_AID);
        ScatterPlot::new().with_data(points).with_color(color).with_size(size).with_legend(name)
    };
    let aids = by_aid.iter().zip(AIDS.iter().cycle());
    let mut plots: Vec<Plot> = aids
        .map(|((aid, points), color)| dots(points, color, 1.3, aid.replace('_', " ")).into())
        .collect();
    if !rejected.is_empty() {
        plots.push(dots(&rejected, REJECTED, 2.2, "rejected".to_owned()).into());
    }
    let limits = (-INNOVATION_LIMIT, INNOVATION_LIMIT);
    let line = |y| ReferenceLine::horizontal(y).with_color(TRUTH);
    let layout = axis
        .layout(&plots, "innovations over their predicted sigma", limits)
        .with_y_label("innovation / sigma")
        .with_reference_line(line(3.0))
        .with_reference_line(line(-3.0));
    Some(Panel { plots, layout })
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::Time;

    #[test]
    fn the_time_axis_covers_the_epochs_in_its_unit() {
        let epoch =
            |t| EpochError { time: Time::from_seconds(t), error: [None; 9], sigma: [0.0; 9] };
        let axis = TimeAxis::covering(&[epoch(300.0), epoch(1800.0)]);
        assert_eq!((axis.unit, axis.from, axis.to), ("min", 5.0, 30.0));
    }

    #[test]
    fn ticks_are_plain_numbers() {
        assert_eq!(plain(-0.0025), "-0.0025");
        assert_eq!(plain(1e-9), "0");
        assert_eq!(plain(-1e-9), "0");
        assert_eq!(plain(150.0), "150");
    }
}
