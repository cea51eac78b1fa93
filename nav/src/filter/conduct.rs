//! What is watched of her way: how the craft behaves.

use crate::pace::PaceWatch;
use crate::slip::Slip;
use crate::wheels::Wheels;

/// What is watched of her way.
#[derive(Clone, Debug, Default)]
pub(super) struct Conduct {
    /// How fast she changes her speed, and how fast she moves athwart.
    pub(super) pace: PaceWatch,
    pub(super) lurch: PaceWatch,
    /// How her heading turns beside her course.
    pub(super) slip: Slip,
    pub(super) wheels: Wheels,
}

impl Conduct {
    /// The estimate is not that of before: how it moved since is of no account.
    pub(super) fn restart(&mut self) {
        self.pace.restart();
        self.lurch.restart();
        self.slip.restart();
    }
}
