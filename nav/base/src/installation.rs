//! What of the installation is found to be otherwise than configured.

use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt;

use crate::estimates::Estimate;
use crate::frames::Body;
use crate::party::Party;
use crate::satellites::CompassFault;

/// Axes of an IMU.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Axes {
    /// Gyros about forward, starboard, down.
    pub gyro: [bool; 3],
    /// Accelerometers along the same.
    pub accel: [bool; 3],
}

impl Axes {
    /// Whether it is any.
    #[must_use]
    pub fn any(&self) -> bool {
        self.gyro.iter().chain(&self.accel).any(|one| *one)
    }
}

impl fmt::Display for Axes {
    /// `gyro down, accelerometer forward`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const ALONG: [&str; 3] = ["forward", "starboard", "down"];
        let of = |kind: &'static str, axes: &[bool; 3]| {
            let own = ALONG.into_iter().zip(*axes).filter(|(_, is)| *is);
            own.map(|(along, _)| format!("{kind} {along}")).collect::<Vec<_>>()
        };
        let mut all = of("gyro", &self.gyro);
        all.extend(of("accelerometer", &self.accel));
        f.write_str(&all.join(", "))
    }
}

/// What tells the same number again and again while the ship moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frozen {
    /// The position of the receiver.
    Position,
    /// Its velocity.
    Velocity,
    /// The log.
    Log,
    /// The compass.
    Heading,
}

/// One thing that is not as configured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Finding {
    /// The GNSS antenna sits elsewhere.
    GnssLever {
        /// Where it was said to be, from the IMU, body axes, m.
        configured: Body,
        /// Where it is found to be.
        found: Body,
        /// 1-sigma of that, each component, m.
        sigma: Body,
    },
    /// Where the GNSS antenna sits was not said.
    GnssLeverUnmeasured {
        /// Where it is found to be, from the IMU, body axes, m.
        found: Body,
        /// 1-sigma of that, each component, m.
        sigma: Body,
    },
    /// The log sits elsewhere.
    LogLever {
        /// Where it was said to be, from the IMU, body axes, m.
        configured: Body,
        /// Where it is found to be.
        found: Body,
        /// 1-sigma of that, each component, m.
        sigma: Body,
    },
    /// The epochs of GNSS come later than their time tags say.
    GnssDelay {
        /// By how much, s; less than nothing if they come earlier.
        found: f64,
        /// 1-sigma, s.
        sigma: f64,
    },
    /// The accelerometers do not tell gravity.
    ImuForce {
        /// Mean of the specific force, m/s^2.
        mean: f64,
    },
    /// The gyros tell a rate that no ship has, or that gravity does not follow.
    ImuRate {
        /// Root mean square of the rate, rad/s.
        mean: f64,
    },
    /// A sensor tells the same number again and again while the ship moves.
    Frozen {
        /// Which.
        what: Frozen,
    },
    /// Axes of the IMU stand still.
    ImuStuck {
        /// Which.
        axes: Axes,
    },
    /// Axes of the IMU reach the end of their range.
    ImuSaturated {
        /// Which.
        axes: Axes,
    },
    /// The gyros do not turn as she does.
    ImuTurns {
        /// What they tell of a turn over what her course says.
        ratio: Estimate,
    },
    /// Gravity swings in its axes against what its gyros say.
    ImuAxes {
        /// How far they agree where they do least: 1 of one that is right, -1 of one of which an axis is mirrored.
        agreement: f64,
    },
    /// She climbs as she points and never slides, and is not configured as what goes on wheels.
    OnWheels,
    /// A receiver saw her climb as no sea does, and she is not configured as what goes on wheels.
    NotAtSea,
    /// Every heading that was found with the IMU was refuted by GNSS.
    ImuRefuted,
    /// The IMU is worse than its data sheet.
    ImuWorse {
        /// In-run biases and scale factors are taken to be so many times as large.
        times: f64,
    },
    /// The IMU is not the way up that it is said to be: the ship seems to lean for ever.
    MountingTilted {
        /// List to starboard that it says, rad.
        roll: f64,
        /// Trim by the stern that it says, rad.
        pitch: f64,
    },
    /// The IMU's bow is not where the ship goes to.
    MountingTurned {
        /// Course less heading on the mean, rad.
        turn: f64,
    },
    /// The log does not say what the solution says of the same water.
    LogMounting {
        /// What it says over what it should.
        scale: Estimate,
        /// Direction of its velocity less that of the solution's, clockwise from above, rad.
        turn: f64,
    },
    /// Several antennas that are a compass are not as configured, or one of them is broken.
    Antennas {
        /// What is wrong.
        fault: CompassFault,
    },
}

impl Finding {
    /// A short name for tables and programs: `gnss_lever`, ...
    #[must_use]
    pub fn as_str(&self) -> &'static str {
        match self {
            Finding::GnssLever { .. } => "gnss_lever",
            Finding::GnssLeverUnmeasured { .. } => "gnss_lever_unmeasured",
            Finding::LogLever { .. } => "log_lever",
            Finding::GnssDelay { .. } => "gnss_delay",
            Finding::ImuForce { .. } => "imu_force",
            Finding::ImuRate { .. } => "imu_rate",
            Finding::ImuStuck { .. } => "imu_stuck",
            Finding::ImuSaturated { .. } => "imu_saturated",
            Finding::Frozen { what: Frozen::Position } => "gnss_position_frozen",
            Finding::Frozen { what: Frozen::Velocity } => "gnss_velocity_frozen",
            Finding::Frozen { what: Frozen::Log } => "log_frozen",
            Finding::Frozen { what: Frozen::Heading } => "heading_frozen",
            Finding::ImuTurns { .. } => "imu_turns",
            Finding::ImuAxes { .. } => "imu_axes",
            Finding::OnWheels => "on_wheels",
            Finding::NotAtSea => "not_at_sea",
            Finding::ImuRefuted => "imu_refuted",
            Finding::ImuWorse { .. } => "imu_worse",
            Finding::MountingTilted { .. } => "mounting_tilted",
            Finding::MountingTurned { .. } => "mounting_turned",
            Finding::LogMounting { .. } => "log_mounting",
            Finding::Antennas { fault: CompassFault::Broken { .. } } => "antenna_broken",
            Finding::Antennas { fault: CompassFault::OwnClock { .. } } => "antenna_clock",
            Finding::Antennas { fault: CompassFault::Swapped { .. } } => "antennas_swapped",
            Finding::Antennas { fault: CompassFault::Incoherent { .. } } => "antenna_incoherent",
        }
    }

    /// Whether the configuration is wrong, and not merely incomplete.
    #[must_use]
    pub fn is_fault(&self) -> bool {
        !matches!(self, Finding::GnssLeverUnmeasured { .. } | Finding::OnWheels | Finding::NotAtSea)
    }

    /// Whether a sensor tells nonsense, which no configuration mends.
    #[must_use]
    pub fn is_bad_data(&self) -> bool {
        matches!(
            self,
            Finding::Frozen { .. } | Finding::ImuStuck { .. } | Finding::ImuSaturated { .. }
        )
    }

    /// Whether nothing can be made of an IMU of which that is so.
    #[must_use]
    pub fn doubts_imu(&self) -> bool {
        matches!(
            self,
            Finding::ImuForce { .. }
                | Finding::ImuRate { .. }
                | Finding::ImuStuck { .. }
                | Finding::ImuSaturated { .. }
                | Finding::ImuTurns { .. }
                | Finding::ImuAxes { .. }
                | Finding::ImuRefuted
                | Finding::MountingTilted { .. }
                | Finding::MountingTurned { .. }
        )
    }

    /// Who is not used where that is so, wholly or in part.
    #[must_use]
    pub fn excludes(&self) -> Option<Party> {
        match self {
            Finding::LogMounting { .. } | Finding::Frozen { what: Frozen::Log } => Some(Party::Log),
            Finding::Frozen { what: Frozen::Heading } => Some(Party::Heading),
            Finding::Frozen { .. } => Some(Party::Gnss),
            finding if finding.doubts_imu() => Some(Party::Imu),
            _ => None,
        }
    }

    /// What to write into the configuration, a line of TOML, where that follows from what was found.
    #[must_use]
    pub fn to_paste(&self) -> Option<String> {
        match self {
            Finding::GnssLever { found, .. } | Finding::GnssLeverUnmeasured { found, .. } => {
                Some(lever_line("gnss", found))
            }
            Finding::LogLever { found, .. } => Some(lever_line("log", found)),
            Finding::OnWheels => Some("kind = \"car\"".to_owned()),
            Finding::GnssDelay { found, .. } => Some(format!("delay_s = {found:.2}")),
            _ => None,
        }
    }
}

fn lever_line(of: &str, lever: &Body) -> String {
    let [forward, starboard, down] = rounded(lever);
    format!("{of}_lever_m = [{forward:.1}, {starboard:.1}, {down:.1}]")
}

fn elsewhere(
    f: &mut fmt::Formatter<'_>,
    of: &str,
    [configured, found, sigma]: [&Body; 3],
) -> fmt::Result {
    let (apart, line, good) = (apart(configured, found), lever_line(of, found), sigma.0.max());
    write!(f, " seems {apart} than configured: {line}, good to {good:.1} m")
}

/// Which way up an IMU is that says so much of roll and pitch, rad.
fn lying(roll: f64, pitch: f64) -> &'static str {
    let down = [-pitch.sin(), roll.sin() * pitch.cos(), roll.cos() * pitch.cos()];
    const WORDS: [[&str; 2]; 3] = [
        ["with its forward axis pointing down", "with its forward axis pointing up"],
        ["on its starboard side", "on its port side"],
        ["tilted", "upside down"],
    ];
    let greatest = |best: usize, i: usize| if down[i].abs() > down[best].abs() { i } else { best };
    let axis = (0..3).fold(2, greatest);
    WORDS[axis][usize::from(down[axis] < 0.0)]
}

/// What may have gone wrong with accelerometers of such a mean, m/s^2.
fn force_cause(mean: f64) -> &'static str {
    let near = |to: f64| (mean / to - 1.0).abs() < 0.05;
    match () {
        () if near(1.0) => "they seem to tell g where m/s2 are expected",
        () if near(9.81 * 9.81) => "they seem to tell m/s2 where g is expected",
        () if near(9.81 / 1000.0) || near(9810.0) => "a factor of a thousand, check the unit",
        () if mean < 1.0 => "are they increments of velocity, or is gravity taken out?",
        () => "check the unit, the rate and whether these are rates or increments",
    }
}

/// What may have gone wrong with a log that says so many times too much in such a direction, rad.
fn log_cause(scale: f64, turn: f64) -> &'static str {
    const KNOT: f64 = 1.0 / 0.514_444;
    let near = |value: f64, to: f64| (value / to - 1.0).abs() < 0.06;
    let quarter = (turn.abs() / FRAC_PI_2).round();
    if (turn.abs() - quarter * FRAC_PI_2).abs() > 0.26 {
        return "check its mounting";
    }
    match quarter as u8 {
        1 => "its axes seem to be mounted a quarter turn off",
        2 => "it seems to be mounted the wrong way round, or its sign is reversed",
        _ if near(scale, KNOT) => "it seems to tell knots where metres a second are expected",
        _ if near(scale, 1.0 / KNOT) => "it seems to tell metres a second where knots are expected",
        _ if near(scale, 3.6) => "it seems to tell kilometres an hour",
        _ => "check its calibration",
    }
}

/// To a decimetre, without a negative zero.
fn rounded(lever: &Body) -> [f64; 3] {
    let components: [f64; 3] = lever.0.into();
    components.map(|m| (m * 10.0).round() / 10.0 + 0.0)
}

/// The components of a difference that matter, in words: `28.0 m higher, 12.0 m further aft`.
fn apart(configured: &Body, found: &Body) -> String {
    /// What a difference must be to be worth a word, m.
    const WORTH: f64 = 0.5;
    const WORDS: [[&str; 2]; 3] = [
        ["further forward", "further aft"],
        ["further to starboard", "further to port"],
        ["lower", "higher"],
    ];
    let difference = found.0 - configured.0;
    let mut parts: Vec<(f64, String)> = WORDS
        .iter()
        .zip(difference.iter())
        .filter(|(_, by)| by.abs() >= WORTH)
        .map(|(words, by)| {
            (by.abs(), format!("{:.1} m {}", by.abs(), words[usize::from(*by < 0.0)]))
        })
        .collect();
    parts.sort_by(|a, b| b.0.total_cmp(&a.0));
    let words: Vec<String> = parts.into_iter().map(|(_, words)| words).collect();
    words.join(", ")
}

impl fmt::Display for Finding {
    /// What a surveyor would say.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Finding::GnssLever { configured, found, sigma } => {
                f.write_str("the GNSS antenna")?;
                elsewhere(f, "gnss", [configured, found, sigma])
            }
            Finding::LogLever { configured, found, sigma } => {
                f.write_str("the log")?;
                elsewhere(f, "log", [configured, found, sigma])
            }
            Finding::GnssLeverUnmeasured { found, sigma } => write!(
                f,
                "the GNSS antenna, whose place is not configured, seems to be at {}, good to {:.1} m",
                lever_line("gnss", found),
                sigma.0.max()
            ),
            Finding::GnssDelay { found, sigma } => {
                let (by, word) = (found.abs(), if *found < 0.0 { "before" } else { "after" });
                write!(
                    f,
                    "GNSS epochs seem to be tagged {by:.2} s {word} their time, good to {sigma:.2} s"
                )
            }
            Finding::LogMounting { scale, turn } => write!(
                f,
                "the log says {:.2} times her speed, {:.0} deg off: {}",
                scale.value,
                turn.to_degrees(),
                log_cause(scale.value, *turn)
            ),
            Finding::Frozen { what } => write!(
                f,
                "{} tells the same number again and again while she moves, and is not used",
                match what {
                    Frozen::Position => "the position of GNSS",
                    Frozen::Velocity => "the velocity of GNSS",
                    Frozen::Log => "the log",
                    Frozen::Heading => "the compass",
                }
            ),
            _ => self.fmt_of_imu(f),
        }
    }
}

impl Finding {
    /// What of the IMU there is to be said.
    fn fmt_of_imu(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Finding::ImuForce { mean } => write!(
                f,
                "the accelerometers say {mean:.2} m/s2 where gravity is 9.81: {}",
                force_cause(*mean)
            ),
            Finding::ImuRate { mean } => write!(
                f,
                "the gyros say {:.1} deg/s on the mean, which no ship does or gravity does not follow: do they \
                 tell degrees where radians are expected?",
                mean.to_degrees()
            ),
            Finding::ImuStuck { axes } => {
                write!(f, "the IMU tells the same number again and again: {axes}")
            }
            Finding::ImuSaturated { axes } => write!(
                f,
                "the IMU reaches the end of its range again and again: {axes}: she moves faster than it can tell"
            ),
            Finding::ImuTurns { ratio } => write!(
                f,
                "the gyros say {:.1} times the turns that her course makes: is the axis that points down \
                 mirrored, swapped, or in another unit?",
                ratio.value
            ),
            Finding::ImuAxes { agreement } => write!(
                f,
                "gravity swings in the axes of the IMU against what its gyros say, agreement {agreement:.1} where 1 is \
                 right: is an axis mirrored, or are two swapped?"
            ),
            Finding::OnWheels => f.write_str(
                "she climbs as she points and never slides, as nothing does but what goes on wheels, and is held to them",
            ),
            Finding::NotAtSea => f.write_str(
                "her height changes as that of no sea does: the mean sea level holds it no more",
            ),
            Finding::Antennas { fault } => write!(f, "{fault}"),
            Finding::ImuRefuted => f.write_str(
                "GNSS refutes every heading that is found with the IMU: are its axes, signs and units as \
                 configured, or is the receiver wrong?",
            ),
            Finding::ImuWorse { times } => write!(
                f,
                "the IMU drifts by more than its data sheet says: its in-run biases and scale factors are taken to \
                 be {times:.0} times as large"
            ),
            _ => self.fmt_of_mounting(f),
        }
    }

    /// What of its mounting there is to be said.
    fn fmt_of_mounting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Finding::MountingTilted { roll, pitch } => write!(
                f,
                "the IMU seems to be mounted {}: it says roll {:.0} deg, pitch {:.0} deg",
                lying(*roll, *pitch),
                roll.to_degrees(),
                pitch.to_degrees()
            ),
            Finding::MountingTurned { turn } => write!(
                f,
                "the IMU seems to be turned by {:.0} deg about the vertical, or she goes {}: course less \
                 heading",
                turn.to_degrees(),
                if turn.abs() > 0.75 * PI { "astern" } else { "sideways" }
            ),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mast_of_the_wrong_sign_is_told_as_a_surveyor_would() {
        let finding = Finding::GnssLever {
            configured: Body::new(-6.0, -0.8, 14.0),
            found: Body::new(-6.04, -0.03, -13.98),
            sigma: Body::new(0.1, 0.1, 0.2),
        };
        assert_eq!(
            finding.to_string(),
            "the GNSS antenna seems 28.0 m higher, 0.8 m further to starboard than configured: \
             gnss_lever_m = [-6.0, 0.0, -14.0], good to 0.2 m"
        );
    }

    #[test]
    fn a_car_that_is_configured_as_a_ship_is_no_fault_and_told_what_to_write() {
        assert!(!Finding::OnWheels.is_fault() && !Finding::NotAtSea.is_fault());
        assert_eq!(Finding::OnWheels.to_paste().as_deref(), Some("kind = \"car\""));
    }

    #[test]
    fn a_delay_has_its_direction() {
        let late = Finding::GnssDelay { found: -0.504, sigma: 0.01 };
        let text = "GNSS epochs seem to be tagged 0.50 s before their time, good to 0.01 s";
        assert_eq!(late.to_string(), text);
    }
}
