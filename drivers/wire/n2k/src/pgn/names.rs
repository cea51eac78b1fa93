//! Short names of common groups, in our words, for lists that people read.

/// By number, in rising order.
const NAMES: [(u32, &str); 107] = [
    (59_392, "acknowledgement (ISO)"),
    (59_904, "request (ISO)"),
    (60_160, "transport protocol, data (ISO)"),
    (60_416, "transport protocol, connection (ISO)"),
    (60_928, "address claim (ISO)"),
    (65_240, "commanded address (ISO)"),
    (126_208, "group function: request, command, acknowledge"),
    (126_464, "list of groups sent or received"),
    (126_720, "of one maker, addressed, fast packet"),
    (126_983, "alert"),
    (126_984, "alert response"),
    (126_985, "alert text"),
    (126_992, "system time"),
    (126_993, "heartbeat"),
    (126_996, "product information"),
    (126_998, "configuration information"),
    (127_233, "man overboard"),
    (127_237, "heading and track control"),
    (127_245, "rudder"),
    (127_250, "heading"),
    (127_251, "rate of turn"),
    (127_252, "heave"),
    (127_257, "attitude"),
    (127_258, "magnetic variation"),
    (127_488, "engine, rapid"),
    (127_489, "engine, dynamic"),
    (127_493, "transmission, dynamic"),
    (127_497, "engine, trip"),
    (127_498, "engine, static"),
    (127_501, "switch bank status"),
    (127_502, "switch bank control"),
    (127_503, "AC input"),
    (127_504, "AC output"),
    (127_505, "fluid level"),
    (127_506, "DC status"),
    (127_507, "charger status"),
    (127_508, "battery status"),
    (127_509, "inverter status"),
    (127_513, "battery configuration"),
    (127_751, "DC voltage and current"),
    (128_000, "leeway"),
    (128_001, "acceleration of the vessel"),
    (128_006, "thruster control"),
    (128_007, "thruster information"),
    (128_008, "thruster motor"),
    (128_259, "speed through water"),
    (128_267, "depth"),
    (128_275, "distance log"),
    (128_520, "tracked target"),
    (128_776, "windlass control"),
    (128_777, "windlass operation"),
    (128_778, "windlass monitoring"),
    (129_025, "position, rapid"),
    (129_026, "course and speed over ground"),
    (129_027, "position difference, rapid"),
    (129_028, "altitude difference, rapid"),
    (129_029, "GNSS position"),
    (129_033, "time and date"),
    (129_038, "AIS class A position"),
    (129_039, "AIS class B position"),
    (129_040, "AIS class B extended position"),
    (129_041, "AIS aid to navigation"),
    (129_044, "datum"),
    (129_045, "user datum"),
    (129_283, "cross track error"),
    (129_284, "navigation to a waypoint"),
    (129_285, "route and waypoints"),
    (129_291, "set and drift"),
    (129_301, "time to or from a mark"),
    (129_302, "bearing and distance between marks"),
    (129_538, "GNSS control"),
    (129_539, "GNSS dilutions"),
    (129_540, "GNSS satellites in view"),
    (129_541, "GPS almanac"),
    (129_542, "GNSS pseudorange noise"),
    (129_545, "GNSS RAIM output"),
    (129_546, "GNSS RAIM settings"),
    (129_547, "GNSS pseudorange errors"),
    (129_549, "GNSS corrections"),
    (129_550, "correction receiver interface"),
    (129_551, "correction receiver signal"),
    (129_556, "GLONASS almanac"),
    (129_792, "AIS DGNSS broadcast"),
    (129_793, "AIS UTC and date"),
    (129_794, "AIS class A static and voyage data"),
    (129_795, "AIS addressed binary message"),
    (129_797, "AIS binary broadcast"),
    (129_798, "AIS search and rescue aircraft"),
    (129_801, "AIS addressed safety message"),
    (129_802, "AIS safety broadcast"),
    (129_808, "DSC call"),
    (129_809, "AIS class B static data, part A"),
    (129_810, "AIS class B static data, part B"),
    (130_074, "waypoint list"),
    (130_306, "wind"),
    (130_310, "environment, old"),
    (130_311, "environment"),
    (130_312, "temperature"),
    (130_313, "humidity"),
    (130_314, "pressure"),
    (130_316, "temperature, extended range"),
    (130_320, "tide station"),
    (130_323, "weather station"),
    (130_560, "payload mass"),
    (130_576, "small craft status"),
    (130_577, "direction data"),
    (130_578, "speed components of the vessel"),
];

/// A short name of a parameter group, if it is a common one. Groups of single makers (61184, 65280 to
/// 65535, 130816 to 131071) are named as such; what they hold depends on the maker.
#[must_use]
pub fn name(pgn: u32) -> Option<&'static str> {
    match pgn {
        61_184 => Some("of one maker, addressed"),
        65_280..=65_535 => Some("of one maker"),
        130_816..=131_071 => Some("of one maker, fast packet"),
        _ => {
            let place = NAMES.binary_search_by_key(&pgn, |(number, _)| *number).ok()?;
            NAMES.get(place).map(|(_, name)| *name)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pgn::Known;

    #[test]
    fn all_names_are_found() {
        assert!(NAMES.is_sorted_by(|a, b| a.0 < b.0));
        assert!(NAMES.iter().all(|(pgn, text)| name(*pgn) == Some(*text)));
        assert!(Known::PGNS.iter().all(|pgn| name(*pgn).is_some()));
        assert_eq!(name(127_250), Some("heading"));
        assert_eq!(name(65_305), Some("of one maker"));
        assert_eq!(name(1), None);
    }
}
