//! A case: the voyage, the lie that was drawn for it, and what is asked.

use insd_base::units::{DEG, wrap_two_pi};
use insd_base::{ExternalReference, GnssFix, Stamped, Voyage};
use nalgebra::Vector3;

use super::draw::Draw;
use super::evidence::{heading_shown_in, shown_after};
use super::gnss::moved;
use super::kinds::{Asked, LieKind, Strike};
use super::{Class, CompassLie, Culprit, Grade, Lie, Suite, Told};
use crate::random::{GaussMarkov, Purpose, normal, normal3, stream};
use crate::{Scenario, ScenarioError, further_receiver, simulate};

/// The voyage of all cases, s; she sails after five minutes.
const LASTS: f64 = 3600.0;
/// 1-sigma of a compass that tells the truth, rad.
const COMPASS: f64 = 0.3 * DEG;
/// The second receiver's slow and white errors, 1-sigma of each component, m, and the slow one's time
/// constant, s.
const SECOND: [f64; 3] = [1.0, 0.5, 100.0];

/// The scenario, but for the grade of the IMU and whether there is a log.
const SCENARIO: &str = include_str!("voyage.toml");

/// What was drawn, and what is asked.
#[derive(Clone, Debug)]
pub struct Case {
    /// Its kind.
    pub kind: &'static str,
    /// Of the IMU.
    pub grade: Grade,
    /// The sensors beside it.
    pub suite: Suite,
    /// What was drawn, for people.
    pub size: String,
    /// Everything that is told wrongly.
    pub told: Vec<Told>,
    /// What is asked.
    pub class: Class,
    /// Whether the liar must be named.
    pub is_named: bool,
    /// When the others can show it, s.
    pub shown_at: Option<f64>,
    /// From when on it is judged, s.
    pub judged_from: f64,
    /// Whether she is said to lie at her berth at the start, and not just to be under way.
    is_moored: bool,
    seed: u64,
}

/// The case of a kind with these sensors that a seed draws.
#[must_use]
pub fn case(kind: &LieKind, grade: Grade, suite: Suite, seed: u64) -> Case {
    let own = kind.name.bytes().fold(seed, |sum, byte| sum.wrapping_mul(31) ^ u64::from(byte));
    let mut draw = Draw { rng: stream(own, Purpose::Lies), grade, suite };
    let Strike { told, size, asked, judged_from, is_moored } = (kind.draw)(&mut draw);
    let first = told.iter().map(|told| told.window.from).fold(f64::INFINITY, f64::min);
    let (class, shown_at, is_named) = match asked {
        Asked::ByEvidence { off, velocity_is_honest } => {
            let lasts = told.iter().map(|told| told.window.until.min(LASTS) - first);
            let lasts = lasts.fold(0.0, f64::max);
            let after = shown_after(grade, suite, velocity_is_honest, off, lasts);
            let carried = if suite.has_log() { Class::Required } else { Class::Told };
            let class = after.map_or(Class::Bounded, |_| carried);
            (class, after.map(|after| first + after), true)
        }
        Asked::Unshown => (Class::Bounded, None, false),
        Asked::After { seconds } => (Class::Required, Some(first + seconds), true),
        Asked::Of { class, is_named } => (class, Some(first), is_named),
    };
    Case {
        kind: kind.name,
        grade,
        suite,
        size,
        told,
        class,
        is_named,
        shown_at,
        judged_from,
        is_moored,
        seed,
    }
}

impl Case {
    /// The voyage with honest sensors.
    ///
    /// # Errors
    /// The scenario of this module is not one.
    pub fn honest(&self) -> Result<Voyage, ScenarioError> {
        let mut voyage = simulate(&self.scenario("")?, self.seed);
        if self.suite.has_compass() {
            voyage.reference = compass(&voyage, self.seed);
        }
        if self.suite.has_second() {
            voyage.reference = second(&voyage, self.seed);
        }
        Ok(voyage)
    }

    /// The fixes of a further honest receiver on the same voyage; `gnss` are keys of the section `[gnss]` of a
    /// scenario, `number`, from 1, decides its errors.
    ///
    /// # Errors
    /// The keys are none.
    pub fn receiver(
        &self,
        gnss: &str,
        number: u32,
    ) -> Result<Vec<Stamped<GnssFix>>, ScenarioError> {
        Ok(further_receiver(&self.scenario("")?, self.seed, number, &self.scenario(gnss)?))
    }

    /// The scenario, its receiver with more keys.
    fn scenario(&self, gnss: &str) -> Result<Scenario, ScenarioError> {
        let grade = match self.grade {
            Grade::Navigation => "navigation",
            Grade::Mems => "mems",
        };
        let log = if self.suite.has_log() { "\n[log]\n" } else { "" };
        let mode = if self.is_moored { "moored" } else { "underway" };
        let moored = if self.is_moored { "moored = true" } else { "" };
        let text = SCENARIO.replace("GRADE", grade).replace("MODE", mode).replace("MOORED", moored);
        let text = text + gnss + log;
        Scenario::from_toml(&text)
    }

    /// The same with everything in it that is told wrongly.
    #[must_use]
    pub fn spoilt(&self, honest: &Voyage) -> Voyage {
        let mut voyage = honest.clone();
        let mut rng = stream(self.seed, Purpose::Lying);
        self.told.iter().for_each(|told| told.spoil(&mut voyage, &mut rng));
        voyage
    }

    /// The same case with the moment at which the others can show the lie where only the voyage tells that: a compass that is mirrored is
    /// not off before she turns.
    #[must_use]
    pub fn shown_in(self, honest: &Voyage, spoilt: &Voyage) -> Self {
        let is_mirrored = |told: &Told| told.lie == Lie::Compass(CompassLie::Mirrored);
        if !self.told.iter().any(is_mirrored) {
            return self;
        }
        Case { shown_at: heading_shown_in(self.grade, self.suite, honest, spoilt), ..self }
    }

    /// Everybody who tells something wrong.
    #[must_use]
    pub fn culprits(&self) -> Vec<Culprit> {
        self.told.iter().filter(|told| told.lie != Lie::Outage).map(Told::culprit).collect()
    }

    /// When the last of it has healed, s, if it does.
    #[must_use]
    pub fn healed_at(&self) -> Option<f64> {
        let until = self.told.iter().map(|told| told.window.until).fold(0.0, f64::max);
        until.is_finite().then_some(until)
    }
}

/// What an honest compass tells on a voyage, once a second.
#[must_use]
pub fn compass(voyage: &Voyage, seed: u64) -> Vec<Stamped<ExternalReference>> {
    let mut rng = stream(seed, Purpose::Compass);
    let rows = voyage.truth.iter().filter_map(|truth| Some((truth.time, truth.attitude?)));
    let told = rows.map(|(time, attitude)| ExternalReference {
        time,
        heading: Some(wrap_two_pi(attitude.heading + COMPASS * normal(&mut rng))),
        heading_std: Some(COMPASS),
        ..ExternalReference::default()
    });
    told.map(Stamped::prompt).collect()
}

fn second(voyage: &Voyage, seed: u64) -> Vec<Stamped<ExternalReference>> {
    let mut rng = stream(seed, Purpose::SecondReceiver);
    let [slow, white, time] = SECOND;
    let own = stream(seed ^ 1, Purpose::SecondReceiver);
    let mut drifting = GaussMarkov::new(Vector3::repeat(slow), time, own);
    let mut before: Option<insd_base::Time> = None;
    let told = voyage.truth.iter().map(|truth| {
        let elapsed = before.map_or(0.0, |before| (truth.time - before).as_seconds());
        before = Some(truth.time);
        let off = drifting.advance(elapsed) + normal3(&mut rng) * white;
        ExternalReference {
            time: truth.time,
            position: Some(moved(&truth.position, &Vector3::new(off.x, off.y, 0.0))),
            position_std: Some(slow.hypot(white)),
            ..ExternalReference::default()
        }
    });
    told.map(Stamped::prompt).collect()
}
