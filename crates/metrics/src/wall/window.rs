//! Means of wall shear stress over a short time, against the noise of single particles.

use crate::error::MetricsError;
use glam::DVec3;
use vaso_particles::{Column, Columns, Memory, VectorColumn, Visitor};

/// Mean over the samples of a window, say ten within a hundredth of a cycle.
///
/// A magnitude of a noisy vector is too large on the mean, and the oscillatory shear index with it: noise has to go before the
/// magnitude is taken.
#[derive(Clone, Debug)]
pub struct ShearWindow {
    /// Samples in the window.
    pub samples: u64,
    /// Sum of their times \[s\].
    pub time_sum: f64,
    sum: VectorColumn,
    count: Column<u64>,
}

impl ShearWindow {
    /// Empty window for `n` points.
    pub fn new(n: usize) -> Self {
        Self {
            samples: 0,
            time_sum: 0.0,
            sum: VectorColumn::with("sum", "Pa", vec![DVec3::ZERO; n]),
            count: Column::with("count", "", vec![0; n]),
        }
    }

    /// Takes the stress \[Pa\] of all points at `time` \[s\].
    ///
    /// # Errors
    /// When there is not one value a point.
    pub fn add(&mut self, time: f64, stress: &[Option<DVec3>]) -> Result<(), MetricsError> {
        MetricsError::length("wall shear stress", stress.len(), self.sum.len())?;
        for ((sum, count), stress) in self.sum.iter_mut().zip(self.count.iter_mut()).zip(stress) {
            if let Some(stress) = stress {
                *sum += *stress;
                *count += 1;
            }
        }
        self.samples += 1;
        self.time_sum += time;
        Ok(())
    }

    /// Mean time \[s\] and mean stress \[Pa\], `None` for points without a value in half of the samples or more; the window is
    /// empty then. Nothing where it was empty before.
    pub fn take(&mut self) -> Option<(f64, Vec<Option<DVec3>>)> {
        if self.samples == 0 {
            return None;
        }
        let samples = self.samples;
        let mean = |(sum, count): (&DVec3, &u64)| (2 * count > samples).then(|| *sum / *count as f64);
        let stress = self.sum.iter().zip(self.count.iter()).map(mean).collect();
        let time = self.time_sum / samples as f64;
        *self = Self::new(self.sum.len());
        Some((time, stress))
    }

    /// Shows all that changes, under `name`.
    pub fn remember(&mut self, name: &str, memory: &mut dyn Memory) {
        let needed = self.sum.len();
        memory.columns(name, self);
        if self.sum.len() != needed {
            memory.refuse(name, format!("it has {} points, {needed} are needed", self.sum.len()));
        }
        memory.counts(&format!("{name}.samples"), &mut [&mut self.samples]);
        memory.fields(&format!("{name}.time_sum_s"), &mut [&mut self.time_sum]);
    }
}

impl Columns for ShearWindow {
    fn visit(&mut self, visitor: &mut dyn Visitor) {
        let Self { samples: _, time_sum: _, sum, count } = self;
        visitor.vector(sum);
        visitor.integer(count);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_of_a_window() {
        let mut window = ShearWindow::new(3);
        assert_eq!(window.take(), None);
        for k in 0..4 {
            let x = f64::from(k);
            let stress = [Some(x * DVec3::X), (k > 1).then_some(DVec3::Y), (k > 0).then_some(x * DVec3::Z)];
            window.add(0.1 * x, &stress).expect("three values");
        }
        let (time, stress) = window.take().expect("four samples");
        assert!((time - 0.15).abs() < 1e-15);
        assert_eq!(stress, [Some(1.5 * DVec3::X), None, Some(2.0 * DVec3::Z)]);
        assert_eq!(window.take(), None);
        assert!(window.add(0.0, &[None]).is_err());
    }
}
