//! GPX 1.1: one track, a segment for each stretch. Heights (`ele`) are over mean sea level, with that of the geoid beside them, so that
//! their sum is the height over the ellipsoid.
//!
//! GPX has no word for a place that is unknown: there is no point then, and the segment ends. It has none for a sigma either: claims
//! and mode stand in `extensions`.

use std::io::{self, Write};

use insd_drivers::recording::NavRow;

use super::stretch::stretches;
use super::track::{SolutionTrack, degrees, escaped, metres, over_sea};

const HEAD: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<gpx version="1.1" creator="insd" xmlns="http://www.topografix.com/GPX/1/1" xmlns:insd="urn:insd:gpx:1">
"#;

pub(super) fn write(track: &SolutionTrack<'_>, mut target: impl Write) -> io::Result<()> {
    writeln!(target, "{HEAD}<trk><name>{}</name>", escaped(track.name))?;
    for stretch in stretches(track.rows).filter(|stretch| stretch.is_told) {
        writeln!(target, "<trkseg>")?;
        stretch.rows.iter().try_for_each(|row| point(track, row, &mut target))?;
        writeln!(target, "</trkseg>")?;
    }
    writeln!(target, "</trk>\n</gpx>")?;
    target.flush()
}

fn point(track: &SolutionTrack<'_>, row: &NavRow, target: &mut impl Write) -> io::Result<()> {
    let (place, sigma) = (&row.solution.position, &row.solution.sigma.position.0);
    let ([latitude, longitude], [elevation, sea]) = (degrees(place), over_sea(place));
    write!(
        target,
        "<trkpt lat=\"{latitude:.10}\" lon=\"{longitude:.10}\"><ele>{elevation:.5}</ele>"
    )?;
    if let Some(utc) = track.utc(row.solution.time) {
        write!(target, "<time>{utc}</time>")?;
    }
    write!(target, "<geoidheight>{sea:.5}</geoidheight><extensions>")?;
    for (name, value) in ["std_n_m", "std_e_m", "std_d_m"].iter().zip(sigma) {
        write!(target, "<insd:{name}>{}</insd:{name}>", metres(*value))?;
    }
    let mode = row.solution.mode.as_str();
    writeln!(target, "<insd:mode>{mode}</insd:mode></extensions></trkpt>")
}

#[cfg(test)]
mod tests {
    use super::super::stretch::tests::row;
    use super::*;
    use insd_base::Mode;
    use insd_config::VoyageCalendar;

    #[test]
    fn a_point_has_its_place_to_the_last_digit_its_time_and_its_claim() {
        let rows = [row(0.0, 10.0, Mode::Fault), row(0.1, -10.0, Mode::DeadReckoning)];
        let mut text = Vec::new();
        let calendar = VoyageCalendar::new("2026-05-01T08:00:00Z");
        write(&SolutionTrack { name: "a<b", rows: &rows, calendar, imu: None }, &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        assert!(text.contains("<name>a&lt;b</name>"), "{text}");
        assert_eq!(text.matches("<trkpt").count(), 1);
        assert!(text.contains("lat=\"54.1234567891\" lon=\"-10.0000000000\""), "{text}");
        assert!(text.contains("<time>2026-05-01T08:00:00.1Z</time>"), "{text}");
        assert!(text.contains("<insd:std_e_m>0.25</insd:std_e_m>"), "{text}");
    }
}
