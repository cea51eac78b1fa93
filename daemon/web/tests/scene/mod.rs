//! A made-up ship for the page: nothing is computed here but what pleases the eye. Every field of the
//! model is filled in one scene or another.

#![allow(dead_code)] // each test uses a part of it

mod docking;
pub(crate) mod faults;
mod plumbing;
mod ship;
mod sky;

use insd_web::snapshot::{
    Alert, Log, Program, RecordingState, ShownAlertState, ShownEngine, ShownEvent, ShownFleet,
    ShownLearning, ShownMode, ShownPriority, ShownRecording, ShownSeverity, ShownTransition,
    Snapshot, TimeInfo,
};
use insd_web::{OrderReceiver, PageOrder};

/// Time between two snapshots, s.
pub(crate) const STEP: f64 = 0.1;

/// What is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scene {
    /// At the berth, the heading is being found.
    Alignment,
    /// Under way, all is well.
    Underway,
    /// Under way, GNSS and a compass are gone, alerts are up.
    Fault,
}

impl Scene {
    /// The scene of a word.
    pub(crate) fn from_word(word: &str) -> Option<Self> {
        match word {
            "alignment" => Some(Scene::Alignment),
            "underway" => Some(Scene::Underway),
            "fault" => Some(Scene::Fault),
            _ => None,
        }
    }
}

/// A scene as it goes on.
#[derive(Debug)]
pub(crate) struct Show {
    pub(crate) scene: Scene,
    ticks: u32,
    /// States of the two alerts of the fault that ask to be acknowledged.
    alerts: [ShownAlertState; 2],
    level: String,
    /// The berth that somebody chose.
    berth: Option<String>,
    /// Whether what is learnt may be used.
    uses_learnt: bool,
}

impl Show {
    /// A scene that has been going on for some minutes.
    pub(crate) fn new(scene: Scene) -> Self {
        let alerts = [ShownAlertState::Unacknowledged; 2];
        Show {
            scene,
            ticks: 3000,
            alerts,
            level: "info".to_owned(),
            berth: None,
            uses_learnt: true,
        }
    }

    /// The same from its beginning, to be gone through by [`Show::skip`].
    pub(crate) fn from_the_start(scene: Scene) -> Self {
        Show { ticks: 0, ..Show::new(scene) }
    }

    /// Whether it is still before the moment at which [`Show::new`] begins.
    pub(crate) fn is_past(&self) -> bool {
        self.ticks < 3000
    }

    /// A snapshot a second later.
    pub(crate) fn skip(&mut self) -> Snapshot {
        self.ticks += 9;
        self.next()
    }

    /// The next snapshot, a tenth of a second later.
    pub(crate) fn next(&mut self) -> Snapshot {
        self.ticks += 1;
        let t = f64::from(self.ticks) * STEP;
        let mode = self.mode(t);
        let mut snapshot = Snapshot {
            program: program(t),
            time: time(t, self.scene),
            modes: self.modes(),
            mode,
            motion: Some(ship::motion(t, self.scene)),
            docking: Some(docking::docking(t, self.scene, self.berth.as_deref())),
            berths: docking::BERTHS.map(str::to_owned).to_vec(),
            alignment: Some(ship::alignment(t, self.scene)),
            engines: self.engines(t),
            estimates: Some(ship::estimates(t)),
            installation: ship::installation(self.scene),
            learning: (self.scene == Scene::Underway).then(|| self.learning()),
            sky: sky::sky(t, self.scene),
            rejections: plumbing::rejections(t, self.scene),
            aids: plumbing::aids(t, self.scene),
            samples: plumbing::samples(t),
            alerts: self.alerts(t),
            watched: plumbing::watched(self.scene),
            recording: Some(self.recording(t)),
            fleets: self.fleets(t),
            log: Log { level: self.level.clone(), repeats: 12, lost: 0 },
            events: self.events(),
            ..Snapshot::default()
        };
        if self.scene == Scene::Alignment {
            snapshot.disturbance = Some(ship::disturbance());
        }
        plumbing::fill(&mut snapshot, t, self.scene);
        snapshot
    }

    fn learning(&self) -> ShownLearning {
        let words = [
            "learnt from 41.0 h of 12 voyages, generation 12",
            "at 12 kn the log reads 1.4 % high",
        ];
        ShownLearning {
            may_be_used: self.uses_learnt,
            uses_log: self.uses_learnt,
            uses_current: self.uses_learnt,
            learnt_h: 41.0,
            voyages: 12,
            outage_m: Some(12.0),
            outage_without_m: Some(25.0),
            words: words.map(str::to_owned).to_vec(),
            ..ShownLearning::default()
        }
    }

    /// Obeys all orders that have come.
    pub(crate) fn obey(&mut self, orders: &mut OrderReceiver) {
        while let Some(request) = orders.poll() {
            let outcome = self.obey_one(&request.order);
            request.answer(outcome);
        }
    }

    fn obey_one(&mut self, order: &PageOrder) -> Result<(), String> {
        let (id, state) = match order {
            PageOrder::Berth(name) => {
                if !name.as_ref().is_none_or(|name| docking::BERTHS.contains(&name.as_str())) {
                    return Err("there is no such berth".to_owned());
                }
                self.berth.clone_from(name);
                return Ok(());
            }
            PageOrder::UseLearnt(is_wanted) => {
                self.uses_learnt = *is_wanted;
                return Ok(());
            }
            PageOrder::LogLevel(level) => {
                self.level.clone_from(level);
                return Ok(());
            }
            PageOrder::Acknowledge { id, .. } => (*id, ShownAlertState::Acknowledged),
            PageOrder::Silence { id, .. } => (*id, ShownAlertState::Silenced),
        };
        let index = [10_001, 10_002].iter().position(|own| *own == id);
        let slot = index.and_then(|index| self.alerts.get_mut(index));
        let asks = |state: ShownAlertState| {
            matches!(state, ShownAlertState::Unacknowledged | ShownAlertState::Silenced)
        };
        match slot.filter(|slot| asks(**slot) && self.scene == Scene::Fault) {
            Some(slot) => *slot = state,
            None => return Err("there is no such alert, or it cannot be done to it".to_owned()),
        }
        Ok(())
    }

    fn mode(&self, t: f64) -> ShownMode {
        let (name, since_s, reason) = match self.scene {
            Scene::Alignment => ("fine_alignment", t - 60.0, "it is known which way is down"),
            Scene::Underway => ("aided", t - 180.0, "GNSS is used"),
            Scene::Fault => {
                ("dead_reckoning", t - 240.0, "a log or a reference carries her, without GNSS")
            }
        };
        ShownMode { name: name.to_owned(), since_s, reason: Some(reason.to_owned()) }
    }

    fn modes(&self) -> Vec<ShownTransition> {
        let change = |at_s: f64, from: Option<&str>, to: &str, reason: &str| ShownTransition {
            at_s,
            utc: Some(utc(at_s)),
            from: from.map(str::to_owned),
            to: to.to_owned(),
            reason: Some(reason.to_owned()),
        };
        let mut modes = vec![
            change(0.0, None, "coarse_alignment", "the IMU sends data"),
            change(
                60.0,
                Some("coarse_alignment"),
                "fine_alignment",
                "it is known which way is down",
            ),
        ];
        if self.scene != Scene::Alignment {
            let reason = "the heading is as good as is asked for";
            modes.push(change(180.0, Some("fine_alignment"), "aided", reason));
        }
        if self.scene == Scene::Fault {
            let reason = "a log or a reference carries her, without GNSS";
            modes.push(change(240.0, Some("aided"), "dead_reckoning", reason));
        }
        modes
    }

    fn engines(&self, t: f64) -> Vec<ShownEngine> {
        let motion = ship::motion(t, self.scene);
        let fault = self.scene == Scene::Fault;
        let engine = |name: &str, in_use: bool, off: f64| ShownEngine {
            name: name.to_owned(),
            mode: self.mode(t).name,
            in_use,
            healthy: off == 0.0,
            valid_at_s: Some(motion.valid_at_s),
            heading_deg: motion.heading_deg.map(|heading| heading + off),
            sigma_heading_deg: motion.sigma_heading_deg,
            differs: if off == 0.0 { Vec::new() } else { vec!["heading".to_owned()] },
        };
        vec![engine("main", true, 0.0), engine("hot", false, if fault { 1.4 } else { 0.0 })]
    }

    fn alerts(&self, t: f64) -> Vec<Alert> {
        let alert = |id, priority, state, [title, description]: [&str; 2], since: f64| Alert {
            id,
            manufacturer: Some("INS".to_owned()),
            title: title.to_owned(),
            description: description.to_owned(),
            priority,
            state,
            changed_utc: Some(utc(since)),
            since_s: Some(t - since),
            ..Alert::default()
        };
        if self.scene != Scene::Fault {
            return Vec::new();
        }
        let [heading, position] = self.alerts;
        let lost = ["Position lost", "Use another position"];
        let engine = ["Heading lost", "Use another heading"];
        let mut alarm = alert(10_002, ShownPriority::Alarm, position, lost, 262.0);
        alarm.escalation = 1;
        vec![
            alarm,
            alert(10_001, ShownPriority::Warning, heading, engine, 250.0),
            alert(
                10_004,
                ShownPriority::Caution,
                ShownAlertState::Acknowledged,
                ["Pos. estimated", "No GNSS or little certainty"],
                250.0,
            ),
            alert(
                10_005,
                ShownPriority::Warning,
                ShownAlertState::Rectified,
                ["No UTC", "Times are left empty"],
                281.0,
            ),
        ]
    }

    fn fleets(&self, t: f64) -> Vec<ShownFleet> {
        let fault = self.scene == Scene::Fault;
        vec![ShownFleet {
            name: "shore".to_owned(),
            connected: !fault,
            sent_messages: (t / 60.0) as u64,
            sent_bytes: (t * 35.0) as u64,
            waiting: if fault { 1200 } else { 3 },
            link_fault: fault.then(|| "the connection has ended".to_owned()),
            ..ShownFleet::default()
        }]
    }

    fn recording(&self, t: f64) -> ShownRecording {
        let fault = self.scene == Scene::Fault;
        ShownRecording {
            state: if fault { RecordingState::Failing } else { RecordingState::Recording },
            folder: "/var/lib/insd/recording".to_owned(),
            bytes: (t * 8400.0) as u64,
            files: 1,
            quota_bytes: Some(20_000_000_000),
            lost: if fault { 1841 } else { 0 },
            last_error: fault.then(|| "No space left on device (os error 28)".to_owned()),
        }
    }

    fn events(&self) -> Vec<ShownEvent> {
        let line = |at_s: f64, severity: ShownSeverity, text: &str| ShownEvent {
            at_s,
            utc: Some(utc(at_s)),
            severity,
            text: text.to_owned(),
        };
        let mut events = vec![
            line(
                0.1,
                ShownSeverity::Info,
                "imu: open: /dev/serial/by-id/usb-FTDI_IMU-if00-port0, 921600 baud",
            ),
            line(
                0.2,
                ShownSeverity::Info,
                "gnss: open: /dev/serial/by-id/usb-u-blox_GNSS-if00, 115200 baud",
            ),
            line(0.9, ShownSeverity::Info, "inertial: from imu (first)"),
            line(1.6, ShownSeverity::Info, "time: by messages, to 20 ms"),
            line(2.4, ShownSeverity::Info, "time: by pulses, to 2 us"),
            line(60.0, ShownSeverity::Info, "mode: fine alignment"),
        ];
        if self.scene != Scene::Alignment {
            events.push(line(180.0, ShownSeverity::Info, "mode: aided"));
        }
        if self.scene == Scene::Fault {
            events.push(line(
                229.4,
                ShownSeverity::Warn,
                "gnss: says that it is invalid, status 0",
            ));
            events.push(line(240.0, ShownSeverity::Warn, "mode: dead reckoning"));
            events.push(line(251.3, ShownSeverity::Warn, "gyro-compass: silent for 3.0 s"));
            events.push(line(
                262.0,
                ShownSeverity::Error,
                "recording: No space left on device (os error 28)",
            ));
        }
        events
    }
}

/// An instant as text; the scenes play on one day.
pub(crate) fn utc(t: f64) -> String {
    let (whole, millis) = (t.floor() as u64, (t.fract() * 1000.0) as u64);
    let seconds = 8 * 3600 + 12 * 60 + whole;
    let (hour, minute) = (seconds / 3600 % 24, seconds / 60 % 60);
    format!("2026-11-21T{hour:02}:{minute:02}:{:02}.{millis:03}Z", seconds % 60)
}

fn program(t: f64) -> Program {
    Program {
        name: "insd".to_owned(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        started_utc: Some(utc(0.0)),
        uptime_s: t,
        unit: Some("MV Example".to_owned()),
        configuration_path: Some("/etc/insd/insd.toml".to_owned()),
        configuration_hash: Some("5f1d0c9a7be2".to_owned()),
        configuration_read_at_s: Some(0.0),
        simulated: true,
        memory_bytes: Some(19_400_000),
        processor_s: Some(t * 0.021),
    }
}

fn time(t: f64, scene: Scene) -> TimeInfo {
    let pulses = scene != Scene::Fault;
    TimeInfo {
        at_s: t,
        told_ago_s: 0.0,
        utc: Some(utc(t)),
        system_utc: Some(utc(t + 0.012)),
        quality: if pulses { "pulses" } else { "messages" }.to_owned(),
        source: Some(if pulses { "pulse" } else { "gnss" }.to_owned()),
        sigma_s: Some(if pulses { 2e-6 } else { 0.018 }),
    }
}
