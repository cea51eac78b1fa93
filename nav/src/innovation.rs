//! Innovations and the Kalman update: what every aid returns and what the filter does with it.

use nalgebra::{Cholesky, Const, SMatrix, SVector};

use crate::error_state::{Covariance, ErrorState, STATES};

/// Measured minus predicted, and how it depends on the error state: z = H x + noise(R).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Innovation<const M: usize> {
    /// Measured minus predicted.
    pub z: SVector<f64, M>,
    /// Measurement matrix.
    pub h: SMatrix<f64, M, STATES>,
    /// Covariance of the measurement noise.
    pub r: SMatrix<f64, M, M>,
}

/// An innovation with its covariance factored: ready to be judged and applied.
#[derive(Clone, Debug)]
pub struct Weighed<const M: usize> {
    innovation: Innovation<M>,
    pht: SMatrix<f64, STATES, M>,
    factor: Cholesky<f64, Const<M>>,
}

impl<const M: usize> Innovation<M> {
    /// Computes S = H P H^T + R and factors it; `None` if S is not positive definite or a value is
    /// not finite.
    #[must_use]
    pub fn weigh(&self, p: &Covariance) -> Option<Weighed<M>> {
        if !self.z.iter().all(|x| x.is_finite()) {
            return None;
        }
        let pht = p_h_transposed(p, &self.h);
        let s = self.h * pht + self.r;
        let symmetric = (s + s.transpose()) * 0.5;
        let factor = Cholesky::new(symmetric)?;
        Some(Weighed { innovation: *self, pht, factor })
    }
}

impl Innovation<3> {
    /// One component alone.
    #[must_use]
    pub fn component(&self, axis: usize) -> Innovation<1> {
        Innovation {
            z: SVector::<f64, 1>::new(self.z[axis]),
            h: self.h.fixed_rows::<1>(axis).into_owned(),
            r: SMatrix::<f64, 1, 1>::new(self.r[(axis, axis)]),
        }
    }

    /// One that tells nothing.
    #[must_use]
    pub fn silent() -> Self {
        Innovation { z: SVector::zeros(), h: SMatrix::zeros(), r: SMatrix::identity() }
    }

    /// Its first two components alone.
    #[must_use]
    pub fn horizontal(&self) -> Innovation<2> {
        Innovation {
            z: self.z.fixed_rows::<2>(0).into_owned(),
            h: self.h.fixed_rows::<2>(0).into_owned(),
            r: self.r.fixed_view::<2, 2>(0, 0).into_owned(),
        }
    }

    /// Two of one instant together.
    #[must_use]
    pub fn beside(&self, other: &Innovation<3>) -> Innovation<6> {
        let mut both =
            Innovation::<6> { z: SVector::zeros(), h: SMatrix::zeros(), r: SMatrix::zeros() };
        for (at, own) in [(0, self), (3, other)] {
            both.z.fixed_rows_mut::<3>(at).copy_from(&own.z);
            both.h.fixed_rows_mut::<3>(at).copy_from(&own.h);
            both.r.fixed_view_mut::<3, 3>(at, at).copy_from(&own.r);
        }
        both
    }
}

impl<const M: usize> Weighed<M> {
    /// Normalised innovation squared, z^T S^-1 z: chi-square with M degrees of freedom.
    #[must_use]
    pub fn nis(&self) -> f64 {
        self.whitened().norm_squared()
    }

    /// Half the logarithm of det S.
    #[must_use]
    pub fn log_root_determinant(&self) -> f64 {
        self.factor.l_dirty().diagonal().iter().map(|d| d.ln()).sum()
    }

    /// The innovation.
    #[must_use]
    pub fn z(&self) -> &SVector<f64, M> {
        &self.innovation.z
    }

    /// 1-sigma that the filter expects of each component.
    #[must_use]
    pub fn sigma(&self) -> SVector<f64, M> {
        let l = self.factor.l();
        SVector::from_fn(|i, _| l.row(i).norm())
    }

    /// The optimal gain, P H^T S^-1.
    #[must_use]
    pub fn gain(&self) -> SMatrix<f64, STATES, M> {
        self.pht * self.factor.inverse()
    }

    /// Update with a gain of one's own choice: Joseph's form,
    /// P <- (I - K H) P (I - K H)^T + K R K^T.
    #[must_use]
    pub fn update_with(&self, p: &mut Covariance, gain: &SMatrix<f64, STATES, M>) -> ErrorState {
        let left = Covariance::identity() - gain * self.innovation.h;
        *p = left * *p * left.transpose() + gain * self.innovation.r * gain.transpose();
        *p = (*p + p.transpose()) * 0.5;
        gain * self.innovation.z
    }

    /// What an effect on the errors (a row for each cause) does to the innovation, and the innovation
    /// itself, both whitened: L^-1 (H U + D) transposed, and L^-1 z, D what the causes do to it directly.
    #[must_use]
    pub fn whitened_with<const W: usize>(
        &self,
        response: &SMatrix<f64, W, STATES>,
        direct: &SMatrix<f64, M, W>,
    ) -> (SMatrix<f64, W, M>, SVector<f64, M>) {
        let mut effect = self.innovation.h * response.transpose() + direct;
        self.factor.l_dirty().solve_lower_triangular_mut(&mut effect);
        (effect.transpose(), self.whitened())
    }

    /// What an effect on the errors (a row for each cause) and `direct` do to the innovation, H U + D
    /// transposed, as it is and whitened, and the innovation itself, whitened.
    #[must_use]
    pub fn effect_of<const W: usize>(
        &self,
        response: &SMatrix<f64, W, STATES>,
        direct: &SMatrix<f64, W, M>,
    ) -> (SMatrix<f64, W, M>, SMatrix<f64, W, M>, SVector<f64, M>) {
        let mut effect = *direct;
        for state in 0..STATES {
            for row in 0..M {
                let weight = self.innovation.h[(row, state)];
                if weight != 0.0 {
                    effect.column_mut(row).axpy(weight, &response.column(state), 1.0);
                }
            }
        }
        let mut whitened = effect.transpose();
        self.factor.l_dirty().solve_lower_triangular_mut(&mut whitened);
        (effect, whitened.transpose(), self.whitened())
    }

    /// Takes from an effect on the errors what an update with this gain takes from it:
    /// U <- U - K H U.
    pub fn pass_on<const W: usize>(
        &self,
        response: &mut SMatrix<f64, W, STATES>,
        gain: &SMatrix<f64, STATES, M>,
    ) {
        let effect = *response * self.innovation.h.transpose();
        *response -= effect * gain.transpose();
    }

    fn whitened(&self) -> SVector<f64, M> {
        let mut z = self.innovation.z;
        self.factor.l_dirty().solve_lower_triangular_mut(&mut z);
        z
    }

    /// Kalman update: returns the estimated error and lowers the covariance.
    ///
    /// With S = L L^T and W = P H^T L^-T the update is x = W L^-1 z, P <- P - W W^T, which keeps P
    /// exactly symmetric. The covariance must be the one that [`Innovation::weigh`] saw.
    #[must_use]
    pub fn update(&self, p: &mut Covariance) -> ErrorState {
        let l = self.factor.l();
        let mut w_t = self.pht.transpose();
        l.solve_lower_triangular_mut(&mut w_t);
        let w = w_t.transpose();
        *p -= w * w_t;
        w * self.whitened()
    }
}

/// P H^T, the empty columns of H left out.
fn p_h_transposed<const M: usize>(
    p: &Covariance,
    h: &SMatrix<f64, M, STATES>,
) -> SMatrix<f64, STATES, M> {
    let mut pht = SMatrix::<f64, STATES, M>::zeros();
    for state in 0..STATES {
        for row in 0..M {
            let weight = h[(row, state)];
            if weight != 0.0 {
                pht.column_mut(row).axpy(weight, &p.column(state), 1.0);
            }
        }
    }
    pht
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn an_update_agrees_with_the_joseph_form() {
        let root = SMatrix::<f64, STATES, STATES>::from_fn(|i, j| {
            ((i * 7 + j * 3) as f64).sin() + if i == j { 2.0 } else { 0.0 }
        });
        let p: Covariance = root * root.transpose();
        let innovation = Innovation::<2> {
            z: SVector::<f64, 2>::new(0.3, -0.2),
            h: SMatrix::from_fn(|i, j| if (i + j) % 5 == 0 { 1.0 - i as f64 } else { 0.0 }),
            r: SMatrix::<f64, 2, 2>::from_diagonal_element(0.5),
        };
        let s = innovation.h * p * innovation.h.transpose() + innovation.r;
        let k = p * innovation.h.transpose() * s.try_inverse().unwrap();
        let i_kh = Covariance::identity() - k * innovation.h;
        let joseph = i_kh * p * i_kh.transpose() + k * innovation.r * k.transpose();
        let mut updated = p;
        let x = innovation.weigh(&p).unwrap().update(&mut updated);
        assert_relative_eq!(updated, joseph, epsilon = 1e-8);
        assert_relative_eq!(x, k * innovation.z, epsilon = 1e-8);
        assert_eq!(updated, updated.transpose());
    }

    #[test]
    fn a_value_that_is_not_finite_is_never_weighed() {
        let innovation = Innovation::<1> {
            z: SVector::<f64, 1>::new(f64::NAN),
            h: SMatrix::zeros(),
            r: SMatrix::<f64, 1, 1>::identity(),
        };
        assert!(innovation.weigh(&Covariance::identity()).is_none());
    }
}
