//! The navigation of several engines as one state.

/// What each engine left, by its name.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Checkpoints(pub Vec<(String, Vec<u8>)>);

impl Checkpoints {
    /// That of an engine.
    #[must_use]
    pub fn of(&self, name: &str) -> Option<&[u8]> {
        self.0.iter().find(|(own, _)| own == name).map(|(_, state)| state.as_slice())
    }

    /// As one state; `None` of nothing. Each name and each state has its length in front, 4 bytes, the least
    /// significant first.
    #[must_use]
    pub fn bytes(&self) -> Option<Vec<u8>> {
        let mut bytes = Vec::new();
        for part in self.0.iter().flat_map(|(name, state)| [name.as_bytes(), state]) {
            bytes.extend(u32::try_from(part.len()).ok()?.to_le_bytes());
            bytes.extend(part);
        }
        (!bytes.is_empty()).then_some(bytes)
    }

    /// What [`Checkpoints::bytes`] wrote; `None` of anything else.
    #[must_use]
    pub fn parse(mut bytes: &[u8]) -> Option<Self> {
        let mut all = Vec::new();
        while !bytes.is_empty() {
            let name = String::from_utf8(part(&mut bytes)?.to_vec()).ok()?;
            all.push((name, part(&mut bytes)?.to_vec()));
        }
        Some(Checkpoints(all))
    }
}

fn part<'a>(bytes: &mut &'a [u8]) -> Option<&'a [u8]> {
    let (length, rest) = bytes.split_first_chunk::<4>()?;
    let length = usize::try_from(u32::from_le_bytes(*length)).ok()?;
    let (own, rest) = rest.split_at_checked(length)?;
    *bytes = rest;
    Some(own)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_of_several_engines_are_found_again_by_name() {
        let own = |name: &str, state: &[u8]| (name.to_owned(), state.to_vec());
        let all = Checkpoints(vec![own("first", &[1, 2]), own("spare", &[])]);
        let bytes = all.bytes().unwrap();
        let back = Checkpoints::parse(&bytes).unwrap();
        assert_eq!(back, all);
        assert_eq!((back.of("first"), back.of("other")), (Some(&[1, 2][..]), None));
        assert_eq!(Checkpoints::default().bytes(), None);
        for end in 1..bytes.len() {
            let cut = Checkpoints::parse(&bytes[..end]);
            assert!(cut.is_none_or(|cut| cut.0.len() < 2), "{end}");
        }
    }
}
