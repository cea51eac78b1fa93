//! Alert limits, by number or by the name of a requirement.

use std::str::FromStr;

use serde::Serialize;

/// Requirements that have a name: the name, who asks, the alert limit, the accuracy (95 %), both horizontal, m.
/// IMO A.1046(27) and MSC.1/Circ.1575 name an accuracy and no alert limit: it is taken for one.
const NAMED: [(&str, &str, f64, f64); 9] = [
    ("ocean", "IMO A.1046(27), ocean", 100.0, 100.0),
    ("harbour", "IMO A.1046(27), harbour entrances", 10.0, 10.0),
    ("coastal", "IMO A.915(22), coast, approaches and inland waterways", 25.0, 10.0),
    ("port", "IMO A.915(22), port", 2.5, 1.0),
    ("docking", "IMO A.915(22), automatic docking", 0.25, 0.1),
    ("circ1575-a", "MSC.1/Circ.1575, level A", 100.0, 100.0),
    ("circ1575-b", "MSC.1/Circ.1575, level B", 10.0, 10.0),
    ("circ1575-c", "MSC.1/Circ.1575, level C", 1.0, 1.0),
    ("circ1575-d", "MSC.1/Circ.1575, level D", 0.1, 0.1),
];
/// Alert limits that make sense, m.
const RANGE: std::ops::RangeInclusive<f64> = 0.001..=100_000.0;

/// The error at which whoever uses a position wants to be warned.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct AlertLimit {
    /// Alert limit, m.
    pub limit_m: f64,
    /// Who asks for it; null for a bare number.
    pub requirement: Option<&'static str>,
    /// What 95 % of errors are to be within, m; null for a bare number.
    pub accuracy_m: Option<f64>,
}

impl AlertLimit {
    /// The names that are known, with their limits, for people.
    #[must_use]
    pub fn names() -> String {
        let names = NAMED.map(|(name, _, limit, _)| format!("{name} ({limit} m)"));
        names.join(", ")
    }
}

impl FromStr for AlertLimit {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let named = NAMED.iter().find(|(name, ..)| *name == text);
        if let Some((_, requirement, limit_m, accuracy_m)) = named {
            let (requirement, accuracy_m) = (Some(*requirement), Some(*accuracy_m));
            return Ok(AlertLimit { limit_m: *limit_m, requirement, accuracy_m });
        }
        match text.parse::<f64>() {
            Ok(limit_m) if RANGE.contains(&limit_m) => {
                Ok(AlertLimit { limit_m, requirement: None, accuracy_m: None })
            }
            _ => Err(format!("expected a number of metres, or one of {}", AlertLimit::names())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_is_a_number_or_the_name_of_a_requirement() {
        let of = |text: &str| text.parse::<AlertLimit>().map(|own| (own.limit_m, own.accuracy_m));
        assert_eq!(of("12.5"), Ok((12.5, None)));
        assert_eq!(of("harbour"), Ok((10.0, Some(10.0))));
        assert_eq!(of("port"), Ok((2.5, Some(1.0))));
        assert_eq!(of("docking"), Ok((0.25, Some(0.1))));
        for wrong in ["", "0", "-1", "nan", "inf", "harbor"] {
            assert!(of(wrong).unwrap_err().contains("docking (0.25 m)"), "{wrong}");
        }
    }
}
