//! What is known of a port before anything arrives.

/// What is known of a port before anything arrives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PortToHear {
    /// Its name.
    pub name: String,
    /// Whether the times of receipt mean anything: not those of a file, which is read as fast as can
    /// be.
    pub timed: bool,
    /// The `transport` of a configuration, as TOML, if one can be suggested.
    pub transport: Option<SuggestedTransport>,
}

/// What a configuration opens, for the suggestion.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SuggestedTransport {
    /// A serial device by its lasting name; the rate is that which was found.
    Serial {
        /// Path of the device.
        device: String,
    },
    /// Anything else, as an inline table.
    Other(String),
}
