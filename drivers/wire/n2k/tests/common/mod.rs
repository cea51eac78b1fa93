//! A bus in memory: nodes and bare listeners on one simulated clock.

#![allow(dead_code)] // each test uses a part of it

use insd_base::can::CanFrame;
use insd_base::{Span, Time};
use insd_n2k::node::{Node, NodeConfig, NodeEvent, ProductInfo, Transmit};
use insd_n2k::{Assembler, BusMessage, N2kId, Name, NameParts};

/// Nodes on a bus. Every frame takes half a millisecond, and the lowest identifier goes first.
pub(crate) struct Bus {
    pub(crate) now: Time,
    pub(crate) nodes: Vec<Node>,
    /// All frames there were, and when.
    pub(crate) frames: Vec<(Time, CanFrame)>,
    pub(crate) events: Vec<(usize, NodeEvent)>,
}

const FRAME_TIME: i64 = 500_000;

impl Bus {
    pub(crate) fn new(nodes: Vec<Node>) -> Self {
        Bus { now: Time::from_seconds(10.0), nodes, frames: Vec::new(), events: Vec::new() }
    }

    /// A bus whose nodes are all up.
    pub(crate) fn started(nodes: Vec<Node>) -> Self {
        let mut bus = Bus::new(nodes);
        let now = bus.now;
        bus.nodes.iter_mut().for_each(|node| node.up(now));
        bus
    }

    pub(crate) fn run(&mut self, seconds: f64) {
        let end = self.now + Span::from_seconds(seconds);
        while self.now < end {
            self.step();
        }
    }

    /// One frame's time: the frame that wins the bus reaches all others.
    fn step(&mut self) {
        let now = self.now;
        for node in &mut self.nodes {
            if node.wake_at().is_some_and(|at| at <= now) {
                node.wake(now);
            }
        }
        let offers = self.nodes.iter_mut().enumerate();
        let offered = offers.filter_map(|(at, node)| Some((at, node.next_frame(now)?)));
        let winner = offered.min_by_key(|(_, frame)| frame.id());
        self.now = now + Span::from_nanos(FRAME_TIME);
        if let Some((at, frame)) = winner {
            self.nodes[at].sent(now);
            self.deliver(&frame, Some(at));
        }
        self.collect();
    }

    /// A frame of somebody who is no node of this bus.
    pub(crate) fn inject(&mut self, frame: &CanFrame) {
        self.deliver(frame, None);
        self.collect();
    }

    fn deliver(&mut self, frame: &CanFrame, from: Option<usize>) {
        self.frames.push((self.now, *frame));
        let others = self.nodes.iter_mut().enumerate().filter(|(at, _)| Some(*at) != from);
        others.for_each(|(_, node)| node.hear(frame, self.now));
    }

    fn collect(&mut self) {
        for (at, node) in self.nodes.iter_mut().enumerate() {
            while let Some(event) = node.poll_event() {
                self.events.push((at, event));
            }
        }
    }

    /// All messages since the last call, and when each was complete.
    pub(crate) fn take_messages(&mut self) -> Vec<(Time, BusMessage)> {
        let mut assembler = Assembler::new();
        let frames = std::mem::take(&mut self.frames);
        let taken = frames.iter().filter_map(|(time, frame)| {
            assembler.take(frame, *time).map(|assembled| (*time, assembled.message))
        });
        let messages = taken.collect();
        let counts = assembler.counts();
        assert_eq!((counts.gaps, counts.orphans, counts.superseded), (0, 0, 0), "half a message");
        messages
    }

    /// Messages of one group from one address since the last call.
    pub(crate) fn take_group(&mut self, pgn: u32, source: u8) -> Vec<Vec<u8>> {
        let messages = self.take_messages().into_iter().map(|(_, message)| message);
        let own = messages.filter(|message| (message.pgn, message.source) == (pgn, source));
        own.map(|message| message.data).collect()
    }

    /// Single frames of one group from one address since the last call.
    pub(crate) fn take_frames(&mut self, pgn: u32, source: u8) -> Vec<Vec<u8>> {
        let frames = std::mem::take(&mut self.frames);
        let own = frames.iter().filter(|(_, frame)| {
            let id = N2kId::parse(frame.id()).unwrap();
            (id.pgn, id.source) == (pgn, source)
        });
        own.map(|(_, frame)| frame.data().to_vec()).collect()
    }

    pub(crate) fn addresses(&self) -> Vec<Option<u8>> {
        self.nodes.iter().map(Node::address).collect()
    }

    pub(crate) fn happened(&self, at: usize, event: &NodeEvent) -> bool {
        self.events.contains(&(at, event.clone()))
    }
}

/// An integrated navigation system of this unique number.
pub(crate) fn name(unique_number: u32) -> Name {
    parts(unique_number).name().unwrap()
}

pub(crate) fn parts(unique_number: u32) -> NameParts {
    NameParts {
        unique_number,
        manufacturer: 999,
        instance_lower: 0,
        instance_upper: 0,
        function: 175,
        class: 60,
        system_instance: 0,
        industry: 4,
        arbitrary_address: true,
    }
}

pub(crate) fn stream(pgn: u32, priority: u8, seconds: f64) -> Transmit {
    Transmit { pgn, priority, interval: Span::from_seconds(seconds), enabled: true }
}

pub(crate) fn config(name: Name, address: u8) -> NodeConfig {
    NodeConfig {
        name,
        address,
        product: ProductInfo {
            n2k_version: 2100,
            product_code: 1,
            model: "insd".to_owned(),
            software: "0.1.0".to_owned(),
            hardware: "none".to_owned(),
            serial: name.to_string(),
            certification: 255,
            load: 0,
        },
        installation: ["bridge".to_owned(), String::new()],
        manufacturer_info: "insd".to_owned(),
        transmit: vec![stream(127_250, 2, 0.1), stream(129_029, 3, 1.0)],
        receive: vec![128_259],
        commands: true,
    }
}

/// A node of this unique number that wants this address.
pub(crate) fn node(unique_number: u32, address: u8) -> Node {
    Node::new(config(name(unique_number), address), u64::from(unique_number))
}

/// A frame of a bare sender.
pub(crate) fn frame(priority: u8, pgn: u32, source: u8, destination: u8, data: &[u8]) -> CanFrame {
    CanFrame::new(N2kId { priority, pgn, source, destination }.compose(), data).unwrap()
}

pub(crate) fn claim(name: Name, source: u8) -> CanFrame {
    frame(6, 60_928, source, 255, &name.bytes())
}

pub(crate) fn iso_request(pgn: u32, source: u8, destination: u8) -> CanFrame {
    let [low, middle, high, _] = pgn.to_le_bytes();
    frame(6, 59_904, source, destination, &[low, middle, high])
}
