//! The frames of one CAN port.
//!
//! A frame's stamp is that of its end, so its own time on the wire is taken off: 0.54 ms for eight bytes
//! at 250 kbit/s. A message is as old as its first frame; that it may have waited for the bus is not seen.
//!
//! Who sits at which address is learnt from claims alone. It is kept while the port is lost: addresses
//! hardly ever change without a claim, and who only listens does not hear old claims again.

use insd_base::can::{BusEvent, CanFrame};
use insd_base::{Span, Stamp};
use insd_n2k::{Assembler, BusMessage, Name, Roster};
use insd_wire::ngt1::NgtFrame;

use crate::core::{Came, Core};
use crate::port::{Link, PortCounts, PortFrame};
use crate::status::BusCounts;

/// The frames of one port.
#[derive(Clone, Debug)]
pub(crate) struct CanIntake {
    bit_time: f64,
    /// None where no sensor of NMEA 2000 listens.
    assembler: Option<Assembler>,
    roster: Roster,
    frames: u64,
    bytes: u64,
    bus: BusCounts,
}

impl CanIntake {
    /// A port that carries messages of NMEA 2000, or only frames of their own.
    pub(crate) fn new(link: Link, n2k: bool) -> Self {
        CanIntake {
            bit_time: if let Link::Can { bit_time } = link { bit_time } else { 0.0 },
            assembler: n2k.then(Assembler::new),
            roster: Roster::default(),
            frames: 0,
            bytes: 0,
            bus: BusCounts::default(),
        }
    }

    /// Takes a frame.
    pub(crate) fn take(&mut self, port: usize, stamp: &Stamp, frame: &CanFrame, core: &mut Core) {
        self.frames += 1;
        self.bytes += frame.data().len() as u64;
        let wire = Span::from_seconds(f64::from(frame.wire_bits()) * self.bit_time);
        let begun = stamp.monotonic - wire;
        core.can_frame(port, stamp, frame, begun);
        if let Some(own) = self.assembler.as_mut().and_then(|own| own.take(frame, begun)) {
            self.roster.learn(&own.message);
            let name = self.roster.name_at(own.message.source);
            let came = Came { begun: own.begun, ended: stamp.monotonic };
            core.message(port, stamp, came, &own.message, name);
        }
    }

    /// Takes a message that an adapter has made bytes of: the time of its bytes is taken off, that of the bus is not known.
    pub(crate) fn adapted(
        &mut self,
        port: usize,
        stamp: &Stamp,
        frame: &PortFrame<'_>,
        core: &mut Core,
    ) {
        let Ok(NgtFrame::Received(told)) = NgtFrame::read(frame.bytes) else { return };
        let message = BusMessage {
            priority: told.priority,
            pgn: told.pgn,
            source: told.source,
            destination: told.destination,
            data: told.data,
        };
        self.roster.learn(&message);
        let name = self.roster.name_at(message.source);
        let came = Came { begun: frame.begun, ended: frame.ended };
        core.message(port, stamp, came, &message, name);
    }

    /// The controller says something.
    pub(crate) fn hear(&mut self, event: BusEvent) {
        let bus = &mut self.bus;
        match event {
            BusEvent::Error { .. } => bus.errors += 1,
            BusEvent::Dropped { frames } => bus.dropped += u64::from(frames),
            state => {
                bus.offs += u64::from(state == BusEvent::BusOff);
                bus.state = Some(state);
            }
        }
    }

    /// Counters of the port, with those of its bytes: damaged are messages that were given up.
    pub(crate) fn counts(&self, bytes: PortCounts) -> PortCounts {
        let own = self.assembler.as_ref().map(Assembler::counts).unwrap_or_default();
        PortCounts {
            bytes: bytes.bytes + self.bytes,
            frames: bytes.frames + self.frames,
            damaged: bytes.damaged + own.incomplete() + own.bad_length + own.aborted,
            ..bytes
        }
    }

    pub(crate) fn bus(&self) -> BusCounts {
        self.bus
    }

    /// Addresses and NAMEs that are known.
    pub(crate) fn nodes(&self) -> Vec<(u8, Name)> {
        self.roster.iter().collect()
    }
}
