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
    use crate::snapshot::{
        Cause, SatelliteFate, Sensor, SensorState, ShownAid, ShownMotion, ShownSatellite,
        ShownSignal, ShownSky, ShownSource, SkyState,
    };

    #[test]
    fn satellites_are_counted_by_why_they_are_not_used_and_only_while_they_are_told() {
        let signal =
            ShownSignal { code: "1C".to_owned(), cn0_db_hz: Some(44.5), ..Default::default() };
        let low = ShownSatellite {
            name: "G07".to_owned(),
            fate: SatelliteFate::Refused,
            reason: Some("low".to_owned()),
            signals: vec![signal],
            ..ShownSatellite::default()
        };
        let sky = ShownSky {
            state: SkyState::Raw,
            used: Some(9),
            satellites: vec![low.clone(), low],
            refused: vec![Cause { reason: "low".to_owned(), count: 42 }],
            against_base: vec![Cause { reason: "fixed".to_owned(), count: 7 }],
            ..ShownSky::default()
        };
        let mut snapshot = Snapshot { sky, ..Snapshot::default() };
        let told = text(&snapshot);
        let total = "insd_satellites_refused_total{reason=\"low\"} 42";
        for line in [
            "insd_satellites_used 9.0",
            "insd_satellites_unused{reason=\"low\"} 2.0",
            "insd_satellite_cn0_db_hertz{satellite=\"G07\",signal=\"1C\"} 44.5",
            total,
            "insd_rtk_epochs_total{outcome=\"fixed\"} 7",
        ] {
            assert!(told.lines().any(|own| own == line), "{line} is not in\n{told}");
        }
        snapshot.sky.state = SkyState::Silent;
        let told = text(&snapshot);
        assert!(told.contains(total) && !told.contains("satellites_used"), "{told}");
    }

    #[test]
    fn metrics_have_units_in_their_names_and_leave_out_what_is_unknown() {
        let source =
            ShownSource { name: "rtk".to_owned(), since_s: Some(42.0), ..ShownSource::default() };
        let motion = ShownMotion {
            heading_deg: Some(123.5),
            source: Some(source),
            ..ShownMotion::default()
        };
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
            "insd_source{source=\"rtk\"} 1.0",
            "insd_source_seconds 42.0",
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
