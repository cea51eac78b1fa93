//! Sensors on a CAN bus: a ship that navigates by them, devices that move, fall silent or say nothing.

use std::sync::OnceLock;

use insd_base::can::{CanFrame, CanId};
use insd_base::{Arrival, ImuSpec, Input, PortId, Triad};
use insd_intake::choice::{Quantity, Why};
use insd_intake::event::{Happening, Refusal};
use insd_n2k::N2kId;
use insd_n2k::pgn::{GnssPosition, Group, Heading};
use insd_tests::feed::{Encoding, n2k};
use insd_wire::imu::can::Shipped;

use super::passage::{COMPASS, GNSS, IMU, Passage, Ship, apart, usual};

/// The port that receiver, log and compass share.
const BUS: u16 = GNSS;

/// IMU, receiver, log and compass on buses.
fn ship() -> &'static Ship {
    static SHIP: OnceLock<Ship> = OnceLock::new();
    SHIP.get_or_init(|| Ship::new(&with_imu(None), |_, _| {}))
}

fn with_imu(table: Option<Shipped>) -> [Encoding; 4] {
    [Encoding::CanImu(table), Encoding::N2kGnss, Encoding::N2kLog, Encoding::N2kHeading]
}

fn sound() -> &'static Passage {
    static PASSAGE: OnceLock<Passage> = OnceLock::new();
    PASSAGE.get_or_init(|| ship().sail())
}

/// The parts of the identifier of a frame of the shared bus.
fn n2k_id(arrival: &Arrival) -> Option<(N2kId, CanFrame)> {
    let Input::Can(frame) = &arrival.input else { return None };
    let id = N2kId::parse(frame.id()).filter(|_| arrival.port == PortId(BUS))?;
    Some((id, *frame))
}

/// The same frame under another address.
fn from(source: u8, id: N2kId, frame: &CanFrame) -> Input {
    let id = N2kId { source, ..id };
    Input::Can(CanFrame::new(id.compose(), frame.data()).unwrap())
}

/// The ship without some frames of the bus from an instant on, s.
fn without(ship: &Ship, since: f64, gone: impl Fn(N2kId) -> bool) -> Ship {
    ship.changed(|own| match n2k_id(own) {
        Some((id, _)) if ship.when(own) >= since && gone(id) => vec![],
        _ => vec![own.clone()],
    })
}

fn is_device(own: &&&Happening) -> bool {
    matches!(own, Happening::Device { .. })
}

#[test]
fn a_ship_navigates_by_a_bus_as_she_does_by_serial_lines() {
    let serial = [Encoding::Sbg, Encoding::NmeaGnss, Encoding::Vbw, Encoding::Ths];
    let serial = Ship::new(&serial, |_, _| {}).sail();
    assert_eq!(sound().counts, serial.counts);
    let worst = apart(sound(), &serial);
    println!("{worst:.3} sigma apart");
    // at the start, where a step of a velocity counts; UBX and NMEA 0183 are twice as far apart there
    assert!(worst < 1.5, "{worst} sigma apart");
}

/// With the error model that such steps need; see docs/sensors.md.
#[test]
fn a_ship_navigates_by_the_coarse_frames_of_makers() {
    for table in [Shipped::Sbg, Shipped::Xsens] {
        let ship = Ship::new(&with_imu(Some(table)), |voyage, _| {
            voyage.header.imu = coarse(&voyage.header.imu);
        });
        let passage = ship.sail();
        let truth: Vec<_> = ship.voyage.truth.iter().filter(|own| own.attitude.is_some()).collect();
        let last = passage.solutions.last().unwrap();
        let time = last.time - ship.reception.offset;
        let own = truth.iter().min_by_key(|own| (own.time - time).as_nanos().abs()).unwrap();
        let off = insd_base::units::wrap_pi(last.attitude.heading - own.attitude.unwrap().heading);
        println!("{table:?}: heading off by {:.3} deg", off.to_degrees());
        println!("  1-sigma {:.3} deg", last.sigma.heading.to_degrees());
        assert!(last.mode.is_navigating());
        assert!(off.abs() < 3.0 * last.sigma.heading && last.sigma.heading.to_degrees() < 1.0);
    }
}

/// A data sheet with what a step of 1 mg and 0.1 deg/s leaves.
fn coarse(spec: &ImuSpec) -> ImuSpec {
    ImuSpec {
        gyro: Triad::of_gyros([60.0, 20.0, 600.0, 0.3, 1000.0]),
        accel: Triad::of_accelerometers([1000.0, 300.0, 600.0, 0.1, 1000.0]),
        ..*spec
    }
}

#[test]
fn a_device_that_moves_to_another_address_is_not_missed() {
    let since = 80.0;
    let (old, new) = (n2k::address(1), 99);
    let mut moved = ship().changed(|own| match n2k_id(own) {
        Some((id, frame)) if ship().when(own) >= since && id.source == old => {
            vec![Arrival { input: from(new, id, &frame), ..own.clone() }]
        }
        _ => vec![own.clone()],
    });
    // another one takes the address that it left, and sends nonsense from it
    let mut nonsense: Vec<Arrival> = Vec::new();
    for own in &moved.arrivals {
        if let Some((id, frame)) = n2k_id(own)
            && moved.when(own) >= since
            && id.source == new
        {
            let mut data = frame.data().to_vec();
            data.iter_mut().skip(5).for_each(|byte| *byte ^= 0x15);
            let frame = CanFrame::new(frame.id(), &data).unwrap();
            nonsense.push(Arrival { input: from(old, id, &frame), ..own.clone() });
        }
    }
    let claim = |sensor: usize, address: u8, seconds: f64| Arrival {
        stamp: ship().at(seconds),
        port: PortId(BUS),
        input: Input::Can(n2k::claim(sensor, address).unwrap()),
    };
    nonsense.push(claim(1, new, since - 0.01));
    nonsense.push(claim(7, old, since - 0.005));
    moved = moved.with(nonsense);
    let passage = moved.sail();
    assert_eq!(passage.counts, sound().counts);
    assert!(passage.news().iter().filter(is_device).count() == 0);
    assert!(!passage.has(|own| matches!(own, Happening::SensorSilent { .. })));
    let status = passage.intake.status();
    assert_eq!(status.sensors[1].device.map(|own| own.address), Some(new));
    assert!(status.sensors[1].refused[&Refusal::OtherDevice] > 300);
    passage.does_not_step(sound());
}

#[test]
fn a_device_that_falls_silent_is_replaced_by_another_of_the_same_group() {
    // a second compass repeats what the first one says, from another address
    let second = 9;
    let mut doubled = ship().changed(|own| match n2k_id(own) {
        Some((id, frame)) if id.pgn == Heading::PGN => {
            let copy = from(n2k::address(second), id, &frame);
            vec![own.clone(), Arrival { input: copy, ..own.clone() }]
        }
        _ => vec![own.clone()],
    });
    doubled = doubled.with(vec![Arrival {
        stamp: ship().at(0.5),
        port: PortId(BUS),
        input: Input::Can(n2k::claim(second, n2k::address(second)).unwrap()),
    }]);
    let compass = usize::from(COMPASS);
    let first = n2k::address(compass);
    let silent = without(&doubled, 90.0, |id| id.source == first);
    let passage = silent.sail_with(|config| {
        let mut other = config.sensors[compass].clone();
        other.name = "second compass".to_owned();
        other.priority = 2;
        other.device.as_mut().unwrap().name = Some(n2k::name(second));
        config.sensors.push(other);
    });
    assert!(passage.has(|own| {
        matches!(own, Happening::Chosen(own)
            if own.quantity == Quantity::Heading && own.why == Why::Silent && own.to == Some(4))
    }));
    // two or three are missed while it is waited for
    let missed = sound().counts[3] - passage.counts[3];
    assert!((1..=4).contains(&missed), "{missed}");
    passage.does_not_step(sound());
}

#[test]
fn fixes_that_are_not_available_are_none_and_the_ship_goes_on_without() {
    let fix = GnssPosition::PGN;
    let span = 80.0..110.0;
    let blind = ship().changed(|own| match n2k_id(own) {
        Some((id, frame)) if id.pgn == fix && span.contains(&ship().when(own)) => {
            // all but the date and time, and the lengths, are ones
            let mut data = frame.data().to_vec();
            let keep = if data[0] & 0x1F == 0 { 8 } else { 1 };
            let keep = if data[0] & 0x1F == 1 { 2 } else { keep };
            data.iter_mut().skip(keep).for_each(|byte| *byte = 0xFF);
            let frame = CanFrame::new(frame.id(), &data).unwrap();
            vec![Arrival { input: Input::Can(frame), ..own.clone() }]
        }
        _ => vec![own.clone()],
    });
    let passage = blind.sail();
    assert!(
        passage
            .has(|own| { matches!(own, Happening::SensorValid { sensor: 1, valid: false, .. }) })
    );
    assert!(passage.counts[1] + 120 < sound().counts[1], "{:?}", passage.counts);
    passage.loses_nothing_beside(sound(), GNSS);
    passage.does_not_step(sound());
}

#[test]
fn lost_frames_cost_their_messages_and_samples_alone() {
    let mut number = 0_u64;
    let mut lost = ship().changed(|own| {
        number += 1;
        let gone = number.is_multiple_of(97) && ship().when(own) > 20.0;
        if gone { vec![] } else { vec![own.clone()] }
    });
    lost.arrivals.sort_by_key(|own| own.stamp.monotonic);
    let passage = lost.sail();
    let status = passage.intake.status();
    assert!(status.ports[usize::from(BUS)].counts.damaged > 50, "{:?}", status.ports[1].counts);
    assert!(status.sensors[usize::from(IMU)].refused[&Refusal::Incomplete] > 300);
    let share = |own: usize| passage.counts[own] as f64 / sound().counts[own] as f64;
    assert!(share(0) > 0.94 && share(1) > 0.85, "{:?} of {:?}", passage.counts, sound().counts);
    let worst = apart(&passage, sound());
    assert!(worst < 3.0, "{worst} sigma apart");
}

#[test]
fn the_same_frames_give_the_same_bits() {
    let again = ship().sail();
    assert_eq!(format!("{:?}", again.solutions), format!("{:?}", sound().solutions));
    assert_eq!(format!("{:?}", again.events), format!("{:?}", sound().events));
}

#[test]
fn plain_frames_and_messages_may_share_a_port() {
    let frames = ship().changed(|own| vec![Arrival { port: PortId(BUS), ..own.clone() }]);
    let passage = frames.sail_with(|config| {
        let port = config.sensors[usize::from(GNSS)].port.clone();
        config.sensors[usize::from(IMU)].port = port;
    });
    assert_eq!(passage.counts, sound().counts);
    assert!(usual().counts[0] == passage.counts[0]);
    let extended = |own: &&Arrival| matches!(&own.input, Input::Can(frame) if matches!(frame.id(), CanId::Extended(_)));
    assert_eq!(frames.arrivals.iter().filter(extended).count(), frames.arrivals.len());
}
