//! The rows of the files: columns to messages.

use insd_base::{
    Attitude, Body, ExternalReference, FixQuality, Geodetic, GnssFix, ImuSample, LogReference,
    LogVelocity, Mode, Ned, Solution, SolutionSigma, Stamped, Time, Truth,
};

use super::fields::Fields;
use super::report::{BadRow, RowFault};
use super::table::{ARRIVAL, Row};

/// Takes `t_s` and the optional `arrival_s`, the first and the last column of every sensor's row.
/// An arrival before the time of validity, by a clock's jitter, counts as prompt.
macro_rules! stamped_row {
    ($message:ty, $parse:path, $columns:expr, $optional:expr) => {
        impl Row for Stamped<$message> {
            const COLUMNS: &'static [&'static str] = $columns;
            const OPTIONAL: &'static [&'static [&'static str]] = $optional;

            fn parse(fields: &Fields<'_>) -> Result<Self, BadRow> {
                let time = fields.time(0)?;
                let last = Self::COLUMNS.len() - 1;
                let arrival = fields.optional_time(last)?.filter(|at| *at > time);
                Ok(Stamped { message: $parse(time, fields)?, arrival })
            }

            fn time(&self) -> Time {
                self.message.time
            }
        }
    };
}

stamped_row!(
    ImuSample,
    imu_sample,
    &[
        "t_s",
        "dtheta_x_rad",
        "dtheta_y_rad",
        "dtheta_z_rad",
        "dvel_x_mps",
        "dvel_y_mps",
        "dvel_z_mps",
        ARRIVAL
    ],
    &[&[ARRIVAL]]
);

stamped_row!(
    GnssFix,
    gnss_fix,
    &[
        "t_s",
        "lat_deg",
        "lon_deg",
        "height_m",
        "vn_mps",
        "ve_mps",
        "vd_mps",
        "std_n_m",
        "std_e_m",
        "std_d_m",
        "std_vn_mps",
        "std_ve_mps",
        "std_vd_mps",
        "hdop",
        "satellites",
        "quality",
        ARRIVAL
    ],
    &[
        &["height_m"],
        &["vn_mps", "ve_mps"],
        &["vd_mps"],
        &["std_n_m", "std_e_m"],
        &["std_d_m"],
        &["std_vn_mps", "std_ve_mps"],
        &["std_vd_mps"],
        &["hdop"],
        &["satellites"],
        &["quality"],
        &[ARRIVAL]
    ]
);

stamped_row!(
    LogVelocity,
    log_velocity,
    &["t_s", "u_mps", "v_mps", "w_mps", "std_mps", "reference", ARRIVAL],
    &[&["v_mps"], &["w_mps"], &["std_mps"], &[ARRIVAL]]
);

stamped_row!(
    ExternalReference,
    external_reference,
    &[
        "t_s",
        "vn_mps",
        "ve_mps",
        "lat_deg",
        "lon_deg",
        "heading_deg",
        "std_v_mps",
        "std_pos_m",
        "std_heading_deg",
        ARRIVAL
    ],
    &[
        &["vn_mps", "ve_mps"],
        &["lat_deg", "lon_deg"],
        &["heading_deg"],
        &["std_v_mps"],
        &["std_pos_m"],
        &["std_heading_deg"],
        &[ARRIVAL]
    ]
);

fn imu_sample(time: Time, fields: &Fields<'_>) -> Result<ImuSample, BadRow> {
    let field = |column| fields.required(column);
    let delta_theta = Body::new(field(1)?, field(2)?, field(3)?);
    let delta_velocity = Body::new(field(4)?, field(5)?, field(6)?);
    Ok(ImuSample { time, delta_theta, delta_velocity })
}

/// A fix. A single missing standard deviation becomes 0, which the filter floors and counts. A
/// missing height or down velocity becomes 0 with an infinite one.
fn gnss_fix(time: Time, fields: &Fields<'_>) -> Result<GnssFix, BadRow> {
    let (height, down) = (fields.number(3)?, fields.number(6)?);
    let horizontal = fields.latitude_longitude(1)?;
    let position = horizontal.map(|p| Geodetic { height: height.unwrap_or(0.0), ..p });
    let velocity = fields.number(4)?.zip(fields.number(5)?);
    let velocity = velocity.map(|(vn, ve)| Ned::new(vn, ve, down.unwrap_or(0.0)));
    let mut position_std = partial_std(fields, 7)?;
    if position.is_some() && height.is_none() {
        position_std.get_or_insert_default().0.z = f64::INFINITY;
    }
    let mut velocity_std = partial_std(fields, 10)?;
    if velocity.is_some() && down.is_none() {
        velocity_std.get_or_insert_default().0.z = f64::INFINITY;
    }
    let has_data = position.is_some() || velocity.is_some();
    Ok(GnssFix {
        time,
        position,
        velocity,
        position_std,
        velocity_std,
        hdop: fields.number(13)?,
        satellites: count(fields, 14)?.map(|satellites| satellites as u16),
        quality: quality(fields, 15, has_data)?,
        lever: None,
        redated: 0.0,
        rank: 0,
    })
}

/// Three standard deviations; `None` if all are missing, 0 for a single missing one.
fn partial_std(fields: &Fields<'_>, first: usize) -> Result<Option<Ned>, BadRow> {
    let (n, e, d) = (fields.number(first)?, fields.number(first + 1)?, fields.number(first + 2)?);
    let any = n.or(e).or(d).is_some();
    Ok(any.then(|| Ned::new(n.unwrap_or(0.0), e.unwrap_or(0.0), d.unwrap_or(0.0))))
}

/// A whole number from 0 to 65535.
fn count(fields: &Fields<'_>, column: usize) -> Result<Option<f64>, BadRow> {
    match fields.within(column, 0.0..=f64::from(u16::MAX))? {
        Some(value) if value.fract() != 0.0 => Err(fields.bad(column, RowFault::OutOfRange)),
        other => Ok(other),
    }
}

/// A GGA quality. A receiver that does not say counts as autonomous when it gives data.
fn quality(fields: &Fields<'_>, column: usize, has_data: bool) -> Result<FixQuality, BadRow> {
    match count(fields, column)? {
        None if has_data => Ok(FixQuality::Autonomous),
        None => Ok(FixQuality::Invalid),
        Some(digit) if digit <= 8.0 => Ok(FixQuality::from_gga(digit as u8).unwrap_or_default()),
        Some(_) => Err(fields.bad(column, RowFault::OutOfRange)),
    }
}

fn log_velocity(time: Time, fields: &Fields<'_>) -> Result<LogVelocity, BadRow> {
    let reference = match fields.raw(5) {
        b"bottom" => LogReference::Bottom,
        b"water" => LogReference::Water,
        b"" => return Err(fields.bad(5, RowFault::Empty)),
        _ => return Err(fields.bad(5, RowFault::UnknownWord)),
    };
    let (u, v, w) = (fields.number(1)?, fields.number(2)?, fields.number(3)?);
    Ok(LogVelocity { time, u, v, w, std: fields.number(4)?, reference })
}

fn external_reference(time: Time, fields: &Fields<'_>) -> Result<ExternalReference, BadRow> {
    let heading = fields.number(5)?.map(|degrees| degrees.rem_euclid(360.0).to_radians());
    Ok(ExternalReference {
        time,
        v_north: fields.number(1)?,
        v_east: fields.number(2)?,
        velocity_std: fields.number(6)?,
        position: fields.latitude_longitude(3)?,
        position_std: fields.number(7)?,
        position_lasting_std: None,
        heading,
        heading_std: fields.number(8)?.map(f64::to_radians),
    })
}

/// The state columns that `truth.csv` and `nav.csv` share.
macro_rules! state_columns {
    ($($more:literal),*) => {
        &["t_s", "lat_deg", "lon_deg", "height_m", "vn_mps", "ve_mps", "vd_mps", "roll_deg",
          "pitch_deg", "heading_deg" $(, $more)*]
    };
}

impl Row for Truth {
    const COLUMNS: &'static [&'static str] = state_columns!();
    const OPTIONAL: &'static [&'static [&'static str]] = &[];

    fn parse(fields: &Fields<'_>) -> Result<Self, BadRow> {
        Ok(Truth {
            time: fields.time(0)?,
            position: position(fields)?,
            velocity: fields.triple(4)?,
            attitude: attitude(fields)?,
        })
    }

    fn time(&self) -> Time {
        self.time
    }
}

/// The columns of `nav.csv`, those behind the mode last.
pub(super) const NAV: &[&str] = state_columns!(
    "std_n_m",
    "std_e_m",
    "std_d_m",
    "std_vn_mps",
    "std_ve_mps",
    "std_vd_mps",
    "std_roll_deg",
    "std_pitch_deg",
    "std_heading_deg",
    "mode",
    "hpl_m",
    "vpl_m",
    "integrity",
    "excluded",
    "satellites",
    "source"
);

/// A solution from the columns of [`NAV`] up to the mode.
pub(super) fn solution(fields: &Fields<'_>) -> Result<Solution, BadRow> {
    let mode = std::str::from_utf8(fields.raw(19)).ok().and_then(Mode::from_word);
    let must =
        |value: Option<Ned>, column| value.ok_or_else(|| fields.bad(column, RowFault::Empty));
    Ok(Solution {
        time: fields.time(0)?,
        position: position(fields)?,
        velocity: must(fields.triple(4)?, 4)?,
        attitude: attitude(fields)?.ok_or_else(|| fields.bad(7, RowFault::Empty))?,
        rate: Body::default(),
        sigma: SolutionSigma {
            position: must(fields.triple(10)?, 10)?,
            velocity: must(fields.triple(13)?, 13)?,
            roll: fields.required(16)?.to_radians(),
            pitch: fields.required(17)?.to_radians(),
            heading: fields.required(18)?.to_radians(),
        },
        mode: mode.ok_or_else(|| fields.bad(19, RowFault::UnknownWord))?,
        judgement: insd_base::Judgement::default(),
        source: None,
        hidden: insd_base::Protection::default(),
    })
}

fn position(fields: &Fields<'_>) -> Result<Geodetic, BadRow> {
    let horizontal = fields.latitude_longitude(1)?;
    let horizontal = horizontal.ok_or_else(|| fields.bad(1, RowFault::Empty))?;
    Ok(Geodetic { height: fields.required(3)?, ..horizontal })
}

fn attitude(fields: &Fields<'_>) -> Result<Option<Attitude>, BadRow> {
    let angles = fields.triple(7)?;
    Ok(angles.map(|Ned(angles)| Attitude {
        roll: angles.x.to_radians(),
        pitch: angles.y.to_radians(),
        heading: angles.z.rem_euclid(360.0).to_radians(),
    }))
}
