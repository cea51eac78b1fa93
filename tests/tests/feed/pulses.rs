//! Faults of the pulse line.

use insd_base::{Arrival, Input, PortId, Pulse, Span};
use insd_intake::clock::{PulseFault, TimeChange, TimeQuality};
use insd_intake::event::Happening;

use super::passage::{GNSS, Passage, Ship};

/// The usual ship with a pulse for each second, later or earlier by what `edges` says, s.
fn ship_with(edges: impl Fn(u32) -> Vec<f64>) -> Ship {
    let ship = Ship::usual();
    let mut sequence = 0;
    let mut pulses = Vec::new();
    for second in 0..150 {
        for late in edges(second) {
            sequence += 1;
            let stamp = ship.at(f64::from(second) + late);
            let pulse = Pulse { time: stamp.monotonic, sequence };
            let mut stamp = stamp;
            // the kernel's stamp is read a little later
            stamp.monotonic = stamp.monotonic + Span::from_nanos(50_000);
            pulses.push(Arrival { stamp, port: PortId(GNSS), input: Input::Pulse(pulse) });
        }
    }
    ship.with(pulses)
}

/// A few microseconds of interrupt latency.
fn latency(second: u32) -> f64 {
    f64::from(second * 7 % 5) * 1e-6
}

fn faults(passage: &Passage) -> Vec<PulseFault> {
    let faults = passage.events.iter().filter_map(|(_, own)| match own {
        Happening::Time(TimeChange::Pulse(fault)) => Some(*fault),
        _ => None,
    });
    faults.collect()
}

fn sound() -> Passage {
    ship_with(|second| vec![latency(second)]).sail()
}

fn ends_on_pulses(passage: &Passage) -> bool {
    passage.intake.status().time.quality == TimeQuality::Pulses
}

#[test]
fn pulses_tie_utc_to_microseconds() {
    let ship = ship_with(|second| vec![latency(second)]);
    let passage = ship.sail();
    assert!(ends_on_pulses(&passage) && faults(&passage).is_empty());
    let error = passage.utc_error(&ship, 140.0);
    assert!(error.abs() < 10e-6, "{error:e}");
}

#[test]
fn pulses_that_are_lost_doubled_or_late_are_told_and_move_nothing() {
    let sound = sound();
    let inside = |second: u32| (80..84).contains(&second);
    let lost = ship_with(|second| if inside(second) { vec![] } else { vec![latency(second)] });
    let doubled = ship_with(|second| {
        let one = latency(second);
        if inside(second) { vec![one, one + 0.4] } else { vec![one] }
    });
    let late = ship_with(|second| vec![latency(second) + if inside(second) { 0.01 } else { 0.0 }]);
    for (ship, count) in [(lost, 1), (doubled, 4), (late, 4)] {
        let passage = ship.sail();
        let told = faults(&passage);
        assert_eq!(told.len(), count, "{told:?}");
        let is_expected = |own: &PulseFault| match own {
            PulseFault::Lost => count == 1,
            PulseFault::Off { .. } => count == 4,
            PulseFault::Unlocked => false,
        };
        assert!(told.iter().all(is_expected), "{told:?}");
        assert!(ends_on_pulses(&passage));
        assert!(passage.utc_error(&ship, 140.0).abs() < 20e-6);
        assert_eq!(passage.counts, sound.counts);
        passage.does_not_step(&sound);
    }
}

#[test]
fn pulses_that_stop_for_good_leave_the_time_where_it_was() {
    let sound = sound();
    let ship = ship_with(|second| if second < 80 { vec![latency(second)] } else { vec![] });
    let passage = ship.sail();
    assert_eq!(faults(&passage), [PulseFault::Lost]);
    assert!(passage.utc_error(&ship, 140.0).abs() < 100e-6);
    assert_eq!(passage.counts, sound.counts);
    passage.does_not_step(&sound);
}

#[test]
fn pulses_that_move_for_good_are_named_anew_and_followed() {
    let sound = sound();
    let moved = |second: u32| if second < 80 { 0.0 } else { 0.01 };
    let ship = ship_with(|second| vec![latency(second) + moved(second)]);
    let passage = ship.sail();
    let told = faults(&passage);
    assert_eq!((told.len(), told.last()), (5, Some(&PulseFault::Unlocked)), "{told:?}");
    assert!(ends_on_pulses(&passage));
    assert!((passage.utc_error(&ship, 140.0) + 0.01).abs() < 20e-6);
    assert_eq!(passage.counts, sound.counts);
    passage.does_not_step(&sound);
}
