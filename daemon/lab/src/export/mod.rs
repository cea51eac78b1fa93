//! A solution in the formats of other programs: GPX, KML, GeoJSON, MCAP, bags of ROS 2.
//!
//! What may not be relied on ([`crate::evaluation::is_told`]) is never told as a position: each format says in its own way that nothing is known then.
//! Positions have the digits of `nav.csv`.

mod cdr;
mod geojson;
mod gpx;
mod imu;
mod kml;
mod mcap;
mod mcap_file;
mod pose;
mod ros2;
mod ros2_schemas;
mod schemas;
mod stretch;
mod track;

use std::path::Path;

use insd_config::OutputFile;

pub use imu::ImuTrack;
pub use track::{NoUtc, SolutionTrack};

/// A format of other programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Format {
    /// GPX 1.1: a track, for plotters and maps.
    Gpx,
    /// KML 2.2: a track and ellipses that hold 95 % of errors, for Google Earth.
    Kml,
    /// GeoJSON (RFC 7946): a line for each mode, for QGIS.
    Geojson,
    /// MCAP with JSON messages of Foxglove: positions with covariance, poses, changes of the mode, on request the IMU.
    Mcap,
    /// A folder with a bag of ROS 2: NavSatFix and Odometry, on request Imu.
    Ros2bag,
}

/// Writes a solution to a file or, a bag of ROS 2, to a folder.
///
/// # Errors
/// The target cannot be written, or the format needs UTC ([`NoUtc`]).
pub fn write(track: &SolutionTrack<'_>, format: Format, out: &Path) -> anyhow::Result<()> {
    let to_file = |write: &dyn Fn(&mut OutputFile) -> anyhow::Result<()>| {
        let mut file = OutputFile::create(out)?;
        write(&mut file)?;
        file.finish()
    };
    match format {
        Format::Gpx => to_file(&|file| Ok(gpx::write(track, file)?)),
        Format::Kml => to_file(&|file| Ok(kml::write(track, file)?)),
        Format::Geojson => to_file(&|file| geojson::write(track, file)),
        Format::Mcap => to_file(&|file| mcap::write(track, file)),
        Format::Ros2bag => ros2::write(track, out),
    }
}
