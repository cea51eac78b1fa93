//! The languages that there are.

use std::fmt;
use std::str::FromStr;
use std::sync::LazyLock;

use schemars::JsonSchema;
use serde::Deserialize;

use crate::catalogue::Catalogue;

/// The language in which people are told something.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize, JsonSchema)]
pub enum Language {
    /// English.
    #[default]
    #[serde(rename = "en")]
    English,
    /// Japanese.
    #[serde(rename = "ja")]
    Japanese,
}

/// The files of a catalogue.
macro_rules! files {
    ($folder:literal) => {
        [
            include_str!(concat!("../", $folder, "/html.toml")),
            include_str!(concat!("../", $folder, "/page.toml")),
            include_str!(concat!("../", $folder, "/word.toml")),
            include_str!(concat!("../", $folder, "/alert.toml")),
            include_str!(concat!("../", $folder, "/said.toml")),
            include_str!(concat!("../", $folder, "/report.toml")),
            include_str!(concat!("../", $folder, "/check.toml")),
        ]
    };
}

impl Language {
    /// All of them.
    pub const ALL: [Language; 2] = [Language::English, Language::Japanese];

    /// Its code (ISO 639-1), as in the `lang` of HTML: `en`, `ja`.
    #[must_use]
    pub fn code(self) -> &'static str {
        match self {
            Language::English => "en",
            Language::Japanese => "ja",
        }
    }

    /// As who speaks it calls it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Language::English => "English",
            Language::Japanese => "日本語",
        }
    }

    /// Its texts.
    #[must_use]
    pub fn catalogue(self) -> &'static Catalogue {
        static ENGLISH: LazyLock<Catalogue> =
            LazyLock::new(|| Catalogue::read(&files!("en"), None));
        static JAPANESE: LazyLock<Catalogue> =
            LazyLock::new(|| Catalogue::read(&files!("ja"), Some(&ENGLISH)));
        match self {
            Language::English => &ENGLISH,
            Language::Japanese => &JAPANESE,
        }
    }
}

impl fmt::Display for Language {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.code())
    }
}

impl FromStr for Language {
    type Err = String;

    fn from_str(code: &str) -> Result<Self, String> {
        let found = Language::ALL.into_iter().find(|own| own.code() == code);
        found.ok_or_else(|| {
            format!("expected one of {}", Language::ALL.map(Language::code).join(", "))
        })
    }
}
