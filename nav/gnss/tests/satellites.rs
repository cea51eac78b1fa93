//! Positions and clocks of satellites against values that two independent codes agree on.
//!
//! The records are of the sets named with each: `moving-5km` (MIT, Rui Hirokawa, cssrlib-data), `pair-1m` (MIT, Taro Suzuki, MatRTKLIB),
//! `common-clock-1p6m` (MIT, Neil Berkman, sidereon; ESBC, EUREF), `geonet-3km` (BSD-2, T. Takasu, RTKLIB test data).

use insd_base::{BroadcastRecord, GpsTime};
use insd_gnss::SatelliteState;
use nalgebra::Vector3;
use serde::Deserialize;

#[derive(Deserialize)]
struct Published {
    record: BroadcastRecord,
    time: GpsTime,
    position: [f64; 3],
    velocity: [f64; 3],
    clock: f64,
    drift: f64,
}

#[test]
fn every_constellation_stands_where_two_other_codes_have_it() {
    let published: Vec<Published> =
        serde_json::from_str(include_str!("data/satellites.json")).unwrap();
    assert_eq!(
        published.len(),
        12,
        "two of GPS, Galileo, QZSS, GLONASS, and of BeiDou's two kinds of orbit"
    );
    for case in published {
        let state = SatelliteState::at(&case.record, case.time);
        let satellite = case.record.satellite();
        let position = (state.position - Vector3::from(case.position)).norm();
        assert!(position < 1e-4, "{satellite}: {position} m");
        let velocity = (state.velocity - Vector3::from(case.velocity)).norm();
        assert!(velocity < 1e-5, "{satellite}: {velocity} m/s");
        let clock = state.clock - case.clock;
        assert!(clock.abs() < 1e-14, "{satellite}: {clock} s");
        let drift = state.clock_drift - case.drift;
        assert!(drift.abs() < 1e-15, "{satellite}: {drift} s/s");
    }
}
