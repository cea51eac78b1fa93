//! The made-up ship and her berth: wherever she sails, here she comes alongside again and again.

use insd_web::snapshot::{Freshness, ShownContact, ShownDocking, ShownDockingPoint, ShownQuay};

use super::Scene;

/// The berths that there are.
pub(crate) const BERTHS: [&str; 2] = ["Pier 3", "Ölhafen 2"];
/// Half her beam, and how far bow and stern are from her middle, m.
const HALF: f64 = 11.0;
const END: f64 = 66.0;
/// Her middle along the quay, m, and the face of the fenders before it.
const MIDDLE: f64 = 118.0;
const FENDER: f64 = 1.2;

/// How she stands to the quay; `chosen` is the berth that somebody chose.
pub(super) fn docking(t: f64, scene: Scene, chosen: Option<&str>) -> ShownDocking {
    let told = scene == Scene::Underway;
    let why = match scene {
        Scene::Underway => None,
        Scene::Alignment => Some("the heading is not known yet".to_owned()),
        Scene::Fault => Some("the sensors contradict each other".to_owned()),
    };
    let quay = ShownQuay {
        length_m: Some(240.0),
        water: "right".to_owned(),
        fenders_m: (0..13).map(|k| [20.0 * f64::from(k), FENDER]).collect(),
        bollards_m: (0..9).map(|k| 30.0 * f64::from(k)).collect(),
    };
    let docking = ShownDocking {
        berth: chosen.unwrap_or(BERTHS[0]).to_owned(),
        choice: if chosen.is_some() { "chosen" } else { "nearest" }.to_owned(),
        state: if told { "valid" } else { "not_valid" }.to_owned(),
        why,
        valid_at_s: t - 0.004,
        freshness: Freshness::Fresh,
        contact_speed_limit_mps: Some(0.1),
        distance_limit_m: Some(5.0),
        quay,
        ..ShownDocking::default()
    };
    if told { alongside(t, docking) } else { docking }
}

fn alongside(t: f64, docking: ShownDocking) -> ShownDocking {
    let passed = t % 240.0;
    let (middle, angle) = (24.0 - 0.085 * passed, 1.6 - 0.006 * passed);
    let (sin, cos) = angle.to_radians().sin_cos();
    let (closing, turning, along) = (0.085, 0.000_105, 0.031);
    let point = |forward: f64, level: f64| ShownDockingPoint {
        distance_m: Some(middle - forward * sin),
        sigma_distance_m: Some(0.06),
        level_m: Some(level),
        closing_mps: Some(closing - forward * turning),
        sigma_closing_mps: Some(0.007),
        along_mps: Some(along),
        sigma_along_mps: Some(0.006),
        place_m: Some(MIDDLE + forward * cos + 0.031 * passed),
        above_m: None,
        sigma_above_m: None,
    };
    let manifold =
        ShownDockingPoint { above_m: Some(8.3), sigma_above_m: Some(0.2), ..point(4.0, 0.31) };
    let stern = point(-END, 0.44);
    let (far, speed) =
        (stern.distance_m.unwrap_or_default(), stern.closing_mps.unwrap_or_default());
    let corner = |forward: f64, side: f64| {
        let (x, y) =
            (forward * cos - side * sin, HALF + middle + FENDER - forward * sin + side * cos);
        [MIDDLE + x + 0.031 * passed, y]
    };
    ShownDocking {
        side: Some("port".to_owned()),
        angle_deg: Some(angle),
        sigma_angle_deg: Some(0.062),
        bow: Some(point(END, 0.44)),
        contact: Some(ShownContact {
            part: "stern".to_owned(),
            speed_mps: Some(speed),
            sigma_speed_mps: Some(0.007),
            in_s: Some(far / speed),
            sigma_in_s: Some(far / speed * 0.08),
        }),
        stern: Some(stern),
        manifold: Some(manifold),
        outline_m: vec![
            corner(80.0, 0.0),
            corner(END, HALF),
            corner(-76.0, HALF),
            corner(-76.0, -HALF),
            corner(END, -HALF),
        ],
        ..docking
    }
}
