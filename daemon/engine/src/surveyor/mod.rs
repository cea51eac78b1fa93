//! What of the installation is otherwise than configured: read off what the filter has found.
//!
//! It looks every ten seconds at the newest state, as the alignment_status does, or when samples of the IMU are found to
//! make no sense, and is no part of what the time line takes back.

mod axes;
mod frozen;
mod gravity;
mod imu;
mod leaning;
mod log;
mod mounting;
mod probation;
mod saturated;
mod stuck;
mod swing;
mod turns;

use insd_base::satellites::CompassFault;
use insd_base::{
    Body, Estimate, Estimates, ExternalReference, Finding, GnssFix, ImuSample, LeverArms,
    LogVelocity, Message, Mode, Parties, Party, Received, Rejection, Solution, Span, Time,
};
use insd_nav::Increment;

use crate::ship::Ship;
use frozen::StandingStill;
use imu::ImuWatch;
use leaning::Leaning;
use log::LogWatch;
use mounting::Mounting;
pub(crate) use probation::Probation;
use turns::Turns;

/// Spacing of looks.
const LOOK: Span = Span::from_nanos(10_000_000_000);
/// A constant is otherwise than configured if it is beyond so many sigmas,
const SIGNIFICANT: f64 = 5.0;
/// and by so much: lever arm, m; delay, s.
const LEVER: f64 = 0.5;
const DELAY: f64 = 0.05;
/// Epochs are set back by no more than this, s.
const LATEST: f64 = 1.5;
/// A log is compared with a solution at most so far from it in time, s.
const LATE: f64 = 0.5;
/// A lever arm that was not measured is told when it is known so well, each component, 1-sigma, m.
const KNOWN: f64 = 0.5;
/// On a straight course it comes to be known less well: up to so much it is the one that was told, m.
const STILL_KNOWN: f64 = 2.0;

/// What was found, and when to look next.
#[derive(Clone, Debug)]
pub(crate) struct Surveyor {
    arms: LeverArms,
    accepts: bool,
    imu: ImuWatch,
    mounting: Mounting,
    probation: Probation,
    turns: Turns,
    leaning: Leaning,
    still: StandingStill,
    log: LogWatch,
    /// What is wrong with antennas that are a compass.
    antennas: Vec<CompassFault>,
    newest: Option<Solution>,
    next: Option<Time>,
    /// Lever arm of a receiver that tags its epochs late, body axes, m, and by how much, s.
    late: Option<(Body, f64)>,
    findings: Vec<Finding>,
    /// Whether GNSS has refuted every heading that was found with the IMU.
    pub(crate) is_refuted: bool,
    /// How often it told an installation that none can be: what is so often is so until somebody mends it.
    pub(crate) impossible: u8,
    /// Whether nobody but GNSS says so: then neither is named.
    pub(crate) is_by_one: bool,
    /// When the judge found the IMU to be of no use.
    pub(crate) condemned: Option<Time>,
}

impl Surveyor {
    /// `accepts` if the mounting of the IMU is as the operator wants it, whatever is found.
    pub(crate) fn new(arms: &LeverArms, accepts: bool) -> Self {
        Surveyor {
            arms: *arms,
            accepts,
            imu: ImuWatch::default(),
            mounting: Mounting::default(),
            probation: Probation::default(),
            turns: Turns::default(),
            leaning: Leaning::default(),
            still: StandingStill::default(),
            log: LogWatch::default(),
            antennas: Vec::new(),
            newest: None,
            next: None,
            late: None,
            findings: Vec::new(),
            is_refuted: false,
            impossible: 0,
            is_by_one: false,
            condemned: None,
        }
    }

    /// What is found to be otherwise than configured, as it is known now.
    pub(crate) fn findings(&self) -> &[Finding] {
        &self.findings
    }

    /// Course less heading on the mean, rad.
    pub(crate) fn course_less_heading(&self) -> Option<Estimate> {
        self.mounting.drift()
    }

    /// Sees a sample of the IMU as it came, and its duration, s.
    pub(crate) fn see_raw(&mut self, sample: &ImuSample, duration: f64) {
        self.imu.see_raw(sample, duration);
    }

    /// Sees an increment of the IMU.
    pub(crate) fn measure(&mut self, increment: &Increment) {
        self.imu.see(increment);
        self.turns.see(increment);
        self.leaning.see(increment);
    }

    /// Whether nothing can be made of what the IMU says, however the ship lies.
    pub(crate) fn refuses_samples(&self) -> bool {
        self.samples().is_some()
    }

    /// What makes the IMU of no use, if anything does.
    pub(crate) fn doubt(&self) -> Option<Finding> {
        self.findings.iter().copied().find(Finding::doubts_imu)
    }

    /// Who is left out for what is found of him alone.
    pub(crate) fn excluded(&self) -> Parties {
        let is_open = |found: &&Finding| matches!(found, Finding::ImuRefuted) && self.is_by_one;
        let named = self.findings.iter().filter(|found| !is_open(found));
        named.filter_map(Finding::excludes).collect()
    }

    /// Whether the position of the receiver in use stands still while the ship does not.
    pub(crate) fn is_fix_frozen(&self) -> bool {
        self.still.is_fix_frozen()
    }

    /// Who stands still from now on.
    pub(crate) fn newly_frozen(&mut self) -> Option<Party> {
        self.still.begun()
    }

    /// Another receiver is heard from now on.
    pub(crate) fn forget_receiver(&mut self) {
        self.still.forget_receiver();
        self.leaning.interrupt();
    }

    /// The ship is aligned anew.
    pub(crate) fn begin_anew(&mut self) {
        self.mounting.begin_anew();
        self.probation.begin_anew();
        self.newest = None;
    }

    /// The IMU is in doubt: a heading that is found with it from now on must be borne out.
    pub(crate) fn doubt_headings(&mut self) {
        self.probation.begin();
    }

    /// How far the IMU's probation has come.
    pub(crate) fn probation(&self) -> Probation {
        self.probation
    }

    /// Goes on with a probation of before a restart.
    pub(crate) fn take_up(&mut self, probation: Probation) {
        self.probation = probation;
    }

    /// What is claimed of a solution with a heading that was found anew since; `reach` from the IMU to the antenna, m.
    pub(crate) fn claim(&self, solution: Solution, reach: f64) -> Solution {
        self.probation.claim(solution, reach)
    }

    /// Sees a solution.
    pub(crate) fn see(&mut self, solution: &Solution) {
        self.mounting.see(solution);
        self.probation.see(self.mounting.is_ahead(), solution.time);
        self.probation.see_way(solution);
        self.newest = Some(*solution);
    }

    /// Hears everybody but the IMU.
    pub(crate) fn hear(&mut self, received: &Received) {
        let newest = self.newest;
        match &received.message {
            Message::Gnss(fix) => {
                self.turns.hear(fix);
                self.leaning.hear(fix);
                self.imu.hear(fix);
                self.still.hear_fix(fix, newest.as_ref());
            }
            Message::Log(log) => {
                self.turns.hear_log(log);
                self.hear_log(log);
            }
            Message::Reference(told) => {
                self.still.hear_heading(told, newest.as_ref());
                if let Some(own) = newest {
                    self.probation.hear(told, (own.attitude.heading, own.sigma.heading));
                }
            }
            Message::Compass(reading) => self.antennas.clone_from(&reading.faults),
            Message::Imu(_)
            | Message::Ranges(_)
            | Message::Base(_)
            | Message::Rtk(_)
            | Message::Ranging(_)
            | Message::Camera(_)
            | Message::Odometry(_) => {}
        }
    }

    /// A log is compared with a solution that does not live by it.
    fn hear_log(&mut self, log: &LogVelocity) {
        let at_log = self.newest.map(|solution| {
            let at_imu = solution.attitude.c_nb().transpose() * solution.velocity.0;
            at_imu + solution.rate.0.cross(&self.arms.log.0)
        });
        self.still.hear_log(log, at_log, self.newest.as_ref());
        let aided = |solution: &Solution| {
            matches!(solution.mode, Mode::Aided | Mode::InMotionAlignment)
                && (log.time - solution.time).as_seconds().abs() < LATE
        };
        if let Some(at_log) = at_log.filter(|_| self.newest.as_ref().is_some_and(aided)) {
            self.log.hear(log, &at_log);
        }
    }

    /// What is left of a message without what its sensor is known to tell wrongly, and what that is.
    pub(crate) fn believed(
        &self,
        received: &Received,
    ) -> (Option<Received>, Option<(&'static str, Rejection)>) {
        let with = |message: Message| Some(Received { message, ..*received });
        let is_wrong = |found: &Finding| matches!(found, Finding::LogMounting { .. });
        let is_turned = |found: &Finding| matches!(found, Finding::MountingTurned { .. });
        match &received.message {
            Message::Gnss(fix) => {
                let (left, refused) = self.still.fix(fix);
                (left.map(Message::Gnss).and_then(with), refused)
            }
            Message::Log(_) if self.still.is_log_frozen() => {
                (None, Some((received.source.name(), Rejection::Frozen)))
            }
            Message::Log(_) if self.findings.iter().any(is_wrong) => {
                (None, Some((received.source.name(), Rejection::NotUsable)))
            }
            // it would tell where her bow points, and not where the IMU does
            Message::Log(_) if self.findings.iter().any(is_turned) => (None, None),
            Message::Reference(told) if self.still.is_heading_frozen() => {
                let left = ExternalReference { heading: None, heading_std: None, ..*told };
                (with(Message::Reference(left)), Some(("reference_heading", Rejection::Frozen)))
            }
            _ => (Some(received.clone()), None),
        }
    }

    /// A message with all that is known of its receiver: the lever arm of its antenna; and epochs that were
    /// found to be tagged late are set back.
    pub(crate) fn completed(&self, received: &Received) -> Received {
        let Message::Gnss(fix) = &received.message else { return received.clone() };
        let arm = fix.lever.unwrap_or(self.arms.gnss);
        let redated = self.late.filter(|(own, _)| *own == arm).map_or(0.0, |(_, by)| by);
        let time = fix.time - Span::from_seconds(redated);
        let fix = GnssFix { time, redated, lever: Some(arm), ..*fix };
        Received { message: Message::Gnss(fix), ..*received }
    }

    /// Looks, if it is time; gives what was not found before.
    pub(crate) fn look(&mut self, ship: Option<&Ship>, now: Time) -> Vec<Finding> {
        let is_urgent = self.doubt().is_none() && self.samples().is_some();
        if !is_urgent && self.next.is_some_and(|next| now < next) {
            return Vec::new();
        }
        self.next = Some(now + LOOK);
        let navigating = ship.filter(|ship| ship.has_one_heading()).and_then(Ship::likeliest);
        let mut found = self.of_imu();
        if let Some(navigator) = navigating {
            let estimates = navigator.filter().estimates(navigator.is_moored());
            self.note_delay(&estimates);
            found.extend(self.of_installation(&estimates, navigator.filter().imu_is_worse_by()));
        }
        found.extend(self.log.finding());
        found.extend(self.still.all().map(|what| Finding::Frozen { what }));
        found.extend(self.antennas.iter().map(|fault| Finding::Antennas { fault: *fault }));
        let is_new = |finding: &&Finding| {
            !self.findings.iter().any(|known| known.as_str() == finding.as_str())
        };
        let told = found.iter().filter(is_new).copied().collect();
        self.findings = found;
        told
    }

    /// Takes what the filter has of the delay; tells whether the next epochs are set back otherwise than
    /// these.
    pub(crate) fn note_delay(&mut self, estimates: &Estimates) -> bool {
        let before = std::mem::replace(&mut self.late, late(estimates));
        let by = |late: Option<(Body, f64)>| late.map_or(0.0, |(_, by)| by);
        (by(self.late) - by(before)).abs() > DELAY
    }

    /// A lever arm in the axes of an IMU that is not mounted as configured means nothing.
    fn of_installation(&self, estimates: &Estimates, imu_is_worse_by: f64) -> Vec<Finding> {
        let is_imu_right = self.of_imu().is_empty();
        let levers = [self.lever(estimates), self.log_lever(estimates)];
        let mut found: Vec<Finding> =
            levers.into_iter().flatten().filter(|_| is_imu_right).collect();
        let worse = (imu_is_worse_by > 1.0).then_some(Finding::ImuWorse { times: imu_is_worse_by });
        let wheels = estimates.goes_on_wheels.then_some(Finding::OnWheels);
        let ashore = estimates.is_not_at_sea.then_some(Finding::NotAtSea);
        found.extend(worse.into_iter().chain(delay(estimates)).chain(wheels).chain(ashore));
        found
    }

    /// What is found of the IMU. A ship that a log, too, sees going astern goes astern.
    fn of_imu(&self) -> Vec<Finding> {
        let is_as_meant = self.accepts || self.log.agrees();
        let turned = || self.mounting.finding().filter(|_| !is_as_meant);
        let refuted = || self.is_refuted.then_some(Finding::ImuRefuted);
        let leaning = || self.leaning.finding();
        let turns = || self.turns.finding();
        self.samples()
            .or_else(leaning)
            .or_else(turns)
            .or_else(turned)
            .or_else(refuted)
            .into_iter()
            .collect()
    }

    /// What is found of its samples.
    fn samples(&self) -> Option<Finding> {
        let tilted = || self.imu.tilted().filter(|_| !self.accepts);
        self.imu.finding().or_else(tilted)
    }

    fn log_lever(&self, estimates: &Estimates) -> Option<Finding> {
        let (found, sigma) = estimates.log_lever?;
        Some(Finding::LogLever { configured: self.arms.log, found, sigma })
    }

    fn lever(&self, estimates: &Estimates) -> Option<Finding> {
        let (found, sigma) = (estimates.gnss_lever, estimates.gnss_lever_sigma);
        let configured = estimates.gnss_lever_configured;
        if configured.0.norm() == 0.0 {
            let is_unmeasured = |own: &Finding| matches!(own, Finding::GnssLeverUnmeasured { .. });
            let was_told = self.findings.iter().any(is_unmeasured);
            let known = sigma.0.max() < if was_told { STILL_KNOWN } else { KNOWN };
            return known.then_some(Finding::GnssLeverUnmeasured { found, sigma });
        }
        let difference = found.0 - configured.0;
        let is_other = |i: usize| difference[i].abs() > LEVER.max(SIGNIFICANT * sigma.0[i]);
        (0..3).any(is_other).then_some(Finding::GnssLever { configured, found, sigma })
    }
}

/// Epochs that come later than the history reaches back, or as much too early, are not set back wholly.
fn late(estimates: &Estimates) -> Option<(Body, f64)> {
    let by = estimates.gnss_delay.value.clamp(-LATEST, LATEST);
    delay(estimates).map(|_| (estimates.gnss_lever_configured, by))
}

fn delay(estimates: &Estimates) -> Option<Finding> {
    let (found, sigma) = (estimates.gnss_delay.value, estimates.gnss_delay.sigma);
    (found.abs() > DELAY.max(SIGNIFICANT * sigma)).then_some(Finding::GnssDelay { found, sigma })
}
