//! The Wendland C2 kernel in the plane, and what it misses beyond a straight border.

use vaso_kernels::Wendland;

/// Normalisation in the plane over that in space at equal smoothing length, 7/(4 pi) / (21/(16 pi)).
const PLANE_OVER_SPACE: f64 = 4.0 / 3.0;

/// Wendland C2 kernel normalised over a plane, 7 / (4 pi h^2) (Dehnen & Aly 2012), support radius 2h.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlaneKernel(Wendland);

impl PlaneKernel {
    /// Kernel of smoothing length `h` \[m\].
    pub(crate) fn new(h: f64) -> Self {
        Self(Wendland::new(h))
    }

    /// Smoothing length h \[m\].
    pub(crate) fn h(&self) -> f64 {
        self.0.h
    }

    /// Support radius 2h \[m\].
    pub(crate) fn support(&self) -> f64 {
        self.0.support()
    }

    /// Kernel value W(r) \[1/m^2\].
    pub(crate) fn value(&self, r: f64) -> f64 {
        PLANE_OVER_SPACE * self.0.h * self.0.value(r)
    }

    /// Factor `s` with `grad W = -s u^3 d`, `u = 1 - r / 2h`, `d` the separation in supports \[1/m^3\].
    pub(crate) fn gradient_scale(&self) -> f64 {
        PLANE_OVER_SPACE * self.0.h * self.0.gradient_scale()
    }

    /// Kernel sum over the square lattice of spacing `dp` \[m\], own term included, times dp^2.
    pub(crate) fn lattice_sum(&self, dp: f64) -> f64 {
        let reach = (self.support() / dp).ceil() as i32;
        let line = |i: i32| -> f64 {
            (-reach..=reach).map(|j| self.value(dp * f64::from(i * i + j * j).sqrt())).sum()
        };
        (-reach..=reach).map(line).sum::<f64>() * dp * dp
    }

    /// Magnitude of the kernel gradient integrated over the half plane beyond a straight line at `clearance`
    /// \[m\]; in \[1/m\].
    ///
    /// By the divergence theorem that is the kernel integrated along the line. Beyond the line the value on
    /// it is kept.
    pub(crate) fn half_plane_gradient(&self, clearance: f64) -> f64 {
        let d = (clearance / self.h()).clamp(0.0, 2.0);
        // In units of h the line lies within the support for |s| < end, where r = 2. With I_n the integral of
        // r^n over 0 < s < end: (n + 1) I_n = end 2^n + n d^2 I_(n-2).
        let end = (4.0 - d * d).max(0.0).sqrt();
        let d2 = d * d;
        let i0 = end;
        let i1 = if d > 0.0 { 0.5 * (2.0 * end + d2 * (end / d).asinh()) } else { end };
        let i2 = (4.0 * end + 2.0 * d2 * i0) / 3.0;
        let i3 = (8.0 * end + 3.0 * d2 * i1) / 4.0;
        let i4 = (16.0 * end + 4.0 * d2 * i2) / 5.0;
        let i5 = (32.0 * end + 5.0 * d2 * i3) / 6.0;
        // (1 - r/2)^4 (1 + 2r) written out.
        let half_line = i0 - 2.5 * i2 + 2.5 * i3 - 0.9375 * i4 + 0.125 * i5;
        2.0 * half_line * self.value(0.0) * self.h()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn integrates_to_one_over_the_plane() {
        let kernel = PlaneKernel::new(0.7);
        let n = 20_000;
        let dr = kernel.support() / f64::from(n);
        let ring = |k: i32| {
            let r = (f64::from(k) + 0.5) * dr;
            2.0 * PI * r * kernel.value(r) * dr
        };
        let integral: f64 = (0..n).map(ring).sum();
        assert!((integral - 1.0).abs() < 1e-8, "{integral}");
    }

    #[test]
    fn half_plane_form_is_the_kernel_along_the_line() {
        let kernel = PlaneKernel::new(1.15e-3);
        let n = 20_000;
        for clearance in [0.0, 0.3, 1.0, 1.7, 1.999].map(|d| d * kernel.h()) {
            let ds = 2.0 * kernel.support() / f64::from(n);
            let value = |k: i32| {
                let s = (f64::from(k) + 0.5) * ds - kernel.support();
                kernel.value(s.hypot(clearance)) * ds
            };
            let integral: f64 = (0..n).map(value).sum();
            let closed = kernel.half_plane_gradient(clearance);
            assert!((closed - integral).abs() * kernel.h() < 1e-7, "{closed} {integral} at {clearance}");
        }
    }
}
