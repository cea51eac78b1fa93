//! Heave on a simulated voyage: through the navigator, with turns, from the IMU's samples on.

use insd_base::units::{DEG, DEG_PER_HOUR};
use insd_base::{Message, Truth, Voyage};
use insd_nav::error_state::{ATTITUDE, POSITION, VELOCITY};
use insd_nav::heave::{HeaveFilter, VerticalStep};
use insd_nav::initial::sensor_covariance;
use insd_nav::{
    Conditioned, Conditioner, Filter, Increment, InitialState, NavConfig, Nominal, Timeline,
};
use insd_simulator::{Scenario, simulate};
use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::trial::{ABEAM, Errors, Instant, centre, rms};

/// Headings, deg, and seconds on each.
type Legs<'a> = &'a [(f64, f64)];

fn voyage(grade: &str, sea: &str, legs: Legs<'_>) -> Voyage {
    let leg = |(heading, seconds): &(f64, f64)| {
        format!(
            "[[route.legs]]\nheading_deg = {heading}\nspeed_kn = 10.0\nduration_s = {seconds}\n"
        )
    };
    let legs: String = legs.iter().map(leg).collect();
    let text = format!(
        "name = \"heave\"\nmode = \"underway\"\n[start]\nlat_deg = 54.0\nlon_deg = 3.0\n\
         height_m = 40.0\n{legs}[sea]\n{sea}\n[imu]\ngrade = \"{grade}\"\n[gnss]\n[log]\n"
    );
    simulate(&Scenario::from_toml(&text).unwrap(), 4)
}

/// A navigator with its heave filter.
struct Sailing {
    timeline: Timeline<Filter>,
    conditioner: Conditioner,
    heave: HeaveFilter,
}

impl Sailing {
    /// Begins with the truth, but for a tilt.
    fn new(voyage: &Voyage) -> Self {
        let header = &voyage.header;
        let config = NavConfig::new(header.imu, header.lever_arms);
        let truth = &voyage.truth[0];
        let (v_n, attitude) = (truth.velocity.unwrap().0, truth.attitude.unwrap());
        let tilt = if header.imu.gyro.bias_std > DEG_PER_HOUR { 0.1 * DEG } else { 0.01 * DEG };
        let mut covariance = sensor_covariance(&config);
        POSITION.renew(&mut covariance, &Matrix3::from_diagonal_element(25.0));
        VELOCITY.renew(&mut covariance, &Matrix3::from_diagonal_element(0.01));
        ATTITUDE.renew(&mut covariance, &Matrix3::from_diagonal_element(tilt * tilt));
        let wrong = Rotation3::new(Vector3::new(0.7, -0.5, 0.8) * tilt).into_inner();
        let nominal = Nominal::at(&truth.position, &v_n, &(wrong * attitude.c_nb()));
        let initial = InitialState::new(truth.time, nominal, covariance, Vector3::zeros());
        let mut filter = Filter::new(&config, &initial);
        filter.begin_navigation();
        Sailing {
            timeline: Timeline::new(filter, truth.time),
            conditioner: Conditioner::new(&header.imu),
            heave: HeaveFilter::new(&header.imu, &[ABEAM]),
        }
    }

    fn advance(&mut self, increment: &Increment) {
        let before = self.timeline.estimator().smooth_velocity();
        self.timeline.advance(increment);
        let filter = self.timeline.estimator();
        let view = filter.view();
        let down = view.c_ne.fixed_rows::<1>(2).transpose();
        self.heave.advance(&VerticalStep {
            to: increment.to,
            duration: increment.duration(),
            velocity: -down.dot(&(filter.smooth_velocity() - before)),
            down_b: view.c_nb().row(2).transpose(),
        });
    }

    fn sail(mut self, voyage: &Voyage) -> Vec<Instant> {
        let mut record = Vec::new();
        let mut truth = voyage.truth.iter().skip(1).peekable();
        for received in voyage.received() {
            let Message::Imu(sample) = &received.message else {
                self.timeline.measure(&received);
                continue;
            };
            match self.conditioner.take(sample) {
                Conditioned::Sample(increment) => self.advance(&increment),
                Conditioned::AfterGap(bridge, increment) => {
                    self.advance(&bridge);
                    self.heave.interrupt(bridge.duration());
                    self.advance(&increment);
                }
                Conditioned::Rejected(_) => {}
            }
            if let Some(now) = truth.next_if(|truth| truth.time <= sample.time) {
                assert_eq!(now.time, sample.time);
                record.push(self.instant(now));
            }
        }
        centre(&mut record);
        record
    }

    fn instant(&self, truth: &Truth) -> Instant {
        let down = truth.attitude.unwrap().c_nb().row(2).transpose();
        let height = truth.position.height;
        Instant {
            t: truth.time.as_seconds(),
            truth: vec![height, height - down.dot(&ABEAM.0)],
            heave: (0..2).filter_map(|point| self.heave.heave(point)).collect(),
        }
    }
}

#[test]
fn heave_behind_the_navigator_is_as_good_as_before_it() {
    for (grade, from) in [("navigation", 50), ("tactical", 100), ("mems", 50)] {
        let sea = format!("state = 6\nfrom_deg = {from}");
        let voyage = voyage(grade, &sea, &[(60.0, 1200.0)]);
        let record = Sailing::new(&voyage).sail(&voyage);
        for point in 0..2 {
            let limit = rms(&record, point).max(1.0);
            let real_time = Errors::real_time(&record, point, 500.0, 1200.0);
            let delayed = Errors::delayed(&record, point, 200.0, 1200.0);
            assert!(real_time.rms < 0.05 * limit, "{grade} {point}: {real_time:?}");
            assert!(delayed.rms < 0.02 * limit, "{grade} {point}: {delayed:?}");
            assert!(real_time.covered > 0.9 && delayed.covered > 0.85, "{grade} {delayed:?}");
        }
    }
}

#[test]
fn turns_change_sea_and_heel_and_leave_the_heave_good() {
    let legs = [(60.0, 900.0), (150.0, 400.0), (10.0, 400.0), (240.0, 400.0)];
    for grade in ["navigation", "mems"] {
        let voyage = voyage(grade, "state = 5\nfrom_deg = 50.0", &legs);
        let record = Sailing::new(&voyage).sail(&voyage);
        let errors = Errors::real_time(&record, 0, 400.0, 2100.0);
        assert!(errors.rms < 0.05 && errors.covered > 0.9, "{grade} {errors:?}");
        let delayed = Errors::delayed(&record, 0, 200.0, 2100.0);
        assert!(delayed.rms < 0.02 && delayed.covered > 0.9, "{grade} {delayed:?}");
        let aside = Errors::real_time(&record, 1, 400.0, 2100.0);
        assert!(aside.rms < 0.12 && aside.worst < 0.7, "{grade} {aside:?}");
    }
}
