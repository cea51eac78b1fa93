use super::*;
#[test]
fn dbg() {
    for trouble in [Trouble::Blind, Trouble::Usual] {
        let mut by = vec![[0.0; 4]; 8];
        for seed in 0..12 {
            let mut scene = Scene::new(seed, trouble);
            for second in 1..=40 {
                scene.sail(1.0);
                if second % 5 == 0 {
                    let filter = scene.filter();
                    let error = filter.nominal().error_to(scene.truth());
                    for (i, b) in [POSITION, VELOCITY, ATTITUDE, CAMERA_AXES].iter().enumerate() {
                        if !filter.covariance().has(*b) { continue; }
                        let mut e = error.of(*b);
                        if i == 3 { e += scene.axes(); }
                        by[second / 5 - 1][i] += e.dot(&b.covariance(filter.covariance()).cholesky().unwrap().solve(&e)) / 3.0 / 12.0;
                    }
                    if seed == 0 && trouble == Trouble::Usual {
                        let c = to_ned(&scene);
                        println!("{second} v {:.3?} s {:.3?} axes {:.4?} {:.4?} att {:.4?} {:.4?} nees {:.2}", (c*error.of(VELOCITY)).as_slice(), VELOCITY.covariance_in(filter.covariance(), &c).diagonal().map(f64::sqrt).as_slice(), (error.of(CAMERA_AXES)+scene.axes()).as_slice(), CAMERA_AXES.stds(filter.covariance()).as_slice(), (c*error.of(ATTITUDE)).as_slice(), ATTITUDE.covariance_in(filter.covariance(), &c).diagonal().map(f64::sqrt).as_slice(), nees(&scene));
                    }
                }
            }
        }
        println!("{by:.2?}");
    }
}
