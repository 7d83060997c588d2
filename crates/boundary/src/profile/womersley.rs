//! Pulsatile flow in a round pipe (Womersley 1955), harmonic by harmonic.

use super::bessel::scaled;
use num_complex::Complex64;
use std::f64::consts::FRAC_PI_4;

/// Shape of one harmonic over the radius, of unit mean over the section and with the phase against the mean flow.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Harmonic {
    values: Vec<Complex64>,
}

/// Intervals over the radius. The layer at the wall of a harmonic is 1/alpha of the radius.
const INTERVALS: usize = 1024;

impl Harmonic {
    /// The harmonic of Womersley number `alpha` = R sqrt(w rho / mu).
    pub(crate) fn new(alpha: f64) -> Self {
        let values = (0..=INTERVALS).map(|k| shape(alpha, k as f64 / INTERVALS as f64)).collect();
        Self { values }
    }

    /// Value at the radius `r`, a part of that of the pipe.
    pub(crate) fn at(&self, r: f64) -> Complex64 {
        let place = (r * INTERVALS as f64).clamp(0.0, INTERVALS as f64);
        let k = (place as usize).min(INTERVALS - 1);
        let part = place - k as f64;
        self.values[k] * (1.0 - part) + self.values[k + 1] * part
    }
}

/// `[1 - J0(L r)/J0(L)] / [1 - 2 J1(L)/(L J0(L))]` with `L = alpha i^{3/2}`.
///
/// Both functions are the same, or change sign together, at -L = alpha e^{-i pi/4}.
fn shape(alpha: f64, r: f64) -> Complex64 {
    // Below, the quotient loses its digits; the flow is Poiseuille's up to alpha^2 / 12.
    if alpha < 1e-3 {
        return Complex64::from(2.0 * (1.0 - r * r));
    }
    let rim = scaled(0, alpha);
    // The scales differ by the growth of J0 between r and the rim.
    let growth = (-(1.0 - r) * alpha * FRAC_PI_4.sin()).exp();
    let lambda = Complex64::from_polar(alpha, -FRAC_PI_4);
    let mean = Complex64::ONE - 2.0 * scaled(1, alpha) / (lambda * rim);
    (Complex64::ONE - scaled(0, alpha * r) * growth / rim) / mean
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_over_the_section_is_one() {
        for alpha in [1e-4, 1e-2, 0.5, 3.0, 12.0, 26.0, 104.0] {
            let harmonic = Harmonic::new(alpha);
            let n = 20_000;
            let sum: Complex64 = (0..n)
                .map(|k| (f64::from(k) + 0.5) / f64::from(n))
                .map(|r| harmonic.at(r) * 2.0 * r / f64::from(n))
                .sum();
            assert!((sum - 1.0).norm() < 2e-3, "alpha {alpha}: {sum}");
            assert!(harmonic.at(1.0).norm() < 1e-12, "alpha {alpha}");
        }
    }

    #[test]
    fn a_slow_one_is_poiseuille_and_a_fast_one_a_plug() {
        let (slow, fast) = (Harmonic::new(0.1), Harmonic::new(100.0));
        for r in [0.0, 0.4, 0.8] {
            assert!((slow.at(r) - 2.0 * (1.0 - r * r)).norm() < 2e-3, "{r}: {}", slow.at(r));
            assert!((fast.at(r) - 1.0).norm() < 0.03, "{r}: {}", fast.at(r));
        }
    }
}
