//! How everything stands, in one line: what `systemctl status` shows.

use insd_base::Mode;
use insd_base::units::DEG;
use tokio::sync::watch;

use super::journal::Audience;
use super::report::Report;
use super::told::Names;
use crate::pipeline::Product;

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
    let mode = report.mode.as_str().replace('_', " ");
    let alerts = report.alerts.iter().filter(|alert| alert.is_active()).count();
    let rest = format!("{speaking} sensors speak, {alerts} alerts");
    let Some(solution) = report.motion.map(|motion| motion.solution) else {
        return format!("{mode}; {rest}");
    };
    if report.mode == Mode::Fault {
        return format!("{mode}; {rest}");
    }
    let (heading, sigma) = (solution.attitude.heading / DEG, solution.sigma.heading / DEG);
    // whole degrees: a line that changes with every look would fill the journal of the manager
    format!("{mode}; heading {heading:.0} deg, 1 sigma {sigma:.2} deg; {rest}")
}
