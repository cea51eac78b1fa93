//! Pairs of field and value in a group function. How long a value is only the field tells.

use crate::bytes::{Bytes, little_endian};
use crate::groups::ParameterError;

/// How long the value of a field is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Width {
    /// So many bytes.
    Bytes(usize),
    /// A text whose first byte is its length.
    Text,
}

/// Fields of group 60928.
pub(crate) const CLAIM: [Width; 10] = [
    Width::Bytes(3),
    Width::Bytes(2),
    Width::Bytes(1),
    Width::Bytes(1),
    Width::Bytes(1),
    Width::Bytes(1),
    Width::Bytes(1),
    Width::Bytes(1),
    Width::Bytes(1),
    Width::Bytes(1),
];
/// The bits that count of each of them.
pub(crate) const CLAIM_BITS: [u32; 10] = [21, 11, 3, 5, 8, 1, 7, 4, 3, 1];

/// Fields of group 126464.
pub(crate) const LIST: [Width; 1] = [Width::Bytes(1)];

/// Fields of group 126996.
pub(crate) const PRODUCT: [Width; 8] = [
    Width::Bytes(2),
    Width::Bytes(2),
    Width::Bytes(32),
    Width::Bytes(32),
    Width::Bytes(32),
    Width::Bytes(32),
    Width::Bytes(1),
    Width::Bytes(1),
];

/// Fields of group 126998.
pub(crate) const CONFIGURATION: [Width; 3] = [Width::Text; 3];

/// Has each pair judged, by the number of the field, from 1, and its value; the codes of all. After a
/// field of unknown length nothing can be told of the rest.
pub(crate) fn judge(
    count: u8,
    pairs: &[u8],
    widths: &[Width],
    mut verdict: impl FnMut(u8, &[u8]) -> ParameterError,
) -> Vec<u8> {
    let mut bytes = Bytes(pairs);
    let mut lost = false;
    let mut code = || {
        if lost {
            return ParameterError::Unable;
        }
        match next(&mut bytes, widths) {
            Some((field, value)) => verdict(field, value),
            None => {
                lost = true;
                ParameterError::NoSuchField
            }
        }
    };
    (0..count).map(|_| code() as u8).collect()
}

fn next<'a>(bytes: &mut Bytes<'a>, widths: &[Width]) -> Option<(u8, &'a [u8])> {
    let field = bytes.byte()?;
    let width = widths.get(usize::from(field.checked_sub(1)?))?;
    let length = match width {
        Width::Bytes(length) => *length,
        Width::Text => usize::from(*bytes.0.first()?).max(2),
    };
    Some((field, bytes.take(length)?))
}

/// The verdict of a request that wants fields to have these values.
pub(crate) fn equals(current: &[Vec<u8>], field: u8, value: &[u8]) -> ParameterError {
    let own = usize::from(field).checked_sub(1).and_then(|at| current.get(at));
    if own.is_some_and(|own| own == value) {
        ParameterError::None
    } else {
        ParameterError::OutOfRange
    }
}

/// The value of a number of so many bits; `None` if a higher bit is set.
pub(crate) fn small(value: &[u8], bits: u32) -> Option<u8> {
    let number = little_endian(value);
    u8::try_from(number).ok().filter(|number| u32::from(*number) >> bits == 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_are_read_by_the_widths_of_their_fields() {
        let mut seen = Vec::new();
        let codes = judge(3, &[1, 9, 8, 7, 3, 5, 4, 6], &CLAIM, |field, value| {
            seen.push((field, value.to_vec()));
            ParameterError::None
        });
        assert_eq!(seen, [(1, vec![9, 8, 7]), (3, vec![5]), (4, vec![6])]);
        assert_eq!(codes, [0, 0, 0]);
    }

    #[test]
    fn after_an_unknown_or_cut_field_the_rest_is_not_looked_at() {
        let judge = |pairs: &[u8]| judge(3, pairs, &CLAIM, |_, _| ParameterError::None);
        assert_eq!(judge(&[3, 5, 11, 1, 3, 5]), [0, 1, 2]);
        assert_eq!(judge(&[3, 5, 1, 1]), [0, 1, 2]);
        assert_eq!(judge(&[0, 5]), [1, 2, 2]);
        assert_eq!(judge(&[]), [1, 2, 2]);
    }
}
