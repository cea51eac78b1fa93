//! RTCM 10403 of a recorded base against RINEX that an independent program made of the same bytes, and messages that an independent
//! library has written.

#![allow(clippy::unwrap_used, clippy::panic, dead_code)] // helpers of tests are not seen as tests

#[path = "raw_gnss/rinex.rs"]
mod rinex;

use std::collections::BTreeSet;

use insd_base::satellites::{
    BroadcastRecord, Constellation, SatelliteEpoch, SatelliteId, SignalCode, SignalObservation,
};
use insd_base::{GpsTime, UtcTime};
use insd_wire::binary::BinaryFault;
use insd_wire::gnss::rtcm::{Correction, Frame, MsmCollector, MsmWriter, write_record};
use insd_wire::stream::{Cutter, Protocol};
use proptest::prelude::*;
use rinex::Compared;
use rtcm_rs::{Message, MessageFrame};

/// Messages of a base, one of each kind.
const RECORDED: &[u8] = include_bytes!("data/rtcm3.bin");

/// When the recording was made, to half a day.
fn received() -> GpsTime {
    UtcTime::from_civil((2023, 1, 3), (12, 0, 0), 0).unwrap().to_gps()
}

/// What is told by a stream, and how many messages were refused.
fn heard(bytes: &[u8]) -> (Vec<Correction>, usize) {
    let (mut cutter, mut collector) = (Cutter::new(&[Protocol::Rtcm]), MsmCollector::new());
    cutter.push(bytes);
    let (mut told, mut refused) = (Vec::new(), 0);
    while let Some(cut) = cutter.cut() {
        match collector.take(cut.bytes, received()) {
            Ok(more) => told.extend(more),
            Err(_) => refused += 1,
        }
    }
    (told, refused)
}

#[test]
fn a_recorded_base_says_what_rinex_of_another_program_says() {
    let (told, refused) = heard(RECORDED);
    assert_eq!(refused, 0);
    let [Correction::Base(base), Correction::Epoch(epoch)] = &told[..] else { panic!("{told:?}") };
    assert_eq!(base.height, None);
    let radius = base.position.iter().map(|axis| axis * axis).sum::<f64>().sqrt();
    assert!((6.35e6..6.39e6).contains(&radius), "{base:?}");
    assert_eq!(epoch.signals.len(), 51);
    let told = include_str!("data/rtcm3.obs");
    let compared = rinex::compare_observations(std::slice::from_ref(epoch), told, |_| false);
    let Compared { codes, phases, dopplers, densities, .. } = compared;
    assert_eq!([codes, phases, dopplers, densities], [51; 4]);
}

#[test]
fn a_recorded_base_that_is_cut_or_has_wrong_bits_makes_nothing_panic() {
    for length in 0..RECORDED.len() {
        heard(&RECORDED[..length]);
    }
    let (mut cutter, mut messages) = (Cutter::new(&[Protocol::Rtcm]), Vec::new());
    cutter.push(RECORDED);
    while let Some(cut) = cutter.cut() {
        messages.push(Frame::open(cut.bytes).unwrap().message.to_vec());
    }
    for (message, bit) in
        messages.iter().flat_map(|own| (0..own.len() * 8).map(move |bit| (own, bit)))
    {
        let mut wrong = message.clone();
        wrong[bit / 8] ^= 1 << (bit % 8);
        heard(&Frame { message: &wrong }.write());
        heard(&Frame { message: &message[..bit / 8] }.write());
    }
}

#[test]
fn a_message_of_more_than_64_cells_is_refused() {
    let mut message = vec![0; 200];
    message[..2].copy_from_slice(&(1077_u16 << 4).to_be_bytes());
    // all satellites, all signals
    message[9..22].fill(0xFF);
    let frame = Frame { message: &message }.write();
    let refused = MsmCollector::new().take(&frame, received());
    assert_eq!(refused, Err(BinaryFault::Range { field: "DF396" }));
}

/// A message with a number and any bits behind it.
fn any_message(number: u16, rest: &[u8]) -> Vec<u8> {
    let mut message = rest.to_vec();
    let [high, low] = (number << 4).to_be_bytes();
    message[0] = high;
    message[1] = low | message[1] & 15;
    Frame { message: &message }.write()
}

/// The record that we read of a message, and what the other library reads.
fn both(number: u16, rest: &[u8]) -> (Option<BroadcastRecord>, Message) {
    let frame = any_message(number, rest);
    let told = MsmCollector::new().take(&frame, received());
    let record = match told.as_deref() {
        Ok([Correction::Record(record)]) => Some(*record),
        Err(BinaryFault::Range { .. }) => None,
        other => panic!("{other:?}"),
    };
    (record, MessageFrame::new(&frame).unwrap().get_message())
}

/// Seconds of the week of an instant.
fn of_week(time: GpsTime) -> f64 {
    (time.to_week().1 / 1_000_000_000) as f64
}

/// A number of the library, which keeps short fields in single precision.
fn wide(number: impl Into<f64>) -> f64 {
    number.into()
}

/// All numbers that a message of the library and a record have in common.
macro_rules! same_orbit {
    ($told:ident, $own:ident, $behind:literal) => {{
        let (orbit, clock) = (&$own.orbit, &$own.clock);
        let pi = std::f64::consts::PI;
        let same = |own: f64, told: f64| (own - told).abs() <= 1e-14 * told.abs();
        prop_assert_eq!(
            wide($told.toe_s),
            (of_week(orbit.reference) - $behind).rem_euclid(604_800.0)
        );
        prop_assert_eq!(
            wide($told.toc_s),
            (of_week(clock.reference) - $behind).rem_euclid(604_800.0)
        );
        let pairs = [
            (orbit.sqrt_a, wide($told.sqrt_a_sqrt_m)),
            (orbit.eccentricity, wide($told.eccentricity)),
            (orbit.m0, wide($told.m0_sc) * pi),
            (orbit.delta_n, wide($told.delta_n_sc_s) * pi),
            (orbit.omega, wide($told.omega_sc) * pi),
            (orbit.omega0, wide($told.omega0_sc) * pi),
            (orbit.omega_dot, wide($told.omegadot_sc_s) * pi),
            (orbit.i0, wide($told.i0_sc) * pi),
            (orbit.i_dot, wide($told.idot_sc_s) * pi),
            (orbit.cuc, wide($told.cuc_rad)),
            (orbit.cus, wide($told.cus_rad)),
            (orbit.crc, wide($told.crc_m)),
            (orbit.crs, wide($told.crs_m)),
            (orbit.cic, wide($told.cic_rad)),
            (orbit.cis, wide($told.cis_rad)),
        ];
        for (number, (own, told)) in pairs.into_iter().enumerate() {
            prop_assert!(same(own, told), "{number}: {own} {told}");
        }
    }};
}

/// Writes the masks of satellites and signals into a message whose header has its usual 73 bits.
fn masks(message: &mut [u8], places: &BTreeSet<u8>, signals: &[u8]) {
    let mut set = |at: usize, value: bool| {
        let mask = 0x80 >> (at % 8);
        message[at / 8] = if value { message[at / 8] | mask } else { message[at / 8] & !mask };
    };
    (1..=64).for_each(|place| set(72 + usize::from(place), places.contains(&place)));
    (1..=32).for_each(|place| set(136 + usize::from(place), signals.contains(&place)));
}

/// Every measurement of an epoch is that of the other library, and none is missing of a signal that both know.
macro_rules! same_msm {
    ($epoch:ident, $told:expr, $range:ident, $phase:ident) => {{
        let told = $told;
        let mut measurements = $epoch.signals.iter();
        for cell in told.signal_data.iter() {
            let name = format!("{}{}", cell.signal_id.band(), cell.signal_id.attribute());
            let Some(own) = measurements.next() else { panic!("{name} is missing") };
            prop_assert_eq!(own.signal.to_string(), name);
            let mut satellites = told.satellite_data.iter();
            let satellite = satellites.find(|own| own.satellite_id == cell.satellite_id).unwrap();
            let rough = satellite
                .gnss_satellite_rough_range_integer_ms
                .map(|whole| f64::from(whole) + satellite.gnss_satellite_rough_range_mod1ms_ms);
            let range = |fine: Option<f64>| Some((rough? + fine?) * 299_792.458);
            prop_assert_eq!(own.code, range(cell.$range.map(wide)));
            let phase =
                own.wavelength().and_then(|length| Some(range(cell.$phase.map(wide))? / length));
            prop_assert_eq!(own.phase, phase);
            prop_assert_eq!(own.half_cycle, phase.is_some() && cell.half_cycle_ambiguity_ind == 1);
        }
        prop_assert!(measurements.next().is_none());
    }};
}

/// The greatest differences of two epochs: code, m; phase, cycles; Doppler shift, Hz; density, dB. Signals are the same, whole cycles of a phase are not
/// looked at.
fn apart(one: &SatelliteEpoch, other: &SatelliteEpoch) -> [f64; 4] {
    assert_eq!(one.tag, other.tag);
    let mut others = other.signals.clone();
    let mut apart = [0.0_f64; 4];
    for own in &one.signals {
        let is_it = |other: &SignalObservation| {
            (other.satellite, other.signal) == (own.satellite, own.signal)
        };
        let other = others.remove(others.iter().position(is_it).unwrap());
        assert_eq!((own.channel, own.half_cycle), (other.channel, other.half_cycle), "{own:?}");
        let cycles = |a: f64, b: f64| (a - b - (a - b).round()).abs();
        let pairs = [
            (own.code, other.code),
            (own.phase, other.phase),
            (own.doppler, other.doppler),
            (own.cn0, other.cn0),
        ];
        for (at, pair) in pairs.into_iter().enumerate() {
            let off = match pair {
                (Some(a), Some(b)) if at == 1 => cycles(a, b),
                (Some(a), Some(b)) => (a - b).abs(),
                (None, None) => 0.0,
                _ => panic!("{own:?} {other:?}"),
            };
            apart[at] = apart[at].max(off);
        }
    }
    assert_eq!(others, []);
    apart
}

/// What frames say, put together.
fn read(frames: &[Vec<u8>], about: GpsTime) -> Vec<Correction> {
    let mut collector = MsmCollector::new();
    frames.iter().flat_map(|frame| collector.take(frame, about).unwrap()).collect()
}

#[test]
fn a_recorded_base_that_is_written_again_says_the_same() {
    let (told, _) = heard(RECORDED);
    let [Correction::Base(base), Correction::Epoch(epoch)] = &told[..] else { panic!("{told:?}") };
    assert_eq!(read(&[base.write()], received()), [Correction::Base(*base)]);
    let high = insd_wire::gnss::rtcm::BaseStation { height: Some(1.25), ..*base };
    assert_eq!(read(&[high.write()], received()), [Correction::Base(high)]);
    let again = read(&MsmWriter::new(7).write(epoch), received());
    let [Correction::Epoch(again)] = &again[..] else { panic!("{again:?}") };
    let apart = apart(epoch, again);
    assert!(apart.iter().all(|own| *own < 1e-6), "{apart:?}");
    let locks = epoch.signals.iter().zip(&again.signals);
    assert!(locks.filter(|(own, other)| own.lock != other.lock).count() == 0);
}

/// A signal that a base may measure.
fn any_signal(constellation: Constellation) -> impl Strategy<Value = SignalObservation> {
    let codes = match constellation {
        Constellation::Gps => ["1C", "2W", "2X", "5Q"],
        Constellation::Glonass => ["1C", "1P", "2C", "2P"],
        Constellation::Galileo => ["1X", "6C", "7Q", "5X"],
        Constellation::BeiDou => ["2I", "6I", "7I", "5P"],
        _ => ["1C", "1C", "5X", "5X"],
    };
    let code = prop::sample::select(codes.to_vec());
    let measured = (2.0e7..4.2e7, -1e8..1e8, -4000.0..4000.0, 20.0..60.0, 0.0..6e4);
    let known = prop::array::uniform4(prop::bool::weighted(0.9));
    (1_u8..20, code, measured, known, any::<bool>()).prop_map(
        move |(number, code, told, known, half)| {
            let [band, attribute] = code.as_bytes() else { panic!("{code}") };
            // PRN 120 is S20
            let first = if constellation == Constellation::Sbas { 19 } else { 0 };
            let satellite = SatelliteId::new(constellation, number + first).unwrap();
            let (range, phase, doppler, density, lock) = told;
            let [has_code, has_phase, has_doppler, has_density] = known;
            let channel =
                (constellation == Constellation::Glonass).then_some(number as i8 % 14 - 7);
            let own = SignalObservation {
                channel,
                // signals of a satellite have come the same way, to some metres
                code: has_code.then_some(2.1e7 + f64::from(number) * 1e6 + range % 40.0),
                phase: (has_phase && has_code).then_some(phase),
                cn0: has_density.then_some(density),
                lock: Some(lock),
                half_cycle: half && has_phase && has_code,
                ..SignalObservation::unknown(satellite, SignalCode::new(band - b'0', *attribute))
            };
            // and go it alike, to a metre a second
            let rate = f64::from(number) * 20.0 + doppler % 0.5;
            let doppler = own.wavelength().filter(|_| has_doppler).map(|length| rate / length);
            SignalObservation { doppler, ..own }
        },
    )
}

/// An epoch of a base, each signal once.
fn any_epoch() -> impl Strategy<Value = SatelliteEpoch> {
    use Constellation as C;
    let each = [C::Gps, C::Glonass, C::Galileo, C::Sbas, C::Qzss, C::BeiDou]
        .map(|own| prop::collection::vec(any_signal(own), 0..60));
    (each, 0..604_800_000_i64).prop_map(|(each, of_week)| {
        let mut signals = each.concat();
        signals.retain(|own| own.satellite.constellation != C::Qzss || own.satellite.number <= 10);
        signals.sort_by_key(|own| (own.satellite, own.signal));
        signals.dedup_by_key(|own| (own.satellite, own.signal));
        let tag = received().nearest_with_tow(of_week * 1_000_000);
        SatelliteEpoch { tag, signals, leap_seconds: None, clock_reset: false }
    })
}

#[test]
fn a_phase_that_drifts_away_from_its_code_is_counted_anew_and_its_lock_begins_there() {
    let satellite = SatelliteId::new(Constellation::Gps, 7).unwrap();
    let mut writer = MsmWriter::new(1);
    let mut epoch = SatelliteEpoch {
        tag: received(),
        signals: vec![SignalObservation {
            code: Some(2.2e7),
            phase: Some(0.25),
            lock: Some(600.0),
            ..SignalObservation::unknown(satellite, SignalCode::new(1, b'C'))
        }],
        leap_seconds: None,
        clock_reset: false,
    };
    let (mut anew, mut last) = (0, None);
    for _ in 0..20 {
        let frames = writer.write(&epoch);
        let [Correction::Epoch(told)] = &read(&frames, received())[..] else { panic!() };
        let (own, signal) = (&told.signals[0], &mut epoch.signals[0]);
        let whole = signal.phase.unwrap() - own.phase.unwrap();
        assert!((whole - whole.round()).abs() < 1e-3, "{whole}");
        let begins = last.is_some_and(|last: f64| (last - whole).abs() > 0.5);
        assert_eq!(begins, own.lock == Some(0.0));
        anew += usize::from(begins);
        last = Some(whole);
        // codes and phases part by 100 m an epoch, as an ionosphere never does
        signal.code = signal.code.map(|code| code + 50.0);
        signal.phase = signal.phase.map(|phase| phase - 50.0 / own.wavelength().unwrap());
    }
    assert_eq!(anew, 2);
}

proptest! {
    #[test]
    fn any_epoch_that_is_written_is_read_to_half_a_step(epoch in any_epoch()) {
        let told = read(&MsmWriter::new(4095).write(&epoch), epoch.tag);
        if epoch.signals.is_empty() {
            prop_assert_eq!(told, []);
            return Ok(());
        }
        let [Correction::Epoch(told)] = &told[..] else { panic!("{} messages", told.len()) };
        let [code, phase, doppler, density] = apart(&epoch, told);
        // half of 2^-29 and 2^-31 ms, of 1e-4 m/s and of 1/16 dB
        prop_assert!(code < 2.9e-4 && phase < 8e-4 && doppler < 8e-4 && density < 0.032);
        for (own, other) in epoch.signals.iter().filter_map(|own| Some((own, told.signals.iter().find(|other| (other.satellite, other.signal) == (own.satellite, own.signal))?))) {
            let (own, other) = (own.lock.unwrap(), other.lock.unwrap());
            prop_assert!(other <= own && own <= 1.04 * other + 0.002, "{} {}", own, other);
        }
    }

    #[test]
    fn any_record_that_is_written_is_read_again(rest in prop::collection::vec(any::<u8>(), 64)) {
        for number in [1019, 1020, 1042, 1044, 1045, 1046] {
            let Ok(told) = MsmCollector::new().take(&any_message(number, &rest), received()) else { continue };
            let [Correction::Record(record)] = &told[..] else { panic!("{told:?}") };
            let frame = write_record(record).unwrap();
            prop_assert_eq!(Frame::open(&frame).unwrap().number(), Some(number));
            prop_assert_eq!(&read(std::slice::from_ref(&frame), received()), &told);
            let week = match MessageFrame::new(&frame).unwrap().get_message() {
                Message::Msg1019(told) => i64::from(told.gps_week_number),
                Message::Msg1042(told) => i64::from(told.bds_week_number) + 1356,
                Message::Msg1044(told) => i64::from(told.qzss_week_number),
                Message::Msg1045(told) => i64::from(told.gal_week_number) + 1024,
                Message::Msg1046(told) => i64::from(told.gal_week_number) + 1024,
                _ => continue,
            };
            let BroadcastRecord::Kepler(kepler) = record else { panic!("{record:?}") };
            let behind = if number == 1042 { 14_000_000_000 } else { 0 };
            let reference = kepler.orbit.reference.as_nanos() - behind;
            prop_assert_eq!((GpsTime::from_nanos(reference).to_week().0 - week) % 1024, 0);
        }
    }

    #[test]
    fn any_orbit_is_read_as_another_library_reads_it(rest in prop::collection::vec(any::<u8>(), 64)) {
        for number in [1019, 1042, 1044, 1045, 1046] {
            let (own, told) = both(number, &rest);
            let Some(BroadcastRecord::Kepler(own)) = own else { continue };
            match told {
                Message::Msg1019(told) => {
                    same_orbit!(told, own, 0.0);
                    prop_assert_eq!((own.issue, own.clock_issue), (told.iode.into(), told.iodc));
                    prop_assert_eq!(own.group_delays[0], wide(told.tgd_s));
                    prop_assert_eq!([own.clock.a0, own.clock.a1, own.clock.a2], [wide(told.af0_s), wide(told.af1_s_s), wide(told.af2_s_s2)]);
                    prop_assert_eq!(own.health, u16::from(told.sv_health_ind));
                }
                Message::Msg1042(told) => {
                    same_orbit!(told, own, 14.0);
                    prop_assert_eq!((own.issue, own.clock_issue), (told.aode.into(), told.aodc.into()));
                    let delays = [wide(told.tgd1_s), wide(told.tgd2_s)];
                    prop_assert!(own.group_delays.iter().zip(delays).all(|(own, told)| (own - told).abs() <= 1e-7 * told.abs()));
                    prop_assert_eq!([own.clock.a0, own.clock.a1, own.clock.a2], [wide(told.a0_s), wide(told.a1_s_s), wide(told.a2_s_s2)]);
                }
                Message::Msg1044(told) => {
                    same_orbit!(told, own, 0.0);
                    prop_assert_eq!((own.issue, own.clock_issue), (told.iode.into(), told.iodc));
                    prop_assert_eq!(own.group_delays[0], wide(told.tgd_s));
                    prop_assert_eq!([own.clock.a0, own.clock.a1, own.clock.a2], [wide(told.af0_s), wide(told.af1_s_s), wide(told.af2_s_s2)]);
                }
                Message::Msg1045(told) => {
                    same_orbit!(told, own, 0.0);
                    prop_assert_eq!(own.issue, told.iodnav);
                    prop_assert_eq!(own.group_delays, [wide(told.bgd_e1_e5a_s), 0.0]);
                    prop_assert_eq!([own.clock.a0, own.clock.a1, own.clock.a2], [wide(told.af0_s), wide(told.af1_s_s), wide(told.af2_s_s2)]);
                }
                Message::Msg1046(told) => {
                    same_orbit!(told, own, 0.0);
                    prop_assert_eq!(own.group_delays, [wide(told.bgd_e1_e5a_s), wide(told.bgd_e1_e5b_s)]);
                    prop_assert_eq!([own.clock.a0, own.clock.a1, own.clock.a2], [wide(told.af0_s), wide(told.af1_s_s), wide(told.af2_s_s2)]);
                    prop_assert_eq!(own.health >> 7, u16::from(told.e5b_sig_health_ind));
                    prop_assert_eq!(own.health >> 1 & 3, u16::from(told.e1_b_sig_health_ind));
                }
                other => panic!("{other:?}"),
            }
        }
    }

    #[test]
    fn any_state_of_glonass_is_read_as_another_library_reads_it(rest in prop::collection::vec(any::<u8>(), 45)) {
        let (own, told) = both(1020, &rest);
        if let (Some(BroadcastRecord::Glonass(own)), Message::Msg1020(told)) = (own, told) {
            let km = |value: f64| value * 1e3;
            let states = [
                (own.position, [wide(told.xn_km), wide(told.yn_km), wide(told.zn_km)]),
                (own.velocity, [wide(told.xn_first_deriv_km_s), wide(told.yn_first_deriv_km_s), wide(told.zn_first_deriv_km_s)]),
                (own.acceleration, [wide(told.xn_second_deriv_km_s2), wide(told.yn_second_deriv_km_s2), wide(told.zn_second_deriv_km_s2)]),
            ];
            for (own, told) in states {
                for (own, told) in own.into_iter().zip(told.map(km)) {
                    prop_assert!((own - told).abs() <= 1e-14 * told.abs(), "{own} {told}");
                }
            }
            prop_assert_eq!(own.channel, told.glo_satellite_freq_chan_number);
            prop_assert_eq!((own.clock_drift, -own.clock_offset), (wide(told.gamma_n), wide(told.tau_n_s)));
        }
    }

    #[test]
    fn any_measurements_are_read_as_another_library_reads_them(
        places in prop::collection::btree_set(1_u8..=24, 1..5),
        signals in prop::sample::subsequence(vec![0_usize, 1, 2, 3], 1..4),
        rest in prop::collection::vec(any::<u8>(), 200),
    ) {
        for (number, known) in [
            (1074, [2, 3, 15, 22]),
            (1077, [2, 10, 16, 32]),
            (1087, [2, 3, 8, 9]),
            (1097, [2, 4, 15, 23]),
            (1107, [2, 22, 23, 24]),
            (1117, [2, 9, 16, 31]),
            (1127, [2, 8, 14, 16]),
        ] {
            let signals: Vec<u8> = signals.iter().map(|at| known[*at]).collect();
            let mut rest = rest.clone();
            // the last message of its epoch
            rest[6] &= 0xFD;
            masks(&mut rest, &places, &signals);
            let frame = any_message(number, &rest);
            let told = MsmCollector::new().take(&frame, received()).unwrap();
            let [Correction::Epoch(epoch)] = &told[..] else { panic!("{told:?}") };
            match MessageFrame::new(&frame).unwrap().get_message() {
                Message::Msg1074(told) => same_msm!(epoch, told.data_segment, gnss_signal_fine_pseudorange_ms, gnss_signal_fine_phaserange_ms),
                Message::Msg1077(told) => same_msm!(epoch, told.data_segment, gnss_signal_fine_pseudorange_ext_ms, gnss_signal_fine_phaserange_ext_ms),
                Message::Msg1087(told) => same_msm!(epoch, told.data_segment, gnss_signal_fine_pseudorange_ext_ms, gnss_signal_fine_phaserange_ext_ms),
                Message::Msg1097(told) => same_msm!(epoch, told.data_segment, gnss_signal_fine_pseudorange_ext_ms, gnss_signal_fine_phaserange_ext_ms),
                Message::Msg1107(told) => same_msm!(epoch, told.data_segment, gnss_signal_fine_pseudorange_ext_ms, gnss_signal_fine_phaserange_ext_ms),
                Message::Msg1117(told) => same_msm!(epoch, told.data_segment, gnss_signal_fine_pseudorange_ext_ms, gnss_signal_fine_phaserange_ext_ms),
                Message::Msg1127(told) => same_msm!(epoch, told.data_segment, gnss_signal_fine_pseudorange_ext_ms, gnss_signal_fine_phaserange_ext_ms),
                other => panic!("{number} {other:?}"),
            }
        }
    }
}
