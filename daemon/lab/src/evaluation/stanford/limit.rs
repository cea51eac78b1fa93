//! Alert limits, by number or by the name of a requirement.

use std::str::FromStr;

use insd_base::Requirement;
use serde::Serialize;

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

impl FromStr for AlertLimit {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if let Some(own) = Requirement::by_name(text) {
            let (requirement, accuracy_m) = (Some(own.authority), Some(own.accuracy));
            return Ok(AlertLimit { limit_m: own.alert_limit, requirement, accuracy_m });
        }
        match text.parse::<f64>() {
            Ok(limit_m) if RANGE.contains(&limit_m) => {
                Ok(AlertLimit { limit_m, requirement: None, accuracy_m: None })
            }
            _ => Err(format!("expected a number of metres, or one of {}", Requirement::names())),
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
