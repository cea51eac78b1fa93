//! What the status words of sensors say.

use insd_intake::config::Kind;

/// Bits of IMU_STATUS of SBG, of which each must be set: what is wrong where one is not.
const SBG: [&str; 10] = [
    "no communication with the IMU",
    "built-in test failed",
    "accelerometer X failed its test",
    "accelerometer Y failed its test",
    "accelerometer Z failed its test",
    "gyro X failed its test",
    "gyro Y failed its test",
    "gyro Z failed its test",
    "accelerometers out of range",
    "gyros out of range",
];

/// Bits of the status bytes of STIM300, the same for gyros and accelerometers: what is wrong where one is
/// set. Bits 0 to 2 name the axes.
const STIM: [&str; 8] = [
    "X",
    "Y",
    "Z",
    "error in the measurement channel",
    "overload",
    "outside its operating conditions",
    "starting",
    "integrity error",
];

/// The words of a status word; none where the kind has no status or it is not known what it says.
pub(super) fn meaning(kind: Kind, word: u32) -> Vec<String> {
    let set = |bit: usize| word >> bit & 1 == 1;
    match kind {
        Kind::Sbg => {
            let wrong = SBG.iter().enumerate().filter(|(bit, _)| !set(*bit));
            or_sound(wrong.map(|(_, text)| (*text).to_owned()).collect())
        }
        Kind::Stim => {
            let groups = [("gyros", 0), ("accelerometers", 8), ("inclinometers", 16)];
            let of_group = |(name, from): (&str, usize)| {
                let own = STIM.iter().enumerate().filter(|(bit, _)| set(from + bit));
                let texts: Vec<&str> = own.map(|(_, text)| *text).collect();
                (!texts.is_empty()).then(|| format!("{name}: {}", texts.join(", ")))
            };
            or_sound(groups.into_iter().filter_map(of_group).collect())
        }
        _ => Vec::new(),
    }
}

fn or_sound(wrong: Vec<String>) -> Vec<String> {
    if wrong.is_empty() { vec!["self-tests passed".to_owned()] } else { wrong }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_status_word_is_told_in_words() {
        assert_eq!(meaning(Kind::Sbg, 0x03FF), ["self-tests passed"]);
        assert_eq!(meaning(Kind::Sbg, 0x07FF), ["self-tests passed"], "the scale is no fault");
        assert_eq!(meaning(Kind::Sbg, 0x03DF), ["gyro X failed its test"]);
        assert_eq!(meaning(Kind::Sbg, 0x00FF).len(), 2);
        assert_eq!(meaning(Kind::Stim, 0), ["self-tests passed"]);
        assert_eq!(meaning(Kind::Stim, 0x1200), ["accelerometers: Y, overload"]);
        assert!(meaning(Kind::Ubx, 7).is_empty());
    }
}
