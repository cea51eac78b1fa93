//! KML 2.2: a line for each stretch, and every minute an ellipse that holds 95 % of errors. Heights are over mean sea level, as KML has them.
//!
//! KML has no word for a place that is unknown: there is no line then.

use std::f64::consts::TAU;
use std::io::{self, Write};

use insd_base::{Mode, Ned, Time};
use insd_drivers::recording::NavRow;

use super::pose::moved;
use super::stretch::{Stretch, stretches};
use super::track::{SolutionTrack, degrees, escaped, over_sea};

const HEAD: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<kml xmlns="http://www.opengis.net/kml/2.2">
<Document>
"#;
/// Interval between two ellipses, s.
const INTERVAL: f64 = 60.0;
/// Half axes of an ellipse in sigmas: the root of the 95 % quantile of chi-square with two degrees of freedom.
const SIGMAS: f64 = 2.447_746_830_680_816;
/// Corners of an ellipse.
const CORNERS: u32 = 36;

pub(super) fn write(track: &SolutionTrack<'_>, mut target: impl Write) -> io::Result<()> {
    writeln!(target, "{HEAD}<name>{}</name>", escaped(track.name))?;
    for (mode, colour) in COLOURS {
        let line = format!("<LineStyle><color>ff{colour}</color><width>2</width></LineStyle>");
        let inside = format!("<PolyStyle><color>40{colour}</color></PolyStyle>");
        writeln!(target, "<Style id=\"{}\">{line}{inside}</Style>", mode.as_str())?;
    }
    let mut drawn = None;
    for stretch in stretches(track.rows).filter(|stretch| stretch.is_told) {
        line(track, &stretch, &mut target)?;
        for row in stretch.rows {
            if is_due(drawn, row.solution.time) {
                drawn = Some(row.solution.time);
                ellipse(track, row, &mut target)?;
            }
        }
    }
    writeln!(target, "</Document>\n</kml>")?;
    target.flush()
}

/// Colours of the modes that are drawn: blue, green, red.
const COLOURS: [(Mode, &str); 5] = [
    (Mode::FineAlignment, "b0b0b0"),
    (Mode::InMotionAlignment, "b0b0b0"),
    (Mode::Aided, "50b000"),
    (Mode::DeadReckoning, "00a0f0"),
    (Mode::Inertial, "3040e0"),
];

fn is_due(drawn: Option<Time>, now: Time) -> bool {
    drawn.is_none_or(|last| (now - last).as_seconds() >= INTERVAL)
}

fn line(
    track: &SolutionTrack<'_>,
    stretch: &Stretch<'_>,
    target: &mut impl Write,
) -> io::Result<()> {
    let mode = stretch.mode.as_str();
    write!(target, "<Placemark><name>{mode}</name>")?;
    if let [first, .., last] = stretch.rows {
        let ends = [first, last].map(|row| track.utc(row.solution.time));
        if let [Some(begin), Some(end)] = ends {
            write!(target, "<TimeSpan><begin>{begin}</begin><end>{end}</end></TimeSpan>")?;
        }
    }
    write!(target, "<styleUrl>#{mode}</styleUrl>")?;
    let kind = if stretch.rows.len() == 1 { "Point" } else { "LineString" };
    write!(target, "<{kind}><coordinates>")?;
    for row in stretch.rows {
        let place = &row.solution.position;
        let [latitude, longitude] = degrees(place);
        let [height, _] = over_sea(place);
        write!(target, "{longitude:.10},{latitude:.10},{height:.5} ")?;
    }
    writeln!(target, "</coordinates></{kind}></Placemark>")
}

/// North and east errors are told as independent, so the axes of the ellipse are north and east.
fn ellipse(track: &SolutionTrack<'_>, row: &NavRow, target: &mut impl Write) -> io::Result<()> {
    let mode = row.solution.mode.as_str();
    write!(target, "<Placemark><name>95 %</name>")?;
    if let Some(utc) = track.utc(row.solution.time) {
        write!(target, "<TimeStamp><when>{utc}</when></TimeStamp>")?;
    }
    write!(
        target,
        "<styleUrl>#{mode}</styleUrl><Polygon><outerBoundaryIs><LinearRing><coordinates>"
    )?;
    let (place, sigma) = (&row.solution.position, &row.solution.sigma.position.0);
    for corner in 0..=CORNERS {
        // the last one is the first again
        let (east, north) = (f64::from(corner % CORNERS) / f64::from(CORNERS) * TAU).sin_cos();
        let by = Ned::new(SIGMAS * sigma.x * north, SIGMAS * sigma.y * east, 0.0);
        let [latitude, longitude] = degrees(&moved(place, &by));
        write!(target, "{longitude:.10},{latitude:.10} ")?;
    }
    writeln!(target, "</coordinates></LinearRing></outerBoundaryIs></Polygon></Placemark>")
}

#[cfg(test)]
mod tests {
    use super::super::stretch::tests::row;
    use super::*;

    #[test]
    fn a_minute_has_one_ellipse_and_what_may_not_be_relied_on_no_line() {
        let mode = |second: u32| if second < 5 { Mode::Fault } else { Mode::Aided };
        let rows: Vec<NavRow> =
            (0..70).map(|second| row(f64::from(second), 10.0, mode(second))).collect();
        let mut text = Vec::new();
        write(&SolutionTrack { name: "x", rows: &rows, calendar: None, imu: None }, &mut text)
            .unwrap();
        let text = String::from_utf8(text).unwrap();
        assert_eq!(text.matches("<Polygon>").count(), 2);
        assert_eq!(text.matches("<LineString>").count(), 1);
        assert!(text.contains("<coordinates>10.0000000000,54.1234567891,"), "{text}");
    }
}
