//! Logs: velocities in whatever axes into those of the ship.

use insd_base::units::wrap_two_pi;
use insd_base::{Attitude, LogReference, UtcTime};
use insd_wire::binary::BinaryFault;
use insd_wire::log::ad2cp::Ad2cpBottomTrack;
use insd_wire::log::pd0::{Ensemble, Geometry};
use insd_wire::log::pd6::Pd6;
use insd_wire::log::{LogFrame, LogReading};
use insd_wire::nmea::{NortekBottomTrack, Sentence, Vbw, VbwVelocity, Vhw};
use nalgebra::{Matrix3, Vector3};

use super::reading::{Reading, ShipVelocity};
use crate::config::Kind;
use crate::event::Refusal;
use crate::mounting::Mounting;

/// What a log's messages must be read with.
#[derive(Clone, Debug)]
pub(super) struct LogState {
    c_bd: Matrix3<f64>,
    /// The mounting was not told, and is that of the log's maker.
    by_maker: bool,
    std: f64,
    /// The instrument's own attitude, with which it turned what it sends in Earth axes.
    attitude: Option<Attitude>,
}

impl LogState {
    /// A log of a kind. The instrument's axes of RDI are never those of the hull, so a mounting that
    /// says they are was not told: then it is the maker's.
    pub(super) fn new(kind: Kind, mounting: &Mounting, std: f64) -> Self {
        let by_maker = matches!(kind, Kind::Pd0 | Kind::Pd6) && *mounting == Mounting::default();
        let mounting = if by_maker { Mounting::rdi(0.0, false) } else { *mounting };
        let c_bd = mounting.c_bd().unwrap_or_else(Matrix3::identity);
        LogState { c_bd, by_maker, std, attitude: None }
    }

    pub(super) fn sentence(&mut self, sentence: &Sentence) -> Result<Vec<Reading>, Refusal> {
        match sentence {
            Sentence::Vbw(vbw) => Ok(self.vbw(vbw)),
            Sentence::Vhw(vhw) => Ok(vec![self.vhw(vhw)]),
            Sentence::NortekBottomTrack(track) => self.nortek(track).map(|reading| vec![reading]),
            _ => Ok(vec![Reading::Idle]),
        }
    }

    pub(super) fn pd0(&mut self, bytes: &[u8]) -> Result<Vec<Reading>, Refusal> {
        let ensemble = Ensemble::read(bytes).map_err(|_| Refusal::Malformed)?;
        self.attitude = attitude(&ensemble);
        let geometry = ensemble.fixed.geometry;
        if self.by_maker {
            let up = geometry.is_some_and(|geometry| geometry.up);
            let mounting = Mounting::rdi(ensemble.fixed.heading_alignment, up);
            self.c_bd = mounting.c_bd().unwrap_or(self.c_bd);
        }
        let mut readings = Vec::new();
        for reference in [LogReference::Bottom, LogReference::Water] {
            if let Some(reading) = ensemble.reading(reference) {
                readings.push(self.reading(&reading, geometry.as_ref())?);
            }
        }
        if readings.is_empty() && ensemble.bottom.is_some() {
            readings.push(invalid(LogReference::Bottom));
        }
        Ok(if readings.is_empty() { vec![Reading::Idle] } else { readings })
    }

    /// Records of other kinds say nothing.
    pub(super) fn ad2cp(&mut self, bytes: &[u8]) -> Result<Vec<Reading>, Refusal> {
        let track = match Ad2cpBottomTrack::read(bytes) {
            Err(BinaryFault::OtherMessage) => return Ok(vec![Reading::Idle]),
            read => read.map_err(|_| Refusal::Malformed)?,
        };
        match track.reading() {
            Some(reading) => self.reading(&reading, None).map(|reading| vec![reading]),
            None => Ok(vec![invalid(LogReference::Bottom)]),
        }
    }

    pub(super) fn pd6(&mut self, bytes: &[u8]) -> Result<Vec<Reading>, Refusal> {
        let line = Pd6::read(bytes).map_err(|_| Refusal::Malformed)?;
        match &line {
            Pd6::Attitude { pitch, roll, heading } => {
                self.attitude = Some(Attitude { roll: *roll, pitch: *pitch, heading: *heading });
                Ok(vec![Reading::Idle])
            }
            Pd6::Velocity { reference, .. } => match line.reading() {
                Some(reading) => self.reading(&reading, None).map(|reading| vec![reading]),
                None => Ok(vec![invalid(*reference)]),
            },
            _ => Ok(vec![Reading::Idle]),
        }
    }

    fn vbw(&self, vbw: &Vbw) -> Vec<Reading> {
        let one = |own: &VbwVelocity, reference| {
            let velocity = [own.longitudinal, own.transverse, None];
            let told = velocity.iter().any(Option::is_some);
            let turned = self.turned(velocity).unwrap_or(velocity);
            told.then(|| self.ship_velocity(turned, reference, own.valid))
        };
        let ground = one(&vbw.ground, LogReference::Bottom);
        let water = one(&vbw.water, LogReference::Water);
        let readings: Vec<Reading> = ground.into_iter().chain(water).collect();
        if readings.is_empty() { vec![Reading::Idle] } else { readings }
    }

    fn vhw(&self, vhw: &Vhw) -> Reading {
        match vhw.speed {
            Some(speed) => self.ship_velocity([Some(speed), None, None], LogReference::Water, true),
            None => Reading::Idle,
        }
    }

    fn nortek(&self, track: &NortekBottomTrack) -> Result<Reading, Refusal> {
        let [x, y, z] = track.velocity;
        if [x, y, z].iter().all(Option::is_none) {
            return Ok(invalid(LogReference::Bottom));
        }
        let reading = LogReading {
            velocity: [x, y, z, None],
            frame: LogFrame::Instrument,
            reference: LogReference::Bottom,
            std: track.figure_of_merit,
            utc: track.time,
            age: track.echo_to_output.map(f64::abs),
        };
        self.reading(&reading, None)
    }

    /// A velocity along the ship's axes, or along those of a log that may be turned about the vertical.
    pub(super) fn turned_velocity(
        &self,
        velocity: [Option<f64>; 3],
        reference: LogReference,
    ) -> Reading {
        let turned = self.turned(velocity).unwrap_or(velocity);
        self.ship_velocity(turned, reference, true)
    }

    /// A velocity in the ship's axes.
    pub(super) fn ship_velocity(
        &self,
        velocity: [Option<f64>; 3],
        reference: LogReference,
        valid: bool,
    ) -> Reading {
        let std = self.std;
        Reading::Velocity(ShipVelocity { velocity, reference, std, gps: None, age: 0.0, valid })
    }

    /// A reading in any axes as one in the ship's.
    fn reading(&self, reading: &LogReading, beams: Option<&Geometry>) -> Result<Reading, Refusal> {
        let [x, y, z, _] = reading.velocity;
        let velocity = match reading.frame {
            LogFrame::Ship => [x, y, z],
            LogFrame::Instrument => self.turned([x, y, z]).ok_or(Refusal::Frame)?,
            LogFrame::Beam => {
                let own = beams.and_then(|geometry| geometry.instrument_reading(reading));
                let Some(own) = own else { return Ok(invalid(reading.reference)) };
                let [x, y, z, _] = own.velocity;
                self.turned([x, y, z]).ok_or(Refusal::Frame)?
            }
            LogFrame::Earth => self.in_ship([x, y, z]).ok_or(Refusal::Frame)?,
        };
        Ok(Reading::Velocity(ShipVelocity {
            velocity,
            reference: reading.reference,
            std: reading.std.filter(|std| *std > 0.0).unwrap_or(self.std),
            gps: reading.utc.map(UtcTime::to_gps),
            age: reading.age.unwrap_or(0.0),
            valid: true,
        }))
    }

    /// A vector in the instrument's axes in those of the ship. Without its third component only where
    /// the mounting turns about that axis alone.
    fn turned(&self, vector: [Option<f64>; 3]) -> Option<[Option<f64>; 3]> {
        let [x, y, z] = vector;
        let own = Vector3::new(x?, y?, z.unwrap_or(0.0));
        let level = self.c_bd.column(2).xy().norm() < 1e-6;
        if z.is_none() && !level {
            return None;
        }
        let turned = self.c_bd * own;
        Some([Some(turned.x), Some(turned.y), z.map(|_| turned.z)])
    }

    /// East, north, up by the instrument's own attitude back into its ship's axes.
    fn in_ship(&self, [east, north, up]: [Option<f64>; 3]) -> Option<[Option<f64>; 3]> {
        let v_n = Vector3::new(north?, east?, -up?);
        let v_b = self.attitude?.c_nb().transpose() * v_n;
        Some([Some(v_b.x), Some(v_b.y), Some(v_b.z)])
    }
}

/// A log that has no velocity.
pub(super) fn invalid(reference: LogReference) -> Reading {
    let (velocity, std) = ([None; 3], f64::INFINITY);
    Reading::Velocity(ShipVelocity { velocity, reference, std, gps: None, age: 0.0, valid: false })
}

fn attitude(ensemble: &Ensemble) -> Option<Attitude> {
    let variable = &ensemble.variable;
    Some(Attitude {
        roll: variable.roll,
        pitch: variable.pitch,
        heading: wrap_two_pi(variable.heading),
    })
}
