//! Records into words and back.

use insd_base::GpsTime;
use insd_base::satellites::{
    BroadcastKind, BroadcastRecord, ClockPolynomial, Constellation, GlonassRecord, IonosphereModel,
    KeplerOrbit, KeplerRecord, SatelliteId, SignalCode,
};
use proptest::prelude::*;

use super::super::bits::Bits;
use super::super::kepler::SECOND;
use super::super::words::NavigationWords;
use super::{Broadcast, NavigationAssembler, WordsRefusal, beidou, galileo, glonass, lnav};

/// An instant in 2025, on a whole half minute.
fn now() -> GpsTime {
    GpsTime::from_week(2381, 408_660 * SECOND)
}

/// Whole steps of every field, so that what comes back is the same number.
fn record(name: &str, kind: BroadcastKind, steps: i64) -> KeplerRecord {
    let whole = |power: i32| steps as f64 * 2_f64.powi(-power);
    let semi = |power: i32| steps as f64 * (2_f64.powi(-power) * std::f64::consts::PI);
    let beidou = matches!(kind, BroadcastKind::D1 | BroadcastKind::D2);
    let galileo = matches!(kind, BroadcastKind::Inav | BroadcastKind::Fnav);
    let finer = |gps: i32, beidou_power: i32| whole(if beidou { beidou_power } else { gps });
    let behind = if beidou { 14 } else { 0 };
    let reference = GpsTime::from_week(2381, (410_400 + behind) * SECOND);
    let delay = if beidou { steps as f64 * 1e-10 } else { whole(if galileo { 32 } else { 31 }) };
    let a = if beidou {
        [33, 50, 66]
    } else if galileo {
        [34, 46, 59]
    } else {
        [31, 43, 55]
    };
    KeplerRecord {
        satellite: name.parse().unwrap(),
        kind,
        issue: 21,
        clock_issue: 21,
        health: u16::from(!galileo),
        accuracy: Some(2.0),
        group_delays: [delay, if beidou || kind == BroadcastKind::Inav { -delay } else { 0.0 }],
        orbit: KeplerOrbit {
            reference,
            sqrt_a: 5153.5 + whole(19),
            eccentricity: 0.125 + whole(33),
            m0: semi(31),
            delta_n: semi(43),
            omega: -semi(31),
            omega0: semi(31),
            omega_dot: -semi(43),
            i0: semi(31),
            i_dot: -semi(43),
            cuc: finer(29, 31),
            cus: -finer(29, 31),
            crc: finer(5, 6),
            crs: -finer(5, 6),
            cic: finer(29, 31),
            cis: -finer(29, 31),
        },
        clock: ClockPolynomial {
            reference,
            a0: whole(a[0]),
            a1: -whole(a[1]),
            a2: (steps % 16) as f64 * 2_f64.powi(-a[2]),
        },
        transmitted: Some(GpsTime::from_week(2381, (408_660 + behind) * SECOND)),
    }
}

/// What is told of words that come one after the other.
fn heard(satellite: SatelliteId, signal: &str, words: Vec<Vec<u32>>) -> Vec<Broadcast> {
    let mut assembler = NavigationAssembler::new();
    let [band, attribute] = signal.as_bytes() else { panic!("{signal}") };
    let signal = SignalCode::new(band - b'0', *attribute);
    let channel = Some(-4);
    let take = |words| {
        let words = NavigationWords { satellite, signal, channel, words };
        assembler.take(&words, now()).unwrap()
    };
    words.into_iter().flat_map(take).collect()
}

/// The pages of a message of Galileo.
fn pages(bits: &Bits, size: usize) -> Vec<Bits> {
    let page = |number: usize| {
        let mut page = Bits::default();
        page.append(bits, number * size, size);
        page
    };
    (0..bits.len() / size).map(page).collect()
}

/// Writes the types of pages, which begin with six bits.
fn typed(pages: Vec<Bits>) -> Vec<Bits> {
    let field = super::super::bits::Field::count(0, 6);
    let typed = |(mut page, number): (Bits, u64)| {
        field.put_raw(&mut page, number);
        page
    };
    pages.into_iter().zip(1..).map(typed).collect()
}

/// Pages of every message, each with its number and good parities, and any bits else.
fn any_pages(content: &[u8]) -> Vec<(SatelliteId, SignalCode, Vec<Vec<u32>>)> {
    let bits = Bits::of(content);
    let cut = |size: usize, pages: usize| -> Vec<Bits> {
        let mut all = Bits::default();
        all.append(&bits, 0, size * pages);
        self::pages(&all, size)
    };
    let numbered = |pages: Vec<Bits>, at: usize, length: usize| -> Vec<Bits> {
        let field = super::super::bits::Field::count(at, length);
        let number = |(mut page, number): (Bits, u64)| {
            field.put_raw(&mut page, number);
            page
        };
        pages.into_iter().zip(1..).map(number).collect()
    };
    let begun = |pages: Vec<Bits>, length: usize, preamble: u64| -> Vec<Bits> {
        let field = super::super::bits::Field::count(0, length);
        let begin = |mut page: Bits| {
            field.put_raw(&mut page, preamble);
            page
        };
        pages.into_iter().map(begin).collect()
    };
    let gps = begun(numbered(cut(lnav::SIZE, 4), 43, 3), 8, 0x8B);
    let beidou = begun(numbered(cut(beidou::SIZE, 3), 15, 3), 11, 0b111_0001_0010);
    let named = |name: &str, signal: &[u8; 2]| {
        (name.parse::<SatelliteId>().unwrap(), SignalCode::new(signal[0] - b'0', signal[1]))
    };
    let glonass = |number: usize| {
        let mut string = numbered(cut(glonass::SIZE, 4), 1, 4).remove(number);
        super::super::bits::Field::count(77, 8).put_raw(&mut string, 0);
        super::checks::glonass_guard(&mut string);
        string.push(0, 11);
        (0..3).map(|word| string.get(word * 32, 32) as u32).collect()
    };
    let inav = typed(cut(galileo::WORD, 6)).iter().map(galileo::inav_words).collect();
    let fnav = typed(cut(galileo::PAGE, 4)).iter().map(galileo::fnav_words).collect();
    let words = [
        (named("G07", b"1C"), gps.iter().map(super::checks::gps_words).collect()),
        (named("E11", b"1B"), inav),
        (named("E11", b"5I"), fnav),
        (named("C21", b"2I"), beidou.iter().map(super::checks::beidou_words).collect()),
        (named("R24", b"1C"), (0..4).map(glonass).collect()),
    ];
    words.into_iter().map(|((satellite, signal), words)| (satellite, signal, words)).collect()
}

proptest! {
    #[test]
    fn a_record_of_gps_comes_back_from_its_subframes(steps in -120_i64..120) {
        for name in ["G07", "J02"] {
            let record = record(name, BroadcastKind::Lnav, steps);
            let told = heard(record.satellite, "1C", lnav::words(&record).into());
            prop_assert_eq!(told, [Broadcast::Record(BroadcastRecord::Kepler(record))]);
        }
    }

    #[test]
    fn a_record_of_galileo_comes_back_from_its_pages(steps in -30_i64..30) {
        let model = IonosphereModel::NeQuickG { ionisation: [51.25, -0.25, 2_f64.powi(-15)] };
        for (kind, signal) in [(BroadcastKind::Inav, "1B"), (BroadcastKind::Fnav, "5I")] {
            let record = record("E11", kind, steps);
            let ionisation = [51.25, -0.25, 2_f64.powi(-15)];
            let words: Vec<_> = if kind == BroadcastKind::Inav {
                let bits = galileo::INAV.bits(&record, ionisation);
                typed(pages(&bits, galileo::WORD)).iter().map(galileo::inav_words).collect()
            } else {
                let bits = galileo::FNAV.bits(&record, ionisation);
                typed(pages(&bits, galileo::PAGE)).iter().map(galileo::fnav_words).collect()
            };
            let told = heard(record.satellite, signal, words);
            prop_assert!(told.contains(&Broadcast::Record(BroadcastRecord::Kepler(record))), "{told:?}");
            prop_assert!(told.contains(&Broadcast::Ionosphere(model)), "{told:?}");
        }
    }

    #[test]
    fn a_record_of_beidou_comes_back_from_its_subframes(steps in -500_i64..500) {
        let d1 = record("C21", BroadcastKind::D1, steps);
        let told = heard(d1.satellite, "2I", beidou::D1.words(&d1));
        prop_assert_eq!(told, [Broadcast::Record(BroadcastRecord::Kepler(d1))]);
        let d2 = record("C03", BroadcastKind::D2, steps);
        let told = heard(d2.satellite, "2I", beidou::D2.words(&d2));
        prop_assert_eq!(told, [Broadcast::Record(BroadcastRecord::Kepler(d2))]);
    }

    #[test]
    fn a_record_of_glonass_comes_back_from_its_strings(steps in -15_i64..15, quarter in -10_i64..10) {
        let whole = |power: i32| steps as f64 * 2_f64.powi(-power) * 1e3;
        let record = GlonassRecord {
            satellite: SatelliteId::new(Constellation::Glonass, 24).unwrap(),
            channel: -4,
            // a quarter of an hour in Moscow, whose day is ahead of UTC by whole hours
            reference: GpsTime::from_week(2381, (409_518 + 900 * quarter) * SECOND),
            position: [whole(11), -whole(11), 12_345e3],
            velocity: [whole(20), -whole(20), 0.0],
            acceleration: [whole(30), -whole(30), 0.0],
            clock_offset: steps as f64 * 2_f64.powi(-30),
            clock_drift: -steps as f64 * 2_f64.powi(-40),
            health: 3,
            age_days: 7.0,
        };
        let told = heard(record.satellite, "1C", glonass::words(&record, 18));
        prop_assert_eq!(told, [Broadcast::Record(BroadcastRecord::Glonass(record))]);
    }

    #[test]
    fn any_bits_behind_good_parities_are_taken_or_are_no_orbit(
        content in prop::collection::vec(any::<u8>(), 28 * 10),
        when in prop_oneof![any::<i64>(), Just(1_440_437_460_000_000_000)],
    ) {
        for (satellite, signal, words) in any_pages(&content) {
            let mut assembler = NavigationAssembler::new();
            for words in words {
                let words = NavigationWords { satellite, signal, channel: Some(0), words };
                let told = assembler.take(&words, GpsTime::from_nanos(when));
                let refused = matches!(told, Err(WordsRefusal::Implausible));
                prop_assert!(refused || told.is_ok(), "{satellite}: {told:?}");
            }
        }
    }

    #[test]
    fn no_words_make_the_assembler_panic(
        number in 1_u8..64,
        system in 0..Constellation::ALL.len(),
        signal in prop::sample::select(vec!["1C", "1B", "5I", "5Q", "2I", "7I", "6I", "2C"]),
        words in prop::collection::vec(any::<u32>(), 0..12),
        when in any::<i64>(),
    ) {
        let satellite = SatelliteId::new(Constellation::ALL[system], number).unwrap();
        let signal = SignalCode::new(signal.as_bytes()[0] - b'0', signal.as_bytes()[1]);
        let words = NavigationWords { satellite, signal, channel: None, words };
        let _ = NavigationAssembler::new().take(&words, GpsTime::from_nanos(when));
    }
}

#[test]
fn one_wrong_bit_is_refused() {
    let gps = record("G07", BroadcastKind::Lnav, 7);
    let galileo = record("E11", BroadcastKind::Inav, 7);
    let beidou = record("C21", BroadcastKind::D1, 7);
    let page = typed(pages(&galileo::INAV.bits(&galileo, [0.0; 3]), galileo::WORD)).remove(0);
    let cases = [
        (gps.satellite, SignalCode::new(1, b'C'), lnav::words(&gps)[0].clone(), 0..30),
        (galileo.satellite, SignalCode::new(1, b'B'), galileo::inav_words(&page), 16..30),
        (beidou.satellite, SignalCode::new(2, b'I'), beidou::D1.words(&beidou).remove(0), 0..15),
    ];
    for (satellite, signal, good, bits) in cases {
        let mut assembler = NavigationAssembler::new();
        let mut take = |words| {
            assembler.take(&NavigationWords { satellite, signal, channel: None, words }, now())
        };
        assert_eq!(take(good.clone()), Ok(vec![]));
        for bit in bits {
            let mut wrong = good.clone();
            wrong[0] ^= 1 << bit;
            assert_eq!(take(wrong), Err(WordsRefusal::Damaged), "{satellite} {bit}");
        }
        assert!(matches!(take(good[..2].to_vec()), Err(WordsRefusal::Short { found: 2, .. })));
    }
}

#[test]
fn subframes_of_two_issues_make_no_record() {
    let old = record("G07", BroadcastKind::Lnav, 7);
    let new = KeplerRecord { issue: 22, clock_issue: 22, ..old };
    let [first, second, _] = lnav::words(&old);
    let [.., third] = lnav::words(&new);
    assert_eq!(heard(old.satellite, "1C", vec![first, second, third]), []);
}

#[test]
fn a_record_is_told_once() {
    let record = record("G07", BroadcastKind::Lnav, 7);
    let twice = [lnav::words(&record), lnav::words(&record)].concat();
    assert_eq!(heard(record.satellite, "1C", twice).len(), 1);
}

#[test]
fn strings_of_two_frames_of_glonass_make_no_record() {
    let record = GlonassRecord {
        satellite: SatelliteId::new(Constellation::Glonass, 24).unwrap(),
        channel: -4,
        reference: now(),
        position: [12_345e3; 3],
        velocity: [0.0; 3],
        acceleration: [0.0; 3],
        clock_offset: 0.0,
        clock_drift: 0.0,
        health: 0,
        age_days: 0.0,
    };
    let satellite = record.satellite;
    let signal = SignalCode::new(1, b'C');
    for (late, records) in [(6, 1), (36, 0)] {
        let mut assembler = NavigationAssembler::new();
        let mut told = Vec::new();
        for (words, second) in glonass::words(&record, 18).into_iter().zip([0, 2, 4, late]) {
            let words = NavigationWords { satellite, signal, channel: Some(-4), words };
            let received = GpsTime::from_nanos(now().as_nanos() + second * SECOND);
            told.extend(assembler.take(&words, received).unwrap());
        }
        assert_eq!(told.len(), records, "{late}");
    }
}

#[test]
fn page_18_of_gps_tells_the_ionosphere_and_the_leap_seconds() {
    let alpha = [5.0 * 2_f64.powi(-30), -2.0_f64.powi(-27), 2_f64.powi(-24), -2.0_f64.powi(-24)];
    let beta = [2_f64.powi(11), -2.0_f64.powi(14), 2_f64.powi(16), -2.0_f64.powi(16)];
    let satellite = SatelliteId::new(Constellation::Gps, 7).unwrap();
    // now is Thursday, the fifth day of week 2381
    let (week, thursday) = (f64::from(2381_u16 % 256), 5.0);
    for (day, expected) in [(4.0, 19), (thursday, 18)] {
        let words = lnav::page_18_words(alpha, beta, [18.0, week, day, 19.0]);
        let told = heard(satellite, "1C", vec![words]);
        let model = IonosphereModel::Klobuchar { alpha, beta };
        assert_eq!(told, [Broadcast::Ionosphere(model), Broadcast::LeapSeconds(expected)]);
    }
}
