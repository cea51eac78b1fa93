//! Integrals by the rule of Gauss and Kronrod with 7 and 15 points, halved where it is not yet sure (2.5.8.3, F.2.6.1).

/// Points of the rule right of the middle on -1 to 1, outermost first: abscissa, weight among 15, weight among 7.
const POINTS: [(f64, f64, f64); 7] = [
    (0.991_455_371_120_812_6, 0.022_935_322_010_529_224, 0.0),
    (0.949_107_912_342_758_5, 0.063_092_092_629_978_56, 0.129_484_966_168_869_7),
    (0.864_864_423_359_769_1, 0.104_790_010_322_250_19, 0.0),
    (0.741_531_185_599_394_5, 0.140_653_259_715_525_92, 0.279_705_391_489_276_64),
    (0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0),
    (0.405_845_151_377_397_2, 0.190_350_578_064_785_4, 0.381_830_050_505_118_9),
    (0.207_784_955_007_898_47, 0.204_432_940_075_298_9, 0.0),
];
/// Weights of the middle.
const MIDDLE: (f64, f64) = (0.209_482_141_084_727_82, 0.417_959_183_673_469_4);
/// How often an interval is halved at most: a step in the density ends there.
const HALVINGS: u32 = 16;

/// Integral over an interval. Each part of it is taken once both rules agree within `tolerance`, relative or in the
/// integral's unit.
pub(super) fn integral(f: &impl Fn(f64) -> f64, interval: [f64; 2], tolerance: f64) -> f64 {
    halved(f, interval, tolerance, HALVINGS)
}

fn halved(f: &impl Fn(f64) -> f64, [from, to]: [f64; 2], tolerance: f64, halvings: u32) -> f64 {
    let (fine, coarse) = both_rules(f, [from, to]);
    let error = (fine - coarse).abs();
    if error > tolerance * fine.abs().max(1.0) && halvings > 0 {
        let middle = 0.5 * (from + to);
        let half = |interval| halved(f, interval, tolerance, halvings - 1);
        half([from, middle]) + half([middle, to])
    } else {
        fine
    }
}

/// The integral by 15 points and by 7.
fn both_rules(f: &impl Fn(f64) -> f64, [from, to]: [f64; 2]) -> (f64, f64) {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let here = f(middle);
    let mut sums = (MIDDLE.0 * here, MIDDLE.1 * here);
    for (x, fine, coarse) in POINTS {
        let pair = f(middle - x * half) + f(middle + x * half);
        sums.0 += fine * pair;
        sums.1 += coarse * pair;
    }
    (half * sums.0, half * sums.1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    #[test]
    fn fifteen_points_integrate_a_polynomial_of_degree_22_and_seven_one_of_13() {
        let (fine, coarse) = both_rules(&|x: f64| x.powi(13) + x.powi(12), [-1.0, 2.0]);
        let exact = (2.0_f64.powi(14) - 1.0) / 14.0 + (2.0_f64.powi(13) + 1.0) / 13.0;
        assert!((fine - exact).abs() < 1e-9 && (coarse - exact).abs() < 1e-9);
        let (fine, coarse) = both_rules(&|x: f64| x.powi(22), [-1.0, 1.0]);
        assert!((fine - 2.0 / 23.0).abs() < 1e-14);
        assert!((coarse - 2.0 / 23.0).abs() > 1e-9);
    }

    #[test]
    fn a_thin_layer_is_found_and_a_step_does_not_hold_for_ever() {
        let layer = integral(&|x: f64| (-((x - 300.0) / 10.0).powi(2)).exp(), [0.0, 1000.0], 1e-3);
        assert!((layer - 10.0 * std::f64::consts::PI.sqrt()).abs() < 1e-2, "{layer}");
        let calls = Cell::new(0);
        let step = |x: f64| {
            calls.set(calls.get() + 1);
            if x > 0.3 { 1e9 } else { 0.0 }
        };
        let found = integral(&step, [0.0, 1.0], 1e-3);
        assert!((found - 0.7e9).abs() < 1e4, "{found}");
        assert!(calls.get() <= 15 * (2 * 16 + 1));
    }

    #[test]
    fn an_integral_of_nan_is_nan_at_once() {
        let calls = Cell::new(0);
        let nan = |_: f64| {
            calls.set(calls.get() + 1);
            f64::NAN
        };
        assert!(integral(&nan, [0.0, 1.0], 1e-3).is_nan());
        assert_eq!(calls.get(), 15);
    }
}
