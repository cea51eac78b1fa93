//! Two receivers on one ship.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod sail;

use insd_simulator::lies::{GnssLie, Grade, Lie, Suite, Told, Window};
use nalgebra::Vector2;

#[test]
fn figures() {
    use rayon::prelude::*;
    use sail::*;
    let from = 1500.0;
    let lies: Vec<(&str, Option<GnssLie>)> = vec![
        ("honest", None),
        ("jump", Some(GnssLie::Jump(Vector2::new(200.0, -220.0)))),
        ("drag", Some(GnssLie::Drag { velocity: Vector2::new(0.6, 0.8), consistent: true })),
        ("slide", Some(GnssLie::Drag { velocity: Vector2::new(0.6, 0.8), consistent: false })),
        ("frozen", Some(GnssLie::FrozenPosition)),
        ("velocity", Some(GnssLie::VelocitySign)),
    ];
    let mut cases = Vec::new();
    for grade in [Grade::Navigation, Grade::Mems] {
        for suite in [Suite::Gnss, Suite::Log] {
            for (name, lie) in &lies {
                for of_spare in [false, true] {
                    for seed in 1..=2 {
                        cases.push((grade, suite, *name, *lie, of_spare, seed));
                    }
                }
            }
        }
    }
    let only = std::env::var("ONLY").unwrap_or_default();
    let out: Vec<String> = cases
        .into_par_iter()
        .filter(|case| format!("{case:?}").contains(&only))
        .map(|(grade, suite, name, lie, of_spare, seed)| {
            let mut ship = Ship::new(grade, suite, seed, SINGLE_POINT);
            if name == "honest" && of_spare {
                ship = ship.with_first(RTK);
            }
            spoil(&mut ship, lie, of_spare, from);
            let sailed = ship.sail();
            format!(
                "{grade:?} {suite} {name} spare {of_spare} seed {seed}: {}",
                sailed.summary(from)
            )
        })
        .collect();
    for line in out {
        println!("{line}");
    }
}

fn spoil(ship: &mut sail::Ship, lie: Option<GnssLie>, of_spare: bool, from: f64) {
    use rand::SeedableRng;
    let Some(lie) = lie else { return };
    let told = Told { lie: Lie::Gnss(lie), window: Window { from, until: f64::INFINITY } };
    let mut rng = rand_pcg::Pcg64::seed_from_u64(3);
    if of_spare {
        let mut other = ship.voyage.clone();
        other.gnss = std::mem::take(&mut ship.spare);
        told.spoil(&mut other, &mut rng);
        ship.spare = other.gnss;
    } else {
        told.spoil(&mut ship.voyage, &mut rng);
    }
}
