//! Velocity across a cap, with unit mean.

mod bessel;
mod inlet;
mod section;
mod womersley;

pub(crate) use inlet::Amplitudes;
pub use inlet::Inlet;
pub use section::Section;

use crate::error::BoundaryError;
use crate::waveform::{Signal, Source};

/// Shape of the velocity over the section of an inlet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Profile {
    /// The same everywhere.
    Plug,
    /// `2 (1 - s^2)`, where `s` is the distance from the centre as a part of the way to the rim in
    /// that direction: the Poiseuille profile on a disc, of unit mean on any star-shaped cap.
    Parabolic,
    /// `(n + 2)/n (1 - s^n)`: the parabola for 2, and blunter the larger n is.
    Power {
        /// n.
        exponent: f64,
    },
    /// Fully developed steady flow through a section of the cap's shape.
    FullyDeveloped,
    /// Fully developed pulsatile flow, harmonic by harmonic of a periodic waveform (Womersley 1955). On a cap that is not
    /// round the radius is that of the steady flow's contours ([`Section::radius`]).
    Womersley,
}

impl Profile {
    /// Largest velocity over the mean, as far as it does not depend on the cap; that of a disc otherwise.
    pub fn peak(self) -> f64 {
        match self {
            Self::Plug => 1.0,
            Self::Parabolic | Self::FullyDeveloped | Self::Womersley => 2.0,
            Self::Power { exponent } => (exponent + 2.0) / exponent,
        }
    }

    /// Whether the profile has a meaning for a flow.
    ///
    /// # Errors
    /// When the exponent is not above zero, or a waveform has no period to take harmonics of.
    pub fn validate(self, mean: &Signal) -> Result<(), BoundaryError> {
        match (self, &mean.source) {
            (Self::Power { exponent }, _) if !(exponent > 0.0 && exponent.is_finite()) => {
                Err(BoundaryError::OutOfRange {
                    key: "exponent",
                    value: exponent,
                    allowed: "more than zero; 2 is the parabola",
                })
            }
            (Self::Womersley, Source::Waveform(wave)) if wave.period().is_none() => {
                Err(BoundaryError::ProfileWithoutPeriod)
            }
            _ => Ok(()),
        }
    }
}

/// Distance of `at` from the origin over that of the rim in the same direction.
///
/// The farthest crossing counts, should a ray cross the rim more than once.
fn radial_fraction(at: [f64; 2], polygon: &[[f64; 2]]) -> f64 {
    let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    let mut rim: f64 = 0.0;
    for (k, &a) in polygon.iter().enumerate() {
        let b = polygon[(k + 1) % polygon.len()];
        let edge = [b[0] - a[0], b[1] - a[1]];
        let denominator = cross(at, edge);
        if denominator == 0.0 {
            continue;
        }
        // at * t = a + edge * u
        let (t, u) = (cross(a, edge) / denominator, cross(a, at) / denominator);
        if t > 0.0 && (-1e-12..=1.0 + 1e-12).contains(&u) {
            rim = rim.max(t);
        }
    }
    if rim > 0.0 { 1.0 / rim } else { 0.0 }
}
