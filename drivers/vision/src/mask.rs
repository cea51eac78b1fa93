//! Where in an image points may be taken: not on water, not on the own ship.

use nalgebra::{Unit, Vector2, Vector3};

use crate::lens::CameraCalibration;

/// Corners of an area of the image, px; as seen, with the lens' distortion.
pub type Polygon = Vec<Vector2<f64>>;

/// What of an image is of use.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImageMask {
    /// Below the horizon only these are looked at; without any and with a known horizon nothing is.
    pub quay: Vec<Polygon>,
    /// The own ship: her rails, cranes and bow.
    pub own_ship: Vec<Polygon>,
}

impl ImageMask {
    /// Whether a point may be tracked. `down` is the vertical in camera axes, where it is known; without it water is not told from quay.
    #[must_use]
    pub fn allows(
        &self,
        camera: &CameraCalibration,
        down: Option<&Unit<Vector3<f64>>>,
        at: &Vector2<f64>,
    ) -> bool {
        if self.own_ship.iter().any(|polygon| contains(polygon, at)) {
            return false;
        }
        let Some(down) = down else { return true };
        let below = camera.ray(at).is_none_or(|ray| ray.dot(down) > 0.0);
        !below || self.quay.iter().any(|polygon| contains(polygon, at))
    }
}

/// Whether a point lies in a polygon: an odd number of edges is crossed on the way to the right.
fn contains(polygon: &[Vector2<f64>], at: &Vector2<f64>) -> bool {
    let ends = polygon.iter().cycle().skip(1);
    let crossed = polygon.iter().zip(ends).filter(|(a, b)| {
        (a.y > at.y) != (b.y > at.y) && at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)
    });
    crossed.count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lens::Lens;

    fn camera() -> CameraCalibration {
        let (focal, centre) = (Vector2::new(500.0, 500.0), Vector2::new(320.0, 240.0));
        CameraCalibration { focal, centre, size: [640, 480], lens: Lens::STRAIGHT }
    }

    fn square(from: f64, to: f64) -> Polygon {
        [(from, from), (to, from), (to, to), (from, to)].map(|(x, y)| Vector2::new(x, y)).to_vec()
    }

    #[test]
    fn water_below_the_horizon_is_left_out_and_the_quay_is_not() {
        let down = Vector3::y_axis();
        let mask = ImageMask { quay: vec![square(300.0, 400.0)], own_ship: Vec::new() };
        let allows = |x, y| mask.allows(&camera(), Some(&down), &Vector2::new(x, y));
        assert!(allows(100.0, 200.0) && !allows(100.0, 280.0) && allows(350.0, 350.0));
    }

    #[test]
    fn a_roll_tilts_the_horizon() {
        let down = Unit::new_normalize(Vector3::new(0.5, 0.87, 0.0));
        let allows =
            |x, y| ImageMask::default().allows(&camera(), Some(&down), &Vector2::new(x, y));
        assert!(allows(20.0, 260.0) && !allows(620.0, 200.0));
    }

    #[test]
    fn the_own_ship_is_never_looked_at() {
        let mask = ImageMask { quay: Vec::new(), own_ship: vec![square(0.0, 100.0)] };
        assert!(!mask.allows(&camera(), None, &Vector2::new(50.0, 50.0)));
        assert!(mask.allows(&camera(), None, &Vector2::new(50.0, 150.0)));
    }
}
