//! Where the ship is, how she moves and lies, and what was found out about her sensors.

use serde::{Deserialize, Serialize};

use super::freshness::Freshness;

/// Where the ship is, how she moves and lies, at the IMU or the point named, and how sure that is. All
/// sigmas are 1-sigma.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownMotion {
    /// Time of validity, on the ship's time line, s.
    pub valid_at_s: f64,
    /// Whether that may be taken as the present: `fresh`, or `old` for a moment before it is gone.
    pub freshness: Freshness,
    /// The same in UTC, if it is known.
    pub valid_utc: Option<String>,
    /// The point that it is told of; `None` for the IMU.
    pub point: Option<String>,
    /// Latitude, WGS-84, deg, north positive.
    pub lat_deg: Option<f64>,
    /// Longitude, WGS-84, deg, east positive.
    pub lon_deg: Option<f64>,
    /// Height above the ellipsoid, m.
    pub height_m: Option<f64>,
    /// Velocity over the Earth, north, m/s.
    pub velocity_north_mps: Option<f64>,
    /// East, m/s.
    pub velocity_east_mps: Option<f64>,
    /// Down, m/s.
    pub velocity_down_mps: Option<f64>,
    /// Speed over ground, kn.
    pub speed_kn: Option<f64>,
    /// Course over ground, from true north, deg, 0 to 360; `None` where it is not certain enough.
    pub course_deg: Option<f64>,
    /// Speed through the water ahead, kn, if a log tells it.
    pub water_speed_kn: Option<f64>,
    /// Speed of the current, kn, if a log tells it.
    pub current_speed_kn: Option<f64>,
    /// Where the current sets to, from true north, deg.
    pub current_set_deg: Option<f64>,
    /// Roll, deg, starboard side down positive.
    pub roll_deg: Option<f64>,
    /// Pitch, deg, bow up positive.
    pub pitch_deg: Option<f64>,
    /// True heading, deg, 0 to 360.
    pub heading_deg: Option<f64>,
    /// Rate of turn, deg/min, bow to starboard positive.
    pub rate_of_turn_deg_min: Option<f64>,
    /// Heave; `None` if it is not asked for.
    pub heave: Option<ShownHeave>,
    /// 1-sigma of the position to the north, m.
    pub sigma_north_m: Option<f64>,
    /// To the east, m.
    pub sigma_east_m: Option<f64>,
    /// Of the height, m.
    pub sigma_height_m: Option<f64>,
    /// Half the longer axis of the 1-sigma error ellipse of the position, m.
    pub ellipse_major_m: Option<f64>,
    /// Half the shorter axis, m.
    pub ellipse_minor_m: Option<f64>,
    /// Direction of the longer axis, from true north, deg, 0 to 180.
    pub ellipse_direction_deg: Option<f64>,
    /// 1-sigma of the velocity to the north, m/s.
    pub sigma_velocity_north_mps: Option<f64>,
    /// To the east, m/s.
    pub sigma_velocity_east_mps: Option<f64>,
    /// Down, m/s.
    pub sigma_velocity_down_mps: Option<f64>,
    /// 1-sigma of the speed, kn.
    pub sigma_speed_kn: Option<f64>,
    /// 1-sigma of the course, deg.
    pub sigma_course_deg: Option<f64>,
    /// 1-sigma of the roll, deg.
    pub sigma_roll_deg: Option<f64>,
    /// 1-sigma of the pitch, deg.
    pub sigma_pitch_deg: Option<f64>,
    /// 1-sigma of the heading, deg.
    pub sigma_heading_deg: Option<f64>,
    /// How THS would judge the heading: `autonomous`, `estimated`, `not_valid`, `simulated`.
    pub heading_quality: Option<String>,
    /// How GGA would judge the position: `rtk_fixed`, `rtk_float`, `differential`, `autonomous`,
    /// `estimated`, `invalid`, `simulated`.
    pub position_quality: Option<String>,
    /// How VTG would judge course and speed: `autonomous`, `differential`, ..., `not_valid`.
    pub velocity_quality: Option<String>,
    /// Whether roll and pitch are good enough to be sent: `valid`, `not_valid`.
    pub level_quality: Option<String>,
    /// Whether the position may be relied on, as in `nav.csv`: `available`, `unavailable`, `fault`; `None` while
    /// nobody compares the sensors.
    pub integrity: Option<String>,
    /// Who is left out: `gnss` (the first receiver), `gnss2`, `gnss3`, `log`, `heading`, `reference`, `imu`, `antennas`, `docking`.
    pub excluded: Vec<String>,
    /// The best source that the position lives by; `None` before the ship navigates.
    pub source: Option<ShownSource>,
    /// Protection level of the horizontal position, m.
    pub hpl_m: Option<f64>,
    /// Of the height, m.
    pub vpl_m: Option<f64>,
}

/// What the position lives by: the best source that was used in the last seconds.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownSource {
    /// Its word, as in `nav.csv`: `rtk`, `float`, `carrier`, `code`, `doppler`, `dr`.
    pub name: String,
    /// It in words.
    pub text: String,
    /// How long it has been that one, s; `None` while that was not told.
    pub since_s: Option<f64>,
    /// When it became that one, UTC, if that is known.
    pub changed_utc: Option<String>,
    /// Why it became that one: a better one has come, or what is wrong with a better one.
    pub reason: Option<String>,
}

/// Heave: its mean over many waves is zero.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownHeave {
    /// Time of validity of the heave in real time, on the ship's time line, s.
    pub valid_at_s: f64,
    /// In real time, m, up positive.
    pub heave_m: Option<f64>,
    /// 1-sigma, m.
    pub sigma_heave_m: Option<f64>,
    /// `unsettled`, `reduced`, `settled`.
    pub quality: String,
    /// The delayed heave, m, up positive.
    pub delayed_heave_m: Option<f64>,
    /// 1-sigma, m.
    pub sigma_delayed_heave_m: Option<f64>,
    /// How long ago the delayed heave was, s.
    pub delay_s: Option<f64>,
}

/// What the filter has found out about the sensors.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownEstimates {
    /// Biases of the gyros about the body axes forward, starboard, down, deg/h.
    pub gyro_bias_deg_h: Vec<ShownEstimate>,
    /// Biases of the accelerometers along the same axes, micro-g.
    pub accel_bias_ug: Vec<ShownEstimate>,
    /// Scale factor of the log, ppm.
    pub log_scale_ppm: Option<ShownEstimate>,
    /// Misalignment of the log, deg, bow to starboard positive.
    pub log_misalignment_deg: Option<ShownEstimate>,
    /// Lever arm of the GNSS antenna, if it is estimated: forward, starboard, down, m.
    pub gnss_lever_m: Vec<ShownEstimate>,
    /// Delay of the GNSS, s.
    pub gnss_delay_s: Option<ShownEstimate>,
    /// Course less heading on the mean while she went straight on, deg: leeway and current, and what the IMU is
    /// turned by.
    pub course_less_heading_deg: Option<ShownEstimate>,
}

/// A value and how sure it is.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownEstimate {
    /// The value, in the unit of the field that holds it.
    pub value: Option<f64>,
    /// 1-sigma, in the same unit.
    pub sigma: Option<f64>,
}

/// How somebody of the sensors stands.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownStands {
    /// Who: `gnss` (the first receiver), `gnss2`, `gnss3` (others, once heard), `log`, `heading`, `reference`, `imu`, `antennas`, `docking` (once heard).
    pub name: String,
    /// How far it is believed: `trusted`, `doubtful`, `excluded`, `probation`.
    pub standing: String,
    /// Since when, s on the ship's time line.
    pub since_s: Option<f64>,
    /// What it was found to do, or is suspected of: `jump`, `drag`, ...
    pub fault: Option<String>,
    /// That in words; nothing of who was never doubted.
    pub text: Option<String>,
    /// What the mate may do about it.
    pub advice: Option<String>,
}

/// Something of the installation that is found to be otherwise than configured.
#[derive(Clone, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Found {
    /// Its short name: `gnss_lever`, `mounting_tilted`, ...
    pub name: String,
    /// What seems to be so.
    pub text: String,
    /// What to write into the configuration, if that follows from it.
    pub paste: Option<String>,
    /// Whether the configuration is wrong, and not merely incomplete.
    pub fault: bool,
}
