//! The wire of a sensor, and what is on it.

use insd_base::can::CanFrame;
use insd_base::{Input, Span, Time};

use super::sensor::SensorFeed;

/// A message on the wire.
#[derive(Clone, Debug, PartialEq)]
pub struct LineSending {
    /// Time of the voyage at which its last byte is on the wire.
    pub at: Time,
    /// Index of the port, which is that of the sensor, or of the first of NMEA 2000.
    pub port: usize,
    /// All its bytes, or a frame.
    pub input: Input,
}

impl LineSending {
    /// Its bytes; none of a frame.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        if let Input::Bytes(bytes) = &self.input { bytes } else { &[] }
    }
}

/// A serial line: one byte after the other.
#[derive(Debug)]
pub(super) struct Line {
    port: usize,
    pub(super) latency: Span,
    byte_time: f64,
    free: Time,
    pub(super) sent: Vec<LineSending>,
}

impl Line {
    pub(super) fn new(port: usize, sensor: &SensorFeed) -> Self {
        let (latency, byte_time) = (Span::from_seconds(sensor.latency), sensor.byte_time);
        Line { port, latency, byte_time, free: Time::START, sent: Vec::new() }
    }

    /// Sends a message of a measurement as soon as the device has it and the line is free.
    pub(super) fn send(&mut self, measured: Time, bytes: &[u8]) {
        self.put(measured, bytes.len() as f64, Input::Bytes(bytes.to_vec()));
    }

    /// Sends a frame of a measurement as soon as the device has it and the bus is free.
    pub(super) fn send_frame(&mut self, measured: Time, frame: &CanFrame) {
        self.put(measured, f64::from(frame.wire_bits()) / 8.0, Input::Can(*frame));
    }

    fn put(&mut self, measured: Time, bytes: f64, input: Input) {
        let begun = (measured + self.latency).max(self.free);
        let at = begun + Span::from_seconds(bytes * self.byte_time);
        self.free = at;
        self.sent.push(LineSending { at, port: self.port, input });
    }
}
