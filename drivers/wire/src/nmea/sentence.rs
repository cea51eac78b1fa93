//! Any sentence that this crate reads.

use super::fault::NmeaFault;
use super::frame::Frame;
use super::line::{NmeaLine, Talker};
use super::{
    Acn, Alc, Alf, Arc, Dtm, Gbs, Gga, Glc, Gll, Gns, Gsa, Gst, Gsv, Hbt, Hcr, Hdg, Hdm, Hdt, Lcd,
    NortekBeam, NortekBottomTrack, NortekGroundSpeed, Pashr, Pinsd, Psxn, Rls, Rmc, Rot, Ths, Txt,
    Vbw, Vdr, Vhw, Vlw, Vtg, Xdr, Zda,
};
use super::{
    PfecAttitude, Phcmp, Phinf, Phlin, Phoct, Phspd, Phtro, Pixse, Prdid, PsatHpr, PtnlAvr, Ptnthtm,
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

            /// Formatters of the approved sentences, and the greatest number of bytes, CR LF
            /// included, that each has with a ship's values ([`super`] says which these are).
            pub const LONGEST: &[(&str, usize)] =
                &[$(($approved::FORMATTER, $approved::LONGEST),)*];

            fn read_approved(frame: &Frame<'_>, formatter: &str) -> Result<Self, NmeaFault> {
                match formatter {
                    $($approved::FORMATTER => $approved::read(frame).map(Sentence::$approved),)*
                    _ => Err(NmeaFault::OtherSentence),
                }
            }

            fn read_own(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
                match frame.address() {
                    $($($address)|+ => $own::read(frame).map(Sentence::$own),)*
                    _ => Err(NmeaFault::OtherSentence),
                }
            }

            /// Writes the sentence; makers' own have no talker.
            #[must_use]
            pub fn write(&self, talker: Talker) -> NmeaLine {
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
        /// Command about an alert.
        Acn,
        /// List of alerts.
        Alc,
        /// Alert.
        Alf,
        /// Refusal of a command about an alert.
        Arc,
        /// Datum of positions.
        Dtm,
        /// Integrity of a position.
        Gbs,
        /// Position fix.
        Gga,
        /// Time differences of Loran.
        Glc,
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
        /// Sign of life.
        Hbt,
        /// Heading and its corrections.
        Hcr,
        /// Heading of a magnetic compass.
        Hdg,
        /// Magnetic heading.
        Hdm,
        /// Heading.
        Hdt,
        /// Signals of Loran.
        Lcd,
        /// Recommended minimum.
        Rmc,
        /// Rate of turn.
        Rot,
        /// Heading and status.
        Ths,
        /// Text.
        Txt,
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
        /// Measurements of transducers.
        Xdr,
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
        /// Attitude of Furuno and JRC satellite compasses.
        PfecAttitude("PFEC"),
        /// Latitude and speed that an Octans corrects its heading with.
        Phcmp("PHCMP"),
        /// Status of an Octans or a Phins.
        Phinf("PHINF"),
        /// Surge, sway and heave of an Octans.
        Phlin("PHLIN"),
        /// Attitude and motion of an Octans with time.
        Phoct("PHOCT"),
        /// Rates of surge, sway and heave of an Octans.
        Phspd("PHSPD"),
        /// Pitch and roll of an Octans.
        Phtro("PHTRO"),
        /// insd's own: what an operator tells it, and what it tells of itself.
        Pinsd("PINSD"),
        /// The set of a Phins.
        Pixse("PIXSE"),
        /// Attitude for current profilers.
        Prdid("PRDID"),
        /// Attitude of Hemisphere satellite compasses.
        PsatHpr("PSAT"),
        /// Line between two antennas of a Trimble receiver.
        PtnlAvr("PTNL"),
        /// Attitude, rates, quality of Seatex and Kongsberg units.
        Psxn("PSXN"),
        /// Attitude of compasses of True North.
        Ptnthtm("PTNTHTM"),
        /// Position and heading by a local position reference.
        Rls("RLS"),
    }
}

impl Sentence {
    /// Reads a line and says who sent it; makers' own sentences have no talker.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of frame or fields; [`NmeaFault::OtherSentence`] for a good frame of an
    /// unknown formatter or maker.
    pub fn read(line: &[u8]) -> Result<(Option<Talker>, Self), NmeaFault> {
        let frame = Frame::parse(line)?;
        Sentence::read_frame(&frame).map(|sentence| (frame.talker(), sentence))
    }

    /// Reads the sentence of a frame.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields; [`NmeaFault::OtherSentence`] for an unknown formatter or maker.
    pub fn read_frame(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
        match frame.approved() {
            Ok((_, formatter)) => Sentence::read_approved(frame, formatter),
            // one has the address of neither the standard nor a maker's own
            Err(_) if frame.address().starts_with('P') || frame.address() == Rls::ADDRESS => {
                Sentence::read_own(frame)
            }
            Err(fault) => Err(fault),
        }
    }
}
