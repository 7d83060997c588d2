//! The faces that bound a body as one point sees them, and what a kernel misses beyond them.

use glam::DVec3;
use vaso_kernels::Wendland;

/// Faces a point can feel at once: wall, outer wall and the caps of one corner.
const CAPACITY: usize = 6;
/// Distance between close-packed layers of particles, in spacings: sqrt(2/3) 2^(1/6). Particles arrange in
/// such layers along a face.
pub(crate) const LAYER: f64 = 0.9165;
/// Clearance beyond which the shape of a face no longer matters, in smoothing lengths: less than a
/// thousandth of the kernel volume lies farther away on that side.
const SHAPE_REACH: f64 = 1.5;
/// Points around the foot of a face at which its shape is asked for: cosine and sine of each.
const RING: [[f64; 2]; 6] = {
    const S: f64 = 0.866_025_403_784_438_6;
    [[1.0, 0.0], [0.5, S], [-0.5, S], [-1.0, 0.0], [-0.5, -S], [0.5, -S]]
};

/// One face of a region, as seen from a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Face {
    /// Distance to the face \[m\], positive on the inner side.
    pub(crate) clearance: f64,
    /// Unit normal out of the region.
    pub(crate) normal: DVec3,
    /// Mean curvature \[1/m\], positive where the region is convex.
    pub(crate) curvature: f64,
}

/// The faces near one point, kept on the stack because they are asked for in the inner loop.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Faces {
    face: [Face; CAPACITY],
    len: usize,
}

impl Faces {
    pub(crate) fn new() -> Self {
        let none = Face { clearance: f64::INFINITY, normal: DVec3::ZERO, curvature: 0.0 };
        Self { face: [none; CAPACITY], len: 0 }
    }

    /// Adds a plane face; beyond six faces the point sits in a corner where more of them change nothing.
    pub(crate) fn push(&mut self, clearance: f64, normal: DVec3) {
        self.add(Face { clearance, normal, curvature: 0.0 });
    }

    /// Adds a face of any shape, as smooth as a kernel of smoothing length `h` \[m\] at `x` \[m\] feels it.
    ///
    /// `height` is the signed distance beyond the face \[m\], `clearance` and `normal` belong to the foot of
    /// `x` on it. On a triangulated surface that normal jumps from one triangle to the next and would push
    /// particles to and fro. What a kernel feels are the moments of the height around the foot: normal and
    /// curvature are those of a ring of radius h, where the weight of both moments is largest.
    pub(crate) fn push_shaped(
        &mut self,
        x: DVec3,
        (clearance, normal): (f64, DVec3),
        h: f64,
        height: impl Fn(DVec3) -> f64,
    ) {
        if clearance > SHAPE_REACH * h || normal == DVec3::ZERO {
            return self.push(clearance, normal);
        }
        let foot = x + clearance * normal;
        let (u, v) = normal.any_orthonormal_pair();
        let (mut mean, mut tilt) = (0.0, DVec3::ZERO);
        for [cos, sin] in RING {
            let outward = cos * u + sin * v;
            // Next to an edge of the region the ring reaches around it.
            let height = height(foot + h * outward).clamp(-0.5 * h, 0.5 * h);
            mean += height / RING.len() as f64;
            tilt += 2.0 / (RING.len() as f64 * h) * height * outward;
        }
        self.add(Face { clearance, normal: (normal + tilt).normalize(), curvature: 2.0 * mean / (h * h) });
    }

    fn add(&mut self, face: Face) {
        if self.len < CAPACITY {
            self.face[self.len] = face;
            self.len += 1;
        }
    }

    pub(crate) fn as_slice(&self) -> &[Face] {
        &self.face[..self.len]
    }

    /// Distance to the nearest face \[m\], negative outside.
    pub(crate) fn clearance(&self) -> f64 {
        self.as_slice().iter().fold(f64::INFINITY, |least, f| least.min(f.clearance))
    }

    /// Kernel gradient summed over what lies beyond the faces \[1/m\], for particles of `spacing` \[m\].
    ///
    /// Every face is a half space filled with layers of particles. Where two meet, the part beyond both must not count twice: the
    /// share of a face is reduced by the kernel volume missing beyond the others, which is exact
    /// for perpendicular faces through the point and for any separable kernel.
    pub(crate) fn missing_gradient(&self, kernel: &Wendland, spacing: f64) -> DVec3 {
        let faces = self.as_slice();
        let mut sum = DVec3::ZERO;
        for (a, face) in faces.iter().enumerate() {
            if face.clearance >= kernel.support() {
                continue;
            }
            let mut share = half_space_gradient(face.clearance, kernel.h)
                + layering_gradient(face.clearance, kernel.h, LAYER * spacing)
                + face.curvature * curvature_gradient(face.clearance, kernel.h);
            for (b, other) in faces.iter().enumerate() {
                if a != b {
                    share *= 1.0 - half_space_volume(other.clearance, kernel.h);
                }
            }
            sum += share * face.normal;
        }
        sum
    }

    /// Moves `x` until it keeps `gap` \[m\] from each face, as far as one pass can.
    pub(crate) fn push_inside(&self, mut x: DVec3, gap: f64) -> DVec3 {
        for face in self.as_slice() {
            if face.clearance < gap {
                x -= (gap - face.clearance) * face.normal;
            }
        }
        x
    }
}

/// Magnitude of the Wendland C2 kernel gradient integrated over the half space beyond a plane at
/// `clearance` \[m\], for smoothing length `h` \[m\]; in \[1/m\].
///
/// Outside the plane the value on the plane is kept: a particle there is pushed back, not sucked out.
fn half_space_gradient(clearance: f64, h: f64) -> f64 {
    let d = (clearance / h).clamp(0.0, 2.0);
    3.0 * (2.0 - d).powi(5) * (4.0 * d * d + 5.0 * d + 2.0) / (256.0 * h)
}

/// What layers of particles at distances `layer` \[m\] push more than the half space they fill evenly \[1/m\].
///
/// The first term of the Euler-Maclaurin formula for the midpoint rule, `layer^2 / 24` times the second
/// derivative of [`half_space_gradient`]. Without it the first layer is pressed against the face, and the
/// particles left over make the rest too dense.
fn layering_gradient(clearance: f64, h: f64, layer: f64) -> f64 {
    let d = (clearance / h).clamp(0.0, 2.0);
    let second = 42.0 / 256.0 * (2.0 - d).powi(3) * (2.0 + 3.0 * d - 12.0 * d * d);
    (layer / h).powi(2) / 24.0 * second / h
}

/// Derivative of the missing kernel gradient by the mean curvature of the face, at `clearance` \[m\]: the
/// kernel gradient integrated over the sliver of thickness `r^2 / 2` between the plane and the curved face,
/// r the distance from the foot. Without unit.
fn curvature_gradient(clearance: f64, h: f64) -> f64 {
    let t = (0.5 * clearance / h).clamp(0.0, 1.0);
    let u = 1.0 - t;
    let moment = 0.25 - 0.6 * u + 0.5 * u * u - u.powi(3) / 7.0 - t * t * (0.25 - 0.2 * u);
    210.0 * t * u.powi(4) * moment
}

/// Share of the Wendland C2 kernel volume beyond a plane at `clearance` \[m\], between 0 and 1/2.
fn half_space_volume(clearance: f64, h: f64) -> f64 {
    let d = (clearance / h).clamp(0.0, 2.0);
    (2.0 - d).powi(6) * (3.0 * d * d + 6.0 * d + 4.0) / 512.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Both integrals by quadrature over slices parallel to the plane.
    #[test]
    fn half_space_forms_are_the_kernel_integrals() {
        let kernel = Wendland::new(1.3e-4);
        let (h, n) = (kernel.h, 4000);
        for clearance in [0.0, 0.3 * h, h, 1.7 * h] {
            let dr = (kernel.support() - clearance) / f64::from(n);
            let (mut gradient, mut volume) = (0.0, 0.0);
            for k in 0..n {
                let r = clearance + (f64::from(k) + 0.5) * dr;
                gradient += 2.0 * PI * r * kernel.value(r) * dr;
                volume += 2.0 * PI * r * (r - clearance) * kernel.value(r) * dr;
            }
            assert!((half_space_gradient(clearance, h) * h - gradient * h).abs() < 1e-6, "at {clearance}");
            assert!((half_space_volume(clearance, h) - volume).abs() < 1e-6, "at {clearance}");
        }
    }

    /// On the edge of two perpendicular faces each plane has lost half of its area.
    #[test]
    fn an_edge_is_not_counted_twice() {
        let kernel = Wendland::new(1.0);
        let mut faces = Faces::new();
        faces.push(0.0, DVec3::X);
        faces.push(0.0, DVec3::Y);
        let g = faces.missing_gradient(&kernel, 1e-9);
        assert!((g - 0.375 * (DVec3::X + DVec3::Y)).length() < 1e-12, "{g}");
    }

    /// Layers of particles beyond a plane, the first of them as far from it as the particle.
    #[test]
    fn layers_push_as_their_sum() {
        for (smoothing, bound) in [(1.0, 0.02), (1.3, 0.01), (2.0, 0.003)] {
            let kernel = Wendland::new(smoothing);
            let n = 4000;
            // Kernel gradient integrated over a plane at distance z.
            let plane = |z: f64| {
                let dr = (kernel.support() - z) / f64::from(n);
                let ring = |r: f64| -2.0 * PI * r * kernel.derivative(r) * z / r * dr;
                (0..n).map(|k| ring(z + (f64::from(k) + 0.5) * dr)).sum::<f64>()
            };
            let planes = (1..).map(|k| f64::from(k) * LAYER).take_while(|z| *z < kernel.support());
            let sum: f64 = planes.map(|z| LAYER * plane(z)).sum();
            let even = half_space_gradient(0.5 * LAYER, smoothing);
            let layered = even + layering_gradient(0.5 * LAYER, smoothing, LAYER);
            assert!((layered / sum - 1.0).abs() < bound, "h {smoothing}: {layered} for {sum}");
            assert!((layered - sum).abs() < 0.5 * (even - sum).abs(), "h {smoothing}: {even} was better");
        }
    }

    /// Inside a cylinder of 36 facets: the missing gradient by quadrature over all that lies beyond them.
    #[test]
    fn a_wall_of_facets_is_felt_as_a_smooth_one() {
        let (kernel, radius, facets) = (Wendland::new(1.3), 6.0, 36.0);
        let height = |x: DVec3| {
            let step = 2.0 * PI / facets;
            let off = (x.y.atan2(x.x) / step).round() * step;
            x.dot(DVec3::new(off.cos(), off.sin(), 0.0)) - radius
        };
        for (clearance, angle) in [(0.46, 0.0), (0.46, 0.05), (0.46, 0.08), (1.3, 0.08)] {
            let x = (radius - clearance) * DVec3::new(f64::cos(angle), f64::sin(angle), 0.0);
            let n = 60;
            let cell = kernel.support() / f64::from(n);
            let mut exact = DVec3::ZERO;
            for (i, j, k) in (0..8 * n * n * n).map(|c| (c % (2 * n), c / (2 * n) % (2 * n), c / (4 * n * n)))
            {
                let d =
                    cell * (DVec3::new(f64::from(i), f64::from(j), f64::from(k)) + 0.5) - kernel.support();
                if height(x + d) > 0.0 {
                    exact -= kernel.derivative(d.length()) * d.normalize() * cell.powi(3);
                }
            }
            let error = |faces: Faces| kernel.h * (faces.missing_gradient(&kernel, 0.0) - exact).length();
            let (mut shaped, mut plane) = (Faces::new(), Faces::new());
            shaped.push_shaped(x, (-height(x), DVec3::X), kernel.h, height);
            plane.push(-height(x), DVec3::X);
            let (shaped, plane) = (error(shaped), error(plane));
            println!("{clearance} {angle} {shaped} {plane}");
            if false {
                continue;
            }
            assert!(shaped < 0.1, "{shaped}, {plane} at {clearance}, {angle}");
        }
    }

    #[test]
    fn pushing_keeps_the_gap_to_both_faces() {
        let mut faces = Faces::new();
        faces.push(0.2, DVec3::X);
        faces.push(-0.1, DVec3::Z);
        assert!((faces.push_inside(DVec3::ZERO, 0.5) - DVec3::new(-0.3, 0.0, -0.6)).length() < 1e-15);
    }
}
