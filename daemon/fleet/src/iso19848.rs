//! Records as a package of time series of ISO 19848, in JSON as DNV's schema has it (`urn:ISO19848:Ship_Data_Transport`, vista-sdk). Channels have the local
//! identifiers of ISO 19848's naming by DNV's vessel information structure 3-4a: 710.1/F211 are her navigation data, F211.1 her position.
//!
//! A record whose UTC is not known has no time stamp, and so no place in a package. Run and sequences stand in the user properties of the message.

use serde_json::{Value, json};

/// Numbers: where they stand in a record, and the local identifier of their channel; units are those of the record.
const CHANNELS: [(&str, &str); 9] = [
    ("lat_deg", "/dnv-v2/vis-3-4a/710.1/F211.1/meta/qty-latitude"),
    ("lon_deg", "/dnv-v2/vis-3-4a/710.1/F211.1/meta/qty-longitude"),
    ("heading_deg", "/dnv-v2/vis-3-4a/710.1/F211/meta/qty-heading.true"),
    ("speed_kn", "/dnv-v2/vis-3-4a/710.1/F211/meta/qty-speed.over.ground"),
    ("course_deg", "/dnv-v2/vis-3-4a/710.1/F211/meta/qty-course.over.ground"),
    ("rate_of_turn_deg_min", "/dnv-v2/vis-3-4a/710.1/F211/meta/qty-rate.of.turn"),
    ("water_speed_kn", "/dnv-v2/vis-3-4a/710.1/F211/meta/qty-speed.through.water"),
    // the structure has no word for these two
    ("roll_deg", "/dnv-v2/vis-3-4a/710.1/F211/meta/qty~roll"),
    ("pitch_deg", "/dnv-v2/vis-3-4a/710.1/F211/meta/qty~pitch"),
];

/// A record with a time: its stamp, the channels that it knows, and what they say.
struct Row {
    stamp: String,
    channels: Vec<&'static str>,
    values: Vec<String>,
}

/// One package: a table for each stretch of records that know the same channels, and a series of events of the alerts.
pub(crate) fn package(ship: &str, records: &[&str]) -> String {
    let records = records.iter().filter_map(|text| serde_json::from_str::<Value>(text).ok());
    let stamped: Vec<(String, Value)> =
        records.filter_map(|record| Some((stamp(&record)?, record))).collect();
    let mut header = json!({ "ShipID": ship_id(ship), "Author": "insd" });
    if let (Some((first, _)), Some((last, _))) = (stamped.first(), stamped.last()) {
        header["TimeSpan"] = json!({ "Start": first, "End": last });
    }
    let rows: Vec<Row> = stamped.iter().filter_map(row).collect();
    let tables: Vec<Value> = rows.chunk_by(|a, b| a.channels == b.channels).map(table).collect();
    let events: Vec<Value> = stamped.iter().filter_map(event).collect();
    let mut series = json!({});
    if !tables.is_empty() {
        series["TabularData"] = json!(tables);
    }
    if !events.is_empty() {
        series["EventData"] = json!({ "NumberOfDataSet": events.len(), "DataSet": events });
    }
    json!({ "Package": { "Header": header, "TimeSeriesData": [series] } }).to_string()
}

fn stamp(record: &Value) -> Option<String> {
    record.pointer("/time/utc")?.as_str().map(str::to_owned)
}

/// A number of the IMO as the standard writes it; any other name as it is.
fn ship_id(ship: &str) -> String {
    match ship.get(..3).zip(ship.get(3..)) {
        Some((imo, number))
            if imo.eq_ignore_ascii_case("imo")
                && number.len() == 7
                && number.bytes().all(|byte| byte.is_ascii_digit()) =>
        {
            format!("IMO{number}")
        }
        _ => ship.to_owned(),
    }
}

fn row((stamp, record): &(String, Value)) -> Option<Row> {
    let motion = record.get("motion")?;
    let known = |(name, channel): (&str, &'static str)| {
        Some((channel, motion.get(name).filter(|own| own.is_number())?.to_string()))
    };
    let (channels, values) = CHANNELS.into_iter().filter_map(known).unzip();
    let row = Row { stamp: stamp.clone(), channels, values };
    (!row.channels.is_empty()).then_some(row)
}

fn table(rows: &[Row]) -> Value {
    let channels = rows.first().map(|row| row.channels.as_slice()).unwrap_or_default();
    let sets = rows.iter().map(|row| json!({ "TimeStamp": row.stamp, "Value": row.values }));
    json!({
        "NumberOfDataSet": rows.len(),
        "NumberOfDataChannel": channels.len(),
        "DataChannelID": channels,
        "DataSet": sets.collect::<Vec<Value>>(),
    })
}

/// A change of an alert: its channel is a short identifier of ours, its value how it stands.
fn event((stamp, record): &(String, Value)) -> Option<Value> {
    let alert = record.get("alert")?;
    let (id, state) = (alert.get("id")?.as_u64()?, alert.get("state")?.as_str()?);
    Some(json!({ "TimeStamp": stamp, "DataChannelID": format!("insd.alert.{id}"), "Value": state }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(records: &[&str]) -> Value {
        serde_json::from_str(&package("imo9074729", records)).unwrap()
    }

    const FULL: &str = r#"{"seq":3,"time":{"utc":"2026-11-28T12:00:00.000Z"},"motion":{"lat_deg":53.5123457,"lon_deg":8.1,"heading_deg":180.0,"integrity":"available"}}"#;
    const BARE: &str = r#"{"seq":4,"time":{"utc":"2026-11-28T12:00:10.000Z"},"motion":{"lat_deg":53.6,"lon_deg":8.2}}"#;

    #[test]
    fn records_that_know_the_same_are_rows_of_one_table() {
        let package = &read(&[FULL, FULL, BARE])["Package"];
        assert_eq!(package["Header"]["ShipID"], "IMO9074729");
        assert_eq!(package["Header"]["TimeSpan"]["End"], "2026-11-28T12:00:10.000Z");
        let tables = package["TimeSeriesData"][0]["TabularData"].as_array().unwrap();
        let sizes: Vec<_> = tables
            .iter()
            .map(|own| (&own["NumberOfDataSet"], &own["NumberOfDataChannel"]))
            .collect();
        assert_eq!(sizes, [(&json!(2), &json!(3)), (&json!(1), &json!(2))]);
        let first = &tables[0];
        assert_eq!(first["DataChannelID"][2], CHANNELS[2].1);
        assert_eq!(first["DataSet"][1]["Value"], json!(["53.5123457", "8.1", "180.0"]));
    }

    #[test]
    fn what_has_no_time_has_no_place_and_what_is_unknown_no_channel() {
        let timeless = FULL.replace("\"2026-11-28T12:00:00.000Z\"", "null");
        let package = &read(&[&timeless])["Package"];
        assert_eq!(package["TimeSeriesData"], json!([{}]));
        assert!(package["Header"].get("TimeSpan").is_none());
    }

    #[test]
    fn a_change_of_an_alert_is_an_event() {
        let record = r#"{"seq":4,"time":{"utc":"2026-11-28T12:00:00.000Z"},"alert":{"id":10001,"state":"rectified"}}"#;
        let series = &read(&[record])["Package"]["TimeSeriesData"][0];
        assert_eq!(series["EventData"]["NumberOfDataSet"], 1);
        let event = &series["EventData"]["DataSet"][0];
        assert_eq!(
            (&event["DataChannelID"], &event["Value"]),
            (&json!("insd.alert.10001"), &json!("rectified"))
        );
    }

    #[test]
    fn only_a_number_of_the_imo_is_written_as_one() {
        assert_eq!(ship_id("imo9074729"), "IMO9074729");
        for other in ["imo907", "ada", "urn:mrn:imo:mmsi:211000000", "imoé4729x"] {
            assert_eq!(ship_id(other), other);
        }
    }
}
