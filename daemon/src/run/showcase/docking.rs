//! How the ship stands to a berth.

use insd_base::units::DEG;
use insd_config::Config;
use insd_output::docking::{DockingPoint, HullPart, WaterSide};
use insd_web::snapshot::{Freshness, ShownContact, ShownDocking, ShownDockingPoint, ShownQuay};

use crate::run::report::Alongside;

/// What is shown of it.
pub(super) fn docking(config: &Config, alongside: &Alongside) -> Option<ShownDocking> {
    let Alongside { docking, outline } = alongside;
    let quay = config.berths.get(docking.berth)?.quay();
    let point = |part: HullPart| docking.point(part).map(shown_point);
    let limits = &config.docking;
    Some(ShownDocking {
        choice: docking.choice.as_str().to_owned(),
        state: docking.state.as_str().to_owned(),
        why: docking.state.why().map(str::to_owned),
        valid_at_s: docking.time.as_seconds(),
        freshness: Freshness::Fresh,
        side: docking.side.map(|side| side.as_str().to_owned()),
        angle_deg: docking.angle.map(|own| own.value / DEG),
        sigma_angle_deg: docking.angle.map(|own| own.sigma / DEG),
        bow: point(HullPart::Bow),
        stern: point(HullPart::Stern),
        manifold: point(HullPart::Manifold),
        contact: docking.contact.map(|own| ShownContact {
            part: own.part.as_str().to_owned(),
            speed_mps: Some(own.speed.value),
            sigma_speed_mps: Some(own.speed.sigma),
            in_s: Some(own.seconds.value),
            sigma_in_s: Some(own.seconds.sigma),
        }),
        contact_speed_limit_mps: limits.contact_speed_mps,
        distance_limit_m: limits.distance_m,
        quay: ShownQuay {
            length_m: Some(quay.length()),
            water: match quay.water {
                WaterSide::Right => "right",
                WaterSide::Left => "left",
            }
            .to_owned(),
            fenders_m: quay.fenders.iter().map(|own| [own.at, own.off]).collect(),
            bollards_m: quay.bollards,
        },
        outline_m: if docking.side.is_some() { outline.clone() } else { Vec::new() },
        berth: quay.name,
    })
}

fn shown_point(point: &DockingPoint) -> ShownDockingPoint {
    ShownDockingPoint {
        distance_m: Some(point.distance.value),
        sigma_distance_m: Some(point.distance.sigma),
        level_m: Some(point.level),
        closing_mps: Some(point.closing.value),
        sigma_closing_mps: Some(point.closing.sigma),
        along_mps: Some(point.along.value),
        sigma_along_mps: Some(point.along.sigma),
        place_m: Some(point.place),
        above_m: point.above.map(|own| own.value),
        sigma_above_m: point.above.map(|own| own.sigma),
    }
}

#[cfg(test)]
mod tests {
    use insd_base::{
        Attitude, Body, Geodetic, Judgement, Mode, Motion, MotionCovariance, Ned, Protection,
        Solution, SolutionSigma, Time,
    };
    use insd_output::docking::BerthDesk;

    use super::*;

    const SHIPPED: &str = include_str!("../../../../systemd/examples/simulated.toml");
    const BERTH: &str = "
[[point]]
name = \"bow\"
lever_m = [50.0, 0.0, 4.0]
[[point]]
name = \"stern\"
lever_m = [-50.0, 0.0, 4.0]
[docking]
bow = \"bow\"
stern = \"stern\"
manifold = \"bow\"
beam_m = 20.0
contact_speed_mps = 0.1
[[berth]]
name = \"Pier 3\"
from_deg = [54.0, 8.0]
to_deg = [54.0, 8.003]
fender_m = 1.0
height_m = 3.0
";

    fn motion(mode: Mode) -> Motion {
        let sigmas = [0.1, 0.1, 0.2, 0.01, 0.01, 0.01, 0.001, 0.001, 0.002_f64];
        let covariance = MotionCovariance::from_diagonal(&sigmas.map(|own| own * own).into());
        let solution = Solution {
            time: Time::from_seconds(7.0),
            position: Geodetic::from_degrees(53.9997, 8.0015, 9.0),
            velocity: Ned::new(0.2, 0.3, 0.0),
            attitude: Attitude { roll: 0.0, pitch: 0.0, heading: 88.0 * DEG },
            rate: Body::default(),
            sigma: SolutionSigma::of_variances(&covariance.diagonal()),
            mode,
            judgement: Judgement::default(),
            source: None,
            hidden: Protection::default(),
        };
        Motion { solution, acceleration: None, covariance: Some(covariance), current: None }
    }

    /// What is reckoned of a motion, and what is shown of it.
    fn both(mode: Mode) -> (Alongside, ShownDocking) {
        let config = Config::of_text(&format!("{SHIPPED}{BERTH}")).unwrap();
        let mut desk = BerthDesk::new(config.output_plan().berths);
        let motion = motion(mode);
        desk.note(&motion.solution.position);
        let docking = desk.look(Some(&motion), motion.solution.time).unwrap();
        let alongside = Alongside { docking, outline: desk.plan(&motion) };
        let shown = docking_of(&config, &alongside);
        (alongside, shown)
    }

    fn docking_of(config: &Config, alongside: &Alongside) -> ShownDocking {
        docking(config, alongside).unwrap()
    }

    #[test]
    fn what_is_shown_of_a_berth_is_what_was_reckoned() {
        let (Alongside { docking, outline }, shown) = both(Mode::Aided);
        assert_eq!((shown.berth.as_str(), shown.choice.as_str()), ("Pier 3", "nearest"));
        assert_eq!((shown.state.as_str(), shown.why), ("valid", None));
        assert_eq!((shown.side.as_deref(), shown.valid_at_s), (Some("port"), 7.0));
        assert!((shown.angle_deg.unwrap() - 2.0).abs() < 0.01, "{:?}", shown.angle_deg);
        for (part, shown) in HullPart::ALL.iter().zip([shown.bow, shown.stern, shown.manifold]) {
            let (own, shown) = (docking.point(*part).unwrap(), shown.unwrap());
            assert_eq!(shown.distance_m, Some(own.distance.value));
            assert_eq!(shown.sigma_distance_m, Some(own.distance.sigma));
            assert_eq!(shown.level_m, Some(own.level));
            assert_eq!(shown.closing_mps, Some(own.closing.value));
            assert_eq!(shown.along_mps, Some(own.along.value));
            assert!((shown.above_m.unwrap() - (9.0 - 4.0 - 3.0)).abs() < 0.01);
        }
        assert_eq!(shown.contact.unwrap().in_s, Some(docking.contact.unwrap().seconds.value));
        assert_eq!((shown.outline_m.len(), shown.outline_m), (4, outline));
        assert_eq!(
            (shown.quay.fenders_m, shown.contact_speed_limit_mps),
            (vec![[0.0, 1.0]], Some(0.1))
        );
    }

    #[test]
    fn what_is_not_known_is_not_shown() {
        let (_, shown) = both(Mode::FineAlignment);
        assert_eq!(
            (shown.state.as_str(), shown.why.as_deref()),
            ("not_valid", Some("the heading is not known yet"))
        );
        assert_eq!((shown.bow, shown.angle_deg, shown.contact), (None, None, None));
        assert!(shown.outline_m.is_empty() && shown.quay.length_m.is_some());
    }
}
