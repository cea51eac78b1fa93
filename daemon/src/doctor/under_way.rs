//! What the ship's motion has shown of her installation: asked of the daemon that runs with the same file.

use insd_config::Config;
use insd_config::check::{ConfigFinding, ConfigPlace, Severity};
use insd_intake::config::Role;
use insd_web::snapshot::{ShownEstimate, ShownEstimates, Snapshot};

use crate::monitor::Client;

/// A lever arm that is not known better, m, or a log whose scale is not, share, is not worth a line.
const LEVER_KNOWN: f64 = 1.0;
const SCALE_KNOWN: f64 = 0.02;
/// A residual is worth writing into the file beyond so many sigmas,
const SIGNIFICANT: f64 = 3.0;
/// and beyond this: lever arm, m; misalignment of a log, deg.
const LEVER: f64 = 0.1;
const TURN: f64 = 0.5;
/// Parts of a million.
const PPM: f64 = 1e-6;

/// What the daemon tells on its page, or that it cannot be asked.
pub(super) fn look(config: &Config) -> Vec<ConfigFinding> {
    if !config.web.enabled {
        let text = "what it has found under way cannot be asked for, as its page is off";
        return vec![
            note(ConfigPlace::one("web").key("enabled"), text).advise("the journal has it, too"),
        ];
    }
    let url = format!("http://{}", config.web.listen);
    let told = Client::new(&url).fetch().and_then(|text| Ok(serde_json::from_str(&text)?));
    match told {
        Ok(snapshot) => of(config, &snapshot),
        Err(fault) => {
            let text = format!("its page tells nothing: {fault:#}");
            let place = ConfigPlace::one("web").key("listen");
            vec![ConfigFinding::new(Severity::Warning, "daemon-silent", place, &text)]
        }
    }
}

/// What is found to be otherwise than configured, and then what is left of each constant.
fn of(config: &Config, snapshot: &Snapshot) -> Vec<ConfigFinding> {
    let found = snapshot.installation.iter().map(|found| {
        let severity = if found.fault { Severity::Warning } else { Severity::Note };
        let own =
            ConfigFinding::new(severity, "found-under-way", ConfigPlace::default(), &found.text);
        let line = found.paste.as_ref().map(|line| format!("write `{line}`"));
        line.into_iter().fold(own, ConfigFinding::advise)
    });
    let mut all: Vec<ConfigFinding> = found.collect();
    if let Some(estimates) = &snapshot.estimates {
        all.extend(residuals(config, estimates));
    }
    all
}

fn residuals(config: &Config, found: &ShownEstimates) -> Vec<ConfigFinding> {
    let all = [
        lever(config, found),
        delay(found),
        scale(found),
        misalignment(config, found),
        drift(found),
    ];
    all.into_iter().flatten().collect()
}

fn lever(config: &Config, found: &ShownEstimates) -> Option<ConfigFinding> {
    let [forward, starboard, down] =
        <[ShownEstimate; 3]>::try_from(found.gnss_lever_m.as_slice()).ok()?;
    let mut arm = [(0.0, 0.0); 3];
    for (own, estimate) in arm.iter_mut().zip([forward, starboard, down]) {
        *own = known(&estimate)?;
    }
    let sigma = arm.iter().map(|(_, sigma)| *sigma).fold(0.0, f64::max);
    let [forward, starboard, down] = arm.map(|(value, _)| value);
    let text = format!(
        "the antenna in use is at [{forward:.2}, {starboard:.2}, {down:.2}] m, good to {sigma:.2} m"
    );
    let finding = note(ConfigPlace::one("ship").key("gnss_lever_m"), &text);
    let own = config.sensors.iter().any(|sensor| sensor.lever().is_some());
    let apart = arm.iter().zip(config.ship.gnss_lever_m);
    let is_other = apart.into_iter().any(|((value, sigma), configured)| {
        (value - configured).abs() > LEVER.max(SIGNIFICANT * sigma)
    });
    let finding = match is_other && !own {
        true => finding
            .advise(format!("write `gnss_lever_m = [{forward:.2}, {starboard:.2}, {down:.2}]`")),
        false => finding,
    };
    (sigma < LEVER_KNOWN).then_some(finding)
}

fn delay(found: &ShownEstimates) -> Option<ConfigFinding> {
    let (value, sigma) = known(found.gnss_delay_s.as_ref()?)?;
    let text =
        format!("GNSS epochs come {value:+.3} s after the time they tell, good to {sigma:.3} s");
    Some(note(ConfigPlace::default(), &text))
}

fn scale(found: &ShownEstimates) -> Option<ConfigFinding> {
    let (value, sigma) = known(found.log_scale_ppm.as_ref()?)?;
    let [value, sigma] = [value, sigma].map(|ppm| ppm * PPM * 100.0);
    let text = format!("the log tells {value:+.2} % too much, good to {sigma:.2} %");
    let finding = note(ConfigPlace::default(), &text);
    let is_off = value.abs() > SIGNIFICANT * sigma;
    let finding = if is_off { finding.advise("calibrate it where it is set up") } else { finding };
    (sigma < SCALE_KNOWN * 100.0).then_some(finding)
}

fn misalignment(config: &Config, found: &ShownEstimates) -> Option<ConfigFinding> {
    let (value, sigma) = known(found.log_misalignment_deg.as_ref()?)?;
    let text = format!("the log is turned {value:+.2} deg to starboard, good to {sigma:.2} deg");
    let mut logs = config.sensors.iter().filter(|sensor| sensor.kind.role() == Role::Log);
    let log = logs.next()?;
    let finding = note(ConfigPlace::of("sensor", &log.name).key("mounting.rotation_deg"), &text);
    let is_off = value.abs() > TURN.max(SIGNIFICANT * sigma);
    let [roll, pitch, yaw] = log.mounting.rotation_deg;
    let line = || format!("write `rotation_deg = [{roll:.1}, {pitch:.1}, {:.1}]`", yaw + value);
    let finding = if is_off { finding.advise(line()) } else { finding };
    (sigma < TURN).then_some(finding)
}

fn drift(found: &ShownEstimates) -> Option<ConfigFinding> {
    let (value, sigma) = known(found.course_less_heading_deg.as_ref()?)?;
    let text = format!(
        "her course is {value:+.1} deg to starboard of her heading on the mean, good to {sigma:.1} deg: \
         leeway and current, and what the IMU is turned by"
    );
    Some(note(ConfigPlace::default(), &text))
}

fn known(estimate: &ShownEstimate) -> Option<(f64, f64)> {
    estimate.value.zip(estimate.sigma)
}

fn note(place: ConfigPlace, text: &str) -> ConfigFinding {
    ConfigFinding::new(Severity::Note, "residual", place, text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_web::snapshot::Found;

    fn estimate(value: f64, sigma: f64) -> ShownEstimate {
        ShownEstimate { value: Some(value), sigma: Some(sigma) }
    }

    /// A configuration with a log.
    fn with_log() -> Config {
        Config::of_text(include_str!("../../../systemd/examples/survey.toml")).unwrap()
    }

    #[test]
    fn residuals_are_told_with_sigma_and_the_lines_to_paste() {
        let config = with_log();
        let [forward, starboard, down] = config.ship.gnss_lever_m;
        let estimates = ShownEstimates {
            gnss_lever_m: vec![
                estimate(forward + 0.5, 0.02),
                estimate(starboard, 0.02),
                estimate(down, 0.04),
            ],
            gnss_delay_s: Some(estimate(0.004, 0.001)),
            log_scale_ppm: Some(estimate(12_000.0, 900.0)),
            log_misalignment_deg: Some(estimate(1.5, 0.1)),
            course_less_heading_deg: Some(estimate(-0.8, 0.3)),
            ..ShownEstimates::default()
        };
        let found = Found {
            text: "the log seems elsewhere".to_owned(),
            paste: Some("log_lever_m = [1.0, 2.0, 3.0]".to_owned()),
            fault: true,
            ..Found::default()
        };
        let snapshot = Snapshot {
            installation: vec![found],
            estimates: Some(estimates),
            ..Snapshot::default()
        };
        let told: Vec<String> = of(&config, &snapshot).iter().map(ToString::to_string).collect();
        let has = |words: &str| {
            assert!(told.iter().any(|line| line.contains(words)), "{words}: {told:#?}");
        };
        has("the log seems elsewhere; write `log_lever_m = [1.0, 2.0, 3.0]`");
        has(&format!("write `gnss_lever_m = [{:.2},", forward + 0.5));
        has("+0.004 s after the time they tell, good to 0.001 s");
        has("the log tells +1.20 % too much, good to 0.09 %; calibrate");
        has("rotation_deg = [0.0, 0.0, 1.5]");
        has("course is -0.8 deg");
    }

    #[test]
    fn what_is_not_known_is_not_told() {
        let config = with_log();
        let vague = ShownEstimates {
            gnss_lever_m: vec![estimate(0.0, 20.0); 3],
            log_scale_ppm: Some(estimate(0.0, 1e5)),
            gnss_delay_s: Some(ShownEstimate::default()),
            ..ShownEstimates::default()
        };
        assert_eq!(residuals(&config, &vague), []);
    }
}
