//! Going on after a crash: the engine as bytes, and the next one from them.

use insd_alignment::StoredVerdict;
use insd_alignment::stored::fingerprint;
use insd_base::units::DEG;
use insd_base::{Event, ModeReason, ResumeDoubt, Span, Time};
use insd_nav::{Estimator, Navigator, Timeline};

use crate::checkpoint::{self, Kept, places};
use crate::epochs::epoch_after;
use crate::resumption::{Finding, Resumption};
use crate::ship::Ship;
use crate::{Engine, LOST, Stage, checks};

/// Sigma of the heading, and of roll and pitch, after the gap beyond which the filter is no longer linear:
/// from there to begin anew is the better way, rad. Roll and pitch are soon found again, so that they
/// may be wider.
const VAGUE: f64 = 5.0 * DEG;
const LEANING: f64 = 8.0 * DEG;

impl Engine {
    /// All that a navigating engine needs to go on after a crash, for [`Engine::resume`]; `None` while
    /// its heading is still being searched for. The same state gives the same bytes: 18 kB, made
    /// in less than 40 us of one core.
    #[must_use]
    pub fn checkpoint(&self) -> Option<Vec<u8>> {
        let Stage::Running(line) = &self.stage else { return None };
        let Ship::Navigating { navigator, aligned, .. } = line.estimator() else { return None };
        if self.is_waiting() || self.shunned.is_some() {
            return None;
        }
        checkpoint::write(&Kept {
            imu: fingerprint(&self.config.imu),
            arms: places(&self.config.lever_arms),
            conditioner: self.conditioner.kept(),
            navigator: navigator.kept(),
            aligned: *aligned,
            alignment_status: self.alignment_status.kept(),
            probation: self.surveyor.probation(),
            learning: self.learning.clone(),
        })
    }

    /// Goes on from the checkpoint of an engine that was ended. To be called before the first message;
    /// `now` is an instant of this engine's time line, before which the checkpoint was valid by `age`.
    ///
    /// The first sample of the IMU closes the gap and tells [`Event::Resumed`]. Then the state is on
    /// trial for some ten seconds ([`Event::ResumeConfirmed`], [`Event::ResumeDropped`]).
    ///
    /// # Errors
    /// Why it cannot be gone on from; the engine then starts as if nothing had been offered.
    pub fn resume(&mut self, bytes: &[u8], now: Time, age: Span) -> Result<(), ResumeDoubt> {
        if self.machine.has_begun() || !matches!(self.stage, Stage::Levelling(_)) {
            return Err(ResumeDoubt::TooLate);
        }
        if !(0.0..=LOST).contains(&age.as_seconds()) {
            return Err(ResumeDoubt::TooOld);
        }
        let kept = checkpoint::read(bytes)?;
        if let Some(doubt) = kept.doubt(&self.config.imu, &self.config.lever_arms) {
            return Err(doubt);
        }
        let by = (now - age) - kept.navigator.time();
        let navigator =
            Navigator::taken_up(&self.nav, &kept.navigator, by).ok_or(ResumeDoubt::NotFinite)?;
        let solution = navigator.solution();
        if !checks::is_sound(&solution) {
            return Err(ResumeDoubt::NotFinite);
        }
        let conditioner = kept.conditioner.shifted(by);
        let turned = conditioner.bridging().rotation_variance(age.as_seconds()).map(f64::sqrt);
        if turned.z.hypot(solution.sigma.heading) > VAGUE || turned.xy().max() > LEANING {
            return Err(ResumeDoubt::TooVague);
        }
        let start = navigator.filter().time();
        let (navigator, aligned) = (Box::new(navigator), kept.aligned);
        let ship = Ship::Navigating { navigator, aligned, verdict: None, trial: None, blind: None };
        self.stage = Stage::Running(Box::new(Timeline::new(ship, start)));
        self.conditioner = conditioner;
        self.alignment_status.take_up(&kept.alignment_status, by);
        self.surveyor.take_up(kept.probation.shifted(by));
        if let (Some(own), Some(kept)) = (&mut self.learning, &kept.learning) {
            **own = kept.shifted(by);
        }
        self.next_epoch = Some(epoch_after(self.period, now));
        self.resumption = Some(Resumption::new(!kept.navigator.filter().is_receiver_suspect()));
        Ok(())
    }

    /// Whether a state is gone on from whose first sample is still awaited.
    pub(crate) fn is_waiting(&self) -> bool {
        self.resumption.as_ref().is_some_and(Resumption::is_waiting)
    }

    /// The first sample after a resumption, if it was awaited: tells of it.
    pub(crate) fn begin_resumption(&mut self, time: Time, gap: f64) -> bool {
        let Some(resumption) = self.resumption.as_mut().filter(|it| it.is_waiting()) else {
            return false;
        };
        resumption.begin(time);
        self.tell(if gap > LOST {
            Event::ResumeDropped { time, reason: ResumeDoubt::TooOld }
        } else {
            Event::Resumed { time, gap }
        });
        true
    }

    /// Tells once what became of the stored state, which is then not offered again.
    pub(crate) fn tell_of_stored(&mut self) {
        let Stage::Running(line) = &self.stage else { return };
        if self.config.stored.is_none() {
            return;
        }
        let Some(verdict) = line.estimator().verdict() else { return };
        self.config.stored = None;
        self.tell(match verdict {
            StoredVerdict::Used { time } => Event::StoredStateUsed { time },
            StoredVerdict::Dropped { time, reason } => Event::StoredStateDropped { time, reason },
        });
    }

    /// Ends the trial of a resumption once the sensors have spoken.
    pub(crate) fn judge_resumption(&mut self) {
        if self.resumption.is_none() {
            return;
        }
        let is_in_doubt =
            self.judge().is_some_and(|judge| judge.is_in_doubt() || judge.docket().is_restless());
        let (Some(resumption), Stage::Running(line)) = (&mut self.resumption, &self.stage) else {
            return;
        };
        resumption.note_doubt(is_in_doubt);
        let time = line.now();
        match resumption.finding(time) {
            None => {}
            Some(Finding::Confirmed) => {
                self.resumption = None;
                self.tell(Event::ResumeConfirmed { time });
            }
            Some(Finding::Refuted(reason)) => {
                self.tell(Event::ResumeDropped { time, reason });
                self.start_over(time, ModeReason::ResumeDropped);
            }
        }
    }
}
