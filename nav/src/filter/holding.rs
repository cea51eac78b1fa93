//! What moves the ship and her past alike is no motion: it is told slowly.
//!
//! Phases tell to centimetres how a ship has moved, and next to nothing of where she is. That codes tell, and her heading where the antenna is far from the
//! IMU, better and better; each bit that they add moves the place of now and that of half a minute before by the same. A master alongside would read it in
//! his distances as a way that she has not made. It is taken out of the place that is told, let in with time, and claimed: the place of before is a state,
//! a clone of the position (Roumeliotis and Burdick, ICRA 2002), and what each measurement moves it by is what is no motion.

use insd_base::{Ecef, Geodetic, SolutionSigma, earth};
use nalgebra::{Matrix2x3, Vector3};

use super::Filter;
use super::held::{Held, Watch, kept};
use crate::aids::View;
use crate::error_state::{EARLIER_PLACE, POSITION};

/// So long codes find the place before anything is held back, s.
const SETTLING: f64 = 60.0;
/// So long the place of now is compared with the same of before, s.
const RENEWED: f64 = 30.0;
/// Of what is held back a share of 1/e is left after so long, s.
const LET_IN: f64 = 3600.0;
/// No more is held back than so many sigmas of the place.
const MOST: f64 = 1.0;
/// The way since then is known where it is known to this, 1-sigma, m: with fewer than four phases the newest place is the best, wherever it was before.
const KNOWN_WAY: f64 = 0.1;

impl Filter {
    /// Where the IMU is told to be.
    pub(super) fn told_place(&self, view: &View) -> Geodetic {
        if self.held.back == Vector3::zeros() {
            return view.geodetic;
        }
        earth::geodetic(&Ecef(view.nominal.position - self.held.back))
    }

    /// What is claimed with what is held back.
    pub(super) fn with_held(&self, view: &View, sigma: SolutionSigma) -> SolutionSigma {
        let mut all = sigma;
        let back = view.c_ne * self.held.back;
        all.position.0 = sigma.position.0.zip_map(&back, f64::hypot);
        all
    }

    /// After a measurement: holds back by how much it has moved the place of before, as long as it is ranges that tell the place.
    pub(super) fn hold_back(&mut self) {
        let moved = std::mem::take(&mut self.state.nominal.earlier_place);
        if !self.satellites.tell_place() {
            self.held = Held::default();
            return;
        }
        let now = self.state.time;
        let new = Watch { begun: now, noted: now, looked: now };
        let Watch { begun, noted, looked } = self.held.watch.unwrap_or(new);
        self.held.back *= (-(now - looked).as_seconds() / LET_IN).exp();
        if (now - begun).as_seconds() >= SETTLING {
            self.hold_level(&moved);
        }
        let is_due = self.held.watch.is_none() || (now - noted).as_seconds() >= RENEWED;
        let noted = if is_due { now } else { noted };
        self.held.watch = Some(Watch { begun, noted, looked: now });
        if is_due {
            self.state.covariance.clone_block(POSITION, EARLIER_PLACE);
        }
    }

    fn hold_level(&mut self, moved: &Vector3<f64>) {
        let c_ne = self.view().c_ne;
        let level = c_ne.fixed_rows::<2>(0).into_owned();
        let [place, way] = self.level_stds(&level);
        let back = kept(level * self.held.back, level * moved, MOST * place, way < KNOWN_WAY);
        self.held.back = level.transpose() * back;
    }

    /// 1-sigma of the place and of the way since the place of before, both level, m.
    fn level_stds(&self, level: &Matrix2x3<f64>) -> [f64; 2] {
        let p = &self.state.covariance;
        let place = POSITION.covariance(p);
        let crossed = POSITION.covariance_with(EARLIER_PLACE, p);
        let way = place + EARLIER_PLACE.covariance(p) - crossed - crossed.transpose();
        [place, way].map(|of| (level * of * level.transpose()).trace().max(0.0).sqrt())
    }
}
