//! The panel of the track over ground.

use insd_base::{Geodetic, earth};
use kuva::plot::{LinePlot, ScatterPlot};
use kuva::prelude::*;
use nalgebra::Vector3;

use super::decimate::thinned;
use super::panel::{Panel, SOLUTION, TRUTH, styled};

const POINTS: usize = 4000;

/// True and computed track, east and north of the first true position.
pub(super) fn panel(nav: &[Geodetic], truth: &[Geodetic]) -> Panel {
    let origin = truth.first().or(nav.first()).copied().unwrap_or_default();
    let true_track: Vec<_> = truth.iter().map(|row| east_north(&origin, row)).collect();
    let track: Vec<_> = nav.iter().map(|row| east_north(&origin, row)).collect();
    let (true_track, track) = (thinned(&true_track, POINTS), thinned(&track, POINTS));
    let (unit, metres) = unit(&true_track);
    let scaled = |points: &[(f64, f64)]| -> Vec<(f64, f64)> {
        points.iter().map(|(east, north)| (east / metres, north / metres)).collect()
    };
    let start: Vec<_> = scaled(&true_track).into_iter().take(1).collect();
    let line = |points, color: &str, width, name: &str| {
        LinePlot::new()
            .with_data(points)
            .with_color(color)
            .with_stroke_width(width)
            .with_legend(name)
    };
    let plots: Vec<Plot> = vec![
        line(scaled(&true_track), TRUTH, 3.0, "truth").into(),
        line(scaled(&track), SOLUTION, 1.3, "solution").into(),
        ScatterPlot::new()
            .with_data(start)
            .with_color(TRUTH)
            .with_size(5.0)
            .with_legend("start")
            .into(),
    ];
    let layout = styled(Layout::auto_from_plots(&plots))
        .with_title("track")
        .with_x_label(format!("east, {unit}"))
        .with_y_label(format!("north, {unit}"))
        .with_equal_aspect();
    Panel { plots, layout }
}

/// Position east and north of an origin, m, in the plane that touches the Earth there.
fn east_north(origin: &Geodetic, point: &Geodetic) -> (f64, f64) {
    let offset: Vector3<f64> = earth::ecef(point).0 - earth::ecef(origin).0;
    let ned = earth::c_ne(origin) * offset;
    (ned.y, ned.x)
}

/// Kilometres for voyages, metres for ships at the berth.
fn unit(track: &[(f64, f64)]) -> (&'static str, f64) {
    let reach = track.iter().map(|(east, north)| east.abs().max(north.abs())).fold(0.0, f64::max);
    if reach > 2000.0 { ("km", 1000.0) } else { ("m", 1.0) }
}
