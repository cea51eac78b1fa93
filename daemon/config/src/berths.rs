//! What the configuration makes of berths and of the ship that goes alongside.

use insd_base::Body;
use insd_nav::angular_rate::rate_variance;
use insd_output::docking::{DockingConfig, DockingLimits, Hull};

use crate::berth::{BerthSection, DockingSection};
use crate::file::Config;

impl Config {
    /// Bow and stern from the IMU, if both are told.
    pub(crate) fn ends_of_ship(&self) -> Option<(Body, Body)> {
        self.docking.ends(&self.points)
    }

    /// What outputs are told of berths.
    pub(crate) fn docking(&self) -> DockingConfig {
        let docking = &self.docking;
        let manifold = DockingSection::lever(&self.points, docking.manifold.as_ref());
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
    let docking = config.docking.faults(&config.points, &config.berths);
    faults.extend(docking.into_iter().map(|fault| format!("[docking]: {fault}")));
    faults
}

#[cfg(test)]
mod tests {
    use insd_base::{Arrival, Input, Order, PortId, Stamp, Time, UtcTime};
    use insd_vessel::{Obeyed, Product};

    use insd_output::docking::Fender;

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
