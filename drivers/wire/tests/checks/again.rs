//! What was read is written, and what was written is read.

use std::fmt::Debug;

/// What the writer keeps of what was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Keeps {
    /// All of it, but for the rounding of a double.
    Everything,
    /// What it rounds, saturates or leaves out it does once: a second time nothing changes.
    AfterOnce,
}

/// Reads a frame; if it can be read, writes it and reads that. Gives what was read first.
pub(crate) fn again<T: Debug, E: Debug>(
    frame: &[u8],
    keeps: Keeps,
    read: impl Fn(&[u8]) -> Result<T, E>,
    write: impl Fn(&T) -> Vec<u8>,
) -> Option<T> {
    let first = read(frame).ok()?;
    let reread = |message: &T| {
        let bytes = write(message);
        read(&bytes).unwrap_or_else(|fault| panic!("{message:?} as {bytes:02X?}: {fault:?}"))
    };
    let second = reread(&first);
    if keeps == Keeps::Everything {
        is_same(&first, &second);
    } else {
        is_same(&second, &reread(&second));
    }
    Some(first)
}

/// Compares two values by what they print; numbers may differ in the last digits.
fn is_same<T: Debug>(a: &T, b: &T) {
    let (a, b) = (format!("{a:?}"), format!("{b:?}"));
    let same = a == b || {
        let (a, b) = (words(&a), words(&b));
        a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| is_same_word(a, b))
    };
    assert!(same, "written and read again:\n{a}\n{b}");
}

fn words(text: &str) -> Vec<&str> {
    text.split([' ', ',', '(', ')', '[', ']', '{', '}']).collect()
}

fn is_same_word(a: &str, b: &str) -> bool {
    if a == b {
        return true;
    }
    let number = |word: &str| word.contains(['.', 'e']).then(|| word.parse::<f64>().ok()).flatten();
    let (Some(a), Some(b)) = (number(a), number(b)) else { return false };
    (a - b).abs() <= 1e-12 + 1e-9 * a.abs().max(b.abs())
}
