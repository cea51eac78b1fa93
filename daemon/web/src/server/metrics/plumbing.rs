//! Sensors, satellites, ports, aids and the recording.

use std::collections::BTreeMap;

use crate::snapshot::{Sensor, ShownInput, ShownOutput, ShownPortState, SkyState, Snapshot};

use super::sheet::Sheet;
use super::ship::word;

/// Name, help, and where it is found.
type Count<T> = (&'static str, &'static str, fn(&T) -> u64);

const INPUT_COUNTS: [Count<ShownInput>; 7] = [
    ("input_bytes", "Bytes taken", |port| port.bytes),
    ("input_frames", "Frames found", |port| port.frames),
    ("input_damaged_frames", "Frames with a wrong checksum", |port| port.damaged),
    ("input_skipped_bytes", "Bytes that belonged to no frame", |port| port.skipped_bytes),
    ("input_overrun_bytes", "Bytes dropped as too many came", |port| port.overrun_bytes),
    ("input_refused", "Datagrams and calls of hosts that were not let in", |port| port.refused),
    ("input_reopened", "Times that the port was opened again", |port| port.reopened),
];

const OUTPUT_COUNTS: [Count<ShownOutput>; 3] = [
    ("output_sent_messages", "Messages handed over to the system", |port| port.sent),
    ("output_dropped_messages", "Messages that will never leave", |port| port.dropped),
    ("output_bytes", "Bytes of the messages sent", |port| port.bytes),
];

const SENSOR_COUNTS: [Count<Sensor>; 2] = [
    ("sensor_passed", "Measurements passed on to the navigator", |sensor| sensor.passed),
    ("sensor_lost_samples", "Samples missing by the sensor's counter", |sensor| sensor.lost),
];

/// Enters all of it.
pub(super) fn write(sheet: &mut Sheet, snapshot: &Snapshot) {
    sensors(sheet, snapshot);
    satellites(sheet, snapshot);
    inputs(sheet, snapshot);
    outputs(sheet, snapshot);
    watched(sheet, snapshot);
    aids(sheet, snapshot);
    buses(sheet, snapshot);
    fleets(sheet, snapshot);
    others(sheet, snapshot);
}

fn sensors(sheet: &mut Sheet, snapshot: &Snapshot) {
    let state = sheet.gauge("sensor_state", "How a sensor is: 1", ["sensor", "state"]);
    let rate = sheet.gauge("sensor_rate_hertz", "Measurements a second", ["sensor"]);
    let age = sheet.gauge("sensor_age_seconds", "Time since it was heard", ["sensor"]);
    let warmth = sheet.gauge("sensor_temperature_celsius", "Its temperature", ["sensor"]);
    let refused = sheet.counter(
        "sensor_refused",
        "Measurements and frames not passed on",
        ["sensor", "reason"],
    );
    for sensor in &snapshot.sensors {
        let name = sensor.name.as_str();
        state.set(&[name, &word(&sensor.state)], 1.0);
        rate.set(&[name], sensor.rate_hz);
        age.set(&[name], sensor.age_s);
        warmth.set(&[name], sensor.temperature_c);
        for cause in &sensor.refused {
            refused.set(&[name, &cause.reason], cause.count);
        }
    }
    for (name, help, of) in SENSOR_COUNTS {
        let counter = sheet.counter(name, help, ["sensor"]);
        snapshot.sensors.iter().for_each(|sensor| counter.set(&[&sensor.name], of(sensor)));
    }
}

fn watched(sheet: &mut Sheet, snapshot: &Snapshot) {
    let labels = ["sensor", "against", "quantity"];
    let angle =
        sheet.gauge("watch_difference_degrees", "A watched sensor less another one", labels);
    let name = |against: &Option<String>| against.clone().unwrap_or_else(|| "insd".to_owned());
    for own in &snapshot.watched {
        angle.set(&[&own.sensor, &name(&own.against), &own.quantity], own.difference_deg);
    }
    let way = sheet.gauge("watch_difference_meters", "How far two positions are apart", labels);
    for own in &snapshot.watched {
        way.set(&[&own.sensor, &name(&own.against), &own.quantity], own.difference_m);
    }
    let differs = sheet.gauge("watch_differs", "Whether it has been beyond its limit: 1", labels);
    for own in &snapshot.watched {
        let labels = [own.sensor.as_str(), &name(&own.against), &own.quantity];
        differs.set(&labels, f64::from(u8::from(own.differs)));
    }
}

fn satellites(sheet: &mut Sheet, snapshot: &Snapshot) {
    let sky = &snapshot.sky;
    let refused =
        sheet.counter("satellites_refused", "Satellites of epochs without a range", ["reason"]);
    sky.refused.iter().for_each(|cause| refused.set(&[&cause.reason], cause.count));
    let against_base =
        sheet.counter("rtk_epochs", "Epochs against a base, and turns of RTK", ["outcome"]);
    sky.against_base.iter().for_each(|cause| against_base.set(&[&cause.reason], cause.count));
    if sky.state != SkyState::Raw {
        return;
    }
    sheet.value("satellites_used", "Satellites in use", sky.used.map(f64::from));
    let unused = sheet.gauge("satellites_unused", "Satellites not in use", ["reason"]);
    let mut reasons: BTreeMap<&str, f64> = BTreeMap::new();
    for reason in sky.satellites.iter().filter_map(|own| own.reason.as_deref()) {
        *reasons.entry(reason).or_default() += 1.0;
    }
    reasons.into_iter().for_each(|(reason, count)| unused.set(&[reason], count));
    let strength = sheet.gauge(
        "satellite_cn0_db_hertz",
        "Carrier to noise density of a signal",
        ["satellite", "signal"],
    );
    for own in &sky.satellites {
        for signal in &own.signals {
            strength.set(&[&own.name, &signal.code], signal.cn0_db_hz);
        }
    }
}

fn inputs(sheet: &mut Sheet, snapshot: &Snapshot) {
    let up = sheet.gauge("input_up", "Whether the port is open and speaks", ["port"]);
    for port in &snapshot.inputs {
        up.set(&[&port.name], is_up(port.state));
    }
    for (name, help, of) in INPUT_COUNTS {
        let counter = sheet.counter(name, help, ["port"]);
        snapshot.inputs.iter().for_each(|port| counter.set(&[&port.name], of(port)));
    }
}

fn outputs(sheet: &mut Sheet, snapshot: &Snapshot) {
    let up = sheet.gauge("output_up", "Whether the port is open", ["port"]);
    let waiting = sheet.gauge("output_waiting_messages", "Messages that wait", ["port"]);
    let ages = sheet.gauge(
        "output_age_seconds",
        "Age of messages when they leave: median, 99 %, greatest",
        ["port", "quantile"],
    );
    for port in &snapshot.outputs {
        up.set(&[&port.name], is_up(port.state));
        waiting.set(&[&port.name], port.waiting as f64);
        if let Some(age) = port.age_ms {
            for (quantile, value) in [("0.5", age.p50), ("0.99", age.p99), ("1", age.max)] {
                ages.set(&[&port.name, quantile], value * 1e-3);
            }
        }
    }
    for (name, help, of) in OUTPUT_COUNTS {
        let counter = sheet.counter(name, help, ["port"]);
        snapshot.outputs.iter().for_each(|port| counter.set(&[&port.name], of(port)));
    }
    let schedule = snapshot.schedule;
    for (name, help, count) in [
        ("epochs", "Instants at which something was due", schedule.epochs),
        ("epochs_late", "Epochs begun more than 1 ms late", schedule.late),
        ("epochs_skipped", "Epochs skipped as too late", schedule.skipped),
    ] {
        sheet.count(name, help, count);
    }
}

fn aids(sheet: &mut Sheet, snapshot: &Snapshot) {
    let accepted = sheet.counter("aid_accepted", "Measurements used", ["aid"]);
    let rejected = sheet.counter("aid_rejected", "Measurements not used", ["aid", "reason"]);
    let floored = sheet.counter("aid_floored", "Sigmas replaced by a floor", ["aid"]);
    for aid in &snapshot.aids {
        accepted.set(&[&aid.name], aid.accepted);
        floored.set(&[&aid.name], aid.floored);
        for cause in &aid.reasons {
            rejected.set(&[&aid.name, &cause.reason], cause.count);
        }
    }
    let samples = snapshot.samples;
    let taken = sheet.counter("imu_samples", "Samples of the IMU by their fate", ["fate"]);
    for (fate, count) in [
        ("used", samples.used),
        ("duplicate", samples.duplicates),
        ("out_of_order", samples.out_of_order),
        ("out_of_range", samples.out_of_range),
    ] {
        taken.set(&[fate], count);
    }
    sheet.count("imu_gaps", "Gaps in the IMU data that were bridged", samples.gaps);
}

fn buses(sheet: &mut Sheet, snapshot: &Snapshot) {
    let state =
        sheet.gauge("bus_state", "What the controller says of its bus: 1", ["port", "state"]);
    let load = sheet.gauge("bus_load_ratio", "Load of the bus", ["port"]);
    let errors = sheet.counter("bus_errors", "Errors on the wire", ["port"]);
    let offs = sheet.counter("bus_offs", "Times that the controller left the bus", ["port"]);
    for bus in &snapshot.buses {
        state.set(&[&bus.port, &word(&bus.state)], 1.0);
        load.set(&[&bus.port], bus.load);
        errors.set(&[&bus.port], bus.errors);
        offs.set(&[&bus.port], bus.offs);
    }
}

fn fleets(sheet: &mut Sheet, snapshot: &Snapshot) {
    if snapshot.fleets.is_empty() {
        return;
    }
    let up = sheet.gauge("fleet_up", "Whether the broker is connected: 1", ["fleet"]);
    let sent =
        sheet.counter("fleet_sent_messages", "Messages that the broker has taken", ["fleet"]);
    let bytes = sheet.counter("fleet_sent_bytes", "Bytes of their payloads", ["fleet"]);
    let waiting = sheet.gauge("fleet_waiting_records", "Records not ashore yet", ["fleet"]);
    let lost = sheet.counter("fleet_lost_records", "Records never sent", ["fleet", "reason"]);
    for fleet in &snapshot.fleets {
        let name = fleet.name.as_str();
        up.set(&[name], f64::from(u8::from(fleet.connected)));
        sent.set(&[name], fleet.sent_messages);
        bytes.set(&[name], fleet.sent_bytes);
        waiting.set(&[name], fleet.waiting as f64);
        lost.set(&[name, "quota"], fleet.lost_quota);
        lost.set(&[name, "expired"], fleet.lost_expired);
        lost.set(&[name, "unwritten"], fleet.lost_unwritten);
    }
}

fn others(sheet: &mut Sheet, snapshot: &Snapshot) {
    sheet.count("log_repeats", "Lines of the journal left out", snapshot.log.repeats);
    let Some(recording) = &snapshot.recording else { return };
    let state = sheet.gauge("recording_state", "How the recording is going: 1", ["state"]);
    state.set(&[&word(&recording.state)], 1.0);
    sheet.count("recording_bytes", "Bytes recorded", recording.bytes);
    let lost = "Arrivals left out of the recording";
    sheet.count("recording_lost_arrivals", lost, recording.lost);
}

fn is_up(state: ShownPortState) -> f64 {
    f64::from(u8::from(state == ShownPortState::Open))
}
