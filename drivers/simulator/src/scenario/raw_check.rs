//! What is asked of the values of `[raw]`.

use super::fault::Faults;
use super::raw::{Raw, RawAntennaFault, RawFault, RawSky};

/// Checks all values of the table.
pub(super) fn check(raw: &Raw, faults: &mut Faults) {
    faults.range("raw.rate_hz", raw.rate_hz, 0.01, 20.0);
    antennas(raw, faults);
    receiver(raw, faults);
    sky(&raw.sky, faults);
    obstructions(raw, faults);
    for (index, fault) in raw.fault.iter().enumerate() {
        satellite_fault(&format!("raw.fault[{index}]"), fault, faults);
    }
    for (index, fault) in raw.antenna_fault.iter().enumerate() {
        antenna_fault(&format!("raw.antenna_fault[{index}]"), fault, raw.antennas_m.len(), faults);
    }
    for (index, spoof) in raw.spoof.iter().enumerate() {
        let key = format!("raw.spoof[{index}]");
        span(&key, spoof.t0_s, Some(spoof.t1_s), faults);
        faults.range(format!("{key}.speed_mps"), spoof.speed_mps, 0.0, 100.0);
        faults.range(format!("{key}.direction_deg"), spoof.direction_deg, -360.0, 360.0);
        faults.range(format!("{key}.clock_m"), spoof.clock_m, -1e5, 1e5);
    }
    if let Some(base) = &raw.base {
        faults.range("raw.base.lat_deg", base.lat_deg, -90.0, 90.0);
        faults.range("raw.base.lon_deg", base.lon_deg, -360.0, 360.0);
        faults.range("raw.base.height_m", base.height_m, -1000.0, 20_000.0);
        for (axis, off) in base.told_off_m.into_iter().enumerate() {
            faults.range(format!("raw.base.told_off_m[{axis}]"), off, -1e5, 1e5);
        }
    }
}

fn antennas(raw: &Raw, faults: &mut Faults) {
    if raw.antennas_m.is_empty() || raw.antennas_m.len() > 9 {
        faults.add("raw.antennas_m", "expected one to nine antennas");
    }
    for (index, lever) in raw.antennas_m.iter().enumerate() {
        faults.lever_arm(&format!("raw.antennas_m[{index}]"), *lever);
    }
    if raw.common_clock.iter().any(|number| !(1..=raw.antennas_m.len()).contains(number)) {
        faults.add("raw.common_clock", "expected numbers of antennas, from 1");
    }
    let is_pair = |[one, other]: [usize; 2]| {
        one != other && [one, other].iter().all(|own| (1..=raw.antennas_m.len()).contains(own))
    };
    if raw.swapped.is_some_and(|pair| !is_pair(pair)) {
        faults.add("raw.swapped", "expected numbers of two antennas, from 1");
    }
}

fn receiver(raw: &Raw, faults: &mut Faults) {
    for (key, value) in [
        ("code_std_m", raw.code_std_m),
        ("phase_std_m", raw.phase_std_m),
        ("doppler_std_mps", raw.doppler_std_mps),
        ("multipath_code_std_m", raw.multipath_code_std_m),
        ("multipath_phase_std_m", raw.multipath_phase_std_m),
        ("clock_bias_walk_m_sqrt_s", raw.clock_bias_walk_m_sqrt_s),
        ("clock_drift_walk_mps_sqrt_s", raw.clock_drift_walk_mps_sqrt_s),
        ("line_bias_walk_m_sqrt_s", raw.line_bias_walk_m_sqrt_s),
        ("clock_drift_mps", raw.clock_drift_mps),
        ("constellation_offset_std_m", raw.constellation_offset_std_m),
        ("slips_per_hour", raw.slips_per_hour),
        ("half_cycle_s", raw.half_cycle_s),
    ] {
        faults.not_negative(format!("raw.{key}"), value);
    }
    faults.positive("raw.multipath_time_constant_s", raw.multipath_time_constant_s);
    faults.range("raw.frequencies", f64::from(raw.frequencies), 1.0, 2.0);
    faults.range("raw.mask_deg", raw.mask_deg, 3.0, 90.0);
    faults.range("raw.clock_offset_ms", raw.clock_offset_ms, 0.0, 1.0);
    faults.range("raw.slips_told", raw.slips_told, 0.0, 1.0);
}

fn sky(sky: &RawSky, faults: &mut Faults) {
    if sky.constellations.is_empty() || !sky.constellations.chars().all(|c| "GEJC".contains(c)) {
        faults.add("raw.sky.constellations", "expected letters out of G, E, J and C");
    }
    faults.not_negative("raw.sky.orbit_std_m", sky.orbit_std_m);
    faults.not_negative("raw.sky.clock_std_m", sky.clock_std_m);
    faults.not_negative("raw.sky.record_step_m", sky.record_step_m);
    faults.not_negative("raw.sky.ionosphere_std", sky.ionosphere_std);
    faults.range("raw.sky.period_s", sky.period_s, 60.0, 1e6);
    faults.range("raw.sky.troposphere_factor", sky.troposphere_factor, 0.0, 10.0);
    faults.range("raw.sky.wet_zenith_std_m", sky.wet_zenith_std_m, 0.0, 1.0);
    let [low, high] = sky.ionosphere_factor;
    faults.range("raw.sky.ionosphere_factor[0]", low, 0.0, 10.0);
    faults.range("raw.sky.ionosphere_factor[1]", high, low, 10.0);
}

fn obstructions(raw: &Raw, faults: &mut Faults) {
    for (index, segment) in raw.segment.iter().enumerate() {
        let key = format!("raw.segment[{index}]");
        span(&key, segment.t0_s, Some(segment.t1_s), faults);
        faults.range(format!("{key}.multipath"), segment.multipath, 0.0, 100.0);
    }
    for (index, crane) in raw.crane.iter().enumerate() {
        let key = format!("raw.crane[{index}]");
        span(&key, crane.t0_s, crane.t1_s, faults);
        for (side, bearing) in crane.azimuth_deg.into_iter().enumerate() {
            faults.range(format!("{key}.azimuth_deg[{side}]"), bearing, -360.0, 360.0);
        }
        faults.range(format!("{key}.elevation_deg"), crane.elevation_deg, 0.0, 90.0);
    }
}

fn satellite_fault(key: &str, fault: &RawFault, faults: &mut Faults) {
    span(key, fault.t0_s, fault.t1_s, faults);
    let sizes = [fault.ramp_mps, fault.jump_m, fault.clock_jump_m, fault.stale_mps2];
    let [size] = sizes.into_iter().flatten().collect::<Vec<f64>>()[..] else {
        faults.add(key, "expected one of ramp_mps, jump_m, clock_jump_m and stale_mps2");
        return;
    };
    faults.range(key, size, -1e5, 1e5);
    if fault.stale_mps2.is_some() && fault.t1_s.is_some() {
        faults.add(format!("{key}.t1_s"), "expected no end of a stale orbit");
    }
}

fn antenna_fault(key: &str, fault: &RawAntennaFault, antennas: usize, faults: &mut Faults) {
    span(key, fault.t0_s, fault.t1_s, faults);
    if !(1..=antennas).contains(&fault.antenna) {
        faults.add(format!("{key}.antenna"), "expected the number of an antenna, from 1");
    }
    let sizes = [fault.broken.then_some(0.0), fault.weaker_db, fault.own_clock_mps];
    let [size] = sizes.into_iter().flatten().collect::<Vec<f64>>()[..] else {
        faults.add(key, "expected one of broken, weaker_db and own_clock_mps");
        return;
    };
    if fault.weaker_db.is_some() {
        faults.range(format!("{key}.weaker_db"), size, 0.0, 60.0);
    }
    if fault.own_clock_mps.is_some() {
        faults.range(format!("{key}.own_clock_mps"), size, -1000.0, 1000.0);
        if fault.t1_s.is_some() {
            faults.add(format!("{key}.t1_s"), "expected no end of a clock of its own");
        }
    }
}

fn span(key: &str, t0: f64, t1: Option<f64>, faults: &mut Faults) {
    faults.not_negative(format!("{key}.t0_s"), t0);
    if t1.is_some_and(|t1| !(t1.is_finite() && t1 > t0)) {
        faults.add(format!("{key}.t1_s"), "expected a time after t0_s");
    }
}
