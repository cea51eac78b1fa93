//! The scenarios that come with the program.

macro_rules! scenarios {
    ($($file:literal),* $(,)?) => {
        &[$(($file, include_str!(concat!("../scenarios/", $file)))),*]
    };
}

/// File name and TOML text of each shipped scenario, in the order of their numbers.
#[must_use]
pub fn shipped() -> &'static [(&'static str, &'static str)] {
    scenarios![
        "01-harbour-departure.toml",
        "02-coastal-2h-navigation.toml",
        "03-coastal-2h-mems.toml",
        "04-log-only.toml",
        "05-gnss-faults.toml",
        "06-berthing.toml",
        "07-moored-ss3.toml",
        "08-moored-ss5.toml",
        "09-moored-tactical.toml",
        "10-underway-restart.toml",
        "11-antimeridian.toml",
        "12-over-the-pole.toml",
        "13-late-arrival.toml",
        "14-water-track-current.toml",
        "15-noise-free-rough-sea.toml",
        "16-imu-gaps-and-duplicates.toml",
        "17-moored-calm.toml",
        "18-moored-swell.toml",
        "19-moored-gust.toml",
        "20-moored-tug.toml",
        "21-moored-lost-samples.toml",
        "22-moored-gnss.toml",
        "23-moored-departure.toml",
        "24-moored-engine.toml",
        "25-moored-mems-gnss.toml",
        "26-tight-port.toml",
        "27-satellite-faults.toml",
        "28-spoofer.toml",
        "29-berthing-4ant.toml",
        "30-berthing-camera.toml",
    ]
}
