//! The satellites, and what becomes of each.

use insd_base::satellites::{SatelliteUse, SignalStrength, SkySatellite};
use insd_base::units::DEG;
use insd_base::{Counts, Time};
use insd_config::Config;
use insd_intake::config::Role;
use insd_web::snapshot::{Cause, SatelliteFate, ShownSatellite, ShownSignal, ShownSky, SkyState};

use super::super::report::Slow;

/// The sky, or why there is none. How old it may be is not decided here.
pub(super) fn sky(config: &Config, slow: &Slow, now: Time) -> ShownSky {
    let refused = refused(&slow.counts);
    let Some(sky) = &slow.sky else {
        let state = if is_heard(config, slow) { SkyState::FixesOnly } else { SkyState::NoReceiver };
        return ShownSky { state, refused, ..ShownSky::default() };
    };
    let satellites: Vec<_> = sky.satellites.iter().map(|own| satellite(own, now)).collect();
    let used = satellites.iter().filter(|own| own.fate.is_used()).count();
    ShownSky {
        state: SkyState::Raw,
        valid_at_s: Some(sky.time.as_seconds()),
        used: u32::try_from(used).ok(),
        satellites,
        refused,
    }
}

/// Whether a receiver is heard, whatever it says.
fn is_heard(config: &Config, slow: &Slow) -> bool {
    let mut sensors = config.sensors.iter().zip(&slow.intake.sensors);
    sensors.any(|(section, status)| {
        section.kind.role() == Role::Gnss && status.heard.is_some() && !status.silent
    })
}

fn refused(counts: &Counts) -> Vec<Cause> {
    let cause = |(reason, count): (&&'static str, &u64)| Cause {
        reason: (*reason).to_owned(),
        count: *count,
    };
    counts.unranged.iter().map(cause).collect()
}

fn satellite(own: &SkySatellite, now: Time) -> ShownSatellite {
    let constellation = own.satellite.constellation;
    let signal = |strength: &SignalStrength| ShownSignal {
        band: strength
            .signal
            .band_name(constellation)
            .map_or_else(|| format!("band {}", strength.signal.band), str::to_owned),
        code: strength.signal.to_string(),
        cn0_db_hz: strength.cn0,
    };
    let left_out = match own.fate {
        SatelliteUse::LeftOut { since } => Some((now - since).as_seconds()),
        _ => None,
    };
    ShownSatellite {
        name: own.satellite.to_string(),
        system: constellation.to_string(),
        azimuth_deg: own.direction.map(|direction| direction.azimuth / DEG),
        elevation_deg: own.direction.map(|direction| direction.elevation / DEG),
        signals: own.signals.iter().map(signal).collect(),
        fate: fate(own.fate),
        left_out_for_s: left_out,
        reason: reason(own.fate).map(str::to_owned),
        text: text(own),
    }
}

fn fate(fate: SatelliteUse) -> SatelliteFate {
    match fate {
        SatelliteUse::Phase => SatelliteFate::Used,
        SatelliteUse::CodeOnly => SatelliteFate::CodeOnly,
        SatelliteUse::LeftOut { .. } => SatelliteFate::LeftOut,
        SatelliteUse::Crowded => SatelliteFate::Crowded,
        SatelliteUse::Waiting => SatelliteFate::Waiting,
        SatelliteUse::Refused(_) => SatelliteFate::Refused,
    }
}

fn reason(fate: SatelliteUse) -> Option<&'static str> {
    match fate {
        SatelliteUse::Phase | SatelliteUse::CodeOnly => None,
        SatelliteUse::LeftOut { .. } => Some("contradicts"),
        SatelliteUse::Crowded => Some("crowded"),
        SatelliteUse::Waiting => Some("waiting"),
        SatelliteUse::Refused(why) => Some(why.as_str()),
    }
}

fn text(own: &SkySatellite) -> Option<String> {
    let told = match own.fate {
        SatelliteUse::Phase => None,
        SatelliteUse::CodeOnly => Some("no phase is tracked".to_owned()),
        SatelliteUse::LeftOut { .. } => Some("its ranges contradict the others".to_owned()),
        SatelliteUse::Crowded => Some("as many as there is room for stand higher".to_owned()),
        SatelliteUse::Waiting => Some("the navigator does not use ranges yet".to_owned()),
        SatelliteUse::Refused(why) => Some(why.to_string()),
    };
    let doubted = "contradicts the others of its epoch";
    match (told, own.is_outlier && !matches!(own.fate, SatelliteUse::LeftOut { .. })) {
        (Some(told), true) => Some(format!("{told}; {doubted}")),
        (None, true) => Some(doubted.to_owned()),
        (told, false) => told,
    }
}
