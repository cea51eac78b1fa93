//! The evidence in words, for people who look into it.

use super::Judge;
use super::charge::{Charge, Kind};

impl Judge {
    /// By how many steps the IMU is taken to be worse, what speaks for one more, and the likeliest faults, for people who look into the
    /// evidence.
    #[must_use]
    pub fn evidence(&self) -> String {
        let of = |charge: &Charge| match charge.kind {
            Kind::Shaped { since, sized, .. } => {
                let (since, size) = (since.as_seconds(), sized.value);
                let [x, y, z] = [size.x, size.y, size.z];
                let explained = sized.explained;
                let (name, weight) = (charge.fault.as_str(), charge.weight);
                format!("{name} {weight:.1} since {since:.0} ({explained:.0}) {x:.3} {y:.3} {z:.3}")
            }
            Kind::Shapeless => format!("{} {:.1}", charge.fault.as_str(), charge.weight),
        };
        let all: Vec<String> = self.assessment.charges.iter().take(5).map(of).collect();
        format!("worse {} ({:.1}); {}", self.docket.worse(), self.pessimist.gain, all.join("; "))
    }
}
