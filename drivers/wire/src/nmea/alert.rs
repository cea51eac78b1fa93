//! What the sentences of alerts share (IEC 62923, bridge alert management): ALF, ALC, ACN and ARC.
//!
//! A device tells of an alert by ALF when it changes, and of all that are active by ALC every 30 s,
//! also when there is none. A bridge answers by ACN; what cannot be done is refused by ARC. HBT says
//! in between that the device lives.
//!
//! Layouts and letters from manuals (JRC JLN-900, JFE-680 and JFE-400, Furuno FMD-3300 and BR-500,
//! Skipper DL2, Koden CVR-010, whose printed examples of ALF and ALC are read and written by tests),
//! which agree; one more (Icom GM600) gives three letters of the state another meaning. The standard
//! itself was not seen, and nothing here is verified against a bridge.

use super::fault::NmeaFault;
use super::fields::Fields;
use super::kinds::Kind;
use super::line::Composer;
use super::mode::letters;
use super::parts::letter_of;

/// Greatest identifier of an alert.
const IDENTIFIER_MAX: u32 = 9_999_999;

/// Greatest instance of an alert.
const INSTANCE_MAX: u32 = 999_999;

/// Greatest revision counter of an alert; after it comes 1.
pub(crate) const REVISION_MAX: u32 = 99;

/// Mnemonic of a maker, for alerts that no standard defines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Manufacturer([u8; 3]);

impl Manufacturer {
    /// A mnemonic of three upper-case letters or digits.
    #[must_use]
    pub fn new(text: &str) -> Option<Self> {
        let good = text.bytes().all(|b| b.is_ascii_uppercase() || b.is_ascii_digit());
        <[u8; 3]>::try_from(text.as_bytes()).ok().filter(|_| good).map(Manufacturer)
    }

    /// The mnemonic.
    #[must_use]
    pub fn as_str(&self) -> &str {
        std::str::from_utf8(&self.0).unwrap_or_default()
    }
}

/// Which alert it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct AlertId {
    /// Maker; `None` for an alert of a standard.
    pub manufacturer: Option<Manufacturer>,
    /// Identifier, at most 9999999; makers' own begin at 10000.
    pub identifier: u32,
    /// Instance, 1 to 999999, where there are several alerts of one identifier.
    pub instance: Option<u32>,
}

/// An alert of a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct AlertEntry {
    /// Which alert.
    pub alert: AlertId,
    /// Its revision counter, 1 to 99: that of its last ALF.
    pub revision: Option<u8>,
}

/// Who can judge an alert.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum AlertCategory {
    /// A: only who sees the picture of the device that raised it.
    A,
    /// B: its text alone is enough.
    B,
    /// C: it cannot be dealt with on the bridge.
    C,
}

/// How urgent an alert is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum AlertPriority {
    /// E.
    EmergencyAlarm,
    /// A.
    Alarm,
    /// W.
    Warning,
    /// C.
    Caution,
}

/// State of an alert.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum AlertState {
    /// V: active and not acknowledged.
    Unacknowledged,
    /// S: active, not acknowledged, silenced for a while.
    Silenced,
    /// A: active and acknowledged, or active where there is nothing to acknowledge.
    Acknowledged,
    /// O: active, responsibility transferred.
    Transferred,
    /// U: no longer active, but never acknowledged.
    Rectified,
    /// N: no longer active.
    Normal,
}

/// What a bridge asks of a device about an alert.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum AlertCommand {
    /// A.
    Acknowledge,
    /// Q: tell it again.
    Request,
    /// O: the responsibility is transferred.
    Transfer,
    /// S.
    Silence,
}

letters! {
    AlertCategory { A b'A', B b'B', C b'C' }
    AlertPriority { EmergencyAlarm b'E', Alarm b'A', Warning b'W', Caution b'C' }
    AlertState {
        Unacknowledged b'V', Silenced b'S', Acknowledged b'A', Transferred b'O', Rectified b'U',
        Normal b'N',
    }
    AlertCommand { Acknowledge b'A', Request b'Q', Transfer b'O', Silence b'S' }
}

impl AlertId {
    /// Three fields; the identifier has three digits at least.
    pub(crate) fn write(&self, line: &mut Composer) {
        line.text(self.manufacturer.as_ref().map_or("", Manufacturer::as_str));
        line.whole(Some(self.identifier), 3, IDENTIFIER_MAX);
        line.whole(self.instance.filter(|instance| *instance > 0), 1, INSTANCE_MAX);
    }

    pub(crate) fn read(fields: &mut Fields<'_>) -> Result<Self, NmeaFault> {
        let manufacturer = fields.convert(Manufacturer::new)?;
        let identifier = fields.whole(IDENTIFIER_MAX)?.ok_or_else(|| fields.malformed())?;
        Ok(AlertId { manufacturer, identifier, instance: fields.whole(INSTANCE_MAX)? })
    }
}

/// Which alert, in three fields.
pub(super) struct Alert;

impl Kind for Alert {
    type Value = AlertId;

    fn write(&self, line: &mut Composer, alert: &AlertId) {
        alert.write(line);
    }

    fn read(&self, fields: &mut Fields<'_>) -> Result<AlertId, NmeaFault> {
        AlertId::read(fields)
    }
}

impl AlertEntry {
    /// Four fields.
    pub(crate) fn write(&self, line: &mut Composer) {
        self.alert.write(line);
        line.whole(self.revision.map(u32::from), 1, REVISION_MAX);
    }

    pub(crate) fn read(fields: &mut Fields<'_>) -> Result<Self, NmeaFault> {
        let alert = AlertId::read(fields)?;
        Ok(AlertEntry { alert, revision: small(fields, REVISION_MAX)? })
    }
}

/// A field of one of several letters.
pub(crate) fn lettered<T>(
    fields: &mut Fields<'_>,
    from_letter: fn(u8) -> Option<T>,
) -> Result<Option<T>, NmeaFault> {
    fields.convert(|text| letter_of(text).and_then(from_letter))
}

/// A small number.
pub(crate) fn small(fields: &mut Fields<'_>, max: u32) -> Result<Option<u8>, NmeaFault> {
    Ok(fields.whole(max)?.and_then(|value| u8::try_from(value).ok()))
}

/// How many sentences a message has, and which of them this one is.
pub(crate) fn place(fields: &mut Fields<'_>, max: u32) -> Result<(u8, u8), NmeaFault> {
    let sentences = small(fields, max)?.filter(|count| *count > 0);
    let sentences = sentences.ok_or_else(|| fields.malformed())?;
    let number = small(fields, max)?.filter(|number| (1..=sentences).contains(number));
    Ok((sentences, number.ok_or_else(|| fields.malformed())?))
}
