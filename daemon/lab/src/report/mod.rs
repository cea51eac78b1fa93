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
mod translated;

pub use gathered::VoyageReport;
use insd_config::Config;
use insd_languages::Language;

impl VoyageReport {
    /// The language that the configuration of the recording tells; English where there is none.
    #[must_use]
    pub fn language(&self) -> Language {
        Config::language_of(self.config.as_deref().unwrap_or_default())
    }

    /// The page, in a language.
    #[must_use]
    pub fn html(&self, language: Language) -> String {
        let page = page::page(self);
        if language == Language::English { page } else { translated::page(&page, language) }
    }
}
