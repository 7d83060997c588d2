//! Bodies for tests, and the static solution of small loads.

#![allow(dead_code)] // each test file uses some of it

use glam::DVec3;
use std::f64::consts::TAU;
use vaso_shell::{Particles, Shell};

/// Particles of a shell.
#[derive(Clone, Default)]
pub(crate) struct Body {
    pub(crate) position: Vec<DVec3>,
    pub(crate) normal: Vec<DVec3>,
    pub(crate) area: Vec<f64>,
    pub(crate) thickness: Vec<f64>,
}

impl Body {
    pub(crate) fn particles(&self) -> Particles<'_> {
        Particles {
            position: &self.position,
            normal: &self.normal,
            area: &self.area,
            thickness: &self.thickness,
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.position.len()
    }

    /// Numbers of all particles.
    pub(crate) fn all(&self) -> Vec<u32> {
        (0..self.len() as u32).collect()
    }

    /// Numbers of the particles for which `is_in` holds.
    pub(crate) fn select(&self, is_in: impl Fn(DVec3) -> bool) -> Vec<u32> {
        (0..self.len() as u32).filter(|&i| is_in(self.position[i as usize])).collect()
    }

    /// Particle nearest to a place.
    pub(crate) fn nearest(&self, place: DVec3) -> usize {
        let distance = |i: &usize| self.position[*i].distance_squared(place);
        (0..self.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("there are particles")
    }

    /// Particles within `reach` of a place with the shares of a force there, after the kernel: a force on one particle alone would
    /// move it out of its neighbours.
    pub(crate) fn patch(&self, place: DVec3, reach: f64) -> Vec<(usize, f64)> {
        let weight = |i: usize| {
            let u = (1.0 - self.position[i].distance(place) / reach).max(0.0);
            self.area[i] * u.powi(4) * (5.0 - 4.0 * u)
        };
        let sum: f64 = (0..self.len()).map(weight).sum();
        (0..self.len()).map(|i| (i, weight(i) / sum)).filter(|(_, share)| *share > 0.0).collect()
    }

    fn add(&mut self, position: DVec3, normal: DVec3, area: f64, thickness: f64) {
        self.position.push(position);
        self.normal.push(normal);
        self.area.push(area);
        self.thickness.push(thickness);
    }
}

/// Numbers from -1 to 1, always the same.
pub(crate) fn noise() -> impl FnMut() -> f64 {
    let mut state = 5_u64;
    move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
    }
}

/// Where `n` particles stand over a length: in the middle of their cells, or also on both ends, there with half a cell.
#[derive(Clone, Copy)]
pub(crate) enum Rows {
    Inside(usize),
    OnEnds(usize),
}

impl Rows {
    /// Places from 0 to `length`, with the length of each cell.
    pub(crate) fn along(self, length: f64) -> Vec<(f64, f64)> {
        match self {
            Self::Inside(n) => {
                let d = length / n as f64;
                (0..n).map(|k| ((k as f64 + 0.5) * d, d)).collect()
            }
            Self::OnEnds(n) => {
                let d = length / (n - 1) as f64;
                let cell = |k: usize| if k == 0 || k == n - 1 { 0.5 * d } else { d };
                (0..n).map(|k| (k as f64 * d, cell(k))).collect()
            }
        }
    }
}

/// Part of a cylinder around the z axis from the angle `from` over `arc`, moved by up to `jitter` cells.
pub(crate) fn cylinder(
    (radius, length, thickness): (f64, f64, f64),
    (from, arc): (f64, f64),
    (around, along): (Rows, Rows),
    jitter: f64,
) -> Body {
    let mut body = Body::default();
    let mut next = noise();
    for (s, ds) in around.along(radius * arc) {
        for (z, dz) in along.along(length) {
            let angle = from + (s + jitter * ds * next()) / radius;
            let z = z + jitter * dz * next();
            let normal = DVec3::new(angle.cos(), angle.sin(), 0.0);
            body.add(radius * normal + z * DVec3::Z, normal, ds * dz, thickness);
        }
    }
    body
}

/// A whole tube around the z axis of `around` by `along` particles.
pub(crate) fn tube(size: (f64, f64, f64), around: usize, along: usize, jitter: f64) -> Body {
    cylinder(size, (0.0, TAU), (Rows::Inside(around), Rows::Inside(along)), jitter)
}

/// A plate in the plane z = 0 from the origin on.
pub(crate) fn plate(size: [f64; 2], thickness: f64, [x, y]: [Rows; 2]) -> Body {
    let mut body = Body::default();
    for (x, dx) in x.along(size[0]) {
        for (y, dy) in y.along(size[1]) {
            body.add(DVec3::new(x, y, 0.0), DVec3::Z, dx * dy, thickness);
        }
    }
    body
}

/// Displacements and changes of the director, in the order of the columns.
#[derive(Clone)]
pub(crate) struct Field {
    u: Vec<DVec3>,
    n: Vec<DVec3>,
}

impl Field {
    fn zero(n: usize) -> Self {
        Self { u: vec![DVec3::ZERO; n], n: vec![DVec3::ZERO; n] }
    }

    fn dot(&self, other: &Self) -> f64 {
        let sum = |a: &[DVec3], b: &[DVec3]| a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum::<f64>();
        sum(&self.u, &other.u) + sum(&self.n, &other.n)
    }

    fn add(&mut self, factor: f64, other: &Self) {
        for (a, b) in self.u.iter_mut().zip(&other.u).chain(self.n.iter_mut().zip(&other.n)) {
            *a += factor * *b;
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        let mut field = Self::zero(self.u.len());
        field.add(factor, self);
        field
    }
}

/// Static displacements \[m\] under small `forces` \[N\] on the particles as given, in the same order. The shell is left in its
/// reference configuration.
pub(crate) fn small_displacements(shell: &mut Shell<f64>, forces: &[DVec3], tolerance: f64) -> Vec<DVec3> {
    let n = shell.state.len();
    let mut load = Field::zero(n);
    for (i, force) in forces.iter().enumerate() {
        load.u[shell.place(i)] = *force;
    }
    let solution = solve(shell, load, tolerance);
    (0..n).map(|i| solution.u[shell.place(i)]).collect()
}

/// Lowest frequency \[rad/s\] of a shell that is held, by inverse iteration from the sag under its weight along `direction`.
pub(crate) fn lowest_frequency(shell: &mut Shell<f64>, direction: DVec3) -> f64 {
    let mut field = Field::zero(shell.state.len());
    field.u.fill(direction);
    let mut square = 0.0;
    for _ in 0..5 {
        let load = inertia_of(shell, &field);
        let next = solve(shell, load.clone(), 1e-7);
        // u K u / u M u, where K u is the load.
        square = next.dot(&load) / next.dot(&inertia_of(shell, &next));
        field = next.scaled(square);
    }
    square.sqrt()
}

fn inertia_of(shell: &Shell<f64>, field: &Field) -> Field {
    let mut load = field.clone();
    for i in 0..load.u.len() {
        load.u[i] *= shell.state.mass[i];
        load.n[i] *= shell.state.rotary_inertia[i];
    }
    load
}

/// Solves for a small displacement by conjugate gradients with the masses as preconditioner.
fn solve(shell: &mut Shell<f64>, load: Field, tolerance: f64) -> Field {
    let mut rest = load;
    hold(shell, &mut rest);
    let mut solution = Field::zero(rest.u.len());
    let mut z = preconditioned(shell, &rest);
    let mut direction = z.clone();
    let mut product = rest.dot(&z);
    let first = product;
    let mut count = 0;
    while product > tolerance * tolerance * first {
        let stiff = stiffness_times(shell, &direction);
        let step = product / direction.dot(&stiff);
        solution.add(step, &direction);
        rest.add(-step, &stiff);
        z = preconditioned(shell, &rest);
        let next = rest.dot(&z);
        let mut new = z.clone();
        new.add(next / product, &direction);
        direction = new;
        product = next;
        count += 1;
        assert!(count < 100_000, "{product:e} of {first:e} after {count} iterations");
    }
    println!("{count} iterations for {} particles", solution.u.len());
    solution
}

fn hold(shell: &Shell<f64>, field: &mut Field) {
    for i in 0..field.u.len() {
        let (support, director) = (shell.support(i), shell.state.reference_director[i]);
        field.u[i] = support.displacement.of(field.u[i]);
        let w = support.director.of(field.n[i]);
        field.n[i] = w - w.dot(director) * director;
    }
}

fn preconditioned(shell: &Shell<f64>, field: &Field) -> Field {
    let mut z = field.clone();
    for i in 0..z.u.len() {
        z.u[i] /= shell.state.mass[i];
        z.n[i] /= shell.state.rotary_inertia[i];
    }
    z
}

/// Forces that hold a small displacement, by a step so small that the shell answers linearly.
fn stiffness_times(shell: &mut Shell<f64>, direction: &Field) -> Field {
    let spacing = shell.numbers().spacing;
    let top = |v: &[DVec3]| v.iter().map(|v| v.length()).fold(0.0, f64::max);
    let size = (top(&direction.u) / spacing).max(top(&direction.n));
    let factor = 1e-7 / size;
    let small = direction.scaled(factor);
    for i in 0..small.u.len() {
        shell.state.displacement[i] = small.u[i];
        shell.state.director[i] = (shell.state.reference_director[i] + small.n[i]).normalize();
    }
    shell.refresh().expect("a small displacement");
    let mut forces = Field::zero(small.u.len());
    for i in 0..small.u.len() {
        forces.u[i] = (-shell.state.mass[i] / factor) * shell.state.acceleration[i];
        forces.n[i] = (-shell.state.rotary_inertia[i] / factor) * shell.state.director_acceleration[i];
    }
    hold(shell, &mut forces);
    for i in 0..small.u.len() {
        shell.state.displacement[i] = DVec3::ZERO;
        shell.state.director[i] = shell.state.reference_director[i];
    }
    forces
}

/// Highest frequency of the shell \[rad/s\] at rest, by power iteration from noise.
pub(crate) fn highest_frequency(shell: &mut Shell<f64>) -> f64 {
    let mut next = noise();
    let mut field = Field::zero(shell.state.len());
    let spacing = shell.numbers().spacing;
    for k in 0..field.u.len() {
        field.u[k] = spacing * DVec3::new(next(), next(), next());
        field.n[k] = DVec3::new(next(), next(), next());
    }
    hold(shell, &mut field);
    let mut square = 0.0;
    for _ in 0..400 {
        let stiff = stiffness_times(shell, &field);
        let z = preconditioned(shell, &stiff);
        // Rayleigh quotient, with the mass as the metric.
        square = z.dot(&stiff) / stiff.dot(&field);
        field = z.scaled(1.0 / square);
    }
    square.sqrt()
}
