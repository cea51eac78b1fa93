//! The status page of a simulated ship.

use insd_base::{Span, Stamp, Time, UtcTime};
use insd_config::Config;
use insd_engine::Output;
use insd_intake::clock::TimeQuality;
use insd_intake::status::{IntakeStatus, TimeStatus};
use insd_lab::demo::onlooker::{DemoSight, Onlooker};
use insd_vessel::{Names, Product};

use super::journal::Audience;
use super::page::{self, Page};
use super::report::{Alongside, Report, Slow};
use super::showcase::{Origin, hash};
use crate::clock::HostClock;
use crate::logging::Log;

/// Time between two looks, s, on the clock on the wall.
const SHOWN: f64 = 0.1;
/// Between two looks at what is costly to find.
const SECOND: f64 = 1.0;

/// The page, and when it was shown something last.
struct DemoPage {
    page: Page,
    clock: HostClock,
    shown: Option<Time>,
    looked: Option<Time>,
}

/// Opens the page of a simulated ship; `text` is that of her configuration.
///
/// # Errors
/// Nobody can listen there.
pub fn open(config: &Config, text: &str, log: &Log) -> anyhow::Result<Box<dyn Onlooker>> {
    let clock = HostClock::start();
    let origin = Origin { clock, started: clock.now(), configuration: None, hash: hash(text) };
    let opened = page::open(config, origin, log).filter(|page| page.handle.is_some());
    let mut page = opened.ok_or_else(|| {
        anyhow::anyhow!("no status page at {}: is another one there?", config.web.listen)
    })?;
    page.showcase.configure(config, text);
    Ok(Box::new(DemoPage { page, clock, shown: None, looked: None }))
}

impl Onlooker for DemoPage {
    fn hear(&mut self, output: &Output) {
        self.page.showcase.hear(&Names::default(), &Product::Engine(*output));
    }

    fn see(&mut self, sight: &DemoSight<'_>) {
        let now = self.clock.now();
        let is_due = |last: Option<Time>, interval: f64| {
            last.is_none_or(|last| now.monotonic - last >= Span::from_seconds(interval))
        };
        if !is_due(self.shown, SHOWN) {
            return;
        }
        self.shown = Some(now.monotonic);
        let is_second = is_due(self.looked, SECOND);
        if is_second {
            self.looked = Some(now.monotonic);
        }
        // she lives in the time of her voyage, and is shown as she is at this moment
        self.page.showcase.show(&report(sight, now.system, is_second), 0.0);
    }
}

fn report(sight: &DemoSight<'_>, system: UtcTime, is_second: bool) -> Report {
    let DemoSight { now, utc, engine, outputs } = *sight;
    let motion = engine.motion();
    let berths = outputs.station().berths();
    let alongside = berths.look(motion.as_ref(), now).map(|docking| {
        let outline = motion.as_ref().map(|own| berths.plan(own)).unwrap_or_default();
        Alongside { docking, outline }
    });
    Report {
        stamp: Stamp { monotonic: now, system },
        utc,
        mode: engine.mode(),
        motion,
        heave: engine.heaves().into_iter().next().flatten(),
        alongside,
        alignment: outputs.alignment(),
        alerts: outputs.station().alerts().views().collect(),
        engines: Vec::new(),
        heard: Vec::new(),
        slow: is_second.then(|| Box::new(slow(sight))),
    }
}

/// What is known of a ship without ports and without disks.
fn slow(sight: &DemoSight<'_>) -> Slow {
    let engine = sight.engine;
    let time = TimeStatus { utc: sight.utc, quality: TimeQuality::Messages, sigma: None };
    let intake = IntakeStatus { ports: Vec::new(), sensors: Vec::new(), choices: Vec::new(), time };
    Slow {
        learning: None,
        intake,
        attempts: Vec::new(),
        counts: engine.counts().clone(),
        outputs: Vec::new(),
        nodes: Vec::new(),
        recorder: None,
        saver: None,
        fleets: Vec::new(),
        disputes: Vec::new(),
        watched: Vec::new(),
        estimates: engine.estimates(),
        sky: engine.sky(),
        standings: engine.standings().collect(),
        findings: engine.findings().to_vec(),
        disturbance: engine.disturbance(),
        epochs: [0; 3],
        untold: 0,
    }
}
