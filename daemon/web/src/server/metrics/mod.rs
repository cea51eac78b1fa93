//! A snapshot as metrics of Prometheus, in the OpenMetrics text format. Units are in the names; what is
//! unknown is left out.

mod plumbing;
mod sheet;
mod ship;

use crate::snapshot::Snapshot;

use sheet::Sheet;

/// The metrics of a snapshot, without the mark of the end.
pub(super) fn text(snapshot: &Snapshot) -> String {
    let mut sheet = Sheet::default();
    ship::write(&mut sheet, snapshot);
    plumbing::write(&mut sheet, snapshot);
    sheet.text()
}

/// The metrics of the page itself, with the mark of the end.
pub(super) fn of_the_page(is_alive: bool, clients: usize) -> String {
    let mut sheet = Sheet::default();
    let alive = f64::from(u8::from(is_alive));
    sheet.value(
        "publishing",
        "Whether the engine has published something within the last 2 s",
        alive,
    );
    sheet.value("web_clients", "Connections to the status page", clients as f64);
    sheet.text() + "# EOF\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::snapshot::{Cause, Sensor, SensorState, ShownAid, ShownMotion};

    #[test]
    fn metrics_have_units_in_their_names_and_leave_out_what_is_unknown() {
        let motion = ShownMotion { heading_deg: Some(123.5), ..ShownMotion::default() };
        let reasons = vec![Cause { reason: "chi_square".to_owned(), count: 3 }];
        let aid = ShownAid {
            name: "gnss_position".to_owned(),
            accepted: 40,
            reasons,
            ..ShownAid::default()
        };
        let sensor =
            Sensor { name: "a \"b\"".to_owned(), state: SensorState::Valid, ..Sensor::default() };
        let snapshot = Snapshot {
            motion: Some(motion),
            aids: vec![aid],
            sensors: vec![sensor],
            ..Snapshot::default()
        };
        let text = text(&snapshot) + &of_the_page(true, 2);
        for line in [
            "insd_heading_degrees 123.5",
            "insd_aid_accepted_total{aid=\"gnss_position\"} 40",
            "insd_aid_rejected_total{aid=\"gnss_position\",reason=\"chi_square\"} 3",
            "insd_sensor_state{sensor=\"a \\\"b\\\"\",state=\"valid\"} 1.0",
            "insd_web_clients 2.0",
        ] {
            assert!(text.lines().any(|own| own == line), "{line} is not in\n{text}");
        }
        assert!(!text.contains("insd_roll_degrees "), "{text}");
        assert!(text.ends_with("# EOF\n") && text.matches("# EOF").count() == 1);
    }
}
