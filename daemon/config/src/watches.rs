//! What the configuration makes of those that are watched.

use insd_vessel::{MOST_WATCHED, WatchPlan};

use crate::file::Config;
use crate::watch::WatchSection;

impl Config {
    /// What the vessel is told of those that are watched.
    pub(crate) fn watch_plans(&self) -> Vec<WatchPlan> {
        let plan = |own: &WatchSection| {
            let mut sensors = self.sensors.iter().enumerate();
            let (index, sensor) = sensors.find(|(_, sensor)| sensor.name == own.sensor)?;
            Some(own.plan(index, sensor))
        };
        self.watches.iter().filter_map(plan).collect()
    }
}

/// All that is wrong with those that are watched, with their places.
pub(crate) fn faults(config: &Config) -> Vec<String> {
    let of_one = |own: &WatchSection| {
        let place = format!("[[watch]] \"{}\"", own.sensor);
        own.faults(&config.sensors, &config.watches)
            .into_iter()
            .map(move |fault| format!("{place}: {fault}"))
    };
    let mut faults: Vec<String> = config.watches.iter().flat_map(of_one).collect();
    if let Some(last) = config.watches.last().filter(|_| config.watches.len() > MOST_WATCHED) {
        let fault = format!("sensor: expected no more than {MOST_WATCHED} that are watched");
        faults.push(format!("[[watch]] \"{}\": {fault}", last.sensor));
    }
    faults
}
