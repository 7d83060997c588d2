//! A smooth curve by points, and frames along it that do not turn about it.

use glam::DVec3;

/// A curve through points.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    point: Vec<DVec3>,
    /// Length from the first point to each \[m\].
    arc: Vec<f64>,
}

/// A right-handed frame at a point of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The point \[m\].
    pub origin: DVec3,
    /// Unit vectors across the curve; `x` cross `y` is the tangent.
    pub x: DVec3,
    /// See `x`.
    pub y: DVec3,
    /// Unit tangent, in the direction of growing length.
    pub tangent: DVec3,
}

impl Curve {
    /// The curve through `point`; points that repeat the one before are left out.
    pub fn new(point: impl IntoIterator<Item = DVec3>) -> Self {
        let mut curve = Self { point: Vec::new(), arc: Vec::new() };
        for p in point {
            let length = curve.point.last().map_or(0.0, |last: &DVec3| last.distance(p));
            if curve.point.is_empty() || length > 0.0 {
                curve.arc.push(curve.length() + length);
                curve.point.push(p);
            }
        }
        curve
    }

    /// The points \[m\].
    pub fn points(&self) -> &[DVec3] {
        &self.point
    }

    /// Length \[m\].
    pub fn length(&self) -> f64 {
        self.arc.last().copied().unwrap_or(0.0)
    }

    /// Number of the stretch that holds `arc`, and how far along it that is, 0 to 1.
    fn locate(&self, arc: f64) -> (usize, f64) {
        let last = self.arc.len().saturating_sub(2);
        let k = self.arc.partition_point(|a| *a <= arc).saturating_sub(1).min(last);
        let part = (arc - self.arc[k]) / (self.arc[k + 1] - self.arc[k]);
        (k, part.clamp(0.0, 1.0))
    }

    /// The point at length `arc` \[m\], by a cubic through neighbouring points (Catmull and Rom 1974); the
    /// ends where `arc` is beyond them.
    pub fn at(&self, arc: f64) -> DVec3 {
        if self.point.len() < 2 {
            return self.point.first().copied().unwrap_or(DVec3::ZERO);
        }
        let (k, u) = self.locate(arc);
        let (a, b) = (self.point[k], self.point[k + 1]);
        let length = self.arc[k + 1] - self.arc[k];
        let (da, db) = (length * self.slope(k), length * self.slope(k + 1));
        let (v, w) = (1.0 - u, u * (1.0 - u));
        v * a + u * b + w * (v * (da - (b - a)) + u * ((b - a) - db))
    }

    /// Derivative by length at a point.
    fn slope(&self, k: usize) -> DVec3 {
        let (low, high) = (k.saturating_sub(1), (k + 1).min(self.point.len() - 1));
        (self.point[high] - self.point[low]) / (self.arc[high] - self.arc[low])
    }

    /// Unit tangent at length `arc` \[m\].
    pub fn tangent(&self, arc: f64) -> DVec3 {
        let step = 1e-3 * self.length();
        (self.at(arc + step) - self.at(arc - step)).normalize_or(DVec3::Z)
    }

    /// The stretch from length `from` to `to` \[m\], cut into at least `pieces` even pieces.
    pub fn stretch(&self, from: f64, to: f64, pieces: usize) -> Self {
        let n = pieces.max(1);
        Self::new((0..=n).map(|k| self.at(from + (to - from) * k as f64 / n as f64)))
    }

    /// The same curve with points about `step` \[m\] apart.
    pub fn resampled(&self, step: f64) -> Self {
        self.stretch(0.0, self.length(), (self.length() / step).ceil() as usize)
    }

    /// The curve run through backwards.
    pub fn reversed(&self) -> Self {
        Self::new(self.point.iter().rev().copied())
    }

    /// The curve with each point moved to the mean of those around it, weighted by a Gaussian of the standard
    /// deviation `width` \[m\] gives for the point; the ends stay.
    ///
    /// A bend of radius r moves inwards by width^2 / (2 r).
    pub fn smoothed(&self, width: impl Fn(DVec3) -> f64) -> Self {
        let (first, last, length) = (self.point[0], self.point[self.point.len() - 1], self.length());
        let mean = |k: usize| {
            let (at, width) = (self.arc[k], width(self.point[k]));
            let reach = 3.0 * width;
            let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
            let mut add = |arc: f64, point: DVec3| {
                let weight = (-0.5 * ((arc - at) / width).powi(2)).exp();
                weights += weight;
                sum += weight * point;
            };
            let around =
                self.arc.partition_point(|a| *a < at - reach)..self.arc.partition_point(|a| *a <= at + reach);
            for m in around {
                add(self.arc[m], self.point[m]);
            }
            // Beyond its ends the curve goes on as its image in them, which leaves the ends where they are.
            for m in 1..self.arc.partition_point(|a| *a <= reach - at) {
                add(-self.arc[m], 2.0 * first - self.point[m]);
            }
            for m in self.arc.partition_point(|a| *a < 2.0 * length - at - reach)..self.arc.len() - 1 {
                add(2.0 * length - self.arc[m], 2.0 * last - self.point[m]);
            }
            sum / weights
        };
        Self::new((0..self.point.len()).map(mean))
    }

    /// Frames at the points, turning about the curve as little as possible: double reflection (Wang,
    /// Juettler, Zheng, Liu 2008). The first has its `y` nearest to `y`.
    pub fn frames(&self, y: DVec3) -> Vec<Frame> {
        let mut frames: Vec<Frame> = Vec::with_capacity(self.point.len());
        for (k, &origin) in self.point.iter().enumerate() {
            let tangent = self.tangent(self.arc[k]);
            let guide = match frames.last() {
                None => y,
                Some(last) => {
                    let step = origin - last.origin;
                    let (mirrored, turned) = (reflect(last.y, step), reflect(last.tangent, step));
                    reflect(mirrored, tangent - turned)
                }
            };
            let y = guide.reject_from_normalized(tangent).normalize_or(tangent.any_orthonormal_vector());
            frames.push(Frame { origin, x: y.cross(tangent), y, tangent });
        }
        frames
    }
}

/// `v` mirrored at the plane across `axis`.
fn reflect(v: DVec3, axis: DVec3) -> DVec3 {
    let squared = axis.length_squared();
    if squared == 0.0 { v } else { v - 2.0 / squared * v.dot(axis) * axis }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;
    use std::f64::consts::PI;

    fn helix(n: usize) -> Curve {
        Curve::new((0..=n).map(|k| {
            let angle = 2.0 * PI * k as f64 / n as f64;
            DVec3::new(angle.cos(), angle.sin(), 0.5 * angle)
        }))
    }

    #[test]
    fn a_curve_passes_through_its_points_and_between_them_to_third_order() {
        let exact = |angle: f64| DVec3::new(angle.cos(), angle.sin(), 0.5 * angle);
        let error = |n: usize| {
            let curve = helix(n);
            assert!((curve.at(curve.arc[n / 2]) - curve.point[n / 2]).length() < 1e-14);
            let k = n / 3;
            let middle = 0.5 * (curve.arc[k] + curve.arc[k + 1]);
            curve.at(middle).distance(exact(2.0 * PI * (k as f64 + 0.5) / n as f64))
        };
        assert!(error(24) < 1e-3);
        assert!(error(48) < error(24) / 7.0, "{} after {}", error(48), error(24));
    }

    #[test]
    fn smoothing_moves_a_bend_inwards_and_leaves_the_ends() {
        let curve = Curve::new((0..=600).map(|k| DVec2::from_angle(f64::from(k) * PI / 600.0).extend(0.0)));
        let smooth = curve.smoothed(|_| 0.2);
        assert!((smooth.point[300].length() - (1.0 - 0.02)).abs() < 1e-3, "{}", smooth.point[300].length());
        assert!(smooth.point[0].distance(DVec3::X) < 1e-12 && smooth.point[600].distance(-DVec3::X) < 1e-12);
        let line = Curve::new((0..=50).map(|k| f64::from(k) * DVec3::Y));
        for (a, b) in line.smoothed(|_| 4.0).point.iter().zip(&line.point) {
            assert!(a.distance(*b) < 1e-12);
        }
    }

    /// Along a closed turn of a helix a frame that does not turn has turned against the natural one by the
    /// total torsion, 2 pi times pitch over speed.
    #[test]
    fn frames_turn_by_the_total_torsion_only() {
        let curve = helix(400);
        let frames = curve.frames(DVec3::Z);
        let (first, last) = (frames[0], frames[frames.len() - 1]);
        let against = |f: &Frame| {
            let inward = -DVec3::new(f.origin.x, f.origin.y, 0.0).normalize();
            f.y.dot(f.tangent.cross(inward)).atan2(f.y.dot(inward))
        };
        let torsion = 2.0 * PI * 0.5 / 1.25_f64.sqrt();
        let turned = (against(&first) - against(&last)).rem_euclid(2.0 * PI);
        assert!((turned - torsion.rem_euclid(2.0 * PI)).abs() < 2e-2, "{turned} against {torsion}");
        for f in frames {
            assert!((f.x.cross(f.y) - f.tangent).length() < 1e-12);
        }
    }
}
