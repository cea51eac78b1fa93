//! What was learnt, in words.

use crate::kept::{KeptLog, KeptModel, KeptThermal, KeptTriad};
use crate::shadow::ShadowScore;

/// Knots in a metre per second, degrees in a radian, seconds in an hour.
const KNOTS: f64 = 3600.0 / 1852.0;
const DEGREES: f64 = 180.0 / std::f64::consts::PI;
const HOUR: f64 = 3600.0;
/// Standard gravity, m/s^2.
const GRAVITY: f64 = 9.806_65;
/// Speeds that the curve of a log is told at, knots.
const SPEEDS: [f64; 4] = [6.0, 9.0, 12.0, 18.0];
/// Those that its turn is told at.
const SLOW_AND_FAST: [f64; 2] = [6.0, 18.0];

/// A model in words, line by line.
#[must_use]
pub fn words(model: &KeptModel) -> Vec<String> {
    let hours = model.hours();
    let (voyages, generation) = (model.voyages, model.generation);
    let ending = if voyages == 1 { "" } else { "s" };
    let mut lines = Vec::new();
    if model.log.labels > 0 {
        lines.push(format!(
            "learnt from {hours:.1} h of {voyages} voyage{ending}, generation {generation}"
        ));
        of_log(&mut lines, &model.log);
    } else {
        lines.push("nothing is learnt of a log yet".to_owned());
    }
    if let Some(imu) = &model.imu {
        of_imu(&mut lines, imu);
    }
    lines
}

impl KeptModel {
    /// Median error after five minutes in outages that did not happen, without and with what is learnt, m; `None` of too few.
    #[must_use]
    pub fn outage(&self) -> Option<[f64; 2]> {
        ShadowScore::after(&self.log).quantiles().map(|own| own.map(|[median, _]| median))
    }
}

fn of_log(lines: &mut Vec<String>, log: &KeptLog) {
    for knots in SPEEDS {
        let off = 100.0 * (log.scale + log.scale_by_speed_s_m * knots / KNOTS);
        let which = if off < 0.0 { "low" } else { "high" };
        lines.push(format!("at {knots:.0} kn the log reads {:.1} % {which}", off.abs()));
    }
    if let Some(range) = log.trained.speeds_mps {
        let [least, most] = range.map(|speed| speed * KNOTS);
        let turns = log.trained.turns;
        let enough = if log.trained.is_enough() { "" } else { ": too little" };
        lines.push(format!(
            "learnt from {least:.0} to {most:.0} kn and {turns} half minutes in turns{enough}"
        ));
    }
    let turned = SLOW_AND_FAST.map(|knots| {
        format!("{:.2}", (log.turn_rad + log.turn_by_speed_s_m * knots / KNOTS) * DEGREES)
    });
    lines.push(format!("it is turned by {} deg at 6 kn and by {} at 18", turned[0], turned[1]));
    let (slide, forward) = (log.slide_m / DEGREES, log.forward_by_turn_m / DEGREES);
    lines.push(format!(
        "for each deg/s of turn to starboard it reads {slide:.3} m/s to starboard and {forward:.3} m/s ahead"
    ));
    let (std, time) = (log.current_std_mps, log.current_time_s / HOUR);
    lines.push(format!("currents of {std:.2} m/s that go on for {time:.1} h"));
    let shadow = ShadowScore::after(log);
    lines.push(match shadow.quantiles() {
        Some([without, with]) => {
            let use_ = if shadow.proves(false) { "used" } else { "not used" };
            format!(
                "if GNSS failed: {:.0} m in 5 min, without learning {:.0} (95 %: {:.0} and {:.0}): {use_}",
                with[0], without[0], with[1], without[1]
            )
        }
        None => "not proven yet: not used".to_owned(),
    });
}

fn of_imu(lines: &mut Vec<String>, imu: &KeptThermal) {
    let [least, most] = imu.range_c;
    let middle = imu.reference_c;
    lines.push(format!("IMU from {least:.0} to {most:.0} degrees Celsius, against {middle:.0}:"));
    let ends = [least - middle, most - middle];
    of_triad(lines, "gyro", &imu.gyros, ends, (DEGREES * HOUR, "deg/h"));
    of_triad(lines, "accelerometer", &imu.accelerometers, ends, (1e3 / GRAVITY, "mg"));
}

fn of_triad(
    lines: &mut Vec<String>,
    name: &str,
    triad: &KeptTriad,
    ends: [f64; 2],
    (factor, unit): (f64, &str),
) {
    let [cold, warm] = ends.map(|above| triad.change(above).map(|own| plain(own * factor)));
    for (i, axis) in ["forward", "starboard", "down"].iter().enumerate() {
        let (cold, warm) = (cold[i], warm[i]);
        lines.push(format!("  {name} {axis}: {cold:+.1} {unit} cold, {warm:+.1} {unit} warm"));
    }
}

/// To a tenth, and no zero with a sign.
fn plain(value: f64) -> f64 {
    (value * 10.0).round() / 10.0 + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_model_is_told_in_words() {
        let log = KeptLog {
            labels: 4920,
            scale: 0.02,
            scale_by_speed_s_m: -0.001,
            slide_m: -5.0,
            current_std_mps: 0.1,
            current_time_s: 20_000.0,
            shadow_without_m: vec![25.0; 8],
            shadow_with_m: vec![12.0; 8],
            ..KeptLog::default()
        };
        let told = words(&KeptModel::new(log, None)).join("\n");
        assert!(told.contains("learnt from 41.0 h of 1 voyage,"), "{told}");
        assert!(told.contains("at 12 kn the log reads 1.4 % high"), "{told}");
        assert!(told.contains("12 m in 5 min, without learning 25"), "{told}");
    }

    #[test]
    fn where_no_log_was_heard_nothing_is_said_of_one() {
        let told = words(&KeptModel::new(KeptLog::default(), None));
        assert_eq!(told, ["nothing is learnt of a log yet"]);
    }

    #[test]
    fn an_imu_that_follows_its_temperature_is_told_of_axis_by_axis() {
        let gyros = KeptTriad { slope_per_k: [1e-5, 0.0, 0.0], ..KeptTriad::default() };
        let accelerometers = KeptTriad { bend_per_k2: [0.0, 1e-4, 0.0], ..KeptTriad::default() };
        let imu = KeptThermal { reference_c: 30.0, range_c: [20.0, 40.0], gyros, accelerometers };
        let told = words(&KeptModel::new(KeptLog::default(), Some(imu)));
        assert_eq!(told[1], "IMU from 20 to 40 degrees Celsius, against 30:");
        assert_eq!(told[2], "  gyro forward: -20.6 deg/h cold, +20.6 deg/h warm");
        assert_eq!(told[3], "  gyro starboard: +0.0 deg/h cold, +0.0 deg/h warm");
        assert_eq!(told[6], "  accelerometer starboard: +1.0 mg cold, +1.0 mg warm");
    }
}
