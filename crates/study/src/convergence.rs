//! What three spacings tell of the value at none: order, extrapolation and the grid convergence index.
//!
//! Roache 1994; Celik, Ghia, Roache, Freitas, Coleman, Raad 2008 (J. Fluids Eng. 130, 078001), whose symbols these are.

/// Safety factor of the index for three grids (Roache 1994).
const SAFETY: f64 = 1.25;
/// Orders outside of this are not those of a scheme in its asymptotic range.
const ORDERS: std::ops::RangeInclusive<f64> = 0.5..=3.0;
/// Rounds of the fixed-point iteration for the order; its contraction halves the change in each.
const ROUNDS: usize = 200;

/// How the values of three spacings go together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Trend {
    /// Their differences fall at this order \[-\].
    Monotonic(f64),
    /// The second difference has the other sign: no order can be told.
    Oscillating,
    /// Their differences do not fall as those of a scheme of order 0.5 to 3 would; the order found \[-\], where there is one.
    Unclear(Option<f64>),
}

/// What three spacings tell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Convergence {
    /// How the values go together.
    pub trend: Trend,
    /// The value at spacing zero; that of the finest where there is no order.
    pub extrapolated: f64,
    /// Uncertainty of the value of the finest, as a share of it \[-\]: the grid convergence index, or half the range of all
    /// three where there is no order.
    pub uncertainty: f64,
}

/// Convergence of values `phi` at spacings `h`, finest first. `None` unless the spacings grow and all is finite, or the finest
/// value is zero.
pub fn convergence(h: [f64; 3], phi: [f64; 3]) -> Option<Convergence> {
    if !(0.0 < h[0] && h[0] < h[1] && h[1] < h[2]) || phi.iter().any(|p| !p.is_finite()) || phi[0] == 0.0 {
        return None;
    }
    let (r21, r32) = (h[1] / h[0], h[2] / h[1]);
    let (e21, e32) = (phi[1] - phi[0], phi[2] - phi[1]);
    let low = phi.iter().copied().fold(f64::INFINITY, f64::min);
    let high = phi.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let range = 0.5 * (high - low) / phi[0].abs();
    let without = |trend| Some(Convergence { trend, extrapolated: phi[0], uncertainty: range });
    if e21 == 0.0 || e32 == 0.0 {
        return without(Trend::Unclear(None));
    }
    if e32 / e21 < 0.0 {
        return without(Trend::Oscillating);
    }
    match order(r21, r32, e32 / e21) {
        Some(p) if ORDERS.contains(&p) => {
            let gain = r21.powf(p) - 1.0;
            Some(Convergence {
                trend: Trend::Monotonic(p),
                extrapolated: phi[0] - e21 / gain,
                uncertainty: SAFETY * (e21 / phi[0]).abs() / gain,
            })
        }
        p => without(Trend::Unclear(p)),
    }
}

/// The order at which differences of ratio `e` belong to refinements `r21` and `r32`: the fixed point of equation 4 of Celik et
/// al., for differences of the same sign.
fn order(r21: f64, r32: f64, e: f64) -> Option<f64> {
    let mut p = 1.0;
    for _ in 0..ROUNDS {
        let q = ((r21.powf(p) - 1.0) / (r32.powf(p) - 1.0)).ln();
        let next = (e.ln() + q).abs() / r21.ln();
        if !next.is_finite() {
            return None;
        }
        // Half a step: the plain iteration swings where the ratios differ.
        p = 0.5 * (p + next.clamp(1e-3, 20.0));
    }
    // The absolute value of the equation also has solutions for differences that grow.
    (e > (r32.powf(p) - 1.0) / (r21.powf(p) - 1.0)).then_some(p)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sample of Celik et al. 2008, table 1, first column: reattachment length on 18 000, 8 000 and 4 500 cells with
    /// refinements 1.5 and 1.333: order 1.53, extrapolated value 6.1685, index 2.2 %.
    #[test]
    fn the_published_sample_is_reproduced() {
        let h = [1.0, 1.5, 1.5 * 1.333];
        let found = convergence(h, [6.063, 5.972, 5.863]).expect("three grids");
        let Trend::Monotonic(p) = found.trend else { panic!("{found:?}") };
        assert!((p - 1.53).abs() < 0.01, "{p}");
        assert!((found.extrapolated - 6.1685).abs() < 2e-3, "{found:?}");
        assert!((found.uncertainty - 0.022).abs() < 5e-4, "{found:?}");
    }

    #[test]
    fn the_order_of_a_power_law_is_found_for_unequal_ratios() {
        for p in [0.7, 1.0, 2.0, 2.9] {
            let value = |h: f64| 5.0 - 0.3 * h.powf(p);
            let h = [0.5, 0.8, 1.1];
            let found = convergence(h, h.map(value)).expect("three spacings");
            let Trend::Monotonic(order) = found.trend else { panic!("{found:?}") };
            assert!((order - p).abs() < 1e-6, "{order} of {p}");
            assert!((found.extrapolated - 5.0).abs() < 1e-6, "{found:?}");
        }
    }

    #[test]
    fn what_swings_or_grows_gives_the_range() {
        let swings = convergence([1.0, 2.0, 4.0], [1.0, 1.1, 1.0]).expect("three");
        assert_eq!(swings.trend, Trend::Oscillating);
        assert!((swings.uncertainty - 0.05).abs() < 1e-12 && swings.extrapolated == 1.0);
        let grows = convergence([1.0, 2.0, 4.0], [1.0, 1.2, 1.25]).expect("three");
        assert!(matches!(grows.trend, Trend::Unclear(_)), "{grows:?}");
        assert!(matches!(
            convergence([1.0, 2.0, 4.0], [1.0, 1.0, 1.0]).expect("three").trend,
            Trend::Unclear(None)
        ));
        assert_eq!(convergence([1.0, 1.0, 2.0], [1.0, 2.0, 3.0]), None);
        assert_eq!(convergence([1.0, 2.0, 3.0], [1.0, f64::NAN, 3.0]), None);
    }
}
