//! Gauss-Legendre quadrature of three points, exact for polynomials of the fifth degree.

/// Nodes on [0, 1]: 1/2 -+ sqrt(3/5)/2 and 1/2.
pub(crate) const NODES: [f64; 3] = [0.112_701_665_379_258_31, 0.5, 0.887_298_334_620_741_7];
/// Weights, of sum 1.
pub(crate) const WEIGHTS: [f64; 3] = [5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0];

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn polynomials_of_the_fifth_degree_are_integrated_exactly() {
        for degree in 0..=5 {
            let sum: f64 = NODES.iter().zip(WEIGHTS).map(|(x, w)| w * x.powi(degree)).sum();
            assert_relative_eq!(sum, 1.0 / f64::from(degree + 1), epsilon = 1e-15);
        }
    }
}
