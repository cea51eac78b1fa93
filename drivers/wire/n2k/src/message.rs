//! A message: the whole contents of a parameter group, whatever number of frames it takes.

/// A message on the bus.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BusMessage {
    /// 0, the highest, to 7.
    pub priority: u8,
    /// Number of the parameter group.
    pub pgn: u32,
    /// Address of the sender.
    pub source: u8,
    /// Address of the receiver, or [`crate::BROADCAST`].
    pub destination: u8,
    /// Its contents.
    pub data: Vec<u8>,
}
