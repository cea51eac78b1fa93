//! The signals of a satellite that a receiver tracks.

use insd_base::satellites::{Constellation, SPEED_OF_LIGHT, SatelliteId, SignalCode};

/// Frequency to which the delays of the ionosphere belong, Hz: L1.
const REFERENCE: f64 = 1_575_420_000.0;

/// One signal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Signal {
    /// Its name.
    pub(crate) code: SignalCode,
    /// Its wavelength, m.
    pub(crate) wavelength: f64,
    /// Delay in the ionosphere over that on L1.
    pub(crate) ionosphere: f64,
    /// Delay of its code in the satellite against the broadcast clock, m.
    pub(crate) group_delay: f64,
}

/// The first `frequencies` signals of a satellite with these group delays, s.
///
/// The clock of GPS and QZSS refers to the ionosphere-free combination of two codes, of which a code of frequency f is late by (f1/f)^2
/// T_GD (IS-GPS-200N, 20.3.3.3.3.2); that of Galileo's I/NAV to E1 and E5b (OS SIS ICD 2.1, 5.1.5), against which the one of E1 and E5a
/// that E5a is late to by (f1/f)^2 BGD differs by the difference of both delays; that of BeiDou to B3I (BDS-SIS-ICD-B1I 3.0, 5.2.4.10).
pub(crate) fn signals(id: SatelliteId, delays: [f64; 2], frequencies: u8) -> Vec<Signal> {
    let names: [&[u8; 2]; 2] = match id.constellation {
        Constellation::Gps => [b"1C", b"2W"],
        Constellation::BeiDou => [b"2I", b"6I"],
        _ => [b"1C", b"5Q"],
    };
    let signal = |(index, name): (usize, &[u8; 2])| {
        let code = SignalCode::new(name[0] - b'0', name[1]);
        let frequency = code.frequency(id.constellation, None)?;
        let ionosphere = (REFERENCE / frequency).powi(2);
        let delay = match (id.constellation, index) {
            (Constellation::Galileo, 0) => delays[1],
            (Constellation::Galileo, _) => delays[1] - delays[0] + ionosphere * delays[0],
            (Constellation::BeiDou, 0) => delays[0],
            (Constellation::BeiDou, _) => 0.0,
            _ => ionosphere * delays[0],
        };
        let wavelength = SPEED_OF_LIGHT / frequency;
        Some(Signal { code, wavelength, ionosphere, group_delay: delay * SPEED_OF_LIGHT })
    };
    names.into_iter().enumerate().take(usize::from(frequencies)).filter_map(signal).collect()
}
