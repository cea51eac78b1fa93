//! GeoJSON (RFC 7946): a feature for each stretch, a line where she was. Heights are over the ellipsoid, as RFC 7946 has them.
//!
//! Where nothing may be relied on the feature has no geometry (`null`, RFC 7946, 3.2: unlocated).

use std::io::Write;

use insd_drivers::recording::NavRow;
use serde_json::{Value, json};

use super::stretch::{Stretch, stretches};
use super::track::{SolutionTrack, degrees, metres};

pub(super) fn write(track: &SolutionTrack<'_>, mut target: impl Write) -> anyhow::Result<()> {
    let name = serde_json::to_string(track.name)?;
    write!(target, "{{\"type\":\"FeatureCollection\",\"name\":{name},\"features\":[")?;
    for (number, stretch) in stretches(track.rows).enumerate() {
        write!(target, "{}", if number == 0 { "\n" } else { ",\n" })?;
        serde_json::to_writer(&mut target, &feature(track, &stretch))?;
    }
    writeln!(target, "\n]}}")?;
    Ok(target.flush()?)
}

fn feature(track: &SolutionTrack<'_>, stretch: &Stretch<'_>) -> Value {
    let each = |value: &dyn Fn(&NavRow) -> Value| stretch.rows.iter().map(value).collect::<Value>();
    let mut properties = json!({
        "mode": stretch.mode.as_str(),
        "usable": stretch.is_told,
        "t_s": each(&|row| json!(row.solution.time.as_seconds())),
    });
    if track.calendar.is_some() {
        // where Leaflet, OpenLayers and others look for times
        properties["coordTimes"] = each(&|row| json!(track.utc(row.solution.time)));
    }
    if !stretch.is_told {
        return json!({ "type": "Feature", "geometry": null, "properties": properties });
    }
    properties["std_n_m"] = each(&|row| json!(metres(row.solution.sigma.position.0.x)));
    properties["std_e_m"] = each(&|row| json!(metres(row.solution.sigma.position.0.y)));
    properties["std_d_m"] = each(&|row| json!(metres(row.solution.sigma.position.0.z)));
    let points = each(&point);
    let geometry = match stretch.rows {
        [_] => json!({ "type": "Point", "coordinates": points[0] }),
        _ => json!({ "type": "LineString", "coordinates": points }),
    };
    json!({ "type": "Feature", "geometry": geometry, "properties": properties })
}

fn point(row: &NavRow) -> Value {
    let place = &row.solution.position;
    let [latitude, longitude] = degrees(place);
    json!([longitude, latitude, metres(place.height)])
}

#[cfg(test)]
mod tests {
    use super::super::stretch::tests::row;
    use super::*;
    use insd_base::Mode;

    #[test]
    fn what_may_not_be_relied_on_has_no_place() {
        let rows = [row(0.0, 10.0, Mode::Fault), row(0.1, 10.0, Mode::Aided)];
        let mut text = Vec::new();
        write(
            &SolutionTrack { name: "a \"b\"", rows: &rows, calendar: None, imu: None },
            &mut text,
        )
        .unwrap();
        let all: Value = serde_json::from_slice(&text).unwrap();
        assert_eq!(all["name"], "a \"b\"");
        let [fault, aided] = [&all["features"][0], &all["features"][1]];
        assert_eq!(
            (&fault["geometry"], &fault["properties"]["mode"]),
            (&Value::Null, &json!("fault"))
        );
        assert!(fault["properties"].get("std_n_m").is_none());
        assert_eq!(aided["geometry"]["coordinates"], json!([10.0, 54.123_456_789_1, 41.5]));
    }
}
