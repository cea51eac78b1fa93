//! Solutions beside truth: the error of each component at common times.

use insd_base::{Ned, Solution, Time, Truth};

use super::component::Component;
use super::series::{Lookup, Series, State};

/// Errors (solution minus truth) and claimed 1-sigmas at one instant, SI and radians, in the order
/// of [`Component::ALL`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EpochError {
    /// Instant.
    pub time: Time,
    /// Error; `None` where truth does not know the component.
    pub error: [Option<f64>; 9],
    /// Claimed standard deviation.
    pub sigma: [f64; 9],
}

/// Epochs that could not be compared, by reason.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, serde::Serialize)]
pub struct EpochsLeftOut {
    /// Before the first or after the last row of the other file.
    pub outside: u64,
    /// In a gap of the other file, too long to interpolate.
    pub in_gap: u64,
}

/// Errors at all common times.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct VoyageErrors {
    /// In order of time.
    pub epochs: Vec<EpochError>,
    /// What could not be compared.
    pub left_out: EpochsLeftOut,
}

impl EpochError {
    /// Error of one component.
    #[must_use]
    pub fn of(&self, component: Component) -> Option<f64> {
        self.error[component.index()]
    }

    /// Claimed 1-sigma of one component.
    #[must_use]
    pub fn sigma_of(&self, component: Component) -> f64 {
        self.sigma[component.index()]
    }

    /// Horizontal position error, m.
    #[must_use]
    pub fn horizontal(&self) -> Option<f64> {
        Some(self.of(Component::North)?.hypot(self.of(Component::East)?))
    }

    /// Claimed 1-sigma of the horizontal position as a radius, m: the root of the summed variances.
    #[must_use]
    pub fn horizontal_sigma(&self) -> f64 {
        self.sigma_of(Component::North).hypot(self.sigma_of(Component::East))
    }

    /// Squared horizontal error in units of its claimed sigmas, for two degrees of freedom:
    /// (e_N / s_N)^2 + (e_E / s_E)^2. The claims of `nav.csv` hold no correlation.
    #[must_use]
    pub fn horizontal_distance_sq(&self) -> Option<f64> {
        let ratio = |c| normalised(self.of(c)?, self.sigma_of(c));
        Some(ratio(Component::North)?.powi(2) + ratio(Component::East)?.powi(2))
    }
}

/// Error over sigma; `None` when the claim is no positive number.
#[must_use]
pub fn normalised(error: f64, sigma: f64) -> Option<f64> {
    (sigma.is_finite() && sigma > 0.0).then(|| error / sigma)
}

/// Compares solutions with truth from an instant on, at the times of the solutions or, if its rows
/// are further apart, of truth. The other is interpolated linearly: positions in ECEF axes, so that
/// neither the antimeridian nor the poles matter, angles along the short arc. Position errors are
/// the ECEF difference in the NED axes of the true position. Neither list need be sorted.
#[must_use]
pub fn errors(nav: &[Solution], truth: &[Truth], from: Option<Time>) -> VoyageErrors {
    let from = from.unwrap_or(Time::from_nanos(i64::MIN));
    let nav = Series::new(nav.iter().map(State::from_solution).collect());
    let truth = Series::new(truth.iter().map(State::from_truth).collect());
    let is_at_truth = truth.is_sparser_than(&nav);
    let (base, other) = if is_at_truth { (&truth, &nav) } else { (&nav, &truth) };
    let mut found = VoyageErrors::default();
    for state in base.states().iter().filter(|state| state.time >= from) {
        match other.at(state.time) {
            Lookup::Found(beside) if !is_at_truth => {
                found.epochs.push(difference(state, &beside));
            }
            Lookup::Found(beside) => found.epochs.push(difference(&beside, state)),
            Lookup::Outside => found.left_out.outside += 1,
            Lookup::InGap => found.left_out.in_gap += 1,
        }
    }
    found
}

fn difference(nav: &State, truth: &State) -> EpochError {
    let position = truth.c_ne() * (nav.position.0 - truth.position.0);
    let velocity = nav.velocity.zip(truth.velocity).map(|(Ned(nav), Ned(truth))| nav - truth);
    let angles = nav.attitude.zip(truth.attitude).map(|(nav, truth)| {
        [
            insd_base::units::wrap_pi(nav.roll - truth.roll),
            nav.pitch - truth.pitch,
            insd_base::units::wrap_pi(nav.heading - truth.heading),
        ]
    });
    let mut error = [None; 9];
    for axis in 0..3 {
        error[axis] = Some(position[axis]);
        error[3 + axis] = velocity.map(|v| v[axis]);
        error[6 + axis] = angles.map(|a| a[axis]);
    }
    EpochError { time: nav.time, error, sigma: nav.sigma }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{solution, truth};
    use super::*;
    use approx::assert_relative_eq;
    use insd_base::Geodetic;

    #[test]
    fn a_metre_is_a_metre_at_the_antimeridian_and_beside_the_pole() {
        for (lat, lon) in [(0.0, 180.0), (89.999_9, 10.0), (-60.0, -180.0)] {
            let point = Geodetic::from_degrees(lat, lon, 0.0);
            let (meridian, normal) = insd_base::earth::radii(point.latitude);
            let mut east = point;
            east.longitude += 1.0 / (normal * point.latitude.cos());
            east.longitude = insd_base::units::wrap_pi(east.longitude);
            east.latitude += 2.0 / meridian;
            let found = errors(&[solution(0.0, east)], &[truth(0.0, point)], None);
            let epoch = found.epochs[0];
            // 11 m from the pole, a metre of arc and a metre of chord differ by 5 cm
            assert_relative_eq!(epoch.of(Component::East).unwrap(), 1.0, epsilon = 0.2);
            assert_relative_eq!(epoch.of(Component::North).unwrap(), 2.0, epsilon = 0.2);
        }
    }

    #[test]
    fn truth_is_interpolated_across_the_antimeridian_and_north() {
        let point = |lon| Geodetic::from_degrees(10.0, lon, 0.0);
        let mut before = truth(0.0, point(179.999_99));
        let mut after = truth(1.0, point(-179.999_99));
        let mut middle = solution(0.5, point(180.0));
        before.attitude.as_mut().unwrap().heading = 359_f64.to_radians();
        after.attitude.as_mut().unwrap().heading = 3_f64.to_radians();
        middle.attitude.heading = 1_f64.to_radians();
        let found = errors(&[middle], &[before, after], None);
        assert!(found.epochs[0].horizontal().unwrap() < 1e-3);
        assert_relative_eq!(found.epochs[0].of(Component::Heading).unwrap(), 0.0, epsilon = 1e-12);
    }

    #[test]
    fn what_cannot_be_compared_is_counted() {
        let point = Geodetic::from_degrees(10.0, 10.0, 0.0);
        let nav: Vec<_> = (0..40).map(|t| solution(f64::from(t) + 0.5, point)).collect();
        let mut reference: Vec<_> =
            (0..100).map(|t| truth(f64::from(t) * 0.2 + 5.0, point)).collect();
        reference.retain(|row| !(10.0..15.0).contains(&row.time.as_seconds()));
        reference[3].velocity = None;
        let found = errors(&nav, &reference, None);
        assert_eq!(found.left_out, EpochsLeftOut { outside: 20, in_gap: 5 });
        assert_eq!(found.epochs.len(), 15);
        assert!(found.epochs[0].of(Component::VelocityEast).is_none());
        let late = errors(&nav, &reference, Some(Time::from_seconds(20.0)));
        assert_eq!(late.epochs.len(), 5);
    }
}
