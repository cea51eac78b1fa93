//! The engines, and what their filter has found out.

use insd_base::units::{DEG, DEG_PER_HOUR, MICRO_G};
use insd_base::{self as base, Body, Party, Standing};
use insd_vessel::{Dispute, EngineStatus};
use insd_web::snapshot::{
    DisturbanceAxis, Found, ShownDisturbance, ShownEngine, ShownEstimate, ShownEstimates, ShownFit,
    ShownStands,
};

use super::super::report::Report;

/// Parts of a ratio in a million.
const PPM: f64 = 1e-6;

/// The engines, if there are several.
pub(super) fn engines(report: &Report, disputes: &[Dispute]) -> Vec<ShownEngine> {
    let several = report.engines.iter().filter(|_| report.engines.len() > 1);
    several.map(|status| engine(status, disputes)).collect()
}

fn engine(status: &EngineStatus, disputes: &[Dispute]) -> ShownEngine {
    let own = disputes.iter().filter(|dispute| dispute.between.contains(&status.name));
    let mut differs: Vec<String> =
        own.map(|dispute| dispute.difference.quantity.as_str().to_owned()).collect();
    differs.dedup();
    let solution = status.motion.map(|motion| motion.solution);
    ShownEngine {
        name: status.name.clone(),
        mode: status.mode.as_str().to_owned(),
        in_use: status.chosen,
        healthy: status.doubt.is_none() && status.motion.is_some(),
        valid_at_s: solution.map(|solution| solution.time.as_seconds()),
        heading_deg: solution.map(|solution| solution.attitude.heading / DEG),
        sigma_heading_deg: solution.map(|solution| solution.sigma.heading / DEG),
        differs,
    }
}

pub(super) fn estimates(found: &base::Estimates) -> ShownEstimates {
    ShownEstimates {
        gyro_bias_deg_h: triad(&found.gyro_bias, &found.gyro_bias_sigma, DEG_PER_HOUR),
        accel_bias_ug: triad(&found.accel_bias, &found.accel_bias_sigma, MICRO_G),
        log_scale_ppm: Some(estimate(&found.log_scale, PPM)),
        log_misalignment_deg: Some(estimate(&found.log_heading, DEG)),
        gnss_lever_m: triad(&found.gnss_lever, &found.gnss_lever_sigma, 1.0),
        gnss_delay_s: Some(estimate(&found.gnss_delay, 1.0)),
        course_less_heading_deg: found.course_less_heading.map(|own| estimate(&own, DEG)),
    }
}

/// How all stand with whom she is navigated by.
pub(super) fn standings(all: &[base::Stands]) -> Vec<ShownStands> {
    let shown = |stands: &base::Stands| ShownStands {
        name: stands.party.as_str().to_owned(),
        standing: stands.standing.as_str().to_owned(),
        since_s: stands.fault.map(|_| stands.since.as_seconds()),
        fault: stands.fault.map(|fault| fault.as_str().to_owned()),
        text: stands.fault.map(|_| stands.to_string()),
        advice: advice(stands, all).map(str::to_owned),
    };
    all.iter().map(shown).collect()
}

/// What the mate may do about somebody who is not believed.
fn advice(stands: &base::Stands, all: &[base::Stands]) -> Option<&'static str> {
    let is_another = |other: &base::Stands| {
        let is_trusted = other.standing == Standing::Trusted;
        is_trusted && other.party.is_receiver() && other.party != stands.party
    };
    match (stands.standing, stands.party) {
        (Standing::Trusted, _) => None,
        (Standing::Excluded, party) if party.is_receiver() && all.iter().any(is_another) => {
            Some("Another receiver is used. Look at its antenna and its cable.")
        }
        (_, Party::Gnss | Party::Gnss2 | Party::Gnss3) => {
            Some("Fix by radar, bearings and depth. Do not steer by track control.")
        }
        (_, Party::Log) => Some("Compare the speed with GNSS. Look at the log."),
        (_, Party::Heading) => {
            Some("Compare with the magnetic compass, and the course on a leading line.")
        }
        (_, Party::Reference) => Some("Look at its receiver and its antenna."),
        (_, Party::Antennas) => {
            Some("Compare with another compass. Look whether an antenna was moved.")
        }
        (_, Party::Docking) => Some("Compare with the eye. Look at its head and at the berth."),
        (_, Party::Imu) => {
            Some("Use another heading, roll and pitch. Look at the IMU's cable and mounting.")
        }
    }
}

/// What of the installation is found to be otherwise than configured.
pub(super) fn installation(findings: &[base::Finding]) -> Vec<Found> {
    let found = |finding: &base::Finding| Found {
        name: finding.as_str().to_owned(),
        text: finding.to_string(),
        paste: finding.to_paste(),
        fault: finding.is_fault(),
    };
    findings.iter().map(found).collect()
}

pub(super) fn triad(value: &Body, sigma: &Body, unit: f64) -> Vec<ShownEstimate> {
    let pairs = value.0.iter().zip(sigma.0.iter());
    let one = |(value, sigma): (&f64, &f64)| base::Estimate { value: *value, sigma: *sigma };
    pairs.map(|pair| estimate(&one(pair), unit)).collect()
}

pub(super) fn estimate(own: &base::Estimate, unit: f64) -> ShownEstimate {
    ShownEstimate { value: Some(own.value / unit), sigma: Some(own.sigma / unit) }
}

pub(super) fn disturbance(found: &base::Disturbance) -> ShownDisturbance {
    let is_velocity = found.quantity == base::SeaQuantity::Velocity;
    let model = pairs(&found.spectrum);
    let peak = model.iter().max_by(|one, other| one[1].total_cmp(&other[1]));
    let residual = Some(found.residual).filter(|residual| residual.is_finite());
    let axis = DisturbanceAxis {
        name: "horizontal".to_owned(),
        dominant_period_s: peak.filter(|peak| peak[0] > 0.0).map(|peak| 1.0 / peak[0]),
        coefficients: found.coefficients.clone(),
        residual_mps: residual.filter(|_| is_velocity),
        residual_m: residual.filter(|_| !is_velocity),
        model,
        measured: pairs(&found.measured),
    };
    ShownDisturbance {
        method: found.method.to_owned(),
        quantity: found.quantity.as_str().to_owned(),
        order: u32::try_from(found.coefficients.len() / 4).ok(),
        interval_s: Some(found.interval),
        window_s: Some(found.window),
        radius: Some(found.radius).filter(|radius| radius.is_finite()),
        fit: found.fit.as_ref().map(fit),
        axes: vec![axis],
    }
}

fn fit(fit: &base::SeaFit) -> ShownFit {
    let seen = fit.seen;
    ShownFit {
        residual: seen.map(|seen| seen.verdict.as_str().to_owned()),
        level: seen.map(|seen| seen.level),
        slow: seen.map(|seen| seen.slow),
        correlation: seen.map(|seen| seen.correlation),
        apart_s: seen.map(|seen| seen.apart),
        fallbacks: fit.fallbacks,
        text: fit.to_string(),
    }
}

fn pairs(densities: &[(f64, f64)]) -> Vec<[f64; 2]> {
    let finite = densities.iter().filter(|(hz, density)| hz.is_finite() && density.is_finite());
    finite.map(|(hz, density)| [*hz, *density]).collect()
}
