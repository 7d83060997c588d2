//! What an accuracy costs: error and time, both against the spacing.

use crate::PowerLaw;

/// Error and time against the spacing, from a ladder of runs that differ in nothing else.
#[derive(Debug, Clone, PartialEq)]
pub struct Trade {
    /// Error against spacing \[m\].
    pub error: PowerLaw,
    /// Time \[s\] against spacing \[m\].
    pub time: PowerLaw,
    /// Finest and coarsest spacing that was run \[m\].
    pub measured: (f64, f64),
}

/// What an error costs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Price {
    /// Spacing it takes \[m\].
    pub spacing: f64,
    /// Time it takes \[s\].
    pub time: f64,
    /// Whether the spacing lies outside what was run.
    pub is_extrapolated: bool,
}

/// Spacings a law is trusted beyond what was run: three quarters of the finest, four thirds of the coarsest.
const TRUST: f64 = 4.0 / 3.0;

impl Trade {
    /// The laws through `(spacing, time, error)`; `None` where they cannot be told, or the error does not fall with the spacing.
    pub fn new(runs: &[(f64, f64, f64)]) -> Option<Self> {
        let error = PowerLaw::fit(&runs.iter().map(|r| (r.0, r.2)).collect::<Vec<_>>())?;
        let time = PowerLaw::fit(&runs.iter().map(|r| (r.0, r.1)).collect::<Vec<_>>())?;
        let low = runs.iter().map(|r| r.0).fold(f64::INFINITY, f64::min);
        let high = runs.iter().map(|r| r.0).fold(0.0, f64::max);
        (error.exponent > 0.05 && time.exponent < -0.05).then_some(Self {
            error,
            time,
            measured: (low, high),
        })
    }

    /// What an error costs.
    pub fn of_error(&self, error: f64) -> Option<Price> {
        let spacing = self.error.solve(error)?;
        Some(self.price(spacing))
    }

    /// What is to be had for a time \[s\].
    pub fn of_time(&self, time: f64) -> Option<Price> {
        let spacing = self.time.solve(time)?;
        Some(self.price(spacing))
    }

    fn price(&self, spacing: f64) -> Price {
        let (low, high) = self.measured;
        Price {
            spacing,
            time: self.time.at(spacing),
            is_extrapolated: spacing < low / TRUST || spacing > high * TRUST,
        }
    }

    /// Factor of time that half the error costs \[-\].
    pub fn of_halving(&self) -> f64 {
        0.5f64.powf(self.time.exponent / self.error.exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trade() -> Trade {
        let run = |h: f64| (h, 1e-2 * h.powi(-4), 0.5 * h.powi(2));
        Trade::new(&[run(0.2), run(0.15), run(0.1)]).expect("three runs")
    }

    #[test]
    fn an_error_has_its_spacing_and_its_time() {
        let price = trade().of_error(0.5 * 0.12f64.powi(2)).expect("a price");
        assert!((price.spacing - 0.12).abs() < 1e-9 && !price.is_extrapolated);
        assert!((price.time - 1e-2 * 0.12f64.powi(-4)).abs() < 1e-6 * price.time);
        assert!(trade().of_error(1e-5).expect("a price").is_extrapolated);
        let back = trade().of_time(price.time).expect("a price");
        assert!((back.spacing - price.spacing).abs() < 1e-9);
    }

    /// Order two and four dimensions: half the error is a spacing of 0.707, four times the time.
    #[test]
    fn half_the_error_has_its_price() {
        assert!((trade().of_halving() - 4.0).abs() < 1e-9);
    }

    #[test]
    fn errors_that_do_not_fall_have_no_price() {
        assert_eq!(Trade::new(&[(0.2, 1.0, 0.1), (0.1, 16.0, 0.2)]), None);
        assert_eq!(Trade::new(&[(0.2, 1.0, 0.1)]), None);
    }
}
