//! Single points and carrier differences of real receivers against where they were: one table.
//!
//! ```text
//! INSD_RAW_GNSS=... cargo run --release -p insd-tests --example satellites -- docs/satellites.md
//! ```
//!
//! The folder holds the sets that docs/satellites.md names. Without a page the table is printed.

mod sets;

use std::error::Error;
use std::path::PathBuf;

use insd_base::{Ecef, GpsTime, SatelliteEpoch, Span, earth};
use insd_gnss::{CarrierDisplacement, CarrierTracker, Context, SinglePoint};
use insd_tests::pages;
use nalgebra::Vector3;

use sets::{SETS, Set, Whereabouts};

const HEAD: &str = "| set, constellations, bands | epochs | single point, horizontal RMS, m (RTKLIB) | vertical RMS | NEES | carrier differences \
    accumulated, horizontal RMS, mm (plain least squares) | slips found |\n|---|---|---|---|---|---|---|\n";

fn main() -> Result<(), Box<dyn Error>> {
    let folder =
        std::env::var_os("INSD_RAW_GNSS").ok_or("INSD_RAW_GNSS: the folder of the sets")?;
    let folder = PathBuf::from(folder);
    let mut table = HEAD.to_owned();
    for set in &SETS {
        let row = Judged::of(set, &folder)?.row(set);
        eprint!("{row}");
        table += &row;
    }
    Ok(pages::put(std::env::args().nth(1), "satellites", &table)?)
}

/// What was found of a set.
#[derive(Default)]
struct Judged {
    points: Vec<(Vector3<f64>, f64)>,
    accumulated: Vec<f64>,
    slips: usize,
}

impl Judged {
    fn of(set: &Set, folder: &std::path::Path) -> Result<Self, Box<dyn Error>> {
        let context = set.context(folder)?;
        let truth = set.truth(folder)?;
        let mut judged = Judged::default();
        let mut carrier = Carrier::default();
        for epoch in set.epochs(folder)? {
            let Some(place) = truth.at(epoch.tag) else { continue };
            judged.note_point(&context, &epoch, &place);
            let turned = truth.turned(epoch.tag);
            carrier.advance(&context, &epoch, (&place, turned), &mut judged);
        }
        Ok(judged)
    }

    fn note_point(&mut self, context: &Context, epoch: &SatelliteEpoch, place: &Vector3<f64>) {
        let Ok(point) = SinglePoint::solve(context, epoch, None) else { return };
        let off = point.position - place;
        let Some(information) = point.covariance.try_inverse() else { return };
        let nees = (off.transpose() * information * off)[0] / 3.0;
        self.points.push((enu(place, &off), nees));
    }

    fn row(&self, set: &Set) -> String {
        let horizontal = rms(self.points.iter().map(|(off, _)| off.xy().norm()));
        let vertical = rms(self.points.iter().map(|(off, _)| off.z));
        let nees = self.points.iter().map(|(_, nees)| nees).sum::<f64>() / self.points.len() as f64;
        let accumulated = rms(self.accumulated.iter().copied()) * 1e3;
        let plain = set.plain_mm.map_or(String::new(), |plain| format!(" ({plain})"));
        format!(
            "| {} | {} | {horizontal:.2} ({:.2}) | {vertical:.2} | {nees:.2} | {accumulated:.0}{plain} | {} |\n",
            set.label,
            self.points.len(),
            set.rtklib_m,
            self.slips,
        )
    }
}

/// An antenna that is followed by phase alone from where it was at first.
#[derive(Default)]
struct Carrier {
    tracker: CarrierTracker,
    place: Option<Vector3<f64>>,
}

impl Carrier {
    fn advance(
        &mut self,
        context: &Context,
        epoch: &SatelliteEpoch,
        (truth, turned): (&Vector3<f64>, f64),
        judged: &mut Judged,
    ) {
        let before = self.place.unwrap_or(*truth);
        let changes = self.tracker.advance(context, epoch, &before, turned);
        let moved = CarrierDisplacement::solve(&changes, &before);
        judged.slips += moved.as_ref().map_or(0, |moved| moved.slipped.len());
        let now = before + moved.map_or_else(Vector3::zeros, |moved| moved.displacement);
        if self.place.is_some() {
            judged.accumulated.push(enu(truth, &(now - truth)).xy().norm());
        }
        self.place = Some(now);
    }
}

fn enu(at: &Vector3<f64>, off: &Vector3<f64>) -> Vector3<f64> {
    let ned = earth::c_ne(&earth::geodetic(&Ecef(*at))) * off;
    Vector3::new(ned.y, ned.x, -ned.z)
}

fn rms(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    (values.map(|value| value * value).sum::<f64>() / count).sqrt()
}

impl Whereabouts {
    /// By what the antenna turned in the second before an instant, rad, clockwise, as its course did; a car points where it goes.
    fn turned(&self, tag: GpsTime) -> f64 {
        let earlier = |seconds: f64| self.at(tag.plus(Span::from_seconds(-seconds)));
        let course = |from: Vector3<f64>, to: Vector3<f64>| {
            let way = enu(&to, &(to - from)).xy();
            (way.norm() > 0.5).then(|| way.x.atan2(way.y))
        };
        let (Some(two), Some(one), Some(now)) = (earlier(2.0), earlier(1.0), earlier(0.0)) else {
            return 0.0;
        };
        let turn = course(two, one).zip(course(one, now)).map(|(before, after)| after - before);
        turn.map_or(0.0, |turn| turn.sin().atan2(turn.cos()))
    }
}
