//! What those who make rules ask of a position.

/// Requirements of one use of a position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Requirement {
    /// Its name in configurations and commands.
    pub name: &'static str,
    /// Who asks, and for what.
    pub authority: &'static str,
    /// Horizontal error of which a user is to be warned, m. A.1046(27) and Circ.1575 name an accuracy only: it is taken for this, too.
    pub alert_limit: f64,
    /// What 95 % of horizontal errors are to be within, m.
    pub accuracy: f64,
    /// Probability of an error beyond the limit without a warning, and within what time, s, where one is named.
    pub risk: Option<(f64, f64)>,
    /// A warning is to come within this, s.
    pub time_to_alert: f64,
}

/// The risk of IMO A.915(22), appendices 2 and 3.
const A915: Option<(f64, f64)> = Some((1e-5, 10_800.0));

const fn requirement(
    name: &'static str,
    authority: &'static str,
    [alert_limit, accuracy]: [f64; 2],
    risk: Option<(f64, f64)>,
) -> Requirement {
    Requirement { name, authority, alert_limit, accuracy, risk, time_to_alert: 10.0 }
}

impl Requirement {
    /// All that have a name.
    pub const ALL: [Requirement; 9] = [
        requirement("ocean", "IMO A.1046(27), ocean", [100.0, 100.0], None),
        requirement("harbour", "IMO A.1046(27), harbour entrances", [10.0, 10.0], None),
        requirement(
            "coastal",
            "IMO A.915(22), coast, approaches and inland waterways",
            [25.0, 10.0],
            A915,
        ),
        requirement("port", "IMO A.915(22), port", [2.5, 1.0], A915),
        requirement("docking", "IMO A.915(22), automatic docking", [0.25, 0.1], A915),
        requirement("circ1575-a", "MSC.1/Circ.1575, level A", [100.0, 100.0], None),
        requirement("circ1575-b", "MSC.1/Circ.1575, level B", [10.0, 10.0], None),
        requirement("circ1575-c", "MSC.1/Circ.1575, level C", [1.0, 1.0], None),
        requirement("circ1575-d", "MSC.1/Circ.1575, level D", [0.1, 0.1], None),
    ];

    /// That of a name.
    #[must_use]
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|own| own.name == name)
    }

    /// The names with their alert limits, for people.
    #[must_use]
    pub fn names() -> String {
        let names = Self::ALL.map(|own| format!("{} ({} m)", own.name, own.alert_limit));
        names.join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_requirement_is_found_by_its_name_and_asks_no_less_of_the_mean_than_of_the_worst() {
        for own in Requirement::ALL {
            assert_eq!(Requirement::by_name(own.name), Some(own));
            assert!(own.accuracy <= own.alert_limit && own.time_to_alert > 0.0, "{own:?}");
        }
        assert_eq!(Requirement::by_name("Harbour"), None);
    }
}
