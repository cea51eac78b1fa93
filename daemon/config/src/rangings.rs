//! What the configuration makes of docking aids.

use insd_base::{Body, RangingTarget};
use insd_intake::ranging::RangingSpec;

use crate::file::Config;
use crate::ranging::RangingSection;

/// Docking aids that are told apart.
const MOST: usize = 16;

impl Config {
    /// What the intake is told of docking aids.
    pub(crate) fn ranging_specs(&self) -> Vec<RangingSpec> {
        let specs = |(index, own): (usize, &RangingSection)| {
            let first = self.rangings.iter().position(|other| other.shares_mark(own));
            let mark = u16::try_from(2 * first.unwrap_or(index)).unwrap_or(u16::MAX - 1);
            let [forward, starboard, down] = own.lever_m;
            let spec = |head: u32, mark: u16, target: RangingTarget| RangingSpec {
                sensor: own.sensor.clone(),
                head,
                mark,
                target,
                lever: Body::new(forward, starboard, down),
                std: own.std_m,
            };
            match own.axes(&self.berths) {
                Some([a, b]) => vec![spec(1, mark, a), spec(2, mark + 1, b)],
                None => own
                    .target(&self.berths)
                    .map(|target| spec(own.head, mark, target))
                    .into_iter()
                    .collect(),
            }
        };
        self.rangings.iter().enumerate().flat_map(specs).collect()
    }
}

/// All that is wrong with docking aids, with their places.
pub(crate) fn faults(config: &Config) -> Vec<String> {
    let all = &config.rangings;
    let mut faults = Vec::new();
    for own in all {
        let place = format!("[[ranging]] \"{}\"", own.name);
        if all.iter().filter(|other| other.name == own.name).count() > 1 {
            faults.push(format!("{place}: name: expected a name that no other docking aid has"));
        }
        let is_same =
            |other: &&RangingSection| other.sensor == own.sensor && other.head == own.head;
        if all.iter().filter(is_same).count() > 1 {
            faults
                .push(format!("{place}: head: expected a number that no other of its sensor has"));
        }
        faults.extend(
            own.faults(&config.sensors, &config.berths)
                .into_iter()
                .map(|fault| format!("{place}: {fault}")),
        );
    }
    if let Some(last) = all.last().filter(|_| config.ranging_specs().len() > MOST) {
        let fault = format!("name: expected no more than {MOST} heads, where axes are two");
        faults.push(format!("[[ranging]] \"{}\": {fault}", last.name));
    }
    faults
}

#[cfg(test)]
mod tests {
    use insd_base::RangingBeam;

    use super::*;

    const SURVEY: &str = include_str!("../../../systemd/examples/survey.toml");
    const LASERS: &str = "
[[sensor]]
name = \"docking lasers\"
port = \"bridge-in\"
kind = \"ranging\"
[[point]]
name = \"bow\"
lever_m = [62.0, 0.0, 4.0]
[[point]]
name = \"stern\"
lever_m = [-58.0, 0.0, 4.0]
[docking]
bow = \"bow\"
stern = \"stern\"
[[berth]]
name = \"Pier 3\"
from_deg = [35.44, 139.65]
to_deg = [35.44, 139.6525]
std_m = 0.04
[[ranging]]
name = \"bow laser\"
sensor = \"docking lasers\"
head = 1
lever_m = [60.0, 11.0, 4.0]
berth = \"Pier 3\"
beam = \"ashore\"
at_m = 190.0
[[ranging]]
name = \"stern laser\"
sensor = \"docking lasers\"
head = 2
lever_m = [-58.0, 11.0, 4.0]
berth = \"Pier 3\"
[[ranging]]
name = \"anchor\"
sensor = \"docking lasers\"
head = 3
lever_m = [0.0, 0.0, -20.0]
point_deg = [35.441, 139.651]
height_m = 48.0
";

    fn with(from: &str, to: &str) -> String {
        assert!(LASERS.contains(from), "{from}");
        format!("{SURVEY}{}", LASERS.replacen(from, to, 1))
    }

    #[test]
    fn heads_on_one_berth_share_its_survey_and_an_anchor_has_its_own() {
        let config = Config::of_text(&with("beam", "beam")).unwrap();
        let specs = config.intake().rangings;
        assert_eq!(specs.iter().map(|own| own.mark).collect::<Vec<_>>(), [0, 0, 4]);
        let RangingTarget::Line(line) = specs[0].target else { panic!("{specs:?}") };
        assert_eq!((line.std, line.beam), (0.04, RangingBeam::Ashore(190.0)));
        assert_eq!(specs[1].lever, Body::new(-58.0, 11.0, 4.0));
        let RangingTarget::Point { place, std } = specs[2].target else { panic!("{specs:?}") };
        assert_eq!((place.height, std), (48.0, [0.1, 0.2]));
    }

    #[test]
    fn each_mistake_is_told_with_its_section_its_key_and_what_was_expected() {
        for (from, to, told) in [
            (
                "sensor = \"docking lasers\"",
                "sensor = \"laser\"",
                "[[ranging]] \"bow laser\": sensor: expected the name of a [[sensor]] of kind",
            ),
            ("head = 2", "head = 1", "head: expected a number that no other of its sensor has"),
            ("head = 1", "head = 0", "head: expected 1 to 999"),
            (
                "berth = \"Pier 3\"\nbeam",
                "berth = \"Pier 4\"\nbeam",
                "berth: expected the name of a [[berth]]",
            ),
            (
                "berth = \"Pier 3\"\nbeam",
                "beam",
                "line_deg: expected this, berth, point_deg or origin_deg",
            ),
            ("at_m = 190.0", "at_m = 1900.0", "at_m: expected a place on the line"),
            ("at_m = 190.0", "", "at_m: expected with beam = \"ashore\""),
            (
                "beam = \"ashore\"",
                "beam = \"aboard\"",
                "direction_deg: expected with beam = \"aboard\"",
            ),
            (
                "height_m = 48.0",
                "beam = \"aboard\"\ndirection_deg = 90.0",
                "beam: expected none to a point or between axes",
            ),
            (
                "point_deg = [35.441, 139.651]",
                "point_deg = [139.651, 35.441]",
                "point_deg: expected [latitude",
            ),
            (
                "point_deg = [35.441, 139.651]",
                "line_deg = [[35.4, 139.6], [35.4, 139.6]]",
                "line_deg: expected two points",
            ),
            ("head = 3", "head = 3\nstd_m = 0.0", "std_m: expected 0.001 to 100"),
        ] {
            let fault = Config::of_text(&with(from, to)).unwrap_err();
            assert!(fault.contains(told), "{from} -> {to}:\n{fault}");
        }
    }
}
