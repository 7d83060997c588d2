//! A periodic function as a sum of harmonics.

use std::f64::consts::TAU;

/// `mean + sum_k cosine[k-1] cos(k w t) + sine[k-1] sin(k w t)` with `w = 2 pi / period`.
#[derive(Clone, Debug, PartialEq)]
pub struct Fourier {
    /// Period \[s\].
    pub period: f64,
    /// Mean over the period.
    pub mean: f64,
    /// Amplitudes of the cosines, from the first harmonic on.
    pub cosine: Vec<f64>,
    /// Amplitudes of the sines, from the first harmonic on.
    pub sine: Vec<f64>,
}

impl Fourier {
    /// The first `harmonics` of `samples` taken at `start + j period / n` \[s\].
    ///
    /// Exact for a function that has no harmonic beyond half the number of samples.
    pub fn of_samples(samples: &[f64], start: f64, period: f64, harmonics: usize) -> Self {
        let n = samples.len() as f64;
        let part = |k: usize, wave: fn(f64) -> f64| -> f64 {
            let terms = samples.iter().enumerate().map(|(j, v)| {
                let turns = k as f64 * (start / period + j as f64 / n);
                v * wave(TAU * turns.fract())
            });
            2.0 * terms.sum::<f64>() / n
        };
        Self {
            period,
            mean: samples.iter().sum::<f64>() / n,
            cosine: (1..=harmonics).map(|k| part(k, f64::cos)).collect(),
            sine: (1..=harmonics).map(|k| part(k, f64::sin)).collect(),
        }
    }

    /// Angular frequency of harmonic `k` \[rad/s\].
    pub fn frequency(&self, k: usize) -> f64 {
        TAU * k as f64 / self.period
    }

    /// Value at `t` \[s\].
    pub fn at(&self, t: f64) -> f64 {
        let turns = (t / self.period).rem_euclid(1.0);
        let waves = self.cosine.iter().zip(&self.sine).enumerate().map(|(k, (a, b))| {
            let (sin, cos) = (TAU * (k + 1) as f64 * turns).sin_cos();
            a * cos + b * sin
        });
        self.mean + waves.sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn harmonics_of_a_sum_of_waves_are_its_amplitudes() {
        let (period, start) = (0.8, 0.13);
        let f = |t: f64| 2.0 + 0.7 * (3.0 * TAU * t / period).cos() - 1.1 * (TAU * t / period).sin();
        let samples: Vec<f64> = (0..16).map(|j| f(start + period * f64::from(j) / 16.0)).collect();
        let series = Fourier::of_samples(&samples, start, period, 4);
        assert!((series.mean - 2.0).abs() < 1e-14);
        for (k, (a, b)) in [(0.0, -1.1), (0.0, 0.0), (0.7, 0.0), (0.0, 0.0)].into_iter().enumerate() {
            assert!((series.cosine[k] - a).abs() < 1e-13 && (series.sine[k] - b).abs() < 1e-13, "{series:?}");
        }
        assert!((series.at(-3.21) - f(-3.21)).abs() < 1e-12);
    }
}
