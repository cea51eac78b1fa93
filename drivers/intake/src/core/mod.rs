//! From frames to messages for the navigator: what all sensors share.

mod array;
mod base;
mod came;
mod camera;
mod gnss;
mod imu;
mod ranging;
mod reference;
mod satellites;
mod sensor;
mod sky;
mod watch;

use std::collections::VecDeque;

use insd_base::can::{BusEvent, CanFrame};
use insd_base::{Geodetic, Message, PortId, Received, Source, Span, Stamp, Time};
use insd_gnss::Turns;

use self::array::Array;
pub(crate) use self::came::Came;
use insd_n2k::Name;

use crate::choice::{Choice, Chosen, Quantity};
use crate::clock::{ShipUtc, SystemWatch};
use crate::config::{IntakeConfig, Role, SensorConfig};
use crate::decode::Reading;
use crate::device::{Device, Heard};
use crate::event::{Happening, IntakeEvent, Refusal};
use crate::intaken::Intaken;
use crate::magnetic::Variation;
use crate::port::PortFrame;
use crate::ranging::DockingAid;

pub(crate) use sensor::Sensor;

/// A better source must have been valid for this long to be taken back, s.
const HOLD: f64 = 10.0;
/// Epochs that wait for UTC to become known.
const WAITING: usize = 64;
/// Quantities that are chosen among sensors.
const QUANTITIES: [Quantity; 6] = [
    Quantity::Inertial,
    Quantity::Gnss,
    Quantity::BottomVelocity,
    Quantity::WaterVelocity,
    Quantity::Heading,
    Quantity::Position,
];

/// What sensors share.
#[derive(Clone, Debug)]
pub(crate) struct Core {
    pub(crate) sensors: Vec<Sensor>,
    pub(crate) choices: Vec<Choice>,
    pub(crate) utc: ShipUtc,
    pub(crate) outputs: VecDeque<Intaken>,
    variation: Variation,
    system: SystemWatch,
    /// Where the ship was by the last position of a receiver.
    here: Option<Geodetic>,
    /// How the ship turns, by the IMU in use.
    turns: Turns,
    /// Receivers that together are a compass.
    array: Option<Array>,
    /// Whose ranges of satellites are used, and when they came last.
    ranging: Option<(usize, Time)>,
    /// Docking aids.
    aids: Vec<DockingAid>,
}

/// The receivers of a configuration that together are a compass.
fn array(config: &IntakeConfig) -> Option<Array> {
    let sensors = config.sensors.iter().enumerate().filter(|(_, sensor)| sensor.array);
    let lever = |sensor: &SensorConfig| sensor.lever().unwrap_or_default();
    let own = sensors.map(|(index, sensor)| (index, lever(sensor), sensor.clock.as_deref()));
    Array::new(&own.collect::<Vec<_>>())
}

impl Core {
    pub(crate) fn new(config: &IntakeConfig) -> Self {
        let mut numbers = [0_u8; 9];
        let sensors = config.sensors.iter().map(|sensor| {
            let number = &mut numbers[sensor.kind.role() as usize];
            let own = Sensor::new(sensor, config, *number);
            *number = number.saturating_add(1);
            own
        });
        let sensors: Vec<Sensor> = sensors.collect();
        let hold = Span::from_seconds(HOLD);
        let mut choices = QUANTITIES.map(|quantity| Choice::new(quantity, hold)).to_vec();
        for (index, sensor) in sensors.iter().enumerate() {
            let patience = Span::from_seconds(sensor.config.patience_s);
            let only = config.imu.as_ref().filter(|_| sensor.config.kind.role() == Role::Imu);
            if only.is_some_and(|only| *only != sensor.config.name) {
                continue;
            }
            for quantity in sensor.quantities() {
                choices[*quantity as usize].add(index, sensor.config.priority, patience);
            }
        }
        Core {
            sensors,
            choices,
            utc: ShipUtc::default(),
            outputs: VecDeque::new(),
            variation: Variation::default(),
            system: SystemWatch::default(),
            here: None,
            turns: Turns::default(),
            array: array(config),
            ranging: None,
            aids: config.rangings.iter().cloned().map(DockingAid::new).collect(),
        }
    }

    /// A frame of a port, for each sensor on it that speaks its protocol.
    pub(crate) fn frame(&mut self, port: usize, stamp: &Stamp, frame: &PortFrame<'_>) {
        let came = Came { begun: frame.begun, ended: frame.ended };
        for index in 0..self.sensors.len() {
            let sensor = &mut self.sensors[index];
            if sensor.port == port && sensor.config.kind.protocol() == Some(frame.protocol) {
                let told = sensor.decoder.read(frame.bytes);
                self.told(index, stamp, came, told);
            }
        }
        self.tell_time(stamp.monotonic);
    }

    /// A frame of a CAN port, for each IMU on it. `begun`: when its first bit came.
    pub(crate) fn can_frame(&mut self, port: usize, stamp: &Stamp, frame: &CanFrame, begun: Time) {
        for index in 0..self.sensors.len() {
            let sensor = &mut self.sensors[index];
            if sensor.port != port {
                continue;
            }
            let incomplete = sensor.decoder.incomplete();
            let (begun, told) = sensor.decoder.can_frame(frame, begun);
            for _ in incomplete..sensor.decoder.incomplete() {
                self.refuse(index, Refusal::Incomplete);
            }
            self.told(index, stamp, Came { begun, ended: stamp.monotonic }, told);
        }
        self.tell_time(stamp.monotonic);
    }

    /// A message of a CAN port, for each sensor of NMEA 2000 on it. `name`: the sender's, if it is known.
    pub(crate) fn message(
        &mut self,
        port: usize,
        stamp: &Stamp,
        came: Came,
        message: &insd_n2k::BusMessage,
        name: Option<Name>,
    ) {
        let from = Device { name, address: message.source };
        for index in 0..self.sensors.len() {
            let sensor = &mut self.sensors[index];
            let own = sensor.port == port;
            let Some(role) = own.then(|| sensor.decoder.role(message)).flatten() else { continue };
            let (begun, told) = match sensor.device.hear(from, role, stamp.monotonic) {
                Heard::Other => (came.begun, Err(Refusal::OtherDevice)),
                Heard::Nobody => continue,
                Heard::Own { chosen } => {
                    sensor.status.device = sensor.device.current();
                    if chosen {
                        sensor.decoder.forget_device();
                        self.tell(
                            stamp.monotonic,
                            Happening::Device { sensor: index, device: from },
                        );
                    }
                    self.sensors[index].decoder.message(message, came.begun)
                }
            };
            self.told(index, stamp, Came { begun, ..came }, told);
        }
        self.tell_time(stamp.monotonic);
    }

    /// What a controller says of the bus of a port. Errors on the wire are counted by the port alone.
    pub(crate) fn bus(&mut self, port: PortId, now: Time, event: BusEvent) {
        if !matches!(event, BusEvent::Error { .. }) {
            self.tell(now, Happening::Bus { port, event });
        }
    }

    fn told(
        &mut self,
        index: usize,
        stamp: &Stamp,
        came: Came,
        told: Result<Vec<Reading>, Refusal>,
    ) {
        match told {
            Ok(readings) => {
                if !readings.is_empty() {
                    self.spoke(index, stamp.monotonic);
                }
                for reading in readings {
                    self.reading(index, stamp, came, &reading);
                }
            }
            Err(reason) => self.refuse(index, reason),
        }
    }

    /// Time passes: silences come to light.
    pub(crate) fn tick(&mut self, stamp: &Stamp) {
        let now = stamp.monotonic;
        if let Some(by) = self.system.look(stamp) {
            self.tell(now, Happening::SystemClockStepped { by });
        }
        self.utc.tick(now);
        self.tell_time(now);
        self.look_at_ranges(now);
        for index in 0..self.choices.len() {
            let chosen = self.choices[index].look(now);
            self.tell_choice(now, chosen);
        }
        for index in 0..self.sensors.len() {
            let own = &mut self.sensors[index];
            let patience = own.config.patience_s;
            let silent = own.status.heard.is_some_and(|last| (now - last).as_seconds() > patience);
            if silent && !own.status.silent {
                own.status.silent = true;
                self.tell(now, Happening::SensorSilent { sensor: index });
            }
        }
    }

    pub(crate) fn tell(&mut self, time: Time, what: Happening) {
        self.outputs.push_back(Intaken::Event(IntakeEvent { time, what }));
    }

    fn reading(&mut self, index: usize, stamp: &Stamp, came: Came, reading: &Reading) {
        match reading {
            Reading::Imu(sample) => self.imu(index, stamp, came, sample),
            Reading::Gnss(part) => self.gnss(index, stamp, came, part),
            Reading::Raw(reading) => self.raw(index, stamp, came, reading),
            Reading::Base(frame) => self.base(index, stamp, frame),
            Reading::Pulse(pulse) => self.pulse_time(index, stamp, pulse),
            Reading::Velocity(velocity) => self.velocity(index, stamp, came, velocity),
            Reading::Heading(heading) => self.heading(index, stamp, came, heading),
            Reading::Fix(position, std) => self.manual(index, stamp, came, *position, *std),
            Reading::Place(position) => self.place(index, stamp, came, *position),
            Reading::Range(range) => self.distance(index, stamp, came, range),
            Reading::Tracks(tracks) => self.tracks(index, stamp, came, tracks),
            Reading::Step(step) => self.step(index, stamp, came, step),
            Reading::Clock(epoch) => self.clock(index, stamp, came, epoch),
            Reading::Shown(shown) => self.shown(index, came, *shown),
            Reading::LeftOut(reason) => self.refuse(index, *reason),
            Reading::Idle => {}
        }
    }

    fn pass(&mut self, index: usize, receipt: Time, source: Source, message: Message) {
        self.sensors[index].status.passed += 1;
        self.outputs.push_back(Intaken::Measured(Received { receipt, source, message }));
    }

    pub(crate) fn refuse(&mut self, index: usize, reason: Refusal) {
        *self.sensors[index].status.refused.entry(reason).or_insert(0) += 1;
    }

    fn choose(&mut self, quantity: Quantity, index: usize, valid: bool, now: Time) -> bool {
        let choice = &mut self.choices[quantity as usize];
        let chosen = choice.hear(index, valid, now);
        let used = choice.is_used(index);
        self.tell_choice(now, chosen);
        used
    }

    fn tell_choice(&mut self, now: Time, chosen: Option<Chosen>) {
        if let Some(chosen) = chosen {
            self.tell(now, Happening::Chosen(chosen));
        }
    }

    fn tell_time(&mut self, now: Time) {
        for change in self.utc.take_changes() {
            self.tell(now, Happening::Time(change));
        }
    }

    fn spoke(&mut self, index: usize, now: Time) {
        let status = &mut self.sensors[index].status;
        let news = status.heard.is_none() || status.silent;
        status.heard = Some(now);
        status.silent = false;
        if news {
            self.tell(now, Happening::SensorSpeaks { sensor: index });
        }
    }

    fn validity(&mut self, index: usize, now: Time, valid: bool, word: u32) {
        let status = &mut self.sensors[index].status;
        let changed =
            status.valid.is_some_and(|before| before != valid) || status.valid.is_none() && !valid;
        status.valid = Some(valid);
        status.status = word;
        if changed {
            self.tell(now, Happening::SensorValid { sensor: index, valid, status: word });
        }
    }
}
