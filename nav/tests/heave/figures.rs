//! What the heave is good for: its errors and what it says of them.

use insd_base::HeaveQuality;

use crate::sea::{Move, Sea, System};
use crate::trial::{ABEAM, Errors, GRADES, Grade, Instant, Trial, rms};

fn trial(grade: Grade, seed: u64) -> Trial<'static> {
    Trial { grade, rate: 50.0, duration: 1500.0, seed, points: &[ABEAM] }
}

/// Height, m, and period, s, of the seas that are sailed through in these tests.
const SEAS: [(f64, f64); 5] = [(0.88, 4.0), (1.88, 8.0), (3.25, 12.0), (5.0, 16.0), (5.0, 20.0)];

fn records(grade: Grade) -> Vec<Vec<Instant>> {
    let sail = |(seed, (height, peak)): (usize, &(f64, f64))| {
        let seed = seed as u64 + 40;
        trial(grade, seed).in_sea(&Sea::new(&[System::new(*height, *peak)], seed))
    };
    SEAS.iter().enumerate().map(sail).collect()
}

/// Errors within 5 cm or 5 % in real time, 2 cm or 2 % delayed, at the IMU and 40 m ahead of it; within
/// two sigmas as often as a normal error is.
fn holds_the_figures(grade: Grade) {
    let mut covered = Vec::new();
    for (record, sea) in records(grade).iter().zip(SEAS) {
        for point in 0..2 {
            let heave = rms(record, point).max(1.0);
            let real_time = Errors::real_time(record, point, 500.0, 1500.0);
            let delayed = Errors::delayed(record, point, 200.0, 1500.0);
            assert!(real_time.rms < 0.05 * heave, "{sea:?} {point}: {real_time:?}");
            assert!(delayed.rms < 0.02 * heave, "{sea:?} {point}: {delayed:?}");
            assert!(delayed.settled > 0.9, "{sea:?} {point}: {delayed:?}");
            covered.extend([real_time.covered, delayed.covered]);
        }
    }
    let mean = covered.iter().sum::<f64>() / covered.len() as f64;
    assert!((0.9..0.995).contains(&mean), "{covered:?}");
}

#[test]
fn a_navigation_grade_imu_gives_heave_to_the_figures_of_the_best_products() {
    holds_the_figures(GRADES[0]);
}

#[test]
fn a_tactical_grade_imu_gives_heave_to_the_figures_of_the_best_products() {
    holds_the_figures(GRADES[1]);
}

#[test]
fn a_consumer_grade_imu_gives_heave_to_the_figures_of_the_best_products() {
    holds_the_figures(GRADES[2]);
}

#[test]
fn swell_and_wind_sea_together_are_followed() {
    let sea = Sea::new(&[System::new(1.5, 5.0), System::new(1.5, 16.0)], 3);
    let record = trial(GRADES[1], 3).in_sea(&sea);
    let errors = Errors::real_time(&record, 1, 500.0, 1500.0);
    assert!(errors.rms < 0.04, "{errors:?}");
}

#[test]
fn a_regular_swell_of_twenty_seconds_is_followed() {
    let omega = std::f64::consts::TAU / 20.0;
    let ship = |t: f64| {
        let (sin, cos) = (omega * t).sin_cos();
        Move { heave: 1.5 * cos, rate: -1.5 * omega * sin, roll: 0.0, pitch: 0.0 }
    };
    let record = trial(GRADES[1], 3).run(ship, |_, _, _| true);
    let errors = Errors::real_time(&record, 0, 500.0, 1500.0);
    assert!(errors.rms < 0.03, "{errors:?}");
}

#[test]
fn nothing_wild_leaves_before_the_filter_has_settled_which_takes_five_minutes() {
    for (seed, grade) in (0..6).zip(GRADES.iter().cycle()) {
        let sea = Sea::new(&[System::new(3.25, 10.0)], seed);
        let record = trial(*grade, seed).in_sea(&sea);
        for point in 0..2 {
            let truth = |i: &Instant| i.truth[point].abs();
            let largest = record.iter().map(truth).fold(0.0, f64::max);
            let unsettled: Vec<&Instant> = record
                .iter()
                .filter(|i| i.heave[point].quality == HeaveQuality::Unsettled)
                .collect();
            let wildest = unsettled.iter().map(|i| i.heave[point].heave.abs()).fold(0.0, f64::max);
            assert!(wildest < 1.3 * largest, "{} {wildest} {largest}", grade.name);
            assert!(unsettled.last().is_some_and(|i| i.t < 301.0));
            let early = Errors::real_time(&record, point, 0.0, 300.0);
            assert!(early.covered > 0.9, "{} {early:?}", grade.name);
        }
    }
}

#[test]
fn settled_means_within_the_figures() {
    for (seed, grade) in GRADES.iter().enumerate() {
        let sea = Sea::new(&[System::new(3.25, 14.0)], seed as u64);
        let record = trial(*grade, seed as u64).in_sea(&sea);
        let settled = record.iter().filter(|i| i.heave[0].quality == HeaveQuality::Settled);
        let errors: Vec<f64> = settled.map(|i| i.heave[0].heave - i.truth[0]).collect();
        let square = errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64;
        assert!(errors.len() > 9000 && square.sqrt() < 0.05, "{} {}", errors.len(), square.sqrt());
    }
}

#[test]
fn an_imu_that_is_worse_than_its_data_sheet_is_found_out() {
    let mut accel = GRADES[2].accel;
    accel[3] *= 8.0;
    let sea = Sea::new(&[System::new(1.88, 12.0)], 8);
    let trial = trial(GRADES[0], 8);
    let truly = Grade { name: "worse", accel };
    let mut error = truly.accelerometer(8);
    let record = trial.run(
        |t| sea.at(t),
        |_, step, _| {
            step.velocity += error.error(step.duration);
            true
        },
    );
    for point in 0..2 {
        let real_time = Errors::real_time(&record, point, 600.0, 1500.0);
        let delayed = Errors::delayed(&record, point, 400.0, 1500.0);
        assert!(real_time.covered > 0.9 && real_time.settled < 0.1, "{real_time:?}");
        assert!(delayed.covered > 0.9 && delayed.settled < 0.5, "{delayed:?}");
    }
}

#[test]
fn rate_and_acceleration_are_the_derivatives_of_the_heave() {
    let sea = Sea::new(&[System::new(1.88, 8.0)], 5);
    let record = trial(GRADES[0], 5).in_sea(&sea);
    for point in 0..2 {
        let (mut rate, mut acceleration, mut count) = (0.0, 0.0, 0.0);
        for three in record.windows(3).filter(|three| three[0].t > 500.0) {
            let [before, now, after] = [0, 1, 2].map(|i| three[i].truth[point]);
            let heave = &three[1].heave[point];
            rate += (heave.rate - (after - before) / 0.2).powi(2);
            acceleration += (heave.acceleration - (after - 2.0 * now + before) / 0.01).powi(2);
            count += 1.0;
        }
        let (rate, acceleration) = ((rate / count).sqrt(), (acceleration / count).sqrt());
        assert!(rate < 0.012 && acceleration < 0.08, "{point}: {rate} m/s {acceleration} m/s^2");
    }
}

#[test]
fn heave_between_the_ticks_follows_the_imu() {
    let sea = Sea::new(&[System::new(1.88, 6.0)], 6);
    let wave = |t: f64| sea.at(t);
    let mut steps = Vec::new();
    let record = Trial { rate: 200.0, duration: 700.0, ..trial(GRADES[0], 6) };
    let mut before: Option<f64> = None;
    record.run(wave, |t, _, filter| {
        if t > 600.0 {
            let heave = filter.heave(1).unwrap().heave;
            let moved = before.map(|b| heave - b);
            let down = [t - 0.01, t - 0.005].map(|t| {
                let ship = wave(t);
                ship.heave - ship.down_b().dot(&ABEAM.0)
            });
            steps.extend(moved.map(|moved| (moved - (down[1] - down[0])).abs()));
            before = Some(heave);
        }
        true
    });
    let worst = steps.iter().copied().fold(0.0, f64::max);
    assert!(steps.len() > 19_000 && worst < 0.003, "{worst}");
}

#[test]
fn imus_of_any_rate_give_the_same_heave() {
    let sea = Sea::new(&[System::new(1.88, 8.0)], 5);
    let heave = |rate: f64| {
        let trial = Trial { rate, duration: 700.0, ..trial(GRADES[0], 5) };
        let record = trial.run(|t| sea.at(t), |_, _, _| true);
        Errors::real_time(&record, 1, 400.0, 700.0)
    };
    for rate in [50.0, 64.0, 150.0, 1000.0] {
        let errors = heave(rate);
        assert!(errors.count > 2000 && errors.rms < 0.012, "{rate} Hz: {errors:?}");
    }
}
