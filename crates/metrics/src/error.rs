//! What makes a metric impossible.

/// Why a metric cannot be set up.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MetricsError {
    /// A length or time that has to be positive is not.
    #[error("the {quantity} must be positive and finite, not {value}")]
    NotPositive {
        /// What it is.
        quantity: &'static str,
        /// The value seen, in SI units.
        value: f64,
    },
    /// Columns that describe the same points differ in length.
    #[error("{seen} values of the {quantity} for {expected} points")]
    Length {
        /// What there are too few or too many of.
        quantity: &'static str,
        /// Values given.
        seen: usize,
        /// Values needed.
        expected: usize,
    },
    /// An opening is asked for that does not exist.
    #[error("no opening is named \"{name}\"; there are \"{known}\"")]
    UnknownOpening {
        /// The name asked for.
        name: String,
        /// The names there are.
        known: String,
    },
}

impl MetricsError {
    /// `value` where it is positive and finite.
    pub(crate) fn positive(quantity: &'static str, value: f64) -> Result<f64, Self> {
        if value > 0.0 && value.is_finite() { Ok(value) } else { Err(Self::NotPositive { quantity, value }) }
    }

    /// Nothing where there are as many values as points.
    pub(crate) fn length(quantity: &'static str, seen: usize, expected: usize) -> Result<(), Self> {
        if seen == expected { Ok(()) } else { Err(Self::Length { quantity, seen, expected }) }
    }
}
