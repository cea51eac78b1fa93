//! The table of errors over sea states, periods and grades of IMU.

use crate::sea::{Sea, System};
use crate::trial::{ABEAM, Errors, GRADES, Grade, Trial, rms};

/// Seeds of each row.
const SEEDS: u64 = 3;
/// When the bank has learnt the sea, and the end, s.
const LEARNT: f64 = 600.0;
const END: f64 = 2400.0;

/// Prints the errors of one sea and IMU: at the IMU and at the point ahead of it, in real time and
/// delayed.
fn row(grade: Grade, name: &str, systems: &[System]) {
    let trial = |seed| {
        let sea = Sea::new(systems, 1000 + seed);
        Trial { grade, rate: 50.0, duration: END, seed, points: &[ABEAM] }.in_sea(&sea)
    };
    let records: Vec<_> = (0..SEEDS).map(trial).collect();
    let mut line = format!("{:10} {name:14}", grade.name);
    for point in 0..2 {
        let heave = records.iter().map(|record| rms(record, point)).sum::<f64>() / SEEDS as f64;
        let all = |of: &dyn Fn(&[_]) -> Errors| {
            Errors::mean(&records.iter().map(|record| of(record)).collect::<Vec<_>>())
        };
        let real_time = all(&|record| Errors::real_time(record, point, LEARNT, END));
        let delayed = all(&|record| Errors::delayed(record, point, 300.0, END));
        for (errors, share) in [(real_time, 0.05), (delayed, 0.02)] {
            line += &format!(
                " | {:4.2} {:5.2} {:5.2} {:5.2} {:3.0}%",
                errors.rms / (share * heave.max(1.0)),
                100.0 * errors.rms,
                100.0 * errors.p95,
                100.0 * errors.worst,
                100.0 * errors.covered,
            );
        }
    }
    println!("{line}");
}

/// `cargo test -p insd-nav --test heave -- --ignored --nocapture the_campaign`
#[test]
#[ignore = "two days of sea, a minute of computing"]
fn the_campaign_prints_its_table() {
    println!(
        "Root mean square over its limit (5 cm or 5 %, delayed 2 cm or 2 %); root mean square, 95 % and \
         greatest error, cm; share within two sigmas.\nIMU: real time | delayed | 40 m ahead: real time | \
         delayed"
    );
    for grade in GRADES {
        for (state, height) in [(3, 0.88), (4, 1.88), (5, 3.25), (6, 5.0)] {
            for peak in [4.0, 8.0, 12.0, 16.0, 20.0] {
                let name = format!("state {state} {peak:4.1} s");
                row(grade, &name, &[System::new(height, peak)]);
            }
        }
        let mixed = [System::new(1.5, 5.0), System::new(1.5, 16.0)];
        row(grade, "5 s and 16 s", &mixed);
    }
}
