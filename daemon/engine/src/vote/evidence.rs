//! What speaks against an engine beside its being different from another.

use insd_base::{Body, Integrity, Mode, Motion, Party, Solution, Span, Time};

use super::compare::vagueness;
use crate::checks;

/// A motion older than this is none: nobody would be told of it.
const SILENT: Span = Span::from_nanos(150_000_000);
/// An engine that refuses so much of what it is told is wrong, if another takes nearly all of it.
const REFUSES: f64 = 0.5;
const TAKES: f64 = 0.2;
/// So much likelier is an engine wrong than the other, as a logarithm, at the least; so much likelier than right.
const LIKELIER: f64 = 4.6;
const LIKELY: f64 = 2.0;
/// So many times as uncertain is much less certain.
const VAGUE: f64 = 4.0;

/// What one engine says at a look, and what is known of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Testimony {
    /// How the ship moves by its account, at the point that all engines speak of.
    pub motion: Option<Motion>,
    /// Whether its IMU stands behind what it says.
    pub imu_valid: bool,
    /// Share of its measurements that it refuses, 0 to 1; see [`super::Record::refused`].
    pub refused: Option<f64>,
    /// How its IMU turned since the last look, rad/s; see [`super::Gyros`].
    pub turned: Option<Body>,
    /// How much likelier it finds what the others say if its gyros turn as [`super::Voter::suspicion`] has it, as a
    /// logarithm.
    pub odds: Option<f64>,
}

/// Why an engine is not believed, the strongest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Doubt {
    /// It says nothing that could be used, or has not for 0.15 s.
    Silent,
    /// Its IMU says that it is not valid.
    ImuInvalid,
    /// Two others that do not share an IMU agree with each other, and not with it.
    Outvoted,
    /// Its IMU of a sudden turned otherwise than the other's, which went on as it had.
    Jumped,
    /// What receiver, log and compass say is likely if its gyros turn otherwise than the other's, and unlikely if the
    /// other's do.
    Unlikely,
    /// It is still aligning, and the other is not.
    Aligning,
    /// It refuses what it is told by receivers and logs, and the other does not.
    Refuses,
    /// It navigates by less: by nothing, or by the log, where the other uses satellites.
    LesserMode,
    /// It is much less certain by its own account: a sigma of four times the other's.
    LessCertain,
}

impl Doubt {
    /// A short name for tables and lines: `silent`, `outvoted`, ...
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Doubt::Silent => "silent",
            Doubt::ImuInvalid => "imu_invalid",
            Doubt::Outvoted => "outvoted",
            Doubt::Jumped => "jumped",
            Doubt::Unlikely => "unlikely",
            Doubt::Aligning => "aligning",
            Doubt::Refuses => "refuses",
            Doubt::LesserMode => "lesser_mode",
            Doubt::LessCertain => "less_certain",
        }
    }
}

impl Testimony {
    /// The motion if it may be used at all.
    pub(super) fn usable(&self, now: Time) -> Option<&Motion> {
        self.motion.as_ref().filter(|motion| {
            let solution = &motion.solution;
            let age = (now - solution.time).as_nanos().abs();
            age <= SILENT.as_nanos()
                && solution.mode != Mode::Fault
                && checks::is_sound(solution)
                && claims(solution)
        })
    }
}

/// Whether its sigmas are such as can be.
fn claims(solution: &Solution) -> bool {
    let sigma = &solution.sigma;
    let mut all = sigma.position.0.iter().chain(sigma.velocity.0.iter());
    all.all(|sigma| *sigma >= 0.0)
        && [sigma.roll, sigma.pitch, sigma.heading].iter().all(|sigma| *sigma >= 0.0)
}

/// How much is behind a solution: 4 with satellites, 3 with a log or reference, 2 with the IMU alone, less
/// while the heading is being found.
pub(super) fn rank(mode: Mode) -> u8 {
    match mode {
        Mode::Aided => 4,
        Mode::DeadReckoning => 3,
        Mode::Inertial => 2,
        Mode::FineAlignment | Mode::InMotionAlignment => 1,
        Mode::Standby | Mode::CoarseAlignment | Mode::Fault => 0,
    }
}

/// Whether its IMU does not stand behind what an engine says, or the judge of the engine has found something that
/// contradicts it. Engines hear the same but for their IMUs, so of two it is that.
pub(super) fn is_imu_doubted(said: &Testimony, solution: &Solution) -> bool {
    let judgement = solution.judgement;
    let is_contradicted = judgement.integrity == Integrity::Contradiction;
    !said.imu_valid || is_contradicted || judgement.excluded.contains(Party::Imu)
}

/// The strongest reason to doubt one of two engines rather than the other: whether it is the second, and
/// why. Both have a motion.
pub(super) fn suspect(
    (one, a): (&Testimony, &Motion),
    (other, b): (&Testimony, &Motion),
) -> Option<(bool, Doubt)> {
    let (a, b) = (&a.solution, &b.solution);
    let navigates = |solution: &Solution| solution.mode.is_navigating();
    let refuses = |own: &Testimony, other: &Testimony| {
        own.refused.is_some_and(|share| share >= REFUSES)
            && other.refused.is_some_and(|share| share <= TAKES)
    };
    let is_unlikely = |own: &Testimony, other: &Testimony| {
        let odds = own.odds.zip(other.odds);
        odds.is_some_and(|(own, other)| own > LIKELY && own - other > LIKELIER)
    };
    let reasons = [
        (Doubt::Unlikely, is_unlikely(one, other), is_unlikely(other, one)),
        (Doubt::ImuInvalid, is_imu_doubted(one, a), is_imu_doubted(other, b)),
        (Doubt::Aligning, !navigates(a), !navigates(b)),
        (Doubt::Refuses, refuses(one, other), refuses(other, one)),
        (Doubt::LesserMode, rank(a.mode) < rank(b.mode), rank(b.mode) < rank(a.mode)),
        (Doubt::LessCertain, is_vaguer(a, b), is_vaguer(b, a)),
    ];
    let telling = reasons.into_iter().find(|(_, first, second)| first != second);
    telling.map(|(doubt, _, second)| (second, doubt))
}

/// Whether one is much less certain than another in something, and in nothing more certain.
pub(super) fn is_vaguer(own: &Solution, other: &Solution) -> bool {
    vagueness(own, other) > VAGUE && vagueness(other, own) < VAGUE.sqrt()
}
