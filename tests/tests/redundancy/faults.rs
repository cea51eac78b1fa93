//! IMUs that go wrong.

use rayon::iter::{IntoParallelIterator, ParallelIterator};

use super::{
    FAULT, Fault, VOYAGE, alert, faulty, heading, heading_told, is_covered, position, switch,
};

/// Faults, within how many seconds the alert must be up, and how long is sailed, s.
const FAULTS: [(Fault, f64, f64); 10] = [
    (Fault::Bias([0.0, 0.0, 3600.0]), 5.0, 300.0),
    (Fault::Bias([0.0, 0.0, -1080.0]), 5.0, 300.0),
    (Fault::Bias([0.0, 0.0, 720.0]), 5.0, 300.0),
    (Fault::Bias([0.0, 0.0, 360.0]), 10.0, 300.0),
    (Fault::Bias([100.0, 0.0, 0.0]), 15.0, 300.0),
    (Fault::Bias([5.0, 0.0, 0.0]), 100.0, 420.0),
    (Fault::Bias([0.0, 0.0, 5.0]), 500.0, VOYAGE),
    (Fault::Stuck, 10.0, 300.0),
    (Fault::Scale(1.1), 30.0, 420.0),
    (Fault::Force(0.05), 60.0, 420.0),
];

#[test]
fn a_wrong_second_imu_is_noticed_and_the_outputs_stay_right() {
    FAULTS.into_par_iter().for_each(|(fault, within, until)| {
        let log = faulty(2, 1, fault, until).sail();
        let alert = alert(&log, fault);
        println!("second {fault:?}: alert {alert:?}, {:?}", log.votes);
        assert_eq!(log.used, [0], "{fault:?}");
        assert!(alert.is_some_and(|at| at <= within), "{fault:?}: {alert:?}");
        let (error, sigmas) = heading(&log, FAULT);
        assert!(sigmas < 3.0, "{fault:?}: {error} deg, {sigmas} sigmas");
    });
}

#[test]
fn a_wrong_first_imu_is_noticed_and_left_where_something_tells_that_it_is_the_wrong_one() {
    FAULTS.into_par_iter().for_each(|(fault, within, until)| {
        let log = faulty(2, 0, fault, until).sail();
        let (alert, switch) = (alert(&log, fault), switch(&log));
        let most = heading_told(&log, FAULT);
        println!("first {fault:?}: alert {alert:?}, switch {switch:?}, {most:.2} deg");
        println!("   {:?}", log.votes);
        assert!(alert.is_some_and(|at| at <= within), "{fault:?}: {alert:?}");
        assert!(most < 1.0 || is_covered(&log, FAULT), "{fault:?}: {most} deg");
        if let Some(switch) = switch {
            assert_eq!(log.used, [0, 1], "{fault:?}");
            let after = FAULT + switch + 0.2;
            let (error, sigmas) = heading(&log, after);
            assert!(sigmas < 3.0, "{fault:?}: {error} deg, {sigmas} sigmas");
            assert!(position(&log, after) < 8.0, "{fault:?}");
        }
    });
}

#[test]
fn of_three_the_wrong_one_is_voted_out_whichever_it_is() {
    let cases: Vec<_> = (0..3).flat_map(|wrong| FAULTS.map(|fault| (wrong, fault))).collect();
    cases.into_par_iter().for_each(|(wrong, (fault, within, until))| {
        let log = faulty(3, wrong, fault, until).sail();
        let (alert, switch) = (alert(&log, fault), switch(&log));
        println!("{wrong} of three {fault:?}: alert {alert:?}, switch {switch:?}");
        println!("   {:?}", log.votes);
        assert!(alert.is_some_and(|at| at <= within), "{wrong} {fault:?}: {alert:?}");
        assert_eq!(switch.is_some(), wrong == 0, "{fault:?}");
        assert_ne!(log.used.last(), Some(&wrong), "{fault:?}");
        let after = FAULT + switch.unwrap_or(0.0) + 0.2;
        let (error, sigmas) = heading(&log, after);
        assert!(sigmas < 3.0, "{wrong} {fault:?}: {error} deg, {sigmas} sigmas");
        assert!(position(&log, after) < 8.0, "{wrong} {fault:?}");
    });
}
