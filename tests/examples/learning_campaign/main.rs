//! Outages of ships whose errors repeat and of others where nothing does, with what is learnt of their sensors and without. One table.
//!
//! ```text
//! cargo run --release -p insd-tests --example learning_campaign -- 12 docs/learning.md
//! ```
//!
//! So many ships of each kind, of 30 losses each after an hour of learning; and the page whose table is filled in. Without a page the table is printed. In the environment
//! `SEED=3` takes one of the seeds, and `SHIPS=1` tells each ship.

mod outages;
mod ship;
mod table;

use std::error::Error;

use insd_tests::pages;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use outages::{End, ends};
use ship::{Kind, Ship};

type Failed = Box<dyn Error + Send + Sync>;

fn main() -> Result<(), Failed> {
    let mut arguments = std::env::args().skip(1);
    let ships: u64 = arguments.next().map_or(Ok(12), |ships| ships.parse())?;
    let one: Option<u64> = std::env::var("SEED").ok().and_then(|seed| seed.parse().ok());
    let seeds: Vec<u64> = one.map_or((1..=ships).collect(), |seed| vec![seed]);
    let mut text = table::HEAD.to_owned();
    for (name, kind) in [("errors repeat", Kind::Repeating), ("nothing repeats", Kind::Control)] {
        let sailed: Result<Vec<_>, Failed> =
            seeds.clone().into_par_iter().map(|seed| sail(kind, seed)).collect();
        let sailed = sailed?;
        let of = |which: usize| -> Vec<End> {
            sailed.iter().flat_map(|own: &[Vec<End>; 2]| own[which].iter().copied()).collect()
        };
        text += &table::rows(name, &of(0), &of(1));
    }
    Ok(pages::put(arguments.next(), "learning-campaign", &text)?)
}

/// Ends of the outages of a ship without what is learnt and with it.
fn sail(kind: Kind, seed: u64) -> Result<[Vec<End>; 2], Failed> {
    let ship = Ship::drawn(kind, seed)?;
    let both = [false, true].map(|is_learning| ends(&ship, is_learning));
    if std::env::var_os("SHIPS").is_some() {
        eprint!("{}", table::rows(&format!("{kind:?} {seed}"), &both[0], &both[1]));
    }
    Ok(both)
}
