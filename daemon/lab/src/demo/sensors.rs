//! What each sensor does: when it last spoke, how often it speaks, and what became of its words.

use std::collections::VecDeque;

use insd_base::{Counts, Message, Received, Span, Time, Voyage};

/// Time over which a rate is counted, s.
const WINDOW: f64 = 10.0;

/// A kind of sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DemoSensor {
    /// Inertial measurement unit.
    Imu,
    /// GNSS receiver.
    Gnss,
    /// Velocity log.
    Log,
    /// External reference.
    Reference,
}

impl DemoSensor {
    /// In the order of the table.
    pub const ALL: [DemoSensor; 4] =
        [DemoSensor::Imu, DemoSensor::Gnss, DemoSensor::Log, DemoSensor::Reference];

    /// Its name on the screen.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            DemoSensor::Imu => "IMU",
            DemoSensor::Gnss => "GNSS",
            DemoSensor::Log => "Log",
            DemoSensor::Reference => "Reference",
        }
    }

    /// First word of the aids that use it.
    fn prefix(self) -> &'static str {
        match self {
            DemoSensor::Imu => "imu",
            DemoSensor::Gnss => "gnss",
            DemoSensor::Log => "log",
            DemoSensor::Reference => "reference",
        }
    }

    fn of(message: &Message) -> DemoSensor {
        match message {
            Message::Imu(_) => DemoSensor::Imu,
            Message::Gnss(_)
            | Message::Ranges(_)
            | Message::Base(_)
            | Message::Rtk(_)
            | Message::Compass(_) => DemoSensor::Gnss,
            Message::Log(_) => DemoSensor::Log,
            Message::Reference(_)
            | Message::Ranging(_)
            | Message::Camera(_)
            | Message::Odometry(_) => DemoSensor::Reference,
        }
    }
}

/// One line of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DemoSensorStatus {
    /// Which.
    pub kind: DemoSensor,
    /// Time since its last message; `None` if it never spoke.
    pub age: Option<Span>,
    /// Messages per second lately.
    pub rate: f64,
    /// Measurements used.
    pub used: u64,
    /// Measurements rejected.
    pub rejected: u64,
    /// Whether it has been silent for much longer than its usual rate lets expect.
    pub silent: bool,
}

/// Listens to the messages of one sensor.
#[derive(Clone, Debug)]
struct Watch {
    kind: DemoSensor,
    receipts: VecDeque<Time>,
    last: Option<Time>,
    /// Highest rate so far, Hz.
    usual_rate: f64,
}

/// Listens to all sensors of a voyage.
#[derive(Clone, Debug)]
pub struct Sensors {
    watches: Vec<Watch>,
}

impl Sensors {
    /// The sensors that a voyage has.
    #[must_use]
    pub fn of(voyage: &Voyage) -> Self {
        let present = |kind: &DemoSensor| match kind {
            DemoSensor::Imu => !voyage.imu.is_empty(),
            DemoSensor::Gnss => !voyage.gnss.is_empty(),
            DemoSensor::Log => !voyage.log.is_empty(),
            DemoSensor::Reference => !voyage.reference.is_empty(),
        };
        let watch = |kind| Watch { kind, receipts: VecDeque::new(), last: None, usual_rate: 0.0 };
        Sensors { watches: DemoSensor::ALL.into_iter().filter(present).map(watch).collect() }
    }

    /// Takes note of a message.
    pub fn hear(&mut self, received: &Received) {
        let kind = DemoSensor::of(&received.message);
        if let Some(watch) = self.watches.iter_mut().find(|watch| watch.kind == kind) {
            watch.receipts.push_back(received.receipt);
            watch.last = Some(received.receipt);
        }
    }

    /// The table at an instant.
    pub fn status(&mut self, now: Time, counts: &Counts) -> Vec<DemoSensorStatus> {
        self.watches.iter_mut().map(|watch| watch.status(now, counts)).collect()
    }
}

impl Watch {
    fn status(&mut self, now: Time, counts: &Counts) -> DemoSensorStatus {
        let window = Span::from_seconds(WINDOW);
        while self.receipts.front().is_some_and(|receipt| now - *receipt >= window) {
            self.receipts.pop_front();
        }
        let listened = (now - Time::START).as_seconds().clamp(1.0, WINDOW);
        let rate = self.receipts.len() as f64 / listened;
        self.usual_rate = self.usual_rate.max(rate);
        let patience = (3.0 / self.usual_rate.max(0.01)).max(2.0);
        let age = self.last.map(|last| now - last);
        let (used, rejected) = usage(self.kind, counts);
        DemoSensorStatus {
            kind: self.kind,
            age,
            rate,
            used,
            rejected,
            silent: age.is_none_or(|age| age.as_seconds() > patience),
        }
    }
}

fn usage(kind: DemoSensor, counts: &Counts) -> (u64, u64) {
    let own = |aid: &str| aid.split('_').next() == Some(kind.prefix());
    let used: u64 = counts.accepted.iter().filter(|(aid, _)| own(aid)).map(|(_, n)| n).sum();
    let refused = counts.rejected.iter().filter(|((aid, _), _)| own(aid));
    let rejected: u64 = refused.map(|(_, n)| n).sum();
    if kind == DemoSensor::Imu {
        let bad = counts.imu_duplicates + counts.imu_out_of_order + counts.imu_out_of_range;
        (used + counts.imu_samples, rejected + bad)
    } else {
        (used, rejected)
    }
}
