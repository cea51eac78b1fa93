//! Faults of the wires: ports that go and come, bytes that are late, lost, damaged or repeated.

use insd_base::{Arrival, Input, PortId, PortState, Span};
use insd_intake::choice::Why;
use insd_intake::event::Happening;
use insd_tests::feed::{at_wrong_baud, noise};

use super::passage::{COMPASS, GNSS, IMU, LOG, Ship, usual};

fn state(ship: &Ship, port: u16, seconds: f64, state: PortState) -> Arrival {
    Arrival { stamp: ship.at(seconds), port: PortId(port), input: Input::State(state) }
}

/// The ship without what a port gave in a span of time.
fn without(ship: &Ship, port: u16, span: (f64, f64)) -> Ship {
    ship.changed(|own| if ship.is_of(own, port, span) { vec![] } else { vec![own.clone()] })
}

/// The ship with what a port gave in a span of time all at once at its end.
fn held_up(ship: &Ship, port: u16, span: (f64, f64)) -> Ship {
    let mut waited = 0;
    ship.changed(|own| {
        let mut own = own.clone();
        if ship.is_of(&own, port, span) {
            // what waited comes before what is new
            waited += 200;
            own.stamp = ship.at(span.1);
            own.stamp.monotonic = own.stamp.monotonic + Span::from_nanos(waited);
        }
        vec![own]
    })
}

#[test]
fn a_receiver_that_is_unplugged_is_told_missed_and_taken_back() {
    let ship = Ship::usual();
    let span = (80.0, 110.0);
    let lost = PortState::Lost { reason: "input/output error".to_owned() };
    let absent = PortState::Absent { reason: "no such file".to_owned() };
    let open = PortState::Open { what: "/dev/ttyUSB0".to_owned() };
    let states = vec![
        state(ship, GNSS, 80.0, lost.clone()),
        state(ship, GNSS, 80.5, absent.clone()),
        state(ship, GNSS, 109.9, open.clone()),
    ];
    let passage = without(ship, GNSS, span).with(states).sail();
    for told in [lost, absent, open] {
        let port = PortId(GNSS);
        assert!(passage.has(|own| *own == Happening::Port { port, state: told.clone() }));
    }
    let gnss = usize::from(GNSS);
    assert!(passage.has(|own| *own == Happening::SensorSilent { sensor: gnss }));
    assert!(passage.has(|own| matches!(own, Happening::Chosen(own) if own.why == Why::NoneLeft)));
    let speaks = Happening::SensorSpeaks { sensor: gnss };
    assert_eq!(passage.events.iter().filter(|(_, own)| *own == speaks).count(), 2);
    assert!(usual().counts[gnss] - passage.counts[gnss] <= 151, "{:?}", passage.counts);
    passage.holds_against(usual(), GNSS);
}

#[test]
fn bytes_of_a_receiver_that_come_half_a_minute_late_all_at_once_do_no_harm() {
    let ship = Ship::usual();
    let passage = held_up(ship, GNSS, (80.0, 110.0)).sail();
    assert!(passage.has(|own| *own == Happening::SensorSilent { sensor: usize::from(GNSS) }));
    assert!(!passage.has(|own| matches!(own, Happening::Time(change) if is_step(*change))));
    passage.holds_against(usual(), GNSS);
}

fn is_step(change: insd_intake::clock::TimeChange) -> bool {
    matches!(change, insd_intake::clock::TimeChange::Stepped { .. })
}

#[test]
fn bytes_of_an_imu_that_come_half_a_minute_late_all_at_once_lose_nothing() {
    let ship = Ship::usual();
    let passage = held_up(ship, IMU, (80.0, 110.0)).sail();
    assert!(passage.has(|own| *own == Happening::SensorSilent { sensor: usize::from(IMU) }));
    assert!(!passage.has(|own| matches!(own, Happening::DeviceClockStepped { .. })));
    assert_eq!(passage.counts, usual().counts);
    assert_eq!(passage.solutions.len(), usual().solutions.len());
    passage.holds_against(usual(), IMU);
}

#[test]
fn bytes_of_log_and_compass_that_come_late_all_at_once_do_no_harm() {
    let ship = Ship::usual();
    for port in [LOG, COMPASS] {
        let passage = held_up(ship, port, (80.0, 110.0)).sail();
        assert!(passage.has(|own| *own == Happening::SensorSilent { sensor: usize::from(port) }));
        passage.holds_against(usual(), port);
    }
}

#[test]
fn half_a_minute_without_bytes_of_one_aid_is_sailed_through() {
    let ship = Ship::usual();
    for port in [GNSS, LOG, COMPASS] {
        let passage = without(ship, port, (80.0, 110.0)).sail();
        assert!(passage.has(|own| *own == Happening::SensorSilent { sensor: usize::from(port) }));
        passage.holds_against(usual(), port);
    }
}

/// What the filter makes of the gap is its own affair.
#[test]
fn two_seconds_without_an_imu_are_one_gap_and_cost_nothing_else() {
    let passage = without(Ship::usual(), IMU, (90.0, 92.0)).sail();
    assert_eq!(passage.noted.imu_gaps, 1);
    assert_eq!(usual().counts[0] - passage.counts[0], 200);
    assert_eq!(passage.solutions.len(), usual().solutions.len());
    passage.loses_nothing_beside(usual(), IMU);
}

#[test]
fn ten_megabytes_of_noise_on_a_port_do_no_harm() {
    let ship = Ship::usual();
    let burst = (0..640).map(|index| Arrival {
        stamp: ship.at(90.0 + 0.0025 * f64::from(index)),
        port: PortId(GNSS),
        input: Input::Bytes(noise(u64::from(index as u32), 16 * 1024)),
    });
    let passage = ship.with(burst.collect()).sail();
    let counts = passage.intake.status().ports[usize::from(GNSS)].counts;
    assert!(counts.skipped > 10_000_000, "{counts:?}");
    // the fixes of the burst that noise ran into, and one behind a false beginning
    assert!(usual().counts[1] - passage.counts[1] < 20, "{:?}", passage.counts);
    passage.holds_against(usual(), GNSS);
}

#[test]
fn a_wrong_baud_rate_is_garbage_and_no_measurement() {
    let ship = Ship::usual();
    for (port, ratio) in [(GNSS, 0.5), (LOG, 2.0), (COMPASS, 1.5)] {
        let garbled = ship.with_bytes(port, (80.0, 100.0), |bytes| at_wrong_baud(bytes, ratio));
        let passage = garbled.sail();
        let index = usize::from(port);
        assert!(passage.has(|own| *own == Happening::SensorSilent { sensor: index }));
        assert!(passage.intake.status().ports[index].counts.skipped > 100);
        passage.holds_against(usual(), port);
    }
}

#[test]
fn half_frames_cost_themselves_and_nothing_more() {
    let ship = Ship::usual();
    for port in [IMU, GNSS, LOG, COMPASS] {
        let mut count = 0;
        let halved = ship.with_bytes(port, (80.0, 100.0), |bytes| {
            count += 1;
            let length = if count % 7 == 0 { bytes.len() / 2 } else { bytes.len() };
            bytes[..length].to_vec()
        });
        let passage = halved.sail();
        let index = usize::from(port);
        let lost = usual().counts[index] - passage.counts[index];
        assert!(lost <= count / 7 + 1, "port {port}: {lost} of {}", count / 7);
        passage.holds_against(usual(), port);
    }
}

#[test]
fn frames_that_come_twice_are_used_once() {
    let ship = Ship::usual();
    for port in [IMU, GNSS, LOG, COMPASS] {
        let doubled = ship.with_bytes(port, (80.0, 100.0), |bytes| [bytes, bytes].concat());
        let mut passage = doubled.sail();
        // the engine refuses a sample of a time that it has had
        passage.counts[0] -= passage.noted.imu_duplicates as usize;
        assert_eq!(passage.counts, usual().counts, "port {port}");
        passage.holds_against(usual(), port);
    }
}
