//! Plane polygons: area, centroid, axes, distance. Vertices run counter-clockwise.

/// A point of the plane.
pub(crate) type Point = [f64; 2];

pub(crate) fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

pub(crate) fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub(crate) fn dot(a: Point, b: Point) -> f64 {
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
}
