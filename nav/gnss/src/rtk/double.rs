//! Double differences: each satellite against the reference of its group, as rows for whoever knows a position beforehand.

use insd_base::SatelliteId;
use nalgebra::{DMatrix, DVector, Vector3};

use super::difference::Difference;
use super::pairing::{Group, SignalPair};

/// An ambiguity: one pair of signals against its reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct PairAmbiguity {
    /// The satellite's.
    pub pair: SignalPair,
    /// The reference satellite of its group, which is tracked by the same signals.
    pub reference: SatelliteId,
}

impl PairAmbiguity {
    /// The reference as it is tracked.
    pub(super) fn reference(&self) -> SignalPair {
        SignalPair { satellite: self.reference, ..self.pair }
    }
}

/// What a row is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Code,
    /// With the place of its ambiguity.
    Phase(usize),
}

/// One row: a single difference less that of its reference.
#[derive(Clone, Copy, Debug)]
struct Row {
    of: usize,
    less: usize,
    kind: Kind,
}

/// The double differences of an epoch: codes first.
#[derive(Clone, Debug)]
pub struct DoubleDifferences {
    pub(super) singles: Vec<Difference>,
    rows: Vec<Row>,
    codes: usize,
    ambiguities: Vec<PairAmbiguity>,
    /// Whole cycles of each ambiguity by its codes, cycles: near enough that nothing is lost by taking them off.
    whole: DVector<f64>,
}

/// Double differences around a position, linear in what it and the ambiguities are off by:
/// `residual = direction . (true - assumed position) + wavelength (true - assumed ambiguity) + error`.
#[derive(Clone, Debug, PartialEq)]
pub struct DifferencedRows {
    /// Measured less computed, m.
    pub residuals: DVector<f64>,
    /// A row of three for each: how it changes with the antenna's place, ECEF axes.
    pub directions: DMatrix<f64>,
    /// Of rows of phase the place of the ambiguity and its wavelength, m.
    pub ambiguities: Vec<Option<(usize, f64)>>,
    /// Covariance of their errors, m^2: what rows share through references, ionosphere, troposphere and a base that is late is in it.
    pub covariance: DMatrix<f64>,
}

impl DoubleDifferences {
    /// Of each group the phase of least variance is the reference.
    pub(super) fn new(singles: Vec<Difference>) -> Self {
        let mut groups: Vec<(Group, usize)> = Vec::new();
        for (index, single) in singles.iter().enumerate() {
            let group = single.pair.group();
            let better = |known: usize| {
                let other = &singles[known];
                let rank = |one: &Difference| (one.phase.is_none(), one.phase_variance);
                rank(single) < rank(other)
            };
            match groups.iter_mut().find(|(known, _)| *known == group) {
                Some((_, known)) if better(*known) => *known = index,
                Some(_) => {}
                None => groups.push((group, index)),
            }
        }
        let (mut codes, mut phases, mut ambiguities) = (Vec::new(), Vec::new(), Vec::new());
        for (of, single) in singles.iter().enumerate() {
            let reference = groups.iter().find(|(group, _)| *group == single.pair.group());
            let Some(&(_, less)) = reference.filter(|(_, less)| *less != of) else { continue };
            codes.push(Row { of, less, kind: Kind::Code });
            if single.phase.is_some() && singles[less].phase.is_some() {
                phases.push(Row { of, less, kind: Kind::Phase(ambiguities.len()) });
                let reference = singles[less].pair.satellite;
                ambiguities.push(PairAmbiguity { pair: single.pair, reference });
            }
        }
        let whole = phases.iter().map(|row: &Row| {
            let (own, other) = (&singles[row.of], &singles[row.less]);
            let apart = |one: &Difference| one.phase.map_or(0.0, |phase| phase - one.code);
            ((apart(own) - apart(other)) / own.wavelength).round()
        });
        let whole = DVector::from_iterator(phases.len(), whole);
        let count = codes.len();
        codes.extend(phases);
        Self { singles, rows: codes, codes: count, ambiguities, whole }
    }

    /// Whole cycles of each ambiguity as the codes have them, to some cycles: where to begin.
    #[must_use]
    pub fn whole_cycles(&self) -> &DVector<f64> {
        &self.whole
    }

    /// Which ambiguities there are.
    #[must_use]
    pub fn ambiguities(&self) -> &[PairAmbiguity] {
        &self.ambiguities
    }

    /// Rows around a position, ECEF, m, with each ambiguity assumed, cycles.
    #[must_use]
    pub fn rows(&self, position: &Vector3<f64>, ambiguities: &DVector<f64>) -> DifferencedRows {
        let rows = &self.rows;
        let mut directions = DMatrix::zeros(rows.len(), 3);
        let mut residuals = DVector::zeros(rows.len());
        let mut places = Vec::with_capacity(rows.len());
        let ranges: Vec<_> = self.singles.iter().map(|single| single.seen_from(position)).collect();
        for (place, row) in rows.iter().enumerate() {
            let (own, reference) = (&self.singles[row.of], &self.singles[row.less]);
            let ((range, gradient), (other, to_other)) = (ranges[row.of], ranges[row.less]);
            directions.row_mut(place).copy_from(&(gradient - to_other).transpose());
            let (measured, assumed) = match row.kind {
                Kind::Code => (own.code - reference.code, 0.0),
                Kind::Phase(index) => {
                    let phases = own.phase.zip(reference.phase);
                    let measured = phases.map_or(0.0, |(own, other)| own - other);
                    (measured, own.wavelength * ambiguities[index])
                }
            };
            residuals[place] = measured - (range - other) - assumed;
            places.push(match row.kind {
                Kind::Code => None,
                Kind::Phase(index) => Some((index, own.wavelength)),
            });
        }
        let covariance =
            DMatrix::from_fn(rows.len(), rows.len(), |i, j| self.covariance(&rows[i], &rows[j]));
        DifferencedRows { residuals, directions, ambiguities: places, covariance }
    }

    /// Rows of code come first; so many.
    pub(super) fn codes(&self) -> usize {
        self.codes
    }

    /// The single difference of an ambiguity, and that of its reference.
    pub(super) fn singles_of(&self, ambiguity: usize) -> (usize, usize) {
        let row = &self.rows[self.codes + ambiguity];
        (row.of, row.less)
    }

    /// Rows of code that a single difference is in, with their signs.
    pub(super) fn codes_with(&self, single: usize) -> DVector<f64> {
        DVector::from_fn(self.codes, |place, _| {
            let row = &self.rows[place];
            f64::from(u8::from(row.of == single)) - f64::from(u8::from(row.less == single))
        })
    }

    /// Rows of phase that a single difference is in, with their signs.
    pub(super) fn phases_with(&self, single: usize) -> DVector<f64> {
        DVector::from_fn(self.rows.len(), |place, _| {
            let row = &self.rows[place];
            let is_phase = row.kind != Kind::Code;
            f64::from(u8::from(is_phase && row.of == single))
                - f64::from(u8::from(is_phase && row.less == single))
        })
    }

    fn covariance(&self, one: &Row, two: &Row) -> f64 {
        let of = |a: usize, b: usize| self.of_singles((a, one.kind), (b, two.kind));
        of(one.of, two.of) - of(one.of, two.less) - of(one.less, two.of) + of(one.less, two.less)
    }

    /// Covariance of two single differences: noise of its own, and what a satellite's signals share.
    fn of_singles(&self, one: (usize, Kind), two: (usize, Kind)) -> f64 {
        let (a, b) = (&self.singles[one.0], &self.singles[two.0]);
        if a.pair.satellite != b.pair.satellite {
            return 0.0;
        }
        let is_code = |kind: Kind| kind == Kind::Code;
        let alike = is_code(one.1) == is_code(two.1);
        let bent = a.ionosphere * a.dispersion * b.dispersion;
        let shared = a.shared + if alike { bent } else { -bent };
        match (one.0 == two.0 && alike, is_code(one.1)) {
            (true, true) => shared + a.code_variance,
            (true, false) => shared + a.phase_variance,
            _ => shared,
        }
    }
}

impl Difference {
    /// Range to a place, and how it changes with it.
    fn seen_from(&self, position: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let transmitter = self.sight.transmitter();
        (transmitter.range(position), transmitter.gradient(position))
    }
}
