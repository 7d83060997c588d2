//! How many particles each triangle of a surface gets, and where they stand in it.

use glam::DVec3;
use serde::{Deserialize, Serialize};
use vaso_geometry::Surface;

/// How the particles are shared out among triangles; both give exactly the number asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Allotment {
    /// Rounds the area summed up along a space-filling curve. Even also where triangles are much smaller
    /// than the area of a particle.
    #[default]
    Cumulative,
    /// Rounds each share down and gives what is left to the largest remainders, ties to lower numbers.
    LargestRemainder,
}

/// Bits along each axis of the space-filling curve.
const MORTON_BITS: u32 = 21;

/// Numbers of the given triangles in Morton order of their centres, so that successive ones are near.
pub(crate) fn morton_order(surface: &Surface, triangles: &[u32]) -> Vec<u32> {
    let (low, high) = surface.bounds();
    let cells = f64::from(1_u32 << MORTON_BITS);
    let extent = (high - low).max_element().max(f64::MIN_POSITIVE);
    let key = |&t: &u32| {
        let [a, b, c] = surface.triangle(t as usize);
        let place = ((a + b + c) / 3.0 - low) / extent * cells;
        let [x, y, z] = place.to_array().map(|p| (p as u64).min((1 << MORTON_BITS) - 1));
        (0..MORTON_BITS).fold(0_u64, |key, bit| {
            let bits = (x >> bit & 1) | (y >> bit & 1) << 1 | (z >> bit & 1) << 2;
            key | bits << (3 * bit)
        })
    };
    let mut keyed: Vec<(u64, u32)> = triangles.iter().map(|t| (key(t), *t)).collect();
    keyed.sort_unstable();
    keyed.into_iter().map(|(_, t)| t).collect()
}

/// Number of particles for each of `areas` \[m^2\], in their order; they add up to `count`.
pub(crate) fn allot(areas: &[f64], count: usize, allotment: Allotment) -> Vec<usize> {
    match allotment {
        Allotment::Cumulative => cumulative(areas, count),
        Allotment::LargestRemainder => largest_remainder(areas, count),
    }
}

fn cumulative(areas: &[f64], count: usize) -> Vec<usize> {
    let total: f64 = areas.iter().sum();
    let (mut sum, mut given) = (0.0, 0);
    let share = |area: &f64| {
        // Added up in the order of the total, so that the last quotient is one and the last round `count`.
        sum += area;
        let up_to = (count as f64 * (sum / total)).round() as usize;
        let n = up_to - given;
        given = up_to;
        n
    };
    areas.iter().map(share).collect()
}

fn largest_remainder(areas: &[f64], count: usize) -> Vec<usize> {
    let total: f64 = areas.iter().sum();
    let quota: Vec<f64> = areas.iter().map(|area| count as f64 * (area / total)).collect();
    let mut shares: Vec<usize> = quota.iter().map(|q| q.floor() as usize).collect();
    let left = count - shares.iter().sum::<usize>();
    let mut order: Vec<usize> = (0..areas.len()).collect();
    order.sort_by(|&a, &b| quota[b].fract().total_cmp(&quota[a].fract()).then(a.cmp(&b)));
    for &k in order.iter().take(left) {
        shares[k] += 1;
    }
    shares
}

/// Places of the particles of successive triangles, each with the number of its triangle.
///
/// One particle stands in the centre, more follow the R2 sequence folded into the triangle (Roberts, "The
/// unreasonable effectiveness of quasirandom sequences", 2018). The sequence goes on from triangle to
/// triangle: begun anew in each, it would repeat its gaps along a surface of equal triangles, in bands too
/// wide to relax.
pub(crate) fn places<'a>(
    surface: &'a Surface,
    order: &'a [u32],
    shares: &'a [usize],
) -> impl Iterator<Item = (DVec3, u32)> + 'a {
    let mut before = 0;
    order.iter().zip(shares).flat_map(move |(&t, &n)| {
        let corners = surface.triangle(t as usize);
        let first = before;
        before += n;
        (first..first + n)
            .map(move |k| (if n == 1 { corners.iter().sum::<DVec3>() / 3.0 } else { place(corners, k) }, t))
    })
}

/// Point `k` of the R2 sequence in a triangle.
fn place([a, b, c]: [DVec3; 3], k: usize) -> DVec3 {
    /// Inverse and inverse square of the real root of x^3 = x + 1.
    const R2: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_3];
    let [mut u, mut v] = R2.map(|r| (0.5 + k as f64 * r).fract());
    if u + v > 1.0 {
        (u, v) = (1.0 - u, 1.0 - v);
    }
    a + u * (b - a) + v * (c - a)
}

#[cfg(test)]
mod tests {
    use super::*;
    use vaso_geometry::shapes;

    const BOTH: [Allotment; 2] = [Allotment::Cumulative, Allotment::LargestRemainder];

    /// Areas over eight orders of magnitude, most of them far below that of a particle.
    fn uneven(n: usize) -> Vec<f64> {
        (0..n).map(|k| 10_f64.powf(-8.0 * (k as f64 * 0.618_033_988_7).fract())).collect()
    }

    #[test]
    fn shares_add_up_and_follow_the_areas() {
        for areas in [uneven(10_000), vec![1e-9; 7777], vec![3.0], uneven(13)] {
            for count in [1, 2, 97, 12_345] {
                for allotment in BOTH {
                    let shares = allot(&areas, count, allotment);
                    assert_eq!(shares.iter().sum::<usize>(), count, "{allotment:?}");
                    let total: f64 = areas.iter().sum();
                    for (share, area) in shares.iter().zip(&areas) {
                        let off = *share as f64 - count as f64 * area / total;
                        assert!(off.abs() < 1.0 + 1e-9, "{allotment:?}: {off}");
                    }
                }
            }
        }
    }

    /// Triangles of a hundredth of a particle: rounding each by itself would leave none.
    #[test]
    fn tiny_triangles_share_evenly_along_the_curve() {
        let pipe = shapes::pipe(1.0, 8.0, DVec3::Z, 200);
        let walls: Vec<u32> = (0..pipe.triangles.len() as u32)
            .filter(|&t| pipe.triangle_normal(t as usize).z.abs() < 0.5)
            .collect();
        let order = morton_order(&pipe, &walls);
        let areas: Vec<f64> = order.iter().map(|&t| pipe.triangle_area(t as usize)).collect();
        let count = order.len() / 100;
        let shares = allot(&areas, count, Allotment::Cumulative);
        // Eight slices along the pipe hold an eighth each, but for the particles the curve has in flight at
        // the borders of its cubes.
        let mut slices = [0; 8];
        for (&t, share) in order.iter().zip(&shares) {
            let [a, b, c] = pipe.triangle(t as usize);
            slices[((a + b + c).z / 3.0) as usize] += share;
        }
        let expected = count as f64 / 8.0;
        assert!(slices.iter().all(|&n| (n as f64 - expected).abs() < 0.06 * expected + 2.0), "{slices:?}");
    }

    #[test]
    fn points_fill_a_triangle_evenly() {
        let third = DVec3::new(1.0, 1.0, 0.0) / 3.0;
        let surface =
            Surface { vertices: vec![DVec3::ZERO, DVec3::X, DVec3::Y], triangles: vec![[0, 1, 2]; 2] };
        let n = 1000;
        let points: Vec<(DVec3, u32)> = places(&surface, &[1, 0], &[1, n]).collect();
        assert_eq!(points.len(), 1 + n);
        assert!((points[0].0 - third).length() < 1e-15 && points[0].1 == 1);
        let points: Vec<DVec3> = points[1..].iter().map(|(x, _)| *x).collect();
        assert!(points.iter().all(|p| p.x >= 0.0 && p.y >= 0.0 && p.x + p.y <= 1.0));
        let mean = points.iter().sum::<DVec3>() / n as f64;
        // The error of a mean over a sequence of low discrepancy is of the order of log(n)/n.
        assert!((mean - third).length() < 7e-3, "{mean}");
    }
}
