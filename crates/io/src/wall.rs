//! What `summary.json` says of the wall.

use crate::json;
use serde::{Deserialize, Serialize};

/// Time-averaged wall shear stress below which a wall counts as little sheared \[Pa\] (Malek, Alper, Izumo 1999).
pub const LOW_TAWSS: f64 = 0.4;

/// Stresses of the wall and their indices, by area.
///
/// Near an opening the flow is imposed, so the stress there says nothing of the vessel: what lies within the buffers does not
/// count.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct WallSummary {
    /// Points at which the stress is told.
    pub points: u64,
    /// Triangles between them.
    pub triangles: u64,
    /// Area of the wall \[m^2\].
    #[serde(deserialize_with = "json::number")]
    pub area_m2: f64,
    /// Area of the part that counts \[m^2\].
    #[serde(deserialize_with = "json::number")]
    pub counted_area_m2: f64,
    /// Magnitude of the wall shear stress in the last frame \[Pa\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wss_pa: Option<Distribution>,
    /// Number of the last whole cycle, from 0, of which the indices below are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cycle: Option<u64>,
    /// Time-averaged wall shear stress \[Pa\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tawss_pa: Option<Distribution>,
    /// Part of the area where it is below 0.4 Pa \[-\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub low_tawss_area_fraction: Option<f64>,
    /// Oscillatory shear index \[-\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub osi: Option<Distribution>,
    /// Relative residence time \[1/Pa\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rrt_1_pa: Option<Distribution>,
    /// Endothelial cell activation potential \[1/Pa\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ecap_1_pa: Option<Distribution>,
    /// Transverse wall shear stress \[Pa\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub transverse_wss_pa: Option<Distribution>,
    /// Largest wall shear stress of the cycle \[Pa\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub peak_wss_pa: Option<Distribution>,
}

/// How a quantity is distributed over the area of the wall.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Distribution {
    /// Mean.
    #[serde(deserialize_with = "json::number")]
    pub mean: f64,
    /// Value that 1 % of the area does not exceed.
    #[serde(deserialize_with = "json::number")]
    pub percentile_1: f64,
    /// Value that half of the area does not exceed.
    #[serde(deserialize_with = "json::number")]
    pub median: f64,
    /// Value that 99 % of the area does not exceed.
    #[serde(deserialize_with = "json::number")]
    pub percentile_99: f64,
    /// Part of the area without a value \[-\].
    #[serde(deserialize_with = "json::number")]
    pub missing: f64,
}

impl Distribution {
    /// Distribution of one value a point, where each point stands for its `area`; NaN is no value, and no area does not count.
    /// `None` where no point has a value.
    ///
    /// # Panics
    /// When there is not one area a value.
    pub fn by_area(value: &[f64], area: &[f64]) -> Option<Self> {
        assert_eq!(value.len(), area.len(), "one area a value");
        let unknown: f64 = value.iter().zip(area).filter(|(v, _)| v.is_nan()).map(|(_, a)| a).sum();
        let pairs = value.iter().copied().zip(area.iter().copied());
        let mut known: Vec<(f64, f64)> = pairs.filter(|(v, a)| !v.is_nan() && *a > 0.0).collect();
        known.sort_by(|a, b| a.0.total_cmp(&b.0));
        let covered: f64 = known.iter().map(|(_, a)| a).sum();
        let &(largest, _) = known.last()?;
        let percentile = |part: f64| {
            let mut below = 0.0;
            let reached = known.iter().find(|(_, a)| {
                below += a;
                below >= part * covered
            });
            reached.map_or(largest, |(value, _)| *value)
        };
        Some(Self {
            mean: known.iter().map(|(v, a)| v * a).sum::<f64>() / covered,
            percentile_1: percentile(0.01),
            median: percentile(0.5),
            percentile_99: percentile(0.99),
            missing: unknown / (covered + unknown),
        })
    }

    /// Part of the area, as far as it has a value, where the value is below `limit`; `None` where no point has one.
    ///
    /// # Panics
    /// When there is not one area a value.
    pub fn fraction_below(limit: f64, value: &[f64], area: &[f64]) -> Option<f64> {
        assert_eq!(value.len(), area.len(), "one area a value");
        let known = || value.iter().zip(area).filter(|(v, _)| !v.is_nan());
        let sum =
            |keep: &dyn Fn(f64) -> bool| known().filter(|(v, _)| keep(**v)).map(|(_, a)| a).sum::<f64>();
        let covered = sum(&|_| true);
        (covered > 0.0).then(|| sum(&|v| v < limit) / covered)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The values 0 to 999 in disorder, those below 500 on three times the area of the others: the median of the area is
    /// at two thirds of the lower half.
    #[test]
    fn percentiles_go_by_area() {
        let value: Vec<f64> = (0..1000).map(|k| f64::from(k * 271 % 1000)).collect();
        let area: Vec<f64> = value.iter().map(|v| if *v < 500.0 { 0.3 } else { 0.1 }).collect();
        let found = Distribution::by_area(&value, &area).expect("values");
        assert!((found.mean - (0.75 * 249.5 + 0.25 * 749.5)).abs() < 1e-9, "{found:?}");
        assert!((found.median - 1000.0 / 3.0).abs() <= 1.0, "{found:?}");
        assert!((found.percentile_1 - 20.0 / 3.0).abs() <= 1.0 && (found.percentile_99 - 980.0).abs() <= 1.0);
        assert_eq!(found.missing, 0.0);
        let below = Distribution::fraction_below(250.0, &value, &area).expect("values");
        assert!((below - 0.375).abs() < 1e-12);
    }

    #[test]
    fn what_has_no_value_is_told_and_does_not_count() {
        let (value, area) = ([f64::NAN, 2.0, 4.0, 100.0], [2.0, 1.0, 1.0, 0.0]);
        let found = Distribution::by_area(&value, &area).expect("values");
        assert_eq!((found.mean, found.percentile_99, found.missing), (3.0, 4.0, 0.5));
        assert_eq!(Distribution::fraction_below(3.0, &value, &area), Some(0.5));
        assert_eq!(Distribution::by_area(&[f64::NAN], &[1.0]), None);
        assert_eq!(Distribution::fraction_below(3.0, &[], &[]), None);
    }
}
