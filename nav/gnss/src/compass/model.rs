//! The equations of an epoch: differences between antennas as they depend on pose, line biases and clocks (gnss.md, eq. 14).

use nalgebra::{DMatrix, DVector, RowVector3, Vector3};

use super::lines::LineBiases;
use super::pose::CompassPose;
use super::settings::{CompassArray, CompassShape};
use super::signal::{Common, Heard};
use insd_base::satellites::LineBias;

/// An array as it is taken for in one epoch, and what it heard.
#[derive(Clone, Copy, Debug)]
pub(super) struct Model<'a> {
    pub(super) array: &'a CompassArray,
    pub(super) commons: &'a [Common],
}

/// Lines that move together, as all their receivers are on a clock that is not the first antenna's.
pub(super) struct Clock {
    pub(super) places: Vec<usize>,
}

impl<'a> Model<'a> {
    pub(super) fn shape(&self) -> &'a CompassShape {
        &self.array.shape
    }

    /// The clock of an antenna, if it is not the first one's.
    pub(super) fn own_clock(&self, antenna: usize) -> Option<usize> {
        Some(self.array.clocks[antenna]).filter(|clock| *clock != self.array.clocks[0])
    }

    /// Where an antenna stands on the hull; nought of two antennas without one.
    pub(super) fn lever(&self, antenna: usize) -> Vector3<f64> {
        match self.shape() {
            CompassShape::Body(levers) => levers[antenna],
            CompassShape::Baseline { .. } => Vector3::zeros(),
        }
    }

    /// Line biases that the epoch has to do with, each once.
    pub(super) fn keys(&self) -> Vec<LineBias> {
        let heard = self.commons.iter().flat_map(|common| &common.heard);
        let mut keys: Vec<LineBias> =
            heard.map(|own| own.line).filter(|line| !line.is_origin()).collect();
        keys.sort();
        keys.dedup();
        keys
    }

    /// The wavelength of a line, m.
    fn wavelength(&self, line: &LineBias) -> Option<f64> {
        let has = |common: &&Common| common.heard.iter().any(|own| own.line == *line);
        self.commons.iter().find(has).map(|common| common.wavelength)
    }

    /// Those that are not on the first antenna's clock: by clock and wavelength, as what a clock is off by is known only up to whole wavelengths.
    pub(super) fn clocks(&self, lines: &LineBiases) -> Vec<Clock> {
        let mut clocks: Vec<((usize, i64), Clock)> = Vec::new();
        for (place, line) in lines.keys.iter().enumerate() {
            let Some(clock) = self.own_clock(line.antenna) else { continue };
            // micrometres: bands are centimetres apart
            let Some(wavelength) = self.wavelength(line) else { continue };
            let key = (clock, (wavelength * 1e6).round() as i64);
            match clocks.iter_mut().find(|(own, _)| *own == key) {
                Some((_, clock)) => clock.places.push(place),
                None => clocks.push((key, Clock { places: vec![place] })),
            }
        }
        clocks.into_iter().map(|(_, clock)| clock).collect()
    }

    /// Phase of an antenna less that of another, less what pose and line biases make of it, m: whole wavelengths and errors are left.
    pub(super) fn difference(
        &self,
        common: &Common,
        (own, against): (&Heard, &Heard),
        offsets: &[Vector3<f64>],
        lines: &LineBiases,
    ) -> f64 {
        let apart = offsets[own.antenna] - offsets[against.antenna];
        let bias = |of: &Heard| lines.place(&of.line).map_or(0.0, |place| lines.mean[place]);
        own.phase - against.phase + common.line_of_sight.dot(&apart) - bias(own) + bias(against)
    }

    /// The shortest wavelength, m.
    pub(super) fn shortest(&self) -> f64 {
        self.commons.iter().map(|common| common.wavelength).fold(1.0, f64::min)
    }

    /// How many satellites there are.
    pub(super) fn satellites(&self) -> usize {
        let mut all: Vec<_> = self.commons.iter().map(|common| common.satellite).collect();
        all.sort();
        all.dedup();
        all.len()
    }

    /// Where all antennas stand.
    pub(super) fn offsets(&self, pose: &CompassPose) -> Vec<Vector3<f64>> {
        let antennas = 0..self.array.antennas();
        antennas.map(|antenna| pose.offset(self.shape(), antenna)).collect()
    }

    /// How the phase of each antenna depends on pose (3 columns) and line biases.
    pub(super) fn design(
        &self,
        common: &Common,
        pose: &CompassPose,
        lines: &LineBiases,
    ) -> DMatrix<f64> {
        let mut design = DMatrix::zeros(common.heard.len(), 3 + lines.keys.len());
        for (row, own) in common.heard.iter().enumerate() {
            let jacobian = pose.jacobian(self.shape(), own.antenna);
            let by_pose: RowVector3<f64> = -common.line_of_sight.transpose() * jacobian;
            design.fixed_view_mut::<1, 3>(row, 0).copy_from(&by_pose);
            if let Some(place) = lines.place(&own.line) {
                design[(row, 3 + place)] = 1.0;
            }
        }
        design
    }
}

impl Common {
    /// Inverse covariance of the antennas' phases where the one that they share, the receivers' and the satellite's, is free, m^-2: the same as differences of all
    /// pairs with all that they have in common.
    pub(super) fn weight(&self) -> DMatrix<f64> {
        let weights = DVector::from_iterator(
            self.heard.len(),
            self.heard.iter().map(|own| 1.0 / own.variance),
        );
        let sum = weights.sum();
        DMatrix::from_diagonal(&weights) - &weights * weights.transpose() / sum
    }

    /// Weighed squares of what is left of differences against the first antenna.
    pub(super) fn squares(&self, left: &DVector<f64>) -> f64 {
        let full = of_antennas(left);
        full.dot(&(self.weight() * &full))
    }

    /// From phases to differences against the first antenna.
    pub(super) fn against_first(&self) -> DMatrix<f64> {
        let count = self.heard.len() - 1;
        DMatrix::from_fn(count, count + 1, |row, column| match column {
            0 => -1.0,
            _ if column == row + 1 => 1.0,
            _ => 0.0,
        })
    }

    /// Covariance of differences against the first antenna, m^2.
    pub(super) fn covariance(&self) -> DMatrix<f64> {
        let first = self.heard[0].variance;
        let count = self.heard.len() - 1;
        DMatrix::from_fn(count, count, |i, j| {
            first + if i == j { self.heard[i + 1].variance } else { 0.0 }
        })
    }
}

/// Of each antenna what differences against the first one leave, nought for that: what all share is of no account.
pub(super) fn of_antennas(left: &DVector<f64>) -> DVector<f64> {
    left.clone().insert_row(0, 0.0)
}
