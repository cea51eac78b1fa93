//! What the estimate would be if a constant of the installation were other than configured: the lever
//! arm of the antenna, the delay of its epochs, or the lever arm of the log.
//!
//! The filter takes these constants as known, to millimetres where they were measured, and cannot doubt
//! them: a mast on the wrong side makes it doubt the receiver. So what a wrong constant does to it is
//! carried along beside it. With b the error of the constants, true minus configured, and U its effect
//! on the errors of the estimate,
//!
//! E\[x\] = U b,   U <- Phi U,   E\[z\] = G b,   G = H U + D,   U <- U - K G,
//!
//! D what the constants do to a measurement itself, with the gains that were really used, K = 0 where a
//! measurement was refused. The filter's innovations then tell b by least squares, the information growing by
//! G^T S^-1 G and the evidence by G^T S^-1 z, and the estimate that another b would have led to is x + U b (Friedland, Treatment of Bias in
//! Recursive Filtering, IEEE Transactions on Automatic Control AC-14 (1969), eqs. (13)-(27); as a test:
//! Willsky and Jones, A Generalized Likelihood Ratio Approach, AC-21 (1976)).
//!
//! A constant is found wrong when it explains what the innovations are off by: the likelihood with it is
//! greater by far, and with it the innovations are about what they should be. A receiver that lies or a
//! gyro that fails is not explained by where the antenna sits.

mod finding;

pub use finding::ConstantsFinding;

use insd_base::attitude::skew;
use insd_estimation::Layout;
use nalgebra::{Cholesky, Const, DMatrix, Matrix3, RowVector3, SMatrix, SVector, Vector3};

use crate::aids::View;
use crate::error_state::{
    Block, Covariance, Effects, Errors, GNSS_DELAY, GNSS_LEVER, POSITION, VELOCITY, Weighed,
};
use crate::trust::FAULT;

/// Constants that are doubted: the lever arm of the antenna, three components, m; the delay, s; the lever
/// arm of the log, m.
pub const CONSTANTS: usize = 7;
const DELAY_AT: usize = 3;
/// Those before it are of the antenna, and all that there are on a ship whose log has never spoken.
const LOG_AT: usize = 4;

/// One value for each constant.
pub type Constants = SVector<f64, CONSTANTS>;
/// The covariance of the constants.
pub type ConstantsCovariance = SMatrix<f64, CONSTANTS, CONSTANTS>;

const fn hypothesis(lever: f64, delay: f64, log: f64) -> Constants {
    SVector::from_array_storage(nalgebra::ArrayStorage([[
        lever, lever, lever, delay, log, log, log,
    ]]))
}

/// What a lever arm may be off by, 1-sigma, m: the longest of masts.
const LEVER: f64 = 50.0;
/// What the delay may be, 1-sigma, s: more than any receiver needs for a fix.
pub const DELAY: f64 = 1.0;
/// A constant that is not doubted.
const CERTAIN: f64 = 1e-9;
/// What may be wrong: the lever arm of the antenna, the delay, or both; that of the log, or of both sensors.
const HYPOTHESES: [Constants; 5] = [
    hypothesis(LEVER, CERTAIN, CERTAIN),
    hypothesis(CERTAIN, DELAY, CERTAIN),
    hypothesis(LEVER, DELAY, CERTAIN),
    hypothesis(CERTAIN, CERTAIN, LEVER),
    hypothesis(LEVER, CERTAIN, LEVER),
];
/// How many of them are of the antenna alone.
const OF_ANTENNA: usize = 3;
/// Errors smaller than these are the business of the filter's own sigmas, m and s.
const LEAST: Constants = hypothesis(1.0, 0.1, 1.0);
/// Logarithm of the ratio of likelihoods from which on a hypothesis is believed.
const CONVINCING: f64 = 30.0;
/// Mean square of the innovations (one is expected) that a hypothesis may leave unexplained.
const UNEXPLAINED: f64 = 5.0;
/// Share of what the innovations are off by that it must explain: the rest is somebody else's fault, and then
/// most likely all of it is.
const SHARE: f64 = 0.7;
/// An error is one beyond so many of its sigmas.
const SIGNIFICANT: f64 = 6.0;
/// Quantities that must have been heard.
const FEWEST: f64 = 60.0;
/// Quantities that the memory spans.
const SPAN: f64 = 3600.0;
/// Quantities that make a moment.
const MOMENT: f64 = 600.0;
/// A lever arm of which an error so large would have shown is confirmed, each component, 1-sigma, m.
const CONFIRMED: f64 = 0.5;
/// Share of a correction that it is unsure of, as what it does to the estimate is not quite linear.
const BENT: f64 = 0.05;

/// What the lever arm of the log does to a measurement itself, of which `by_lever` is the derivative.
fn of_log_lever(by_lever: &DMatrix<f64>) -> DMatrix<f64> {
    let mut direct = DMatrix::zeros(CONSTANTS, by_lever.nrows());
    direct.fixed_rows_mut::<3>(LOG_AT).copy_from(&by_lever.transpose());
    direct
}

/// The effect of the constants on the estimate, and what the innovations say of them.
#[derive(Clone, Debug, PartialEq)]
pub struct SeparateBias {
    /// What a unit of each constant does to the errors of the estimate; those of the log from its first word on.
    response: Effects,
    information: ConstantsCovariance,
    evidence: Constants,
    /// Sum of the normalised squares of the innovations, and how many there were.
    misfit: f64,
    heard: f64,
    /// Mean of the squares of late, none of them counting for more than a fault.
    strain: f64,
    /// Which share of the horizontal position did not come from the receiver, once that is known.
    surveyed: Option<f64>,
}

/// How a hypothesis fits.
struct Fit {
    /// Logarithm of the ratio of likelihoods.
    score: f64,
    /// Mean square of the innovations that it leaves unexplained.
    left: f64,
    /// What it finds in units of the prior sigmas, with the factor of its information.
    solved: Constants,
    factor: Cholesky<f64, Const<CONSTANTS>>,
    prior: Constants,
}

impl Fit {
    fn finding(&self) -> ConstantsFinding {
        let prior = &self.prior;
        let covariance = self.factor.inverse().component_mul(&(prior * prior.transpose()));
        ConstantsFinding {
            value: self.solved.component_mul(prior),
            covariance: covariance * self.left,
        }
    }
}

impl SeparateBias {
    /// The filter's position has come from the receiver by way of the configured constants, its
    /// velocity has not.
    #[must_use]
    pub fn new(view: &View) -> Self {
        let mut response = Effects::none(LOG_AT);
        response.set(0, GNSS_LEVER, &Matrix3::identity());
        response.set(DELAY_AT, GNSS_DELAY, &SMatrix::<f64, 1, 1>::identity());
        let mut bias = SeparateBias {
            response,
            information: ConstantsCovariance::zeros(),
            evidence: Constants::zeros(),
            misfit: 0.0,
            heard: 0.0,
            strain: 0.0,
            surveyed: Some(0.0),
        };
        bias.place(view, &Vector3::repeat(1.0));
        bias
    }

    /// The same of a filter of which it is not known where its position has come from.
    #[must_use]
    pub fn of_unknown_origin(view: &View) -> Self {
        let mut bias = SeparateBias { surveyed: None, ..SeparateBias::new(view) };
        bias.place(view, &Vector3::zeros());
        bias
    }

    /// Whether it is known where the position has come from.
    #[must_use]
    pub fn knows_origin(&self) -> bool {
        self.surveyed.is_some()
    }

    /// Where the position has come from: a share of each of its components, NED, from the receiver.
    pub fn came_from(&mut self, view: &View, share: &Vector3<f64>) {
        self.place(view, share);
        self.surveyed = Some(1.0 - share.xy().max());
    }

    /// Which share of the horizontal position did not come from the receiver; nothing while that is not known.
    #[must_use]
    pub fn surveyed(&self) -> f64 {
        self.surveyed.unwrap_or(0.0)
    }

    /// The position has been set to what the receiver says, a share of each of its components, NED:
    /// r = p - C_eb l + v tau.
    fn place(&mut self, view: &View, share: &Vector3<f64>) {
        let taken = view.c_ne.transpose() * Matrix3::from_diagonal(share) * view.c_ne;
        let by_delay = (taken * view.nominal.velocity).transpose();
        self.set(POSITION, &-(taken * view.c_eb).transpose(), &by_delay);
    }

    /// The velocity has been set to what the receiver says: v = v_a - C_eb (omega x l) + a tau, with the
    /// `acceleration` of the antenna in ECEF axes, m/s^2.
    pub fn start(&mut self, view: &View, acceleration: &Vector3<f64>) {
        let by_lever = -(view.c_eb * skew(&view.rate)).transpose();
        self.set(VELOCITY, &by_lever, &acceleration.transpose());
    }

    /// What was heard of late is somebody else's fault, and the estimate is another now: what is known of the
    /// constants stays, and nothing speaks against them.
    pub fn excuse(&mut self, view: &View) {
        let before = std::mem::replace(self, SeparateBias::new(view));
        self.information = before.information;
        (self.heard, self.misfit, self.strain) = (before.heard, before.heard, 1.0);
    }

    fn set(&mut self, block: Block<3>, by_lever: &Matrix3<f64>, by_delay: &RowVector3<f64>) {
        self.response.set(0, block, by_lever);
        self.response.set(DELAY_AT, block, by_delay);
    }

    /// The effect on the errors, to be carried along with them.
    pub fn response_mut(&mut self) -> &mut Effects {
        &mut self.response
    }

    /// The same on the errors of these states.
    fn response_on(&mut self, layout: &Layout) -> &mut Effects {
        self.response.conform(layout);
        &mut self.response
    }

    /// The unit of a block of states has grown: their numbers are what they were, times a factor.
    pub fn rescale<const W: usize>(&mut self, block: Block<W>, factor: f64) {
        self.response.scale_block(block, factor);
    }

    /// Hears an innovation of GNSS, used or not, before it is absorbed. What it is off by below `least` strains
    /// nothing, 1-sigma of each component: receivers state what they resolve, and clocks and masts are not that stiff.
    pub fn hear(&mut self, weighed: &Weighed, least: f64) {
        let sigma = weighed.sigma().map(|sigma| sigma.hypot(least));
        let rows = weighed.rows() as f64;
        let strains = weighed.z().component_div(&sigma).norm_squared() / rows;
        let mean_square = strains.min(weighed.nis() / rows);
        self.weigh_in(weighed, DMatrix::zeros(self.response.causes(), weighed.rows()));
        self.strain += (mean_square.min(FAULT) - self.strain) * (rows / self.heard.min(MOMENT));
    }

    /// Hears an innovation of the log, used or not, before it is absorbed; `by_lever` is its derivative with
    /// respect to the lever arm of the log, which is no state of the filter.
    pub fn hear_log(&mut self, weighed: &Weighed, by_lever: &DMatrix<f64>) {
        self.response.widen(CONSTANTS);
        self.weigh_in(weighed, of_log_lever(by_lever));
    }

    /// The log was absorbed: the error of its lever arm came with it.
    pub fn absorb_log(&mut self, weighed: &Weighed, by_lever: &DMatrix<f64>) {
        self.response.widen(CONSTANTS);
        let response = self.response_on(weighed.layout());
        weighed.pass_on(response, &weighed.whiten(of_log_lever(by_lever)));
    }

    /// An innovation is absorbed: what the constants did to it comes with it.
    pub fn absorb(&mut self, weighed: &Weighed) {
        let response = self.response_on(weighed.layout());
        let none = DMatrix::zeros(response.causes(), weighed.rows());
        let effect = weighed.effect_of(response, none);
        weighed.pass_on(response, &effect);
    }

    /// The same of one that is absorbed with another gain than the best.
    pub fn absorb_by(&mut self, weighed: &Weighed, gain: &DMatrix<f64>) {
        let response = self.response_on(weighed.layout());
        let none = DMatrix::zeros(response.causes(), weighed.rows());
        let effect = weighed.effect_of(response, none);
        weighed.pass_on_by(response, &effect, gain);
    }

    fn weigh_in(&mut self, weighed: &Weighed, direct: DMatrix<f64>) {
        let response = self.response_on(weighed.layout());
        let effect = weighed.effect_of(response, direct);
        let z = weighed.whitened();
        let (causes, rows) = (effect.nrows(), weighed.rows() as f64);
        let kept = 1.0 - rows / SPAN;
        self.information *= kept;
        let mut told = self.information.view_mut((0, 0), (causes, causes));
        told += &effect * effect.transpose();
        self.evidence *= kept;
        let mut told = self.evidence.rows_mut(0, causes);
        told += &effect * &z;
        self.misfit = self.misfit * kept + z.norm_squared();
        self.heard = self.heard * kept + rows;
    }

    /// Whether the configured lever arm has been confirmed: nothing speaks against it, and if it were wrong
    /// something would.
    #[must_use]
    pub fn is_confirmed(&self) -> bool {
        let prior = &HYPOTHESES[0];
        self.factor(prior).is_some_and(|factor| {
            let unsure = factor.inverse();
            (0..3).all(|i| unsure[(i, i)] * prior[i] * prior[i] < CONFIRMED * CONFIRMED)
        })
    }

    /// Mean square of the latest innovations, of which one is expected, each counted as a fault at most;
    /// `None` before there are enough of them.
    #[must_use]
    pub fn strain(&self) -> Option<f64> {
        (self.heard >= FEWEST).then_some(self.strain)
    }

    /// The same from the first innovation on, however few there are; zero before.
    #[must_use]
    pub fn early_strain(&self) -> f64 {
        self.strain
    }

    /// What is found to be wrong, if anything is.
    #[must_use]
    pub fn finding(&self) -> Option<ConstantsFinding> {
        let fits = self.misfit <= self.heard;
        if fits || self.heard < FEWEST {
            return None;
        }
        let weighed = self.hypotheses().iter().filter_map(|prior| self.weigh(prior));
        let (_, finding) = weighed.max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(finding)
    }

    /// Whether a hypothesis explains what the innovations are off by, be it too early to find it.
    #[must_use]
    pub fn is_suspicious(&self) -> bool {
        let mut all = self.hypotheses().iter().filter_map(|prior| self.fit(prior));
        self.misfit > self.heard && all.any(|fit| fit.score > 0.0 && self.is_explained(&fit))
    }

    /// Whether a hypothesis leaves little of what the innovations are off by.
    fn is_explained(&self, fit: &Fit) -> bool {
        let excess = self.misfit / self.heard - 1.0;
        fit.left < UNEXPLAINED && fit.left - 1.0 < (1.0 - SHARE) * excess
    }

    /// How much better the likeliest hypothesis fits than the configuration, as a logarithm; nothing where the configuration is
    /// confirmed.
    #[must_use]
    pub fn odds(&self) -> f64 {
        self.likeliest().map_or(0.0, |(score, _)| score.max(0.0))
    }

    /// The likeliest hypothesis, be it believed or not: how much better it fits than the configuration, as a logarithm, and the error of the estimate
    /// that it means; `None` where the configuration is confirmed.
    #[must_use]
    pub fn likeliest(&self) -> Option<(f64, Errors)> {
        if self.is_confirmed() {
            return None;
        }
        let fits = self.hypotheses().iter().filter_map(|prior| self.fit(prior));
        let best = fits.max_by(|a, b| a.score.total_cmp(&b.score))?;
        Some((best.score, self.meant(&best.finding().value)))
    }

    /// Those that there is something to hear of.
    fn hypotheses(&self) -> &'static [Constants] {
        let has_log = self.response.causes() > LOG_AT;
        &HYPOTHESES[..if has_log { HYPOTHESES.len() } else { OF_ANTENNA }]
    }

    /// The error of the estimate that constants mean which are off by so much.
    fn meant(&self, off: &Constants) -> Errors {
        self.response.total(&off.as_slice()[..self.response.causes()])
    }

    /// How much better a hypothesis fits than the configuration. With S the prior sigmas and A = I + S Lambda S the logarithm of
    /// the ratio of likelihoods is (S eta)^T A^-1 (S eta) / 2 - ln(det A) / 2.
    fn fit(&self, prior: &Constants) -> Option<Fit> {
        let factor = self.factor(prior)?;
        let scaled = prior.component_mul(&self.evidence);
        let solved = factor.solve(&scaled);
        let explained = scaled.dot(&solved);
        let left = ((self.misfit - explained) / self.heard).max(1.0);
        let volume: f64 = factor.l_dirty().diagonal().iter().map(|d| d.ln()).sum();
        let score = explained / (2.0 * left) - volume;
        Some(Fit { score, left, solved, factor, prior: *prior })
    }

    /// I + S Lambda S, factored.
    fn factor(&self, prior: &Constants) -> Option<Cholesky<f64, Const<CONSTANTS>>> {
        let scaled = self.information.component_mul(&(prior * prior.transpose()));
        Cholesky::new(SMatrix::identity() + scaled)
    }

    /// How much better a hypothesis fits than the configuration, and what it finds; `None` unless it is
    /// believed.
    fn weigh(&self, prior: &Constants) -> Option<(f64, ConstantsFinding)> {
        let fit = self.fit(prior)?;
        if fit.score <= CONVINCING || !self.is_explained(&fit) {
            return None;
        }
        let finding = fit.finding();
        let is_large = |i: usize| {
            let sigma = finding.covariance[(i, i)].max(0.0).sqrt();
            finding.value[i].abs() > LEAST[i].max(SIGNIFICANT * sigma)
        };
        (0..CONSTANTS).any(is_large).then_some((fit.score, finding))
    }

    /// The delay is not known as it was thought, but to `sigma`, s: the estimate is as unsure.
    pub fn suppose_delay(&self, sigma: f64, p: &mut Covariance) {
        let mut supposed = Constants::zeros();
        supposed[DELAY_AT] = sigma;
        p.spread(&self.meant(&supposed));
    }

    /// The error of the estimate that a finding means; the covariance is as much wider as the finding is unsure.
    pub fn correct(&self, finding: &ConstantsFinding, p: &mut Covariance) -> Errors {
        let ConstantsFinding { value, covariance } = finding;
        let bent = SMatrix::from_diagonal(&(value.component_mul(value) * (BENT * BENT)));
        let causes = self.response.causes();
        let unsure = (covariance + bent).view((0, 0), (causes, causes)).into_owned();
        p.spread_by(&self.response, &unsure);
        self.meant(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error_state::all_states;
    use crate::error_state::{Innovation, Jacobian};
    use insd_base::{Geodetic, earth};
    use nalgebra::Matrix3 as M3;

    fn view(rate: Vector3<f64>) -> View {
        let place = Geodetic::from_degrees(50.0, 5.0, 20.0);
        let nominal = crate::Nominal::at(&place, &Vector3::new(5.0, 0.0, 0.0), &M3::identity());
        let measured = rate + nominal.c_eb().transpose() * earth::rate_e();
        View::new(&nominal, &measured, 0.0)
    }

    fn hardly_unsure() -> Covariance {
        let mut p = Covariance::zeros(&all_states());
        p.matrix_mut().fill_diagonal(1e-9);
        p
    }

    /// Velocities of an antenna that is `off` from where it is said to be, on a ship that rolls and yaws;
    /// the filter's own errors are none.
    fn rolling(off: &Vector3<f64>, noise: f64) -> SeparateBias {
        let mut bias = SeparateBias::new(&view(Vector3::zeros()));
        for second in 0..300 {
            let phase = f64::from(second) * 0.7;
            let view = view(Vector3::new(0.05 * phase.sin(), 0.01 * phase.cos(), 0.02));
            let by_lever = view.c_nb() * skew(&view.rate);
            let h = Jacobian::none(3).with(GNSS_LEVER, &by_lever);
            let scatter = |k: i32| (f64::from(second * second + k) * 0.37).sin() * noise;
            let z = by_lever * off + Vector3::new(scatter(0), scatter(5), scatter(11));
            let innovation = Innovation::new(&z, h, &M3::from_diagonal_element(noise * noise));
            bias.hear(&innovation.weigh(&hardly_unsure()).unwrap(), 0.0);
        }
        bias
    }

    #[test]
    fn a_lever_arm_that_explains_the_innovations_is_found() {
        let off = Vector3::new(12.0, 0.0, -28.0);
        let finding = rolling(&off, 0.05).finding().unwrap();
        assert!((finding.value.fixed_rows::<3>(0) - off).amax() < 0.5, "{finding:?}");
        assert!(finding.value[DELAY_AT].abs() < 1e-6 && finding.log_lever().is_none());
    }

    #[test]
    fn innovations_that_no_lever_arm_explains_convict_none() {
        assert_eq!(rolling(&Vector3::zeros(), 0.05).finding(), None);
        let mut lying = rolling(&Vector3::zeros(), 0.05);
        let view = view(Vector3::zeros());
        for _ in 0..300 {
            let z = view.c_nb() * Vector3::new(3.0, -2.0, 0.0);
            let noise = M3::from_diagonal_element(0.0025);
            let innovation = Innovation::new(&z, Jacobian::none(3), &noise);
            lying.hear(&innovation.weigh(&hardly_unsure()).unwrap(), 0.0);
        }
        assert_eq!(lying.finding(), None);
        assert!(lying.strain().unwrap() > 20.0, "but the strain shows");
    }

    #[test]
    fn noise_that_is_stated_too_large_hides_a_wrong_lever_arm_from_a_finding_and_not_from_the_claims()
     {
        let bias = rolling(&Vector3::new(0.0, 12.0, 0.0), 1.0);
        assert_eq!(bias.finding(), None);
        let is_likely = |bias: &SeparateBias| bias.likeliest().is_some_and(|(odds, _)| odds > 5.0);
        assert!(is_likely(&bias));
        assert!(!is_likely(&rolling(&Vector3::zeros(), 1.0)));
    }

    #[test]
    fn a_lever_arm_is_confirmed_by_motion_in_all_directions_and_not_before() {
        assert!(rolling(&Vector3::zeros(), 0.05).is_confirmed());
        assert!(!SeparateBias::new(&view(Vector3::zeros())).is_confirmed());
    }
}
