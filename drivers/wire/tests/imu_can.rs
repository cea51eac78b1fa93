//! IMUs that send plain CAN frames: tables, samples from frames, what lost frames do.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use insd_base::can::{CanFrame, CanId};
use insd_base::{Time, UtcTime};
use insd_wire::imu::can::{
    ByteOrder, CanImu, CanLayout, CanPart, Field, FrameLayout, LayoutChoice, Shipped, What,
};
use insd_wire::imu::{DeviceTime, ImuMotion, ImuReading, Wrapping};
use proptest::prelude::*;

const INTERVAL: f64 = 0.01;
const ALL: [Shipped; 3] = [Shipped::Xsens, Shipped::XsensIncrements, Shipped::Sbg];

fn frame(id: u16, data: &[u8]) -> CanFrame {
    CanFrame::new(CanId::Standard(id), data).unwrap()
}

/// The samples of frames that come 0.2 ms apart, and how many were incomplete.
fn samples(layout: &CanLayout, frames: &[CanFrame]) -> (Vec<ImuReading>, u64) {
    let mut imu = CanImu::new(layout, INTERVAL);
    let mut all = Vec::new();
    for (index, frame) in frames.iter().enumerate() {
        let at = Time::from_seconds(index as f64 * 2e-4);
        if let Ok(CanPart::Sample { reading, .. }) = imu.take(frame, at) {
            all.push(reading);
        }
    }
    (all, imu.incomplete())
}

/// A sample of which nothing is coarser than the tables.
fn sample(count: u64) -> ImuReading {
    let step = count as f64;
    let motion = ImuMotion::Rates {
        gyro: [0.25, -0.5 + 0.125 * (step % 3.0), 0.0],
        accel: [0.5, -0.25, -9.75],
    };
    ImuReading {
        device_time: Some(DeviceTime {
            ticks: Wrapping { value: 4_294_967_000 + count * 100, modulus: 1 << 32 },
            tick: 1e-4,
        }),
        counter: Some(Wrapping { value: (65_530 + count) % 65_536, modulus: 65_536 }),
        temperature: Some(31.5),
        ..ImuReading::bare(motion)
    }
}

fn written(shipped: Shipped, count: u64) -> Vec<CanFrame> {
    let mut reading = sample(count);
    if let Some(time) = &mut reading.device_time {
        time.ticks.value %= 1 << 32;
    }
    reading.status = if shipped == Shipped::Sbg { 0x03FF } else { 0 };
    shipped.layout().write(&reading, INTERVAL)
}

/// The numbers follow from the maker's database alone.
#[test]
fn frames_of_an_mti_are_read_as_its_database_says() {
    let frames = [
        frame(0x05, &[0x00, 0x01, 0x86, 0xA0]),
        frame(0x06, &[0x12, 0x34]),
        frame(0x11, &[0x00, 0x00, 0x00, 0x03]),
        frame(0x32, &[0x02, 0x00, 0xFF, 0x00, 0x00, 0x01]),
        frame(0x34, &[0x01, 0x00, 0xFF, 0x80, 0x09, 0xCF]),
        frame(0x51, &[0x1E, 0x80]),
    ];
    let (samples, incomplete) = samples(&Shipped::Xsens.layout(), &[frames, frames].concat());
    assert_eq!((samples.len(), incomplete), (2, 0));
    let ticks = Wrapping { value: 100_000, modulus: 1 << 32 };
    let expected = ImuReading {
        device_time: Some(DeviceTime { ticks, tick: 1e-4 }),
        counter: Some(Wrapping { value: 0x1234, modulus: 65_536 }),
        status: 3,
        ..ImuReading::bare(ImuMotion::Rates {
            gyro: [1.0, -0.5, 1.0 / 512.0],
            accel: [1.0, -0.5, 9.808_593_75],
        })
    };
    assert_eq!(samples[0], expected, "its temperature is told after it");
    assert_eq!(samples[1], ImuReading { temperature: Some(30.5), ..expected });
}

#[test]
fn increments_of_an_mti_are_a_quaternion_and_a_velocity_with_its_exponent() {
    let half = (0.005_f64.sin() * 32_767.0).round() as i16;
    let [high, low] = half.to_be_bytes();
    let frames = [
        frame(0x05, &[0, 0, 0, 1]),
        frame(0x31, &[0x20, 0, 0xE0, 0, 0, 1, 13]),
        frame(0x33, &[0x7F, 0xFE, 0, 0, high, low, 0, 0]),
    ];
    let (samples, _) = samples(&Shipped::XsensIncrements.layout(), &frames);
    let ImuMotion::Increments { delta_theta, delta_velocity } = samples[0].motion else { panic!() };
    assert_eq!(delta_velocity, [1.0, -1.0, 1.0 / 8192.0]);
    assert!((delta_theta[1] - 0.01).abs() < 4e-5, "{delta_theta:?}");
}

#[test]
fn frames_of_an_sbg_unit_are_read_as_its_database_says() {
    let frames = [
        frame(0x120, &[0x40, 0x42, 0x0F, 0x00, 0xFF, 0x03, 0xEA, 0x0B]),
        frame(0x121, &[0x32, 0x00, 0xCE, 0xFF, 0x2B, 0xFC]),
        frame(0x122, &[0x01, 0x00, 0xFF, 0xFF, 0xE8, 0x03]),
    ];
    let (samples, _) = samples(&Shipped::Sbg.layout(), &frames);
    let own = samples[0];
    let ImuMotion::Rates { gyro, accel } = own.motion else { panic!() };
    for (found, expected) in gyro.iter().chain(&accel).zip([0.001, -0.001, 1.0, 0.5, -0.5, -9.81]) {
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    }
    let ticks = Wrapping { value: 1_000_000, modulus: 1 << 32 };
    assert_eq!(own.device_time, Some(DeviceTime { ticks, tick: 1e-6 }));
    assert_eq!((own.temperature, own.valid, own.status), (Some(30.5), true, 0x03FF));
}

#[test]
fn a_status_that_is_not_as_it_should_be_makes_samples_invalid_until_it_is_told_again() {
    let layout = Shipped::Xsens.layout();
    let bad = frame(0x11, &[0, 0, 0x20, 0]);
    let mut frames = written(Shipped::Xsens, 0);
    frames[2] = bad;
    let without = |count| {
        let frames = written(Shipped::Xsens, count);
        frames.into_iter().filter(|frame| frame.id() != CanId::Standard(0x11))
    };
    frames.extend(without(1));
    frames.extend(written(Shipped::Xsens, 2));
    let valid: Vec<bool> = samples(&layout, &frames).0.iter().map(|own| own.valid).collect();
    assert_eq!(valid, [false, false, true]);
}

#[test]
fn what_is_written_is_read_again() {
    for shipped in ALL {
        let frames: Vec<CanFrame> = (0..9).flat_map(|count| written(shipped, count)).collect();
        let (samples, incomplete) = samples(&shipped.layout(), &frames);
        assert_eq!((samples.len(), incomplete), (9, 0), "{shipped:?}");
        for (count, own) in (0..).zip(&samples) {
            assert!(own.valid && own.is_near(&sample(count)), "{shipped:?} {own:?}");
        }
    }
}

trait Near {
    fn is_near(&self, other: &Self) -> bool;
}

impl Near for ImuReading {
    fn is_near(&self, other: &Self) -> bool {
        let rates = |motion: &ImuMotion| match *motion {
            ImuMotion::Rates { gyro, accel } => (gyro, accel),
            ImuMotion::Increments { delta_theta, delta_velocity } => {
                (delta_theta.map(|own| own / INTERVAL), delta_velocity.map(|own| own / INTERVAL))
            }
        };
        let ((gyro, accel), (gyro_b, accel_b)) = (rates(&self.motion), rates(&other.motion));
        let near = |a: [f64; 3], b: [f64; 3], step: f64| {
            a.iter().zip(b).all(|(a, b)| (a - b).abs() <= step)
        };
        near(gyro, gyro_b, 3.2e-3) && near(accel, accel_b, 5e-3)
    }
}

/// Whatever single frame is lost: the sample it belongs to is not made, and no sample is made of two.
#[test]
fn a_lost_frame_costs_its_sample_and_no_other() {
    for shipped in ALL {
        let layout = shipped.layout();
        let per_sample = written(shipped, 0).len();
        for lost in 0..per_sample {
            let mut frames: Vec<CanFrame> =
                (0..6).flat_map(|count| written(shipped, count)).collect();
            let id = frames.remove(2 * per_sample + lost).id();
            let needed = layout.frames.iter().any(|own| own.can_id() == Some(id) && !own.optional);
            let (samples, incomplete) = samples(&layout, &frames);
            let missing = u64::from(needed);
            assert_eq!((samples.len() as u64, incomplete), (6 - missing, missing), "{shipped:?}");
            let kept = (0..6).filter(|count| !needed || *count != 2);
            for (count, own) in kept.zip(&samples) {
                let ImuMotion::Rates { gyro, .. } = own.motion else { continue };
                let ImuMotion::Rates { gyro: sent, .. } = sample(count).motion else { continue };
                assert!((gyro[1] - sent[1]).abs() < 1e-3, "{shipped:?} {lost} {count}");
            }
        }
    }
}

#[test]
fn a_frame_that_is_sent_twice_changes_nothing() {
    for shipped in ALL {
        let frames: Vec<CanFrame> = (0..4).flat_map(|count| written(shipped, count)).collect();
        let twice: Vec<CanFrame> = frames.iter().flat_map(|own| [*own, *own]).collect();
        let doubled: Vec<CanFrame> = twice[1..].to_vec();
        let once = samples(&shipped.layout(), &frames).0;
        assert_eq!(samples(&shipped.layout(), &doubled).0.len(), once.len(), "{shipped:?}");
    }
}

#[test]
fn a_frame_that_comes_much_too_late_is_of_another_sample() {
    let layout = Shipped::Sbg.layout();
    let frames = written(Shipped::Sbg, 0);
    let mut imu = CanImu::new(&layout, INTERVAL);
    let parts: Vec<CanPart> = [0.0, 0.001, 0.2]
        .iter()
        .zip(&frames)
        .map(|(at, frame)| imu.take(frame, Time::from_seconds(*at)).unwrap())
        .collect();
    assert_eq!((parts, imu.incomplete()), (vec![CanPart::Part; 3], 1));
}

/// Three frames of four bits of counter each, as sensors of cars send them.
fn with_counters() -> CanLayout {
    let part = |what, start, scale| Field {
        signed: true,
        order: ByteOrder::Big,
        scale,
        missing: Some(0x8000),
        ..Field::new(what, start, 16)
    };
    let frame = |id, first, second| FrameLayout {
        id,
        extended: true,
        optional: false,
        fields: vec![
            part(first, 0, 1e-3),
            part(second, 16, 2e-3),
            Field::new(What::Counter, 56, 4),
        ],
    };
    CanLayout {
        frames: vec![
            frame(0x1800_0174, What::RateZ, What::AccelY),
            frame(0x1800_0178, What::RateX, What::AccelX),
            frame(0x1800_017C, What::RateY, What::AccelZ),
        ],
    }
}

#[test]
fn frames_with_different_counters_make_no_sample() {
    let layout = with_counters();
    assert_eq!(layout.faults(), Vec::<String>::new());
    let count = |value| Some(Wrapping { value, modulus: 16 });
    let write = |value| {
        let reading = ImuReading { device_time: None, counter: count(value), ..sample(value) };
        layout.write(&reading, INTERVAL)
    };
    let (first, second) = (write(15), write(0));
    // the last two frames of the first and the first of the second are lost
    let mixed = [&first[..1], &second[1..], &write(1)[..]].concat();
    let (samples, incomplete) = samples(&layout, &mixed);
    assert_eq!((samples.len(), incomplete), (1, 2));
    assert_eq!(samples[0].counter, count(1));
    assert!(samples[0].is_near(&sample(1)));
}

#[test]
fn a_number_that_stands_for_not_available_makes_the_sample_invalid() {
    let layout = with_counters();
    let mut frames = layout.write(&sample(0), INTERVAL);
    let mut data: Vec<u8> = frames[1].data().to_vec();
    data[..2].copy_from_slice(&[0x80, 0x00]);
    frames[1] = CanFrame::new(frames[1].id(), &data).unwrap();
    let (samples, _) = samples(&layout, &frames);
    assert!(!samples[0].valid && !samples[0].motion.is_finite());
}

#[test]
fn utc_is_read_where_the_table_has_all_its_parts() {
    let mut layout = Shipped::Xsens.layout();
    let what =
        [What::Year, What::Month, What::Day, What::Hour, What::Minute, What::Second].into_iter();
    let mut fields: Vec<Field> =
        what.zip(0_u8..).map(|(what, byte)| Field::new(what, 8 * byte, 8)).collect();
    fields[0].offset = 2000.0;
    let fraction =
        Field { order: ByteOrder::Big, scale: 1e-4, ..Field::new(What::Fraction, 48, 16) };
    fields.push(fraction);
    let utc = FrameLayout { id: 7, extended: false, optional: true, fields };
    layout.frames.insert(2, utc);
    assert_eq!(layout.faults(), Vec::<String>::new());
    let told = UtcTime::from_civil((2026, 3, 31), (23, 59, 58), 123_400_000);
    let reading = ImuReading { utc: told, ..sample(0) };
    let frames = [layout.write(&reading, INTERVAL), layout.write(&sample(1), INTERVAL)].concat();
    let utc: Vec<_> = samples(&layout, &frames).0.iter().map(|own| own.utc).collect();
    assert_eq!(utc, [told, None]);
}

#[test]
fn a_table_of_ones_own_is_read_and_a_fault_in_it_is_told() {
    let own = r#"{"frames": [
        {"id": 1, "fields": [
            {"what": "rate_x", "start": 0, "width": 16, "signed": true, "scale": 1e-3},
            {"what": "rate_y", "start": 16, "width": 16, "signed": true, "scale": 1e-3},
            {"what": "rate_z", "start": 32, "width": 16, "signed": true, "scale": 1e-3}]},
        {"id": 2, "fields": [
            {"what": "accel_x", "start": 0, "width": 16, "order": "big", "scale": 1e-3},
            {"what": "accel_y", "start": 16, "width": 16, "order": "big", "scale": 1e-3},
            {"what": "accel_z", "start": 32, "width": 16, "order": "big", "scale": 1e-3}]}]}"#;
    let LayoutChoice::Own(layout) = serde_json::from_str(own).unwrap() else { panic!() };
    assert_eq!(layout.faults(), Vec::<String>::new());
    assert_eq!(layout.frames[1].fields[2].order, ByteOrder::Big);
    let named: LayoutChoice = serde_json::from_str("\"xsens_increments\"").unwrap();
    assert_eq!(named, LayoutChoice::Shipped(Shipped::XsensIncrements));
    for (from, to, part) in [
        ("\"width\": 16", "\"witdh\": 16", "unknown field `witdh`"),
        ("rate_z", "rate_w", "unknown variant `rate_w`"),
    ] {
        let fault = serde_json::from_str::<LayoutChoice>(&own.replacen(from, to, 1)).unwrap_err();
        assert!(fault.to_string().contains(part), "{fault}");
    }
    assert!(serde_json::from_str::<LayoutChoice>("\"xsense\"").is_err());
}

#[test]
fn a_table_that_cannot_make_samples_has_faults() {
    for shipped in ALL {
        assert_eq!(shipped.layout().faults(), Vec::<String>::new());
        let change = |change: &dyn Fn(&mut CanLayout)| {
            let mut layout = shipped.layout();
            change(&mut layout);
            layout.faults().len()
        };
        assert!(change(&|own| own.frames.clear()) > 0);
        assert!(change(&|own| own.frames[0].id = 0x800) > 0);
        assert!(change(&|own| own.frames[0].optional = true) > 0);
        assert!(change(&|own| own.frames[0].fields[0].width = 0) > 0);
        assert!(change(&|own| own.frames[0].fields[0].start = 60) > 0);
        assert!(change(&|own| own.frames[0].fields[0].scale = f64::NAN) > 0);
        assert!(change(&|own| own.frames[1].id = own.frames[0].id) > 0);
    }
}

proptest! {
    #[test]
    fn no_frames_make_it_panic(
        seeds in prop::collection::vec((0_usize..8, prop::collection::vec(any::<u8>(), 0..9)), 0..80),
        which in 0_usize..4,
    ) {
        let layout = ALL.get(which).map_or_else(with_counters, |shipped| shipped.layout());
        let mut imu = CanImu::new(&layout, INTERVAL);
        for (index, (frame, data)) in seeds.iter().enumerate() {
            let id = layout.frames.get(*frame).and_then(FrameLayout::can_id);
            let frame = CanFrame::new(id.unwrap_or(CanId::Standard(0x7FF)), data).unwrap();
            let at = Time::from_seconds(index as f64 * 3e-3);
            if let Ok(CanPart::Sample { reading, begun }) = imu.take(&frame, at) {
                prop_assert!(begun <= at);
                prop_assert!(!reading.valid || reading.motion.is_finite());
            }
        }
    }

    #[test]
    fn rates_and_forces_come_back_within_half_a_step(
        gyro in prop::array::uniform3(-30.0..30.0_f64),
        accel in prop::array::uniform3(-120.0..120.0_f64),
    ) {
        for (shipped, rate, force) in
            [(Shipped::Xsens, 1.0 / 512.0, 1.0 / 256.0), (Shipped::Sbg, 1e-3, 1e-2)]
        {
            let reading = ImuReading { motion: ImuMotion::Rates { gyro, accel }, ..sample(0) };
            let layout = shipped.layout();
            let (samples, _) = samples(&layout, &layout.write(&reading, INTERVAL));
            let ImuMotion::Rates { gyro: g, accel: a } = samples[0].motion else { panic!() };
            for axis in 0..3 {
                prop_assert!((g[axis] - gyro[axis]).abs() <= 0.5001 * rate);
                prop_assert!((a[axis] - accel[axis]).abs() <= 0.5001 * force);
            }
        }
    }
}
