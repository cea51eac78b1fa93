//! A covariance, and a vector of errors, as they are kept, and taken up again to the bit.

use nalgebra::{DMatrix, DVector};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::covariance::Covariance;
use crate::errors::Errors;
use crate::layout::{Layout, Place};

/// What is written: the blocks, and the upper triangle by columns, each down to its diagonal.
#[derive(Serialize, Deserialize)]
struct Kept {
    places: Vec<Place>,
    triangle: Vec<f64>,
}

/// A correlation may be beyond one by so much: rounding.
const ROUNDING: f64 = 1e-6;
/// No state vector is longer.
const LONGEST: usize = 4096;

impl Serialize for Covariance {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let p = self.matrix();
        let column = |column: usize| (0..=column).map(move |row| p[(row, column)]);
        let triangle = (0..self.states()).flat_map(column).collect();
        Kept { places: self.layout().places().to_vec(), triangle }.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Covariance {
    /// Fails unless it can be a covariance: finite, no variance below zero, no correlation beyond one.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let kept = Kept::deserialize(deserializer)?;
        let layout = layout_of(&kept.places).ok_or_else(|| D::Error::custom("blocks overlap"))?;
        let states = layout.states();
        if kept.triangle.len() != states * (states + 1) / 2 {
            return Err(D::Error::custom("as many values as states ask for were expected"));
        }
        let index = |row: usize, column: usize| column * (column + 1) / 2 + row;
        let p = DMatrix::from_fn(states, states, |i, j| kept.triangle[index(i.min(j), i.max(j))]);
        is_covariance(&p)
            .then(|| Covariance::new(layout, p))
            .ok_or_else(|| D::Error::custom("no covariance has these values"))
    }
}

/// What is written of a vector.
#[derive(Serialize, Deserialize)]
struct ErrorsCheckpoint {
    places: Layout,
    values: Vec<f64>,
}

impl Serialize for Errors {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let values = self.values().as_slice().to_vec();
        ErrorsCheckpoint { places: self.layout().clone(), values }.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Errors {
    /// Fails unless there is a value for each state.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let ErrorsCheckpoint { places, values } = ErrorsCheckpoint::deserialize(deserializer)?;
        (places.states() == values.len())
            .then(|| Errors::new(places, DVector::from_vec(values)))
            .ok_or_else(|| D::Error::custom("a value for each state was expected"))
    }
}

impl Serialize for Layout {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.places().serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Layout {
    /// Fails if blocks are not one after the other, or one is there twice.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let places = Vec::<Place>::deserialize(deserializer)?;
        layout_of(&places).ok_or_else(|| D::Error::custom("blocks overlap"))
    }
}

/// The layout of these places, if each is there once and they follow each other.
fn layout_of(places: &[Place]) -> Option<Layout> {
    let is_long = places.iter().any(|place| place.width > LONGEST) || places.len() > LONGEST;
    let unique = |i: usize| places[..i].iter().all(|before| before.key != places[i].key);
    if is_long || !(0..places.len()).all(unique) {
        return None;
    }
    let layout = Layout::of_blocks(places.iter().map(|place| (place.key, place.width)));
    (layout.states() <= LONGEST && layout.places() == places).then_some(layout)
}

fn is_covariance(p: &DMatrix<f64>) -> bool {
    let root = p.diagonal().map(f64::sqrt);
    let is_bounded = |i: usize, j: usize| {
        p[(i, j)].abs() <= root[i] * root[j] * (1.0 + ROUNDING) + f64::MIN_POSITIVE
    };
    let mut pairs = (0..p.nrows()).flat_map(|i| (0..i).map(move |j| (i, j)));
    p.iter().all(|value| value.is_finite())
        && root.iter().all(|std| std.is_finite())
        && pairs.all(|(i, j)| is_bounded(i, j))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::Block;
    use nalgebra::{Matrix1, Matrix2, Vector2};

    fn covariance() -> Covariance {
        let mut p = Covariance::none();
        p.join(Block::<2>::new(4), &Matrix2::new(2.0, 0.3, 0.3, 1.0));
        p.join(Block::<1>::new(1).instance(3), &Matrix1::new(0.1 + 0.2));
        p
    }

    #[test]
    fn what_was_kept_is_taken_up_to_the_bit() {
        let kept = serde_json::to_string(&covariance()).unwrap();
        assert_eq!(serde_json::from_str::<Covariance>(&kept).unwrap(), covariance());
        let mut errors = Errors::none();
        errors.set(Block::<2>::new(4), &Vector2::new(0.1 + 0.2, -1e-300));
        let kept = serde_json::to_string(&errors).unwrap();
        assert_eq!(serde_json::from_str::<Errors>(&kept).unwrap(), errors);
    }

    #[test]
    fn what_cannot_be_a_covariance_is_refused() {
        let kept = serde_json::to_value(covariance()).unwrap();
        let spoilt = |change: &dyn Fn(&mut serde_json::Value)| {
            let mut spoilt = kept.clone();
            change(&mut spoilt);
            serde_json::from_value::<Covariance>(spoilt).is_err()
        };
        assert!(spoilt(&|kept| kept["triangle"][0] = (-1.0).into()));
        assert!(spoilt(&|kept| kept["triangle"][1] = 1e3.into()));
        assert!(spoilt(&|kept| kept["triangle"] = vec![1.0; 5].into()));
        assert!(spoilt(&|kept| kept["places"][1]["start"] = 1.into()));
        assert!(spoilt(&|kept| kept["places"][1]["key"] = kept["places"][0]["key"].clone()));
        assert!(spoilt(&|kept| kept["places"][1]["width"] = u64::MAX.into()));
        assert!(!spoilt(&|_| {}));
        for value in [f64::NAN, f64::INFINITY] {
            let mut p = covariance().matrix().clone();
            (p[(0, 1)], p[(1, 0)]) = (value, value);
            assert!(!is_covariance(&p));
        }
    }
}
