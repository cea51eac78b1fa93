//! A place against a base by integers: centimetres, as long as they are right and the base is where it says.
//!
//! The integers were found without the filter, so that nothing is counted twice but the phases of the epoch, of millimetres. Whether they are right the filter
//! judges by what inertial navigation and the phases of all epochs since expect: a place that contradicts it is not used, and who does so time after time is not
//! believed before it has agreed for some epochs. Integers that are withdrawn have misled the place and all that hangs together with it: ranges find it anew.
//!
//! What a base's coordinates are off by moves all places alike. It is no noise that averages out, and no state, as nothing would tell it: it is added to what is claimed.

use insd_base::satellites::{RtkEpoch, RtkPlace, RtkSilence, RtkTurn};
use insd_base::{Ecef, Rejection, SolutionSigma, Source, Time, earth};
use nalgebra::{Matrix1, Matrix3, Vector3};

use super::Filter;
use super::entry::{Judged, NO_INNOVATION, RTK_AID, detail, enter};
use super::ranges::UNKNOWN_PLACE;
use super::rtk_standing::RtkStanding;
use crate::aids::gnss_position::{self, PositionFix};
use crate::error_state::{
    GNSS_POSITION_ERROR, IONOSPHERE, IONOSPHERE_UNKNOWN, Innovation, OFFSET_UNKNOWN, SATELLITES,
    SEA_LEVEL, SEA_LEVEL_UNKNOWN, SYSTEM_OFFSETS,
};
use crate::judge::Aid;
use crate::receiver_clock;
use crate::report::{Outcome, Report};

/// Phases are no better than this, 1-sigma, m.
const WHITE: f64 = 0.003;
/// Reflections of phases, 1-sigma, m, level and down, and what the air between the antennas adds, of their distance.
const REFLECTED: [f64; 2] = [0.005, 0.01];
const AIR: f64 = 5e-7;
/// What coordinates of a base are off by, 1-sigma, m, level and down, and what air and orbits do for hours, of the distance.
const BASE: [f64; 2] = [0.01, 0.02];
const BASELINE: f64 = 1e-6;
/// While RTK is not believed none agrees that is farther off on the level, m.
const NEAR: f64 = 0.15;

impl Filter {
    /// Why the last epoch against a base gave no place that was used.
    #[must_use]
    pub fn rtk_silence(&self) -> Option<RtkSilence> {
        self.rtk.silence
    }

    pub(super) fn apply_rtk(&mut self, told: &RtkEpoch, source: Source, report: &mut Report) {
        let now = self.state.time;
        if told.is_withdrawal && self.rtk.used.is_some() {
            self.forget_place_of_rtk();
            report.rtk.push((now, RtkTurn::Withdrawn));
        }
        let outcome = match &told.place {
            Ok(place) => self.take_rtk(place, (told.time, source), report),
            Err(why) => Err(*why),
        };
        self.rtk.silence = outcome.err();
        report.against_base = Some(outcome);
    }

    fn take_rtk(
        &mut self,
        place: &RtkPlace,
        (time, source): (Time, Source),
        report: &mut Report,
    ) -> Result<(), RtkSilence> {
        if let Some(reason) = self.why_no_rtk() {
            let outcome = Outcome::Rejected(reason);
            let judged = Judged { outcome, log_likelihood: 0.0, innovation: NO_INNOVATION };
            enter(report, time, source, RTK_AID, &judged);
            return Err(RtkSilence::Settling);
        }
        self.begin_with_rtk();
        let innovation = self.rtk_innovation(place);
        let Some(weighed) = innovation.weigh(&self.state.covariance) else {
            return Err(RtkSilence::Contradicted);
        };
        let is_near = !self.rtk.is_contradicted || innovation.z[0].hypot(innovation.z[1]) < NEAR;
        let agrees = is_near && weighed.nis() <= self.gate.limit(weighed.rows());
        let (is_used, turn) = self.rtk.hear(agrees);
        report.rtk.extend(turn.map(|turn| (self.state.time, turn)));
        let refusal = if agrees { Rejection::SourceSuspect } else { Rejection::ChiSquare };
        let outcome = if is_used { Outcome::Accepted } else { Outcome::Rejected(refusal) };
        let judged = Judged { outcome, log_likelihood: 0.0, innovation: detail(&weighed) };
        enter(report, time, source, RTK_AID, &judged);
        if !is_used {
            return Err(RtkSilence::Contradicted);
        }
        self.absorb(&weighed);
        let is_first = self.rtk.used.replace(self.state.time).is_none();
        let far = BASELINE * place.baseline;
        self.rtk.base_std = Some(BASE.map(|std| std + far));
        self.rtk.is_base_surveyed = place.is_surveyed;
        if is_first {
            // so much more is claimed from now on
            self.protect();
        }
        Ok(())
    }

    /// Places are for a ship that lives by ranges of the same receiver, whose antenna is known and who is believed.
    fn why_no_rtk(&self) -> Option<Rejection> {
        if !self.navigating || !self.satellites.are_fresh(self.state.time) {
            Some(Rejection::NotUsable)
        } else if self.withholds(Aid::GnssPosition) {
            Some(Rejection::SourceSuspect)
        } else {
            self.config.is_gnss_lever_unknown().then_some(Rejection::NotUsable)
        }
    }

    /// The slow errors are those of phases from now on.
    fn begin_with_rtk(&mut self) {
        if self.rtk.used.is_none() {
            GNSS_POSITION_ERROR.renew(&mut self.state.covariance, &Matrix3::identity());
            self.state.nominal.gnss_position_error = Vector3::zeros();
            self.receiver.rtk = Some(true);
        }
    }

    fn rtk_innovation(&self, place: &RtkPlace) -> Innovation {
        let view = self.view();
        let [level, down] = REFLECTED.map(|std| std + AIR * place.baseline);
        let measured = PositionFix {
            position: earth::geodetic(&Ecef(place.antenna)),
            white: Vector3::zeros(),
            slow: Vector3::new(level, level, down),
            velocity: view.c_ne * self.antenna_velocity(),
        };
        let mut innovation = gnss_position::innovation(&view, &measured, &self.antenna_lever());
        let white = view.c_ne * place.covariance * view.c_ne.transpose()
            + Matrix3::from_diagonal_element(WHITE * WHITE)
            + self.bent_position(&view);
        innovation.r += white;
        innovation
    }

    /// Forgets where she is, and all that was concluded from it: ranges tell it anew.
    fn forget_place_of_rtk(&mut self) {
        let unknown = |std: f64| Matrix3::from_diagonal_element(std * std);
        self.renew_place(&unknown(UNKNOWN_PLACE));
        let state = &mut self.state;
        GNSS_POSITION_ERROR.renew(&mut state.covariance, &unknown(1.0));
        SYSTEM_OFFSETS.renew(&mut state.covariance, &unknown(OFFSET_UNKNOWN));
        SEA_LEVEL
            .renew(&mut state.covariance, &Matrix1::new(SEA_LEVEL_UNKNOWN * SEA_LEVEL_UNKNOWN));
        let ionosphere = IONOSPHERE_UNKNOWN * IONOSPHERE_UNKNOWN;
        IONOSPHERE.renew(&mut state.covariance, &Matrix1::new(ionosphere));
        state.nominal.gnss_position_error = Vector3::zeros();
        state.nominal.ionosphere = 0.0;
        let clock = state.nominal.receiver_clock.x;
        receiver_clock::renew(&mut state.nominal, &mut state.covariance, clock, None);
        for slot in 0..SATELLITES {
            self.forget_code_errors(slot);
            // constants are those of the place: all begin anew
            self.satellites.slot_mut(slot).iter_mut().for_each(|slot| slot.arc = None);
        }
        self.rtk = RtkStanding::default();
        self.restart_judge();
    }

    /// What is claimed with what the base's coordinates may be off by: it stays when RTK has gone.
    pub(super) fn with_base_error(&self, sigma: SolutionSigma) -> SolutionSigma {
        let Some([level, down]) = self.rtk.base_std else { return sigma };
        let mut all = sigma;
        all.position.0 = sigma.position.0.zip_map(&Vector3::new(level, level, down), f64::hypot);
        all
    }
}
