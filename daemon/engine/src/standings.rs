//! How everybody stands, told when it changes.

use insd_base::{Event, Party, Standing, Stands};

use crate::Engine;

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
    fn note(&mut self, stands: &Stands) -> bool {
        let before = std::mem::replace(&mut self.0[stands.party as usize], stands.standing);
        before != stands.standing
    }
}

impl Engine {
    /// Tells whoever stands otherwise than was told last. What is made of the others beside an IMU that is not believed is
    /// of no account.
    pub(crate) fn tell_standings(&mut self) {
        if self.shunned.is_some() {
            return;
        }
        let mut told = self.told;
        let new: Vec<Stands> = self.standings().filter(|stands| told.note(stands)).collect();
        self.told = told;
        for stands in new {
            let time = stands.since;
            self.tell(Event::Judged { time, stands });
        }
    }
}
