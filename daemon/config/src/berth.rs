//! Berths, and the ship that goes alongside: `[[berth]]` and `[docking]`.

use insd_base::{Body, Geodetic};
use insd_nav::angular_rate::rate_variance;
use insd_output::docking::{DockingConfig, DockingLimits, Fender, Hull, Quay, WaterSide};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::file::Config;

/// A line that is shorter has no direction, m.
const SHORTEST: f64 = 1.0;
/// One that is longer is no berth, m.
const LONGEST: f64 = 5000.0;
/// A fender that stands further off is none, m.
const FURTHEST: f64 = 30.0;

/// A berth to go alongside.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BerthSection {
    /// Its name.
    pub name: String,
    /// One point of the edge of the quay: latitude, longitude, deg.
    pub from_deg: [f64; 2],
    /// Another point of it: latitude, longitude, deg.
    pub to_deg: [f64; 2],
    /// On which hand the water is, looking from the first point to the second.
    #[serde(default)]
    pub water: WaterHand,
    /// How far the face of the fenders is before the edge, all along the quay, m.
    #[serde(default)]
    pub fender_m: f64,
    /// Fenders one by one, where they differ: how far from the first point, and how far before the edge, m.
    #[serde(default)]
    pub fenders_m: Vec<[f64; 2]>,
    /// Bollards: how far from the first point, m.
    #[serde(default)]
    pub bollards_m: Vec<f64>,
    /// Height of the edge above the ellipsoid, m. With it the height of the manifold above the quay is told.
    pub height_m: Option<f64>,
    /// How well line, fenders and the points of the ship are known across the line, 1-sigma, m.
    #[serde(default = "tenth")]
    pub std_m: f64,
}

/// On which hand the water is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WaterHand {
    /// To the right.
    #[default]
    Right,
    /// To the left.
    Left,
}

/// The ship that goes alongside, and when to be warned.
#[derive(Clone, Debug, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DockingSection {
    /// Name of the `[[point]]` at which her side begins forward, at the height of the fenders.
    pub bow: Option<String>,
    /// Name of the `[[point]]` at which it ends aft.
    pub stern: Option<String>,
    /// Name of the `[[point]]` of the manifold, or of whatever else is to come to its place.
    pub manifold: Option<String>,
    /// Her beam, m: she is taken as a rectangle from bow to stern. Without it and without an outline the points are those of her side.
    pub beam_m: Option<f64>,
    /// Corners of her outline at the height of the fenders from the IMU: forward, starboard, m.
    pub outline_m: Vec<[f64; 2]>,
    /// Name of the `[[berth]]` that is chosen at the start; left out: the nearest is proposed.
    pub berth: Option<String>,
    /// Speed of the first contact that is warned of, m/s.
    pub contact_speed_mps: Option<f64>,
    /// Distance at which it is warned of a part that still comes nearer, m.
    pub distance_m: Option<f64>,
    /// Protection level of a distance beyond which all is called doubtful, m.
    pub alert_limit_m: Option<f64>,
}

fn tenth() -> f64 {
    0.1
}

impl BerthSection {
    /// The two points of its line, at its height.
    pub(crate) fn line(&self) -> [Geodetic; 2] {
        let height = self.height_m.unwrap_or(0.0);
        [self.from_deg, self.to_deg].map(|[lat, lon]| Geodetic::from_degrees(lat, lon, height))
    }

    /// What goes alongside is told of it.
    #[must_use]
    pub fn quay(&self) -> Quay {
        let fender = |[at, off]: &[f64; 2]| Fender { at: *at, off: *off };
        let all_along = vec![Fender { at: 0.0, off: self.fender_m }];
        let own: Vec<Fender> = self.fenders_m.iter().map(fender).collect();
        Quay {
            name: self.name.clone(),
            line: self.line(),
            water: match self.water {
                WaterHand::Right => WaterSide::Right,
                WaterHand::Left => WaterSide::Left,
            },
            fenders: if own.is_empty() { all_along } else { own },
            bollards: self.bollards_m.clone(),
            height: self.height_m,
            sigma: self.std_m,
        }
    }

    /// All that is wrong with it, in words.
    fn faults(&self) -> Vec<String> {
        let mut faults = Vec::new();
        let mut expect = |good: bool, fault: String| {
            if !good {
                faults.push(fault);
            }
        };
        expect(!self.name.is_empty(), "name: expected a name".to_owned());
        let on_earth = |[lat, lon]: [f64; 2]| lat.abs() <= 90.0 && lon.abs() <= 180.0;
        for (key, point) in [("from_deg", self.from_deg), ("to_deg", self.to_deg)] {
            let text = "expected [latitude, longitude], -90 to 90 and -180 to 180";
            expect(on_earth(point), format!("{key}: {text}"));
        }
        let length = self.quay().length();
        if on_earth(self.from_deg) && on_earth(self.to_deg) {
            let text =
                format!("to_deg: expected another point than from_deg, {SHORTEST} m away or more");
            expect(length >= SHORTEST, text);
            let text = format!(
                "to_deg: expected the other end of the quay, within {LONGEST} m of from_deg, which is {length:.0} m away"
            );
            expect(length <= LONGEST, text);
        }
        let off = |value: f64| (0.0..=FURTHEST).contains(&value);
        expect(off(self.fender_m), format!("fender_m: expected 0 to {FURTHEST}"));
        let both = self.fender_m != 0.0 && !self.fenders_m.is_empty();
        expect(!both, "fenders_m: expected either fender_m or fenders_m".to_owned());
        let on_quay = |at: f64| (0.0..=length.max(SHORTEST)).contains(&at);
        let sound = self.fenders_m.iter().all(|[at, before]| on_quay(*at) && off(*before));
        let text = format!(
            "fenders_m: expected [from the first point, before the edge], 0 to {length:.0} and 0 to {FURTHEST}"
        );
        expect(sound, text);
        let rising = self.fenders_m.is_sorted_by(|one, other| one[0] < other[0]);
        expect(rising, "fenders_m: expected them in rising order along the quay".to_owned());
        let sound = self.bollards_m.iter().all(|at| on_quay(*at));
        expect(sound, format!("bollards_m: expected each from 0 to {length:.0}"));
        let sound = self.height_m.is_none_or(|height| (-1000.0..=9000.0).contains(&height));
        expect(sound, "height_m: expected -1000 to 9000".to_owned());
        expect((0.0..=100.0).contains(&self.std_m), "std_m: expected 0 to 100".to_owned());
        faults
    }
}

impl DockingSection {
    fn named(&self) -> [(&'static str, Option<&String>); 3] {
        [
            ("bow", self.bow.as_ref()),
            ("stern", self.stern.as_ref()),
            ("manifold", self.manifold.as_ref()),
        ]
    }

    /// The outline; that of a beam goes from bow to stern.
    fn outline(&self, bow: &Body, stern: &Body) -> Vec<[f64; 2]> {
        let Some(beam) = self.beam_m else { return self.outline_m.clone() };
        let (fore, aft, half) = (bow.0.x, stern.0.x, beam / 2.0);
        let (middle_fore, middle_aft) = (bow.0.y, stern.0.y);
        vec![
            [fore, middle_fore - half],
            [fore, middle_fore + half],
            [aft, middle_aft + half],
            [aft, middle_aft - half],
        ]
    }

    /// All that is wrong with it, in words; a bow and a stern are needed where there are berths.
    fn faults(&self, config: &Config) -> Vec<String> {
        let mut faults = Vec::new();
        let mut expect = |good: bool, fault: &str| {
            if !good {
                faults.push(fault.to_owned());
            }
        };
        for (key, name) in self.named() {
            let known = name.is_none_or(|name| config.has_point(name));
            expect(known, &format!("{key}: expected the name of a [[point]]"));
            let needed = key != "manifold" && !config.berths.is_empty();
            expect(
                name.is_some() || !needed,
                &format!("{key}: expected the name of a [[point]], as there is a [[berth]]"),
            );
        }
        if let Some((bow, stern)) = config.ends_of_ship() {
            expect(bow.0.x > stern.0.x, "bow: expected a [[point]] that is ahead of that of stern");
        }
        let beam = self.beam_m.is_none_or(|beam| (0.5..=100.0).contains(&beam));
        expect(beam, "beam_m: expected 0.5 to 100");
        let both = self.beam_m.is_some() && !self.outline_m.is_empty();
        expect(!both, "outline_m: expected either beam_m or outline_m");
        let closed = self.outline_m.is_empty() || self.outline_m.len() >= 3;
        expect(closed, "outline_m: expected three corners or more");
        let near = self.outline_m.iter().flatten().all(|part| part.abs() <= 1000.0);
        expect(near, "outline_m: expected [forward, starboard] in m, each within +-1000");
        let known = |name: &String| config.berths.iter().any(|berth| berth.name == *name);
        expect(self.berth.as_ref().is_none_or(known), "berth: expected the name of a [[berth]]");
        for (key, value, most) in [
            ("contact_speed_mps", self.contact_speed_mps, 10.0),
            ("distance_m", self.distance_m, 1000.0),
            ("alert_limit_m", self.alert_limit_m, 1000.0),
        ] {
            let good = value.is_none_or(|value| value > 0.0 && value <= most);
            expect(good, &format!("{key}: expected more than 0, {most} at the most"));
        }
        faults
    }
}

impl Config {
    /// Bow and stern from the IMU, if both are told.
    pub(crate) fn ends_of_ship(&self) -> Option<(Body, Body)> {
        let lever = |name: &Option<String>| {
            let name = name.as_ref()?;
            let point = self.points.iter().find(|point| point.name == *name)?;
            Some(point.lever())
        };
        lever(&self.docking.bow).zip(lever(&self.docking.stern))
    }

    /// What outputs are told of berths.
    pub(crate) fn docking(&self) -> DockingConfig {
        let docking = &self.docking;
        let manifold = docking.manifold.as_ref().and_then(|name| {
            self.points.iter().find(|point| point.name == *name).map(|point| point.lever())
        });
        let hull = self.ends_of_ship().map(|(bow, stern)| Hull {
            outline: docking.outline(&bow, &stern),
            bow,
            stern,
            manifold,
        });
        let imu = self.imu.spec(self.imu(None).map_or(100.0, |sensor| sensor.rate_hz));
        DockingConfig {
            berths: self.berths.iter().map(BerthSection::quay).collect(),
            hull,
            rate_sigma: rate_variance(&imu).sqrt().hypot(imu.gyro.instability_std),
            limits: DockingLimits {
                contact_speed: docking.contact_speed_mps,
                distance: docking.distance_m,
                level: docking.alert_limit_m,
            },
            chosen: docking.berth.clone(),
        }
    }
}

/// All that is wrong with berths and the ship that goes alongside, with their places.
pub(crate) fn faults(config: &Config) -> Vec<String> {
    let mut faults = Vec::new();
    for berth in &config.berths {
        let place = format!("[[berth]] \"{}\"", berth.name);
        if config.berths.iter().filter(|other| other.name == berth.name).count() > 1 {
            faults.push(format!("{place}: name: expected a name that no other berth has"));
        }
        faults.extend(berth.faults().into_iter().map(|fault| format!("{place}: {fault}")));
    }
    let docking = config.docking.faults(config);
    faults.extend(docking.into_iter().map(|fault| format!("[docking]: {fault}")));
    faults
}

#[cfg(test)]
mod tests {
    use insd_base::{Arrival, Input, Order, PortId, Stamp, Time, UtcTime};
    use insd_vessel::{Obeyed, Product};

    use super::*;

    const SURVEY: &str = include_str!("../../../systemd/examples/survey.toml");
    const BERTH: &str = "
[[point]]
name = \"bow\"
lever_m = [62.0, 0.0, 4.0]
[[point]]
name = \"stern\"
lever_m = [-58.0, 0.0, 4.0]
[docking]
bow = \"bow\"
stern = \"stern\"
beam_m = 22.0
berth = \"Pier 3\"
[[berth]]
name = \"Pier 3\"
from_deg = [35.44, 139.65]
to_deg = [35.44, 139.6525]
fender_m = 1.2
";

    fn with(from: &str, to: &str) -> String {
        assert!(BERTH.contains(from), "{from}");
        format!("{SURVEY}{}", BERTH.replacen(from, to, 1))
    }

    #[test]
    fn what_is_configured_is_what_outputs_are_told() {
        let config = Config::of_text(&with("fender_m", "bollards_m = [5.0]\nfender_m")).unwrap();
        let told = config.docking();
        let quay = &told.berths[0];
        assert!((quay.length() - 227.0).abs() < 1.0, "{}", quay.length());
        assert_eq!(
            (quay.fenders.as_slice(), quay.sigma),
            (&[Fender { at: 0.0, off: 1.2 }][..], 0.1)
        );
        let hull = told.hull.unwrap();
        assert_eq!(hull.outline, [[62.0, -11.0], [62.0, 11.0], [-58.0, 11.0], [-58.0, -11.0]]);
        assert_eq!((hull.bow, hull.manifold), (Body::new(62.0, 0.0, 4.0), None));
        assert_eq!(told.chosen.as_deref(), Some("Pier 3"));
        // angle random walk of 0.003 deg/sqrt(h) in samples of 200 Hz: some 1e-5 rad/s
        assert!((1e-6..1e-4).contains(&told.rate_sigma), "{}", told.rate_sigma);
    }

    #[test]
    fn each_mistake_is_told_with_its_line_and_what_was_expected() {
        for (from, to, told) in [
            (
                "[35.44, 139.6525]",
                "[35.44, 139.65]",
                "to_deg: expected another point than from_deg",
            ),
            ("[35.44, 139.6525]", "[35.44, 139.95]", "within 5000 m of from_deg, which is 27"),
            ("[35.44, 139.65]", "[139.65, 35.44]", "from_deg: expected [latitude, longitude]"),
            ("[35.44, 139.65]", "[35.44]", "from_deg: expected a list of 2"),
            ("[35.44, 139.65]", "[nan, 139.65]", "from_deg: expected [latitude, longitude]"),
            ("fender_m = 1.2", "fender_m = -1.2", "fender_m: expected 0 to 30, not -1.2"),
            (
                "fender_m = 1.2",
                "fenders_m = [[9.0, 1.0], [8.0, 1.0]]",
                "expected them in rising order",
            ),
            ("fender_m = 1.2", "fenders_m = [[900.0, 1.0]]", "0 to 227 and 0 to 30"),
            ("fender_m = 1.2", "bollards_m = [300.0]", "bollards_m: expected each from 0 to 227"),
            ("fender_m = 1.2", "std_m = -1.0", "std_m: expected 0 to 100, not -1.0"),
            ("fender_m = 1.2", "water = \"north\"", "water: expected one of right, left"),
            (
                "bow = \"bow\"",
                "bow = \"stem\"",
                "bow: expected the name of a [[point]], not \"stem\"",
            ),
            (
                "bow = \"bow\"\n",
                "",
                "bow: expected the name of a [[point]], as there is a [[berth]]",
            ),
            ("bow = \"bow\"", "bow = \"stern\"", "that is ahead of that of stern"),
            ("beam_m = 22.0", "beam_m = 0", "beam_m: expected 0.5 to 100"),
            (
                "beam_m = 22.0",
                "outline_m = [[1.0, 2.0]]",
                "outline_m: expected three corners or more",
            ),
            (
                "\"Pier 3\"\n[[berth]]",
                "\"Pier 4\"\n[[berth]]",
                "berth: expected the name of a [[berth]]",
            ),
            ("beam_m = 22.0", "distance_m = 0.0", "distance_m: expected more than 0"),
            ("name = \"Pier 3\"", "name = \"\"", "name: expected a name"),
        ] {
            let message = Config::of_text(&with(from, to)).unwrap_err();
            assert!(message.contains(told) && message.contains("line "), "{to}: {message}");
        }
        let twice =
            format!("{}{}", with("beam", "beam"), &BERTH[BERTH.find("[[berth]]").unwrap()..]);
        let message = Config::of_text(&twice).unwrap_err();
        assert!(message.contains("a name that no other berth has"), "{message}");
    }

    #[test]
    fn a_line_that_is_shorter_than_the_ship_and_a_berth_in_another_sea_are_warned_of() {
        let causes = |from: &str, to: &str| {
            let examined = crate::check::examine(&with(from, to));
            assert!(examined.is_accepted(), "{:?}", examined.findings);
            examined.findings.iter().map(|finding| finding.cause).collect::<Vec<_>>()
        };
        let usual = causes("beam", "beam");
        assert!(!usual.contains(&"quay-short") && !usual.contains(&"berth-far"), "{usual:?}");
        assert!(causes("139.6525]", "139.651]").contains(&"quay-short"));
        let far = "from_deg = [31.44, 139.65]\nto_deg = [31.44, 139.6525]";
        assert!(
            causes("from_deg = [35.44, 139.65]\nto_deg = [35.44, 139.6525]", far)
                .contains(&"berth-far")
        );
        assert!(causes("beam_m = 22.0\n", "").contains(&"no-beam"));
    }

    #[test]
    fn an_order_chooses_a_berth_that_there_is_and_a_new_configuration_keeps_it() {
        let text = with("berth = \"Pier 3\"\n", "");
        let mut pipeline = Config::of_text(&text).unwrap().pipeline();
        let mut order = |order: Order| {
            let stamp = Stamp { monotonic: Time::START, system: UtcTime::from_nanos(0) };
            let arrival = Arrival { stamp, port: PortId(u16::MAX), input: Input::Order(order) };
            let mut obeyed = Vec::new();
            pipeline.handle(&arrival, |product| obeyed.push(product));
            let chosen = pipeline.outputs().station().berths().chosen().map(str::to_owned);
            (obeyed, chosen)
        };
        let berth = |name: &str| Order::Berth(Some(name.to_owned()));
        let done = |name: Option<&str>, done| {
            vec![Product::Order(Obeyed::Berth { name: name.map(str::to_owned), done })]
        };
        let pier = Some("Pier 3".to_owned());
        assert_eq!(order(berth("Pier 4")), (done(Some("Pier 4"), false), None));
        assert_eq!(order(berth("Pier 3")), (done(Some("Pier 3"), true), pier.clone()));
        let other = text.replace("fender_m = 1.2", "fender_m = 1.3");
        let (obeyed, chosen) = order(Order::Configuration(other));
        let Product::Order(Obeyed::Configured(change)) = &obeyed[0] else {
            unreachable!("{obeyed:?}")
        };
        assert!(change.outputs && !change.inputs && change.waiting.is_empty());
        assert_eq!(chosen, pier);
        assert_eq!(order(Order::Berth(None)), (done(None, true), None));
    }
}
