//! Which of many runs are worth their time.

/// Indices of the points `(time, error)` that no other beats in both, by growing time. Points that are not finite take no part.
pub fn pareto(points: &[(f64, f64)]) -> Vec<usize> {
    let mut order: Vec<usize> =
        (0..points.len()).filter(|&k| points[k].0.is_finite() && points[k].1.is_finite()).collect();
    order.sort_by(|&a, &b| {
        points[a].0.total_cmp(&points[b].0).then(points[a].1.total_cmp(&points[b].1)).then(a.cmp(&b))
    });
    let mut least = f64::INFINITY;
    order.retain(|&k| {
        let better = points[k].1 < least;
        least = least.min(points[k].1);
        better
    });
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_has_what_nothing_beats() {
        let points = [(3.0, 1.0), (1.0, 5.0), (2.0, 5.0), (2.0, 2.0), (9.0, 1.5), (0.5, f64::NAN)];
        assert_eq!(pareto(&points), [1, 3, 0]);
        assert_eq!(pareto(&[]), [0usize; 0]);
    }

    #[test]
    fn equal_points_count_once() {
        assert_eq!(pareto(&[(1.0, 1.0), (1.0, 1.0)]), [0]);
    }
}
