//! Laws of the form `y = a x^p`, as errors and times follow in the spacing.

/// A power law through measured points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerLaw {
    /// `y` at `x = 1`.
    pub factor: f64,
    /// The exponent \[-\].
    pub exponent: f64,
    /// Largest ratio of a measured value and the law's, either way, less one \[-\].
    pub misfit: f64,
}

impl PowerLaw {
    /// The law through points `(x, y)` by least squares of the logarithms; `None` where there are fewer than two different
    /// `x`, or a value is not positive and finite.
    pub fn fit(points: &[(f64, f64)]) -> Option<Self> {
        if points.iter().any(|&(x, y)| !(x > 0.0 && y > 0.0 && x.is_finite() && y.is_finite())) {
            return None;
        }
        let n = points.len() as f64;
        let logs: Vec<(f64, f64)> = points.iter().map(|&(x, y)| (x.ln(), y.ln())).collect();
        let mean = logs.iter().fold((0.0, 0.0), |m, l| (m.0 + l.0 / n, m.1 + l.1 / n));
        let spread: f64 = logs.iter().map(|l| (l.0 - mean.0).powi(2)).sum();
        // The same x but for rounding tells no slope.
        if points.len() < 2 || spread < 1e-12 {
            return None;
        }
        let exponent = logs.iter().map(|l| (l.0 - mean.0) * (l.1 - mean.1)).sum::<f64>() / spread;
        let intercept = mean.1 - exponent * mean.0;
        let misfit = logs.iter().map(|l| (l.1 - intercept - exponent * l.0).abs()).fold(0.0, f64::max);
        Some(Self { factor: intercept.exp(), exponent, misfit: misfit.exp_m1() })
    }

    /// `y` at `x`.
    pub fn at(&self, x: f64) -> f64 {
        self.factor * x.powf(self.exponent)
    }

    /// The `x` at which the law gives `y`; `None` where it hardly depends on `x`.
    pub fn solve(&self, y: f64) -> Option<f64> {
        let x = (y / self.factor).powf(1.0 / self.exponent);
        (self.exponent.abs() > 0.05 && x.is_finite() && x > 0.0).then_some(x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_is_found_again() {
        let points = [1.0, 1.5, 4.0].map(|x: f64| (x, 3.0 * x.powf(-2.5)));
        let law = PowerLaw::fit(&points).expect("three points");
        assert!((law.factor - 3.0).abs() < 1e-12 && (law.exponent + 2.5).abs() < 1e-12 && law.misfit < 1e-12);
        assert!((law.at(2.0) - 3.0 * 2f64.powf(-2.5)).abs() < 1e-12);
        let x = law.solve(law.at(2.0)).expect("it depends on x");
        assert!((x - 2.0).abs() < 1e-12);
    }

    #[test]
    fn scatter_is_told_as_misfit() {
        let law = PowerLaw::fit(&[(1.0, 1.0), (2.0, 4.4), (4.0, 16.0)]).expect("three points");
        assert!((law.exponent - 2.0).abs() < 0.01 && (0.03..0.07).contains(&law.misfit), "{law:?}");
    }

    #[test]
    fn what_tells_no_law_gives_none() {
        assert_eq!(PowerLaw::fit(&[(1.0, 2.0)]), None);
        assert_eq!(PowerLaw::fit(&[(1.0, 2.0), (1.0, 3.0)]), None);
        assert_eq!(PowerLaw::fit(&[(1.0, 2.0), (2.0, 0.0)]), None);
        assert_eq!(PowerLaw::fit(&[(1.0, 2.0), (2.0, f64::NAN)]), None);
        let flat = PowerLaw::fit(&[(1.0, 2.0), (2.0, 2.0)]).expect("a law");
        assert_eq!(flat.solve(1.0), None);
    }
}
