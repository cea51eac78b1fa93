//! Lies of a receiver.

use insd_base::earth::{c_ne, ecef, geodetic};
use insd_base::{Ecef, FixQuality, Geodetic, GnssFix, Ned, Stamped, Voyage};
use nalgebra::{Vector2, Vector3};
use rand_pcg::Pcg64;

use super::{Window, shifted, truth_at};
use crate::random::normal3;

/// What a receiver tells wrongly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GnssLie {
    /// Its position jumps, north and east, m.
    Jump(Vector2<f64>),
    /// Its height jumps, m.
    Height(f64),
    /// It is dragged off, m/s; its velocity with it if `consistent`.
    Drag {
        /// North and east, m/s.
        velocity: Vector2<f64>,
        /// Whether the velocity is dragged off with the position.
        consistent: bool,
    },
    /// It creeps off with a growing speed, velocity included, m/s^2.
    Creep(Vector2<f64>),
    /// The second receiver is dragged off, m/s.
    SecondDrag(Vector2<f64>),
    /// Its position stands still, its velocity does not.
    FrozenPosition,
    /// All that it says stands still.
    FrozenAll,
    /// Its position stands still, and its velocity is zero.
    FrozenStill,
    /// Its velocity has the wrong sign.
    VelocitySign,
    /// East and north of its velocity are swapped.
    VelocitySwapped,
    /// Its velocity is too fast by this factor.
    VelocityScale(f64),
    /// Its velocity stands still.
    VelocityStuck,
    /// It tells more way than she makes, by this share, in its position and its velocity.
    Fast(f64),
    /// Its sigmas are wrong by this factor.
    Sigmas(f64),
    /// It claims fixed ambiguities.
    ClaimsRtk,
    /// It is noisy beyond what it says, 1-sigma, m.
    Noise(f64),
    /// Its epochs are dated late, s.
    Dated(f64),
    /// Its fixes arrive late, s.
    Arrives(f64),
    /// Its antenna is elsewhere than configured, body axes, m.
    Lever(Vector3<f64>),
    /// Every epoch is told twice.
    Doubled,
}

/// Sigma of fixed ambiguities, m.
const RTK: f64 = 0.02;

impl GnssLie {
    pub(super) fn is_of_second(self) -> bool {
        matches!(self, GnssLie::SecondDrag(_))
    }

    pub(super) fn spoil(self, voyage: &mut Voyage, window: &Window, rng: &mut Pcg64) {
        match self {
            GnssLie::SecondDrag(velocity) => drag_second(voyage, window, &velocity),
            GnssLie::Doubled => double(voyage, window),
            GnssLie::Lever(arm) => move_antenna(voyage, window, &arm),
            _ => {
                let held = voyage.gnss.iter().find(|fix| window.holds(fix.message.time)).copied();
                let told = voyage.gnss.iter_mut().filter(|fix| window.holds(fix.message.time));
                for fix in told {
                    let since = window.since(fix.message.time);
                    self.spoil_fix(fix, held.as_ref().map(|held| &held.message), since, rng);
                }
            }
        }
        voyage.gnss.sort_by_key(|fix| fix.message.time);
    }

    fn spoil_fix(
        self,
        fix: &mut Stamped<GnssFix>,
        held: Option<&GnssFix>,
        since: f64,
        rng: &mut Pcg64,
    ) {
        let told = &mut fix.message;
        match self {
            GnssLie::Jump(by) => move_by(&mut told.position, &by.push(0.0)),
            GnssLie::Height(up) => move_by(&mut told.position, &Vector3::new(0.0, 0.0, -up)),
            GnssLie::Drag { velocity, consistent } => {
                move_by(&mut told.position, &(velocity * since).push(0.0));
                add(&mut told.velocity, &(velocity * f64::from(u8::from(consistent))));
            }
            GnssLie::Creep(acceleration) => {
                move_by(&mut told.position, &(acceleration * (0.5 * since * since)).push(0.0));
                add(&mut told.velocity, &(acceleration * since));
            }
            GnssLie::Fast(share) => hasten(told, held, share),
            GnssLie::FrozenPosition | GnssLie::FrozenAll | GnssLie::FrozenStill => {
                self.freeze(told, held);
            }
            GnssLie::Noise(std) => {
                let noise = normal3(rng) * std;
                move_by(&mut told.position, &noise);
            }
            GnssLie::Dated(late) => {
                fix.arrival = Some(fix.arrival.unwrap_or(told.time).max(shifted(told.time, late)));
                told.time = shifted(told.time, late);
            }
            GnssLie::Arrives(late) => {
                fix.arrival = Some(shifted(fix.arrival.unwrap_or(told.time), late));
            }
            _ => self.spoil_words(told, held),
        }
    }

    fn freeze(self, told: &mut GnssFix, held: Option<&GnssFix>) {
        let Some(held) = held else { return };
        told.position = held.position;
        match self {
            GnssLie::FrozenAll => told.velocity = held.velocity,
            GnssLie::FrozenStill => told.velocity = told.velocity.map(|_| Ned::default()),
            _ => {}
        }
    }

    /// Velocity, sigmas and quality.
    fn spoil_words(self, told: &mut GnssFix, held: Option<&GnssFix>) {
        let change = |velocity: &mut Option<Ned>, by: &dyn Fn(Vector3<f64>) -> Vector3<f64>| {
            *velocity = velocity.map(|velocity| Ned(by(velocity.0)));
        };
        match self {
            GnssLie::VelocitySign => change(&mut told.velocity, &|v| -v),
            GnssLie::VelocitySwapped => {
                change(&mut told.velocity, &|v| Vector3::new(v.y, v.x, v.z));
            }
            GnssLie::VelocityScale(factor) => change(&mut told.velocity, &|v| v * factor),
            GnssLie::VelocityStuck => told.velocity = held.and_then(|held| held.velocity),
            GnssLie::Sigmas(factor) => {
                change(&mut told.position_std, &|std| std * factor);
                change(&mut told.velocity_std, &|std| std * factor);
            }
            GnssLie::ClaimsRtk => {
                told.quality = FixQuality::RtkFixed;
                change(&mut told.position_std, &|_| Vector3::repeat(RTK));
            }
            _ => {}
        }
    }
}

fn move_by(position: &mut Option<Geodetic>, by: &Vector3<f64>) {
    *position = position.map(|place| moved(&place, by));
}

/// A place so far north, east and down of another, m.
pub(super) fn moved(place: &Geodetic, by: &Vector3<f64>) -> Geodetic {
    geodetic(&Ecef(ecef(place).0 + c_ne(place).tr_mul(by)))
}

fn add(velocity: &mut Option<Ned>, by: &Vector2<f64>) {
    *velocity = velocity.map(|own| Ned(own.0 + by.push(0.0)));
}

/// Adds such a share to the way made since `held` and to the velocity.
fn hasten(told: &mut GnssFix, held: Option<&GnssFix>, share: f64) {
    if let (Some(from), Some(to)) = (held.and_then(|held| held.position), told.position) {
        let way = c_ne(&from) * (ecef(&to).0 - ecef(&from).0);
        move_by(&mut told.position, &Vector3::new(way.x * share, way.y * share, 0.0));
    }
    told.velocity = told.velocity.map(|own| Ned(own.0 + (own.0.xy() * share).push(0.0)));
}

fn drag_second(voyage: &mut Voyage, window: &Window, velocity: &Vector2<f64>) {
    for told in voyage.reference.iter_mut().filter(|told| window.holds(told.message.time)) {
        let since = window.since(told.message.time);
        move_by(&mut told.message.position, &(velocity * since).push(0.0));
    }
}

fn double(voyage: &mut Voyage, window: &Window) {
    let again: Vec<Stamped<GnssFix>> =
        voyage.gnss.iter().filter(|fix| window.holds(fix.message.time)).copied().collect();
    voyage.gnss.extend(again);
}

fn move_antenna(voyage: &mut Voyage, window: &Window, arm: &Vector3<f64>) {
    for fix in voyage.gnss.iter_mut().filter(|fix| window.holds(fix.message.time)) {
        let attitude = truth_at(&voyage.truth, fix.message.time).and_then(|truth| truth.attitude);
        let by = attitude.map(|attitude| attitude.c_nb() * arm).unwrap_or_default();
        move_by(&mut fix.message.position, &by);
    }
}
