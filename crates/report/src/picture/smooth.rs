//! Local means of a noisy quantity.

use glam::DVec3;

/// Mean of `values` around each particle, weighted by a Gaussian of width `spacing` cut at twice that.
///
/// The pressure of single particles scatters about the pressure of the flow by as much as the flow's own
/// differences; what a picture should show is the latter. Values that are not finite count for nothing.
pub(super) fn local_mean(position: &[DVec3], values: &[f64], spacing: f64) -> Vec<f64> {
    mean_at(position, position, values, spacing)
}

/// The same mean at the places `at`: NaN where no particle with a value is within two spacings.
pub(crate) fn mean_at(at: &[DVec3], position: &[DVec3], values: &[f64], spacing: f64) -> Vec<f64> {
    let reach = 2.0 * spacing;
    let cell = |x: DVec3| (x / reach).floor().as_i64vec3().to_array();
    let valued = position.iter().zip(values).enumerate().filter(|(_, (x, v))| x.is_finite() && v.is_finite());
    // By cell, and within one by number: a sorted list in which neighbours along the last axis lie together.
    let mut cells: Vec<([i64; 3], usize)> = valued.map(|(i, (x, _))| (cell(*x), i)).collect();
    cells.sort_unstable();
    let mean = |x: &DVec3| {
        let [a, b, c] = cell(*x);
        let (mut sum, mut weight) = (0.0, 0.0);
        for (da, db) in (-1..=1).flat_map(|da| (-1..=1).map(move |db| (da, db))) {
            let first = cells.partition_point(|(at, _)| *at < [a + da, b + db, c - 1]);
            let near = cells[first..].iter().take_while(|(at, _)| *at <= [a + da, b + db, c + 1]);
            for &(_, j) in near {
                let distance = (position[j] - *x).length_squared() / (spacing * spacing);
                if distance < 4.0 {
                    let w = (-distance).exp();
                    sum += w * values[j];
                    weight += w;
                }
            }
        }
        sum / weight
    };
    at.iter().map(|x| if x.is_finite() { mean(x) } else { f64::NAN }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lattice() -> Vec<DVec3> {
        (0..1000).map(|k| DVec3::new((k % 10) as f64, (k / 10 % 10) as f64, (k / 100) as f64) - 4.5).collect()
    }

    #[test]
    fn a_linear_field_is_kept_and_scatter_shrinks() {
        let position = lattice();
        let linear: Vec<f64> = position.iter().map(|x| 3.0 * x.x - x.z + 7.0).collect();
        let smooth = local_mean(&position, &linear, 1.0);
        for (x, (a, b)) in position.iter().zip(smooth.iter().zip(&linear)) {
            if x.abs().max_element() < 3.0 {
                assert!((a - b).abs() < 1e-12, "{x}: {a} for {b}");
            }
        }
        let noise: Vec<f64> =
            (0..1000).map(|k: u64| if (k * 7919 / 13).is_multiple_of(2) { 1.0 } else { -1.0 }).collect();
        let power = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>() / v.len() as f64;
        assert!(power(&local_mean(&position, &noise, 1.0)) < 0.25 * power(&noise));
    }

    #[test]
    fn one_bad_value_does_not_spread() {
        let position = lattice();
        let mut values = vec![2.0; 1000];
        values[555] = f64::NAN;
        let smooth = local_mean(&position, &values, 1.0);
        assert!(smooth.iter().all(|x| (x - 2.0).abs() < 1e-12));
        // Between the particles it is the same, far from them there is none.
        let between = mean_at(&[DVec3::splat(0.3), DVec3::splat(99.0)], &position, &values, 1.0);
        assert!((between[0] - 2.0).abs() < 1e-12 && between[1].is_nan());
        // Alone with a bad value there is nothing to average.
        assert!(local_mean(&[DVec3::ZERO], &[f64::NAN], 1.0)[0].is_nan());
    }
}
