//! The cut along the middle of a vessel.

use glam::DVec3;
use std::collections::BTreeMap;

/// Particles behind the middle of what the eye meets first, in order of index.
///
/// Each line of sight meets the vessel in one or more runs of particles (limbs that overlap in the picture
/// are runs apart from each other). The middle of the nearest run is averaged with that of its neighbours,
/// and what lies before it is left out. `seen` and `spacing` are in pixels, z pointing to the eye.
pub(super) fn behind_the_middle(seen: &[DVec3], spacing: f64) -> Vec<usize> {
    let cell = 1.5 * spacing;
    let column = |x: &DVec3| ((x.x / cell).floor() as i64, (x.y / cell).floor() as i64);
    let mut columns: BTreeMap<(i64, i64), Vec<f64>> = BTreeMap::new();
    for x in seen.iter().filter(|x| x.is_finite()) {
        columns.entry(column(x)).or_default().push(x.z);
    }
    // (farthest, nearest) depth of the nearest run of each column.
    let runs: BTreeMap<(i64, i64), (f64, f64)> = columns
        .into_iter()
        .map(|(place, mut depths)| {
            depths.sort_by(|a, b| b.total_cmp(a));
            let end = depths.windows(2).position(|pair| pair[0] - pair[1] > 2.5 * spacing);
            (place, (depths[end.unwrap_or(depths.len() - 1)], depths[0]))
        })
        .collect();
    let middle = |(i, j): (i64, i64)| {
        let own = runs[&(i, j)];
        let (mut sum, mut weight) = (0.0, 0.0);
        for place in (-2..=2).flat_map(|di| (-2..=2).map(move |dj| (i + di, j + dj))) {
            // A neighbour counts when it is the same limb, by its length: short runs at the rim say little.
            if let Some(&(far, near)) = runs.get(&place)
                && far <= own.1
                && near >= own.0
            {
                let length = near - far + spacing;
                sum += length * 0.5 * (near + far);
                weight += length;
            }
        }
        sum / weight
    };
    let middles: BTreeMap<(i64, i64), f64> = runs.keys().map(|&place| (place, middle(place))).collect();
    (0..seen.len())
        .filter(|&i| seen[i].is_finite() && seen[i].z <= middles[&column(&seen[i])] + 0.25 * spacing)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A lattice in a tube along x of radius `r` around (y, z).
    fn tube(r: i32, y: f64, z: f64) -> Vec<DVec3> {
        let mut points = Vec::new();
        for i in 0..60 {
            for (j, k) in (-r..=r).flat_map(|j| (-r..=r).map(move |k| (j, k))) {
                if j * j + k * k <= r * r {
                    points.push(DVec3::new(f64::from(i), y + f64::from(j), z + f64::from(k)));
                }
            }
        }
        points
    }

    #[test]
    fn half_of_a_tube_is_left_and_it_is_the_far_half() {
        let points = tube(10, 0.0, 50.0);
        let left = behind_the_middle(&points, 1.0);
        let share = left.len() as f64 / points.len() as f64;
        assert!((0.48..0.58).contains(&share), "{share}");
        assert!(left.iter().all(|&i| points[i].z < 51.5));
        assert!(left.windows(2).all(|pair| pair[0] < pair[1]));
    }

    #[test]
    fn a_limb_behind_another_stays_whole() {
        let mut points = tube(6, 0.0, 0.0);
        let front = points.len();
        points.extend(tube(6, 0.0, 40.0));
        let left = behind_the_middle(&points, 1.0);
        let (back, rest): (Vec<usize>, Vec<usize>) = left.into_iter().partition(|&i| i < front);
        assert_eq!(back.len(), front);
        assert!(rest.len() < (points.len() - front) * 6 / 10 && !rest.is_empty());
    }
}
