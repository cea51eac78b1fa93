//! Where she was, how she moved and lay, and how sure that was.

use insd_base::units::{DEG, KNOT, wrap_pi};
use insd_base::{Heave, HeaveQuality, Mode, Solution, Span, Time};

use crate::report::bins::{Bins, Extent, LIMIT, Merge};
use crate::report::statistics::Statistics;

/// Width of the first bins of what is measured continuously.
const FINE: Span = Span::from_nanos(100_000_000);
/// Width of the first bins of the track, and how many there are at most.
const PACE: Span = Span::from_nanos(1_000_000_000);
const PLACES: usize = 4096;
/// Speed below which a ship covers no ground but sways, m/s.
const UNDER_WAY: f64 = 0.1;
/// Heading sigma below which a heading is one to steer by, as the engine has it, rad.
const STEERABLE: f64 = 1.0 * DEG;
/// A solution that is missing for longer than this is a gap, s.
const GAP: f64 = 2.0;

/// One quantity over time, in the unit in which it is shown.
#[derive(Clone, Debug)]
pub(crate) struct Channel {
    pub(crate) bins: Bins<Extent>,
    /// Of what was said while navigating.
    pub(crate) navigating: Statistics,
}

/// Where she was at the end of a bin.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub(crate) struct Place(pub(crate) Option<Fix>);

/// A point of the track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fix {
    /// Latitude and longitude, rad.
    pub(crate) latitude: f64,
    pub(crate) longitude: f64,
    pub(crate) mode: Mode,
}

/// All quantities of the solutions.
#[derive(Clone, Debug)]
pub(crate) struct Motion {
    /// Roll, pitch, heading (without a jump at north), deg.
    pub(crate) roll: Channel,
    pub(crate) pitch: Channel,
    pub(crate) heading: Channel,
    /// Rate of turn, deg/min.
    pub(crate) turn: Channel,
    /// Speed over ground, kn.
    pub(crate) speed: Channel,
    /// Heave, m, up.
    pub(crate) heave: Channel,
    /// 1-sigma: heading, roll, pitch, deg; horizontal and vertical position, m, and velocity, m/s.
    pub(crate) heading_sigma: Channel,
    pub(crate) roll_sigma: Channel,
    pub(crate) pitch_sigma: Channel,
    pub(crate) horizontal_sigma: Channel,
    pub(crate) height_sigma: Channel,
    pub(crate) velocity_sigma: Channel,
    pub(crate) down_velocity_sigma: Channel,
    pub(crate) track: Bins<Place>,
    pub(crate) solutions: u64,
    /// When the first solution was valid, and the first by which one could navigate.
    pub(crate) first: Option<Time>,
    pub(crate) navigated: Option<Time>,
    /// Distance run over ground while navigating, m.
    pub(crate) distance: f64,
    /// Where solutions were missing once there were some, s.
    pub(crate) gaps: Statistics,
    last: Option<Time>,
    turned: f64,
}

impl Channel {
    fn new(start: Time, width: Span) -> Self {
        Channel { bins: Bins::new(start, width, LIMIT), navigating: Statistics::default() }
    }

    fn add(&mut self, time: Time, value: f64, navigating: bool) {
        self.bins.change(time, |bin| bin.add(value));
        if navigating {
            self.navigating.add(value);
        }
    }

    /// Whether anything was ever said.
    pub(crate) fn is_known(&self) -> bool {
        self.bins.iter().any(|(_, bin)| bin.values().is_some())
    }
}

impl Merge for Place {
    fn merge(&mut self, later: &Self) {
        self.0 = later.0.or(self.0);
    }
}

impl Motion {
    /// Nothing known yet; solutions will come so often, Hz.
    pub(crate) fn new(start: Time, rate: f64) -> Self {
        let own = || Channel::new(start, Span::from_seconds(1.0 / rate.max(0.01)).max(FINE));
        Motion {
            roll: own(),
            pitch: own(),
            heading: own(),
            turn: own(),
            speed: own(),
            heave: Channel::new(start, FINE),
            heading_sigma: own(),
            roll_sigma: own(),
            pitch_sigma: own(),
            horizontal_sigma: own(),
            height_sigma: own(),
            velocity_sigma: own(),
            down_velocity_sigma: own(),
            track: Bins::new(start, PACE, PLACES),
            solutions: 0,
            first: None,
            navigated: None,
            distance: 0.0,
            gaps: Statistics::default(),
            last: None,
            turned: 0.0,
        }
    }

    /// Takes a solution; gives the time since the last, s, unless there was a gap.
    pub(crate) fn solution(&mut self, solution: &Solution) -> Option<f64> {
        let time = solution.time;
        let steerable = self.navigated.is_some() || solution.sigma.heading <= STEERABLE;
        let navigating = solution.mode.is_navigating() && steerable;
        self.solutions += 1;
        self.first.get_or_insert(time);
        if navigating {
            self.navigated.get_or_insert(time);
        }
        self.turned += wrap_pi(solution.attitude.heading - self.turned);
        self.enter(solution, navigating);
        let (latitude, longitude) = (solution.position.latitude, solution.position.longitude);
        let fix = Fix { latitude, longitude, mode: solution.mode };
        self.track.change(time, |place| place.0 = Some(fix));
        let passed = self.last.replace(time).map(|last| (time - last).as_seconds());
        if let Some(missing) = passed.filter(|passed| *passed > GAP) {
            self.gaps.add(missing);
        }
        let passed = passed.filter(|passed| (0.0..=GAP).contains(passed));
        if navigating && solution.speed() >= UNDER_WAY {
            self.distance += passed.unwrap_or(0.0) * solution.speed();
        }
        passed
    }

    fn enter(&mut self, solution: &Solution, navigating: bool) {
        let time = solution.time;
        let sigma = &solution.sigma;
        let (position, velocity) = (&sigma.position.0, &sigma.velocity.0);
        let values = [
            (&mut self.roll, solution.attitude.roll / DEG),
            (&mut self.pitch, solution.attitude.pitch / DEG),
            (&mut self.heading, self.turned / DEG),
            (&mut self.turn, solution.rate_of_turn() * 60.0 / DEG),
            (&mut self.speed, solution.speed() / KNOT),
            (&mut self.heading_sigma, sigma.heading / DEG),
            (&mut self.roll_sigma, sigma.roll / DEG),
            (&mut self.pitch_sigma, sigma.pitch / DEG),
            (&mut self.horizontal_sigma, position.x.hypot(position.y)),
            (&mut self.height_sigma, position.z),
            (&mut self.velocity_sigma, velocity.x.hypot(velocity.y)),
            (&mut self.down_velocity_sigma, velocity.z),
        ];
        for (channel, value) in values {
            channel.add(time, value, navigating);
        }
    }

    /// Takes the heave at the IMU.
    pub(crate) fn heave(&mut self, heave: &Heave) {
        self.heave.add(heave.time, heave.heave, heave.quality != HeaveQuality::Unsettled);
    }
}
