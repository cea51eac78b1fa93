//! What units that cannot be asked were told to send, in the words of their decoders.

use insd_wire::imu::kvh::{KvhFormat, KvhLinear, KvhRotation, KvhTemperature};
use insd_wire::imu::stim::{StimFormat, StimKind, StimRange};

use crate::config::{KvhSettings, StimSettings};

impl KvhSettings {
    /// The decoder's form, for messages at this interval, s.
    #[must_use]
    pub fn format(&self, interval: f64) -> KvhFormat {
        KvhFormat {
            rotation: if self.rates { KvhRotation::Rate } else { KvhRotation::Delta },
            degrees: self.degrees,
            linear: if self.delta_velocity {
                KvhLinear::DeltaMetres
            } else {
                KvhLinear::Acceleration
            },
            temperature: if self.centidegrees {
                KvhTemperature::CentiCelsius
            } else {
                KvhTemperature::Celsius
            },
            interval,
        }
    }
}

impl StimSettings {
    /// The decoder's form, for datagrams at this interval, s; `None` for a range that no unit has.
    #[must_use]
    pub fn format(&self, interval: f64) -> Option<StimFormat> {
        let kind = |increments| if increments { StimKind::Increment } else { StimKind::Rate };
        let range = match self.range_g {
            2 => StimRange::G2,
            5 => StimRange::G5,
            10 => StimRange::G10,
            30 => StimRange::G30,
            80 => StimRange::G80,
            _ => return None,
        };
        Some(StimFormat {
            gyro: kind(self.gyro_increments),
            accel: kind(self.accel_increments),
            range,
            interval: Some(interval),
        })
    }
}
