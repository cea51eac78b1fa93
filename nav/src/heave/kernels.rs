//! The averages that heave is measured by.

use super::kernel::Kernel;
use super::learner::Grade;
use super::point::Expected;
use super::times::{DELAY, LESSON};

/// What the average of the delayed heave stops and passes, s.
const DELAYED_BAND: (f64, f64) = (40.0, 100.0);
/// The same for the average that the bank is measured against.
const LESSON_BAND: (f64, f64) = (30.0, 80.0);
/// Half the length of the average that shows what is slower than heave, and what it stops and passes, s.
const SLOW: f64 = 75.0;
const SLOW_BAND: (f64, f64) = (45.0, 120.0);
/// Distance of the averages whose fourth difference is the slow motion, s.
const SLOW_APART: f64 = 22.0;

/// The averages, and what the IMU's errors leave of them.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Kernels {
    pub(super) delayed: Kernel,
    pub(super) lesson: Kernel,
    pub(super) slow: Kernel,
    pub(super) expected: Expected,
}

impl Kernels {
    pub(super) fn new(grade: &Grade) -> Self {
        let delayed = Kernel::low_pass(DELAY, DELAYED_BAND.0, DELAYED_BAND.1);
        let lesson = Kernel::low_pass(LESSON as f64, LESSON_BAND.0, LESSON_BAND.1);
        let slow = Kernel::low_pass(SLOW, SLOW_BAND.0, SLOW_BAND.1).fourth_difference(SLOW_APART);
        let expected = Expected {
            delayed: delayed.response_of_rest().variance(grade.noise, grade.walk),
            slow: slow.response().variance(grade.noise, grade.walk),
        };
        Kernels { delayed, lesson, slow, expected }
    }
}
