//! The sea for those who look on: the model that holds the ship at her berth where one does, otherwise
//! one fitted to the horizontal velocity of the last two and a half minutes.

use insd_base::{Disturbance, SeaQuantity, Span, Time, earth};
use insd_nav::Navigator;
use insd_nav::berth::{Method, SeaSight};
use insd_nav::disturbance::{ModelOrder, Prefilter, PrefilterConfig, measured_spectrum};
use nalgebra::Vector2;

/// Spacing of the samples: waves down to a period of one second.
const SPACING: Span = Span::from_nanos(500_000_000);
/// Length of the window, s: some fifteen waves.
const WINDOW: f64 = 150.0;
/// Highest order that is tried.
const HIGHEST_ORDER: usize = 8;
/// Points of a spectrum, from the longest period that its window tells to two samples, evenly on a logarithmic scale.
const POINTS: usize = 96;
/// Segments that the samples make, with others that overlap them, for the measured spectrum.
const SEGMENTS: usize = 2;
/// Longest period of a spectrum of the velocity, and of the displacement, s.
const SLOWEST: (f64, f64) = (60.0, 300.0);

/// The window.
#[derive(Clone, Debug)]
pub(crate) struct Trace {
    window: Prefilter,
    next: Option<Time>,
}

impl Trace {
    pub(crate) fn new() -> Self {
        let order = ModelOrder::Chosen { max: HIGHEST_ORDER };
        let window = Span::from_seconds(WINDOW);
        Trace {
            window: Prefilter::new(&PrefilterConfig { interval: SPACING, window, order }),
            next: None,
        }
    }

    /// Takes the velocity of the ship, if it is time to: forward and starboard, as the corrections of
    /// the filter have not stepped it.
    pub(crate) fn watch(&mut self, navigator: &Navigator) {
        let filter = navigator.filter();
        let now = filter.time();
        if self.next.is_some_and(|next| now < next) {
            return;
        }
        // a sample that is late does not make the next ones late
        let due = self.next.filter(|next| now - *next < SPACING).unwrap_or(now);
        self.next = Some(due + SPACING);
        let nominal = filter.nominal();
        let c_ne = earth::c_ne(&nominal.geodetic());
        let velocity = (c_ne * filter.smooth_velocity()).xy();
        let bow = (c_ne * nominal.c_eb().column(0)).xy();
        let bow = bow / bow.norm().max(1e-9);
        let across = Vector2::new(-bow.y, bow.x);
        self.window.push(due, &Vector2::new(velocity.dot(&bow), velocity.dot(&across)));
    }

    /// Forgets what was before a gap.
    pub(crate) fn clear(&mut self) {
        self.window.clear();
        self.next = None;
    }

    /// The sea; `None` while too little has been seen of it, or nothing is to be seen.
    pub(crate) fn disturbance(&self, navigator: &Navigator) -> Option<Disturbance> {
        if let Some(sight) = navigator.sea_sight() {
            return Some(described(&sight));
        }
        let sight = SeaSight {
            method: None,
            model: self.window.estimate().ok()?.model,
            quantity: SeaQuantity::Velocity,
            samples: self.window.newest_run(),
            fit: None,
        };
        Some(described(&sight))
    }
}

fn described(sight: &SeaSight) -> Disturbance {
    let model = &sight.model;
    let rows = model.coefficients().iter().flat_map(|a| [a.m11, a.m12, a.m21, a.m22]);
    let fastest = 0.5 / model.interval();
    let slowest = match sight.quantity {
        SeaQuantity::Velocity => 1.0 / SLOWEST.0,
        SeaQuantity::Displacement => 1.0 / SLOWEST.1,
    };
    let ratio = fastest / slowest;
    let frequencies: Vec<f64> =
        (0..POINTS).map(|point| slowest * ratio.powf(point as f64 / (POINTS - 1) as f64)).collect();
    let density = |frequency: &f64| {
        let density = model.spectrum(*frequency)?.trace().re;
        density.is_finite().then_some((*frequency, density))
    };
    Disturbance {
        method: sight.method.map_or("window", Method::as_str),
        quantity: sight.quantity,
        interval: model.interval(),
        window: sight.samples.len() as f64 * model.interval(),
        coefficients: rows.collect(),
        radius: model.radius(),
        residual: (0.5 * model.residual_covariance().trace()).sqrt(),
        spectrum: frequencies.iter().filter_map(density).collect(),
        measured: measured_spectrum(
            &sight.samples,
            model.interval(),
            sight.samples.len() / SEGMENTS,
            &frequencies,
        ),
        fit: sight.fit,
    }
}
