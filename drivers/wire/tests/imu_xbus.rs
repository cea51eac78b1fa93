//! Xbus: messages of a device, round trips, framing.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

mod frames;

use frames::{
    assert_frame_is_guarded, assert_splitting_does_not_matter, bytes_of_hex as hex, cut_all, stream,
};
use insd_base::UtcTime;
use insd_wire::binary::BinaryFault;
use insd_wire::imu::ImuMotion;
use insd_wire::imu::rotation::{delta_theta_of, quaternion_of};
use insd_wire::imu::xbus::{
    FINE_DAY, FINE_U32, MtData2, Orientation, Precision, Status, Utc, XbusAxes, look,
};
use insd_wire::nmea::CivilTime;
use insd_wire::stream::{Look, Protocol};
use proptest::prelude::*;

// From recordings of a device (xsens-go by Einride AB, MIT, testdata), one for each number format.
const FLOAT32: &str = "faff3662102002a9861060040314ed5310100c07440be007e301140d2f1837e02004018000
    0740200cbc8e5466c0e82f10bf9ad29e40100cb935269fbd949930bc46234680200cbb425c343b1068df3ae1c7e580
    30103f800001b778c7f03738d82737107feef7";
const FP1220: &str = "faff365f102002a9ea106004031518da10100c0e14204007e301140d2f1937e010010540210
    c00007d65ff8bb2caffebfc2e40110c00000141fffed645ffffccc580210cfffffb1b000003acffffffa6803110001
    00001fffffffa00000005000000006a";
const FP1632: &str = "faff3679102002aa4e1060040315446e10100c14f80ac007e301140d2f1a37e010010540221
    20bd2d9600000bc86a000fff8c82ab000fffe401212001e139f0000ed67c100fffffce1a784ffff80221200479ad20
    000006d5fbf0000ff0a3905ffff80321800000001000100005ba6000000008c010000fffec569ffff5d";
const FLOAT64: &str = "faff3693102002aab210600403156ff210100c1bc38b4007e301140d2f1b37e01001054023
    183f7132f3a0000000c01d0038a0000000bff3678d800000004013183f05f57a00000000bfb28f8020000000bf88d6
    7f800000008023183f149ade600000013f353d8280000000bf1850fdc00000008033203ff00000000000013e9a5fd4
    e00000003ebb3002e0000001be9f1ffd00000000cf";
const WITH_EULER: &str = "faff3671102002a9871060040314edb710100c07dca26007e301140d2f1837e02004000
    0000520300cc2c6ec743e083f53c33330cb40200c3ce7e9cbc11a8e2fbfd04d0c40100c39931323bdc5d49bbc8552c
    480200c3ab21f42bb513ab9bb51e94c8030103f80000136e3ff0cb785e822b78657df19";
// From the maker's protocol document, section 6.
const MANUAL: &str = "faff3631102002dfc51060040045 9da040200cbedc9afa3f549f37411cbb7080200cbbaa5c
    803b8c5501bb813300e020040000008145";
const GOTO_MEASUREMENT: &str = "faff1000f1";

const GOLDENS: [(&str, Precision); 4] = [
    (FLOAT32, Precision::Float32),
    (FP1220, Precision::Fp1220),
    (FP1632, Precision::Fp1632),
    (FLOAT64, Precision::Float64),
];

fn read(frame: &[u8]) -> MtData2 {
    MtData2::read(frame).unwrap_or_else(|fault| panic!("{frame:02x?}: {fault}"))
}

/// A message with a good checksum of any data.
fn message(id: u8, data: &[u8]) -> Vec<u8> {
    let length = u16::try_from(data.len()).unwrap();
    let [high, low] = length.to_be_bytes();
    let header = if length < 255 { vec![id, low] } else { vec![id, 255, high, low] };
    let sum = header.iter().chain(data).fold(0xFF_u8, |sum, byte| sum.wrapping_add(*byte));
    [&[0xFA, 0xFF], &header[..], data, &[sum.wrapping_neg()]].concat()
}

#[test]
fn the_example_of_the_manual_is_read() {
    let data = read(&hex(MANUAL));
    assert_eq!((data.counter, data.fine_time), (Some(57_285), Some(0x0045_9DA0)));
    assert_eq!(data.status, Some(Status::Word(0x81)));
    let reading = data.reading().unwrap();
    let ImuMotion::Rates { accel, .. } = reading.motion else { panic!() };
    assert!((accel[2] - 9.795_8).abs() < 1e-4);
    assert!(reading.valid);
}

#[test]
fn all_number_formats_of_a_device_are_read_and_written_as_they_came() {
    for (golden, precision) in GOLDENS {
        let data = read(&hex(golden));
        assert_eq!(data.write(precision), hex(golden), "{precision:?}");
        let push = data.acceleration.unwrap();
        assert!((push[1] + 7.26).abs() < 0.02 && (push[2] + 1.22).abs() < 0.04, "{push:?}");
    }
    assert_eq!(read(&hex(WITH_EULER)).write(Precision::Float32), hex(WITH_EULER));
}

#[test]
fn the_values_are_those_of_the_recordings_own_decoding() {
    let data = read(&hex(FLOAT32));
    assert_eq!((data.counter, data.fine_time), (Some(43_398), Some(51_703_123)));
    assert_eq!(data.status, Some(Status::Word(0x0180_0007)));
    assert_eq!(data.acceleration.unwrap()[0], -0.017_374_228_686_094_284);
    assert_eq!(data.delta_v.unwrap()[1], -0.072_557_806_968_688_96);
    assert_eq!(data.rate_of_turn.unwrap()[2], 0.001_722_571_090_795_099_7);
    assert_eq!(data.delta_q.unwrap()[0], 1.000_000_119_209_289_6);
    let fixed = read(&hex(FP1632));
    assert_eq!(fixed.acceleration.unwrap()[2], -1.218_098_640_441_894_5);
    assert_eq!(fixed.delta_q.unwrap()[3], -1.875_101_588_666_439e-5);
    let coarse = read(&hex(FP1220));
    assert_eq!(coarse.rate_of_turn.unwrap()[0], -0.001_194_953_918_457_031_2);
}

#[test]
fn a_message_of_a_device_is_a_sample() {
    let reading = read(&hex(FLOAT64)).reading().unwrap();
    let utc = UtcTime::from_civil((2019, 1, 20), (13, 47, 27), 465_800_000);
    assert_eq!(reading.utc, utc);
    assert_eq!(reading.status, 0x05);
    assert_eq!(reading.counter.unwrap().modulus, 1 << 16);
    let time = reading.device_time.unwrap();
    assert_eq!((time.ticks.value, time.ticks.modulus, time.tick), (51_736_562, FINE_U32, 1e-4));
    let day = read(&hex(FLOAT64)).reading_wrapping(FINE_DAY).unwrap();
    assert_eq!(day.device_time.unwrap().ticks.modulus, 864_000_000);
}

#[test]
fn the_delta_quaternion_of_a_device_is_its_rate_over_the_interval() {
    let data = read(&hex(FLOAT64));
    let ImuMotion::Increments { delta_theta, .. } = data.reading().unwrap().motion else {
        panic!()
    };
    for (turn, rate) in delta_theta.into_iter().zip(data.rate_of_turn.unwrap()) {
        assert!((turn - rate * 0.01).abs() < 1e-11, "{turn} {rate}");
    }
}

#[test]
fn clipped_accelerometers_and_gyros_make_the_sample_invalid() {
    let data = MtData2 {
        acceleration: Some([0.0; 3]),
        rate_of_turn: Some([0.0; 3]),
        ..MtData2::default()
    };
    assert!(data.reading().unwrap().valid);
    for bit in 0..32 {
        let sample = MtData2 { status: Some(Status::Word(1 << bit)), ..data };
        assert_eq!(sample.reading().unwrap().valid, !(8..14).contains(&bit), "bit {bit}");
    }
    let none = MtData2 { delta_q: Some([0.0; 4]), delta_v: Some([0.0; 3]), ..data };
    assert!(!none.reading().unwrap().valid);
}

#[test]
fn utc_is_believed_only_with_all_its_flags() {
    let civil = CivilTime::from_utc(UtcTime::from_nanos(1_700_000_000_123_456_789)).unwrap();
    for flags in 0..=u8::MAX {
        assert_eq!(Utc { civil, flags }.utc().is_some(), flags & 7 == 7);
    }
}

#[test]
fn other_messages_and_unknown_items_are_passed_over() {
    assert_eq!(look(&hex(GOTO_MEASUREMENT)), Look::Frame(5));
    assert_eq!(MtData2::read(&hex(GOTO_MEASUREMENT)), Err(BinaryFault::OtherMessage));
    let unknown = message(0x36, &[0x70, 0x10, 2, 0, 0, 0x10, 0x20, 2, 1, 2]);
    assert_eq!(read(&unknown), MtData2 { counter: Some(0x0102), ..MtData2::default() });
    let short = message(0x36, &[0x10, 0x20, 1, 0]);
    assert_eq!(MtData2::read(&short), Err(BinaryFault::Short { needed: 2, found: 1 }));
}

#[test]
fn extended_lengths_are_read_up_to_the_makers_limit() {
    let filler: Vec<u8> = [vec![0x70, 0x20, 97], vec![0; 97]].concat();
    let mut data = filler.repeat(20);
    data.extend([0x10, 0x20, 2, 7, 8]);
    let long = message(0x36, &data);
    assert_eq!(look(&long), Look::Frame(2005 + 7));
    assert_eq!(read(&long).counter, Some(0x0708));
    assert_eq!(look(&message(0x36, &filler.repeat(21))), Look::Nothing);
}

#[test]
fn impossible_headers_are_refused_at_their_first_wrong_byte() {
    for wrong in [
        &[0xFF][..],
        &[0xFA, 0x01],
        &[0xFA, 0xFF, 0x36, 0xFF, 0x00, 0xFE],
        &[0xFA, 0xFF, 0x36, 0xFF, 0x08, 0x01],
        &[0xFA, 0xFF, 0x36, 0x02],
        &[0xFA, 0xFF, 0x36, 0x05, 0x10, 0x20, 0x03],
        &[0xFA, 0xFF, 0x36, 0x06, 0x10, 0x20, 0x02, 0x00, 0x00],
    ] {
        assert_eq!(look(wrong), Look::Nothing, "{wrong:02x?}");
    }
}

#[test]
fn any_wrong_bit_is_found_and_no_reader_panics() {
    for golden in [FLOAT32, FP1220, FP1632, FLOAT64, WITH_EULER, MANUAL, GOTO_MEASUREMENT] {
        assert_frame_is_guarded(Protocol::Xbus, &hex(golden), |bytes| {
            assert!(MtData2::read(bytes).is_err());
        });
    }
}

#[test]
fn fixed_point_numbers_are_saturated() {
    let data = MtData2 { acceleration: Some([1e9, -1e9, 0.0]), ..MtData2::default() };
    for (precision, limit) in [(Precision::Fp1220, 2048.0), (Precision::Fp1632, 32_768.0)] {
        let [high, low, zero] = read(&data.write(precision)).acceleration.unwrap();
        assert!((high - limit).abs() < 1e-5 && high < limit);
        assert_eq!((low, zero), (-limit, 0.0));
    }
}

/// Half of a step of a number near a value.
fn half_step(precision: Precision, value: f64) -> f64 {
    match precision {
        Precision::Float32 => f64::from(f32::EPSILON) / 2.0 * value.abs(),
        Precision::Fp1220 => 2.0_f64.powi(-21),
        Precision::Fp1632 => 2.0_f64.powi(-33),
        Precision::Float64 => 0.0,
    }
}

fn near<const N: usize>(a: Option<[f64; N]>, b: Option<[f64; N]>, precision: Precision) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => a
            .iter()
            .zip(b)
            .all(|(a, b)| (a - b).abs() <= half_step(precision, b) * (1.0 + 1e-6) + 1e-300),
        (None, None) => true,
        _ => false,
    }
}

fn vector(most: f64) -> impl Strategy<Value = Option<[f64; 3]>> {
    prop::option::of(prop::array::uniform3(-most..most))
}

fn status() -> impl Strategy<Value = Option<Status>> {
    prop_oneof![
        Just(None),
        prop::num::u8::ANY.prop_map(|byte| Some(Status::Byte(byte))),
        prop::num::u32::ANY.prop_map(|word| Some(Status::Word(word))),
    ]
}

fn mtdata2() -> impl Strategy<Value = MtData2> {
    let utc = (0..4_000_000_000_000_000_000_i64, prop::num::u8::ANY).prop_map(|(nanos, flags)| {
        Utc { civil: CivilTime::from_utc(UtcTime::from_nanos(nanos)).unwrap(), flags }
    });
    let orientation = (
        prop::sample::select(vec![XbusAxes::Enu, XbusAxes::Ned, XbusAxes::Nwu]),
        prop::array::uniform3(-3.0..3.0),
    )
        .prop_map(|(axes, euler)| Orientation { axes, euler });
    let times = (
        prop::option::of(prop::num::u16::ANY),
        prop::option::of(prop::num::u32::ANY),
        prop::option::of(prop::num::u32::ANY),
        prop::option::of(utc),
    );
    let turn = vector(1.0).prop_map(|turn| turn.map(quaternion_of));
    let vectors = (vector(2000.0), vector(20.0), vector(40.0), turn);
    let rest = (status(), prop::option::of(orientation), prop::option::of(-50.0..90.0_f64));
    (times, vectors, rest).prop_map(|(times, vectors, (status, orientation, temperature))| {
        let (counter, fine_time, coarse_time, utc) = times;
        let (acceleration, delta_v, rate_of_turn, delta_q) = vectors;
        MtData2 {
            counter,
            fine_time,
            coarse_time,
            utc,
            status,
            orientation,
            acceleration,
            delta_v,
            rate_of_turn,
            delta_q,
            temperature,
        }
    })
}

proptest! {
    #[test]
    fn what_is_written_is_read_back_within_half_a_step(
        data in mtdata2(),
        precision in prop::sample::select(Precision::ALL.to_vec()),
    ) {
        let back = read(&data.write(precision));
        prop_assert!(near(back.acceleration, data.acceleration, precision));
        prop_assert!(near(back.delta_v, data.delta_v, precision));
        prop_assert!(near(back.rate_of_turn, data.rate_of_turn, precision));
        prop_assert!(near(back.delta_q, data.delta_q, precision));
        let single = |value: Option<f64>| value.map(|value| [value]);
        prop_assert!(near(single(back.temperature), single(data.temperature), precision));
        if let (Some(back), Some(data)) = (back.orientation, data.orientation) {
            let degrees = |angles: [f64; 3]| Some(angles.map(f64::to_degrees));
            prop_assert_eq!(back.axes, data.axes);
            let loose = if precision == Precision::Float64 { Precision::Fp1632 } else { precision };
            prop_assert!(near(degrees(back.euler), degrees(data.euler), loose));
        }
        prop_assert_eq!(back.orientation.is_some(), data.orientation.is_some());
        let exact = |data: MtData2| {
            (data.counter, data.fine_time, data.coarse_time, data.utc, data.status)
        };
        prop_assert_eq!(exact(back), exact(data));
    }

    #[test]
    fn a_delta_theta_survives_the_wire_in_double_precision(
        turn in prop::array::uniform3(-1.7..1.7_f64),
    ) {
        let data = MtData2 { delta_q: Some(quaternion_of(turn)), ..MtData2::default() };
        let back = read(&data.write(Precision::Float64)).delta_q.unwrap();
        for (found, written) in delta_theta_of(back).into_iter().zip(turn) {
            prop_assert!((found - written).abs() < 1e-12);
        }
    }

    #[test]
    fn the_frames_are_the_same_in_any_splitting(
        (bytes, places) in stream([FLOAT32, FP1220, WITH_EULER, GOTO_MEASUREMENT].map(hex).to_vec()),
    ) {
        assert_splitting_does_not_matter(Protocol::Xbus, &bytes, &places);
    }

    #[test]
    fn no_bytes_make_a_reader_panic(
        items in prop::collection::vec(
            (prop::num::u8::ANY, prop::num::u8::ANY, prop::collection::vec(prop::num::u8::ANY, 0..40)),
            0..12),
        noise in prop::collection::vec(prop::num::u8::ANY, 1..200),
    ) {
        let _ = MtData2::read(&noise);
        let _ = cut_all(Protocol::Xbus, &noise[..]);
        let item = |(high, low, data): (u8, u8, Vec<u8>)| {
            [&[high, low, u8::try_from(data.len()).unwrap()], &data[..]].concat()
        };
        let whole = message(0x36, &items.into_iter().flat_map(item).collect::<Vec<_>>());
        prop_assert_eq!(look(&whole), Look::Frame(whole.len()));
        if let Ok(data) = MtData2::read(&whole) {
            let _ = data.reading();
        }
    }
}
