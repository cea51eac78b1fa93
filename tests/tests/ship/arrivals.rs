//! Measurements that arrive late and out of order.

use insd_base::{Message, Received, Solution, Voyage, earth};
use insd_engine::EngineConfig;
use insd_lab::evaluation::Component;
use insd_simulator::simulate;
use insd_tests::sailing::{OUTPUT_RATE, delayed, prompt, sail_messages};
use insd_tests::scores::{Scores, pooled};
use insd_tests::{scenario, variant};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use super::figure;

/// Delays of 0 to 1 s that look random and are the same every time, s.
fn up_to_a_second(index: usize) -> f64 {
    (index as f64 * 0.618_033_988_749_895).fract()
}

fn sail(voyage: &Voyage, messages: &[Received]) -> Vec<Solution> {
    sail_messages(&EngineConfig::for_voyage(&voyage.header, OUTPUT_RATE), messages, 1).solutions
}

fn voyages(seconds: f64, seeds: std::ops::Range<u64>) -> Vec<Voyage> {
    seeds.into_par_iter().map(|s| simulate(&scenario(13).with_duration(seconds), s)).collect()
}

#[test]
fn s13_delays_of_up_to_a_second_cost_less_than_five_percent() {
    let voyages = voyages(900.0, 0..4);
    let scored = |deliver: &(dyn Fn(&Voyage) -> Vec<Received> + Sync)| {
        let one = |voyage: &Voyage| {
            Scores::new(&sail(voyage, &deliver(voyage)), &voyage.truth, 400.0, f64::MAX)
        };
        pooled(&(0..voyages.len()).into_par_iter().map(|i| one(&voyages[i])).collect::<Vec<_>>())
    };
    let on_time = scored(&prompt);
    let late = scored(&|voyage| delayed(voyage, up_to_a_second));
    for component in Component::ALL {
        let growth = late.of(component).rms / on_time.of(component).rms;
        figure!("s13 {} {} {growth:.4}", component.name(), on_time.of(component).rms);
        assert!(growth < 1.05, "{}: {growth}", component.name());
    }
    assert!(late.horizontal().rms < 1.05 * on_time.horizontal().rms);
}

/// The messages of a voyage of 300 s whose aids fall silent two seconds before its end, delayed from
/// `late_from` on, s.
fn silent_at_the_end(voyage: &Voyage, late_from: f64) -> Vec<Received> {
    let messages = voyage.received();
    let is_late = |index: usize| messages[index].message.time().as_seconds() >= late_from;
    let delay = |index| if is_late(index) { up_to_a_second(index) } else { 0.0 };
    let mut late = delayed(voyage, delay);
    late.retain(|received| {
        matches!(received.message, Message::Imu(_)) || received.message.time().as_seconds() < 298.0
    });
    late
}

/// The last solution of such a voyage.
fn end(voyage: &Voyage, late_from: f64) -> Solution {
    *sail(voyage, &silent_at_the_end(voyage, late_from)).last().unwrap()
}

/// Closely and not to the bit: where a fix and a log velocity are valid at the same instant, they are
/// applied in the order of their arrival, and a start chooses its first estimate from what has
/// arrived.
#[test]
fn s13_once_all_has_arrived_the_solution_is_as_if_it_had_come_on_time() {
    for voyage in voyages(300.0, 0..2) {
        let (a, b) = (end(&voyage, f64::MAX), end(&voyage, 0.0));
        assert_eq!(a.time, b.time);
        let apart = earth::ecef(&a.position).0 - earth::ecef(&b.position).0;
        let slipped = a.velocity.0 - b.velocity.0;
        let turned = (a.attitude.heading - b.attitude.heading).abs();
        figure!("s13 end {:e} m {:e} m/s {turned:e} rad", apart.norm(), slipped.norm());
        assert!(apart.norm() < 0.01 * a.sigma.position.0.norm(), "{apart:?}");
        assert!(slipped.norm() < 0.01 * a.sigma.velocity.0.norm(), "{slipped:?}");
        assert!(turned < 0.01 * a.sigma.heading, "{turned:e}");
        assert!((a.sigma.heading / b.sigma.heading - 1.0).abs() < 1e-3);
    }
}

#[test]
fn s13_once_all_fixes_have_arrived_the_solution_is_the_same_to_the_bit() {
    let only_gnss = [("[log]\narrival = { fixed_s = 0.2, random_s = 0.2 }", "")];
    let voyage = simulate(&variant(13, &only_gnss).with_duration(300.0), 0);
    assert_eq!(end(&voyage, 20.0), end(&voyage, f64::MAX));
}
