//! Plane polygons: area, centroid, axes, distance, triangulation. Vertices run counter-clockwise.

/// A point of the plane.
pub(crate) type Point = [f64; 2];

fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// The sides of a closed polygon.
pub(crate) fn sides(polygon: &[Point]) -> impl Iterator<Item = (Point, Point)> + '_ {
    let n = polygon.len();
    (0..n).map(move |i| (polygon[i], polygon[(i + 1) % n]))
}

/// Signed area, positive counter-clockwise.
pub(crate) fn area(polygon: &[Point]) -> f64 {
    let Some(&origin) = polygon.first() else { return 0.0 };
    sides(polygon).map(|(a, b)| 0.5 * cross(sub(a, origin), sub(b, origin))).sum()
}

/// Length of the border.
pub(crate) fn perimeter(polygon: &[Point]) -> f64 {
    sides(polygon).map(|(a, b)| sub(b, a)).map(|s| dot(s, s).sqrt()).sum()
}

/// Centre of area; the first vertex when the area is zero.
pub(crate) fn centroid(polygon: &[Point]) -> Point {
    let Some(&origin) = polygon.first() else { return [0.0; 2] };
    let (mut twice_area, mut moment) = (0.0, [0.0; 2]);
    for (a, b) in sides(polygon) {
        let (a, b) = (sub(a, origin), sub(b, origin));
        let w = cross(a, b);
        twice_area += w;
        moment[0] += w * (a[0] + b[0]);
        moment[1] += w * (a[1] + b[1]);
    }
    if twice_area == 0.0 {
        return origin;
    }
    [origin[0] + moment[0] / (3.0 * twice_area), origin[1] + moment[1] / (3.0 * twice_area)]
}

/// Angle from the first axis to the direction in which the area about the origin spreads furthest \[rad\].
pub(crate) fn principal_angle(polygon: &[Point]) -> f64 {
    let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
    for (a, b) in sides(polygon) {
        let w = cross(a, b);
        xx += w * (a[0] * a[0] + a[0] * b[0] + b[0] * b[0]);
        yy += w * (a[1] * a[1] + a[1] * b[1] + b[1] * b[1]);
        xy += 0.5 * w * (a[0] * b[1] + 2.0 * a[0] * a[1] + 2.0 * b[0] * b[1] + b[0] * a[1]);
    }
    0.5 * (2.0 * xy).atan2(xx - yy)
}

/// Distance from `p` to the border, negative inside (even-odd rule).
pub(crate) fn signed_distance(polygon: &[Point], p: Point) -> f64 {
    let mut nearest = f64::INFINITY;
    let mut inside = false;
    for (a, b) in sides(polygon) {
        let (side, from_a) = (sub(b, a), sub(p, a));
        let length_squared = dot(side, side);
        let t = if length_squared > 0.0 { (dot(from_a, side) / length_squared).clamp(0.0, 1.0) } else { 0.0 };
        let gap = [from_a[0] - t * side[0], from_a[1] - t * side[1]];
        nearest = nearest.min(dot(gap, gap));
        if (a[1] > p[1]) != (b[1] > p[1]) && from_a[0] < side[0] * (p[1] - a[1]) / side[1] {
            inside = !inside;
        }
    }
    if inside { -nearest.sqrt() } else { nearest.sqrt() }
}

/// Whether no two sides cross each other.
pub(crate) fn is_simple(polygon: &[Point]) -> bool {
    let n = polygon.len();
    let side_of = |a: Point, b: Point, p: Point| cross(sub(b, a), sub(p, a));
    (0..n).all(|i| {
        let (a, b) = (polygon[i], polygon[(i + 1) % n]);
        (i + 2..n).filter(|j| (j + 1) % n != i).all(|j| {
            let (c, d) = (polygon[j], polygon[(j + 1) % n]);
            let apart =
                side_of(a, b, c) * side_of(a, b, d) > 0.0 || side_of(c, d, a) * side_of(c, d, b) > 0.0;
            // Touching sides (a product of exactly zero) do not cross unless both straddle.
            apart || side_of(a, b, c) * side_of(a, b, d) == 0.0 || side_of(c, d, a) * side_of(c, d, b) == 0.0
        })
    })
}

/// Triangles of a counter-clockwise polygon by ear clipping, the ear with the shortest cut first.
///
/// A simple polygon of `n` vertices gives `n - 2` triangles. Where the polygon crosses itself no ear may be
/// left; then the shortest cut is taken all the same, so that the border is closed in any case.
pub(crate) fn triangulate(polygon: &[Point]) -> Vec<[usize; 3]> {
    let mut left: Vec<usize> = (0..polygon.len()).collect();
    let mut triangles = Vec::with_capacity(polygon.len().saturating_sub(2));
    while left.len() > 3 {
        let n = left.len();
        let corner = |i: usize| [left[(i + n - 1) % n], left[i], left[(i + 1) % n]];
        let turn = |i: usize| {
            let [a, b, c] = corner(i).map(|v| polygon[v]);
            cross(sub(b, a), sub(c, b))
        };
        let cut = |i: usize| {
            let [a, _, c] = corner(i).map(|v| polygon[v]);
            dot(sub(c, a), sub(c, a))
        };
        // Only a vertex with a turn to the right can lie in an ear.
        let reflex: Vec<usize> = (0..n).filter(|&i| turn(i) <= 0.0).map(|i| left[i]).collect();
        let is_ear = |i: usize| turn(i) > 0.0 && !reflex.iter().any(|&v| blocks(polygon, corner(i), v));
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_unstable_by(|&i, &j| cut(i).total_cmp(&cut(j)).then(i.cmp(&j)));
        let best = order.iter().copied().find(|&i| is_ear(i)).unwrap_or(order[0]);
        triangles.push(corner(best));
        left.remove(best);
    }
    if let [a, b, c] = left[..] {
        triangles.push([a, b, c]);
    }
    triangles
}

/// Whether vertex `v` lies in or on the triangle `ear`, its own corners aside.
fn blocks(polygon: &[Point], ear: [usize; 3], v: usize) -> bool {
    let p = polygon[v];
    // A vertex of the same position (a loop that touches itself) does not block either.
    !ear.contains(&v)
        && ear.iter().all(|&e| polygon[e] != p)
        && (0..3).all(|k| {
            let (a, b) = (polygon[ear[k]], polygon[ear[(k + 1) % 3]]);
            cross(sub(b, a), sub(p, a)) >= 0.0
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    const L_SHAPE: [Point; 6] = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];

    #[test]
    fn integrals_of_an_l_shape() {
        assert_eq!(area(&L_SHAPE), 3.0);
        assert_eq!(perimeter(&L_SHAPE), 8.0);
        let [x, y] = centroid(&L_SHAPE);
        assert!((x - 5.0 / 6.0).abs() < 1e-15 && (y - 5.0 / 6.0).abs() < 1e-15);
    }

    #[test]
    fn longer_side_is_the_principal_axis() {
        let (c, s) = (0.8, 0.6);
        let box_3_by_1 = [[-1.5, -0.5], [1.5, -0.5], [1.5, 0.5], [-1.5, 0.5]];
        let turned = box_3_by_1.map(|[x, y]| [c * x - s * y, s * x + c * y]);
        assert!((principal_angle(&turned) - 0.6f64.asin()).abs() < 1e-14);
    }

    #[test]
    fn distance_has_the_sign_of_the_side() {
        assert_eq!(signed_distance(&L_SHAPE, [0.5, 0.5]), -0.5);
        assert_eq!(signed_distance(&L_SHAPE, [1.5, 1.5]), 0.5);
        assert_eq!(signed_distance(&L_SHAPE, [-3.0, -4.0]), 5.0);
    }

    #[test]
    fn a_figure_of_eight_is_not_simple() {
        assert!(is_simple(&L_SHAPE));
        assert!(!is_simple(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]));
    }

    #[test]
    fn ears_tile_the_polygon() {
        let star: Vec<Point> = (0..40)
            .map(|i| {
                let (r, angle) =
                    (if i % 2 == 0 { 1.0 } else { 0.3 }, f64::from(i) * std::f64::consts::TAU / 40.0);
                [r * angle.cos(), r * angle.sin()]
            })
            .collect();
        for polygon in [&L_SHAPE[..], &star] {
            let triangles = triangulate(polygon);
            assert_eq!(triangles.len(), polygon.len() - 2);
            let areas = triangles.iter().map(|t| area(&t.map(|v| polygon[v])));
            assert!(areas.clone().all(|a| a > 0.0));
            assert!((areas.sum::<f64>() - area(polygon)).abs() < 1e-14);
        }
    }
}
