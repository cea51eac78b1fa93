//! Real text cut, flipped and torn apart: no panic, and what can be read still is.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod checks;

use insd_base::{
    Constellation, GpsTime, SatelliteEpoch, SatelliteId, SignalCode, SignalObservation,
};
use insd_rinex::ObservationHeader;
use proptest::prelude::*;

const TEXTS: [&[u8]; 9] = [
    include_bytes!("data/moving.obs"),
    include_bytes!("data/moving.nav"),
    include_bytes!("data/pair.obs"),
    include_bytes!("data/pair.crx"),
    include_bytes!("data/geonet.05o"),
    include_bytes!("data/geonet.05d"),
    include_bytes!("data/geonet.05n"),
    include_bytes!("data/esbjerg.nav"),
    include_bytes!("data/esbjerg-glonass.nav"),
];

#[test]
fn every_cut_of_a_file_of_observations_leaves_the_epochs_before_it() {
    let text = TEXTS[4];
    let (_, whole, _) = checks::observations(text).unwrap();
    for end in (0..text.len()).step_by(7) {
        let Some((_, cut, _)) = checks::observations(&text[..end]) else { continue };
        let full = cut.len().saturating_sub(1);
        assert_eq!(cut[..full], whole[..full]);
    }
}

#[test]
fn a_lost_line_of_version_two_costs_at_most_its_epoch() {
    let text = String::from_utf8(TEXTS[4].to_vec()).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let start = lines.iter().position(|line| line.contains("END OF HEADER")).unwrap() + 1;
    let (_, whole, _) = checks::observations(text.as_bytes()).unwrap();
    for lost in start..lines.len() {
        let rest: Vec<&str> =
            lines.iter().enumerate().filter(|(at, _)| *at != lost).map(|(_, line)| *line).collect();
        let (_, epochs, flaws) = checks::observations(rest.join("\n").as_bytes()).unwrap();
        assert_eq!(flaws.len(), 1, "line {lost}: {flaws:?}");
        let same = whole.iter().filter(|epoch| epochs.contains(epoch)).count();
        assert_eq!(same, whole.len() - 1, "line {lost}");
    }
}

/// Three decimals, and not zero, which is written as nothing.
fn observation(largest: i64) -> impl Strategy<Value = Option<f64>> {
    prop::option::of(
        (-largest / 10..largest).prop_filter_map("zero", |n| (n != 0).then_some(n as f64 / 1000.0)),
    )
}

prop_compose! {
    fn signal(band: u8)(
        code in observation(9_999_999_999_999), phase in observation(9_999_999_999_999),
        doppler in observation(9_999_999), cn0 in observation(60_000),
        half_cycle: bool, slip: bool,
    ) -> Option<SignalObservation> {
        let gps = SatelliteId::new(Constellation::Gps, 1)?;
        let own = SignalObservation::unknown(gps, SignalCode::new(band, b'C'));
        let told = code.or(phase).or(doppler).or(cn0).is_some();
        told.then_some(SignalObservation { code, phase, doppler, cn0, half_cycle, slip, ..own })
    }
}

/// A satellite with its signals in the order of their bands.
fn satellite() -> impl Strategy<Value = Vec<SignalObservation>> {
    let name = (prop::sample::select(Constellation::ALL.to_vec()), 1_u8..=99);
    (name, signal(1), signal(2), signal(7), -7_i8..=6).prop_map(
        |((system, number), a, b, c, channel)| {
            let satellite = SatelliteId::new(system, number).unwrap();
            let channel = Some((i16::from(channel) + i16::from(number)).rem_euclid(14) as i8 - 7);
            let channel = if system == Constellation::Glonass { channel } else { None };
            let own = |own: SignalObservation| SignalObservation { satellite, channel, ..own };
            [a, b, c].into_iter().flatten().map(own).collect()
        },
    )
}

proptest! {
    #[test]
    fn any_observations_of_three_decimals_come_back_to_the_bit(
        satellites in prop::collection::vec(prop::collection::vec(satellite(), 0..20), 1..5),
        start in 0_i64..2_000_000_000, tenths in prop::collection::vec(1_i64..1_000_000_000, 5),
        leap_seconds in prop::option::of(0_i8..30),
    ) {
        let mut tag = start * 1_000_000_000;
        let mut channels = std::collections::BTreeMap::new();
        let mut epochs = Vec::new();
        for (satellites, tenth) in satellites.into_iter().zip(tenths) {
            tag += tenth * 100;
            let mut signals: Vec<SignalObservation> = Vec::new();
            for own in satellites {
                let known = own.first().is_some_and(|own| signals.iter().any(|s| s.satellite == own.satellite));
                signals.extend(own.into_iter().filter(|_| !known));
            }
            for own in &mut signals {
                // a satellite has one channel in a file
                let channel = own.channel;
                own.channel = *channels.entry(own.satellite).or_insert(channel);
            }
            epochs.push(SatelliteEpoch { tag: GpsTime::from_nanos(tag), signals, leap_seconds, clock_reset: false });
        }
        let signals = Constellation::ALL.map(|own| (own, [1, 2, 7].map(|band| SignalCode::new(band, b'C')).to_vec()));
        let header = ObservationHeader { leap_seconds, signals: signals.to_vec(), ..ObservationHeader::default() };
        checks::observations_come_back(&header, &epochs);
    }

    #[test]
    fn no_bytes_make_anything_panic(bytes: Vec<u8>) {
        checks::everything(&bytes);
    }

    #[test]
    fn cut_and_flipped_text_makes_nothing_panic(
        which in 0..TEXTS.len(),
        flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..12),
        cuts in prop::collection::vec((any::<prop::sample::Index>(), 0_usize..200), 0..4),
        end in any::<prop::sample::Index>(),
    ) {
        let mut text = TEXTS[which].to_vec();
        for (at, value) in flips {
            let at = at.index(text.len());
            text[at] = value;
        }
        for (at, length) in cuts {
            let from = at.index(text.len());
            text.drain(from..(from + length).min(text.len() - 1).max(from));
        }
        text.truncate(text.len() / 2 + end.index(text.len() / 2 + 1));
        checks::everything(&text);
    }

    #[test]
    fn lines_in_any_order_make_nothing_panic(which in 0..TEXTS.len(), seed: u64) {
        let text = TEXTS[which];
        let mut lines: Vec<&[u8]> = text.split(|byte| *byte == b'\n').collect();
        let header = lines.iter().position(|line| line.ends_with(b"END OF HEADER")).unwrap() + 1;
        let mut state = seed | 1;
        for at in header..lines.len() {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            let other = header + (state >> 33) as usize % (lines.len() - header);
            lines.swap(at, other);
        }
        checks::everything(&lines.join(&b'\n'));
    }
}
