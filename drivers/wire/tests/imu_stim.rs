//! STIM300: the numbers of its data sheet, round trips, and any bytes. No recorded datagram was found.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod frames;

use frames::{bytes_of_hex, cut_all, is_robust, is_split_anyhow};
use insd_base::units::DEG;
use insd_wire::binary::BinaryFault;
use insd_wire::imu::ImuMotion;
use insd_wire::imu::stim::{
    StimConfiguration, StimDatagram, StimFormat, StimGroup, StimInput, StimKind, StimRange, look,
};
use insd_wire::stream::{Look, Protocol};
use proptest::prelude::*;

const FORMAT: StimFormat = StimFormat {
    gyro: StimKind::Rate,
    accel: StimKind::Rate,
    range: StimRange::G10,
    interval: Some(0.002),
};

fn group(count: i32) -> StimGroup {
    StimGroup { counts: [count, -count, 0], status: 0 }
}

fn datagram() -> StimDatagram {
    StimDatagram {
        rate: group(1 << 14),
        acceleration: Some(group(1 << 19)),
        counter: 200,
        latency: 1500,
        ..StimDatagram::default()
    }
}

#[test]
fn one_degree_per_second_and_one_g_are_the_powers_of_two_of_the_data_sheet() {
    let reading = datagram().reading(&FORMAT).unwrap();
    let expected = ImuMotion::Rates { gyro: [DEG, -DEG, 0.0], accel: [9.806_65, -9.806_65, 0.0] };
    assert_eq!(reading.motion, expected);
    assert_eq!(reading.latency, Some(0.0015));
    let counter = reading.counter.unwrap();
    assert_eq!((counter.value, counter.modulus, reading.valid), (200, 256, true));
    let bits = [21, 20, 19, 18, 16];
    let ranges = [StimRange::G2, StimRange::G5, StimRange::G10, StimRange::G30, StimRange::G80];
    for (bits, range) in bits.into_iter().zip(ranges) {
        let motion = ImuMotion::Rates { gyro: [0.0; 3], accel: [9.806_65; 3] };
        let (_, counts) = StimFormat { range, ..FORMAT }.counts(&motion).unwrap();
        assert_eq!(counts, [1 << bits; 3]);
        let accel = StimKind::Increment;
        let format = StimFormat { range, accel, gyro: accel, ..FORMAT };
        let motion = ImuMotion::Increments { delta_theta: [DEG; 3], delta_velocity: [0.25; 3] };
        assert_eq!(format.counts(&motion).unwrap(), ([1 << 21; 3], [1 << (bits + 1); 3]));
    }
}

#[test]
fn rates_beside_increments_become_increments() {
    let format = StimFormat { gyro: StimKind::Increment, ..FORMAT };
    let Some(ImuMotion::Increments { delta_theta, delta_velocity }) =
        datagram().reading(&format).map(|reading| reading.motion)
    else {
        unreachable!()
    };
    assert!((delta_theta[0] - DEG / 128.0).abs() < 1e-15);
    assert!((delta_velocity[0] - 9.806_65 * 0.002).abs() < 1e-12);
    let triggered = StimFormat { interval: None, ..format };
    assert_eq!(datagram().reading(&triggered), None, "no interval is not an interval of zero");
    let sums = StimFormat { accel: StimKind::Integrated, ..FORMAT };
    assert_eq!(datagram().reading(&sums), None);
    assert_eq!(StimDatagram { acceleration: None, ..datagram() }.reading(&FORMAT), None);
}

#[test]
fn any_status_bit_of_gyroscopes_or_accelerometers_makes_the_sample_invalid() {
    let overload = StimGroup { status: 0x11, ..group(5) };
    let rate = StimDatagram { rate: overload, ..datagram() }.reading(&FORMAT).unwrap();
    assert_eq!((rate.valid, rate.status), (false, 0x11));
    let accel = StimDatagram { acceleration: Some(overload), ..datagram() };
    let accel = accel.reading(&FORMAT).unwrap();
    assert_eq!((accel.valid, accel.status), (false, 0x1100));
}

#[test]
fn temperature_is_the_mean_of_the_gyroscopes() {
    let warm = StimGroup { counts: [20 << 8, 21 << 8, 22 << 8], status: 0 };
    let temperatures = Some([warm, group(0), group(0)]);
    let reading = StimDatagram { temperatures, ..datagram() }.reading(&FORMAT).unwrap();
    assert_eq!(reading.temperature, Some(21.0));
}

#[test]
fn the_crc_is_taken_over_zeros_as_well() {
    // a rate datagram of zeros: its 14 bytes and two zeros under CRC-32/MPEG-2
    let body = [&[0x90_u8][..], &[0; 15]].concat();
    let mut crc = u32::MAX;
    for byte in body {
        crc ^= u32::from(byte) << 24;
        for _ in 0..8 {
            crc = crc << 1 ^ if crc >> 31 == 1 { 0x04C1_1DB7 } else { 0 };
        }
    }
    let frame = StimDatagram::default().write();
    assert_eq!(frame.len(), 18);
    assert_eq!(frame[14..], crc.to_be_bytes());
}

#[test]
fn line_ends_are_filler_and_other_datagrams_are_told_apart() {
    let frame = datagram().write();
    let configuration = StimConfiguration {
        revision: b'H',
        firmware: 23,
        format: FORMAT,
        groups: [true, false, false, false, false],
        line_ends: true,
    };
    let told = configuration.write();
    let bytes = [&frame[..], b"\r\n", &told, b"\r\n", &frame].concat();
    assert_eq!(cut_all(Protocol::Stim, &bytes), [frame.clone(), told.clone(), frame.clone()]);
    assert_eq!(look(b"\r"), Look::Filler(1));
    assert_eq!(StimDatagram::read(&told), Err(BinaryFault::OtherMessage));
    assert_eq!(StimConfiguration::read(&frame), Err(BinaryFault::OtherMessage));
    assert_eq!(StimConfiguration::read(&told), Ok(configuration));
}

#[test]
fn the_configuration_datagram_is_read_by_its_table() {
    // revision H, firmware 23; 1000 Hz, PPS, temperatures, accelerations; 921.6 kbit/s; all axes, gyro
    // angle delayed; accelerometers velocity since the sample, 5 g
    let body = "BC 48 17 7A 20 79 44 40 71 44 40 70 44 40 08 00 00 33 30 00 00 00";
    let body = bytes_of_hex(body);
    let crc = crc::Crc::<u32>::new(&crc::CRC_32_MPEG_2);
    let sum = crc.checksum(&[&body[..], &[0, 0]].concat());
    let read = StimConfiguration::read(&[&body[..], &sum.to_be_bytes()].concat()).unwrap();
    let format = StimFormat {
        gyro: StimKind::Increment,
        accel: StimKind::Increment,
        range: StimRange::G5,
        interval: Some(0.001),
    };
    assert_eq!(read.format, format);
    assert_eq!(read.groups, [true, false, true, false, true]);
    assert_eq!((read.revision, read.firmware, read.line_ends), (b'H', 23, false));
}

fn group_of(limit: i32) -> impl Strategy<Value = StimGroup> {
    (prop::array::uniform3(-limit..limit), any::<u8>())
        .prop_map(|(counts, status)| StimGroup { counts, status })
}

prop_compose! {
    fn datagrams()(
        rate in group_of(1 << 23),
        acceleration in prop::option::of(group_of(1 << 23)),
        inclination in prop::option::of(group_of(1 << 23)),
        temperatures in prop::option::of(prop::array::uniform3(group_of(1 << 15))),
        input in prop::option::of((any::<bool>(), -(1 << 23)..1 << 23, any::<u8>())),
        counter: u8, latency: u16,
    ) -> StimDatagram {
        let there = [true, acceleration.is_some(), inclination.is_some()];
        let temperatures = temperatures.map(|groups| {
            let mut groups = groups;
            for (group, there) in groups.iter_mut().zip(there) {
                *group = if there { *group } else { StimGroup::default() };
            }
            groups
        });
        let input = input.map(|(pps, counts, status)| StimInput { pps, counts, status });
        StimDatagram { rate, acceleration, inclination, temperatures, input, counter, latency }
    }
}

proptest! {
    #[test]
    fn what_is_written_is_read(datagram in datagrams()) {
        let frame = datagram.write();
        prop_assert_eq!(look(&frame), Look::Frame(frame.len()));
        prop_assert_eq!(StimDatagram::read(&frame), Ok(datagram));
    }

    #[test]
    fn a_motion_survives_within_half_a_count(
        gyro in prop::array::uniform3(-8.9..8.9), accel in prop::array::uniform3(-98.0..98.0),
    ) {
        let (rate, acceleration) = FORMAT.counts(&ImuMotion::Rates { gyro, accel }).unwrap();
        let datagram = StimDatagram {
            rate: StimGroup { counts: rate, status: 0 },
            acceleration: Some(StimGroup { counts: acceleration, status: 0 }),
            ..StimDatagram::default()
        };
        let ImuMotion::Rates { gyro: g, accel: a } = datagram.reading(&FORMAT).unwrap().motion else {
            unreachable!()
        };
        let half = [0.5 * DEG / 16_384.0, 0.5 * 9.806_65 / 524_288.0];
        for axis in 0..3 {
            prop_assert!((g[axis] - gyro[axis]).abs() <= half[0] * (1.0 + 1e-9));
            prop_assert!((a[axis] - accel[axis]).abs() <= half[1] * (1.0 + 1e-9));
        }
    }

    #[test]
    fn frames_are_the_same_in_any_splitting(datagram in datagrams(), sizes in frames::sizes()) {
        let frame = datagram.write();
        let bytes = [&b"\x90\xAFxx"[..], &frame, b"\r\n", &frame, &frame].concat();
        is_split_anyhow(Protocol::Stim, &bytes, &sizes);
    }

    #[test]
    fn no_bytes_make_it_panic(
        datagram in datagrams(), flips in frames::flips(), noise in frames::noise(),
    ) {
        is_robust(Protocol::Stim, &datagram.write(), &flips, &noise, |bytes| {
            let _ = StimConfiguration::read(bytes);
            if let Ok(datagram) = StimDatagram::read(bytes) {
                let _ = datagram.reading(&FORMAT);
            }
        });
    }
}
