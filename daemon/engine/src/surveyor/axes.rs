//! The six axes of an IMU, each watched by itself.

use insd_base::{Axes, ImuSample};

/// Who watches one axis.
pub(super) trait Watch {
    /// Sees what it tells, and the duration of the sample, s.
    fn see(&mut self, value: f64, duration: f64);
    /// Whether it is found wrong.
    fn is_wrong(&self) -> bool;
}

/// One for each of the six.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Each<A> {
    gyro: [A; 3],
    accel: [A; 3],
}

impl<A: Watch> Each<A> {
    /// Sees a sample as it came, and its duration, s.
    pub(super) fn see(&mut self, sample: &ImuSample, duration: f64) {
        let of = |axes: &mut [A; 3], values: &[f64]| {
            axes.iter_mut().zip(values).for_each(|(axis, value)| axis.see(*value, duration));
        };
        of(&mut self.gyro, sample.delta_theta.0.as_slice());
        of(&mut self.accel, sample.delta_velocity.0.as_slice());
    }

    /// Those that are found wrong, if any are.
    pub(super) fn axes(&self) -> Option<Axes> {
        let which = |axes: &[A; 3]| axes.each_ref().map(A::is_wrong);
        let axes = Axes { gyro: which(&self.gyro), accel: which(&self.accel) };
        axes.any().then_some(axes)
    }
}
