//! The track behind the ship, thinned so that it never grows long.

/// Points that are kept at most.
const MOST: usize = 600;

/// East and north, m, of the places where something was.
#[derive(Clone, Debug)]
pub struct Trail {
    points: Vec<(f64, f64)>,
    /// Of how many points offered one is kept.
    stride: usize,
    offered: usize,
}

impl Default for Trail {
    fn default() -> Self {
        Trail { points: Vec::new(), stride: 1, offered: 0 }
    }
}

impl Trail {
    /// Offers a point. When the trail is full every second one goes, and from then on every
    /// second one is kept, so that it covers the whole voyage evenly.
    pub fn offer(&mut self, point: (f64, f64)) {
        if self.offered.is_multiple_of(self.stride) {
            self.points.push(point);
        }
        self.offered += 1;
        if self.points.len() > MOST {
            let mut index = 0;
            self.points.retain(|_| {
                index += 1;
                index % 2 == 1
            });
            self.stride *= 2;
        }
    }

    /// The points, oldest first.
    #[must_use]
    pub fn points(&self) -> &[(f64, f64)] {
        &self.points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_voyage_keeps_its_first_point_and_an_even_spacing() {
        let mut trail = Trail::default();
        (0..100_000).for_each(|i| trail.offer((f64::from(i), 0.0)));
        let points = trail.points();
        assert!((MOST / 2..=MOST).contains(&points.len()), "{}", points.len());
        assert_eq!(points[0], (0.0, 0.0));
        let step = points[1].0;
        assert!(points.windows(2).all(|pair| pair[1].0 - pair[0].0 == step));
    }
}
