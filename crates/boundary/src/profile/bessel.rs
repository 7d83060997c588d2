//! Bessel functions on the ray that pulsatile pipe flow needs, J_n(x e^{-i pi/4}) for real x.

use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_4, PI};

/// Where the series gives way to the asymptotic form. There the terms of the series are e^7 times their sum, and
/// what the form leaves out is e^-35 of it.
const FAR: f64 = 25.0;

/// J_n(z) e^{-|Im z|} at z = x e^{-i pi/4}, for `order` n of 0 or 1 and x >= 0. The factor keeps it within range.
pub(crate) fn scaled(order: u32, x: f64) -> Complex64 {
    let z = Complex64::from_polar(x, -FRAC_PI_4);
    if x < FAR { series(order, z) * z.im.exp() } else { asymptotic(order, z) }
}

/// Power series (Abramowitz and Stegun 1964, 9.1.10).
fn series(order: u32, z: Complex64) -> Complex64 {
    let square = -0.25 * z * z;
    let mut term = if order == 0 { Complex64::ONE } else { 0.5 * z };
    let mut sum = term;
    for k in 1..200 {
        let k = f64::from(k);
        term *= square / (k * (k + f64::from(order)));
        sum += term;
        if term.norm() < 1e-17 * sum.norm() {
            break;
        }
    }
    sum
}

/// The growing half of Hankel's expansion (Abramowitz and Stegun 1964, 9.2.7), for z below the real axis.
fn asymptotic(order: u32, z: Complex64) -> Complex64 {
    let n = f64::from(order);
    let mut term = Complex64::ONE;
    let mut sum = term;
    for k in 1..30 {
        let odd = f64::from(2 * k - 1);
        term *= Complex64::i() * (4.0 * n * n - odd * odd) / (8.0 * f64::from(k) * z);
        sum += term;
        if term.norm() < 1e-17 {
            break;
        }
    }
    let phase = z.re - 0.5 * n * PI - FRAC_PI_4;
    sum * Complex64::from_polar(1.0, phase) / (2.0 * PI * z).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_those_of_mpmath() {
        let table = [
            (1.0, (0.485367836696052, 0.1230532007775678), (0.1951902454258983, -0.151646545762264)),
            (5.0, (-0.1815644967747418, 0.003381612389061062), (-0.01048504087679172, 0.1689695496231411)),
            (10.0, (0.1179207765794151, 0.04787687943663955), (0.05051586339029839, -0.1120079181552954)),
            (
                24.9,
                (-0.005463883167907739, -0.08004628880608917),
                (-0.0789889323347378, 0.004233170718091712),
            ),
            (
                25.1,
                (0.005851999094777552, -0.07969544106564388),
                (-0.07848973090928053, -0.006908433383208061),
            ),
            (60.0, (-0.01909744666105955, -0.04791341679769586), (-0.04774430832449997, 0.01870090622305846)),
            (120.0, (-0.03406206482329537, 0.01296233434195378), (0.01282349063309432, 0.03400001410410745)),
        ];
        for (x, j0, j1) in table {
            for (order, (re, im)) in [(0, j0), (1, j1)] {
                let error = (scaled(order, x) - Complex64::new(re, im)).norm();
                assert!(error < 1e-13, "J{order} at {x}: {error:.1e}");
            }
        }
    }
}
