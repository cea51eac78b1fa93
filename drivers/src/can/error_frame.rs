//! The kernel's error frames (`linux/can/error.h`).

use insd_base::BusEvent;

/// Classes, bits of the identifier.
const LOST_ARBITRATION: u32 = 0x002;
const CONTROLLER: u32 = 0x004;
const BUS_OFF: u32 = 0x040;
const RESTARTED: u32 = 0x100;
const ALL: u32 = 0x1FFF_FFFF;

/// Classes that are told. To lose the bus to a more urgent frame is no error.
pub(super) const WANTED: u32 = ALL & !LOST_ARBITRATION;

/// States of the controller in byte 1, for what is received and what is sent.
const WARNING: u8 = 0x04 | 0x08;
const PASSIVE: u8 = 0x10 | 0x20;
const ACTIVE: u8 = 0x40;

/// What an error frame with this class and these data says: the gravest of all.
pub(super) fn event(class: u32, data: &[u8]) -> BusEvent {
    let controller = if class & CONTROLLER == 0 { 0 } else { data.get(1).copied().unwrap_or(0) };
    match class {
        _ if class & BUS_OFF != 0 => BusEvent::BusOff,
        _ if class & RESTARTED != 0 => BusEvent::Restarted,
        _ if controller & PASSIVE != 0 => BusEvent::Passive,
        _ if controller & WARNING != 0 => BusEvent::Warning,
        _ if controller & ACTIVE != 0 => BusEvent::Active,
        _ => BusEvent::Error { class: class & ALL },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_frame_says_the_gravest_of_what_it_holds() {
        let with = |byte: u8| [0, byte, 0, 0, 0, 0, 0, 0];
        for (class, data, expected) in [
            (0x040, with(0), BusEvent::BusOff),
            (0x244, with(0x30), BusEvent::BusOff),
            (0x100, with(0), BusEvent::Restarted),
            (0x204, with(0x30), BusEvent::Passive),
            (0x204, with(0x0C), BusEvent::Warning),
            (0x204, with(0x40), BusEvent::Active),
            (0x004, with(0x01), BusEvent::Error { class: 4 }),
            (0x088, with(0x30), BusEvent::Error { class: 0x88 }),
        ] {
            assert_eq!(event(class, &data), expected, "{class:X}");
        }
        assert_eq!(event(4, &[]), BusEvent::Error { class: 4 });
    }
}
