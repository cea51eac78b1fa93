//! `nav.csv`: the answer of a replay.

use std::f64::consts::TAU;
use std::io::{self, Write};
use std::path::Path;

use insd_base::{Availability, SatelliteId, SatelliteInnovation, Solution, SolutionSource};

use super::error::RecordingError;
use super::nav_row::NavRow;
use super::nav_telling::{MAX_SIGMA, NavTelling};
use super::number::{Zeros, push_fixed, push_time};
use super::reader::{Rows, read_all};
use super::rows::NAV;

const DEGREE_PLACES: usize = 10;
const METRE_PLACES: usize = 5;
const ANGLE_PLACES: usize = 6;

/// Writes `nav.csv`: fixed decimal places (latitude and longitude 10, heights and velocities 5,
/// angles 6, standard deviations 5 in m and 6 in m/s and deg), the same bytes for the same
/// solutions. A standard deviation is always a positive finite number.
#[derive(Debug)]
pub struct NavWriter<W: Write> {
    target: W,
    line: Vec<u8>,
    telling: NavTelling,
}

impl<W: Write> NavWriter<W> {
    /// Writes the header line. The target should be buffered.
    ///
    /// # Errors
    /// The target cannot be written.
    pub fn new(mut target: W) -> io::Result<Self> {
        writeln!(target, "{}", NAV.join(","))?;
        Ok(NavWriter { target, line: Vec::with_capacity(256), telling: NavTelling::default() })
    }

    /// Writes one row. A solution that is not finite is left out and counted.
    ///
    /// # Errors
    /// The target cannot be written.
    pub fn write(&mut self, solution: &Solution) -> io::Result<()> {
        let Some(row) = self.telling.row(solution) else { return Ok(()) };
        self.line.clear();
        push_state(&mut self.line, solution);
        push_sigmas(&mut self.line, solution);
        self.line.push(b',');
        self.line.extend_from_slice(solution.mode.as_str().as_bytes());
        push_judgement(&mut self.line, &row);
        self.line.push(b'\n');
        self.target.write_all(&self.line)
    }

    /// A satellite is left out of the solutions from now on, or used again: the rows name it.
    pub fn leave_out(&mut self, satellite: SatelliteId, is_excluded: bool) {
        self.telling.leave_out(satellite, is_excluded);
    }

    /// Takes note of what a satellite told: the rows say of how many the ranges are in use.
    pub fn hear_satellite(&mut self, told: &SatelliteInnovation) {
        self.telling.hear_satellite(told);
    }

    /// Solutions that were left out because they were not finite.
    #[must_use]
    pub fn left_out(&self) -> u64 {
        self.telling.left_out()
    }

    /// Flushes and gives the target back.
    ///
    /// # Errors
    /// The target cannot be written.
    pub fn finish(mut self) -> io::Result<W> {
        self.target.flush()?;
        Ok(self.target)
    }
}

/// Reads a `nav.csv`, plain or compressed, with what it says of how far it may be relied on and with the count of its
/// faulty rows. The angular rate and what was made of the sensors' words, which it does not hold, are those of nobody
/// knowing.
///
/// # Errors
/// The file is missing, its header is wrong, it has no or too many faulty rows, or a row says of its integrity what
/// the format does not know.
pub fn read_nav_rows(path: &Path) -> Result<Rows<NavRow>, RecordingError> {
    read_all(path)
}

/// Reads the solutions of a `nav.csv`, plain or compressed.
///
/// # Errors
/// As [`read_nav_rows`].
pub fn read_nav(path: &Path) -> Result<Vec<Solution>, RecordingError> {
    read_nav_rows(path).map(|all| all.rows.into_iter().map(|row| row.solution).collect())
}

fn push_state(row: &mut Vec<u8>, solution: &Solution) {
    let (position, attitude) = (&solution.position, &solution.attitude);
    push_time(row, solution.time);
    push(row, position.latitude.to_degrees(), DEGREE_PLACES);
    push(row, position.longitude.to_degrees(), DEGREE_PLACES);
    push(row, position.height, METRE_PLACES);
    for velocity in &solution.velocity.0 {
        push(row, *velocity, METRE_PLACES);
    }
    push(row, attitude.roll.to_degrees(), ANGLE_PLACES);
    push(row, attitude.pitch.to_degrees(), ANGLE_PLACES);
    let heading = attitude.heading.rem_euclid(TAU).to_degrees();
    // 359.9999996 would be written as 360
    push(row, if heading >= 360.0 - 0.5e-6 { 0.0 } else { heading }, ANGLE_PLACES);
}

/// Protection levels, whether they may be relied on, who is left out, and of how many satellites the ranges are in use.
fn push_judgement(line: &mut Vec<u8>, row: &NavRow) {
    push_sigma(line, row.horizontal_level.unwrap_or(f64::INFINITY), METRE_PLACES);
    push_sigma(line, row.vertical_level.unwrap_or(f64::INFINITY), METRE_PLACES);
    line.push(b',');
    line.extend_from_slice(row.integrity.map_or("", Availability::as_str).as_bytes());
    line.push(b',');
    line.extend_from_slice(row.excluded.join(" ").as_bytes());
    line.push(b',');
    if let Some(used) = row.satellites {
        line.extend_from_slice(used.to_string().as_bytes());
    }
    line.push(b',');
    line.extend_from_slice(row.solution.source.map_or("", SolutionSource::as_str).as_bytes());
}

fn push_sigmas(row: &mut Vec<u8>, solution: &Solution) {
    let sigma = &solution.sigma;
    for position in &sigma.position.0 {
        push_sigma(row, *position, METRE_PLACES);
    }
    for velocity in &sigma.velocity.0 {
        push_sigma(row, *velocity, ANGLE_PLACES);
    }
    for angle in [sigma.roll, sigma.pitch, sigma.heading] {
        push_sigma(row, angle.to_degrees(), ANGLE_PLACES);
    }
}

fn push(row: &mut Vec<u8>, value: f64, places: usize) {
    row.push(b',');
    push_fixed(row, value, places, Zeros::Kept);
}

/// A NaN or infinite claim is one of knowing nothing; none is smaller than the last place.
fn push_sigma(row: &mut Vec<u8>, sigma: f64, places: usize) {
    let known = if sigma.is_finite() { sigma } else { MAX_SIGMA };
    push(row, known.clamp(10_f64.powi(-(places as i32)), MAX_SIGMA), places);
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::{
        Attitude, Availability, Body, Geodetic, Integrity, Judgement, Mode, Ned, Parties, Party,
        SolutionSigma, Time,
    };

    fn solution() -> Solution {
        Solution {
            time: Time::from_seconds(12.3),
            position: Geodetic::from_degrees(-35.123_456_789_01, 179.999_999_999_99, -3.25),
            velocity: Ned::new(1.0, -2.5, 0.000_01),
            attitude: Attitude { roll: -0.01, pitch: 0.02, heading: -1e-12 },
            rate: Body::default(),
            sigma: SolutionSigma {
                position: Ned::new(f64::NAN, 0.0, f64::INFINITY),
                velocity: Ned::new(0.01, 0.01, 0.02),
                roll: 1e-5,
                pitch: 1e-5,
                heading: -0.0,
            },
            mode: Mode::DeadReckoning,
            judgement: insd_base::Judgement::default(),
            source: Some(SolutionSource::DeadReckoning),
            hidden: insd_base::Protection::default(),
        }
    }

    fn text(solutions: &[Solution]) -> String {
        let mut writer = NavWriter::new(Vec::new()).unwrap();
        for solution in solutions {
            writer.write(solution).unwrap();
        }
        String::from_utf8(writer.finish().unwrap()).unwrap()
    }

    #[test]
    fn a_row_is_written_exactly_as_the_format_says() {
        let text = text(&[solution()]);
        let mut lines = text.lines();
        assert_eq!(
            lines.next().unwrap(),
            "t_s,lat_deg,lon_deg,height_m,vn_mps,ve_mps,vd_mps,roll_deg,pitch_deg,heading_deg,\
             std_n_m,std_e_m,std_d_m,std_vn_mps,std_ve_mps,std_vd_mps,std_roll_deg,std_pitch_deg,\
             std_heading_deg,mode,hpl_m,vpl_m,integrity,excluded,satellites,source"
        );
        assert_eq!(
            lines.next().unwrap(),
            "12.3,-35.1234567890,180.0000000000,-3.25000,1.00000,-2.50000,0.00001,-0.572958,\
             1.145916,0.000000,1000000.00000,0.00001,1000000.00000,0.010000,0.010000,0.020000,\
             0.000573,0.000573,0.000001,dead_reckoning,1000000.00000,1000000.00000,unavailable,,,dr"
        );
    }

    #[test]
    fn whoever_is_left_out_is_named_and_a_contradiction_is_a_fault() {
        let excluded: Parties = [Party::Gnss, Party::Log].into_iter().collect();
        let row = |integrity| {
            let judgement = Judgement { integrity, excluded };
            let mut sigma = solution().sigma;
            sigma.position = Ned::new(1.0, 1.0, 1.0);
            let text = text(&[Solution { judgement, sigma, ..solution() }]);
            text.lines().nth(1).unwrap().split(',').skip(20).collect::<Vec<_>>().join(",")
        };
        assert_eq!(row(Integrity::Consistent), "7.77817,5.20000,available,gnss log,,dr");
        assert!(row(Integrity::Unproven).ends_with(",unavailable,gnss log,,dr"));
        assert!(row(Integrity::Contradiction).ends_with(",fault,gnss log,,dr"));
    }

    #[test]
    fn a_solution_that_is_not_finite_is_left_out_and_counted() {
        let mut writer = NavWriter::new(Vec::new()).unwrap();
        let bad = Solution { velocity: Ned::new(f64::NAN, 0.0, 0.0), ..solution() };
        writer.write(&bad).unwrap();
        assert_eq!(writer.left_out(), 1);
        assert_eq!(writer.finish().unwrap().iter().filter(|b| **b == b'\n').count(), 1);
    }

    #[test]
    fn what_is_written_reads_back() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("nav.csv");
        std::fs::write(&path, text(&[solution()])).unwrap();
        let back = read_nav(&path).unwrap()[0];
        let expected = solution();
        assert_eq!((back.time, back.mode), (expected.time, expected.mode));
        assert!((back.position.latitude - expected.position.latitude).abs() < 1e-12);
        assert!((back.attitude.roll - expected.attitude.roll).abs() < 1e-8);
    }

    /// A solution that its sensors do not bear out, as a file.
    fn doubted() -> String {
        let excluded: Parties = [Party::Gnss, Party::Imu].into_iter().collect();
        let judgement = Judgement { integrity: Integrity::Contradiction, excluded };
        text(&[Solution { judgement, ..solution() }, solution()])
    }

    const FURTHER: [&str; 6] = ["hpl_m", "vpl_m", "integrity", "excluded", "satellites", "source"];

    fn read(text: &str) -> Result<Rows<NavRow>, RecordingError> {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("nav.csv");
        std::fs::write(&path, text).unwrap();
        read_nav_rows(&path)
    }

    #[test]
    fn what_a_row_says_of_its_integrity_reads_back() {
        let all = read(&doubted()).unwrap();
        assert!(FURTHER.iter().all(|column| all.has(column)));
        let row = &all.rows[0];
        assert_eq!((row.horizontal_level, row.vertical_level), (Some(1e6), Some(1e6)));
        assert_eq!(row.integrity, Some(Availability::Fault));
        assert_eq!(row.excluded, ["gnss", "imu"]);
        assert!(all.rows[1].excluded.is_empty());
        assert_eq!(row.satellites, None);
    }

    #[test]
    fn columns_that_are_not_there_and_empty_fields_are_unknown() {
        let cut = |keep: usize| {
            let line = |line: &str| line.split(',').take(keep).collect::<Vec<_>>().join(",");
            doubted().lines().map(line).collect::<Vec<_>>().join("\n")
        };
        let old = read(&cut(20)).unwrap();
        assert!(!FURTHER.iter().any(|column| old.has(column)));
        let row = &old.rows[0];
        assert_eq!((row.horizontal_level, row.vertical_level, row.integrity), (None, None, None));
        let empty = doubted().replace("1000000.00000,1000000.00000,fault,gnss imu,", ",,,,");
        let row = &read(&empty).unwrap().rows[0];
        assert_eq!((row.horizontal_level, row.vertical_level, row.integrity), (None, None, None));
    }

    #[test]
    fn an_integrity_that_cannot_be_read_is_an_error_with_its_place() {
        for (good, bad, said) in [
            (",fault,", ",maybe,", ":2:integrity: unknown word \"maybe\""),
            ("gnss imu", "gnss;imu", ":2:excluded: unknown word \"gnss;imu\""),
            ("1000000.00000,1000000.00000,fault", "-1,2,fault", ":2:hpl_m: -1 is out of range"),
            ("gnss imu,", "gnss imu,-1", ":2:satellites: -1 is out of range"),
            ("gnss imu,", "gnss imu,2.5", ":2:satellites: expected a number, found \"2.5\""),
            ("1000000.00000,fault", "x,fault", ":2:vpl_m: expected a number, found \"x\""),
        ] {
            let fault = read(&doubted().replacen(good, bad, 1)).unwrap_err().to_string();
            assert!(fault.ends_with(&format!("nav.csv{said}")), "{fault}");
        }
    }
}
