//! What sensors measured, kind by kind, as columns.

use std::collections::BTreeMap;

use insd_base::{
    ExternalReference, Geodetic, GnssFix, ImuSample, LogReference, LogVelocity, Message, Ned,
    RangingReading, Received, Time,
};

use crate::columns::{Column, Number, numbers, words};

/// A message and when it came.
#[derive(Clone, Debug)]
struct Heard<T> {
    receipt: Time,
    message: T,
}

/// Messages by their kind.
#[derive(Debug, Default)]
pub(crate) struct Messages {
    imu: Vec<Heard<ImuSample>>,
    gnss: Vec<Heard<GnssFix>>,
    log: Vec<Heard<LogVelocity>>,
    reference: Vec<Heard<ExternalReference>>,
    ranging: Vec<Heard<RangingReading>>,
    /// How many there were of kinds that are no rows of numbers.
    others: BTreeMap<&'static str, u64>,
}

impl Messages {
    /// Takes one in.
    pub(crate) fn take(&mut self, received: &Received) {
        let receipt = received.receipt;
        match &received.message {
            Message::Imu(message) => self.imu.push(Heard { receipt, message: *message }),
            Message::Gnss(message) => self.gnss.push(Heard { receipt, message: *message }),
            Message::Log(message) => self.log.push(Heard { receipt, message: *message }),
            Message::Reference(message) => {
                self.reference.push(Heard { receipt, message: *message });
            }
            Message::Ranging(message) => self.ranging.push(Heard { receipt, message: *message }),
            Message::Ranges(_) => self.count("ranges"),
            Message::Base(_) => self.count("base"),
            Message::Rtk(_) => self.count("rtk"),
            Message::Compass(_) => self.count("compass"),
            Message::Camera(_) => self.count("camera"),
            Message::Odometry(_) => self.count("odometry"),
        }
    }

    fn count(&mut self, kind: &'static str) {
        *self.others.entry(kind).or_default() += 1;
    }

    /// How many messages there were of kinds that have no table.
    pub(crate) fn others(&self) -> &BTreeMap<&'static str, u64> {
        &self.others
    }

    /// The tables of the kinds that were heard.
    pub(crate) fn tables(&self) -> Vec<(&'static str, Vec<Column>)> {
        let mut log = numbers(&self.log, &LOG);
        log.push(words("reference", &self.log, |own| Some(word(own.message.reference).into())));
        let tables = [
            ("imu", numbers(&self.imu, &IMU), self.imu.len()),
            ("gnss", numbers(&self.gnss, &GNSS), self.gnss.len()),
            ("log", log, self.log.len()),
            ("reference", numbers(&self.reference, &REFERENCE), self.reference.len()),
            ("ranging", numbers(&self.ranging, &RANGING), self.ranging.len()),
        ];
        let heard = tables.into_iter().filter(|(_, _, rows)| *rows > 0);
        heard.map(|(kind, columns, _)| (kind, columns)).collect()
    }
}

/// As in `log.csv`.
fn word(reference: LogReference) -> &'static str {
    match reference {
        LogReference::Bottom => "bottom",
        LogReference::Water => "water",
    }
}

const IMU: [Number<Heard<ImuSample>>; 8] = [
    ("t_s", "s", |own| Some(own.message.time.as_seconds())),
    ("dtheta_x_rad", "rad", |own| Some(own.message.delta_theta.0.x)),
    ("dtheta_y_rad", "rad", |own| Some(own.message.delta_theta.0.y)),
    ("dtheta_z_rad", "rad", |own| Some(own.message.delta_theta.0.z)),
    ("dvel_x_mps", "m/s", |own| Some(own.message.delta_velocity.0.x)),
    ("dvel_y_mps", "m/s", |own| Some(own.message.delta_velocity.0.y)),
    ("dvel_z_mps", "m/s", |own| Some(own.message.delta_velocity.0.z)),
    ("receipt_s", "s", |own| Some(own.receipt.as_seconds())),
];

const GNSS: [Number<Heard<GnssFix>>; 18] = [
    ("t_s", "s", |own| Some(own.message.time.as_seconds())),
    ("lat_deg", "deg", |own| place(own).map(|own| own.latitude.to_degrees())),
    ("lon_deg", "deg", |own| place(own).map(|own| own.longitude.to_degrees())),
    ("height_m", "m", |own| {
        place(own).map(|own| own.height).filter(|_| is_told(own.message.position_std))
    }),
    ("vn_mps", "m/s", |own| own.message.velocity.map(|Ned(v)| v.x)),
    ("ve_mps", "m/s", |own| own.message.velocity.map(|Ned(v)| v.y)),
    ("vd_mps", "m/s", |own| {
        own.message.velocity.map(|Ned(v)| v.z).filter(|_| is_told(own.message.velocity_std))
    }),
    ("std_n_m", "m", |own| own.message.position_std.map(|Ned(s)| s.x)),
    ("std_e_m", "m", |own| own.message.position_std.map(|Ned(s)| s.y)),
    ("std_d_m", "m", |own| finite(own.message.position_std)),
    ("std_vn_mps", "m/s", |own| own.message.velocity_std.map(|Ned(s)| s.x)),
    ("std_ve_mps", "m/s", |own| own.message.velocity_std.map(|Ned(s)| s.y)),
    ("std_vd_mps", "m/s", |own| finite(own.message.velocity_std)),
    ("hdop", "", |own| own.message.hdop),
    ("satellites", "", |own| own.message.satellites.map(f64::from)),
    ("quality", "", |own| Some(f64::from(own.message.quality.as_gga()))),
    ("rank", "", |own| Some(f64::from(own.message.rank))),
    ("receipt_s", "s", |own| Some(own.receipt.as_seconds())),
];

fn place(heard: &Heard<GnssFix>) -> Option<Geodetic> {
    heard.message.position
}

/// Whether the down component is told: where it is not, its sigma is infinite.
fn is_told(std: Option<Ned>) -> bool {
    std.is_none_or(|Ned(std)| std.z.is_finite())
}

fn finite(std: Option<Ned>) -> Option<f64> {
    std.map(|Ned(std)| std.z).filter(|std| std.is_finite())
}

const LOG: [Number<Heard<LogVelocity>>; 6] = [
    ("t_s", "s", |own| Some(own.message.time.as_seconds())),
    ("u_mps", "m/s", |own| own.message.u),
    ("v_mps", "m/s", |own| own.message.v),
    ("w_mps", "m/s", |own| own.message.w),
    ("std_mps", "m/s", |own| own.message.std),
    ("receipt_s", "s", |own| Some(own.receipt.as_seconds())),
];

const REFERENCE: [Number<Heard<ExternalReference>>; 10] = [
    ("t_s", "s", |own| Some(own.message.time.as_seconds())),
    ("vn_mps", "m/s", |own| own.message.v_north),
    ("ve_mps", "m/s", |own| own.message.v_east),
    ("lat_deg", "deg", |own| own.message.position.map(|own| own.latitude.to_degrees())),
    ("lon_deg", "deg", |own| own.message.position.map(|own| own.longitude.to_degrees())),
    ("heading_deg", "deg", |own| own.message.heading.map(f64::to_degrees)),
    ("std_v_mps", "m/s", |own| own.message.velocity_std),
    ("std_pos_m", "m", |own| own.message.position_std),
    ("std_heading_deg", "deg", |own| own.message.heading_std.map(f64::to_degrees)),
    ("receipt_s", "s", |own| Some(own.receipt.as_seconds())),
];

const RANGING: [Number<Heard<RangingReading>>; 5] = [
    ("t_s", "s", |own| Some(own.message.time.as_seconds())),
    ("mark", "", |own| Some(f64::from(own.message.mark))),
    ("distance_m", "m", |own| Some(own.message.distance)),
    ("std_m", "m", |own| Some(own.message.std)),
    ("receipt_s", "s", |own| Some(own.receipt.as_seconds())),
];
