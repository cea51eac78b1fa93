//! What each method takes the sea for, beside what it meets.

use std::f64::consts::TAU;

use insd_base::units::DEG;
use insd_base::{Geodetic, Span, Time, Truth, Voyage};
use insd_nav::aids::{berth, reference_position, reference_velocity};
use insd_nav::berth::{Moorings, Prefiltered, WhiteNoise, Whitened};
use insd_nav::disturbance::{Model, measured_spectrum};
use insd_nav::error_state::Innovation;
use insd_nav::error_state::{ATTITUDE, POSITION, VELOCITY};
use insd_nav::initial::sensor_covariance;
use insd_nav::{
    Conditioned, Conditioner, Estimator, Filter, InitialState, NavConfig, Nominal, Oscillator,
};
use nalgebra::{Matrix3, Vector2, Vector3};

use crate::svg::{Axis, Panel, Series};

/// What comes before is still settling, s.
const SETTLED: f64 = 300.0;
/// Length of a segment of the measured spectra, s.
const PIECE: usize = 400;
/// Models that come from windows which are still being filled.
const FIRST_MODELS: usize = 4;
/// Frequencies of the model curves.
const POINTS: usize = 240;
/// Lowest and highest frequency that is drawn, Hz.
const BAND: (f64, f64) = (0.003, 0.5);

/// What was measured, what the model foresees of it, and what it does not.
struct Seen {
    /// From sample to sample, s.
    spacing: f64,
    measured: Vec<Vector2<f64>>,
    /// In units of its own sigma.
    residual: Vec<Vector2<f64>>,
    /// One-sided spectral density of one component of what was measured, by frequency, Hz.
    model: Vec<(f64, f64)>,
}

/// One column for each method: spectra above, what is left below.
pub(crate) fn panels(voyage: &Voyage) -> (Vec<Panel>, Vec<Panel>) {
    let columns = [
        ("(a) white_noise: velocity", "white noise", "orange", white(voyage)),
        ("(b) as_published: velocity", "autoregression", "blue", prefiltered(voyage)),
        ("(c) autoregressive: displacement", "autoregression", "purple", whitened(voyage)),
        ("(d) moorings: displacement", "oscillators, waves", "green", moored(voyage)),
    ];
    let above = columns.iter().map(|(title, name, class, seen)| {
        let axis = if title.ends_with("displacement") {
            Axis::decades("m\u{b2}/Hz", -4, 2)
        } else {
            Axis::decades("(m/s)\u{b2}/Hz", -4, 1)
        };
        spectrum(
            title,
            axis,
            vec![
                Series {
                    class: "grey",
                    label: "measured",
                    points: measured(&seen.measured, seen.spacing),
                },
                Series { class, label: name, points: seen.model.clone() },
            ],
        )
    });
    let below = columns.iter().map(|(title, _, class, seen)| {
        let scale = 1.0 / (2.0 * seen.spacing);
        let points =
            measured(&seen.residual, seen.spacing).iter().map(|(f, s)| (*f, s * scale)).collect();
        let title = title.split(':').next().unwrap_or_default().to_owned();
        spectrum(
            &title,
            Axis::decades("density over that of white noise", -3, 2),
            vec![
                Series { class, label: "residual", points },
                Series {
                    class: "grey dashed",
                    label: "white",
                    points: vec![(BAND.0, 1.0), (BAND.1, 1.0)],
                },
            ],
        )
    });
    (above.collect(), below.collect())
}

fn spectrum(title: &str, y: Axis, series: Vec<Series>) -> Panel {
    let x = Axis::log("frequency, Hz", BAND.0, BAND.1, &[0.003, 0.01, 0.03, 0.1, 0.3]);
    Panel { title: title.to_owned(), x, y, series }
}

fn frequencies(highest: f64) -> Vec<f64> {
    let ratio: f64 = highest / BAND.0;
    (0..POINTS).map(|i| BAND.0 * ratio.powf(i as f64 / (POINTS - 1) as f64)).collect()
}

/// One-sided spectral density of one component, mean of both, as it is measured.
fn measured(samples: &[Vector2<f64>], spacing: f64) -> Vec<(f64, f64)> {
    let length = (PIECE as f64 / spacing) as usize;
    let step = 1.0 / (length as f64 * spacing);
    let frequencies: Vec<f64> = (1..length / 2).map(|k| k as f64 * step).collect();
    let both = measured_spectrum(samples, spacing, length, &frequencies);
    both.into_iter().map(|(frequency, density)| (frequency, density / 2.0)).collect()
}

/// A filter that starts from the truth, and does not know it.
fn begin(voyage: &Voyage, truth: &Truth) -> Option<Filter> {
    let config = NavConfig::new(voyage.header.imu, voyage.header.lever_arms);
    let nominal = Nominal::at(&truth.position, &truth.velocity?.0, &truth.attitude?.c_nb());
    let mut covariance = sensor_covariance(&config);
    for (block, std) in [(POSITION, 10.0), (VELOCITY, 0.5), (ATTITUDE, 1.0 * DEG)] {
        block.renew(&mut covariance, &Matrix3::from_diagonal_element(std * std));
    }
    let rate = Vector3::zeros();
    Some(Filter::new(&config, &InitialState::new(truth.time, nominal, covariance, rate)))
}

/// Sails through a voyage with a filter that `hold` is asked to hold after each sample of the IMU.
fn sail(voyage: &Voyage, filter: &mut Filter, mut hold: impl FnMut(&mut Filter)) {
    let mut conditioner = Conditioner::new(&voyage.header.imu);
    for sample in &voyage.imu {
        if let Conditioned::Sample(increment) = conditioner.take(&sample.message) {
            filter.advance(&increment);
            hold(filter);
        }
    }
}

/// Tells when another sample is due.
fn ticker(spacing: f64) -> impl FnMut(Time) -> bool {
    let mut next = Time::START;
    move |now| {
        let is_due = now >= next;
        if is_due {
            next = now + Span::from_seconds(spacing);
        }
        is_due
    }
}

fn is_settled(filter: &Filter) -> bool {
    filter.time() >= Time::from_seconds(SETTLED)
}

/// An innovation in units of its sigma.
fn normalised(filter: &mut Filter, innovation: &Innovation) -> Option<Vector2<f64>> {
    filter.settle();
    let off = innovation.z.component_div(&innovation.weigh(filter.covariance())?.sigma());
    Some(Vector2::new(off[0], off[1]))
}

fn start(voyage: &Voyage) -> Filter {
    let first = voyage.truth.first().and_then(|truth| begin(voyage, truth));
    first.unwrap_or_else(|| unreachable!("a simulated voyage has its truth"))
}

fn white(voyage: &Voyage) -> Seen {
    let mut filter = start(voyage);
    let (mut white, mut is_due) = (WhiteNoise::new(&filter), ticker(1.0));
    let (mut measured, mut residual) = (Vec::new(), Vec::new());
    sail(voyage, &mut filter, |filter| {
        if is_due(filter.time()) && is_settled(filter) {
            let view = filter.view();
            let innovation = reference_velocity::innovation(&view, &Vector2::zeros(), white.std());
            measured.push(view.v_n().xy());
            residual.extend(normalised(filter, &innovation));
        }
        white.hold(filter);
    });
    let density = 2.0 * white.std().powi(2);
    Seen { spacing: 1.0, measured, residual, model: vec![(BAND.0, density), (BAND.1, density)] }
}

/// The model is fitted anew with each estimate: what each leaves of the samples since the one before,
/// and the mean of their spectra.
fn prefiltered(voyage: &Voyage) -> Seen {
    let mut filter = start(voyage);
    let (mut hold, mut is_due) = (Prefiltered::new(&filter), ticker(1.0));
    let (mut measured, mut residual) = (Vec::new(), Vec::new());
    let (mut models, mut since): (Vec<Model>, usize) = (Vec::new(), 0);
    sail(voyage, &mut filter, |filter| {
        let due = is_due(filter.time());
        if due && is_settled(filter) {
            measured.push(filter.view().v_n().xy());
        }
        hold.hold(filter);
        since += usize::from(due);
        let newest = hold.model().filter(|model| models.last() != Some(*model));
        if let Some(model) = newest {
            if is_settled(filter) {
                let samples: Vec<Vector2<f64>> = hold.window().samples().copied().collect();
                residual.extend(unforeseen(&samples, model, since));
            }
            models.push(model.clone());
            since = 0;
        }
    });
    let model = mean_spectrum(&models[FIRST_MODELS.min(models.len())..], BAND.1);
    Seen { spacing: 1.0, measured, residual, model }
}

/// Mean of the spectra of one component of some models, up to a frequency.
fn mean_spectrum(models: &[Model], highest: f64) -> Vec<(f64, f64)> {
    let density = |f: f64| {
        let each = models.iter().filter_map(|model| Some(model.spectrum(f)?.trace().re / 2.0));
        (f, each.sum::<f64>() / models.len() as f64)
    };
    frequencies(highest).into_iter().map(density).collect()
}

/// The berth of a voyage and the displacement from it that is stated, 1-sigma, m.
fn berth_of(voyage: &Voyage) -> Option<(Geodetic, Option<f64>)> {
    let reference = voyage.reference.first()?.message;
    Some((reference.position?, reference.position_std))
}

fn whitened(voyage: &Voyage) -> Seen {
    const SPACING: f64 = 4.0;
    let mut filter = start(voyage);
    let mut hold = Whitened::new(&mut filter);
    if let Some((place, std)) = berth_of(voyage) {
        hold.name_berth(&mut filter, &place, std);
    }
    let mut is_due = ticker(SPACING);
    let (mut measured, mut residual, mut models) = (Vec::new(), Vec::new(), Vec::new());
    sail(voyage, &mut filter, |filter| {
        hold.hold(filter);
        if is_due(filter.time()) && is_settled(filter) {
            let newest_first = hold.displacements(filter);
            measured.extend(newest_first.first().copied());
            if let Some(model) = hold.model() {
                let sigma = model.residual_covariance().diagonal().map(f64::sqrt);
                let left = model.residual(&newest_first);
                residual.extend(left.map(|left| left.component_div(&sigma)));
                models.push(model);
            }
        }
    });
    let model = mean_spectrum(&models, 0.5 / SPACING);
    Seen { spacing: SPACING, measured, residual, model }
}

/// What a model leaves of the newest samples of a window, in units of its sigma.
fn unforeseen(samples: &[Vector2<f64>], model: &Model, count: usize) -> Vec<Vector2<f64>> {
    let sigma = model.residual_covariance().diagonal().map(f64::sqrt);
    let of = |history: &[Vector2<f64>]| {
        let newest_first: Vec<Vector2<f64>> = history.iter().rev().copied().collect();
        Some(model.residual(&newest_first)?.component_div(&sigma))
    };
    let all: Vec<Vector2<f64>> = samples.windows(model.order() + 1).filter_map(of).collect();
    all[all.len().saturating_sub(count)..].to_vec()
}

/// One-sided spectral density of the displacement of an oscillator, m^2/Hz (`insd_nav::sway`).
fn density(oscillator: &Oscillator, frequency: f64) -> f64 {
    let (omega, at) = (TAU / oscillator.period, TAU * frequency);
    let drive = 4.0 * oscillator.damping * omega.powi(3) * oscillator.std.powi(2);
    let response =
        (omega * omega - at * at).powi(2) + (2.0 * oscillator.damping * omega * at).powi(2);
    2.0 * drive / response
}

fn moored(voyage: &Voyage) -> Seen {
    const SPACING: f64 = 2.0;
    let mut filter = start(voyage);
    let mut moorings = Moorings::new(&mut filter);
    if let Some((place, std)) = berth_of(voyage) {
        moorings.name_berth(&mut filter, &place, std);
    }
    let mut is_due = ticker(SPACING);
    let (mut measured, mut residual) = (Vec::new(), Vec::new());
    sail(voyage, &mut filter, |filter| {
        if is_due(filter.time()) && is_settled(filter) {
            let view = filter.view();
            let off = reference_position::innovation(&view, moorings.place(), 0.0).z;
            measured.push(-Vector2::new(off[0], off[1]));
            let innovation = berth::innovation(&view, moorings.place(), moorings.waves_std());
            residual.extend(normalised(filter, &innovation));
        }
        moorings.hold(filter);
    });
    let waves = 2.0 * SPACING * moorings.waves_std().powi(2);
    let sway = filter.sway().copied();
    let model = |f: f64| {
        let slow = sway.map_or(0.0, |sway| sway.0.iter().map(|o| density(o, f)).sum());
        (f, slow + waves)
    };
    let model = frequencies(0.5 / SPACING).into_iter().map(model).collect();
    Seen { spacing: SPACING, measured, residual, model }
}
