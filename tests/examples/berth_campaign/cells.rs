//! The ships, seas and berths of the campaign.

/// One of them: what to call it, the shipped scenario, and what is set otherwise.
pub(crate) struct Cell {
    pub(crate) label: &'static str,
    pub(crate) scenario: &'static str,
    pub(crate) sets: &'static [&'static str],
}

const fn cell(label: &'static str, scenario: &'static str, sets: &'static [&'static str]) -> Cell {
    Cell { label, scenario, sets }
}

pub(crate) const CELLS: [Cell; 30] = [
    cell("calm", "17", &[]),
    cell("sea state 0", "7", &["sea.state=0"]),
    cell("sea state 1", "7", &["sea.state=1"]),
    cell("sea state 2", "7", &["sea.state=2"]),
    cell("sea state 3", "7", &[]),
    cell("sea state 4", "7", &["sea.state=4"]),
    cell("sea state 5", "8", &[]),
    cell("sea state 6", "8", &["sea.state=6"]),
    cell("sheltered quay, 5", "8", &["sea.exposure=[{at_s=0,factor=0.3}]"]),
    cell("swell of 8 s", "18", &["sea.peak_period_s=8"]),
    cell("swell of 12 s", "18", &["sea.peak_period_s=12"]),
    cell("swell of 15 s", "18", &["sea.peak_period_s=15"]),
    cell("swell of 18 s", "18", &[]),
    cell("swell of 20 s", "18", &["sea.peak_period_s=20"]),
    cell("moorings of 20-40 s", "8", &["sea.mooring_period_s=[20,40]"]),
    cell("moorings of 30-60 s", "8", &["sea.mooring_period_s=[30,60]"]),
    cell("moorings of 40-180 s", "8", &["sea.mooring_period_s=[40,180]"]),
    cell("moorings of 100-180 s", "8", &["sea.mooring_period_s=[100,180]"]),
    cell("equator", "8", &["start.lat_deg=0"]),
    cell("latitude 60", "8", &["start.lat_deg=60"]),
    cell("ship of 20 m", "8", &["ship.length_m=20"]),
    cell("ship of 300 m", "8", &["ship.length_m=300"]),
    cell("gust", "19", &[]),
    cell("tug", "20", &[]),
    cell("GNSS", "22", &[]),
    cell("tactical, 3", "9", &[]),
    cell("tactical, 5", "8", &["imu.grade=\"tactical\""]),
    cell("MEMS, 3", "9", &["imu.grade=\"mems\""]),
    cell("MEMS, 5", "8", &["imu.grade=\"mems\""]),
    cell("MEMS, GNSS", "25", &[]),
];
