//! How many there may be at once of what has several instances among the error states.

/// Satellites that are used at once, the highest ones.
pub const SATELLITES: usize = 24;
/// Lines of antennas that are told apart at once: three beside the first, of three constellations on two bands.
pub const LINES: usize = 18;
/// What an epoch of antennas tells: attitude and lines.
pub const ANTENNA_ROWS: usize = 3 + LINES;
/// Lines and points ashore that docking aids measure to at once.
pub const RANGING_MARKS: usize = 4;
/// Poses at times of images that are held at once.
pub const CAMERA_POSES: usize = 10;
/// States of one of them: position and attitude.
pub const POSE_STATES: usize = 6;
/// Points of the world that a camera sees, and that are held at once.
pub const LANDMARKS: usize = 16;
/// Poses that steps of a visual odometry are measured from, and that are held at once.
pub const ODOMETRY_POSES: usize = 3;
