//! Epoch after epoch out of a text.

use std::collections::{BTreeSet, VecDeque};

use insd_base::{
    Constellation, GpsTime, SatelliteEpoch, SatelliteId, SignalCode, SignalObservation,
};

use crate::error::{Flaw, RinexError};
use crate::observation::header::{Draft, ObservationHeader};
use crate::observation::rows::{Head, Rows, head, is_head, satellite};
use crate::text::{Lines, columns, is_blank};

/// Reads a file of observations of version 2, 3 or 4: an iterator of epochs, and of the flaws that stand between and in them.
///
/// What is flawed is left out and nothing else: a line, a satellite, or an epoch whose first line cannot be read or
/// whose time is not after that of the one before. The flaws of an epoch come before it. Events (flags 2 to 5) are
/// no epochs; those that bring lines of a header change [`Self::header`].
///
/// A slip that only an unreadable line told of is lost with it: a satellite that was away for an epoch may have slipped.
/// The slips of an epoch that came out of order, and of records of flag 6, are told with the next.
#[derive(Debug)]
pub struct ObservationReader<'a> {
    lines: Lines<'a>,
    draft: Draft,
    flaws: VecDeque<Flaw>,
    ready: Option<SatelliteEpoch>,
    /// Signals that slipped by a record of flag 6 or in an epoch that was left out, for the next one.
    slipped: BTreeSet<(SatelliteId, SignalCode)>,
    last: Option<GpsTime>,
    rows: Rows<'a>,
    signals: Vec<SignalObservation>,
}

impl<'a> ObservationReader<'a> {
    /// Reads the header.
    ///
    /// # Errors
    /// When it is no header of a file of observations of versions 2 to 4, or has no types of observations.
    pub fn new<T: AsRef<[u8]> + ?Sized>(text: &'a T) -> Result<Self, RinexError> {
        let mut lines = Lines::new(text.as_ref());
        let mut draft = Draft::read(&mut lines)?;
        let flaws = std::mem::take(&mut draft.flaws).into();
        Ok(Self {
            lines,
            draft,
            flaws,
            ready: None,
            slipped: BTreeSet::new(),
            last: None,
            rows: Rows::default(),
            signals: Vec::new(),
        })
    }

    /// The header, with what events have changed in it up to the epoch that came last.
    #[must_use]
    pub fn header(&self) -> &ObservationHeader {
        &self.draft.header
    }

    /// Reads up to the end of the next epoch or event; false at the end of the text.
    fn advance(&mut self) -> bool {
        let Some(line) = self.lines.next() else { return false };
        if is_blank(line) {
            return true;
        }
        let early = self.draft.is_early();
        let read = if is_head(line, early) {
            head(line, &mut self.lines, &self.draft)
        } else {
            Err(Flaw::new(self.lines.number(), "epoch", "the first line of an epoch", line))
        };
        match read {
            Err(flaw) => {
                self.flaws.push_back(flaw);
                self.pass_over();
            }
            Ok(head) if (2..=5).contains(&head.flag) => self.event(&head),
            Ok(head) => self.epoch(&head),
        }
        true
    }

    /// Leaves out what stands before the next first line of an epoch.
    fn pass_over(&mut self) {
        let early = self.draft.is_early();
        while self.lines.peek().is_some_and(|line| !is_head(line, early)) {
            self.lines.next();
        }
    }

    /// Lines of a header, comments among them, and whether the antenna moves from here on.
    fn event(&mut self, head: &Head<'_>) {
        match head.flag {
            2 => self.draft.header.is_moving = true,
            3 => self.draft.header.is_moving = false,
            _ => {}
        }
        let early = self.draft.is_early();
        for _ in 0..head.count {
            let Some(line) = self.lines.peek().filter(|line| !is_head(line, early)) else {
                self.miscounted(head);
                break;
            };
            self.lines.next();
            if let Err(flaw) = self.draft.line(line, self.lines.number()) {
                self.flaws.push_back(flaw);
            }
        }
        self.flaws.extend(self.draft.flaws.drain(..));
        if head.count > 0 {
            self.draft.settle();
        }
    }

    fn miscounted(&mut self, head: &Head<'_>) {
        let expected = "as many lines as its first line says";
        self.flaws.push_back(Flaw::new(head.line, "number of satellites", expected, b"fewer"));
    }

    /// The satellites of an epoch, or the slips of flag 6.
    fn epoch(&mut self, head: &Head<'_>) {
        let Some(tag) = head.tag else { return };
        let mut signals = Vec::new();
        for index in 0..head.count {
            if !self.satellite(head, index, &mut signals) {
                self.miscounted(head);
                break;
            }
        }
        self.surplus();
        if head.flag == 6 {
            let slipped = signals.iter().filter(|own| own.phase.is_some());
            self.slipped = slipped.map(|own| (own.satellite, own.signal)).collect();
            return;
        }
        self.mark_slips(head, &mut signals);
        let is_late = self.last.is_none_or(|last| tag > last);
        // also of one that is left out, as one wild date must not make all that follow it early
        self.last = Some(tag);
        if !is_late {
            let expected = "a time after that of the epoch before";
            let found = b"an earlier one or the same";
            self.flaws.push_back(Flaw::new(head.line, "epoch", expected, found));
            let slipped = signals.iter().filter(|own| own.slip);
            self.slipped = slipped.map(|own| (own.satellite, own.signal)).collect();
            return;
        }
        let leap_seconds = self.draft.header.leap_seconds;
        self.ready = Some(SatelliteEpoch { tag, signals, leap_seconds, clock_reset: false });
    }

    /// Lines behind the last satellite that was announced.
    fn surplus(&mut self) {
        let early = self.draft.is_early();
        let surplus = self.lines.peek().filter(|line| !is_head(line, early) && !is_blank(line));
        if let Some(line) = surplus {
            let expected = "no more lines than the first line of the epoch says";
            let number = self.lines.number() + 1;
            self.flaws.push_back(Flaw::new(number, "number of satellites", expected, line));
            self.pass_over();
        }
    }

    /// After a power failure no phase goes on; a slip that somebody found and repaired is still one.
    fn mark_slips(&mut self, head: &Head<'_>, signals: &mut [SignalObservation]) {
        for own in signals {
            own.slip |= head.flag == 1 || self.slipped.contains(&(own.satellite, own.signal));
        }
        self.slipped.clear();
    }

    /// Reads a satellite; false where its lines are not there.
    fn satellite(
        &mut self,
        head: &Head<'_>,
        index: usize,
        signals: &mut Vec<SignalObservation>,
    ) -> bool {
        let only = self.draft.header.constellation;
        let (name, satellite) = if self.draft.is_early() {
            let name = head.name(index);
            let satellite = satellite(name, only);
            let system = satellite.map_or(Constellation::Gps, |own| own.constellation);
            let width = self.draft.width(system).unwrap_or(0);
            if !self.rows.take_early(&mut self.lines, width) {
                return false;
            }
            (name, satellite)
        } else {
            let Some(line) = self.lines.peek().filter(|line| !is_head(line, false)) else {
                return false;
            };
            self.lines.next();
            self.rows.take_modern(line);
            let name = columns(line, 0, 3);
            (name, satellite(name, only))
        };
        if let Err(flaw) = self.observations(name, satellite, signals) {
            self.flaws.push_back(flaw);
        }
        true
    }

    fn observations(
        &mut self,
        name: &[u8],
        satellite: Option<SatelliteId>,
        signals: &mut Vec<SignalObservation>,
    ) -> Result<(), Flaw> {
        let line = self.lines.number();
        let flaw = |expected, found| Flaw::new(line, "observations", expected, found);
        let own = satellite.ok_or_else(|| flaw("a satellite such as G07", name))?;
        let layout = self.draft.layout(own.constellation);
        let layout = layout.ok_or_else(|| flaw("a constellation that the header has", name))?;
        if signals.iter().any(|known| known.satellite == own) {
            return Err(flaw("each satellite once in an epoch", name));
        }
        let glonass = own.constellation == Constellation::Glonass;
        let channel = if glonass { self.draft.channel(own.number) } else { None };
        self.signals.clear();
        self.signals.extend(layout.signals.iter().map(|signal| SignalObservation {
            channel,
            ..SignalObservation::unknown(own, *signal)
        }));
        let read = self.rows.read(layout, &self.draft, &mut self.signals);
        read.map_err(|(expected, found)| flaw(expected, found))?;
        signals.extend(self.signals.iter().filter(|own| is_observed(own)).copied());
        Ok(())
    }
}

fn is_observed(own: &SignalObservation) -> bool {
    [own.code, own.phase, own.doppler, own.cn0].iter().any(Option::is_some)
}

impl Iterator for ObservationReader<'_> {
    type Item = Result<SatelliteEpoch, Flaw>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if let Some(flaw) = self.flaws.pop_front() {
                return Some(Err(flaw));
            }
            if let Some(epoch) = self.ready.take() {
                return Some(Ok(epoch));
            }
            if !self.advance() {
                return None;
            }
        }
    }
}
