//! Particle sets and exact flows to hold the estimator against.

use glam::DVec3;
use vaso_generation::{Settings, fluid};
use vaso_geometry::{LengthUnit, Vessel, prepare, shapes};
use vaso_particles::WallDistance;

/// Radius of all pipes \[m\].
pub(crate) const RADIUS: f64 = 1.0;

/// Inside of a round pipe about z.
pub(crate) struct Cylinder;

impl WallDistance for Cylinder {
    fn sample(&self, x: DVec3) -> (f64, DVec3) {
        let r = x.with_z(0.0);
        (r.length() - RADIUS, r.normalize_or_zero())
    }
}

/// Radial unit vector of a pipe about z.
pub(crate) fn radial(x: DVec3) -> DVec3 {
    x.with_z(0.0).normalize_or_zero()
}

/// Numbers spread evenly over -0.5 to 0.5.
pub(crate) fn random() -> impl FnMut() -> f64 {
    let mut state = 11_u64;
    move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    }
}

/// Lattice sites moved by up to 0.2 spacings along each axis, those deeper than 0.3 spacings.
pub(crate) fn perturbed(bounds: (DVec3, DVec3), spacing: f64, distance: &dyn WallDistance) -> Vec<DVec3> {
    let n = ((bounds.1 - bounds.0) / spacing).ceil().as_u64vec3();
    let mut next = random();
    let mut sites = Vec::new();
    for k in 0..n.x * n.y * n.z {
        let site = DVec3::new((k % n.x) as f64, (k / n.x % n.y) as f64, (k / n.x / n.y) as f64) + 0.5;
        let x = bounds.0 + spacing * (site + 0.4 * DVec3::new(next(), next(), next()));
        if distance.sample(x).0 < -0.3 * spacing {
            sites.push(x);
        }
    }
    sites
}

/// A pipe fourteen spacings long, lattice sites moved at random.
pub(crate) fn perturbed_pipe(spacing: f64) -> Vec<DVec3> {
    let corner = DVec3::new(RADIUS + spacing, RADIUS + spacing, 0.0);
    perturbed((-corner, corner.with_z(14.0 * spacing)), spacing, &Cylinder)
}

/// The surface of that pipe.
pub(crate) fn pipe_vessel(spacing: f64) -> Vessel {
    let pipe = shapes::pipe(RADIUS, 14.0 * spacing, DVec3::Z, 128);
    prepare(pipe, Some(LengthUnit::Metre)).expect("a pipe")
}

/// The same pipe with relaxed particles.
pub(crate) fn relaxed_pipe(spacing: f64) -> Vec<DVec3> {
    fluid(&pipe_vessel(spacing), &Settings::new(spacing), &mut |_, _| {}).expect("the spacing fits").position
}

/// Points on the middle of that pipe, off both ends by more than the reach of the fit.
pub(crate) fn pipe_wall(spacing: f64) -> (Vec<DVec3>, Vec<DVec3>) {
    let ring = |k: u32| f64::from(k) * 2.399_963; // golden angle: every point sees the particles at another place
    let normal: Vec<DVec3> = (0..400).map(|k| DVec3::new(ring(k).cos(), ring(k).sin(), 0.0)).collect();
    let position = (0..400)
        .zip(&normal)
        .map(|(k, n)| RADIUS * n + spacing * (4.0 + 6.0 * f64::from(k) / 400.0) * DVec3::Z);
    (position.collect(), normal)
}

/// Mean and root mean square of the deviation of `found` from `exact`, over the magnitude `scale`; panics where there is none.
pub(crate) fn deviation(found: &[Option<DVec3>], exact: impl Fn(usize) -> DVec3, scale: f64) -> (DVec3, f64) {
    let difference: Vec<DVec3> =
        (0..found.len()).map(|k| (found[k].expect("a value everywhere") - exact(k)) / scale).collect();
    let n = found.len() as f64;
    let mean = difference.iter().sum::<DVec3>() / n;
    (mean, (difference.iter().map(|d| d.length_squared()).sum::<f64>() / n).sqrt())
}

/// A complex number, for Bessel functions.
#[derive(Clone, Copy)]
pub(crate) struct Complex(pub(crate) f64, pub(crate) f64);

impl Complex {
    pub(crate) fn polar(r: f64, phase: f64) -> Self {
        Self(r * phase.cos(), r * phase.sin())
    }

    pub(crate) fn times(self, b: Self) -> Self {
        Self(self.0 * b.0 - self.1 * b.1, self.0 * b.1 + self.1 * b.0)
    }

    pub(crate) fn over(self, b: Self) -> Self {
        let d = b.0 * b.0 + b.1 * b.1;
        Self((self.0 * b.0 + self.1 * b.1) / d, (self.1 * b.0 - self.0 * b.1) / d)
    }

    pub(crate) fn scaled(self, a: f64) -> Self {
        Self(a * self.0, a * self.1)
    }

    pub(crate) fn abs(self) -> f64 {
        self.0.hypot(self.1)
    }
}

/// Bessel function of the first kind and of order 0 or 1, by its series.
pub(crate) fn bessel(order: u32, z: Complex) -> Complex {
    let quarter = z.times(z).scaled(-0.25);
    let mut term = if order == 0 { Complex(1.0, 0.0) } else { z.scaled(0.5) };
    let mut sum = term;
    for k in 1..40 {
        term = term.times(quarter).scaled(1.0 / (f64::from(k) * f64::from(k + order)));
        sum = Complex(sum.0 + term.0, sum.1 + term.1);
    }
    sum
}

/// Womersley (1955) flow in a pipe of the radius above for a pressure gradient of amplitude 1 Pa/m and unit density and
/// frequency.
pub(crate) struct Womersley {
    pub(crate) alpha: f64,
}

impl Womersley {
    fn argument(&self) -> Complex {
        Complex::polar(self.alpha, 0.75 * std::f64::consts::PI)
    }

    pub(crate) fn viscosity(&self) -> f64 {
        (RADIUS / self.alpha).powi(2)
    }

    /// Axial velocity at radius `r` and phase \[m/s\].
    pub(crate) fn velocity(&self, r: f64, phase: f64) -> f64 {
        let z = self.argument();
        let ratio = bessel(0, z.scaled(r / RADIUS)).over(bessel(0, z));
        Complex(1.0 - ratio.0, -ratio.1).times(Complex(0.0, -1.0)).times(Complex::polar(1.0, phase)).0
    }

    /// Wall shear stress as a complex amplitude \[Pa\].
    pub(crate) fn stress(&self) -> Complex {
        let z = self.argument();
        let slope = z.times(bessel(1, z)).over(bessel(0, z)).times(Complex(0.0, -1.0));
        slope.scaled(-self.viscosity() / RADIUS)
    }
}
