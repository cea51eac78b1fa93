//! As much of RINEX 3.04 as a comparison needs.

use std::collections::BTreeMap;

use insd_base::GpsTime;
use insd_base::satellites::{
    Constellation, KeplerRecord, SatelliteEpoch, SatelliteId, SignalObservation,
};

/// Columns of one observation.
const COLUMN: usize = 16;

/// How often each kind was compared.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Compared {
    pub(crate) codes: usize,
    pub(crate) phases: usize,
    pub(crate) dopplers: usize,
    pub(crate) densities: usize,
    pub(crate) half_cycles: usize,
}

/// The kinds of observations of each system, and what follows the header.
fn header(text: &str) -> (BTreeMap<char, Vec<String>>, &str) {
    let (header, body) = text.split_once("END OF HEADER").unwrap();
    let mut types: BTreeMap<char, Vec<String>> = BTreeMap::new();
    let mut system = ' ';
    for line in header.lines().filter(|line| line.contains("SYS / # / OBS TYPES")) {
        system = line.chars().next().filter(|first| *first != ' ').unwrap_or(system);
        types.entry(system).or_default().extend(line[7..60].split_whitespace().map(str::to_owned));
    }
    (types, body.split_once('\n').unwrap().1)
}

/// Compares all observations of a file, to its last decimal, with those of as many epochs, but those whose satellite and name
/// (`E10 L7Q`) are left out.
pub(crate) fn compare_observations(
    epochs: &[SatelliteEpoch],
    text: &str,
    is_left_out: impl Fn(&str) -> bool,
) -> Compared {
    let (types, body) = header(text);
    let mut compared = Compared::default();
    let mut epochs = epochs.iter();
    let mut epoch = None;
    for line in body.lines() {
        if let Some(stamp) = line.strip_prefix('>') {
            epoch = epochs.next();
            is_at(epoch.unwrap(), stamp);
            continue;
        }
        let satellite: SatelliteId = line[..3].parse().unwrap();
        for (number, name) in types[&line.chars().next().unwrap()].iter().enumerate() {
            let Some(field) = line.get(3 + COLUMN * number..) else { continue };
            let Some(told) = Told::read(field) else { continue };
            if is_left_out(&format!("{satellite} {name}")) {
                continue;
            }
            let named = |own: &&SignalObservation| {
                own.satellite == satellite && own.signal.to_string() == name[1..]
            };
            let own = epoch.unwrap().signals.iter().find(named);
            let own = own.unwrap_or_else(|| panic!("{satellite} has no {name}"));
            compared.one(own, name, &told);
        }
    }
    assert!(epochs.next().is_none(), "more epochs than in the file");
    compared
}

/// The seconds of the minute agree; seven decimals are told.
fn is_at(epoch: &SatelliteEpoch, stamp: &str) {
    let told: f64 = stamp[17..29].trim().parse().unwrap();
    let own = (epoch.tag.as_nanos() % 60_000_000_000) as f64 * 1e-9;
    assert!((own - told).abs() < 0.6e-7, "{own} {told}");
}

/// One field: value and flags.
struct Told {
    value: f64,
    flags: u8,
}

impl Told {
    fn read(field: &str) -> Option<Self> {
        let value = field.get(..14)?.trim().parse().ok()?;
        let flags = field.get(14..15).and_then(|flags| flags.parse().ok()).unwrap_or(0);
        Some(Told { value, flags })
    }
}

impl Compared {
    fn one(&mut self, own: &SignalObservation, name: &str, told: &Told) {
        let (count, value) = match &name[..1] {
            "C" => (&mut self.codes, own.code),
            "L" => (&mut self.phases, own.phase),
            "D" => (&mut self.dopplers, own.doppler),
            _ => (&mut self.densities, own.cn0),
        };
        *count += 1;
        let value = value.unwrap_or_else(|| panic!("no {name}: {own:?}"));
        let told_value = told.value;
        // RTKLIB keeps Doppler shifts in single precision
        let single = if name.starts_with('D') { value.abs() * 2_f64.powi(-24) } else { 0.0 };
        let difference = (value - told_value).abs();
        assert!(difference < 0.000_51 + single, "{name}: {value} {told_value}, {own:?}");
        if name.starts_with('L') {
            assert_eq!(own.half_cycle, told.flags & 2 == 2, "{name}: {own:?}");
            self.half_cycles += usize::from(own.half_cycle);
        }
    }
}

/// Records of satellites with Keplerian elements: the satellite and all numbers from the clock's on.
pub(crate) fn records(text: &str) -> Vec<(SatelliteId, Vec<f64>)> {
    let (_, body) = text.split_once("END OF HEADER").unwrap();
    let mut records: Vec<(SatelliteId, Vec<f64>)> = Vec::new();
    for line in body.split_once('\n').unwrap().1.lines() {
        if !line.starts_with(' ') {
            records.push((line[..3].parse().unwrap(), Vec::new()));
        }
        let begin = if line.starts_with(' ') { 4 } else { 23 };
        let own = &mut records.last_mut().unwrap().1;
        own.extend((begin..80).step_by(19).filter_map(|at| number(line, at)));
    }
    records.retain(|(satellite, _)| satellite.constellation != Constellation::Sbas);
    records
}

fn number(line: &str, at: usize) -> Option<f64> {
    let text = line.get(at..line.len().min(at + 19))?.trim();
    (!text.is_empty()).then(|| text.replace('D', "e").parse().unwrap())
}

/// What of a record differs from the numbers of a file beyond their last decimal.
pub(crate) fn differing(own: &KeplerRecord, told: &[f64]) -> Vec<String> {
    let (orbit, clock) = (&own.orbit, &own.clock);
    let beidou = own.satellite.constellation == Constellation::BeiDou;
    let behind = if beidou { 14 } else { 0 };
    let of_week = |time: GpsTime| ((time.as_nanos() / 1_000_000_000 - behind) % 604_800) as f64;
    let last = if beidou { own.group_delays[1] } else { f64::from(own.clock_issue) };
    let fields = [
        ("a0", 0, clock.a0),
        ("a1", 1, clock.a1),
        ("a2", 2, clock.a2),
        ("issue", 3, own.issue.into()),
        ("crs", 4, orbit.crs),
        ("delta n", 5, orbit.delta_n),
        ("m0", 6, orbit.m0),
        ("cuc", 7, orbit.cuc),
        ("e", 8, orbit.eccentricity),
        ("cus", 9, orbit.cus),
        ("sqrt a", 10, orbit.sqrt_a),
        ("toe", 11, of_week(orbit.reference)),
        ("cic", 12, orbit.cic),
        ("omega0", 13, orbit.omega0),
        ("cis", 14, orbit.cis),
        ("i0", 15, orbit.i0),
        ("crc", 16, orbit.crc),
        ("omega", 17, orbit.omega),
        ("omega dot", 18, orbit.omega_dot),
        ("i dot", 19, orbit.i_dot),
        ("accuracy", 23, own.accuracy.unwrap_or(-1.0)),
        ("health", 24, own.health.into()),
        ("delay", 25, own.group_delays[0]),
        ("issue of the clock or delay", 26, last),
    ];
    let wrong = |(_, at, own): &&(&str, usize, f64)| {
        let digits = told[*at].abs().max(1e-99).log10().floor() as i32 + 1;
        (told[*at] - own).abs() > 0.51e-12 * 10_f64.powi(digits)
    };
    let name = |(name, at, own): &(&str, usize, f64)| format!("{name}: {own:e} {:e}", told[*at]);
    fields.iter().filter(wrong).map(name).collect()
}
