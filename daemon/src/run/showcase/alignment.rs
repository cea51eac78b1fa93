//! How the alignment stands.

use insd_base::units::DEG;
use insd_base::{AlignmentStatus, Forecast, Lack, Limiting, Time};
use insd_web::snapshot::ShownAlignment;

pub(super) fn alignment(
    status: &AlignmentStatus,
    now: Time,
    utc: impl Fn(Time) -> Option<String>,
) -> ShownAlignment {
    let ready_in = match status.ready {
        Forecast::Expected { at, .. } => Some((at - now).as_seconds().max(0.0)),
        _ => None,
    };
    let sigma = status.sigma;
    ShownAlignment {
        told_at_s: status.time.as_seconds(),
        phase: status.phase.as_str().to_owned(),
        moored: status.moored,
        progress: progress(status, now),
        sigma_heading_deg: sigma.map(|sigma| sigma.heading / DEG),
        sigma_roll_deg: sigma.map(|sigma| sigma.roll / DEG),
        sigma_pitch_deg: sigma.map(|sigma| sigma.pitch / DEG),
        target_deg: status.target.map(|target| target / DEG),
        gyrocompass_deg: status.gyrocompass.map(|limit| limit / DEG),
        forecast: status.ready.as_str().to_owned(),
        ready_in_s: ready_in,
        ready_utc: ready_in.and(status.ready.ready_at()).and_then(&utc),
        reached_at_s: match status.ready {
            Forecast::Reached { at } => Some(at.as_seconds()),
            _ => None,
        },
        best_deg: match status.ready {
            Forecast::Unreachable { best, .. } => Some(best / DEG),
            _ => None,
        },
        limited_by: limit(status.ready).map(|limit| limit.as_str().to_owned()),
        lacks: lack(status.ready).map(|lack| lack.as_str().to_owned()),
        text: text(status, ready_in),
        sea_period_s: status.sea.and_then(|sea| sea.period),
        sea_heave_m: status.sea.map(|sea| sea.significant_heave),
        shifts: status.shifts,
        stored_state: None,
    }
}

/// What has passed of what it takes in all.
fn progress(status: &AlignmentStatus, now: Time) -> Option<f64> {
    match status.ready {
        Forecast::Reached { .. } => Some(1.0),
        Forecast::Expected { at, .. } => {
            let whole = (at - Time::START).as_seconds();
            let passed = (now - Time::START).as_seconds();
            (whole > 0.0).then(|| (passed / whole).clamp(0.0, 1.0))
        }
        Forecast::Unreachable { .. } | Forecast::Unknown { .. } => None,
    }
}

fn limit(forecast: Forecast) -> Option<Limiting> {
    match forecast {
        Forecast::Expected { limiting, .. } | Forecast::Unreachable { limiting, .. } => {
            Some(limiting)
        }
        _ => None,
    }
}

fn lack(forecast: Forecast) -> Option<Lack> {
    match forecast {
        Forecast::Unknown { lacks } => Some(lacks),
        _ => None,
    }
}

fn text(status: &AlignmentStatus, ready_in: Option<f64>) -> String {
    let target = status.target.map_or("the heading that is asked for".to_owned(), |target| {
        format!("a heading of {:.2} deg, 1 sigma,", target / DEG)
    });
    match status.ready {
        Forecast::Reached { .. } => format!("{target} is reached"),
        Forecast::Expected { limiting, .. } => {
            let minutes = ready_in.unwrap_or_default() / 60.0;
            format!("{target} is expected in {minutes:.0} min; {} limits it", because(limiting))
        }
        Forecast::Unreachable { best, limiting } => format!(
            "{target} is out of reach: {:.2} deg can be had; {} limits it",
            best / DEG,
            because(limiting)
        ),
        Forecast::Unknown { lacks } => {
            format!("nobody knows when {target} is reached: {}", missing(lacks))
        }
    }
}

fn because(limiting: Limiting) -> &'static str {
    match limiting {
        Limiting::GyroBias => "the bias of the gyros",
        Limiting::RandomWalk => "the random walk of the gyros",
        Limiting::Sea => "the motion of the ship at her berth",
        Limiting::Latitude => "the latitude",
    }
}

fn missing(lack: Lack) -> &'static str {
    match lack {
        Lack::Time => "it takes some more time to tell",
        Lack::Manoeuvres => "she must change course or speed",
        Lack::GnssVelocity => "there is no GNSS velocity",
        Lack::Aid => "there is no aid",
        Lack::Method => "the chosen method has no forecast",
    }
}
