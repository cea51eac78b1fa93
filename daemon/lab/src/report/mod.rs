//! A report of a recording: one HTML page that needs nothing else, the same for the same recording.
//!
//! The recording is replayed through the very pipeline of the daemon, and what the report needs is
//! gathered on the way in a bounded room ([`collect`]): a day at 200 Hz takes no more memory than an hour.

mod bins;
mod bounded;
mod collect;
mod draw;
mod gathered;
mod page;
mod source;
mod statistics;
mod times;

pub use gathered::VoyageReport;

impl VoyageReport {
    /// The page.
    #[must_use]
    pub fn html(&self) -> String {
        page::page(self)
    }
}
