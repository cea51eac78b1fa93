//! A voyage as the byte streams of a ship's sensors.
//!
//! [`feed`] is the other end of `insd-intake`: it encodes what a simulated voyage measured in the
//! format of each sensor and says when the last byte of each message is on the wire. What the computer
//! sees of it and when is up to [`arrivals`]. Pure and without randomness of its own.

pub mod arrivals;
mod calendar;
mod camera;
mod config;
mod damage;
mod gnss;
mod heading;
mod imu;
mod line;
mod log;
pub mod n2k;
mod sensor;

use insd_base::Voyage;

pub use arrivals::{Reception, arrivals};
pub use calendar::Calendar;
pub use camera::film;
pub use damage::{at_wrong_baud, noise};
use line::Line;
pub use line::LineSending;
pub use sensor::{DeviceClock, Encoding, FeedConfig, SensorFeed};

/// Everything that the sensors of a ship send on a voyage, in order of time; of a camera nothing, which [`film`] does.
#[must_use]
pub fn feed(voyage: &Voyage, config: &FeedConfig) -> Vec<LineSending> {
    let mut all = Vec::new();
    for (port, sensor) in config.sensors.iter().enumerate() {
        let mut line = Line::new(config.port_of(port), sensor);
        match sensor.encoding {
            Encoding::Sbg
            | Encoding::Stdbin
            | Encoding::Mip
            | Encoding::Xbus(_)
            | Encoding::Kvh { .. }
            | Encoding::Stim
            | Encoding::CanImu(_) => imu::encode(voyage, sensor, &mut line),
            Encoding::Ubx | Encoding::Sbf | Encoding::NmeaGnss => {
                gnss::encode(voyage, sensor, &mut line);
            }
            Encoding::Vbw | Encoding::Pd0(_) | Encoding::Pd6(_) | Encoding::Nortek => {
                log::encode(voyage, sensor, &mut line);
            }
            Encoding::Hdt | Encoding::Ths | Encoding::Psxn | Encoding::Pashr => {
                heading::encode(voyage, sensor, &mut line);
            }
            Encoding::N2kGnss | Encoding::N2kLog | Encoding::N2kHeading => {
                n2k::encode(voyage, sensor, port, &mut line);
            }
            Encoding::Tracks => {}
        }
        all.append(&mut line.sent);
    }
    all.sort_by_key(|sending| sending.at);
    all
}
