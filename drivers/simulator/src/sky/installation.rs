//! What is wrong with the installation of antennas.

use super::truth::InjectedAntennaFault;
use crate::scenario::{Raw, RawAntennaFault};

/// A receiver loses a signal that is weaker, dB Hz.
pub(crate) const TRACKED_FROM: f64 = 24.0;

/// By how much the signals of an antenna, by its number, are weaker at time `t`, s, dB: without end where nothing comes.
pub(crate) fn loss(faults: &[RawAntennaFault], antenna: usize, t: f64) -> f64 {
    let holds = |fault: &&RawAntennaFault| {
        fault.antenna == antenna && t >= fault.t0_s && fault.t1_s.is_none_or(|end| t < end)
    };
    let of = |fault: &RawAntennaFault| {
        if fault.broken { f64::INFINITY } else { fault.weaker_db.unwrap_or(0.0) }
    };
    faults.iter().filter(holds).map(of).sum()
}

/// From when on, s, the receiver of an antenna has an oscillator of its own, and by how much that is faster, m/s.
pub(crate) fn own_clock(faults: &[RawAntennaFault], antenna: usize) -> Option<(f64, f64)> {
    let own = faults.iter().filter(|fault| fault.antenna == antenna);
    own.filter_map(|fault| Some((fault.t0_s, fault.own_clock_mps?))).next()
}

/// Where the antennas are said to be, from the IMU, body axes, m.
pub(crate) fn told_antennas(raw: &Raw) -> Vec<[f64; 3]> {
    let mut told = raw.antennas_m.clone();
    if let Some([one, other]) = raw.swapped {
        told.swap(one - 1, other - 1);
    }
    told
}

/// The faults for those who judge, in a voyage of `duration`, s.
pub(crate) fn injected(faults: &[RawAntennaFault], duration: f64) -> Vec<InjectedAntennaFault> {
    let of = |fault: &RawAntennaFault| {
        let sizes = [("weaker_db", fault.weaker_db), ("own_clock_mps", fault.own_clock_mps)];
        let given = sizes.into_iter().find_map(|(kind, size)| Some((kind, size?)));
        let (kind, size) = given.unwrap_or(("broken", 0.0));
        InjectedAntennaFault {
            antenna: fault.antenna,
            kind: kind.to_owned(),
            t0_s: fault.t0_s,
            t1_s: fault.t1_s.unwrap_or(duration).min(duration),
            size,
        }
    };
    faults.iter().map(of).collect()
}
