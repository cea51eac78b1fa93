//! The satellites, and what becomes of each.

use std::collections::BTreeMap;

use insd_base::satellites::{SatelliteUse, SignalStrength, Sky, SkySatellite};
use insd_base::units::DEG;
use insd_base::{Counts, Time};
use insd_config::Config;
use insd_intake::config::{Role, SensorConfig};
use insd_intake::status::SensorStatus;
use insd_web::snapshot::{Cause, SatelliteFate, ShownSatellite, ShownSignal, ShownSky, SkyState};

use super::super::report::Slow;

/// The sky, or why there is none. How old it may be is not decided here.
pub(super) fn sky(config: &Config, slow: &Slow, now: Time) -> ShownSky {
    let is_heard = is_heard(&config.sensors, &slow.intake.sensors);
    shown(slow.sky.as_ref(), is_heard, &slow.counts, now)
}

fn shown(sky: Option<&Sky>, is_heard: bool, counts: &Counts, now: Time) -> ShownSky {
    let (refused, against_base) = (causes(&counts.unranged), causes(&counts.rtk));
    let Some(sky) = sky else {
        let state = if is_heard { SkyState::FixesOnly } else { SkyState::NoReceiver };
        return ShownSky { state, refused, against_base, ..ShownSky::default() };
    };
    let satellites: Vec<_> = sky.satellites.iter().map(|own| satellite(own, now)).collect();
    let used = satellites.iter().filter(|own| own.fate.is_used()).count();
    ShownSky {
        state: SkyState::Raw,
        valid_at_s: Some(sky.time.as_seconds()),
        used: u32::try_from(used).ok(),
        satellites,
        refused,
        against_base,
    }
}

/// Whether a receiver is heard, whatever it says.
fn is_heard(sections: &[SensorConfig], all: &[SensorStatus]) -> bool {
    sections.iter().zip(all).any(|(section, status)| {
        section.kind.role() == Role::Gnss && status.heard.is_some() && !status.silent
    })
}

fn causes(counts: &BTreeMap<&'static str, u64>) -> Vec<Cause> {
    let cause = |(reason, count): (&&'static str, &u64)| Cause {
        reason: (*reason).to_owned(),
        count: *count,
    };
    counts.iter().map(cause).collect()
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
        reason: own.fate.reason().map(str::to_owned),
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

#[cfg(test)]
mod tests {
    use insd_base::SignalCode;
    use insd_base::satellites::{LookAngles, RangeRefusal};

    use super::*;

    fn seen(name: &str, fate: SatelliteUse, is_outlier: bool) -> SkySatellite {
        let signal = SignalStrength { signal: SignalCode::new(5, b'Q'), cn0: Some(44.5) };
        SkySatellite {
            satellite: name.parse().unwrap(),
            direction: Some(LookAngles { azimuth: 90.0 * DEG, elevation: 30.0 * DEG }),
            signals: vec![signal],
            fate,
            is_outlier,
        }
    }

    #[test]
    fn each_satellite_is_told_with_its_reason_and_for_how_long_it_is_left_out() {
        let (now, since) = (Time::from_seconds(100.0), Time::from_seconds(88.0));
        let low = SatelliteUse::Refused(RangeRefusal::Low { lowest: 10.0 * DEG });
        let satellites = vec![
            seen("G07", SatelliteUse::Phase, false),
            seen("E11", SatelliteUse::LeftOut { since }, true),
            seen("C30", low, true),
        ];
        let sky = Sky { time: Time::from_seconds(99.0), satellites };
        let mut counts = Counts::default();
        counts.unranged.insert("low", 7);
        let told = shown(Some(&sky), true, &counts, now);
        assert_eq!((told.state, told.valid_at_s, told.used), (SkyState::Raw, Some(99.0), Some(1)));
        assert_eq!(told.refused, [Cause { reason: "low".to_owned(), count: 7 }]);
        let [used, left_out, low] = &told.satellites[..] else { panic!("{told:?}") };
        assert_eq!((used.reason.as_deref(), used.text.as_deref()), (None, None));
        assert_eq!((used.name.as_str(), used.system.as_str()), ("G07", "GPS"));
        let signal = &left_out.signals[0];
        assert_eq!((signal.band.as_str(), signal.code.as_str()), ("E5a", "5Q"));
        assert_eq!(left_out.left_out_for_s, Some(12.0));
        assert_eq!(left_out.text.as_deref(), Some("its ranges contradict the others"));
        assert_eq!(low.reason.as_deref(), Some("low"));
        let text = "below 10 degrees; contradicts the others of its epoch";
        assert_eq!(low.text.as_deref(), Some(text));
        assert!((low.azimuth_deg.unwrap() - 90.0).abs() < 1e-9);
    }

    #[test]
    fn without_raw_measurements_it_is_said_whether_a_receiver_is_heard() {
        let told = |is_heard| shown(None, is_heard, &Counts::default(), Time::START).state;
        assert_eq!((told(true), told(false)), (SkyState::FixesOnly, SkyState::NoReceiver));
        let config = include_str!("../../../../systemd/examples/simulated.toml");
        let sensors = Config::of_text(config).unwrap().sensors;
        let heard =
            |silent| SensorStatus { heard: Some(Time::START), silent, ..Default::default() };
        assert!(is_heard(&sensors, &vec![heard(false); sensors.len()]));
        assert!(!is_heard(&sensors, &vec![heard(true); sensors.len()]));
        assert!(!is_heard(&sensors, &vec![SensorStatus::default(); sensors.len()]));
    }
}
