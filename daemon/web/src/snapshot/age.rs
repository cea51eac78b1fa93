//! How old something may be that is shown: the one place that decides it, for the page, the interface,
//! the metrics and the monitor.
//!
//! Every group of the snapshot carries its time of validity, and the snapshot the time at which it is
//! shown. [`Snapshot::after`] lets time go on: what grows old is marked, and a moment later it is gone.

use super::freshness::{Freshness, GONE};
use super::{
    BusState, CameraState, RecordingState, Sensor, SensorState, ShownAid, ShownAlignment,
    ShownCamera, ShownEngine, ShownInput, ShownMode, ShownMotion, ShownOutput, ShownPortState,
    ShownSky, SkyState, Snapshot, TimeInfo,
};

/// What the alignment says is repeated every 10 s; when it is older than this nobody aligns, s.
const ALIGNMENT_GONE: f64 = 15.0;
/// Satellites stand where they stood; but what becomes of them is not known for longer than the navigator takes their ranges as fresh, s.
const SKY_GONE: f64 = 5.0;
/// After so long without an image that was looked at nobody knows what becomes of the next, s.
const CAMERA_GONE: f64 = 5.0;
/// A comparison of which nothing new has come for so long is no more than history, s.
const WATCH_GONE: f64 = 10.0;
/// Measurements that a sensor may leave out before its row is called silent.
const LEFT_OUT: f64 = 3.0;

impl Snapshot {
    /// What is to be shown of it so long after it was published or came, s. Letting time go on in two steps
    /// is as good as in one; ages of what was already taken away do not come back.
    #[must_use]
    pub fn after(&self, passed_s: f64) -> Self {
        let passed = if passed_s > 0.0 { passed_s } else { 0.0 };
        let mut shown = self.clone();
        shown.time.at_s += passed;
        shown.time.told_ago_s += passed;
        shown.mode.since_s += passed;
        shown.program.uptime_s += passed;
        let now = shown.time.at_s;
        let navigator = Freshness::of_age(shown.time.told_ago_s);
        shown.sensors.iter_mut().for_each(|sensor| sensor.grow_older(passed, navigator));
        shown.aids.iter_mut().for_each(|aid| aid.grow_older(passed, navigator));
        shown.inputs.iter_mut().for_each(|port| port.grow_older(passed, navigator));
        shown.sky.grow_older(now, passed, navigator);
        shown.camera.iter_mut().for_each(|camera| camera.grow_older(now, navigator));
        shown.watched.iter_mut().for_each(|own| own.age_s = own.age_s.map(|age| age + passed));
        shown.watched.retain(|own| own.age_s.is_none_or(|age| age <= WATCH_GONE));
        for alert in &mut shown.alerts {
            alert.since_s = alert.since_s.map(|since| since + passed);
        }
        shown.judge_ship(now, passed, navigator);
        if navigator == Freshness::Gone {
            shown.forget_the_program();
        }
        shown
    }

    /// The motion, if it may be taken as the present.
    #[must_use]
    pub fn present(&self) -> Option<&ShownMotion> {
        self.motion.as_ref().filter(|motion| motion.freshness == Freshness::Fresh)
    }

    /// Motion, alignment, engines and the mode: all hang on the samples of an IMU.
    fn judge_ship(&mut self, now: f64, passed: f64, navigator: Freshness) {
        let inertial = self.inertial_age(now);
        let own = inertial.map_or(Freshness::Fresh, Freshness::of_age).max(navigator);
        if let Some(motion) = &mut self.motion {
            motion.grow_older(now, passed, own);
        }
        self.motion = self.motion.take().filter(|motion| motion.freshness != Freshness::Gone);
        self.docking.iter_mut().for_each(|docking| docking.grow_older(now, own));
        for engine in &mut self.engines {
            engine.grow_older(now, navigator);
        }
        if own == Freshness::Gone {
            self.estimates = None;
            self.disturbance = None;
        }
        let told = |alignment: &ShownAlignment| now - alignment.told_at_s <= ALIGNMENT_GONE;
        self.alignment = self.alignment.take().filter(told).filter(|_| own != Freshness::Gone);
        if own != Freshness::Fresh {
            let age = if navigator == Freshness::Fresh { inertial } else { None };
            self.mode.give_way(age.unwrap_or(self.time.told_ago_s), navigator);
        }
    }

    /// How old what the IMU says is, s; `None` while none has been heard.
    fn inertial_age(&self, now: f64) -> Option<f64> {
        let of_motion = self.motion.as_ref().map(|motion| now - motion.valid_at_s);
        let is_inertial = |sensor: &&Sensor| sensor.used_for.iter().any(|own| own == "inertial");
        let of_sensor = || {
            let silent = |sensor: &Sensor| sensor.state == SensorState::Silent;
            let own = self.sensors.iter().filter(is_inertial).filter(|own| silent(own));
            own.filter_map(|sensor| sensor.age_s).reduce(f64::min)
        };
        of_motion.or_else(of_sensor)
    }

    /// What is told of the program and its ports when nothing has come of it for too long. Counts stay: they
    /// are of the past anyway.
    fn forget_the_program(&mut self) {
        let TimeInfo { at_s, told_ago_s, .. } = self.time;
        self.time =
            TimeInfo { at_s, told_ago_s, quality: "unknown".to_owned(), ..TimeInfo::default() };
        self.program.memory_bytes = None;
        self.program.processor_s = None;
        self.outputs.iter_mut().for_each(ShownOutput::forget);
        for bus in &mut self.buses {
            (bus.state, bus.rate_hz, bus.load) = (BusState::Unknown, None, None);
            bus.node_state = None;
        }
        if let Some(recording) = &mut self.recording {
            recording.state = RecordingState::Unknown;
        }
    }
}

impl ShownMotion {
    fn grow_older(&mut self, now: f64, passed: f64, least: Freshness) {
        if let Some(source) = &mut self.source {
            source.since_s = source.since_s.map(|since| since + passed);
        }
        self.freshness = Freshness::of_age(now - self.valid_at_s).max(least);
        let is_gone = |at: f64| Freshness::of_age(now - at) == Freshness::Gone;
        self.heave = self.heave.take().filter(|heave| !is_gone(heave.valid_at_s));
    }
}

impl ShownEngine {
    fn grow_older(&mut self, now: f64, navigator: Freshness) {
        let age = self.valid_at_s.map(|at| now - at);
        let own = age.map_or(Freshness::Fresh, Freshness::of_age).max(navigator);
        if own == Freshness::Fresh {
            return;
        }
        (self.heading_deg, self.sigma_heading_deg) = (None, None);
        self.healthy = false;
        let mut mode = ShownMode { name: std::mem::take(&mut self.mode), ..ShownMode::default() };
        mode.give_way(0.0, navigator);
        self.mode = mode.name;
    }
}

impl ShownMode {
    /// What is true where no solution is made any more.
    fn give_way(&mut self, age_s: f64, navigator: Freshness) {
        let (name, reason) = match navigator {
            Freshness::Fresh => ("standby", "the IMU is silent"),
            _ => ("fault", "the navigator tells nothing any more"),
        };
        let is_so = self.name == name || self.name == "fault" || self.name.is_empty();
        if !is_so {
            *self = ShownMode {
                name: name.to_owned(),
                since_s: age_s,
                reason: Some(reason.to_owned()),
            };
        }
    }
}

impl Sensor {
    fn grow_older(&mut self, passed: f64, navigator: Freshness) {
        self.age_s = self.age_s.map(|age| age + passed);
        if let Some(base) = &mut self.base {
            base.age_s = base.age_s.map(|age| age + passed);
        }
        let patience = self.rate_hz.filter(|rate| *rate > 0.0).map_or(0.0, |rate| LEFT_OUT / rate);
        let is_late = self.age_s.is_some_and(|age| age > patience.max(GONE));
        if navigator == Freshness::Gone {
            self.state = SensorState::Unknown;
        } else if is_late && matches!(self.state, SensorState::Valid | SensorState::Received) {
            self.state = SensorState::Silent;
        }
        if matches!(self.state, SensorState::Unknown | SensorState::Silent) {
            (self.rate_hz, self.temperature_c, self.status_word) = (None, None, None);
            (self.fix, self.satellites) = (None, None);
            self.status.clear();
        }
    }
}

impl ShownAid {
    fn grow_older(&mut self, passed: f64, navigator: Freshness) {
        self.age_s = self.age_s.map(|age| age + passed);
        self.in_use &= navigator != Freshness::Gone;
        if !self.in_use {
            self.last_normalised_innovation = None;
        }
    }
}

impl ShownSky {
    fn grow_older(&mut self, now: f64, passed: f64, navigator: Freshness) {
        let is_old = self.valid_at_s.is_none_or(|at| now - at > SKY_GONE);
        if navigator == Freshness::Gone {
            self.state = SkyState::Unknown;
        } else if is_old && self.state == SkyState::Raw {
            self.state = SkyState::Silent;
        }
        if self.state != SkyState::Raw {
            (self.valid_at_s, self.used) = (None, None);
            self.satellites.clear();
        }
        for satellite in &mut self.satellites {
            satellite.left_out_for_s = satellite.left_out_for_s.map(|time| time + passed);
        }
    }
}

impl ShownCamera {
    fn grow_older(&mut self, now: f64, navigator: Freshness) {
        let is_old = self.valid_at_s.is_none_or(|at| now - at > CAMERA_GONE);
        if navigator == Freshness::Gone {
            self.state = CameraState::Unknown;
        } else if is_old && self.is_looked_at() {
            self.state = CameraState::Silent;
        }
        if !self.is_looked_at() {
            (self.valid_at_s, self.points, self.poses, self.landmarks) = (None, None, None, None);
            (self.turned, self.delay) = (Vec::new(), None);
        }
    }
}

impl ShownInput {
    fn grow_older(&mut self, passed: f64, navigator: Freshness) {
        self.age_s = self.age_s.map(|age| age + passed);
        if navigator == Freshness::Gone {
            (self.state, self.rate_bytes_s) = (ShownPortState::Unknown, None);
        } else if self.state != ShownPortState::Open {
            self.rate_bytes_s = None;
        }
    }
}

impl ShownOutput {
    fn forget(&mut self) {
        (self.state, self.rate_bytes_s, self.age_ms) = (ShownPortState::Unknown, None, None);
        self.messages.iter_mut().for_each(|message| message.age_ms = None);
    }
}

#[cfg(test)]
mod tests {
    use super::super::freshness::OLD;
    use super::super::{ShownHeave, ShownSatellite, ShownSource};
    use super::*;

    /// A ship that sails, told at once.
    fn sailing() -> Snapshot {
        let heave = ShownHeave { valid_at_s: 99.98, heave_m: Some(0.4), ..ShownHeave::default() };
        let motion = ShownMotion {
            valid_at_s: 99.98,
            heading_deg: Some(62.0),
            heave: Some(heave),
            source: Some(ShownSource { since_s: Some(7.0), ..ShownSource::default() }),
            ..ShownMotion::default()
        };
        let imu = Sensor {
            state: SensorState::Valid,
            rate_hz: Some(200.0),
            age_s: Some(0.02),
            used_for: vec!["inertial".to_owned()],
            temperature_c: Some(41.0),
            ..Sensor::default()
        };
        let log = Sensor { rate_hz: Some(1.0), age_s: Some(0.9), ..imu.clone() };
        let log = Sensor { used_for: vec!["bottom_velocity".to_owned()], ..log };
        let aligned = ShownAlignment { told_at_s: 91.0, ..ShownAlignment::default() };
        let engine = ShownEngine {
            mode: "aided".to_owned(),
            valid_at_s: Some(99.98),
            ..ShownEngine::default()
        };
        let mut snapshot = Snapshot {
            motion: Some(motion),
            sensors: vec![imu, log],
            alignment: Some(aligned),
            engines: vec![engine],
            ..Snapshot::default()
        };
        (snapshot.time.at_s, snapshot.time.utc) = (100.0, Some("noon".to_owned()));
        snapshot.mode.name = "aided".to_owned();
        snapshot
    }

    /// The same, published so long after the last sample of the IMU.
    fn without_imu(silent_s: f64) -> Snapshot {
        let mut snapshot = sailing();
        snapshot.time.at_s += silent_s;
        snapshot.sensors[0].age_s = Some(silent_s);
        snapshot
    }

    #[test]
    fn what_is_new_is_shown_as_it_is() {
        let snapshot = sailing();
        assert!(snapshot.after(0.0) == snapshot);
        assert!(snapshot.after(0.3).present().is_some() && snapshot.after(0.3).is_navigating());
        let source = snapshot.after(0.25).motion.unwrap().source.unwrap();
        assert_eq!(source.since_s, Some(7.25));
    }

    #[test]
    fn a_silent_imu_makes_her_heading_old_then_gone_and_her_mode_standby() {
        let old = without_imu(0.7).after(0.0);
        assert_eq!(old.motion.as_ref().unwrap().freshness, Freshness::Old);
        assert!(old.present().is_none() && !old.is_navigating());
        let gone = without_imu(1.1).after(0.0);
        assert_eq!((&gone.motion, gone.mode.name.as_str()), (&None, "standby"));
        assert_eq!(gone.mode.reason.as_deref(), Some("the IMU is silent"));
        assert!((gone.mode.since_s - 1.12).abs() < 1e-9);
        assert_eq!(gone.engines[0].mode, "standby");
        assert_eq!(gone.sensors[0].state, SensorState::Silent);
        assert_eq!((gone.sensors[0].temperature_c, gone.sensors[0].rate_hz), (None, None));
        assert_eq!(gone.sensors[1].state, SensorState::Valid, "a slow log is not silent");
        assert_eq!(gone.alignment, None);
        assert!(gone.time.utc.is_some());
    }

    #[test]
    fn an_imu_that_falls_silent_while_levelling_ends_the_alignment() {
        let mut levelling = Snapshot { motion: None, ..without_imu(1.2) };
        levelling.mode.name = "coarse_alignment".to_owned();
        let shown = levelling.after(0.0);
        assert_eq!((shown.mode.name.as_str(), shown.alignment), ("standby", None));
    }

    #[test]
    fn a_navigator_that_tells_nothing_is_in_fault_and_knows_no_time() {
        let old = sailing().after(0.8);
        assert_eq!((old.mode.name.as_str(), old.time.utc.is_some()), ("fault", true));
        let gone = sailing().after(1.2);
        assert_eq!((&gone.motion, gone.mode.name.as_str()), (&None, "fault"));
        assert_eq!((gone.time.utc, gone.time.told_ago_s), (None, 1.2));
        assert!(gone.sensors.iter().all(|sensor| sensor.state == SensorState::Unknown));
    }

    #[test]
    fn a_camera_is_silent_when_its_last_image_is_old_and_unknown_when_nobody_tells_of_it() {
        let mut snapshot = sailing();
        let (state, at) = (CameraState::Used, snapshot.time.at_s);
        let own =
            ShownCamera { state, valid_at_s: Some(at), points: Some(40), ..Default::default() };
        snapshot.camera = Some(own);
        assert_eq!(snapshot.after(0.5).camera.unwrap().points, Some(40));
        snapshot.time.at_s += 5.1;
        let late = snapshot.after(0.1).camera.unwrap();
        assert_eq!((late.state, late.points), (CameraState::Silent, None));
        assert_eq!(snapshot.after(2.0).camera.unwrap().state, CameraState::Unknown);
    }

    #[test]
    fn the_sky_is_gone_when_its_ranges_are_fresh_no_more_and_unknown_when_nobody_tells_of_it() {
        let left_out = ShownSatellite { left_out_for_s: Some(7.0), ..ShownSatellite::default() };
        let mut snapshot = sailing();
        snapshot.sky = ShownSky {
            state: SkyState::Raw,
            valid_at_s: Some(99.0),
            used: Some(0),
            satellites: vec![left_out],
            ..ShownSky::default()
        };
        let sky = snapshot.after(0.5).sky;
        assert_eq!((sky.state, sky.satellites[0].left_out_for_s), (SkyState::Raw, Some(7.5)));
        let late = Snapshot { time: TimeInfo { at_s: 104.5, ..TimeInfo::default() }, ..snapshot };
        let sky = late.after(0.0).sky;
        assert_eq!((sky.state, sky.used, sky.satellites.len()), (SkyState::Silent, None, 0));
        assert_eq!(late.after(1.2).sky.state, SkyState::Unknown);
    }

    #[test]
    fn two_steps_in_time_are_as_one() {
        for snapshot in [sailing(), without_imu(0.4), without_imu(3.0)] {
            for (first, second) in [(0.25, 0.25), (0.5, 1.0), (2.0, 2.0)] {
                let (twice, once) =
                    (snapshot.after(first).after(second), snapshot.after(first + second));
                assert_eq!((twice.mode.name, twice.motion), (once.mode.name, once.motion));
                assert_eq!((twice.sensors, twice.time), (once.sensors, once.time));
            }
        }
    }

    #[test]
    fn an_age_that_is_no_number_is_gone_and_one_ahead_of_its_time_is_fresh() {
        assert_eq!(Freshness::of_age(f64::NAN), Freshness::Gone);
        assert_eq!(Freshness::of_age(-0.01), Freshness::Fresh);
        assert_eq!(
            (Freshness::of_age(OLD), Freshness::of_age(GONE)),
            (Freshness::Fresh, Freshness::Old)
        );
    }
}
