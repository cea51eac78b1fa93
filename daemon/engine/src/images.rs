//! Others who take the antenna to sit elsewhere than it is said to: as far below the IMU as above it, or anywhere.
//!
//! A sign that is easily got wrong, and worse than it looks: the swing of a mast that points down is that of one that
//! points up on a ship that is turned round, and a heading that is found by it is 180 deg off. The accelerometers,
//! which feel how the IMU itself sways, tell the two apart; and an antenna that swings far less than it would where it is said
//! to sit may sit anywhere. So while the heading is sought further filters of eight states have another lever arm
//! each, and the likelihood of what the receiver says decides.

use insd_alignment::EightState;
use insd_base::units::wrap_pi;
use insd_base::{Received, Solution, earth};
use insd_nav::config::LeverFound;
use insd_nav::{Estimator, Increment, NavConfig, Report};
use nalgebra::Vector3;

use crate::odds::{Likelihood, Odds};

/// A mast shorter than this, m, tells little by its swing.
const SHORTEST: f64 = 3.0;
/// 1-sigma of each component of a lever arm of which a sign was found wrong, m.
const UNSURE: f64 = 0.5;
/// Logarithm of the ratio of likelihoods from which on another lever arm is the right one, and of that from which on
/// it is not: installers get most lever arms right.
const OTHER: f64 = 14.0;
const NOT_OTHER: f64 = -10.0;
/// By so much it must be likelier than any further one, or a heading that was told wrongly.
pub(crate) const LEADS: f64 = 4.0;
/// Mean square of the innovations, of which one is expected, up to which it explains them all, and how many are asked for.
const HONEST: f64 = 1.6;
const ENOUGH: f64 = 100.0;
/// Whoever finds the heading knows it to this, 1-sigma, rad.
const FINDS: f64 = 0.5;
/// Headings apart by less than so many sigmas are the same.
const ALIKE: f64 = 3.0;

/// Whether both know the heading, and it is the same.
fn are_alike(one: &EightState, other: &EightState) -> bool {
    let ((a, a_sigma), (b, b_sigma)) = (one.heading(), other.heading());
    let is_same = wrap_pi(a - b).abs() < ALIKE * a_sigma.hypot(b_sigma);
    is_same && one.finished() && other.finished()
}

/// Which lever arm it is, as far as the heading goes.
#[derive(Clone, Debug)]
pub(crate) enum Verdict {
    /// Nobody can tell yet, and the headings differ.
    Open,
    /// The one that was told.
    AsTold,
    /// Another, and how much likelier that is than the one that was told.
    Other(Box<EightState>, f64),
    /// One far below the IMU, said to be above it: no sign is got wrong like that, but an IMU that is mirrored tells it.
    Mirrored,
}

/// A finder with another lever arm, and how much likelier that is.
#[derive(Clone, Debug)]
struct Image {
    finder: Box<EightState>,
    odds: Odds,
}

impl Image {
    /// Whether it takes the antenna to sit far below the IMU where it was told to sit far above it.
    fn is_below(&self, told: &EightState) -> bool {
        let height = |finder: &EightState| -finder.config().gnss_lever().z;
        height(&self.finder) < -SHORTEST && height(told) > SHORTEST
    }

    /// Whether it explains all that the receiver says.
    fn fits(&self) -> bool {
        self.odds.heard > ENOUGH && self.odds.misfit < HONEST * self.odds.heard
    }

    /// 1-sigma of each component of its lever arm, m.
    fn unsure(&self) -> f64 {
        self.finder.config().gnss.lever_found.map_or(0.0, |found| found.std)
    }

    fn knows_nothing(&self) -> bool {
        self.finder.config().gnss.lever_found == Some(LeverFound::UNKNOWN)
    }

    /// Whether both know the heading, and it is the same; an image is always like itself.
    fn is_alike(&self, other: &Image) -> bool {
        std::ptr::eq(self, other) || are_alike(&self.finder, &other.finder)
    }
}

/// All of them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Images(Vec<Image>);

impl Images {
    /// Those that begin as a finder with this configuration does; none where it matters little where the antenna sits. Alongside
    /// only the height swings, and whether the level components have the wrong signs too nobody can tell: so two know but the height, as it was told or mirrored.
    pub(crate) fn beside(config: &NavConfig, begin: impl Fn(&NavConfig) -> EightState) -> Self {
        let arm = config.gnss_lever();
        if config.gnss.lever_found.is_some() || config.is_gnss_lever_unknown() {
            return Images::default();
        }
        let (is_tall, level) = (arm.z.abs() > SHORTEST, arm.xy().norm());
        let mirrored = LeverFound { arm: Vector3::new(arm.x, arm.y, -arm.z), std: UNSURE };
        let of_height = |z: f64| LeverFound { arm: Vector3::new(0.0, 0.0, z), std: level };
        let is_long = is_tall && level > SHORTEST;
        let others = [
            (mirrored, is_tall),
            (of_height(-arm.z), is_long),
            (of_height(arm.z), is_long),
            (LeverFound::UNKNOWN, arm.norm() > SHORTEST),
        ];
        let image = |found: LeverFound| {
            let mut config = *config;
            config.gnss.lever_found = Some(found);
            Image { finder: Box::new(begin(&config)), odds: Odds::default() }
        };
        let that_matter = others.into_iter().filter(|(_, matters)| *matters);
        Images(that_matter.map(|(found, _)| image(found)).collect())
    }

    pub(crate) fn advance(&mut self, increment: &Increment) {
        self.0.iter_mut().for_each(|image| image.finder.advance(increment));
    }

    /// Hear what the finder with the lever arm that was told heard, and what that made of it.
    pub(crate) fn apply(&mut self, received: &Received, told: &Report) {
        let told = Likelihood::of(told);
        for image in &mut self.0 {
            let own = image.finder.apply(received);
            image.odds.weigh(&image.finder, &own, &told);
        }
        // of another antenna nothing was found
        self.0.retain(|image| image.finder.config().gnss.lever_found.is_some());
    }

    /// Which lever arm is right, beside the finder with the one that was told.
    pub(crate) fn judge(&self, told: &EightState) -> Verdict {
        let best = self.best();
        let rivals = self.0.iter().filter(|image| best.is_some_and(|best| !image.is_alike(best)));
        let next = rivals.map(|image| image.odds.logarithm).fold(f64::NEG_INFINITY, f64::max);
        match best {
            Some(best) if best.odds.logarithm > OTHER.max(next + LEADS) => self.verdict(best, told),
            _ if self.open(told).next().is_some() => Verdict::Open,
            _ => Verdict::AsTold,
        }
    }

    /// The likeliest; of those that find the same heading and are nearly as likely the one that claims least.
    fn best(&self) -> Option<&Image> {
        let likeliest =
            self.0.iter().max_by(|a, b| a.odds.logarithm.total_cmp(&b.odds.logarithm))?;
        let equals = self.0.iter().filter(|image| {
            image.is_alike(likeliest) && image.odds.logarithm > likeliest.odds.logarithm - LEADS
        });
        equals.max_by(|a, b| a.unsure().total_cmp(&b.unsure()))
    }

    /// Who is the likeliest of them, and how likely, beside the finder with the lever arm that was told.
    pub(crate) fn likeliest(&self, told: &EightState) -> Option<Verdict> {
        Some(self.verdict(self.best()?, told))
    }

    /// What follows if one is likelier than the lever arm that was told. An antenna far below the IMU is none, and one of which the height alone
    /// is right may be likelier than one that is wrong in another way: where it does not explain what is heard nothing is known of the antenna.
    fn verdict(&self, best: &Image, told: &EightState) -> Verdict {
        let is_below = best.is_below(told);
        if is_below && best.fits() {
            // whom it helps to find no heading it explains nothing
            let knows_heading = best.finder.heading().1 < FINDS && !best.finder.is_off_circle();
            return if knows_heading { Verdict::Mirrored } else { Verdict::Open };
        }
        let is_doubtful = is_below || best.unsure() > UNSURE && !best.fits();
        let vague = self.0.iter().find(|image| is_doubtful && image.knows_nothing());
        let chosen = vague.unwrap_or(best);
        Verdict::Other(chosen.finder.clone(), chosen.odds.logarithm)
    }

    /// Whether only a mirrored IMU explains what the receiver says.
    pub(crate) fn is_mirrored(&self, told: &EightState) -> bool {
        matches!(self.judge(told), Verdict::Mirrored)
    }

    /// Those that may be right and find another heading.
    fn open(&self, told: &EightState) -> impl Iterator<Item = &Image> {
        self.0
            .iter()
            .filter(|image| image.odds.logarithm > NOT_OTHER && !are_alike(&image.finder, told))
    }

    /// A solution of the finder with the lever arm that was told that covers those that may be right.
    pub(crate) fn covered(&self, told: &EightState, solution: Solution) -> Solution {
        let mut sigma = solution.sigma;
        for image in self.open(told) {
            let own = image.finder.solution();
            let apart = earth::ecef(&own.position).0 - earth::ecef(&solution.position).0;
            sigma.position.0 += (earth::c_ne(&solution.position) * apart).abs();
            sigma.heading += wrap_pi(own.attitude.heading - solution.attitude.heading).abs();
        }
        Solution { sigma, ..solution }
    }
}
