//! What is drawn by kind and seed: a port, a ship, and what goes wrong.

use insd_base::{Geodetic, geoid};

/// The basis: a quarter of an hour through a port.
pub(crate) const SCENARIO: &str = "26";
/// How long each voyage is, s.
const DURATION: f64 = 840.0;
/// A position follows one satellite's error by this share, about, where ten are in view.
const SHARE: f64 = 0.3;

/// What goes wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Nothing.
    Honest,
    /// One satellite runs away.
    Ramp,
    /// One satellite jumps.
    Jump,
    /// The base is not where it says, from the begin.
    Base,
    /// Multipath is many times as large as stated.
    Multipath,
    /// Of some satellites only a reflection is heard.
    NonLineOfSight,
    /// A spoofer pulls all ranges and fixes away.
    Spoofer,
}

/// All kinds, in the order of the table.
pub(crate) const KINDS: [Kind; 7] = [
    Kind::Honest,
    Kind::Ramp,
    Kind::Jump,
    Kind::Base,
    Kind::Multipath,
    Kind::NonLineOfSight,
    Kind::Spoofer,
];

impl Kind {
    /// Its name in the table.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Kind::Honest => "nothing",
            Kind::Ramp => "ramp of a satellite",
            Kind::Jump => "jump of a satellite",
            Kind::Base => "wrong base",
            Kind::Multipath => "multipath",
            Kind::NonLineOfSight => "non-line-of-sight",
            Kind::Spoofer => "spoofer",
        }
    }
}

/// One voyage.
#[derive(Clone, Debug)]
pub(crate) struct Case {
    pub(crate) kind: Kind,
    pub(crate) seed: u64,
    /// Between which times it goes wrong, s; of an honest one none.
    pub(crate) wrong: Option<[f64; 2]>,
    /// How large it is, in words.
    pub(crate) size: String,
    /// What is set in the scenario.
    pub(crate) sets: Vec<String>,
}

/// A stream of numbers by a seed: SplitMix64 (Steele, Lea and Flood, OOPSLA 2014).
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as f64 / 2.0_f64.powi(64)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// Evenly by its logarithm.
    fn of_any_size(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    fn angle(&mut self) -> f64 {
        self.between(0.0, 360.0)
    }
}

impl Case {
    /// Grades take turns, and so do ships with and without a log.
    pub(crate) fn new(kind: Kind, seed: u64) -> Self {
        let mut draw = Draw(seed << 8 | kind as u64);
        let grade = if seed.is_multiple_of(2) { "navigation" } else { "mems" };
        let has_log = (seed / 2).is_multiple_of(2);
        let mut case = Case {
            kind,
            seed,
            wrong: None,
            size: format!("{grade}{}", if has_log { ", log" } else { "" }),
            sets: vec![
                format!("duration_s={DURATION}"),
                "truth.rate_hz=2".to_owned(),
                format!("imu={{ grade = \"{grade}\", rate_hz = 50 }}"),
            ],
        };
        if has_log {
            case.sets.push("log={}".to_owned());
        }
        let place = case.port(&mut draw);
        case.go_wrong(&mut draw, &place);
        case
    }

    /// Where she sails, and the sea.
    fn port(&mut self, draw: &mut Draw) -> Geodetic {
        let (latitude, longitude) = (draw.between(-60.0, 60.0), draw.between(-180.0, 180.0));
        let sea = Geodetic::from_degrees(latitude, longitude, 0.0);
        let height = geoid::undulation(&sea).unwrap_or_default();
        self.sets.push(format!("start.lat_deg={latitude}"));
        self.sets.push(format!("start.lon_deg={longitude}"));
        self.sets.push(format!("start.height_m={height}"));
        let speed = draw.between(4.0, 12.0);
        let mut heading = draw.angle();
        let first = draw.between(100.0, 250.0);
        let second = draw.between(150.0, 350.0);
        let legs = [first, second, DURATION - first - second].map(|duration| {
            heading = (heading + draw.between(-110.0, 110.0)).rem_euclid(360.0);
            format!("{{ heading_deg = {heading}, speed_kn = {speed}, duration_s = {duration} }}")
        });
        self.sets.push(format!("route.legs=[{}]", legs.join(", ")));
        let wave = draw.between(0.2, 1.5);
        self.sets.push(format!(
            "sea={{ significant_height_m = {wave}, peak_period_s = {}, from_deg = {} }}",
            draw.between(4.0, 8.0),
            draw.angle()
        ));
        Geodetic::from_degrees(latitude, longitude, height)
    }

    /// What happens to the sky and to fixes.
    fn go_wrong(&mut self, draw: &mut Draw, place: &Geodetic) {
        let from = draw.between(330.0, 450.0).round();
        let span = [from, from + 300.0];
        let (crane, width) = (draw.angle(), draw.between(40.0, 150.0));
        let mut raw = vec![format!(
            "crane = [{{ azimuth_deg = [{crane}, {}], elevation_deg = {} }}]",
            (crane + width).rem_euclid(360.0),
            draw.between(15.0, 40.0)
        )];
        let (size, of_sky, of_fixes) = self.fault(draw, span);
        self.wrong = match self.kind {
            Kind::Honest => None,
            Kind::Base => Some([0.0, DURATION]),
            _ => Some(span),
        };
        self.size = format!("{}, {size}", self.size);
        let has_base = self.kind == Kind::Base || draw.next() < 0.3;
        raw.extend((!of_sky.is_empty() && self.kind != Kind::Base).then(|| of_sky.clone()));
        if has_base {
            raw.push(base(draw, place, if self.kind == Kind::Base { &of_sky } else { "" }));
            raw.push("frequencies = 2".to_owned());
            self.size += ", base";
        }
        self.sets.push(format!("raw={{ common_clock = [1], {} }}", raw.join(", ")));
        self.sets.push(format!("gnss={{ {of_fixes} }}"));
    }

    /// How large it is, and what it does to the sky and to fixes.
    fn fault(&self, draw: &mut Draw, [from, to]: [f64; 2]) -> (String, String, String) {
        let during = format!("when = {{ at_s = [{}] }}, duration_s = {}", from - 0.5, to - from);
        let within = format!("t0_s = {from}, t1_s = {to}");
        let (angle, share) = (draw.angle(), SHARE * draw.between(0.3, 1.7));
        match self.kind {
            Kind::Honest => Default::default(),
            Kind::Ramp => {
                let rate = draw.of_any_size(0.05, 1.0);
                (
                    format!("{rate:.2} m/s"),
                    format!("fault = [{{ {within}, ramp_mps = {rate} }}]"),
                    format!(
                        "spoofing = [{{ {during}, direction_deg = {angle}, speed_mps = {} }}]",
                        share * rate
                    ),
                )
            }
            Kind::Jump => {
                let size = draw.of_any_size(5.0, 200.0);
                let what = if draw.next() < 0.5 { "jump_m" } else { "clock_jump_m" };
                (
                    format!("{what} {size:.0}"),
                    format!("fault = [{{ {within}, {what} = {size} }}]"),
                    format!("jumps = [{{ {during}, size_m = {} }}]", share * size),
                )
            }
            Kind::Base => told_elsewhere(draw, angle),
            Kind::Multipath => {
                let times = draw.of_any_size(3.0, 20.0);
                (
                    format!("{times:.0} times"),
                    format!(
                        "segment = [{{ {within}, label = \"multipath\", multipath = {times} }}]"
                    ),
                    format!("jumps = [{{ {during}, size_m = {} }}]", share * times),
                )
            }
            Kind::NonLineOfSight => {
                let count = 1 + (4.0 * draw.next()) as u32;
                (
                    format!("{count} satellites"),
                    format!("segment = [{{ {within}, label = \"nlos\", reflected = {count} }}]"),
                    format!("jumps = [{{ {during}, size_m = {} }}]", share * 20.0),
                )
            }
            Kind::Spoofer => {
                let speed = draw.of_any_size(0.1, 1.0);
                let clock = draw.between(0.0, 20.0);
                (
                    format!("{speed:.2} m/s"),
                    format!(
                        "spoof = [{{ {within}, speed_mps = {speed}, direction_deg = {angle}, clock_m = {clock} }}]"
                    ),
                    format!(
                        "spoofing = [{{ {during}, direction_deg = {angle}, speed_mps = {speed} }}]"
                    ),
                )
            }
        }
    }
}

/// A base within some kilometres, for whose place nobody on board answers, with more of its table.
fn base(draw: &mut Draw, place: &Geodetic, more: &str) -> String {
    let north = draw.between(-0.03, 0.03);
    let east = draw.between(-0.03, 0.03);
    let comma = if more.is_empty() { "" } else { ", " };
    format!(
        "base = {{ lat_deg = {}, lon_deg = {}, height_m = {}, surveyed = false{comma}{more} }}",
        place.latitude.to_degrees() + north,
        place.longitude.to_degrees() + east,
        place.height + draw.between(5.0, 30.0)
    )
}

/// How far off a base says it is, and the key of that.
fn told_elsewhere(draw: &mut Draw, angle: f64) -> (String, String, String) {
    let off = draw.of_any_size(0.3, 30.0);
    let (north, east) = (off * angle.to_radians().cos(), off * angle.to_radians().sin());
    (format!("{off:.1} m"), format!("told_off_m = [{north}, {east}, 0.0]"), String::new())
}
