//! What bases measure, on the ship's time line.

use std::sync::Arc;

use insd_base::{BaseEpoch, Message, SatelliteEpoch, Source, Stamp, Time};

use super::Core;
use crate::base::BaseTold;
use crate::event::{Happening, Refusal};

/// An epoch that is older, s, when it comes is no use, and its time doubtful; so is one from the future.
const OLDEST: f64 = 60.0;
const EARLIEST: f64 = -1.0;

impl Core {
    /// A frame of a base.
    pub(super) fn base(&mut self, index: usize, stamp: &Stamp, frame: &[u8]) {
        let Some(received) = self.utc.about(stamp) else {
            self.refuse(index, Refusal::NoTime);
            return;
        };
        let now = stamp.monotonic;
        let ship = self.here;
        let Some(base) = &mut self.sensors[index].base else { return };
        for told in base.take(frame, (now, received), ship.as_ref()) {
            match told {
                BaseTold::Epoch(epoch) => self.base_epoch(index, stamp, epoch),
                BaseTold::News(news) => self.tell(now, Happening::Base { sensor: index, news }),
                BaseTold::Refused(reason) => self.refuse(index, reason),
            }
        }
        let own = &mut self.sensors[index];
        own.status.base = own.base.as_ref().map(|base| base.status.clone());
    }

    fn base_epoch(&mut self, index: usize, stamp: &Stamp, epoch: SatelliteEpoch) {
        let now = stamp.monotonic;
        let Some(time) = self.utc.time_of(epoch.tag) else {
            self.refuse(index, Refusal::NoTime);
            return;
        };
        let age = (now - time).as_seconds();
        if !(EARLIEST..OLDEST).contains(&age) {
            self.refuse(index, Refusal::TimeDoubted);
            return;
        }
        let own = &mut self.sensors[index];
        let (number, Some(base)) = (own.number, &mut own.base) else { return };
        let (offered, news) = base.offer(epoch, time, now);
        if let Some(news) = news {
            self.tell(now, Happening::Base { sensor: index, news });
        }
        let offered = Arc::new(offered);
        self.pass(index, now, Source::Base(number), Message::Base(Arc::clone(&offered)));
        if number == 0 {
            self.hold_against(now, &offered);
        }
    }

    /// Receivers on board are held against an epoch of the first base.
    fn hold_against(&mut self, now: Time, told: &Arc<BaseEpoch>) {
        for index in 0..self.sensors.len() {
            let own = &mut self.sensors[index];
            let source = Source::Gnss(own.number);
            let Some(come) = own.sky.as_mut().and_then(|sky| sky.hear_base(told)) else { continue };
            self.pass(index, now, source, Message::Rtk(come));
        }
    }
}
