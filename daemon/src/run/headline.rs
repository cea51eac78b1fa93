//! How everything stands, in one line: what `systemctl status` shows.

use insd_base::units::DEG;
use insd_base::{Mode, Solution};
use insd_vessel::{Names, Product};
use insd_web::snapshot::Freshness;
use tokio::sync::watch;

use super::journal::Audience;
use super::report::Report;

/// Says how everything stands, every few seconds.
pub(super) struct Headline {
    line: watch::Sender<String>,
}

impl Headline {
    pub(super) fn new() -> (Self, watch::Receiver<String>) {
        let (line, receiver) = watch::channel(String::new());
        (Headline { line }, receiver)
    }
}

impl Audience for Headline {
    fn hear(&mut self, _: &Names, _: &Product) {}

    fn see(&mut self, report: &Report) {
        let Some(slow) = &report.slow else { return };
        let line = line(report, slow.intake.sensors.iter().filter(|own| !own.silent).count());
        self.line.send_if_modified(|before| {
            let is_new = *before != line;
            if is_new {
                *before = line;
            }
            is_new
        });
    }
}

fn line(report: &Report, speaking: usize) -> String {
    let alerts = report.alerts.iter().filter(|alert| alert.is_active()).count();
    let rest = format!("{speaking} sensors speak, {alerts} alerts");
    let age = |solution: &Solution| (report.stamp.monotonic - solution.time).as_seconds();
    let is_fresh = |own: &Solution| Freshness::of_age(age(own)) == Freshness::Fresh;
    let solution = report.motion.map(|motion| motion.solution);
    let is_silent = report.mode.is_navigating() && solution.is_some_and(|own| !is_fresh(&own));
    let mode = if is_silent { Mode::Standby } else { report.mode }.as_str().replace('_', " ");
    let Some(solution) = solution.filter(is_fresh) else {
        return format!("{mode}; {rest}");
    };
    if report.mode == Mode::Fault {
        return format!("{mode}; {rest}");
    }
    let (heading, sigma) = (solution.attitude.heading / DEG, solution.sigma.heading / DEG);
    // whole degrees: a line that changes with every look would fill the journal of the manager
    format!("{mode}; heading {heading:.0} deg, 1 sigma {sigma:.2} deg; {rest}")
}
