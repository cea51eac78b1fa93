//! RTCM 10403 of a recorded base against RINEX that an independent program made of the same bytes, and messages that an independent
//! library has written.

#![allow(clippy::unwrap_used, clippy::panic, dead_code)] // helpers of tests are not seen as tests

#[path = "raw_gnss/rinex.rs"]
mod rinex;

use std::collections::BTreeSet;

use insd_base::satellites::BroadcastRecord;
use insd_base::{GpsTime, UtcTime};
use insd_wire::binary::Fault;
use insd_wire::gnss::rtcm::{Correction, Frame, MsmCollector};
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
    assert_eq!(refused, Err(Fault::Range { field: "DF396" }));
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
        Err(Fault::Range { .. }) => None,
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

proptest! {
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
