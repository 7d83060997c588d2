//! The Wendland C2 kernel in three dimensions.

use std::f64::consts::PI;

/// Normalisation of the three-dimensional Wendland C2 kernel, 21 / (16 pi).
const SIGMA: f64 = 21.0 / (16.0 * PI);

/// Wendland C2 kernel with support radius 2h (Wendland 1995; Dehnen & Aly 2012).
///
/// `W(r) = sigma / h^3 (1 - q/2)^4 (1 + 2q)`, `q = r / h`, zero from `q = 2` on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wendland {
    /// Smoothing length \[m\]; the support radius is twice as large.
    pub h: f64,
}

impl Wendland {
    /// Kernel of smoothing length `h` \[m\], `h > 0`.
    pub fn new(h: f64) -> Self {
        debug_assert!(h > 0.0, "smoothing length must be positive, got {h}");
        Self { h }
    }

    /// Support radius 2h \[m\]: the kernel is zero from there on.
    pub fn support(&self) -> f64 {
        2.0 * self.h
    }

    /// Kernel value W(r) \[1/m^3\].
    pub fn value(&self, r: f64) -> f64 {
        let u = (1.0 - 0.5 * r / self.h).max(0.0);
        self.value_scale() * u.powi(4) * (5.0 - 4.0 * u)
    }

    /// Radial derivative dW/dr \[1/m^4\], never positive.
    pub fn derivative(&self, r: f64) -> f64 {
        let u = (1.0 - 0.5 * r / self.h).max(0.0);
        -self.gradient_scale() * u.powi(3) * r / self.support()
    }

    /// Factor `s` with `W = s u^4 (5 - 4u)`, `u = 1 - r / 2h` \[1/m^3\].
    pub fn value_scale(&self) -> f64 {
        SIGMA / self.h.powi(3)
    }

    /// Factor `s` with `grad W = -s u^3 d`, where `d` is the separation in supports \[1/m^4\].
    pub fn gradient_scale(&self) -> f64 {
        10.0 * SIGMA / self.h.powi(4)
    }

    /// Kernel sum `S0 = sum V W` over the cubic lattice of spacing `dp` \[m\], self term included.
    ///
    /// It differs from one (1.0095 at h = 1.3 dp), so density summation is measured against it.
    pub fn lattice_sum(&self, dp: f64) -> f64 {
        let reach = (self.support() / dp).ceil() as i32;
        let mut sum = 0.0;
        for i in -reach..=reach {
            for j in -reach..=reach {
                for k in -reach..=reach {
                    sum += self.value(dp * f64::from(i * i + j * j + k * k).sqrt());
                }
            }
        }
        sum * dp.powi(3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrates_to_one() {
        let kernel = Wendland::new(0.7);
        let n = 20_000;
        let dr = kernel.support() / f64::from(n);
        let integral: f64 = (0..n)
            .map(|k| {
                let r = (f64::from(k) + 0.5) * dr;
                4.0 * PI * r * r * kernel.value(r) * dr
            })
            .sum();
        assert!((integral - 1.0).abs() < 1e-8, "{integral}");
    }

    #[test]
    fn derivative_is_that_of_the_value() {
        let kernel = Wendland::new(1.3);
        for k in 1..25 {
            let r = 0.1 * f64::from(k);
            let e = 1e-6;
            let numeric = (kernel.value(r + e) - kernel.value(r - e)) / (2.0 * e);
            assert!((numeric - kernel.derivative(r)).abs() < 1e-9, "at r = {r}");
        }
    }

    /// Lattice sums of the 3D Wendland kernel at the smoothing lengths in use (four decimals).
    #[test]
    fn lattice_sums_match_the_table() {
        for (ratio, expected) in [(1.0, 1.0338), (1.15, 1.0213), (1.3, 1.0095), (1.5, 1.0031)] {
            let sum = Wendland::new(ratio * 0.4).lattice_sum(0.4);
            assert!((sum - expected).abs() < 5e-5, "h/dp = {ratio}: {sum}");
        }
    }
}
