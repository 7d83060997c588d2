//! Developed flow of a shear-thinning fluid in a pipe, by its equations of one dimension.

use vaso_fluid::Rheology;

/// Steps of the quadrature across the radius.
const STEPS: usize = 2000;

/// Developed flow in a round pipe: `G r / 2 = eta(g) g` at every radius, `u` the integral of `g` from the wall.
pub struct Developed {
    radius: f64,
    /// Pressure gradient G \[Pa/m\].
    pub gradient: f64,
    /// Velocity at even radii from the axis to the wall \[m/s\].
    velocity: Vec<f64>,
}

impl Developed {
    /// Flow of mean velocity `mean` \[m/s\] in a pipe of `radius` \[m\].
    pub fn new(rheology: &Rheology, radius: f64, mean: f64) -> Self {
        let flow = |gradient| Self::driven(rheology, radius, gradient);
        let (mut low, mut high) = (0.0, 1.0);
        while flow(high).mean() < mean {
            high *= 2.0;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if flow(middle).mean() < mean { low = middle } else { high = middle }
        }
        flow(high)
    }

    /// Flow driven by a pressure gradient \[Pa/m\].
    pub fn driven(rheology: &Rheology, radius: f64, gradient: f64) -> Self {
        let step = radius / STEPS as f64;
        let mut velocity = vec![0.0; STEPS + 1];
        for k in (0..STEPS).rev() {
            let middle = (k as f64 + 0.5) * step;
            velocity[k] = velocity[k + 1] + step * shear_rate(rheology, 0.5 * gradient * middle);
        }
        Self { radius, gradient, velocity }
    }

    /// Mean velocity \[m/s\].
    pub fn mean(&self) -> f64 {
        let ring = |k: usize| {
            let r = (k as f64 + 0.5) / STEPS as f64;
            (self.velocity[k] + self.velocity[k + 1]) * r
        };
        (0..STEPS).map(ring).sum::<f64>() / STEPS as f64
    }

    /// Velocity at distance `r` \[m\] from the axis \[m/s\].
    pub fn velocity(&self, r: f64) -> f64 {
        let at = (r / self.radius).clamp(0.0, 1.0) * STEPS as f64;
        let k = (at as usize).min(STEPS - 1);
        let part = at - k as f64;
        (1.0 - part) * self.velocity[k] + part * self.velocity[k + 1]
    }

    /// Velocity on the axis \[m/s\].
    pub fn peak(&self) -> f64 {
        self.velocity[0]
    }
}

/// Shear rate at a shear stress \[Pa\]: the stress grows with it for every law here.
fn shear_rate(rheology: &Rheology, stress: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1e6);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if rheology.viscosity(middle) * middle < stress { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `u = (n / (n + 1)) (G / 2k)^(1/n) (R^(1 + 1/n) - r^(1 + 1/n))`.
    #[test]
    fn a_power_law_has_its_profile() {
        let (k, n, radius, gradient) = (0.017, 0.708, 3e-3, 200.0);
        let flow = Developed::driven(&Rheology::PowerLaw { consistency: k, index: n }, radius, gradient);
        let power = 1.0 + 1.0 / n;
        let scale = n / (n + 1.0) * (gradient / (2.0 * k)).powf(1.0 / n);
        for r in [0.0, 1e-3, 2e-3] {
            let exact = scale * (radius.powf(power) - f64::powf(r, power));
            assert!((flow.velocity(r) / exact - 1.0).abs() < 1e-4, "{} and {exact}", flow.velocity(r));
        }
        let mean = scale * radius.powf(power) * (1.0 - 2.0 / (power + 2.0));
        assert!((flow.mean() / mean - 1.0).abs() < 1e-4);
        let again = Developed::new(&Rheology::PowerLaw { consistency: k, index: n }, radius, mean);
        assert!((again.gradient / gradient - 1.0).abs() < 1e-4);
    }
}
