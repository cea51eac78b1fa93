//! insd's own sentences; `docs/pinsd.md` has them field by field.
//!
//! STA says whether its data are simulated. The others have no mark for it, so from a simulator they are
//! silent.
//!
//! PRO follows from the covariance that the solution claims, and holds as far as that is true. With the
//! semi-axes a and b of the 1-sigma ellipse of the horizontal error, a >= b, m:
//! ```text
//! R95 = a (1.960790 + 0.004071 c + 0.114276 c^2 + 0.371625 c^3),  c = b / a
//! HPL = a sqrt(-2 ln p)
//! VPL = z sigma_down,  P(|x| > z) = p for a normal x of unit variance
//! ```
//! R95 is the radius of the circle in which a normal error is with 95 %, by the polynomial of Leenhouts, "On
//! the computation of bi-normal radial error", Navigation 32 (1985), as GeodePy has it; it is within 0.2 % of
//! the integral (test `the_radius_of_95_percent_is_that_of_the_integral`). HPL is that of a circular error
//! of sigma a (Rayleigh), which b <= a can only make smaller: a bound. Where the north-east covariance is
//! not known, a is the root of the trace, which is never less than the true one, and b is 0.

use insd_base::Mode;
use insd_n2k::pgn::TimeSource;
use insd_wire::nmea::{
    NmeaLine, Pinsd, PinsdAlignment, PinsdMode, PinsdProtection, PinsdSigma, PinsdStatus,
    PinsdTime, ProtectionState, Talker, TimeOfDay,
};

use super::entry::{Content, Entry, one, unmarked};
use crate::redacted_epoch::RedactedEpoch;

pub(super) static ENTRIES: &[Entry] = &[
    Entry::own("PINSD.STA", PinsdStatus::LONGEST, status),
    Entry::own("PINSD.SIG", PinsdSigma::LONGEST, |said, _| unmarked(said, sigma)),
    Entry::own("PINSD.ALI", PinsdAlignment::LONGEST, alignment),
    Entry::own("PINSD.PRO", PinsdProtection::LONGEST, |said, _| unmarked(said, protection)),
];

/// What the navigator adds for a risk is beside levels of this one: 10 to minus this.
const USUAL: u8 = 5;

/// So many sigmas a normal error exceeds, up or down, with probability 10 to minus 1, 2, ... 9.
const VERTICAL: [f64; 9] = [
    1.644_854, 2.575_829, 3.290_527, 3.890_592, 4.417_174, 4.891_639, 5.326_724, 5.730_729,
    6.109_410,
];

fn utc(said: &RedactedEpoch<'_>) -> Option<TimeOfDay> {
    said.civil().map(|utc| utc.time)
}

/// Without a solution it stands by.
fn status(said: &RedactedEpoch<'_>, _: Talker) -> Option<Content> {
    let said = said.marked();
    let status = PinsdStatus {
        time: utc(&said),
        mode: said.mode().map_or(PinsdMode::Standby, PinsdMode::from),
        seconds_in_mode: said.seconds_in_mode().map(|seconds| seconds as u32),
        heading: said.heading_mode(),
        position: said.marked_quality(),
        heave: said.any_heave().map(|heave| heave.quality),
        time_source: time_source(&said),
        simulated: said.is_simulated(),
        alerts: None,
        integrity: said.judgement().map(|own| own.integrity.into()),
        excluded: said.judgement().map(|own| own.excluded),
        source: said.source().map(|(source, _)| source.into()),
        seconds_of_source: said.source().and_then(|(_, seconds)| seconds).map(|own| own as u32),
    };
    one(Pinsd::Status(status).write())
}

/// Pulses and messages of a receiver are not told apart here, so it is called the lesser.
fn time_source(said: &RedactedEpoch<'_>) -> PinsdTime {
    match said.time_source() {
        Some(TimeSource::Gps | TimeSource::Glonass) => PinsdTime::Messages,
        _ => PinsdTime::Unknown,
    }
}

/// Of whatever quality, but for a fault.
fn sigma(said: &RedactedEpoch<'_>) -> NmeaLine {
    let sigma = said.sigma().filter(|_| said.mode() != Some(Mode::Fault));
    let heave = said.any_heave().map(|heave| heave.sigma);
    let time = utc(said);
    Pinsd::Sigma(match sigma {
        Some(sigma) => PinsdSigma::of(time, &sigma, heave),
        None => PinsdSigma { time, heave, ..PinsdSigma::default() },
    })
    .write()
}

/// How long it still takes counts from the instant that it tells.
fn alignment(said: &RedactedEpoch<'_>, _: Talker) -> Option<Content> {
    let mut alignment = said.alignment()?;
    alignment.time = said.time();
    one(Pinsd::Alignment(PinsdAlignment::of(utc(said), &alignment)).write())
}

fn protection(said: &RedactedEpoch<'_>) -> NmeaLine {
    let axes = axes(said);
    let hidden = said.hidden().unwrap_or_default();
    let exponent = said.risk_exponent();
    let level = |std: f64, sigmas: fn(u8) -> f64, hidden: f64| {
        (std * sigmas(USUAL) + hidden).max(std * sigmas(exponent))
    };
    let horizontal = axes.map(|(major, _)| level(major, rayleigh, hidden.horizontal));
    let vertical = said.position_sigma().map(|sigma| level(sigma.0.z, normal, hidden.vertical));
    let alert_limit = said.alert_limit();
    Pinsd::Protection(PinsdProtection {
        time: utc(said),
        radius_95: axes.map(|(major, minor)| radius_95(major, minor)),
        horizontal,
        vertical,
        exponent: axes.map(|_| exponent),
        alert_limit,
        state: ProtectionState::of(horizontal, alert_limit),
    })
    .write()
}

/// Major and minor semi-axis of the ellipse of the horizontal error, m.
fn axes(said: &RedactedEpoch<'_>) -> Option<(f64, f64)> {
    let bound = || said.position_sigma().map(|sigma| (sigma.0.xy().norm(), 0.0));
    said.ellipse().map(|ellipse| (ellipse.major, ellipse.minor)).or_else(bound)
}

/// How many sigmas a circular normal error exceeds with probability 10 to minus this.
fn rayleigh(exponent: u8) -> f64 {
    (2.0 * f64::from(exponent) * std::f64::consts::LN_10).sqrt()
}

/// How many sigmas a normal error exceeds, up or down, with that probability.
fn normal(exponent: u8) -> f64 {
    VERTICAL[usize::from(exponent.clamp(1, 9)) - 1]
}

/// Radius of the circle in which the error is with 95 %, m; see the module.
fn radius_95(major: f64, minor: f64) -> f64 {
    let c = if major > 0.0 { minor / major } else { 0.0 };
    major * (1.960_790 + c * (0.004_071 + c * (0.114_276 + c * 0.371_625)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, TAU};

    /// Probability that an error of sigmas 1 and c is within a radius.
    fn within(radius: f64, c: f64) -> f64 {
        let steps = 20_000_u32;
        let share = |step: u32| {
            let part = (f64::from(step) + 0.5) / f64::from(steps);
            let (sin, cos) = (part * FRAC_PI_2).sin_cos();
            let q = cos * cos + sin * sin / (c * c);
            -(-0.5 * radius * radius * q).exp_m1() / q
        };
        (0..steps).map(share).sum::<f64>() / (f64::from(steps) * c)
    }

    #[test]
    fn the_radius_of_95_percent_is_that_of_the_integral() {
        for c in [0.01, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0] {
            let radius = radius_95(1.0, c);
            let (less, more) = (within(radius * 0.998, c), within(radius * 1.002, c));
            assert!(less < 0.95 && 0.95 < more, "{c}: {less} {more}");
        }
        assert!((radius_95(3.0, 0.0) - 3.0 * 1.96).abs() < 0.003);
    }

    #[test]
    fn a_protection_level_is_exceeded_with_its_probability_or_a_smaller_one() {
        let k = rayleigh(USUAL);
        assert!(((1.0 - within(k, 1.0)) / 1e-5 - 1.0).abs() < 1e-3, "{k}");
        for c in [0.1, 0.5, 0.9] {
            assert!(1.0 - within(k, c) < 1e-5, "{c}");
        }
        // a very long ellipse is a line: a normal error, beyond z on either side
        let step = 1e-4;
        let density = |x: f64| (-0.5 * x * x).exp() / TAU.sqrt();
        for exponent in 1..=9 {
            let from = normal(exponent);
            let tail = (0..60_000).map(|index| density(from + (f64::from(index) + 0.5) * step));
            let both = 2.0 * tail.sum::<f64>() * step;
            let risk = 10_f64.powi(-i32::from(exponent));
            assert!((both / risk - 1.0).abs() < 1e-3, "{exponent}: {both}");
        }
    }
}
