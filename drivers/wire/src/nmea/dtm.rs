//! DTM: datum of the positions that follow.

use super::kinds::{Decimal, Field};
use super::parts::letter_of;
use super::table::sentence;

const DATUM: Field<Datum> =
    Field { write: |line, datum| line.text(datum.as_str()), read: Datum::new };

const SUBDIVISION: Field<u8> = Field {
    write: |line, letter| line.text(char::from(letter).encode_utf8(&mut [0; 4])),
    read: letter_of,
};

/// Code of a datum: three letters or digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Datum([u8; 3]);

impl Datum {
    /// WGS 84, the datum of everything here.
    pub const WGS84: Datum = Datum(*b"W84");

    /// A datum of three upper-case letters or digits.
    #[must_use]
    pub fn new(text: &str) -> Option<Self> {
        let good = text.bytes().all(|b| b.is_ascii_uppercase() || b.is_ascii_digit());
        <[u8; 3]>::try_from(text.as_bytes()).ok().filter(|_| good).map(Datum)
    }

    /// The code.
    #[must_use]
    pub fn as_str(&self) -> &str {
        std::str::from_utf8(&self.0).unwrap_or_default()
    }
}

sentence! {
    /// The datum in use and its offset: what must be added to a position in the reference datum to get one
    /// in the datum in use.
    ///
    /// A Saab R4 sends `W84,C` alone; what is absent is unknown.
    approved Dtm "DTM", longest 49;
    /// Datum in use: W84 WGS 84, W72 WGS 72, S85 SGS 85, P90 PE 90, 999 the user's, or another code.
    1 datum: Option<Datum> = DATUM;
    /// Subdivision of the datum.
    2 subdivision: Option<u8> = SUBDIVISION;
    /// Offset of latitude, rad, north positive.
    3 latitude_offset: Option<f64> = Decimal::signed(4, 60.0).minutes().lettered([b'N', b'S']), later;
    /// Offset of longitude, rad, east positive.
    5 longitude_offset: Option<f64> = Decimal::signed(4, 60.0).minutes().lettered([b'E', b'W']), too;
    /// Offset of altitude, m.
    7 altitude_offset: Option<f64> = Decimal::signed(2, 9999.9), too;
    /// Reference datum, mostly W84.
    8 reference: Option<Datum> = DATUM, too;
}
