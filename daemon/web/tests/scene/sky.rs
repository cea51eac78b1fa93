//! The sky above the made-up ship.

use insd_web::snapshot::{Cause, SatelliteFate, ShownSatellite, ShownSignal, ShownSky, SkyState};

use super::Scene;

/// Name, azimuth and elevation, deg.
type Place = (&'static str, f64, f64);

const HEARD: [Place; 34] = [
    ("G02", 41.0, 63.0),
    ("G05", 118.0, 8.0),
    ("G07", 66.0, 38.0),
    ("G08", 98.0, 12.0),
    ("G13", 301.0, 22.0),
    ("G15", 278.0, 57.0),
    ("G18", 214.0, 71.0),
    ("G23", 163.0, 29.0),
    ("G27", 57.0, 17.0),
    ("G29", 189.0, 44.0),
    ("G30", 71.0, 31.0),
    ("R03", 28.0, 24.0),
    ("R04", 87.0, 51.0),
    ("R13", 252.0, 19.0),
    ("R14", 307.0, 47.0),
    ("R19", 341.0, 14.0),
    ("E03", 64.0, 41.0),
    ("E05", 152.0, 11.0),
    ("E08", 201.0, 68.0),
    ("E13", 281.0, 33.0),
    ("E15", 118.0, 26.0),
    ("E24", 310.0, 78.0),
    ("E25", 233.0, 15.0),
    ("E26", 61.0, 66.0),
    ("E33", 16.0, 36.0),
    ("C11", 134.0, 18.0),
    ("C12", 91.0, 46.0),
    ("C21", 291.0, 61.0),
    ("C22", 227.0, 23.0),
    ("C26", 59.0, 21.0),
    ("C34", 178.0, 54.0),
    ("C35", 126.0, 82.0),
    ("C44", 333.0, 27.0),
    ("S23", 171.0, 28.0),
];

/// What is heard of the satellites.
pub(super) fn sky(t: f64, scene: Scene) -> ShownSky {
    let count = |rate: f64| (t * rate) as u64;
    let cause = |reason: &str, rate: f64| Cause { reason: reason.to_owned(), count: count(rate) };
    let refused = vec![cause("low", 2.0), cause("no_orbit", 1.0), cause("stale_orbit", 0.4)];
    if scene == Scene::Alignment {
        return ShownSky { state: SkyState::FixesOnly, ..ShownSky::default() };
    }
    let heard = HEARD.iter().enumerate().filter(|(k, _)| scene == Scene::Underway || k % 11 == 6);
    let satellites: Vec<_> = heard.map(|(k, place)| satellite(t, k, place)).collect();
    let used = satellites.iter().filter(|own| own.fate.is_used()).count();
    ShownSky {
        state: SkyState::Raw,
        valid_at_s: Some(t.floor() - 0.1),
        used: u32::try_from(used).ok(),
        satellites,
        refused,
        against_base: vec![cause("fixed", 0.9), cause("unclear", 0.1)],
    }
}

fn satellite(t: f64, k: usize, (name, azimuth, elevation): &Place) -> ShownSatellite {
    let system = match name.as_bytes()[0] {
        b'G' => "GPS",
        b'R' => "GLONASS",
        b'E' => "Galileo",
        b'C' => "BeiDou",
        _ => "SBAS",
    };
    let bands: &[(&str, &str)] = match system {
        "GPS" => &[("L1", "1C"), ("L2", "2L"), ("L5", "5Q")],
        "GLONASS" => &[("G1", "1C"), ("G2", "2C")],
        "Galileo" => &[("E1", "1C"), ("E5a", "5Q"), ("E5b", "7Q")],
        "BeiDou" => &[("B1I", "2I"), ("B3I", "6I")],
        _ => &[("L1", "1C")],
    };
    let (fate, reason, text) = fate(name, *elevation);
    let is_known = !matches!(reason, Some("no_orbit" | "stale_orbit" | "unhealthy"));
    let strength = |band: usize| {
        let wobble = (t / 7.0 + (3 * k + band) as f64).sin();
        33.0 + 17.0 * elevation.to_radians().sin().sqrt() - 3.0 * band as f64 + wobble
    };
    let signals = bands.iter().enumerate().map(|(index, (band, code))| ShownSignal {
        band: (*band).to_owned(),
        code: (*code).to_owned(),
        cn0_db_hz: Some(strength(index)),
    });
    ShownSatellite {
        name: (*name).to_owned(),
        system: system.to_owned(),
        azimuth_deg: is_known.then_some(azimuth + t / 240.0),
        elevation_deg: is_known.then_some(*elevation),
        signals: signals.collect(),
        fate,
        left_out_for_s: (fate == SatelliteFate::LeftOut).then_some(t - 281.0),
        reason: reason.map(str::to_owned),
        text: text.map(str::to_owned),
    }
}

fn fate(name: &str, elevation: f64) -> (SatelliteFate, Option<&'static str>, Option<&'static str>) {
    use SatelliteFate as Fate;
    match name {
        "G30" | "C26" => {
            (Fate::LeftOut, Some("contradicts"), Some("its ranges contradict the others"))
        }
        "R13" | "E25" => (Fate::CodeOnly, None, Some("no phase is tracked")),
        "E24" => (Fate::Refused, Some("unhealthy"), Some("not healthy (0x07)")),
        "S23" => (Fate::Refused, Some("no_orbit"), Some("no orbit known")),
        "R19" => {
            let text = "orbit 38 min from its reference time, at most 15";
            (Fate::Refused, Some("stale_orbit"), Some(text))
        }
        "R03" | "C11" => {
            let text = "as many as there is room for stand higher";
            (Fate::Crowded, Some("crowded"), Some(text))
        }
        _ if elevation < 10.0 => (Fate::Refused, Some("low"), Some("below 10 degrees")),
        _ => (Fate::Used, None, None),
    }
}
