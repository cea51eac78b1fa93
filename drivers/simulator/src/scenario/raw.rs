//! Raw GNSS: antennas, receivers, the sky above them, and what goes wrong with it.

use insd_base::SatelliteId;
use serde::Deserialize;

/// The sky: which satellites, and how far truth is from what they broadcast.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct RawSky {
    /// Letters of the constellations, as in RINEX: G, E, J and C.
    pub(crate) constellations: String,
    /// True orbit against the broadcast one, 1-sigma of its length; smooth.
    pub(crate) orbit_std_m: f64,
    /// True clock of a satellite against the broadcast one, 1-sigma; smooth.
    pub(crate) clock_std_m: f64,
    /// How far neighbouring records of a satellite disagree, 1-sigma, along the track and in the clock.
    pub(crate) record_step_m: f64,
    /// Delay in the ionosphere over that of the broadcast model: drawn from between the two, one draw.
    pub(crate) ionosphere_factor: [f64; 2],
    /// Change of that factor from satellite to satellite and in time, 1-sigma; smooth.
    pub(crate) ionosphere_std: f64,
    /// How quickly orbit, clock and ionosphere depart: the mean period of what they are made of.
    pub(crate) period_s: f64,
    /// Delay in the troposphere over the true one: 0 takes it away.
    pub(crate) troposphere_factor: f64,
    /// Zenith delay of the water in the air against the mean, 1-sigma, one draw.
    pub(crate) wet_zenith_std_m: f64,
}

impl Default for RawSky {
    fn default() -> Self {
        RawSky {
            constellations: "GEJ".to_owned(),
            orbit_std_m: 1.0,
            clock_std_m: 0.5,
            record_step_m: 0.2,
            ionosphere_factor: [0.7, 1.3],
            ionosphere_std: 0.1,
            period_s: 14_400.0,
            troposphere_factor: 1.0,
            wet_zenith_std_m: 0.03,
        }
    }
}

/// A span of time that is judged apart, or in which the sky is obstructed.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSegment {
    /// Beginning.
    pub(crate) t0_s: f64,
    /// End, excluded.
    pub(crate) t1_s: f64,
    /// What to call it.
    pub(crate) label: String,
    /// How many satellites are left; all unless given.
    pub(crate) satellites: Option<usize>,
    /// Of how many low satellites only a reflection is heard.
    #[serde(default)]
    pub(crate) reflected: usize,
    /// How many times as large as stated multipath is.
    #[serde(default = "once")]
    pub(crate) multipath: f64,
}

fn once() -> f64 {
    1.0
}

/// Something on land that hides a part of the sky.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawCrane {
    /// From the first bearing clockwise to the second, from true north.
    pub(crate) azimuth_deg: [f64; 2],
    /// How high it reaches.
    pub(crate) elevation_deg: f64,
    /// Beginning; the start unless given.
    #[serde(default)]
    pub(crate) t0_s: f64,
    /// End, excluded; never unless given.
    pub(crate) t1_s: Option<f64>,
}

/// What one satellite does that its records do not say: exactly one of the four sizes is given.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawFault {
    /// Its name; one in view throughout, drawn at random, unless given.
    pub(crate) satellite: Option<SatelliteName>,
    /// Beginning.
    pub(crate) t0_s: f64,
    /// End, excluded; the end of the voyage unless given.
    pub(crate) t1_s: Option<f64>,
    /// Code and phase run away.
    pub(crate) ramp_mps: Option<f64>,
    /// The code is off, the phase is not.
    pub(crate) jump_m: Option<f64>,
    /// The satellite's clock is off: code and phase alike.
    pub(crate) clock_jump_m: Option<f64>,
    /// The satellite leaves, along its track, the orbit of its last record, and broadcasts no newer one. Has no end.
    pub(crate) stale_mps2: Option<f64>,
}

/// A satellite by its name, as G07.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(try_from = "String")]
pub(crate) struct SatelliteName(pub(crate) SatelliteId);

impl TryFrom<String> for SatelliteName {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse().map(SatelliteName)
    }
}

/// All ranges pulled towards a false position, consistently.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSpoof {
    /// Beginning.
    pub(crate) t0_s: f64,
    /// End, excluded; then the receivers are back at once.
    pub(crate) t1_s: f64,
    /// Speed of the pull.
    pub(crate) speed_mps: f64,
    /// Where to, from true north.
    pub(crate) direction_deg: f64,
    /// By how much all ranges are longer from the first moment on, as the spoofer's clock is not the satellites'.
    #[serde(default)]
    pub(crate) clock_m: f64,
}

/// What is wrong with the installation of one antenna: exactly one of the three is given.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawAntennaFault {
    /// Its number, from 1.
    pub(crate) antenna: usize,
    /// Beginning; the start unless given.
    #[serde(default)]
    pub(crate) t0_s: f64,
    /// End, excluded; never unless given.
    pub(crate) t1_s: Option<f64>,
    /// Its cable is broken: nothing comes.
    #[serde(default)]
    pub(crate) broken: bool,
    /// Its signals are weaker by this.
    pub(crate) weaker_db: Option<f64>,
    /// Its receiver runs on an oscillator of its own, whatever `common_clock` says: so much faster than the one before. Has no end.
    pub(crate) own_clock_mps: Option<f64>,
}

/// A receiver on land, of the same kind as those on board.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawBase {
    /// Geodetic latitude of its antenna.
    pub(crate) lat_deg: f64,
    /// Longitude.
    pub(crate) lon_deg: f64,
    /// Height above the ellipsoid.
    pub(crate) height_m: f64,
    /// Where it says it is less where it is, north, east, down.
    #[serde(default)]
    pub(crate) told_off_m: [f64; 3],
    /// Whether somebody on board has it surveyed where it says it is; else that is its word alone.
    #[serde(default = "surveyed")]
    pub(crate) surveyed: bool,
}

fn surveyed() -> bool {
    true
}

/// Raw GNSS. The first keys are those of a voyage's `[raw]` table.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Raw {
    /// Rate of epochs.
    pub(crate) rate_hz: f64,
    /// Antennas from the IMU, body axes.
    pub(crate) antennas_m: Vec<[f64; 3]>,
    /// Numbers, from 1, of the antennas whose receivers share one oscillator.
    pub(crate) common_clock: Vec<usize>,
    /// White noise of the code at the zenith, 1-sigma; times sqrt((1 + 1/sin^2 el)/2), as the next four.
    pub(crate) code_std_m: f64,
    /// Of the phase.
    pub(crate) phase_std_m: f64,
    /// Of the Doppler shift.
    pub(crate) doppler_std_mps: f64,
    /// Multipath of the code, Gauss-Markov, 1-sigma.
    pub(crate) multipath_code_std_m: f64,
    /// Of the phase.
    pub(crate) multipath_phase_std_m: f64,
    /// Its time constant.
    pub(crate) multipath_time_constant_s: f64,
    /// Random walk of a receiver's clock.
    pub(crate) clock_bias_walk_m_sqrt_s: f64,
    /// Random walk of its drift.
    pub(crate) clock_drift_walk_mps_sqrt_s: f64,
    /// Random walk of the phase delay of each antenna's line.
    pub(crate) line_bias_walk_m_sqrt_s: f64,
    /// Frequencies per satellite, 1 or 2.
    pub(crate) frequencies: u8,
    /// Satellites lower than this are not tracked.
    pub(crate) mask_deg: f64,
    /// Offset of a receiver's clock at the start: up to this, either way.
    pub(crate) clock_offset_ms: f64,
    /// Drift of its clock at the start, 1-sigma.
    pub(crate) clock_drift_mps: f64,
    /// Whether a receiver sets its clock by a whole millisecond where it is off by more than half a one.
    pub(crate) clock_jumps: bool,
    /// Constant offset of each constellation but GPS and QZSS in a receiver, 1-sigma.
    pub(crate) constellation_offset_std_m: f64,
    /// Cycle slips of each satellite and antenna.
    pub(crate) slips_per_hour: f64,
    /// Which share of them the receiver tells.
    pub(crate) slips_told: f64,
    /// How long after it is found a phase may be off by half a cycle, and is said to be.
    pub(crate) half_cycle_s: f64,
    /// The sky.
    pub(crate) sky: RawSky,
    /// Spans of time.
    pub(crate) segment: Vec<RawSegment>,
    /// Obstructions.
    pub(crate) crane: Vec<RawCrane>,
    /// Faults of satellites.
    pub(crate) fault: Vec<RawFault>,
    /// Faults of the installation of single antennas.
    pub(crate) antenna_fault: Vec<RawAntennaFault>,
    /// Numbers of two antennas of which the voyage tells each to be where the other is.
    pub(crate) swapped: Option<[usize; 2]>,
    /// Spoofers.
    pub(crate) spoof: Vec<RawSpoof>,
    /// Base station.
    pub(crate) base: Option<RawBase>,
}

impl Default for Raw {
    fn default() -> Self {
        Raw {
            rate_hz: 1.0,
            antennas_m: vec![[-6.0, -0.8, -14.0]],
            common_clock: Vec::new(),
            code_std_m: 0.3,
            phase_std_m: 0.0015,
            doppler_std_mps: 0.03,
            multipath_code_std_m: 0.4,
            multipath_phase_std_m: 0.002,
            multipath_time_constant_s: 60.0,
            clock_bias_walk_m_sqrt_s: 0.01,
            clock_drift_walk_mps_sqrt_s: 0.01,
            line_bias_walk_m_sqrt_s: 5e-5,
            frequencies: 1,
            mask_deg: 10.0,
            clock_offset_ms: 0.3,
            clock_drift_mps: 30.0,
            clock_jumps: false,
            constellation_offset_std_m: 5.0,
            slips_per_hour: 2.0,
            slips_told: 0.3,
            half_cycle_s: 0.0,
            sky: RawSky::default(),
            segment: Vec::new(),
            crane: Vec::new(),
            fault: Vec::new(),
            antenna_fault: Vec::new(),
            swapped: None,
            spoof: Vec::new(),
            base: None,
        }
    }
}
