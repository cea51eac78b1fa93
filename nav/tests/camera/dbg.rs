use super::*;
#[test]
fn dbg() {
    for trouble in [Trouble::Usual] {
        let mut by = vec![[0.0; 5]; 8];
        for seed in 0..24 {
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
                        by[second / 5 - 1][i] += e.dot(&b.covariance(filter.covariance()).cholesky().unwrap().solve(&e)) / 3.0 / 24.0;
                    }
                    by[second / 5 - 1][4] += (error.of(VELOCITY)).norm_squared() / 24.0 * 100.0;
                }
            }
        }
        println!("{by:.2?}");
    }
}
