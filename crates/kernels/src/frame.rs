//! Fixed-point frame: how positions enter the pair loops without losing digits.

use glam::DVec3;

/// Box of a run, cut into 2^31 fixed-point units along its longest edge.
///
/// Differences of two fixed-point coordinates are exact, so single-precision pair loops see the
/// same separations wherever in the box (and in space) a pair lies.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    origin: DVec3,
    support: f64,
    /// Fixed-point units a metre \[1/m\].
    scale: f64,
}

impl Frame {
    /// Frame over `bounds` \[m\] for pairs closer than `support` \[m\].
    ///
    /// An eighth of the extent is added on each side; positions beyond stick to the border.
    pub fn new(bounds: (DVec3, DVec3), support: f64) -> Self {
        let extent = (bounds.1 - bounds.0).max_element().max(4.0 * support);
        let origin = bounds.0 - DVec3::splat(extent / 8.0);
        Self { origin, support, scale: 2_f64.powi(31) / (1.25 * extent) }
    }

    /// Support radius \[m\], the unit of separations in the pair loops.
    pub fn support(&self) -> f64 {
        self.support
    }

    /// Fixed-point unit, in supports.
    pub fn unit(&self) -> f64 {
        1.0 / (self.scale * self.support)
    }

    /// Fixed-point coordinates of `x` \[m\].
    #[inline]
    pub fn fixed(&self, x: DVec3) -> [i32; 3] {
        // `as` saturates: a particle far outside sticks to the border instead of wrapping around.
        ((x - self.origin) * self.scale).to_array().map(|c| c as i32)
    }

    /// Coordinates of `x` \[m\] in supports.
    #[inline]
    pub fn in_supports(&self, x: DVec3) -> [f64; 3] {
        ((x - self.origin) / self.support).to_array()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn separations_do_not_depend_on_the_place() {
        let support = 1e-3;
        for shift in [0.0, 1.0, -250.0] {
            let low = DVec3::splat(shift);
            let frame = Frame::new((low, low + DVec3::new(0.06, 0.02, 0.01)), support);
            let (a, b) = (low + DVec3::new(0.05, 0.01, 0.003), low + DVec3::new(0.0504, 0.0098, 0.0031));
            let (fa, fb) = (frame.fixed(a), frame.fixed(b));
            for k in 0..3 {
                let exact = (a - b)[k] / support;
                let fixed = f64::from(fa[k].wrapping_sub(fb[k])) * frame.unit();
                assert!((fixed - exact).abs() < 1.1 * frame.unit() + 1e-10, "{fixed} {exact}");
            }
        }
    }
}
