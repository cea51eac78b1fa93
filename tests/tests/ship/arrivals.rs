//! Measurements that arrive late and out of order.

use insd::evaluation::Component;
use insd_base::{Message, Received, Solution, Voyage};
use insd_engine::EngineConfig;
use insd_simulator::simulate;
use insd_tests::sailing::{delayed, prompt, sail_messages, OUTPUT_RATE};
use insd_tests::scores::{Scores, pooled};
use insd_tests::scenario;
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

/// The messages of a voyage whose aids fall silent two seconds before its end.
fn silent_at_the_end(voyage: &Voyage, seconds: f64, delay: impl Fn(usize) -> f64) -> Vec<Received> {
    let mut messages = delayed(voyage, delay);
    messages.retain(|received| {
        matches!(received.message, Message::Imu(_))
            || received.message.time().as_seconds() < seconds - 2.0
    });
    messages
}

#[test]
fn s13_once_all_has_arrived_the_solution_is_as_if_it_had_come_on_time() {
    for voyage in voyages(300.0, 0..2) {
        let on_time = sail(&voyage, &silent_at_the_end(&voyage, 300.0, |_| 0.0));
        let late = sail(&voyage, &silent_at_the_end(&voyage, 300.0, up_to_a_second));
        let (a, b) = (on_time.last().unwrap(), late.last().unwrap());
        assert_eq!(a.time, b.time);
        let apart = insd_base::earth::ecef(&a.position).0 - insd_base::earth::ecef(&b.position).0;
        let turned = (a.attitude.heading - b.attitude.heading).abs();
        figure!("s13 end {:e} m, {:e} m/s, {turned:e} rad", apart.norm(), (a.velocity.0 - b.velocity.0).norm());
        assert!(apart.norm() < 1e-3, "{apart:?}");
        assert!((a.velocity.0 - b.velocity.0).norm() < 1e-4);
        assert!(turned < 0.01 * a.sigma.heading, "{turned:e}");
        assert!((a.sigma.heading / b.sigma.heading - 1.0).abs() < 1e-3);
    }
}
