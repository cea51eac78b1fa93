//! What is left of all when the navigator begins anew, or goes on at another time.

use insd_base::{Party, Span, Standing, Time};

use super::{Docket, Entry};

impl Docket {
    /// What is left when the navigator begins anew on the word of a receiver that was not trusted.
    #[must_use]
    pub fn begun_anew(&self, now: Time) -> Self {
        let Docket { parts, lies, worse, by_one, alike, open, numbers, .. } = *self;
        let mut anew =
            Docket { parts, lies, worse, by_one, alike, open, numbers, ..Docket::default() };
        let others = [Party::Log, Party::Heading, Party::Antennas, Party::Docking];
        let others = others.into_iter().chain(Party::RECEIVERS);
        for named in others.filter(|named| *named != self.receiver_in_use()) {
            let own = &self.entries[named as usize];
            let is_left_out = matches!(own.standing, Standing::Excluded | Standing::Probation);
            if is_left_out && !self.is_named_by_a_doubted_imu(own) {
                anew.entries[named as usize] = *own;
            }
        }
        if self.standing(Party::Imu) == Standing::Doubtful {
            anew.entries[Party::Imu as usize] = self.entries[Party::Imu as usize];
        }
        let own = self.lie_of(Party::Gnss);
        if self.is_excluded(Party::Gnss) {
            anew.acquit(Party::Gnss, now);
        } else if anew.lies[own].unproven.is_some() {
            anew.enter(Party::Gnss, Standing::Probation, now);
        }
        anew.lies[own] = anew.lies[own].forgotten();
        anew
    }

    /// Whether somebody was named while the IMU was itself in doubt: it was held against that.
    fn is_named_by_a_doubted_imu(&self, own: &Entry) -> bool {
        let imu = &self.entries[Party::Imu as usize];
        matches!(imu.standing, Standing::Doubtful | Standing::Excluded) && own.since >= imu.since
    }

    /// The same on a time line that is later by a span.
    #[must_use]
    pub fn shifted(mut self, by: Span) -> Self {
        for entry in &mut self.entries {
            entry.since = entry.since + by;
            entry.agreeing_since = None;
        }
        self.lies = self.lies.map(|lie| lie.shifted(by));
        self.alike = self.alike.map(|since| since + by);
        self.open = self.open.map(|lie| lie.shifted(by));
        self.numbers = self.numbers.shifted(by);
        self
    }
}
