//! A key of a scenario that takes several values in one campaign.

use std::str::FromStr;

use insd_simulator::Override;

/// `KEY=A,B,C`: the same key with one value after the other.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sweep(Vec<Override>);

impl FromStr for Sweep {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let expected = || "expected KEY=A,B,C, for example sea.state=3,5".to_owned();
        let (key, values) = text.split_once('=').ok_or_else(expected)?;
        let set = |value: &str| format!("{key}={value}").parse::<Override>();
        Ok(Sweep(parts(values).into_iter().map(set).collect::<Result<_, _>>()?))
    }
}

/// The values between the commas, those within brackets left alone.
fn parts(values: &str) -> Vec<&str> {
    let mut depth = 0_i32;
    let is_between = |letter: char| {
        depth += i32::from("[{".contains(letter)) - i32::from("]}".contains(letter));
        letter == ',' && depth == 0
    };
    values.split(is_between).collect()
}

/// Every value of the first with every value of the second, and so on: what is set in each variation. One variation
/// in which nothing is set where there are no sweeps.
pub(super) fn variations(sweeps: &[Sweep]) -> Vec<Vec<Override>> {
    sweeps.iter().fold(vec![Vec::new()], |variations, Sweep(values)| {
        let with = |variation: &Vec<Override>| {
            let variation = variation.clone();
            values
                .iter()
                .map(move |value| [variation.as_slice(), std::slice::from_ref(value)].concat())
        };
        variations.iter().flat_map(with).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sweeps_multiply() {
        let sweeps = ["sea.state=3,5", "start.lat_deg=0,40,60"].map(|text| text.parse().unwrap());
        let all = variations(&sweeps);
        assert_eq!(all.len(), 6);
        let shown: Vec<String> = all[1].iter().map(ToString::to_string).collect();
        assert_eq!(shown, ["sea.state=3", "start.lat_deg=40"]);
        assert_eq!(variations(&[]), vec![vec![]]);
    }

    #[test]
    fn a_comma_within_brackets_belongs_to_the_value() {
        assert_eq!(parts("[1, 2],[3,4]"), ["[1, 2]", "[3,4]"]);
        assert!("sea.state".parse::<Sweep>().is_err() && "a=1,,2".parse::<Sweep>().is_err());
    }
}
