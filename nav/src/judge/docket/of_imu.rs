//! How far the IMU is believed: it cannot be left out, and whoever speaks against it may lie himself.

use insd_base::{Fault, Party, Span, Standing, Time};

use super::{Docket, FORGOTTEN, QUARANTINE};

impl Docket {
    /// By how many steps the IMU was found to be worse than its data sheet.
    #[must_use]
    pub fn worse(&self) -> u8 {
        self.worse
    }

    /// With an IMU that is a step worse.
    #[must_use]
    pub fn with_worse_imu(mut self) -> Self {
        self.worse = self.worse.saturating_add(1);
        self
    }

    /// Whether the IMU was found wrong by one witness, who may be so himself: neither is named.
    #[must_use]
    pub fn is_imu_doubted_by_one(&self) -> bool {
        self.by_one
    }

    /// So many others were heard when the IMU was found wrong. Two that told another speed at once may both go on to lie.
    pub fn note_witnesses(&mut self, count: usize, now: Time) {
        self.by_one = count < 2 || self.may_be_two(now);
    }

    /// Whether two that lie alike may be what the IMU is blamed for.
    #[must_use]
    pub fn may_be_two(&self, now: Time) -> bool {
        self.alike.is_some_and(|since| (now - since).as_seconds() < FORGOTTEN)
    }

    /// Two others have told another speed at once: the IMU missed a push, or they lie alike. None is named.
    pub(in crate::judge) fn note_alike(&mut self, now: Time) {
        (self.alike, self.by_one) = (Some(now), true);
    }

    /// Whether the IMU is not believed, in whatever way it is wrong.
    #[must_use]
    pub fn is_restless(&self) -> bool {
        self.restless.is_some()
    }

    /// When the IMU was last found wrong, if it is doubted for that.
    #[must_use]
    pub fn imu_doubted_since(&self) -> Option<Time> {
        let imu = &self.entries[Party::Imu as usize];
        (imu.standing == Standing::Doubtful).then_some(imu.since)
    }

    /// The IMU is of no use, as what it says was refuted again after it had been found wrong.
    pub fn condemn_imu(&mut self, now: Time) {
        self.disbelieve_imu(now);
        self.condemned = true;
    }

    /// Whether it is.
    #[must_use]
    pub fn is_imu_condemned(&self) -> bool {
        self.condemned
    }

    /// For how long the IMU has been seen to be wrong, in whatever way, s.
    #[must_use]
    pub fn wrong_imu_for(&self) -> f64 {
        self.restless.map_or(0.0, |(since, last)| (last - since).as_seconds())
    }

    /// The IMU is found wrong now, in whatever way.
    pub fn disbelieve_imu(&mut self, now: Time) {
        self.restless = Some((self.restless.map_or(now, |(since, _)| since), now));
        self.enter(Party::Imu, Standing::Doubtful, now);
        let imu = &mut self.entries[Party::Imu as usize];
        (imu.since, imu.fault) = (now, Some(Fault::ImuUseless));
    }

    /// The IMU was blamed for somebody else's lie: it is believed again, and what the receiver might have done instead is nothing.
    pub(in crate::judge) fn absolve_imu(&mut self, now: Time) {
        self.by_one = true;
        if !self.condemned {
            (self.restless, self.open) = (None, None);
            self.enter(Party::Imu, Standing::Trusted, now);
        }
    }

    /// The IMU is right as far as is seen now.
    pub fn consider_imu(&mut self, now: Time) {
        self.restless = self.restless.filter(|(_, last)| (now - *last).as_seconds() < QUARANTINE);
    }

    /// Nobody was heard for a time, s.
    pub fn postpone(&mut self, unheard: f64) {
        let later = |last: Time| last + Span::from_seconds(unheard);
        self.restless = self.restless.map(|(since, last)| (later(since), later(last)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_imu_that_two_contradict_who_may_lie_alike_is_not_named_for_an_hour() {
        let mut docket = Docket::default();
        docket.note_witnesses(2, Time::START);
        assert!(!docket.is_imu_doubted_by_one());
        docket.note_alike(Time::START);
        let after = |seconds: f64| {
            let mut later = docket;
            later.note_witnesses(2, Time::from_seconds(seconds));
            later.is_imu_doubted_by_one()
        };
        assert!(after(1800.0));
        assert!(!after(3700.0));
    }

    #[test]
    fn an_imu_that_was_blamed_for_another_is_believed_again_unless_it_is_of_no_use() {
        let (blamed, found) = (Time::from_seconds(100.0), Time::from_seconds(110.0));
        let mut docket = Docket::default();
        docket.disbelieve_imu(blamed);
        docket.absolve_imu(found);
        assert_eq!(docket.imu_doubted_since(), None);
        assert!(!docket.is_restless() && docket.open_lie().is_none());
        docket.condemn_imu(blamed);
        docket.absolve_imu(found);
        assert_eq!(docket.imu_doubted_since(), Some(blamed));
    }
}
