//! How alike the wall shear stress of two runs is, point by point.

use crate::case::Case;
use crate::error::DriverError;
use crate::observe::WallObserver;
use crate::plan::Plan;
use std::path::Path;
use vaso_io::{FrameData, SeriesReader, schema, wall_surface};

/// Magnitude of the wall shear stress over the wall, time-averaged where cycles were run.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct StressMap {
    /// At each point of the mesh \[Pa\]; NaN where there is none.
    value: Vec<f64>,
    /// Area it stands for, zero next to openings \[m^2\].
    area: Vec<f64>,
}

impl StressMap {
    /// That of the run in `out`; `None` where it told none.
    ///
    /// # Errors
    /// When a file cannot be read.
    pub(super) fn read(out: &Path, case: &Case, plan: &Plan) -> Result<Option<Self>, DriverError> {
        if !plan.wall_metrics {
            return Ok(None);
        }
        let Some(path) = wall_surface(out) else { return Ok(None) };
        let Some(frame) = SeriesReader::open(&path)?.last_frame()? else { return Ok(None) };
        let area = WallObserver::counted(case, plan);
        Ok(magnitude(&frame).filter(|value| value.len() == area.len()).map(|value| Self { value, area }))
    }

    /// Correlation with another on the same points (Pearson's coefficient, by area); `None` where they are not the same, or too few have values.
    pub(super) fn correlation(&self, other: &Self) -> Option<f64> {
        if self.value.len() != other.value.len() {
            return None;
        }
        let points = || {
            let pairs = self.area.iter().zip(&self.value).zip(&other.value);
            pairs
                .map(|((w, a), b)| (*w, *a, *b))
                .filter(|(w, a, b)| *w > 0.0 && a.is_finite() && b.is_finite())
        };
        let total: f64 = points().map(|p| p.0).sum();
        let mean = |of: &dyn Fn(f64, f64) -> f64| points().map(|(w, a, b)| w * of(a, b)).sum::<f64>() / total;
        let (one, two) = (mean(&|a, _| a), mean(&|_, b| b));
        let covariance = mean(&|a, b| (a - one) * (b - two));
        let spread = mean(&|a, _| (a - one).powi(2)) * mean(&|_, b| (b - two).powi(2));
        let coefficient = covariance / spread.sqrt();
        coefficient.is_finite().then_some(coefficient)
    }
}

/// The time-averaged stress, or that of the last window.
fn magnitude(frame: &FrameData) -> Option<Vec<f64>> {
    let mean = frame.scalars.iter().find(|(name, _)| name == schema::TAWSS).map(|(_, values)| values);
    if let Some(mean) = mean.filter(|values| values.iter().any(|v| v.is_finite())) {
        return Some(mean.clone());
    }
    let stress = frame.vectors.iter().find(|(name, _)| name == schema::WSS)?;
    Some(stress.1.iter().map(|v| v.length()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_grows_together_is_alike_whatever_its_scale() {
        let map = |value: &[f64]| StressMap { value: value.to_vec(), area: vec![1.0, 2.0, 1.0, 0.0] };
        let own = map(&[1.0, 2.0, 4.0, 9.0]);
        let near = |other: &[f64], exact: f64| {
            let found = own.correlation(&map(other)).expect("three points");
            assert!((found - exact).abs() < 1e-12, "{found} for {exact}");
        };
        near(&[2.0, 4.0, 8.0, -5.0], 1.0);
        near(&[-1.0, -2.0, -4.0, 0.0], -1.0);
        // Deviations of -5/4, -1/4, 7/4 and of -1, 0, 1, with weights of 1, 2, 1.
        near(&[0.0, 1.0, 2.0, 0.0], 3.0 / (4.75_f64 * 2.0).sqrt());
        assert_eq!(own.correlation(&map(&[1.0, 1.0, 1.0, 1.0])), None);
        assert_eq!(own.correlation(&StressMap { value: vec![1.0], area: vec![1.0] }), None);
        assert!(own.correlation(&map(&[2.0, f64::NAN, 8.0, 0.0])).is_some());
    }
}
