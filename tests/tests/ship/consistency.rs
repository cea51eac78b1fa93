//! Honest claims over a few seeds. `insd campaign` does it over many seeds and hours.

use insd_lab::evaluation::{Component, EpochError, normalised};
use insd_tests::sailing::sail_all;
use insd_tests::scenario;
use insd_tests::scores::{Scores, dishonest};

use super::figure;

/// Scenarios of navigation and MEMS grade, eight seeds of 20 min, scored over the last five.
#[test]
fn over_eight_seeds_every_component_is_as_wrong_as_it_says() {
    for number in [2, 3] {
        let passages = sail_all(&scenario(number).with_duration(1200.0), 10..18);
        let scores: Vec<Scores> = passages.iter().map(|p| p.scores_from(900.0)).collect();
        for component in Component::ALL {
            let nees: f64 = scores.iter().map(|s| s.of(component).nees).sum();
            figure!("seeds {number} {} {:.2}", component.name(), nees / 8.0);
        }
        assert_eq!(dishonest(&scores, &Component::ALL), Vec::<String>::new());
        let beyond = |epoch: &EpochError, component| {
            normalised(epoch.of(component).unwrap(), epoch.sigma_of(component)).unwrap().abs() > 5.0
        };
        for component in Component::ALL {
            let wild = scores.iter().flat_map(|s| &s.epochs).filter(|e| beyond(e, component));
            assert_eq!(wild.count(), 0, "{} beyond five sigma", component.name());
        }
    }
}
