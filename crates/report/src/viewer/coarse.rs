//! A surface with fewer points, by clusters: one point stands for all in a cell of space.

use glam::DVec3;

/// Points kept and the triangles between them, as places in the list of those kept.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Coarse {
    /// Numbers of the points kept, ascending.
    pub(super) kept: Vec<usize>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// The surface with at most `most` points, which must be above 0: all of them where they are that few. Points are kept, not moved, so that each keeps
/// its values in every frame.
///
/// Points whose position is not finite go, with their triangles. (Clusters: Rossignac and Borrel 1993.)
pub(super) fn coarse(position: &[DVec3], triangles: &[[u32; 3]], most: usize) -> Coarse {
    let finite: Vec<usize> = (0..position.len()).filter(|&i| position[i].is_finite()).collect();
    let mut owner: Vec<Option<usize>> = vec![None; position.len()];
    if finite.len() <= most {
        finite.iter().for_each(|&i| owner[i] = Some(i));
        return renumbered(&owner, finite, triangles);
    }
    let area = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| position[v as usize]);
        0.5 * (b - a).cross(c - a).length()
    };
    let total: f64 = triangles.iter().map(area).filter(|a| a.is_finite()).sum();
    let extent = finite.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), &i| {
        (low.min(position[i]), high.max(position[i]))
    });
    let size = (extent.1 - extent.0).max_element();
    // Cells of the area that falls to a point; at least a part of the whole that ends the growth soon.
    let mut cell = (total / most as f64).sqrt().max(1e-5 * size).max(f64::MIN_POSITIVE);
    loop {
        let groups = clusters(position, &finite, extent.0, cell);
        if groups.len() <= most {
            let mut kept = Vec::with_capacity(groups.len());
            for group in groups {
                let mean = group.iter().map(|&i| position[i]).sum::<DVec3>() / group.len() as f64;
                let distance = |i: &usize| position[*i].distance_squared(mean);
                let near = group.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b)));
                if let Some(near) = near {
                    group.iter().for_each(|&i| owner[i] = Some(near));
                    kept.push(near);
                }
            }
            kept.sort_unstable();
            return renumbered(&owner, kept, triangles);
        }
        cell *= 1.1;
    }
}

/// Points by cells, each group in order of number.
fn clusters(position: &[DVec3], points: &[usize], origin: DVec3, cell: f64) -> Vec<Vec<usize>> {
    let mut placed: Vec<([i64; 3], usize)> = points
        .iter()
        .map(|&i| (((position[i] - origin) / cell).floor().as_i64vec3().to_array(), i))
        .collect();
    placed.sort_unstable();
    placed.chunk_by(|a, b| a.0 == b.0).map(|group| group.iter().map(|p| p.1).collect()).collect()
}

/// Triangles between the owners of their corners, each once and none without area.
fn renumbered(owner: &[Option<usize>], kept: Vec<usize>, triangles: &[[u32; 3]]) -> Coarse {
    let place = |i: u32| owner[i as usize].and_then(|i| kept.binary_search(&i).ok()).map(|k| k as u32);
    let mut seen: Vec<([u32; 3], usize)> = Vec::with_capacity(triangles.len());
    for (order, &[a, b, c]) in triangles.iter().enumerate() {
        let (Some(a), Some(b), Some(c)) = (place(a), place(b), place(c)) else { continue };
        if a == b || b == c || c == a {
            continue;
        }
        // The smallest first, the sense of turning kept.
        let turned = if a < b && a < c {
            [a, b, c]
        } else if b < c {
            [b, c, a]
        } else {
            [c, a, b]
        };
        seen.push((turned, order));
    }
    seen.sort_unstable();
    seen.dedup_by_key(|t| t.0);
    seen.sort_unstable_by_key(|t| t.1);
    Coarse { kept, triangles: seen.into_iter().map(|t| t.0).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// A tube of length 10 and radius 1.
    fn tube(around: u32, along: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let points = (0..along * around).map(|k| {
            let (sin, cos) = (TAU * f64::from(k % around) / f64::from(around)).sin_cos();
            DVec3::new(cos, sin, 10.0 * f64::from(k / around) / f64::from(along - 1))
        });
        let at = |k: u32, j: u32| k * around + j % around;
        let quads = (0..along - 1).flat_map(|k| (0..around).map(move |j| (k, j)));
        let triangles = quads.flat_map(|(k, j)| {
            [[at(k, j), at(k, j + 1), at(k + 1, j)], [at(k, j + 1), at(k + 1, j + 1), at(k + 1, j)]]
        });
        (points.collect(), triangles.collect())
    }

    fn area(position: &[DVec3], coarse: &Coarse) -> f64 {
        let corner = |v: u32| position[coarse.kept[v as usize]];
        coarse
            .triangles
            .iter()
            .map(|&[a, b, c]| 0.5 * (corner(b) - corner(a)).cross(corner(c) - corner(a)).length())
            .sum()
    }

    #[test]
    fn few_points_stay_as_they_are() {
        let (position, triangles) = tube(8, 3);
        let same = coarse(&position, &triangles, 24);
        assert_eq!(same.kept, (0..24).collect::<Vec<_>>());
        assert_eq!(same.triangles.len(), triangles.len());
    }

    #[test]
    fn a_tube_keeps_its_shape_and_the_limit() {
        let (position, triangles) = tube(200, 300);
        let fewer = coarse(&position, &triangles, 6000);
        assert!((3000..=6000).contains(&fewer.kept.len()), "{}", fewer.kept.len());
        assert!(fewer.triangles.iter().flatten().all(|&v| (v as usize) < fewer.kept.len()));
        let found = area(&position, &fewer);
        assert!((found / (10.0 * TAU) - 1.0).abs() < 0.05, "{found}");
        // The sense of turning survives: normals point outwards.
        let outward = |t: &&[u32; 3]| {
            let [a, b, c] = t.map(|v| position[fewer.kept[v as usize]]);
            let radial = (a + b + c) * DVec3::new(1.0, 1.0, 0.0);
            (b - a).cross(c - a).dot(radial) > 0.0
        };
        let right = fewer.triangles.iter().filter(outward).count();
        assert!(right as f64 > 0.98 * fewer.triangles.len() as f64, "{right} of {}", fewer.triangles.len());
    }

    #[test]
    fn points_that_are_nowhere_go_with_their_triangles() {
        let (mut position, triangles) = tube(8, 3);
        position[9] = DVec3::NAN;
        let rest = coarse(&position, &triangles, 24);
        assert_eq!(rest.kept.len(), 23);
        assert_eq!(rest.triangles.len(), triangles.iter().filter(|t| !t.contains(&9)).count());
        let one = coarse(&[DVec3::ONE; 50], &[[0, 1, 2]], 10);
        assert_eq!((one.kept.len(), one.triangles.len()), (1, 0));
    }
}
