//! Any sentence that this crate reads.

use super::fault::Fault;
use super::frame::Frame;
use super::line::{Line, Talker};
use super::{
    Dtm, Gga, Gll, Gns, Gsa, Gst, Gsv, Hdg, Hdm, Hdt, NortekBeam, NortekBottomTrack,
    NortekGroundSpeed, Pashr, Pinsd, Psxn, Rmc, Rot, Ths, Vbw, Vdr, Vhw, Vlw, Vtg, Zda,
};

/// The enum, and the match of a formatter to its reader and of a sentence to its writer.
macro_rules! sentences {
    (
        approved { $($(#[$approved_doc:meta])* $approved:ident,)* }
        own { $($(#[$own_doc:meta])* $own:ident($($address:literal)|+),)* }
    ) => {
        /// A sentence of any kind.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Sentence {
            $($(#[$approved_doc])* $approved($approved),)*
            $($(#[$own_doc])* $own($own),)*
        }

        impl Sentence {
            /// Formatters of the approved sentences, and addresses of makers' own, that are read.
            pub const NAMES: &[&str] =
                &[$($approved::FORMATTER,)* $($($address,)+)*];

            fn read_approved(frame: &Frame<'_>, formatter: &str) -> Result<Self, Fault> {
                match formatter {
                    $($approved::FORMATTER => $approved::read(frame).map(Sentence::$approved),)*
                    _ => Err(Fault::OtherSentence),
                }
            }

            fn read_own(frame: &Frame<'_>) -> Result<Self, Fault> {
                match frame.address() {
                    $($($address)|+ => $own::read(frame).map(Sentence::$own),)*
                    _ => Err(Fault::OtherSentence),
                }
            }

            /// Writes the sentence; makers' own have no talker.
            #[must_use]
            pub fn write(&self, talker: Talker) -> Line {
                match self {
                    $(Sentence::$approved(sentence) => sentence.write(talker),)*
                    $(Sentence::$own(sentence) => sentence.write(),)*
                }
            }
        }
    };
}

sentences! {
    approved {
        /// Datum of positions.
        Dtm,
        /// Position fix.
        Gga,
        /// Geographic position.
        Gll,
        /// Position fix of several systems.
        Gns,
        /// Satellites used.
        Gsa,
        /// Error statistics.
        Gst,
        /// Satellites in view.
        Gsv,
        /// Heading of a magnetic compass.
        Hdg,
        /// Magnetic heading.
        Hdm,
        /// Heading.
        Hdt,
        /// Recommended minimum.
        Rmc,
        /// Rate of turn.
        Rot,
        /// Heading and status.
        Ths,
        /// Speed over ground and through the water.
        Vbw,
        /// Set and drift.
        Vdr,
        /// Speed through the water and heading.
        Vhw,
        /// Distance run.
        Vlw,
        /// Course and speed over ground.
        Vtg,
        /// Date and time.
        Zda,
    }
    own {
        /// Bottom track of one beam of a Nortek log.
        NortekBeam("PNORBT0"),
        /// Speed and course over ground of a Nortek log.
        NortekGroundSpeed("PNORBT4"),
        /// Bottom track of a Nortek log.
        NortekBottomTrack("PNORBT6" | "PNORBT7" | "PNORBT8" | "PNORBT9"),
        /// Attitude in a dialect.
        Pashr("PASHR"),
        /// What an operator tells insd.
        Pinsd("PINSD"),
        /// Attitude, rates, quality of Seatex and Kongsberg units.
        Psxn("PSXN"),
    }
}

impl Sentence {
    /// Reads a line and says who sent it; makers' own sentences have no talker.
    ///
    /// # Errors
    /// The first [`Fault`] of frame or fields; [`Fault::OtherSentence`] for a good frame of an
    /// unknown formatter or maker.
    pub fn read(line: &[u8]) -> Result<(Option<Talker>, Self), Fault> {
        let frame = Frame::parse(line)?;
        Sentence::read_frame(&frame).map(|sentence| (frame.talker(), sentence))
    }

    /// Reads the sentence of a frame.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields; [`Fault::OtherSentence`] for an unknown formatter or maker.
    pub fn read_frame(frame: &Frame<'_>) -> Result<Self, Fault> {
        match frame.approved() {
            Ok((_, formatter)) => Sentence::read_approved(frame, formatter),
            Err(_) if frame.address().starts_with('P') => Sentence::read_own(frame),
            Err(fault) => Err(fault),
        }
    }
}
