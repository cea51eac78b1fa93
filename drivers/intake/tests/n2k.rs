//! Devices of NMEA 2000 and IMUs on a CAN bus, from frames to measurements.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod bus;

use bus::{AT, Bus, UTC, fix, sensor};
use insd_base::can::{BusEvent, CanFrame, CanId};
use insd_base::units::DEG;
use insd_base::{Geodetic, LogReference, Message, PortId};
use insd_intake::config::Kind;
use insd_intake::device::DeviceFilter;
use insd_intake::event::{Happening, Refusal};
use insd_intake::port::Link;
use insd_n2k::Name;
use insd_n2k::pgn::{
    Attitude, CourseSpeed, Direction, DistanceLog, Dops, FixMethod, GnssPosition, Heading, North,
    PositionRapid, PseudorangeNoise, RateOfTurn, Speed, SpeedComponents, SystemTime, TimeSource,
};
use insd_wire::imu::can::{LayoutChoice, Shipped};
use insd_wire::imu::{ImuMotion, ImuReading};
use proptest::prelude::*;

fn course(sid: Option<u8>, speed: f64) -> CourseSpeed {
    CourseSpeed { sid, reference: Some(North::True), course: Some(0.0), speed: Some(speed) }
}

/// Epochs of a receiver whose messages come in an order, SIDs as given by the second; the north velocities.
fn velocities(order: &[u8], sid: impl Fn(u8, u8) -> Option<u8>) -> Vec<Option<f64>> {
    let mut bus = Bus::new(vec![sensor(Kind::N2kGnss)]);
    for second in 0..20_u8 {
        bus.wait(1.0 - 0.01 * order.len() as f64);
        for (place, group) in (0_u8..).zip(order) {
            bus.wait(0.01);
            // a velocity that tells by itself which second it is of
            let sid = sid(second, place);
            match group {
                0 => bus.send(1, &GnssPosition { sid, ..fix(second.into()) }),
                1 => bus.send(1, &course(sid, f64::from(second))),
                _ => bus.send(1, &Dops { sid, hdop: Some(1.5), ..Bus::no_dops() }),
            }
        }
    }
    let gnss = bus.gnss();
    // the first may wait for the second, and the tie of clocks for the first ten seconds
    assert!(gnss.len() > 17, "{}", gnss.len());
    gnss.iter().map(|fix| fix.velocity.map(|own| own.0.x)).collect()
}

/// Whether each velocity from a second on is of its own second.
fn follows(velocities: &[Option<f64>], from: usize) -> bool {
    velocities
        .iter()
        .zip(0_i32..)
        .skip(from)
        .all(|(own, second)| own.is_some_and(|own| (own - f64::from(second)).abs() < 1e-6))
}

#[test]
fn a_velocity_belongs_to_the_fix_with_its_sid_before_or_after_it() {
    for order in [[0, 1, 2], [1, 0, 2], [2, 1, 0]] {
        let own = velocities(&order, |second, _| Some(second));
        // before its first fix nobody listens to a device
        assert!(follows(&own, 1), "{order:?} {own:?}");
    }
}

#[test]
fn without_sids_that_link_a_velocity_belongs_to_the_fix_it_came_with() {
    assert!(follows(&velocities(&[0, 1, 2], |_, _| None), 2));
    assert!(follows(&velocities(&[0, 1, 2], |_, _| Some(0)), 2));
    // each group counts for itself, which is found out after a few fixes
    let apart = velocities(&[0, 1, 2], |second, place| Some(second + 100 * place));
    assert!(apart[1].is_none() && follows(&apart, 6), "{apart:?}");
}

#[test]
fn a_fix_is_timed_by_its_own_utc_and_has_the_sigmas_of_its_sid() {
    let mut bus = Bus::new(vec![sensor(Kind::N2kGnss)]);
    for second in 0..20_u8 {
        bus.wait(1.0);
        let sid = Some(second);
        bus.send(1, &GnssPosition { sid, ..fix(second.into()) });
        bus.send(
            1,
            &PseudorangeNoise {
                sid,
                range_rms: None,
                major: None,
                minor: None,
                orientation: None,
                latitude_std: Some(0.5),
                longitude_std: Some(0.25),
                altitude_std: Some(1.0),
            },
        );
    }
    let gnss = bus.gnss();
    for pair in gnss.windows(2) {
        assert!(((pair[1].time - pair[0].time).as_seconds() - 1.0).abs() < 1e-4);
    }
    let std = gnss[5].position_std.unwrap().0;
    assert_eq!((std.x, std.y, std.z), (0.5, 0.25, 1.0));
    assert_eq!((gnss[5].hdop, gnss[5].satellites), (Some(0.8), Some(11)));
    let at = gnss[5].position.unwrap();
    assert!((at.latitude - AT.latitude).abs() < 1e-12 && (at.height - AT.height).abs() < 1e-6);
}

#[test]
fn a_fix_that_is_not_available_is_invalid_and_never_zero() {
    let none = GnssPosition { latitude: None, longitude: None, ..fix(0.0) };
    let unknown = GnssPosition { method: Some(FixMethod::NoFix), ..fix(0.0) };
    let guessed = GnssPosition { method: Some(FixMethod::DeadReckoning), ..fix(0.0) };
    for bad in [none, unknown, guessed] {
        let mut bus = Bus::new(vec![sensor(Kind::N2kGnss)]);
        for second in 0..20_u8 {
            bus.wait(1.0);
            let GnssPosition { time, .. } = fix(second.into());
            bus.send(1, &GnssPosition { sid: Some(second), time, ..bad.clone() });
        }
        let status = bus.intake.status();
        assert!(bus.gnss().is_empty(), "{bad:?}");
        assert_eq!(status.sensors[0].valid, Some(false), "{bad:?}");
    }
}

#[test]
fn an_altitude_above_the_geoid_is_put_on_the_ellipsoid_where_the_installer_says_so() {
    let mut own = sensor(Kind::N2kGnss);
    own.altitude_above_geoid = true;
    let mut bus = Bus::new(vec![own]);
    for second in 0..20_u8 {
        bus.wait(1.0);
        bus.send(1, &GnssPosition { sid: Some(second), ..fix(second.into()) });
    }
    let Geodetic { height, .. } = bus.gnss()[3].position.unwrap();
    assert!((height - AT.height - 36.0).abs() < 1e-6, "{height}");
}

#[test]
fn system_time_tells_utc_where_fixes_do_not_and_a_satellite_system_is_its_source() {
    for (source, told) in [(TimeSource::Gps, true), (TimeSource::LocalCrystal, false)] {
        let mut bus = Bus::new(vec![sensor(Kind::N2kGnss)]);
        for second in 0..20_u8 {
            bus.wait(1.0);
            let sid = Some(second);
            let GnssPosition { date, time, .. } = fix(second.into());
            bus.send(1, &GnssPosition { sid, date: None, time: None, ..fix(0.0) });
            bus.send(1, &SystemTime { sid, source: Some(source), date, time });
            bus.wait(0.01);
        }
        assert_eq!(bus.intake.utc_at(bus.now()).is_some(), told, "{source:?}");
        let refused = &bus.intake.status().sensors[0].refused;
        assert!(refused.get(&Refusal::NoTime).is_some_and(|count| *count >= 19));
        assert_eq!(bus.gnss().len(), 0);
    }
    // the same before the fix lends it its time
    let mut bus = Bus::new(vec![sensor(Kind::N2kGnss)]);
    for second in 0..20_u8 {
        bus.wait(1.0);
        let sid = Some(second);
        let GnssPosition { date, time, .. } = fix(second.into());
        bus.send(1, &SystemTime { sid, source: Some(TimeSource::Gps), date, time });
        bus.send(1, &GnssPosition { sid, date: None, time: None, ..fix(0.0) });
    }
    assert!(bus.gnss().len() > 17);
    assert!((bus.intake.utc_at(bus.now()).unwrap().since(UTC).as_seconds() - 19.0).abs() < 0.01);
}

fn heading(heading: Option<f64>, reference: Option<North>, variation: Option<f64>) -> Heading {
    Heading { sid: None, heading, deviation: None, variation, reference }
}

/// Headings that pass, and how many were refused as magnetic, and whether the last was valid.
fn headings(magnetic: bool, told: &Heading) -> (Vec<f64>, u64, Option<bool>) {
    let mut own = sensor(Kind::N2kHeading);
    own.magnetic = magnetic;
    let mut bus = Bus::new(vec![own]);
    for _ in 0..10 {
        bus.wait(0.1);
        bus.send(1, told);
    }
    let status = bus.intake.status().sensors[0].clone();
    let refused = status.refused.get(&Refusal::Magnetic).copied().unwrap_or(0);
    (bus.headings(), refused, status.valid)
}

#[test]
fn a_heading_is_true_or_corrected_or_refused() {
    let (told, refused, valid) = headings(false, &heading(Some(1.0), Some(North::True), None));
    assert_eq!((told.len(), refused, valid), (10, 0, Some(true)));
    assert!(told.iter().all(|own| (own - 1.0).abs() < 1e-9));
    let magnetic = heading(Some(1.0), Some(North::Magnetic), Some(0.1));
    assert_eq!(headings(false, &magnetic).1, 10);
    let (told, refused, _) = headings(true, &magnetic);
    assert!(told.len() == 10 && told.iter().all(|own| (own - 1.1).abs() < 1e-9));
    assert_eq!(refused, 0);
    // no place is known for the model
    assert_eq!(headings(true, &heading(Some(1.0), Some(North::Magnetic), None)).1, 10);
    for none in [heading(None, Some(North::True), None), heading(Some(1.0), None, None)] {
        let (told, _, valid) = headings(true, &none);
        assert_eq!((told.len(), valid), (0, Some(false)), "{none:?}");
    }
}

#[test]
fn the_yaw_of_an_attitude_is_a_heading_only_where_asked_for_and_no_better_one_comes() {
    let attitude = Attitude { sid: None, yaw: Some(0.5), pitch: Some(0.02), roll: None };
    for (yaw, better, expected) in [(false, false, 0), (true, false, 20), (true, true, 0)] {
        let mut own = sensor(Kind::N2kHeading);
        own.yaw = yaw;
        let mut bus = Bus::new(vec![own]);
        for _ in 0..20 {
            if better {
                bus.send(1, &heading(Some(1.0), Some(North::True), None));
            }
            bus.wait(0.1);
            bus.send(1, &attitude);
            bus.send(1, &RateOfTurn { sid: None, rate: Some(0.01) });
        }
        let yaws = bus.headings().iter().filter(|own| (*own - 0.5).abs() < 1e-3).count();
        assert_eq!(yaws, expected, "{yaw} {better}");
        let shown = bus.intake.status().sensors[0].shown;
        assert_eq!(shown.roll, None);
        assert_eq!(shown.pitch.is_some() && shown.rate_of_turn.is_some(), yaw || better);
    }
}

fn speed(water: f64, direction: Option<Direction>) -> Speed {
    Speed { sid: None, water: Some(water), ground: None, kind: None, direction }
}

#[test]
fn a_log_tells_components_or_else_a_speed_with_the_sign_of_its_direction() {
    let all = SpeedComponents {
        forward_water: Some(-1.5),
        starboard_water: Some(0.25),
        forward_ground: Some(-1.25),
        ..SpeedComponents::default()
    };
    let mut bus = Bus::new(vec![sensor(Kind::N2kLog)]);
    for _ in 0..10 {
        bus.wait(0.5);
        bus.send(1, &all);
        bus.send(1, &speed(9.0, None));
        bus.send(1, &DistanceLog { date: None, time: None, log: Some(5e6), trip: None });
    }
    let log = bus.log();
    assert_eq!(log.len(), 20);
    for own in &log {
        let expected = match own.reference {
            LogReference::Water => (Some(-1.5), Some(0.25), None),
            LogReference::Bottom => (Some(-1.25), None, None),
        };
        assert_eq!((own.u, own.v, own.w), expected);
    }
    assert_eq!(bus.intake.status().sensors[0].shown.distance, Some(5e6));
    for (direction, sign) in
        [(None, 1.0), (Some(Direction::Forward), 1.0), (Some(Direction::Reverse), -1.0)]
    {
        let mut bus = Bus::new(vec![sensor(Kind::N2kLog)]);
        for _ in 0..10 {
            bus.wait(1.0);
            bus.send(1, &speed(2.0, direction));
        }
        let told: Vec<_> = bus.log().iter().map(|own| (own.u, own.v, own.reference)).collect();
        assert_eq!(told, vec![(Some(2.0 * sign), None, LogReference::Water); 10]);
    }
    let mut bus = Bus::new(vec![sensor(Kind::N2kLog)]);
    bus.wait(1.0);
    bus.send(1, &SpeedComponents::default());
    bus.send(1, &Speed { water: None, ..speed(0.0, None) });
    assert_eq!((bus.log().len(), bus.intake.status().sensors[0].valid), (0, Some(false)));
}

#[test]
fn a_position_is_timed_by_its_receipt_and_the_first_bit_of_its_frame() {
    let mut own = sensor(Kind::N2kPosition);
    own.latency_s = 0.05;
    let mut bus = Bus::new(vec![own]);
    let place = PositionRapid { latitude: Some(0.5), longitude: Some(-1.0) };
    let bits = bus.frames(1, &place)[0].wire_bits();
    for _ in 0..10 {
        bus.wait(0.1);
        bus.send(1, &place);
    }
    let told = bus.references();
    assert_eq!(told.len(), 10);
    let late = (bus.now() - told[9].time).as_seconds();
    assert!((late - 0.05 - f64::from(bits) * 4e-6).abs() < 1e-9, "{late}");
    bus.wait(0.1);
    bus.send(1, &PositionRapid { latitude: None, longitude: Some(-1.0) });
    assert_eq!(bus.intake.status().sensors[0].valid, Some(false));
}

#[test]
fn what_stays_of_the_error_of_a_position_is_told_with_it() {
    let mut own = sensor(Kind::N2kPosition);
    own.position_lasting_std_m = Some(100.0);
    let mut bus = Bus::new(vec![own]);
    bus.wait(0.1);
    bus.send(1, &PositionRapid { latitude: Some(0.5), longitude: Some(-1.0) });
    assert_eq!(bus.references()[0].position_lasting_std, Some(100.0));
}

#[test]
fn two_devices_with_the_same_group_do_not_mix_and_a_move_is_no_interruption() {
    let mut bus = Bus::new(vec![sensor(Kind::N2kHeading)]);
    let told = |own: f64| heading(Some(own), Some(North::True), None);
    bus.claim(10, 1);
    bus.claim(20, 2);
    for step in 0..40 {
        bus.wait(0.1);
        // the other one takes the first one's address in the middle
        let (first, second) = if step < 20 { (10, 20) } else { (44, 10) };
        if step == 20 {
            bus.claim(44, 1);
            bus.claim(10, 2);
        }
        bus.send(first, &told(1.0));
        bus.send(second, &told(2.0));
    }
    assert_eq!(bus.headings().len(), 40);
    assert!(bus.headings().iter().all(|own| (own - 1.0).abs() < 1e-9));
    let status = &bus.intake.status();
    assert_eq!(status.sensors[0].refused.get(&Refusal::OtherDevice), Some(&40));
    assert_eq!(status.sensors[0].device.map(|own| own.address), Some(44));
    assert_eq!(status.ports[0].nodes, [(10, Name::new(2)), (44, Name::new(1))]);
    let chosen = bus.events.iter().filter(|own| matches!(own, Happening::Device { .. }));
    assert_eq!(chosen.count(), 1);
    // it falls silent, and the other one takes over
    for _ in 0..40 {
        bus.wait(0.1);
        bus.send(10, &told(2.0));
    }
    let other = bus.headings().iter().filter(|own| (*own - 2.0).abs() < 1e-9).count();
    assert!((9..=11).contains(&other), "{other}");
}

#[test]
fn two_sensors_are_told_apart_by_their_names() {
    let by_name = |name: u64, priority: u8| {
        let mut own = sensor(Kind::N2kHeading);
        own.name = format!("compass {name}");
        own.priority = priority;
        own.device = Some(DeviceFilter { name: Some(Name::new(name)), ..DeviceFilter::default() });
        own
    };
    let mut bus = Bus::new(vec![by_name(1, 1), by_name(2, 2)]);
    let told = |own: f64| heading(Some(own), Some(North::True), None);
    bus.send(20, &told(2.0));
    assert!(bus.headings().is_empty(), "nobody knows yet who it is");
    bus.claim(20, 2);
    bus.claim(10, 1);
    for step in 0..100 {
        bus.wait(0.1);
        if step < 50 {
            bus.send(10, &told(1.0));
        }
        bus.send(20, &told(2.0));
    }
    let status = bus.intake.status();
    assert_eq!(status.sensors.iter().map(|own| own.silent).collect::<Vec<_>>(), [true, false]);
    let headings = bus.headings();
    let (first, second) = headings.split_at(50);
    assert!(first.iter().all(|own| (own - 1.0).abs() < 1e-9));
    // its patience is three seconds
    assert!((19..=21).contains(&second.len()), "{}", second.len());
    assert!(second.iter().all(|own| (own - 2.0).abs() < 1e-9));
}

#[test]
fn a_lost_frame_of_a_fast_packet_costs_its_message_alone_and_is_counted() {
    let mut bus = Bus::new(vec![sensor(Kind::N2kGnss)]);
    for second in 0..20_u8 {
        bus.wait(1.0);
        let frames = bus.frames(1, &GnssPosition { sid: Some(second), ..fix(second.into()) });
        let lost = if second == 12 { 3 } else { usize::MAX };
        for (_, frame) in (0..).zip(&frames).filter(|(index, _)| *index != lost) {
            bus.give(frame);
        }
        bus.send(1, &course(Some(second), 5.0));
    }
    let first = bus.gnss()[0].time;
    let gnss = bus.gnss();
    let seconds = gnss.iter().map(|own| (own.time - first).as_seconds().round() as i32);
    assert!(seconds.eq((0..20).filter(|second| *second != 12)));
    let counts = bus.intake.status().ports[0].counts;
    assert_eq!((counts.damaged, counts.frames), (1, 20 * 8 - 1));
}

#[test]
fn what_a_controller_says_of_its_bus_is_told_and_counted() {
    let mut bus = Bus::new(vec![sensor(Kind::N2kGnss)]);
    for event in [
        BusEvent::Error { class: 8 },
        BusEvent::BusOff,
        BusEvent::Restarted,
        BusEvent::Dropped { frames: 17 },
    ] {
        bus.event(event);
    }
    let told = |event| Happening::Bus { port: PortId(0), event };
    let expected = [BusEvent::BusOff, BusEvent::Restarted, BusEvent::Dropped { frames: 17 }];
    assert_eq!(bus.events, expected.map(told));
    let counts = bus.intake.status().ports[0].bus;
    assert_eq!((counts.errors, counts.offs, counts.dropped), (1, 1, 17));
    assert_eq!(counts.state, Some(BusEvent::Restarted));
}

#[test]
fn samples_of_a_can_imu_pass_and_those_with_a_lost_frame_are_counted() {
    let mut own = sensor(Kind::CanImu);
    own.layout = Some(LayoutChoice::Shipped(Shipped::Sbg));
    let mut bus = Bus::new(vec![own]);
    let layout = Shipped::Sbg.layout();
    for count in 0..500_u64 {
        bus.wait(0.01);
        let motion = ImuMotion::Rates { gyro: [0.1, 0.0, 0.0], accel: [0.0, 0.0, -9.8] };
        let ticks = insd_wire::imu::Wrapping { value: count * 10_000, modulus: 1 << 32 };
        let device_time = Some(insd_wire::imu::DeviceTime { ticks, tick: 1e-6 });
        let reading = ImuReading { device_time, status: 0x3FF, ..ImuReading::bare(motion) };
        let frames = layout.write(&reading, 0.01);
        let lost = if count % 100 == 50 { 1 } else { 3 };
        frames.iter().zip(0..).filter(|(_, index)| *index != lost).for_each(|(own, _)| {
            bus.give(own);
        });
    }
    let imu: Vec<_> = bus.measured.iter().filter(|own| matches!(own, Message::Imu(_))).collect();
    let status = &bus.intake.status().sensors[0];
    assert_eq!((imu.len(), status.refused.get(&Refusal::Incomplete)), (495, Some(&5)));
}

#[test]
fn a_description_that_cannot_be_is_refused() {
    let faults = |change: &dyn Fn(&mut insd_intake::config::IntakeConfig)| {
        let mut imu = sensor(Kind::CanImu);
        imu.layout = Some(LayoutChoice::Shipped(Shipped::Xsens));
        let mut config = Bus::config(vec![imu]);
        change(&mut config);
        config.faults().iter().map(|fault| fault.key).collect::<Vec<_>>()
    };
    assert_eq!(faults(&|_| {}), Vec::<&str>::new());
    assert_eq!(faults(&|own| own.sensors[0].layout = None), ["layout"]);
    assert_eq!(faults(&|own| own.ports[0].link = Link::Stream), ["kind"]);
    let device = Some(DeviceFilter::default());
    assert_eq!(faults(&|own| own.sensors[0].device = device), ["device"]);
    let mut layout = Shipped::Sbg.layout();
    layout.frames[1].fields.pop();
    let own_table = Some(LayoutChoice::Own(layout));
    assert_eq!(faults(&|own| own.sensors[0].layout.clone_from(&own_table)), ["layout"]);
    assert_eq!(
        faults(&|own| own.sensors.push(sensor(Kind::Compass))),
        ["kind"],
        "sentences on a bus of frames"
    );
}

proptest! {
    #[test]
    fn no_frames_make_it_panic_and_none_make_what_is_no_number(
        seeds in prop::collection::vec(
            (0_usize..20, 0_u8..4, any::<bool>(), prop::collection::vec(any::<u8>(), 0..9)), 0..200),
    ) {
        const GROUPS: [u32; 14] = [
            60_928, 126_992, 127_250, 127_251, 127_257, 128_259, 128_275, 129_025, 129_026, 129_029,
            129_033, 129_539, 129_542, 130_578,
        ];
        let mut imu = sensor(Kind::CanImu);
        imu.layout = Some(LayoutChoice::Shipped(Shipped::Sbg));
        let kinds = [Kind::N2kGnss, Kind::N2kHeading, Kind::N2kLog, Kind::N2kPosition];
        let sensors = kinds.map(sensor).into_iter().chain([imu]);
        let mut bus = Bus::new(sensors.collect());
        for (which, source, sane, mut data) in seeds {
            let id = match GROUPS.get(which) {
                Some(pgn) => CanId::Extended(pgn << 8 | 2 << 26 | u32::from(source)),
                None => CanId::Standard(0x120 + (which as u16 - 14) % 4),
            };
            if sane {
                data.resize(8, 0);
                data[0] &= 0x1F;
            }
            bus.wait(0.01);
            bus.give(&CanFrame::new(id, &data).unwrap());
        }
        for message in &bus.measured {
            let finite = match message {
                Message::Imu(own) => own.delta_velocity.0.iter().all(|part| part.is_finite()),
                Message::Gnss(own) => own.position.is_none_or(|at| at.latitude.abs() <= 90.0 * DEG),
                Message::Log(own) => [own.u, own.v].iter().flatten().all(|part| part.is_finite()),
                Message::Reference(own) => own.heading.is_none_or(f64::is_finite),
                Message::Ranges(_) | Message::Base(_) | Message::Rtk(_) | Message::Compass(_) => false,
                Message::Ranging(_) | Message::Camera(_) | Message::Odometry(_) => false,
            };
            prop_assert!(finite, "{message:?}");
        }
    }
}
