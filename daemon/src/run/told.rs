//! Events in words, for the journal.

use insd_base::Event;
use insd_drivers::ports::{Judge, Judgement};
use insd_engine::Output;
use insd_intake::Intake;
use insd_intake::event::{Happening, IntakeEvent};
use insd_wire::stream::{Cutter, Protocol};

use crate::pipeline::Product;

/// Good frames at which a baud rate is taken as right.
const CONVINCED: usize = 3;

/// Tells what is worth telling of a product.
pub fn tell(intake: &Intake, product: &Product) {
    match product {
        Product::Intake(event) => tell_event(intake, event),
        Product::Engine(Output::Event(event)) => tell_engine(event),
        Product::Engine(Output::Alignment(status)) => tracing::debug!(?status, "alignment"),
        Product::Engine(_) | Product::Spoken(_) => {}
    }
}

/// Changes of what the ship does or knows are worth a line each; refused measurements are counted.
fn tell_engine(event: &Event) {
    match event {
        Event::Rejected { .. } => tracing::debug!(?event, "engine"),
        Event::ModeChanged { time, to } => {
            tracing::info!(at = time.as_seconds(), mode = to.as_str(), "mode");
        }
        Event::ImuGap { time, missing } => {
            tracing::warn!(at = time.as_seconds(), missing, "gap in the IMU data bridged");
        }
        _ => tracing::info!(?event, "engine"),
    }
}

fn tell_event(intake: &Intake, event: &IntakeEvent) {
    let at = event.time.as_seconds();
    let name = |sensor: &usize| intake.sensor_name(*sensor).to_owned();
    match &event.what {
        Happening::Port { port, state } => {
            tracing::info!(at, port = intake.port_name(*port), "{state}");
        }
        Happening::Bus { port, event } => {
            tracing::warn!(at, port = intake.port_name(*port), "bus: {event}");
        }
        Happening::Device { sensor, device } => {
            let (address, known) = (device.address, device.name.map(|name| name.to_string()));
            tracing::info!(at, sensor = name(sensor), address, name = ?known, "device");
        }
        Happening::SensorSpeaks { sensor } => tracing::info!(at, sensor = name(sensor), "speaks"),
        Happening::SensorSilent { sensor } => tracing::warn!(at, sensor = name(sensor), "silent"),
        Happening::SensorValid { sensor, valid, status } => {
            tracing::warn!(at, sensor = name(sensor), valid, status, "validity");
        }
        Happening::SamplesLost { sensor, count } => {
            tracing::warn!(at, sensor = name(sensor), count, "samples lost");
        }
        Happening::DeviceClockStepped { sensor, by } => {
            tracing::warn!(at, sensor = name(sensor), by, "device clock stepped");
        }
        Happening::Chosen(chosen) => {
            let (from, to) = (chosen.from.as_ref().map(name), chosen.to.as_ref().map(name));
            tracing::info!(at, quantity = ?chosen.quantity, ?from, ?to, why = ?chosen.why, "source");
        }
        Happening::Time(change) => tracing::info!(at, ?change, "time"),
        Happening::SystemClockStepped { by } => {
            tracing::warn!(at, by = by.as_seconds(), "system clock stepped");
        }
    }
}

/// Judges the bytes heard at a baud rate: right if they hold a few good frames of any protocol.
pub(super) fn judge() -> Judge {
    Judge::new(|bytes| {
        let mut cutter = Cutter::new(&Protocol::ALL);
        cutter.push(bytes);
        let mut frames = 0;
        while cutter.cut().is_some() {
            frames += 1;
        }
        if frames >= CONVINCED { Judgement::Fits } else { Judgement::Wrong }
    })
}
