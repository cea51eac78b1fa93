//! Which frames of a CAN port count, so that the kernel keeps back all others.

use insd_base::CanId;
use insd_drivers::can::CanFilter;
use insd_drivers::ports::{PortConfig, Transport};
use insd_intake::config::SensorConfig;
use insd_n2k::is_addressed;
use insd_n2k::pgn::Known;
use insd_wire::imu::can::LayoutChoice;

use super::Config;

/// Groups by which a bus is kept: acknowledgement, request, transport protocol, claim, commanded
/// address, group function, and the products of others.
const MANAGEMENT: [u32; 8] = [59_392, 59_904, 60_160, 60_416, 60_928, 65_240, 126_208, 126_996];

/// Bits of an identifier that name a group: with its specific part, or without where that is an address.
const BROADCAST_GROUP: u32 = 0x03FF_FF00;
const ADDRESSED_GROUP: u32 = 0x03FF_0000;

/// The filters of a port that states none; none where everything must be heard anyway.
pub(super) fn of(config: &Config, port: &str, opened: &PortConfig) -> Vec<CanFilter> {
    if !matches!(opened.transport, Transport::Socketcan(_)) {
        return Vec::new();
    }
    let sensors = || config.sensors.iter().filter(|sensor| sensor.port == port);
    let has_node = config.nodes.iter().any(|node| node.port == port);
    let mut filters = Vec::new();
    if has_node || sensors().any(|sensor| sensor.kind.is_n2k()) {
        filters.extend(MANAGEMENT.iter().chain(Known::PGNS).map(|pgn| group(*pgn)));
    }
    filters.extend(sensors().flat_map(frames));
    filters
}

fn group(pgn: u32) -> CanFilter {
    let mask = if is_addressed(pgn) { ADDRESSED_GROUP } else { BROADCAST_GROUP };
    CanFilter { id: pgn << 8 & mask, mask, standard: false }
}

/// Those of a plain CAN IMU.
fn frames(sensor: &SensorConfig) -> Vec<CanFilter> {
    let layout = sensor.layout.as_ref().map(LayoutChoice::layout);
    let frames = layout.into_iter().flat_map(|layout| layout.frames);
    frames
        .map(|frame| CanFilter {
            id: frame.id,
            mask: if frame.extended { CanId::MAX_EXTENDED } else { CanId::MAX_STANDARD.into() },
            standard: !frame.extended,
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_group_is_let_through_whoever_sends_it_to_whom() {
        for (pgn, id) in [(59_904, 0x18EA_23FE), (127_250, 0x09F1_1201), (60_928, 0x18EE_FF40)] {
            assert!(group(pgn).accepts(CanId::Extended(id)), "{pgn}");
            assert!(!group(pgn).accepts(CanId::Extended(0x09F1_0D01)), "{pgn}");
        }
    }
}
