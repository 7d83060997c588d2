//! What is read off a flow in a pipe.

use std::f64::consts::TAU;

use glam::{DMat4, DVec3, DVec4};
use num_complex::Complex64;
use vaso_driver::{Flow, Plan};
use vaso_fluid::FluidState;
use vaso_metrics::{Viscosity, WallShear};
use vaso_particles::WallDistance;

use crate::pipe::Pipe;

/// A flow at its end.
pub struct Flown {
    /// Fluid particles.
    pub particles: usize,
    /// Particles that left through the wall.
    pub escaped: u64,
    /// Largest density deviation, relative.
    pub density: f64,
    /// Time of the loop \[s\].
    pub seconds: f64,
}

/// Runs a pipe to its end, and shows each advective step to `see`.
///
/// # Panics
/// When the flow breaks down.
pub fn fly(pipe: &Pipe, mut see: impl FnMut(&Flow<f32>, &Plan)) -> Flown {
    let (mut flow, _, plan) = pipe.flow::<f32>();
    fly_on(&mut flow, plan.end_time, |flow| see(flow, &plan))
}

/// Runs a flow to `end` \[s\], and shows each advective step to `see`.
///
/// # Panics
/// When the flow breaks down.
pub fn fly_on(flow: &mut Flow<f32>, end: f64, mut see: impl FnMut(&Flow<f32>)) -> Flown {
    while flow.time < end {
        flow.step(end).unwrap_or_else(|e| panic!("{e}"));
        see(flow);
    }
    Flown {
        particles: flow.fluid.state.len(),
        escaped: flow.watch.escaped,
        density: flow.watch.max_density_error,
        seconds: flow.ledger.total(),
    }
}

/// Flow through a pipe \[m^3/s\]: the mean over the slab between two distances from the inlet, parts of the length.
pub fn flow_within(pipe: &Pipe, state: &FluidState, density: f64, [from, to]: [f64; 2]) -> f64 {
    let axis = pipe.axis.normalize();
    let carried = state.position.iter().zip(state.velocity.iter()).zip(state.mass.iter());
    let sum: f64 = carried
        .filter(|((x, _), _)| (from..to).contains(&(pipe.place(**x).0 / pipe.length)))
        .map(|((_, v), m)| v.dot(axis) * m / density)
        .sum();
    sum / ((to - from) * pipe.length)
}

/// Slope of the pressure along a pipe \[Pa/m\], fitted to the particles of a slab.
pub fn pressure_slope(pipe: &Pipe, flow: &Flow<f32>, [from, to]: [f64; 2]) -> f64 {
    let mut line = Line::default();
    for (i, &x) in flow.fluid.state.position.iter().enumerate() {
        let z = pipe.place(x).0;
        if (from..to).contains(&(z / pipe.length)) {
            line.add(z, flow.fluid.pressure(i));
        }
    }
    line.slope()
}

/// Least-squares line through points.
#[derive(Clone, Copy, Debug, Default)]
pub struct Line {
    n: f64,
    x: f64,
    y: f64,
    xx: f64,
    xy: f64,
}

impl Line {
    /// Takes a point.
    pub fn add(&mut self, x: f64, y: f64) {
        self.n += 1.0;
        self.x += x;
        self.y += y;
        self.xx += x * x;
        self.xy += x * y;
    }

    /// Its slope.
    pub fn slope(&self) -> f64 {
        (self.n * self.xy - self.x * self.y) / (self.n * self.xx - self.x * self.x)
    }

    /// Its value at `x`.
    pub fn at(&self, x: f64) -> f64 {
        self.y / self.n + self.slope() * (x - self.x / self.n)
    }
}

/// Values in time.
#[derive(Clone, Debug, Default)]
pub struct Series {
    /// Times \[s\] with their values.
    pub points: Vec<(f64, f64)>,
}

impl Series {
    /// Takes a value.
    pub fn add(&mut self, t: f64, value: f64) {
        self.points.push((t, value));
    }

    /// Points from a time on.
    pub fn from(&self, t: f64) -> Self {
        Self { points: self.points.iter().copied().filter(|p| p.0 >= t).collect() }
    }

    /// Mean of the points.
    pub fn mean(&self) -> f64 {
        self.points.iter().map(|p| p.1).sum::<f64>() / self.points.len() as f64
    }

    /// Means over consecutive stretches of `length` \[s\], at the mean of their times.
    pub fn smoothed(&self, length: f64) -> Self {
        let mut points = Vec::new();
        let mut rest = self.points.as_slice();
        while let Some(&(first, _)) = rest.first() {
            let n = rest.partition_point(|p| p.0 < first + length).max(1);
            let (now, later) = rest.split_at(n);
            let sum = now.iter().fold((0.0, 0.0), |sum, p| (sum.0 + p.0, sum.1 + p.1));
            points.push((sum.0 / n as f64, sum.1 / n as f64));
            rest = later;
        }
        Self { points }
    }

    /// Largest difference from `exact`.
    pub fn largest_difference(&self, exact: impl Fn(f64) -> f64) -> f64 {
        self.points.iter().map(|&(t, y)| (y - exact(t)).abs()).fold(0.0, f64::max)
    }

    /// What they differ from `exact` by.
    pub fn minus(&self, exact: impl Fn(f64) -> f64) -> Self {
        Self { points: self.points.iter().map(|&(t, y)| (t, y - exact(t))).collect() }
    }

    /// Complex amplitude of the wave `Re(a e^(i w t))` in them, with `w` of a period \[s\], beside a straight line.
    ///
    /// The points have to span whole periods.
    pub fn wave(&self, period: f64) -> Complex64 {
        let (mut normal, mut right) = (DMat4::ZERO, DVec4::ZERO);
        let middle = self.points.iter().map(|p| p.0).sum::<f64>() / self.points.len() as f64;
        for &(t, y) in &self.points {
            let (sin, cos) = (TAU * t / period).sin_cos();
            let row = DVec4::new(1.0, (t - middle) / period, cos, sin);
            normal += DMat4::from_cols(row * row.x, row * row.y, row * row.z, row * row.w);
            right += row * y;
        }
        let fit = normal.inverse() * right;
        Complex64::new(fit.z, -fit.w)
    }
}

/// Wall shear stress on the middle of a pipe.
pub struct Shear {
    wall: WallShear,
    axis: DVec3,
    distance: PipeWall,
    viscosity: f64,
    sum: Vec<f64>,
    samples: f64,
}

/// Signed distance to an endless pipe.
struct PipeWall {
    origin: DVec3,
    axis: DVec3,
    radius: f64,
}

impl WallDistance for PipeWall {
    fn sample(&self, x: DVec3) -> (f64, DVec3) {
        let across = (x - self.origin) - (x - self.origin).dot(self.axis) * self.axis;
        (across.length() - self.radius, across.normalize_or(self.axis.any_orthonormal_vector()))
    }
}

/// Points of [`Shear`] around the pipe, and rings of them.
const AROUND: usize = 24;
const RINGS: usize = 12;

impl Shear {
    /// On rings between two distances from the inlet, parts of the length.
    ///
    /// # Panics
    /// Never: the points are sound.
    pub fn new(pipe: &Pipe, [from, to]: [f64; 2]) -> Self {
        let axis = pipe.axis.normalize();
        let first = axis.any_orthonormal_vector();
        let second = axis.cross(first);
        let (mut position, mut normal) = (Vec::new(), Vec::new());
        for ring in 0..RINGS {
            let z = pipe.length * (from + (to - from) * (ring as f64 + 0.5) / RINGS as f64);
            for k in 0..AROUND {
                let (sin, cos) = (TAU * k as f64 / AROUND as f64).sin_cos();
                let out = cos * first + sin * second;
                position.push(pipe.origin + z * axis + pipe.radius() * out);
                normal.push(out);
            }
        }
        let n = position.len();
        let wall = WallShear::new(position, normal, pipe.spacing()).expect("one normal a point");
        let distance = PipeWall { origin: pipe.origin, axis, radius: pipe.radius() };
        Self { wall, axis, distance, viscosity: pipe.viscosity, sum: vec![0.0; n], samples: 0.0 }
    }

    /// Mean over the wall of the stress along the pipe \[Pa\] now.
    ///
    /// # Panics
    /// When a point has too few particles near it.
    pub fn take(&mut self, state: &FluidState) -> f64 {
        let viscosity = Viscosity::Constant(self.viscosity);
        let sample = self
            .wall
            .evaluate(&state.position, &state.velocity, &self.distance, viscosity)
            .expect("columns of a state are of one length");
        let stress: Vec<f64> =
            sample.stress.iter().map(|s| s.expect("the pipe is filled").dot(self.axis)).collect();
        self.samples += 1.0;
        self.sum.iter_mut().zip(&stress).for_each(|(sum, stress)| *sum += stress);
        stress.iter().sum::<f64>() / stress.len() as f64
    }

    /// Mean in time of the stress along the pipe at each point \[Pa\].
    pub fn means(&self) -> Vec<f64> {
        self.sum.iter().map(|sum| sum / self.samples).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wave_is_found_beside_a_drift() {
        let mut series = Series::default();
        for k in 0..400 {
            let t = 0.3 + 1e-2 * f64::from(k);
            series.add(t, 5.0 + 0.7 * t + 2.0 * (TAU * t / 0.8 - 0.6).cos());
        }
        let wave = series.wave(0.8);
        assert!((wave.norm() - 2.0).abs() < 1e-9 && (wave.arg() + 0.6).abs() < 1e-9, "{wave}");
    }
}
