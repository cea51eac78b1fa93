//! What left the ports.

use std::collections::BTreeMap;

use insd_output::{Content, PortMessage};

/// Messages of one kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub(crate) struct Sent {
    pub(crate) messages: u64,
    pub(crate) bytes: u64,
}

/// By port and kind of message.
#[derive(Clone, Debug, Default)]
pub(crate) struct Said(pub(crate) BTreeMap<(usize, &'static str), Sent>);

impl Said {
    /// Takes the messages of one port.
    pub(crate) fn take(&mut self, port: usize, messages: &[PortMessage]) {
        for message in messages {
            let sent = self.0.entry((port, message.kind.name())).or_default();
            sent.messages += 1;
            sent.bytes += length(&message.content);
        }
    }
}

fn length(content: &Content) -> u64 {
    let bytes: usize = match content {
        Content::Lines(lines) => lines.iter().map(|line| line.as_bytes().len()).sum(),
        Content::Binary(bytes) => bytes.len(),
    };
    bytes as u64
}
