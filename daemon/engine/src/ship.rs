//! The ship on her time line: finding her heading, then navigating.

use insd_alignment::kinematics::Kinematics;
use insd_alignment::{
    AlignmentConfig, Bank, EightState, InMotion, Level, StoredState, StoredVerdict,
};
use insd_base::alignment::{ACCURACY, heading_target};
use insd_base::units::DEG;
use insd_base::{
    Body, Fault, ImuSpec, Message, Mode, Party, Received, Solution, StoredDoubt, Time,
};
use insd_nav::berth::Method;
use insd_nav::config::LogShape;
use insd_nav::filter::judged::ImuState;
use insd_nav::judge::Docket;
use insd_nav::{Estimator, Increment, NavConfig, Navigator, Report};

use crate::antennas::as_heading;
use crate::blind::{Blind, Word, tells_heading, without_heading};
use crate::heir::Heir;
use crate::images::{Images, LEADS, Verdict as Seat};
use crate::trial::{Misled, Trial};

/// Heading sigma below which a ship can be steered by it for the first time.
const STEERABLE: f64 = 1.0 * DEG;

/// Latitude beyond which north turns under the ship too fast for the filter of eight states.
const POLAR: f64 = 88.0 * DEG;

/// What runs on the time line.
#[derive(Clone, Debug)]
pub(crate) enum Ship {
    /// Several headings are possible; `heir` finds the heading once a receiver is heard, if the gyros are coarse.
    Aligning { bank: Box<Bank>, heir: Option<Box<Heir>> },
    /// A receiver tells the velocity, the heading may be anything; `berth` is how the ship is held
    /// once it is found, if she is moored.
    /// `blind` finds it without a heading reference, where one is heard; `images` with the antenna elsewhere.
    InMotion {
        finder: Box<EightState>,
        blind: Option<Blind>,
        images: Images,
        berth: Option<Method>,
    },
    /// One is known, `aligned` once well enough to steer by; `verdict` on a stored state; `blind` while a heading
    /// reference that it was found with is not borne out.
    Navigating {
        navigator: Box<Navigator>,
        aligned: bool,
        verdict: Option<StoredVerdict>,
        trial: Option<Trial>,
        blind: Option<Blind>,
    },
}

impl Ship {
    pub(crate) fn aligning(
        config: &NavConfig,
        level: &Level,
        kinematics: &Kinematics,
        choice: &AlignmentConfig,
        stored: Option<&StoredState>,
    ) -> Self {
        let is_polar = kinematics.position.latitude.abs() > POLAR;
        let is_coarse = config.has_coarse_gyros();
        let is_heard = kinematics.gnss_velocity || (kinematics.gnss_position && is_coarse);
        let is_told = !kinematics.moored || (is_heard && stored.is_none());
        let is_wanted = !is_polar && choice.in_motion == InMotion::EightState;
        if is_told && is_wanted {
            let berth = kinematics.moored.then_some(choice.moored);
            return Ship::in_motion(config, level, kinematics, berth);
        }
        let is_awaited = is_wanted && is_coarse && stored.is_none();
        let heir = is_awaited.then(|| Box::new(Heir::new(config, choice.moored)));
        let bank = Box::new(match stored {
            Some(stored) => Bank::with_stored(config, level, kinematics, choice, stored),
            None => Bank::new(config, level, kinematics, choice.moored),
        });
        Ship::Aligning { bank, heir }
    }

    fn in_motion(
        config: &NavConfig,
        level: &Level,
        kinematics: &Kinematics,
        berth: Option<Method>,
    ) -> Self {
        let begin = |config: &NavConfig| EightState::new(config, level, kinematics);
        let images = Images::beside(config, begin);
        Ship::InMotion { finder: Box::new(begin(config)), blind: None, images, berth }
    }

    /// What became of the stored state that was offered.
    pub(crate) fn verdict(&self) -> Option<StoredVerdict> {
        match self {
            Ship::Aligning { bank, .. } => bank.verdict(),
            Ship::InMotion { finder, .. } => {
                let (time, reason) = (finder.time(), StoredDoubt::NotMoored);
                Some(StoredVerdict::Dropped { time, reason })
            }
            Ship::Navigating { verdict, .. } => *verdict,
        }
    }

    /// What is worth storing: only of a ship that is aligned and still lies at her berth.
    pub(crate) fn stored_state(&self, imu: &ImuSpec) -> Option<StoredState> {
        match self {
            Ship::Navigating { navigator, aligned: true, .. } => StoredState::of(navigator, imu),
            _ => None,
        }
    }

    /// What the heading was misled by, if GNSS refutes what was handed over for navigation a while ago.
    pub(crate) fn refuted_by(&self) -> Option<Misled> {
        match self {
            Ship::InMotion { finder, images, .. } => {
                let by_imu = || images.is_mirrored(finder).then_some(Misled::Imu);
                finder.gain_of_log().map(Misled::Log).or_else(by_imu)
            }
            Ship::Navigating { navigator, .. }
                if navigator.filter().finds_the_impossible()
                    || (!navigator.is_moored() && navigator.filter().puts_antenna_off_board()) =>
            {
                Some(Misled::Imu)
            }
            Ship::Navigating { navigator, .. } if navigator.filter().is_forsaken() => {
                Some(Misled::Unknown)
            }
            Ship::Navigating { navigator, trial: Some(trial), .. } => {
                trial.refuted_by(navigator.filter())
            }
            _ => None,
        }
    }

    /// What is to be done about the IMU.
    pub(crate) fn imu_state(&self) -> ImuState {
        match self {
            Ship::Navigating { navigator, .. } => navigator.filter().imu_state(),
            _ => ImuState::Believed,
        }
    }

    /// Whether the IMU was found wrong by one witness, who may be so himself.
    pub(crate) fn is_imu_doubted_by_one(&self) -> bool {
        match self {
            Ship::Navigating { navigator, .. } => {
                navigator.filter().docket().is_imu_doubted_by_one()
            }
            _ => false,
        }
    }

    /// How much likelier what the others say since an instant is if the gyros turn so much too fast, rad/s.
    pub(crate) fn odds_of_gyros(&mut self, since: Time, excess: &Body) -> Option<f64> {
        match self {
            Ship::Navigating { navigator, .. } => {
                navigator.filter_mut().odds_of_gyros(since, &excess.0)
            }
            _ => None,
        }
    }

    /// Somebody is seen to lie by what he says alone.
    pub(crate) fn disbelieve(&mut self, whom: Party) {
        if let Ship::Navigating { navigator, .. } = self {
            navigator.filter_mut().disbelieve(whom);
        }
    }

    /// Which errors of a log are estimated, and how the current goes on, 1-sigma, m/s, and time constant, s.
    pub(crate) fn learn_log(&mut self, wanted: (Option<LogShape>, (f64, f64))) {
        if let Ship::Navigating { navigator, .. } = self {
            navigator.filter_mut().learn_log(wanted.0, wanted.1);
        }
    }

    /// Whether the trial of her heading is over and GNSS has borne it out.
    pub(crate) fn is_acquitted(&self) -> bool {
        match self {
            Ship::Navigating { navigator, trial: Some(trial), .. } => {
                trial.acquits(navigator.filter())
            }
            _ => false,
        }
    }

    /// Whether the trial of her heading has gone well for minutes.
    pub(crate) fn does_well(&self) -> bool {
        match self {
            Ship::Navigating { navigator, trial: Some(trial), .. } => {
                trial.has_gone_well(navigator.filter())
            }
            _ => false,
        }
    }

    /// Whether her heading was found with a reference that nothing has borne out.
    pub(crate) fn is_heading_unchecked(&self) -> bool {
        matches!(self, Ship::Navigating { blind: Some(_), .. })
    }

    /// What whoever told the heading that she was found with did, if it is not so.
    pub(crate) fn fault_of_heading(&self) -> Fault {
        match self {
            Ship::Navigating { blind: Some(blind), .. } => blind.fault(),
            _ => Fault::HeadingOffset,
        }
    }

    /// Whether she is taken as lying at her berth.
    pub(crate) fn is_moored(&self) -> bool {
        match self {
            Ship::Aligning { bank, .. } => bank.is_moored(),
            Ship::InMotion { berth, .. } => berth.is_some(),
            Ship::Navigating { navigator, .. } => navigator.is_moored(),
        }
    }

    /// Whether a single filter is left.
    pub(crate) fn has_one_heading(&self) -> bool {
        matches!(self, Ship::Navigating { .. })
    }

    /// Whether the heading has been good enough to steer by.
    pub(crate) fn is_steerable(&self) -> bool {
        matches!(self, Ship::Navigating { aligned: true, .. })
    }

    /// How far everybody is believed.
    pub(crate) fn docket(&self) -> Option<Docket> {
        match self {
            Ship::InMotion { finder, .. } => Some(finder.config().docket),
            _ => self.likeliest().map(|navigator| navigator.filter().docket()),
        }
    }

    /// The likeliest of her filters, if she has a full one.
    pub(crate) fn likeliest(&self) -> Option<&Navigator> {
        match self {
            Ship::Aligning { bank, .. } => bank.likeliest(),
            Ship::InMotion { .. } => None,
            Ship::Navigating { navigator, .. } => Some(navigator.as_ref()),
        }
    }

    fn with_mode(&self, solution: Solution) -> Solution {
        let solution = match self {
            Ship::Navigating { navigator, trial: Some(trial), .. } => {
                trial.claim(navigator.filter(), solution)
            }
            _ => solution,
        };
        let solution = match self {
            Ship::InMotion { finder, images, .. } => images.covered(finder, solution),
            _ => solution,
        };
        let solution = match self {
            Ship::InMotion { blind: Some(blind), .. }
            | Ship::Navigating { blind: Some(blind), .. } => blind.covered(solution),
            _ => solution,
        };
        let aligned = heading_target(ACCURACY, solution.position.latitude);
        let mode = match self {
            _ if self.is_moored() && solution.sigma.heading > aligned => Mode::FineAlignment,
            Ship::Aligning { .. } | Ship::InMotion { .. } => Mode::InMotionAlignment,
            Ship::Navigating { aligned: false, .. } if solution.mode == Mode::Aided => {
                Mode::InMotionAlignment
            }
            Ship::Navigating { .. } => solution.mode,
        };
        Solution { mode, ..solution }
    }

    /// Takes the antenna to sit where it must; tells whether that is known as far as the heading goes.
    fn knows_antenna(&mut self) -> bool {
        let Ship::InMotion { finder, images, blind, .. } = self else { return true };
        let (other, odds) = match images.judge(finder) {
            Seat::Open | Seat::Mirrored => return false,
            Seat::AsTold => return true,
            Seat::Other(other, odds) => (other, odds),
        };
        // a heading that was told wrongly puts an antenna elsewhere, too
        let lead = blind.as_ref().map_or(f64::NEG_INFINITY, Blind::odds) - odds;
        *finder = match blind {
            _ if lead.abs() < LEADS => return false,
            Some(blind) if lead > 0.0 => blind.believed(),
            _ => other,
        };
        (*images, *blind) = (Images::default(), None);
        true
    }

    /// Makes what has found the heading the navigator, so that nothing steps.
    fn hand_over(&mut self) {
        if !self.knows_antenna() {
            return;
        }
        let verdict = self.verdict();
        let found = match self {
            Ship::Aligning { bank, .. } => bank.winner().cloned(),
            Ship::InMotion { finder, berth, .. } => finder
                .initial_state()
                .map(|initial| Navigator::new(finder.config(), &initial.at_berth(*berth))),
            Ship::Navigating { .. } => None,
        };
        if let Some(mut navigator) = found {
            navigator.begin_navigation();
            let is_on_trial = matches!(self, Ship::InMotion { .. });
            let trial = is_on_trial.then(|| Trial::of(navigator.filter()));
            let blind = match self {
                Ship::InMotion { blind, images, .. } => {
                    blind.take().map(|blind| blind.with_images(std::mem::take(images)))
                }
                _ => None,
            };
            navigator.filter_mut().doubt_heading(blind.is_some());
            *self = Ship::Navigating {
                navigator: Box::new(navigator),
                aligned: false,
                verdict,
                trial,
                blind,
            };
        }
    }

    /// Lets the filter of eight states take over from the bank of headings, if the message is what it waits for.
    fn call_heir(&mut self, received: &Received) {
        let Ship::Aligning { bank, heir: Some(heir) } = self else { return };
        if is_compared(received) {
            return;
        }
        if let Some((level, kinematics, berth)) = heir.called_by(received, bank) {
            *self = Ship::in_motion(&heir.config, &level, &kinematics, berth);
        }
    }

    /// Does as whoever is blind to the heading reference says: nothing more while it bears out, and the heading that
    /// it found once it refutes.
    fn hear_blind(&mut self) {
        let Ship::Navigating { navigator, blind: own, .. } = self else { return };
        let Some(blind) = own else { return };
        let solution = navigator.filter().is_settled().then(|| navigator.filter().solution());
        let word = solution.map(|it| blind.judge(it.attitude.heading, it.sigma.heading));
        let docket = navigator.filter().docket();
        match word {
            Some(Word::BornOut) => {
                navigator.filter_mut().doubt_heading(false);
                *own = None;
            }
            Some(Word::Refuted) if docket.imu_doubted_since().is_some() => {
                navigator.filter_mut().condemn_imu();
            }
            Some(Word::Refuted) => {
                let finder = blind.finder().clone();
                let docket = docket.without(blind.fault(), finder.time());
                self.begin_with(&finder, docket);
            }
            Some(Word::Elsewhere(finder)) => self.begin_with(&finder, docket),
            _ => {}
        }
    }

    /// Navigates by what a finder has found instead, on trial.
    fn begin_with(&mut self, finder: &EightState, docket: Docket) {
        let Ship::Navigating { navigator, aligned, trial, blind, .. } = self else { return };
        let Some(initial) = finder.initial_state() else { return };
        let past = navigator.filter().past();
        let config = finder.config().with_docket(docket);
        **navigator = Navigator::new(&config, &initial.at_berth(navigator.berth()));
        navigator.begin_navigation();
        navigator.filter_mut().follow_past(past);
        *trial = Some(Trial::of(navigator.filter()));
        (*aligned, *blind) = (false, None);
    }

    fn inner(&self) -> &dyn Solver {
        match self {
            Ship::Aligning { bank, .. } => bank.as_ref(),
            Ship::InMotion { finder, .. } => finder.as_ref(),
            Ship::Navigating { navigator, .. } => navigator.as_ref(),
        }
    }
}

/// Whether the heading is found to be good enough to steer by. Its sigma is a matter of the covariance:
/// it is only asked for when that is new.
fn is_steerable(navigator: &Navigator) -> bool {
    navigator.filter().is_settled() && navigator.filter().heading_std() < STEERABLE
}

/// Whose a heading is that a message may tell.
fn who_tells_heading(received: &Received) -> Party {
    let is_of_antennas = matches!(received.message, Message::Compass(_));
    if is_of_antennas { Party::Antennas } else { Party::Heading }
}

/// Whether a message is of a receiver that is not in use.
fn is_compared(received: &Received) -> bool {
    matches!(received.message, Message::Gnss(fix) if fix.rank > 0)
}

/// The part of an [`Estimator`] that only reads.
trait Solver {
    fn now(&self) -> Solution;
    fn at(&self, increment: &Increment, at: Time) -> Solution;
}

impl<E: Estimator> Solver for E {
    fn now(&self) -> Solution {
        self.solution()
    }

    fn at(&self, increment: &Increment, at: Time) -> Solution {
        self.solution_at(increment, at)
    }
}

impl Estimator for Ship {
    fn advance(&mut self, increment: &Increment) {
        match self {
            Ship::Aligning { bank, .. } => {
                bank.advance(increment);
                self.hand_over();
            }
            Ship::InMotion { finder, blind, images, .. } => {
                finder.advance(increment);
                images.advance(increment);
                blind.iter_mut().for_each(|blind| blind.advance(increment));
            }
            Ship::Navigating { navigator, aligned, trial, blind, .. } => {
                navigator.advance(increment);
                blind.iter_mut().for_each(|blind| blind.advance(increment));
                if navigator.seems_to_leave() {
                    navigator.cast_off();
                    *trial = Some(Trial::of(navigator.filter()));
                }
                *aligned = *aligned || is_steerable(navigator);
            }
        }
    }

    fn apply(&mut self, received: &Received) -> Report {
        self.call_heir(received);
        match self {
            Ship::Navigating { navigator, .. } if is_compared(received) => {
                navigator.apply(received)
            }
            _ if is_compared(received) => Report::default(),
            Ship::Aligning { bank, .. } => bank.apply(&as_heading(received)),
            Ship::InMotion { finder, blind, images, .. } => {
                let whom = who_tells_heading(received);
                let received = &as_heading(received);
                let is_left_out = finder.config().docket.is_excluded(whom);
                if blind.is_none() && tells_heading(received) && !is_left_out {
                    *blind = Some(Blind::beside(finder, whom));
                }
                let heard = if is_left_out { without_heading(received) } else { received.clone() };
                let report = finder.apply(&heard);
                for blind in blind.iter_mut() {
                    let own = blind.apply(received);
                    blind.compare(&own, &report);
                }
                images.apply(&heard, &report);
                self.hand_over();
                report
            }
            Ship::Navigating { navigator, aligned, blind, .. } => {
                let report = navigator.apply(received);
                *aligned = *aligned || is_steerable(navigator);
                blind.iter_mut().for_each(|blind| blind.hear(received));
                self.hear_blind();
                report
            }
        }
    }

    fn solution(&self) -> Solution {
        self.with_mode(self.inner().now())
    }

    fn solution_at(&self, increment: &Increment, at: Time) -> Solution {
        self.with_mode(self.inner().at(increment, at))
    }
}
