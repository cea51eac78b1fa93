//! A node of NMEA 2000 as the port drives it.

use insd_base::{BusEvent, CanFrame, Time};
use insd_n2k::node::Node;

use super::Speaker;

impl Speaker for Node {
    fn up(&mut self, now: Time) {
        Node::up(self, now);
    }

    fn down(&mut self, now: Time) {
        Node::down(self, now);
    }

    fn bus_event(&mut self, event: BusEvent, now: Time) {
        match event {
            BusEvent::BusOff => self.bus_off(now),
            BusEvent::Restarted => self.restarted(now),
            _ => {}
        }
    }

    fn hear(&mut self, frame: &CanFrame, now: Time) {
        Node::hear(self, frame, now);
    }

    fn wake(&mut self, now: Time) {
        Node::wake(self, now);
    }

    fn wake_at(&self) -> Option<Time> {
        Node::wake_at(self)
    }

    fn next_frame(&mut self, now: Time) -> Option<CanFrame> {
        Node::next_frame(self, now)
    }

    fn sent(&mut self, now: Time) {
        Node::sent(self, now);
    }

    fn refused(&mut self, now: Time) {
        Node::refused(self, now);
    }
}
