//! How everybody stands, told when it changes.

use insd_base::{Party, Standing, Stands};

/// What was told last of each.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Told([Standing; Party::ALL.len()]);

impl Default for Told {
    fn default() -> Self {
        Told([Standing::Trusted; Party::ALL.len()])
    }
}

impl Told {
    /// Takes note of how somebody stands; tells whether that is new.
    pub(crate) fn note(&mut self, stands: &Stands) -> bool {
        let before = std::mem::replace(&mut self.0[stands.party as usize], stands.standing);
        before != stands.standing
    }
}
