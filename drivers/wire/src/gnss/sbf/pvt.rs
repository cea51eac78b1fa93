//! PVTGeodetic: position, velocity and time of an epoch.
//!
//! Layout: Septentrio's reference guides (mosaic-X5 4.14.10 as in pysbf2; 4.10.1). Revision 1 added
//! `NrBases` and `PPPInfo`, revision 2 `Latency`, the accuracies and `Misc`; later ones only add.

use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};

use insd_base::units::DEG;
use insd_base::{FixQuality, Geodetic};

use super::field::{self, SbfMode, put_f32, put_f64, put_u16};
use super::frame::{SbfStamp, begun, body, framed};
use crate::binary::{BinaryFault, Reader, Writer};
use crate::gnss::{GnssEpoch, GnssPart};

/// Number of the block.
pub(super) const ID: u16 = 4007;

/// How far beyond its end a rounded angle may be, rad.
const ROUNDING: f64 = 1e-9;

/// PVTGeodetic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PvtGeodetic {
    /// When, by the receiver's clock.
    pub stamp: SbfStamp,
    /// Type of the solution and error.
    pub mode: SbfMode,
    /// `Latitude`, `Longitude`, `Height` above the ellipsoid of the datum.
    pub position: Option<Geodetic>,
    /// `Undulation`: height of the geoid above the ellipsoid, m.
    pub undulation: Option<f32>,
    /// `Vn`, `Ve` and the reverse of `Vu`: north, east, down velocity, m/s.
    pub velocity: [Option<f32>; 3],
    /// `COG`: course over ground, rad; not given below 0.1 m/s.
    pub course: Option<f64>,
    /// `RxClkBias`: receiver's clock ahead of the system's time, s.
    pub clock_bias: Option<f64>,
    /// `RxClkDrift`: how much faster it runs, s/s.
    pub clock_drift: Option<f64>,
    /// `TimeSystem` of the bias: 0 GPS, 1 Galileo, 3 GLONASS, 4 `BeiDou`, 5 QZSS.
    pub time_system: Option<u8>,
    /// `Datum`: 0 WGS 84 or ITRS, 19 as the base station's, 30 and above regional.
    pub datum: Option<u8>,
    /// `NrSV`: satellites used.
    pub satellites: Option<u8>,
    /// `ReferenceID`: base station or SBAS satellite.
    pub reference: u16,
    /// `MeanCorrAge`: age of the corrections, s.
    pub correction_age: Option<f64>,
    /// `SignalInfo`: a bit for each type of signal used.
    pub signals: u32,
    /// `AlertFlag`: integrity.
    pub alert: u8,
    /// What revision 2 added.
    pub extra: Option<PvtAccuracy>,
}

/// What PVTGeodetic tells from revision 2 on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PvtAccuracy {
    /// `NrBases` (revision 1): base stations used.
    pub bases: u8,
    /// `Latency`: from the epoch to this block, s; not what the line takes.
    pub latency: Option<f64>,
    /// `HAccuracy`, m: twice the root mean square of the horizontal distance error. At 655.34 the
    /// field is at its end.
    pub horizontal: Option<f64>,
    /// `VAccuracy`, m: 2-sigma. At 655.34 the field is at its end.
    pub vertical: Option<f64>,
}

impl PvtAccuracy {
    /// What a revision has; nothing of revisions 0 and 1, which tell no accuracy.
    pub(super) fn read(reader: &mut Reader<'_>, revision: u8) -> Result<Option<Self>, BinaryFault> {
        if revision < 2 {
            return Ok(None);
        }
        let [bases, _, _] = reader.array()?;
        Ok(Some(PvtAccuracy {
            bases,
            latency: field::u16(reader, 1e-4)?,
            horizontal: field::u16(reader, 0.01)?,
            vertical: field::u16(reader, 0.01)?,
        }))
    }

    /// The block of a payload and of what revision 2 adds to it; of revision 0 if that is not known.
    pub(super) fn framed(own: Option<&Self>, id: u16, mut payload: Writer) -> Vec<u8> {
        if let Some(own) = own {
            own.write(&mut payload);
        }
        framed((id, if own.is_some() { 2 } else { 0 }), &payload)
    }

    fn write(&self, writer: &mut Writer) {
        writer.put(&[self.bases, 0, 0]);
        put_u16(writer, self.latency, 1e-4);
        put_u16(writer, self.horizontal, 0.01);
        put_u16(writer, self.vertical, 0.01);
        writer.u8(0);
    }

    /// 1-sigma of north, east, down: the horizontal distance shared equally.
    pub(super) fn std(&self) -> [Option<f64>; 3] {
        let component = self.horizontal.map(|twice| twice / 2.0 / SQRT_2);
        [component, component, self.vertical.map(|twice| twice / 2.0)]
    }
}

impl PvtGeodetic {
    /// Reads a block of any revision.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(block: &[u8]) -> Result<Self, BinaryFault> {
        let (stamp, mut reader, revision) = body(block, ID)?;
        let reader = &mut reader;
        let mode = SbfMode::read(reader)?;
        let place = [field::f64(reader)?, field::f64(reader)?, field::f64(reader)?];
        let undulation = field::f32(reader)?;
        let velocity =
            [field::f32(reader)?, field::f32(reader)?, field::f32(reader)?.map(|up| -up)];
        let course = field::f32(reader)?.map(|degrees| f64::from(degrees) * DEG);
        let clock_bias = field::f64(reader)?.map(|milliseconds| milliseconds * 1e-3);
        let clock_drift = field::f32(reader)?.map(|ppm| f64::from(ppm) * 1e-6);
        let [time_system, datum, satellites, _] = reader.array()?.map(known);
        Ok(PvtGeodetic {
            stamp,
            mode,
            position: position(place)?,
            undulation,
            velocity,
            course,
            clock_bias,
            clock_drift,
            time_system,
            datum,
            satellites,
            reference: reader.le_u16()?,
            correction_age: field::u16(reader, 0.01)?,
            signals: reader.le_u32()?,
            alert: reader.u8()?,
            extra: PvtAccuracy::read(reader, revision)?,
        })
    }

    /// The block, of revision 2, or of revision 0 if the accuracies are not known.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let mut writer = begun(self.stamp);
        self.mode.write(&mut writer);
        put_f64(&mut writer, self.position.map(|position| position.latitude));
        put_f64(&mut writer, self.position.map(|position| position.longitude));
        put_f64(&mut writer, self.position.map(|position| position.height));
        let [north, east, down] = self.velocity;
        for value in [self.undulation, north, east, down.map(|down| -down)] {
            put_f32(&mut writer, value);
        }
        put_f32(&mut writer, self.course.map(|course| (course / DEG) as f32));
        put_f64(&mut writer, self.clock_bias.map(|seconds| seconds / 1e-3));
        put_f32(&mut writer, self.clock_drift.map(|drift| (drift / 1e-6) as f32));
        let small = [self.time_system, self.datum, self.satellites];
        writer.put(&small.map(|value| value.unwrap_or(u8::MAX))).u8(0).le_u16(self.reference);
        put_u16(&mut writer, self.correction_age, 0.01);
        writer.le_u32(self.signals).u8(self.alert);
        PvtAccuracy::framed(self.extra.as_ref(), ID, writer)
    }

    /// What a receiver in this state would send.
    #[must_use]
    pub fn of(state: &GnssEpoch) -> Self {
        let mode = SbfMode::of(state.quality);
        let fixed = mode.is_valid();
        let moving = state.ground_speed() >= 0.1;
        let extra = PvtAccuracy {
            bases: 0,
            latency: None,
            horizontal: fixed.then(|| 2.0 * state.horizontal_std()),
            vertical: fixed.then_some(2.0 * state.position_std[2]),
        };
        PvtGeodetic {
            stamp: SbfStamp::of(state.time),
            mode,
            position: fixed.then_some(state.position),
            undulation: fixed.then_some(state.undulation as f32),
            velocity: state.velocity.map(|component| fixed.then_some(component as f32)),
            course: (fixed && moving).then(|| state.course()),
            clock_bias: fixed.then_some(0.0),
            clock_drift: fixed.then_some(0.0),
            time_system: fixed.then_some(0),
            datum: fixed.then_some(0),
            satellites: Some(state.satellites),
            reference: 0,
            correction_age: None,
            signals: 0,
            alert: 0,
            extra: Some(extra),
        }
    }

    /// What the message says of its epoch. The epoch is the receiver's own time stamp, by which the
    /// covariances name the same epoch; it may differ from GPS time by [`PvtGeodetic::clock_bias`].
    #[must_use]
    pub fn part(&self) -> GnssPart {
        let valid = self.mode.is_valid();
        let [north, east, down] = self.velocity.map(|value| value.map(f64::from));
        let down = down.filter(|_| !self.mode.two_dimensional);
        let std = self.extra.filter(|_| valid).map_or([None; 3], |extra| extra.std());
        GnssPart {
            kind: "PVTGeodetic",
            epoch: self.stamp.epoch(),
            position: self.position.filter(|_| valid),
            position_std: std,
            velocity: if valid { [north, east, down] } else { [None; 3] },
            satellites: self.satellites.map(u16::from),
            quality: self.mode.quality(),
            invalid: self.mode.quality() == Some(FixQuality::Invalid),
            ..GnssPart::default()
        }
    }
}

/// A byte; all ones says that there is none.
fn known(byte: u8) -> Option<u8> {
    (byte != u8::MAX).then_some(byte)
}

/// The point of latitude, longitude and height, if all three are given.
fn position(place: [Option<f64>; 3]) -> Result<Option<Geodetic>, BinaryFault> {
    let [Some(latitude), Some(longitude), Some(height)] = place else { return Ok(None) };
    if latitude.abs() > FRAC_PI_2 + ROUNDING {
        return Err(BinaryFault::Range { field: "Latitude" });
    }
    if longitude.abs() > PI + ROUNDING {
        return Err(BinaryFault::Range { field: "Longitude" });
    }
    Ok(Some(Geodetic { latitude, longitude, height }))
}
