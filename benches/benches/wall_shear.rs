//! Wall shear stress and its sums over a cycle, one core.
//!
//! `cargo bench -p vaso-benches --bench wall_shear`; the time a point of the wall is criterion's time over the number of
//! elements it prints.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;
use std::hint::black_box;
use vaso_geometry::{DistanceGrid, LengthUnit, SignedDistance, prepare, shapes};
use vaso_metrics::{NearWallDistance, ShearCycles, Viscosity, WallShear};
use vaso_particles::WallDistance;

/// Spacings across the pipe.
const ACROSS: f64 = 20.0;
/// Length of the pipe \[spacings\].
const LENGTH: f64 = 100.0;

/// Pipe about z; lengths in spacings.
struct Pipe;

impl WallDistance for Pipe {
    fn sample(&self, x: DVec3) -> (f64, DVec3) {
        let r = x.with_z(0.0);
        (r.length() - 0.5 * ACROSS, r.normalize_or_zero())
    }
}

/// Interpolated distance, as the fluid of a run has it.
struct Coarse(DistanceGrid);

impl WallDistance for Coarse {
    fn sample(&self, x: DVec3) -> (f64, DVec3) {
        self.0.sample(x)
    }
}

/// Lattice sites in the pipe, each moved by up to 0.15 spacings along each axis.
fn particles() -> Vec<DVec3> {
    let mut state = 3_u64;
    let mut next = move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let (n, length) = (ACROSS as u64, LENGTH as u64);
    (0..n * n * length)
        .map(|k| {
            let site = DVec3::new((k % n) as f64, (k / n % n) as f64, (k / n / n) as f64) + 0.5;
            let corner = DVec3::new(0.5 * ACROSS, 0.5 * ACROSS, 0.0);
            site - corner + 0.3 * DVec3::new(next(), next(), next())
        })
        .filter(|x| Pipe.sample(*x).0 < -0.2)
        .collect()
}

/// One point of the wall a square of the spacing.
fn points() -> (Vec<DVec3>, Vec<DVec3>) {
    let around = (std::f64::consts::PI * ACROSS).round() as u32;
    (0..around * LENGTH as u32)
        .map(|k| {
            let angle = std::f64::consts::TAU * f64::from(k % around) / f64::from(around);
            let normal = DVec3::new(angle.cos(), angle.sin(), 0.0);
            (0.5 * ACROSS * normal + (f64::from(k / around) + 0.5) * DVec3::Z, normal)
        })
        .unzip()
}

fn benches(criterion: &mut Criterion) {
    // One core: the figures are to be compared with those of a single loop.
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("nothing has started threads yet");
    let particles = particles();
    let velocity: Vec<DVec3> =
        particles.iter().map(|x| (1.0 - x.with_z(0.0).length_squared() / 100.0) * DVec3::Z).collect();
    let (position, normal) = points();
    let wall = WallShear::new(position, normal.clone(), 1.0).expect("a spacing of one");
    let evaluate = |viscosity| {
        wall.evaluate(black_box(&particles), black_box(&velocity), &Pipe, viscosity).expect("equal lengths")
    };
    let mut group = criterion.benchmark_group("wall-shear");
    group.throughput(Throughput::Elements(normal.len() as u64));
    group.bench_function("constant", |b| b.iter(|| evaluate(Viscosity::Constant(3.5e-3))));
    let pipe = shapes::pipe(0.5 * ACROSS, LENGTH, DVec3::Z, 96);
    let vessel = prepare(pipe, Some(LengthUnit::Metre)).expect("a pipe");
    let exact = SignedDistance::wall(&vessel);
    let coarse = Coarse(DistanceGrid::build(&exact, vessel.surface.bounds(), 1.0, 5.0));
    let distance = NearWallDistance { coarse: &coarse, exact: &exact, reach: wall.reach() };
    group.bench_function("on-triangles", |b| {
        b.iter(|| {
            wall.evaluate(black_box(&particles), &velocity, &distance, Viscosity::Constant(3.5e-3))
                .expect("equal lengths")
        });
    });
    let law = |rate: f64| 3.5e-3 + 0.05 * (1.0 + rate * rate).powf(-0.4);
    group.bench_function("by-shear-rate", |b| b.iter(|| evaluate(Viscosity::ShearRate(&law))));

    let mut sums = ShearCycles::new(normal, 0.0, 1.0).expect("a period of one");
    let samples = [1.0, -0.5].map(|scale| -> Vec<Option<DVec3>> {
        let sample = evaluate(Viscosity::Constant(scale * 3.5e-3));
        sample.stress
    });
    let mut step = 0_u32;
    group.bench_function("cycle-sums", |b| {
        b.iter(|| {
            step += 1;
            sums.add(0.01 * f64::from(step), &samples[step as usize % 2]).expect("equal lengths")
        });
    });
    group.finish();
}

criterion_group! {
    name = wall_shear;
    config = Criterion::default().sample_size(10);
    targets = benches
}
criterion_main!(wall_shear);
