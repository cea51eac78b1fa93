//! From frames to messages for the navigator: what all sensors share.

use std::collections::VecDeque;

use insd_base::{
    ExternalReference, Geodetic, GpsTime, LogReference, LogVelocity, Message, Received, Source,
    Span, Stamp, Time,
};
use insd_wire::gnss::{EpochTime, GnssPart, PulseOrder, PulseTime};
use insd_wire::imu::ImuReading;
use insd_wire::nmea::Position;

use crate::Intaken;
use crate::choice::{Choice, Chosen, Quantity};
use crate::clock::{ShipUtc, SystemWatch};
use crate::config::{IntakeConfig, Kind, Role, SensorConfig};
use crate::decode::{Decoder, HeadingReading, Reading, ShipVelocity};
use crate::event::{Happening, IntakeEvent, Refusal};
use crate::magnetic::Variation;
use crate::port::Frame;
use crate::sensor::{Epoch, EpochBuilder, ImuChange, ImuIntake, ImuSettings, Pace, TimeBase};
use crate::status::SensorStatus;

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

/// One sensor at work.
#[derive(Clone, Debug)]
pub(crate) struct Sensor {
    pub(crate) config: SensorConfig,
    pub(crate) port: usize,
    pub(crate) status: SensorStatus,
    decoder: Decoder,
    imu: Option<ImuIntake>,
    epochs: EpochBuilder,
    waiting: VecDeque<Epoch>,
    /// Parts of epochs, with the times of their first and last bytes, before a date was known.
    undated: Vec<(GnssPart, (Time, Time))>,
    /// How often it gives each quantity that is timed by its receipt.
    paces: [Pace; QUANTITIES.len()],
    /// Its number among the sensors of its role.
    number: u8,
}

/// What sensors share.
#[derive(Clone, Debug)]
pub(crate) struct Core {
    pub(crate) sensors: Vec<Sensor>,
    pub(crate) choices: Vec<Choice>,
    pub(crate) utc: ShipUtc,
    pub(crate) outputs: VecDeque<Intaken>,
    variation: Variation,
    system: SystemWatch,
}

impl Core {
    pub(crate) fn new(config: &IntakeConfig) -> Self {
        let mut numbers = [0_u8; 5];
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
        }
    }

    /// A frame of a port, for each sensor on it that speaks its protocol.
    pub(crate) fn frame(&mut self, port: usize, stamp: &Stamp, frame: &Frame<'_>) {
        for index in 0..self.sensors.len() {
            let sensor = &mut self.sensors[index];
            if sensor.port != port || sensor.config.kind.protocol() != frame.protocol {
                continue;
            }
            match sensor.decoder.read(frame.bytes) {
                Ok(readings) => {
                    if !readings.is_empty() {
                        self.spoke(index, stamp.monotonic);
                    }
                    for reading in readings {
                        self.reading(index, stamp, frame, &reading);
                    }
                }
                Err(reason) => self.refuse(index, reason),
            }
        }
        self.tell_time(stamp.monotonic);
    }

    /// Time passes: silences come to light.
    pub(crate) fn tick(&mut self, stamp: &Stamp) {
        let now = stamp.monotonic;
        if let Some(by) = self.system.look(stamp) {
            self.tell(now, Happening::SystemClockStepped { by });
        }
        self.utc.tick(now);
        self.tell_time(now);
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

    fn reading(&mut self, index: usize, stamp: &Stamp, frame: &Frame<'_>, reading: &Reading) {
        match reading {
            Reading::Imu(sample) => self.imu(index, stamp, frame, sample),
            Reading::Gnss(part) => self.gnss(index, stamp, frame, part),
            Reading::Pulse(pulse) => self.pulse_time(stamp, pulse),
            Reading::Velocity(velocity) => self.velocity(index, stamp, frame, velocity),
            Reading::Heading(heading) => self.heading(index, stamp, frame, heading),
            Reading::Fix(position, std) => self.manual(index, stamp, frame, *position, *std),
            Reading::Idle => {}
        }
    }

    fn imu(&mut self, index: usize, stamp: &Stamp, frame: &Frame<'_>, sample: &ImuReading) {
        let now = stamp.monotonic;
        self.validity(index, now, sample.valid, sample.status);
        let sensor = &mut self.sensors[index];
        sensor.status.temperature = sample.temperature.or(sensor.status.temperature);
        let Some(imu) = &mut sensor.imu else { return };
        let mut ready = Vec::new();
        let changes = imu.take(sample, frame.begun, &self.utc, &mut ready);
        if let (Some(utc), None) = (sample.utc, changes[1]) {
            let priority = sensor.config.priority.saturating_add(100);
            let latency = Span::from_seconds(sensor.config.latency_s);
            if let Some(gps) = self.utc.resolve(&EpochTime::Utc(utc), stamp) {
                self.utc.message((priority, index), gps, frame.begun, latency);
            }
        }
        for change in changes.into_iter().flatten() {
            self.tell_imu(index, now, change);
        }
        if !sample.valid {
            self.refuse(index, Refusal::Invalid);
        }
        if self.sensors[index].config.time == TimeBase::Utc && sample.utc.is_none() {
            self.refuse(index, Refusal::NoTime);
        }
        let used = self.choose(Quantity::Inertial, index, sample.valid, now);
        let number = self.sensors[index].number;
        for sample in ready {
            if used {
                self.pass(index, now, Source::Imu(number), Message::Imu(sample));
            } else {
                self.refuse(index, Refusal::NotChosen);
            }
        }
    }

    fn tell_imu(&mut self, index: usize, now: Time, change: ImuChange) {
        let what = match change {
            ImuChange::Lost(count) => {
                self.sensors[index].status.lost += count;
                Happening::SamplesLost { sensor: index, count }
            }
            ImuChange::ClockStepped(by) => Happening::DeviceClockStepped { sensor: index, by },
        };
        self.tell(now, what);
    }

    /// Parts of epochs that came before any date was known wait for it.
    fn gnss(&mut self, index: usize, stamp: &Stamp, frame: &Frame<'_>, part: &GnssPart) {
        let gps = part.epoch.and_then(|epoch| self.utc.resolve(&epoch, stamp));
        let times = (frame.begun, frame.ended);
        let undated = &mut self.sensors[index].undated;
        if gps.is_none() && (part.epoch.is_some() || !undated.is_empty()) {
            if undated.len() < WAITING {
                undated.push((*part, times));
            } else {
                self.refuse(index, Refusal::NoTime);
            }
            return;
        }
        for (early, times) in std::mem::take(undated) {
            let gps = early.epoch.and_then(|epoch| self.utc.resolve(&epoch, stamp));
            self.part(index, stamp, times, &early, gps);
        }
        self.part(index, stamp, times, part, gps);
    }

    fn part(
        &mut self,
        index: usize,
        stamp: &Stamp,
        (first, ended): (Time, Time),
        part: &GnssPart,
        gps: Option<GpsTime>,
    ) {
        let config = &self.sensors[index].config;
        let latency = Span::from_seconds(config.latency_s);
        let (begun, priority) = (first - latency, config.priority);
        if let Some(gps) = gps
            && !part.invalid
            && !self.utc.message((priority, index), gps, first, latency)
        {
            self.refuse(index, Refusal::TimeDoubted);
            return;
        }
        let sensor = &mut self.sensors[index];
        if let Some(epoch) = sensor.epochs.take(part, gps, begun, ended) {
            if sensor.waiting.len() == WAITING {
                sensor.waiting.pop_front();
            }
            sensor.waiting.push_back(epoch);
        }
        while let Some(epoch) = self.sensors[index].waiting.pop_front() {
            let Some(time) = self.utc.time_of(epoch.gps) else {
                self.sensors[index].waiting.push_front(epoch);
                break;
            };
            self.epoch(index, stamp.monotonic, time, &epoch);
        }
    }

    fn epoch(&mut self, index: usize, now: Time, time: Time, epoch: &Epoch) {
        let sensor = &self.sensors[index];
        let (number, role, uses_heading) =
            (sensor.number, sensor.config.kind.role(), sensor.config.heading);
        let (std, offset) = (sensor.config.heading_std_deg, sensor.config.heading_offset_deg);
        let default_std = sensor.config.position_std_m;
        let fix = epoch.fix(time);
        self.validity(index, now, epoch.is_valid(), 0);
        if let Some(position) = fix.position.filter(|_| epoch.is_valid()) {
            self.variation.here(position, self.utc.utc_at(time));
        }
        if role == Role::Position {
            let std = fix.position_std.map(|std| std.0.xy().norm());
            let reference = ExternalReference {
                time,
                position: fix.position,
                position_std: std.filter(|std| std.is_finite()).or(Some(default_std)),
                ..ExternalReference::default()
            };
            self.reference(Quantity::Position, index, now, epoch.is_valid(), reference);
            return;
        }
        if uses_heading && let Some(heading) = epoch.part.heading {
            let heading = insd_base::units::wrap_two_pi(heading + offset.to_radians());
            let reference = ExternalReference {
                time,
                heading: Some(heading),
                heading_std: epoch.part.heading_std.or(Some(std.to_radians())),
                ..ExternalReference::default()
            };
            self.reference(Quantity::Heading, index, now, epoch.is_valid(), reference);
        }
        if self.choose(Quantity::Gnss, index, epoch.is_valid(), now) {
            self.pass(index, now, Source::Gnss(number), Message::Gnss(fix));
        } else {
            self.refuse(index, Refusal::NotChosen);
        }
    }

    fn manual(
        &mut self,
        index: usize,
        stamp: &Stamp,
        frame: &Frame<'_>,
        position: Position,
        std: Option<f64>,
    ) {
        let now = stamp.monotonic;
        let Position { latitude, longitude } = position;
        let default = self.sensors[index].config.position_std_m;
        self.validity(index, now, true, 0);
        let reference = ExternalReference {
            time: frame.begun,
            position: Some(Geodetic { latitude, longitude, height: 0.0 }),
            position_std: std.filter(|std| *std > 0.0).or(Some(default)),
            ..ExternalReference::default()
        };
        self.reference(Quantity::Position, index, now, true, reference);
    }

    fn pulse_time(&mut self, stamp: &Stamp, pulse: &PulseTime) {
        let gps = self.utc.resolve(&pulse.instant, stamp);
        if let Some(gps) = gps.filter(|_| pulse.order == PulseOrder::Next) {
            self.utc.announce(gps);
        }
    }

    fn velocity(&mut self, index: usize, stamp: &Stamp, frame: &Frame<'_>, told: &ShipVelocity) {
        let now = stamp.monotonic;
        let latency = self.sensors[index].config.latency_s + told.age;
        let by_receipt = frame.begun - Span::from_seconds(latency);
        let own = told.gps.filter(|gps| self.fits(*gps, frame.begun));
        let own = own.and_then(|gps| self.utc.time_of(gps));
        self.validity(index, now, told.valid, 0);
        let quantity = match told.reference {
            LogReference::Bottom => Quantity::BottomVelocity,
            LogReference::Water => Quantity::WaterVelocity,
        };
        let used = self.choose(quantity, index, told.valid, now);
        if !told.valid {
            self.refuse(index, Refusal::Invalid);
        } else if used && own.is_none() && !self.is_fresh(quantity, index, frame) {
            self.refuse(index, Refusal::TimeDoubted);
        } else if used {
            let time = own.unwrap_or(by_receipt);
            let [u, v, w] = told.velocity;
            let (std, reference) = (Some(told.std), told.reference);
            let message = Message::Log(LogVelocity { time, u, v, w, std, reference });
            self.pass(index, now, Source::Log(self.sensors[index].number), message);
        } else {
            self.refuse(index, Refusal::NotChosen);
        }
    }

    /// Whether an instant that a log tells is near its receipt.
    fn fits(&self, gps: GpsTime, begun: Time) -> bool {
        let late = self.utc.time_of(gps).map(|time| (begun - time).as_seconds());
        late.is_some_and(|late| (-0.1..2.5).contains(&late))
    }

    /// Whether a reading that is timed by its receipt is not one that waited, or one told again.
    fn is_fresh(&mut self, quantity: Quantity, index: usize, frame: &Frame<'_>) -> bool {
        self.sensors[index].paces[quantity as usize].is_fresh(frame.begun)
    }

    fn heading(&mut self, index: usize, stamp: &Stamp, frame: &Frame<'_>, told: &HeadingReading) {
        let now = stamp.monotonic;
        let config = &self.sensors[index].config;
        let time = frame.begun - Span::from_seconds(config.latency_s);
        let std = told.std.unwrap_or(config.heading_std_deg.to_radians());
        let Some((heading, std)) = self.variation.to_true(told, std) else {
            self.refuse(index, Refusal::Magnetic);
            return;
        };
        self.validity(index, now, told.valid, 0);
        if told.valid && !self.is_fresh(Quantity::Heading, index, frame) {
            self.refuse(index, Refusal::TimeDoubted);
            return;
        }
        let reference = ExternalReference {
            time,
            heading: Some(heading),
            heading_std: Some(std),
            ..ExternalReference::default()
        };
        self.reference(Quantity::Heading, index, now, told.valid, reference);
    }

    fn reference(
        &mut self,
        quantity: Quantity,
        index: usize,
        now: Time,
        valid: bool,
        reference: ExternalReference,
    ) {
        let used = self.choose(quantity, index, valid, now);
        if !valid {
            self.refuse(index, Refusal::Invalid);
        } else if used {
            let number = u8::try_from(index).unwrap_or(u8::MAX);
            self.pass(index, now, Source::Reference(number), Message::Reference(reference));
        } else {
            self.refuse(index, Refusal::NotChosen);
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

impl Sensor {
    fn new(config: &SensorConfig, intake: &IntakeConfig, number: u8) -> Self {
        let port = intake.ports.iter().position(|port| port.name == config.port);
        let settings = config.mounting.c_bd().map(|c_bd| ImuSettings {
            period: 1.0 / config.rate_hz,
            latency: config.latency_s,
            time_base: config.time,
            c_bd,
        });
        let is_imu = config.kind.role() == Role::Imu;
        Sensor {
            config: config.clone(),
            port: port.unwrap_or(usize::MAX),
            status: SensorStatus { name: config.name.clone(), ..SensorStatus::default() },
            decoder: Decoder::new(config),
            imu: settings.filter(|_| is_imu).map(ImuIntake::new),
            epochs: EpochBuilder::default(),
            waiting: VecDeque::new(),
            undated: Vec::new(),
            paces: [Pace::default(); QUANTITIES.len()],
            number,
        }
    }

    fn quantities(&self) -> &'static [Quantity] {
        match self.config.kind.role() {
            Role::Imu => &[Quantity::Inertial],
            Role::Gnss if self.config.heading => &[Quantity::Gnss, Quantity::Heading],
            Role::Gnss => &[Quantity::Gnss],
            Role::Log => &[Quantity::BottomVelocity, Quantity::WaterVelocity],
            Role::Heading => &[Quantity::Heading],
            Role::Position if self.config.kind == Kind::Manual => {
                &[Quantity::Position, Quantity::Heading]
            }
            Role::Position => &[Quantity::Position],
        }
    }
}
