//! Messages taken one by one: made believable, weighed, gated, absorbed.

use insd_base::satellites::SatelliteRanges;
use insd_base::{
    ExternalReference, FixQuality, Geodetic, GnssFix, LogReference, LogVelocity, Party, Rejection,
    Source, earth,
};
use insd_estimation::Innovation;
use insd_nav::antenna::AntennaMotion;
use insd_nav::floors::{self, Believable};
use insd_nav::leap::ToldMotion;
use insd_nav::{AidReport, Outcome, Report};
use nalgebra::{Vector2, Vector3};

use super::EightState;
use super::aids::{self, SpeedReading, Split};
use super::belief::{considered as k, state as x};
use super::stride::{self, Moved, Stride};

/// Attitude that a levelled ship under way is unsure of from moment to moment, rad: it carries the antenna, and where only
/// positions tell how she moves nothing else may be taken from it.
const UNLEVEL: f64 = 0.01;
/// A heading is a point on the circle of sine and cosine: no sharper than this, rad.
const SHARPEST: f64 = 1e-3;
const GNSS_VELOCITY: &str = "gnss_velocity";
const GNSS_POSITION: &str = "gnss_position";
const GNSS_DISPLACEMENT: &str = "gnss_displacement";
/// A displacement that was used counts for so long, s, and one begins with its epoch if it is no farther away than this, s.
const STRIDING: f64 = 2.5;
const SAME: f64 = 0.005;

impl EightState {
    /// A GNSS fix, valid now.
    pub fn gnss(&mut self, fix: &GnssFix, source: Source) -> Report {
        let mut report = Report::default();
        if !fix.quality.is_measured() {
            enter(&mut report, fix.time, source, GNSS_POSITION, Rejection::NoFix);
            return report;
        }
        self.settle();
        self.note_quality(fix.quality);
        self.note_arm(fix);
        let lever = self.config.gnss_lever();
        let mut passed = Vec::new();
        if let Some(velocity) = fix.velocity.filter(|_| !self.strides()) {
            let std = self.config.floors.gnss_velocity(fix.velocity_std);
            if std.replaced {
                report.floored.push(GNSS_VELOCITY);
            }
            let share = self.config.gnss.velocity_slow_share;
            let split = split(velocity.0.xy(), &std.value, share);
            let scene = self.scene();
            let swing = scene.swing(&lever);
            let moving = self.antenna.acceleration(self.time, &(self.push + swing), 0.0);
            let innovation =
                aids::gnss_velocity(&scene, &split, &lever, &moving.xy(), &self.belief);
            let swing_noise = scene.swing_noise(&lever);
            let told = (&innovation, swing_noise);
            passed.push(self.judge(told, fix.time, source, GNSS_VELOCITY, &mut report));
            if std.value.z < floors::UNTOLD {
                let (white, slow) = shares(std.value.z, share);
                let white = white.hypot(scene.rocking(&self.belief).sqrt());
                self.vertical.measure_down(velocity.0.z - swing.z, white, slow);
            }
        }
        if let Some(position) = fix.position {
            let Some(used) = self.gnss_position(fix, position, source, &mut report) else {
                return report;
            };
            self.gnss_used = used.then_some(self.time).or(self.gnss_used);
            passed.push(used);
        }
        self.consider_restart(fix, &passed, &mut report);
        report
    }

    /// Whether phases tell how the antenna moves, better than the velocities that are made of the same signals.
    pub(super) fn strides(&self) -> bool {
        self.strode.is_some_and(|last| (self.time - last).as_seconds() < STRIDING)
    }

    /// Ranges: what their phases tell of the way since the epoch before. The rest is for a navigator; until there is one, the fixes of the
    /// same receiver tell where she is.
    pub(super) fn ranges(&mut self, ranges: &SatelliteRanges, source: Source) -> Report {
        let mut report = Report::default();
        self.settle();
        let next = Stride::begin(self.time, self.motion.c_pb());
        let begun = self.stride.replace(next);
        let Some((stride, told)) = begun.zip(ranges.displacement) else { return report };
        let is_other = (told.since - stride.since).as_seconds().abs() > SAME;
        // how an antenna swings of which nobody knows the place goes with the forces, and is no noise
        if is_other || self.config.is_gnss_lever_unknown() {
            return report;
        }
        let c_ne = earth::c_ne(&self.motion.place);
        let level = c_ne.fixed_rows::<2>(0);
        let by = level * told.by;
        let moved = Moved { by, covariance: level * told.covariance * level.transpose() };
        let lever = self.config.gnss_lever();
        let scene = self.scene();
        let innovation = stride::gnss_displacement(&scene, &stride, &moved, &lever, &self.belief);
        if self.judge((&innovation, 0.0), ranges.time, source, GNSS_DISPLACEMENT, &mut report) {
            self.strode = Some(self.time);
        }
        report
    }

    /// The position of a fix; tells whether it was used, `None` while the receiver may just have leapt.
    fn gnss_position(
        &mut self,
        fix: &GnssFix,
        position: Geodetic,
        source: Source,
        report: &mut Report,
    ) -> Option<bool> {
        let lever = self.config.gnss_lever();
        let std = self.config.floors.gnss_position(fix.position_std, fix.quality);
        if std.replaced {
            report.floored.push(GNSS_POSITION);
        }
        let share = self.config.gnss.position_slow_share_for(self.rtk == Some(true));
        let mut split = split(position, &std.value, share);
        if fix.velocity.is_none() {
            split.white = split.white.map(|white| white.hypot(UNLEVEL * lever.norm()));
        }
        self.watch_for_leaps(fix, &position, split.white.max());
        let scene = self.scene();
        let leaning = scene.leaning(&self.mast, &self.belief);
        let innovation = aids::gnss_position(&scene, &split, &lever, leaning);
        if self.leap.is_suspected() {
            enter(report, fix.time, source, GNSS_POSITION, Rejection::SourceSuspect);
            return None;
        }
        let used = self.judge((&innovation, 0.0), fix.time, source, GNSS_POSITION, report);
        if self.config.is_gnss_lever_unknown() {
            self.place(&position, &split.white.component_mul(&split.white));
        }
        if std.value.z < floors::UNTOLD {
            let above = (self.motion.c_pb() * lever).z;
            let (white, slow) = shares(std.value.z, share);
            self.vertical.measure_height(position.height + above, white, slow);
            self.heard_height = self.time;
        }
        Some(used)
    }

    /// A log's velocity, valid now. Without a forward component it is not usable.
    pub fn log(&mut self, log: &LogVelocity, source: Source) -> Report {
        let mut report = Report::default();
        let water = log.reference == LogReference::Water;
        let aid = if water { "log_water" } else { "log_bottom" };
        let Some(u) = log.u else {
            enter(&mut report, log.time, source, aid, Rejection::NotUsable);
            return report;
        };
        if self.config.docket.is_excluded(Party::Log) {
            enter(&mut report, log.time, source, aid, Rejection::SourceSuspect);
            return report;
        }
        self.settle();
        let std = floors::scalar(log.std, &self.config.floors.log);
        if std.replaced {
            report.floored.push(aid);
        }
        let reading = SpeedReading { u, v: log.v, w: log.w, std: std.value, water };
        let lever = self.config.lever_arms.log.0;
        let innovation = aids::log_velocity(&self.scene(), &reading, &lever, &self.belief);
        self.judge((&innovation, 0.0), log.time, source, aid, &mut report);
        report
    }

    /// An external reference, valid now.
    pub fn reference(&mut self, reference: &ExternalReference, source: Source) -> Report {
        let mut report = Report::default();
        self.settle();
        let at = reference.time;
        if let Some(velocity) = reference.velocity() {
            let std = believed(reference.velocity_std, &self.config.floors.reference_velocity);
            let innovation = aids::reference_velocity(&self.scene(), &velocity.0.xy(), std);
            self.judge((&innovation, 0.0), at, source, "reference_velocity", &mut report);
        }
        if let Some(place) = reference.position {
            let std = believed(reference.position_std, &self.config.floors.reference_position)
                .hypot(self.config.berth_doubt());
            let innovation = aids::reference_position(&self.scene(), &place, std);
            self.judge((&innovation, 0.0), at, source, "reference_position", &mut report);
        }
        if let Some(heading) = reference.heading {
            let std = believed(reference.heading_std, &self.config.floors.reference_heading)
                .max(SHARPEST);
            let innovation = aids::reference_heading(&self.scene(), heading, std);
            self.judge((&innovation, 0.0), at, source, "reference_heading", &mut report);
        }
        report
    }

    /// The slow errors of code and carrier solutions have nothing to do with each other.
    fn note_quality(&mut self, quality: FixQuality) {
        let rtk = quality == FixQuality::RtkFixed;
        if self.rtk.is_some_and(|before| before != rtk) {
            self.belief.forget_considered_pair(k::SLOW_POSITION);
            self.belief.forget_considered_pair(k::SLOW_VELOCITY);
        }
        self.rtk = Some(rtk);
    }

    /// Applies an innovation if it passes the chi-square gate; tells whether it did. So much of its variance is noise in what
    /// it takes for the motion of the hull.
    fn judge(
        &mut self,
        (innovation, swing_noise): (&Innovation, f64),
        time: insd_base::Time,
        source: Source,
        aid: &'static str,
        report: &mut Report,
    ) -> bool {
        let Some(weighed) = self.belief.weigh(innovation) else {
            enter(report, time, source, aid, Rejection::OutOfRange);
            return false;
        };
        let limit = self.gate.limit(2);
        let passes = weighed.nis() <= limit;
        if passes {
            if let Some(blur) = &mut self.blur {
                blur.absorb(&weighed, &self.belief.own(), swing_noise);
            }
            let errors = self.belief.absorb(&weighed);
            self.motion.inject(&self.local, &errors);
            self.after_update();
        }
        let sigma = weighed.sigma();
        let z = weighed.z();
        let bounded = weighed.nis().min(limit);
        report.log_likelihood += -0.5 * bounded - weighed.log_root_determinant();
        report.aids.push(AidReport {
            time,
            source,
            aid,
            outcome: if passes {
                Outcome::Accepted
            } else {
                Outcome::Rejected(Rejection::ChiSquare)
            },
            innovation: [(z[0], sigma[0]), (z[1], sigma[1]), (f64::NAN, f64::NAN)],
        });
        passes
    }

    /// Watches the receiver's position for leaps. After one she is where it says, and nobody can tell which of its words was true: the
    /// claims cover both.
    fn watch_for_leaps(&mut self, fix: &GnssFix, place: &Geodetic, place_std: f64) {
        let swing = self.scene().swing(&self.config.gnss_lever());
        let told = ToldMotion {
            time: self.time,
            place: *place,
            place_std,
            // of a heading that is not known the swing is not known, either
            velocity: fix.velocity.map_or(self.motion.velocity + swing.xy(), |own| own.0.xy()),
            velocity_std: self.belief.pair(x::VELOCITY).max().max(0.0).sqrt(),
        };
        if let Some(leap) = self.leap.see(&told) {
            self.motion.shift(&self.local, &leap);
            let mut docket = self.config.docket;
            docket.suspect(&self.leap.net(), self.time);
            self.config = self.config.with_docket(docket);
        }
    }

    /// Another receiver has another antenna.
    fn note_arm(&mut self, fix: &GnssFix) {
        if fix.lever.is_some_and(|arm| self.config.hear_antenna(arm)) {
            self.antenna = AntennaMotion::default();
            self.belief.renew_considered_pair(k::LEVER, self.config.gnss_lever_std().powi(2));
            self.mast.release();
        }
    }

    /// Takes the position as that of the antenna, `white` the variance of the fix: nothing knows it better
    /// while the lever arm is unknown. It is off by that, dr = -C_nb dl, and by what the mast leans at that moment, which is of no
    /// account until it leans otherwise.
    fn place(&mut self, antenna: &Geodetic, white: &Vector2<f64>) {
        self.motion.place = Geodetic { height: self.vertical.height, ..*antenna };
        let by_lever = -self.scene().hull;
        self.belief.tie_pair(x::POSITION, k::LEVER, &by_lever, white.max());
        self.mast.hold(&self.scene().mast());
    }

    /// A filter that refuses its receiver for long is itself in error: it starts again from the
    /// receiver's word, with the heading unknown.
    fn consider_restart(&mut self, fix: &GnssFix, passed: &[bool], report: &mut Report) {
        if passed.iter().all(|passed| *passed) {
            self.refused_since = None;
            return;
        }
        let since = *self.refused_since.get_or_insert(self.time);
        let (Some(place), Some(velocity)) = (fix.position, fix.velocity) else { return };
        if (self.time - since).as_seconds() < self.config.gate.reset_time {
            return;
        }
        let spread = |std: Vector3<f64>, arm: f64| std.xy().norm() + arm;
        let lever = self.config.gnss_lever();
        let place_std = self.config.floors.gnss_position(fix.position_std, fix.quality).value;
        let speed_std = self.config.floors.gnss_velocity(fix.velocity_std).value;
        let swing = self.scene().swing(&lever).norm();
        self.motion.place = Geodetic { height: self.vertical.height, ..place };
        self.motion.velocity = velocity.0.xy();
        self.renew(spread(place_std, lever.norm()), spread(speed_std, swing));
        self.mast.release();
        self.refused_since = None;
        report.position_reset = true;
    }
}

fn split<T>(value: T, std: &Vector3<f64>, slow_share: f64) -> Split<T> {
    let (white, slow) = shares(1.0, slow_share);
    let std: Vector2<f64> = std.xy();
    Split { value, white: std * white, slow: std * slow }
}

/// White and slow part of a sigma, of the variance of which a share is slow.
fn shares(std: f64, slow_share: f64) -> (f64, f64) {
    (std * (1.0 - slow_share).sqrt(), std * slow_share.sqrt())
}

fn believed(stated: Option<f64>, range: &Believable) -> f64 {
    floors::scalar(stated, range).value
}

/// Notes a quantity that was not even weighed.
fn enter(
    report: &mut Report,
    time: insd_base::Time,
    source: Source,
    aid: &'static str,
    reason: Rejection,
) {
    let innovation = [(f64::NAN, f64::NAN); 3];
    report.aids.push(AidReport {
        time,
        source,
        aid,
        outcome: Outcome::Rejected(reason),
        innovation,
    });
}
