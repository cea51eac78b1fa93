//! `--outage SENSOR:FROM..TO`: a sensor taken away for a while.

use std::fmt;
use std::str::FromStr;

use insd_base::{Received, Time};

/// A stretch of time in which the messages of one sensor are dropped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SensorOutage {
    sensor: &'static str,
    from: Time,
    to: Time,
}

impl SensorOutage {
    /// Whether a message falls into the outage: `FROM <= t_s < TO` by its time of validity.
    #[must_use]
    pub fn drops(&self, received: &Received) -> bool {
        let time = received.message.time();
        received.source.name() == self.sensor && self.from <= time && time < self.to
    }
}

impl fmt::Display for SensorOutage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [from, to] = [self.from, self.to].map(Time::as_seconds);
        write!(f, "{}:{from}..{to}", self.sensor)
    }
}

impl FromStr for SensorOutage {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let expected = || {
            "expected SENSOR:FROM..TO with SENSOR one of imu, gnss, log, reference, camera and FROM < TO \
             in seconds, for example gnss:600..900"
                .to_owned()
        };
        let (name, span) = text.split_once(':').ok_or_else(expected)?;
        let (from, to) = span.split_once("..").ok_or_else(expected)?;
        let names = ["imu", "gnss", "log", "reference", "camera"];
        let sensor = names.into_iter().find(|sensor| *sensor == name).ok_or_else(expected)?;
        let instant = |text| super::seconds(text).map(Time::from_seconds).map_err(|_| expected());
        let (from, to) = (instant(from)?, instant(to)?);
        if from < to { Ok(SensorOutage { sensor, from, to }) } else { Err(expected()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::{GnssFix, ImuSample, Message, Source};

    #[test]
    fn an_outage_holds_its_start_but_not_its_end() {
        let outage: SensorOutage = "gnss:600..900.5".parse().unwrap();
        let fix = |seconds| {
            let time = Time::from_seconds(seconds);
            let message = Message::Gnss(GnssFix { time, ..GnssFix::default() });
            Received {
                receipt: Time::from_seconds(seconds + 10.0),
                source: Source::Gnss(0),
                message,
            }
        };
        assert!(outage.drops(&fix(600.0)) && outage.drops(&fix(900.4)));
        assert!(!outage.drops(&fix(599.9)) && !outage.drops(&fix(900.5)));
        let time = Time::from_seconds(700.0);
        let message = Message::Imu(ImuSample { time, ..ImuSample::default() });
        assert!(!outage.drops(&Received { receipt: time, source: Source::Imu(0), message }));
    }

    #[test]
    fn anything_else_is_refused_with_an_example() {
        for text in ["gnss", "gnss:1", "radar:1..2", "gnss:2..1", "gnss:a..b", "gnss:nan..1", ""] {
            let message = text.parse::<SensorOutage>().unwrap_err();
            assert!(message.contains("gnss:600..900"), "{text}");
        }
    }
}
