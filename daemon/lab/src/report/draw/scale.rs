//! The upright axis of a chart.

/// How values are laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Evenly.
    Linear,
    /// By their logarithm; only positive ones are shown.
    Logarithmic,
    /// A direction, deg, that goes on beyond 360 and below 0.
    Bearing,
}

/// Values from bottom to top, with their marks.
#[derive(Clone, Debug)]
pub(crate) struct Scale {
    kind: Kind,
    least: f64,
    greatest: f64,
    marks: Vec<f64>,
    decimals: usize,
}

/// Marks aimed at.
const MARKS: f64 = 5.0;
/// A direction that moves by more than this is shown from 0 to 360.
const CIRCLE: f64 = 180.0;
/// Spacings of marks of a direction, deg.
const BEARINGS: [f64; 7] = [1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0];
/// Ratio of greatest to least over which only powers of ten are marked.
const WIDE: f64 = 200.0;
/// Least ratio and least span shown, so that noise of no meaning does not fill a chart.
const RATIO: f64 = 5.0;

impl Scale {
    /// For values from `least` to `greatest`; not less than `span` of them is shown.
    pub(crate) fn new(kind: Kind, least: f64, greatest: f64, span: f64) -> Self {
        match kind {
            Kind::Logarithmic => Self::logarithmic(least, greatest),
            Kind::Bearing if greatest - least > CIRCLE => {
                let marks = (0..=4).map(|quarter| f64::from(quarter) * 90.0).collect();
                Scale { kind, least: 0.0, greatest: 360.0, marks, decimals: 0 }
            }
            Kind::Linear | Kind::Bearing => Self::linear(kind, least, greatest, span),
        }
    }

    fn linear(kind: Kind, least: f64, greatest: f64, span: f64) -> Self {
        let missing = (span - (greatest - least)).max(0.0) / 2.0;
        let (least, greatest) = (least - missing, greatest + missing);
        let aim = (greatest - least) / MARKS;
        let bearing = BEARINGS.into_iter().find(|step| kind == Kind::Bearing && *step >= aim);
        let step = bearing.filter(|step| aim > 0.5 * step).unwrap_or_else(|| round_step(aim));
        let (first, last) = ((least / step).floor(), (greatest / step).ceil());
        let marks = (0..=(last - first) as u32).map(|index| (first + f64::from(index)) * step);
        let decimals = (-step.log10().floor()).clamp(0.0, 9.0) as usize;
        let (least, greatest) = (first * step, last * step);
        Scale { kind, least, greatest, marks: marks.collect(), decimals }
    }

    fn logarithmic(least: f64, greatest: f64) -> Self {
        let middle = (least * greatest).sqrt();
        let (least, greatest) =
            (least.min(middle / RATIO.sqrt()), greatest.max(middle * RATIO.sqrt()));
        let is_wide = greatest / least > WIDE;
        let digits: &[f64] = if is_wide { &[1.0] } else { &[1.0, 2.0, 5.0] };
        let exponents = least.log10().floor() as i32 - 1..=greatest.log10().ceil() as i32 + 1;
        let all: Vec<f64> =
            exponents.flat_map(|own| digits.iter().map(move |digit| digit * power(own))).collect();
        let first = all.iter().rposition(|mark| *mark <= least * 1.001).unwrap_or(0);
        let last = all.iter().position(|mark| *mark >= greatest * 0.999).unwrap_or(all.len());
        let marks: Vec<f64> = all.into_iter().take(last + 1).skip(first).collect();
        let ends = marks.first().copied().zip(marks.last().copied());
        let (least, greatest) = ends.unwrap_or((least, greatest));
        Scale { kind: Kind::Logarithmic, least, greatest, marks, decimals: 0 }
    }

    /// How far up a value is, 0 to 1 within the chart; `None` of what cannot be shown.
    pub(crate) fn share(&self, value: f64) -> Option<f64> {
        let share = match self.kind {
            Kind::Logarithmic if value <= 0.0 => return None,
            Kind::Logarithmic => (value / self.least).ln() / (self.greatest / self.least).ln(),
            _ => (value - self.least) / (self.greatest - self.least),
        };
        Some(share).filter(|share| share.is_finite())
    }

    /// Whole circles to take off a direction.
    pub(crate) fn circles(&self, value: f64) -> f64 {
        let is_folded = self.kind == Kind::Bearing && self.greatest - self.least >= 360.0;
        if is_folded { (value / 360.0).floor() } else { 0.0 }
    }

    /// Each mark with its label.
    pub(crate) fn marks(&self) -> impl Iterator<Item = (f64, String)> + '_ {
        self.marks.iter().map(|mark| (*mark, self.label(*mark)))
    }

    fn label(&self, mark: f64) -> String {
        let decimals = self.decimals;
        match self.kind {
            Kind::Bearing if self.circles(mark) > 0.0 => "360".to_owned(),
            Kind::Bearing if decimals == 0 => format!("{:03.0}", mark.rem_euclid(360.0)),
            Kind::Bearing => format!("{:.decimals$}", mark.rem_euclid(360.0)),
            Kind::Logarithmic => {
                format!("{mark:.*}", (-mark.log10().floor()).clamp(0.0, 9.0) as usize)
            }
            Kind::Linear => format!("{:.decimals$}", mark + 0.0).replace('-', "−"),
        }
    }
}

fn power(exponent: i32) -> f64 {
    10_f64.powi(exponent)
}

/// The next larger of 1, 2, 5 times a power of ten.
pub(crate) fn round_step(least: f64) -> f64 {
    let least = least.max(1e-9);
    let base = power(least.log10().floor() as i32);
    let steps = [1.0, 2.0, 5.0, 10.0].map(|digit| digit * base);
    steps.into_iter().find(|step| *step >= least * 0.999).unwrap_or(10.0 * base)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(scale: &Scale) -> Vec<String> {
        scale.marks().map(|(_, label)| label).collect()
    }

    #[test]
    fn marks_are_round_and_hold_all_values() {
        let scale = Scale::new(Kind::Linear, -2.3, 4.1, 0.1);
        assert_eq!(labels(&scale), ["−4", "−2", "0", "2", "4", "6"]);
        assert!(scale.share(-2.3).unwrap() > 0.0 && scale.share(4.1).unwrap() < 1.0);
        assert_eq!(
            labels(&Scale::new(Kind::Linear, 0.0, 0.0, 0.2)),
            ["−0.10", "−0.05", "0.00", "0.05", "0.10"]
        );
    }

    #[test]
    fn wide_logarithms_have_powers_of_ten_and_narrow_ones_more() {
        assert_eq!(
            labels(&Scale::new(Kind::Logarithmic, 0.013, 90.0, 0.0)),
            ["0.01", "0.1", "1", "10", "100"]
        );
        assert_eq!(
            labels(&Scale::new(Kind::Logarithmic, 0.5, 2.0, 0.0)),
            ["0.2", "0.5", "1", "2", "5"]
        );
        assert_eq!(Scale::new(Kind::Logarithmic, 0.5, 2.0, 0.0).share(0.0), None);
    }

    #[test]
    fn a_heading_about_north_does_not_jump_and_a_full_circle_is_folded() {
        assert_eq!(
            labels(&Scale::new(Kind::Bearing, 350.0, 372.0, 1.0))[..3],
            ["350", "355", "000"]
        );
        let circle = Scale::new(Kind::Bearing, -20.0, 800.0, 1.0);
        assert_eq!(labels(&circle), ["000", "090", "180", "270", "360"]);
        assert_eq!((circle.circles(725.0), circle.circles(-1.0)), (2.0, -1.0));
    }
}
