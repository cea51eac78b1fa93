//! Whose clock it is that a delay between receiver and IMU is put down to.
//!
//! The filter estimates one delay, of the receiver's epochs behind the time base of the IMU. As a rule the receiver
//! has the better clock, and a solution is told in its time. A receiver that smooths its positions, or dates them by
//! when it sends them, has not: then the time of the IMU stands. With sigma_i and sigma_r what the stamps of the IMU
//! and the epochs of the receiver may be off by, the mean of the part of the IMU, given the sum d, is
//!
//! d_i = d sigma_i^2 / (sigma_i^2 + sigma_r^2),   its variance sigma_i^2 sigma_r^2 / (sigma_i^2 + sigma_r^2)
//!
//! (Gelb, Applied Optimal Estimation, eqs. (4.2-6), (4.2-7), with the sum as a perfect measurement).

/// The part of a delay that is the IMU's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dating {
    /// Of the delay as it is estimated.
    pub share: f64,
    /// What the part is unsure of when the delay is known, 1-sigma, s.
    pub std: f64,
}

impl Dating {
    /// By what both clocks may be off, 1-sigma, s: that of the IMU and that of the receiver.
    #[must_use]
    pub fn new(imu: f64, receiver: f64) -> Self {
        let both = imu.hypot(receiver);
        if both > 0.0 {
            Dating { share: (imu / both).powi(2), std: imu * receiver / both }
        } else {
            Dating { share: 1.0, std: 0.0 }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_delay_is_put_down_to_the_worse_clock() {
        assert_eq!(Dating::new(1e-3, 0.0), Dating { share: 1.0, std: 0.0 });
        let late = Dating::new(1e-3, 0.3);
        assert!(late.share < 1e-4 && (late.std - 1e-3).abs() < 1e-5);
        let alike = Dating::new(0.1, 0.1);
        assert!((alike.share - 0.5).abs() < 1e-12 && (alike.std - 0.1 / 2f64.sqrt()).abs() < 1e-12);
        assert_eq!(Dating::new(0.0, 0.0).share, 1.0);
    }
}
