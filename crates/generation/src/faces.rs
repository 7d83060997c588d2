//! The faces that bound a body as one point sees them, and what a kernel misses beyond them.

use glam::DVec3;
use vaso_kernels::Wendland;

/// Faces a point can feel at once: wall, outer wall and the caps of one corner.
const CAPACITY: usize = 6;

/// One locally plane face of a region, as seen from a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Face {
    /// Distance to the face \[m\], positive on the inner side.
    pub(crate) clearance: f64,
    /// Unit normal out of the region.
    pub(crate) normal: DVec3,
}

/// The faces near one point, kept on the stack because they are asked for in the inner loop.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Faces {
    face: [Face; CAPACITY],
    len: usize,
}

impl Faces {
    pub(crate) fn new() -> Self {
        Self { face: [Face { clearance: f64::INFINITY, normal: DVec3::ZERO }; CAPACITY], len: 0 }
    }

    /// Adds a face; beyond six faces the point sits in a corner where more of them change nothing.
    pub(crate) fn push(&mut self, clearance: f64, normal: DVec3) {
        if self.len < CAPACITY {
            self.face[self.len] = Face { clearance, normal };
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

    /// Kernel gradient integrated over what lies beyond the faces \[1/m\].
    ///
    /// Every face is a half space. Where two meet, the part beyond both must not count twice: the
    /// share of a face is reduced by the kernel volume missing beyond the others, which is exact
    /// for perpendicular faces through the point and for any separable kernel.
    pub(crate) fn missing_gradient(&self, kernel: &Wendland) -> DVec3 {
        let faces = self.as_slice();
        let mut sum = DVec3::ZERO;
        for (a, face) in faces.iter().enumerate() {
            if face.clearance >= kernel.support() {
                continue;
            }
            let mut share = half_space_gradient(face.clearance, kernel.h);
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
        let g = faces.missing_gradient(&kernel);
        assert!((g - 0.375 * (DVec3::X + DVec3::Y)).length() < 1e-12, "{g}");
    }

    #[test]
    fn pushing_keeps_the_gap_to_both_faces() {
        let mut faces = Faces::new();
        faces.push(0.2, DVec3::X);
        faces.push(-0.1, DVec3::Z);
        assert!((faces.push_inside(DVec3::ZERO, 0.5) - DVec3::new(-0.3, 0.0, -0.6)).length() < 1e-15);
    }
}
