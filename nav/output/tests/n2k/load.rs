//! What the default table costs the bus, and that the figure of the library is that of real frames.

use insd_base::units::DEG;
use insd_base::{CanFrame, Ned, Time, UtcTime};
use insd_n2k::node::Transmit;
use insd_n2k::{BROADCAST, N2kId, fast_packet};
use insd_output::n2k::{BITS_PER_SECOND, BusLoad, PgnSchedule, default_transmit};
use insd_output::{Manner, OutputEpoch};

use crate::ship::{epoch, heaving, solution};

#[test]
fn the_default_table_takes_four_percent_of_the_bus() {
    let load = BusLoad::of(&default_transmit());
    let share = |bits: f64| (bits / BITS_PER_SECOND * 1e4).round() / 100.0;
    assert_eq!((load.frames * 1000.0).round(), 67_000.0);
    assert_eq!((share(load.mean_bits()), share(load.worst_bits())), (3.75, 4.29));
}

#[test]
fn groups_that_are_not_sent_cost_nothing() {
    let none = |line: Transmit| Transmit { enabled: false, ..line };
    let off: Vec<Transmit> = default_transmit().into_iter().map(none).collect();
    assert_eq!(BusLoad::of(&off).frames, 0.0);
    let everything: Vec<Transmit> =
        default_transmit().into_iter().map(|line| Transmit { enabled: true, ..line }).collect();
    assert_eq!((BusLoad::of(&everything).frames * 1000.0).round(), 69_000.0);
}

/// The ship of a minute: turning, rolling, with everything known that is known today.
fn sailing(step: i64) -> OutputEpoch {
    let time = Time::from_nanos(step * 100_000_000);
    let seconds = time.as_seconds();
    let mut ship = solution();
    ship.attitude.heading += 0.3 * DEG * seconds;
    ship.attitude.roll = 5.0 * DEG * (0.6 * seconds).sin();
    ship.attitude.pitch = 2.0 * DEG * (0.9 * seconds).cos();
    ship.rate.0.z = 0.3 * DEG * (1.0 + 0.2 * (0.5 * seconds).sin());
    ship.velocity = Ned::new(0.45 + 0.1 * (0.4 * seconds).cos(), 5.12 - 0.01 * seconds, 0.0);
    ship.position.latitude += 1e-7 * seconds;
    ship.position.longitude += 1e-6 * seconds;
    let utc =
        UtcTime::from_civil((2026, 1, 2), (3, 4, 0), 0).map(|utc| utc.plus(time - Time::START));
    OutputEpoch {
        time,
        solution: Some(ship),
        utc,
        heave: Some(heaving(0.8 * (0.7 * seconds).sin())),
        covariance_north_east: None,
        current: None,
        ..epoch()
    }
}

/// The frames of a message.
fn frames(priority: u8, pgn: u32, contents: &[u8], counter: u8) -> Vec<CanFrame> {
    let id = N2kId { priority, pgn, source: 35, destination: BROADCAST };
    match CanFrame::new(id.compose(), contents) {
        Some(frame) => vec![frame],
        None => fast_packet::split(id, contents, counter).unwrap(),
    }
}

#[test]
fn the_mean_stuffing_is_that_of_real_frames() {
    let table = default_transmit();
    let mut voice = PgnSchedule::new(Manner::default());
    let mut counts = Vec::new();
    for step in 0..600 {
        for (pgn, contents) in voice.messages(&sailing(step), &table) {
            let priority = table.iter().find(|line| line.pgn == pgn).unwrap().priority;
            let frames = frames(priority, pgn, &contents, (step % 8) as u8);
            counts.extend(frames.iter().map(|frame| frame.wire_bits() - 131));
        }
    }
    let frames = BusLoad::of(&table).frames;
    assert_eq!(counts.len(), (60.0 * frames).round() as usize);
    assert!(counts.iter().max() <= Some(&29));
    let mean = f64::from(counts.iter().sum::<u32>()) / counts.len() as f64;
    let claimed = BusLoad { frames: 1.0 }.mean_bits() - 131.0;
    assert!((mean - claimed).abs() < 0.3, "{mean:.2} bits are stuffed, {claimed} are claimed");
}
