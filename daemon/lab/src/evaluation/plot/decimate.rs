//! Fewer points for the same picture.

/// Points in one panel.
const BUCKETS: usize = 700;

/// A curve with at most two points for each of the buckets of time: the lowest and the highest, so
/// that no peak is lost.
pub(super) fn extremes(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    if points.len() <= 2 * BUCKETS {
        return points.to_vec();
    }
    let mut kept = Vec::with_capacity(2 * BUCKETS);
    for bucket in points.chunks(points.len().div_ceil(BUCKETS)) {
        let by_value = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let (Some(low), Some(high)) =
            (bucket.iter().min_by(by_value), bucket.iter().max_by(by_value))
        else {
            continue;
        };
        let (first, second) = if low.0 <= high.0 { (low, high) } else { (high, low) };
        kept.push(*first);
        if second != first {
            kept.push(*second);
        }
    }
    kept
}

/// Every n-th point, so that at most `count` are left.
pub(super) fn thinned<T: Copy>(points: &[T], count: usize) -> Vec<T> {
    points.iter().step_by(points.len().div_ceil(count).max(1)).copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_single_peak_survives() {
        let mut points: Vec<(f64, f64)> = (0..100_000).map(|i| (f64::from(i), 0.0)).collect();
        points[54_321].1 = 9.0;
        let kept = extremes(&points);
        assert!(kept.len() <= 2 * BUCKETS);
        assert!(kept.contains(&(54_321.0, 9.0)));
        assert!(kept.is_sorted_by_key(|point| point.0));
    }
}
