//! Voyages with a MEMS IMU whose biases follow its temperature and whose yaw gyro's scale follows the turn, beyond its data
//! sheet, as real ones do; the log has a scale that follows the speed. Nobody lies.
//!
//! `temperature [SEEDS]`: normalised squares of the errors of each voyage, how long any measurement was refused in
//! one piece, and by how much worse than its data sheet the IMU was found to be; where nobody tells the temperature of the IMU, and where it
//! is told.

mod sail;
mod systematic;

use insd_simulator::{Scenario, simulate};
use rayon::prelude::*;

use sail::{Outcome, sail};

const FERRY: &str = include_str!("ferry.toml");

fn main() {
    let seeds: u64 = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(9);
    let scenario = match Scenario::with_overrides(FERRY, &[]) {
        Ok(scenario) => scenario,
        Err(fault) => return eprintln!("{fault}"),
    };
    for is_told in [false, true] {
        let one = |seed: u64| sail(&systematic::spoilt(simulate(&scenario, seed), seed), is_told);
        let all: Vec<Outcome> = (1..=seeds).into_par_iter().map(one).collect();
        println!("temperature {}", if is_told { "told" } else { "not told" });
        println!("seed {}", Outcome::HEAD);
        all.iter().zip(1..).for_each(|(one, seed): (_, u64)| println!("{seed:>4} {one}"));
        println!("mean {}", Outcome::mean(&all));
    }
}
