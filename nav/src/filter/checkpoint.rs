//! A filter as it is kept for the next start of the program, and taken up again.

use insd_base::{Span, Time};
use insd_estimation::Place;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::Filter;
use super::heard::Heard;
use super::receiver::Receiver;
use super::state::State;
use crate::config::NavConfig;
use crate::declaration::Carried;
use crate::error_state::{BERTH_OFFSET, Covariance, SWAY, SWAY_VELOCITY};
use crate::error_state::{carried, declaration};
use crate::initial::InitialState;
use crate::judge::Docket;
use crate::nominal::Nominal;
use crate::sea_window::LevelWindow;
use crate::sway::Sway;
use crate::trust::Trust;

/// Estimate, covariance and memory of a filter that navigates. What a moment brings back is left out: the
/// acceleration of the antenna, the pace of the receiver.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FilterCheckpoint {
    time: Time,
    nominal: Nominal,
    covariance: Covariance,
    rate: Vector3<f64>,
    lateness: f64,
    trust: Trust,
    rtk: Option<bool>,
    slow_noise: [f64; 3],
    level: LevelWindow,
    sway: Option<Sway>,
    last_relative: Option<Time>,
    last_motion: Option<Time>,
    last_water: Option<Time>,
    turned: Vector3<f64>,
    unswayed: f64,
    docket: Docket,
}

impl FilterCheckpoint {
    /// Instant of the estimate.
    #[must_use]
    pub fn time(&self) -> Time {
        self.time
    }

    /// Whether the receiver was found in fault at that instant: then it is no witness.
    #[must_use]
    pub fn is_receiver_suspect(&self) -> bool {
        self.trust.is_suspect(self.time)
    }

    /// Whether its states are those of this program: all that are always carried, as they begin, and whole blocks of others.
    fn has_states(&self) -> bool {
        let layout = self.covariance.layout();
        let mut always = carried(Carried::Always).zip(layout.places());
        let is_own = |place: &Place| {
            declaration(place.key).is_some_and(|declared| declared.width == place.width)
        };
        let has_sway = [SWAY.key(), SWAY_VELOCITY.key(), BERTH_OFFSET.key()];
        always.all(|(declared, place)| declared.key == place.key)
            && carried(Carried::Always).count() <= layout.places().len()
            && layout.places().iter().all(is_own)
            && (self.sway.is_none() || has_sway.iter().all(|key| layout.start(*key).is_some()))
    }
}

impl Filter {
    /// What is worth keeping of a filter that navigates.
    #[must_use]
    pub fn kept(&self) -> FilterCheckpoint {
        if !self.is_settled() {
            let mut settled = self.clone();
            settled.settle();
            return settled.kept();
        }
        FilterCheckpoint {
            time: self.state.time,
            nominal: self.state.nominal,
            covariance: self.state.covariance.clone(),
            rate: self.state.rate,
            lateness: self.receiver.lateness,
            trust: self.receiver.trust,
            rtk: self.receiver.rtk,
            slow_noise: {
                let [position, velocity] = self.receiver.slow_noise;
                [position, velocity, self.compass_noise]
            },
            level: self.state.level,
            sway: self.state.sway,
            last_relative: self.heard.relative,
            last_motion: self.heard.motion,
            last_water: self.heard.water,
            turned: self.state.turned,
            unswayed: self.state.unswayed,
            docket: self.docket(),
        }
    }

    /// A filter that goes on from what was kept, on a time line that is later by a span. `None` if it
    /// cannot be a filter's.
    #[must_use]
    pub fn taken_up(config: &NavConfig, kept: &FilterCheckpoint, by: Span) -> Option<Filter> {
        if !kept.has_states() {
            return None;
        }
        let initial =
            InitialState::new(kept.time + by, kept.nominal, kept.covariance.clone(), kept.rate);
        let later = |time: Option<Time>| time.map(|time| time + by);
        let config = config.with_docket(kept.docket.shifted(by));
        let [position, velocity, heading] = kept.slow_noise;
        let mut filter = Filter::new(&config, &initial);
        filter.receiver = Receiver {
            lateness: kept.lateness,
            trust: kept.trust.shifted(by),
            rtk: kept.rtk,
            slow_noise: [position, velocity],
            ..filter.receiver
        };
        filter.compass_noise = heading;
        filter.state = State {
            level: kept.level,
            sway: kept.sway,
            turned: kept.turned,
            unswayed: kept.unswayed,
            ..filter.state
        };
        filter.heard = Heard {
            relative: later(kept.last_relative),
            motion: later(kept.last_motion),
            water: later(kept.last_water),
            ..Heard::default()
        };
        // which mark had which states is not kept: they begin anew
        filter.end_to_carry(Carried::WithRanging);
        filter.forget_camera();
        filter.begin_navigation();
        let is_noise = |noise: &f64| noise.is_finite() && *noise > 0.0;
        let is_finite = kept.rate.iter().all(|x| x.is_finite())
            && kept.lateness.is_finite()
            && kept.slow_noise.iter().all(is_noise);
        (kept.nominal.is_sound() && is_finite).then_some(filter)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::error_state::{ATTITUDE, POSITION, VELOCITY};
    use crate::increments::Increment;
    use crate::initial::sensor_covariance;
    use crate::timeline::Estimator;
    use insd_base::{Geodetic, ImuSpec, LeverArms, Triad};
    use nalgebra::Matrix3;

    /// A filter that has navigated for half a second.
    pub(in crate::filter) fn filter() -> (NavConfig, Filter) {
        let triad = Triad {
            bias_std: 1e-7,
            instability_std: 1e-8,
            instability_time: 100.0,
            random_walk: 1e-6,
            scale_std: 1e-5,
        };
        let config = NavConfig::new(
            ImuSpec { rate: 100.0, gyro: triad, accel: triad },
            LeverArms::default(),
        );
        let place = Geodetic::from_degrees(35.0, 139.0, 20.0);
        let nominal = Nominal::at(&place, &Vector3::new(5.0, 1.0, 0.0), &Matrix3::identity());
        let mut covariance = sensor_covariance(&config);
        for (block, std) in [(POSITION, 3.0), (VELOCITY, 0.1), (ATTITUDE, 1e-3)] {
            block.renew(&mut covariance, &Matrix3::from_diagonal_element(std * std));
        }
        let time = Time::from_seconds(500.0);
        let mut filter =
            Filter::new(&config, &InitialState::new(time, nominal, covariance, Vector3::zeros()));
        filter.begin_navigation();
        for step in 0..55 {
            filter.advance(&still(500.0 + 0.01 * f64::from(step)));
        }
        (config, filter)
    }

    fn still(from: f64) -> Increment {
        Increment {
            from: Time::from_seconds(from),
            to: Time::from_seconds(from + 0.01),
            rotation: Vector3::new(1e-4, 0.0, 2e-4),
            velocity: Vector3::new(0.0, 0.0, -0.098),
            end_rate: Vector3::zeros(),
            end_rate_variance: 0.0,
            angular_acceleration: Vector3::zeros(),
            rate_noise: Vector3::zeros(),
            force_noise: Vector3::zeros(),
            bridged: None,
            celsius: None,
        }
    }

    #[test]
    fn a_filter_that_is_taken_up_goes_on_as_if_nothing_had_been() {
        let (config, mut filter) = filter();
        let kept = filter.kept();
        filter.settle();
        let by = Span::from_seconds(-600.0);
        let mut again = Filter::taken_up(&config, &kept, by).unwrap();
        assert_eq!(again.time() + Span::from_seconds(600.0), filter.time());
        for step in 0..300 {
            filter.advance(&still(500.55 + 0.01 * f64::from(step)));
            again.advance(&still(-99.45 + 0.01 * f64::from(step)));
        }
        filter.settle();
        again.settle();
        assert_eq!(again.nominal(), filter.nominal());
        assert_eq!(again.covariance(), filter.covariance());
    }

    #[test]
    fn states_of_another_program_are_refused() {
        let (config, filter) = filter();
        let kept = filter.kept();
        let spoilt = |change: &dyn Fn(&mut FilterCheckpoint)| {
            let mut spoilt = kept.clone();
            change(&mut spoilt);
            Filter::taken_up(&config, &spoilt, Span::ZERO).is_none()
        };
        assert!(spoilt(&|kept| kept.covariance.leave(VELOCITY.key())));
        assert!(spoilt(&|kept| kept.covariance = Covariance::none()));
        assert!(spoilt(&|kept| kept.covariance.join_diagonal(SWAY.key(), 3, 1.0)));
        assert!(spoilt(&|kept| kept.nominal.velocity.x = f64::INFINITY));
        assert!(!spoilt(&|kept| kept.covariance.join_diagonal(SWAY.key(), 4, 1.0)));
        assert!(!spoilt(&|_| {}));
    }
}
