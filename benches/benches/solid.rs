//! Pair loops and sub-steps of a total-Lagrangian solid, one core, each instruction set and precision.
//!
//! `cargo bench -p vaso-benches --bench solid`; the time a particle is criterion's time over the number of elements it
//! prints. The loops at "double/scalar" are the reference for their speed.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;
use std::hint::black_box;
use vaso_benches::SPACING;
use vaso_kernels::{
    CHUNK, CellGrid, Frame, Gather, PairLaw, Records, Rows, SearchSet, Store, Wendland, sweep,
};
use vaso_solid::law::{force, strain};
use vaso_solid::{Isa, Material, NeoHookean, Numbers, Particles, Real, Solid};

/// Particles along an edge: 2e5 in all, more than the caches hold.
const EDGE: usize = 58;
/// Sub-steps an iteration.
const STEPS: usize = 5;

/// A cube of lattice sites, each moved by up to 0.1 spacings along each axis.
fn cube() -> Vec<DVec3> {
    let mut state = 3_u64;
    let mut next = move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    (0..EDGE.pow(3))
        .map(|k| {
            let site = DVec3::new((k % EDGE) as f64, (k / EDGE % EDGE) as f64, (k / EDGE / EDGE) as f64);
            SPACING * (site + 0.2 * DVec3::new(next(), next(), next()))
        })
        .collect()
}

fn all_rows<R: Real, P: PairLaw<R, K>, const K: usize>(
    isa: Isa,
    law: &P,
    gather: &Gather<R>,
    rows: &Rows,
) -> f64 {
    let mut check = 0.0;
    for (c, row) in rows.chunks().iter().enumerate() {
        let mut sums = [[0.0; K]; CHUNK];
        sweep(isa, law, gather, (row, c * CHUNK), Store::None, &mut sums);
        check += sums[0][0];
    }
    check
}

fn loops<R: Real>(criterion: &mut Criterion, position: &[DVec3]) {
    let mut group = criterion.benchmark_group(format!("solid-loops-{}", R::PRECISION));
    group.throughput(Throughput::Elements(position.len() as u64));
    let support = Wendland::new(1.15 * SPACING).support();
    let bounds = (DVec3::splat(-SPACING), DVec3::splat(EDGE as f64 * SPACING));
    let frame = Frame::new(bounds, support);
    let mut grid = CellGrid::new(bounds, support);
    let mut order = Vec::new();
    grid.sort(position, &mut order);
    let sorted: Vec<DVec3> = order.iter().map(|&k| position[k as usize]).collect();
    let mut set = SearchSet::default();
    set.fill(&frame, &sorted);
    let (mut records, mut second) = (Records::<R>::default(), Records::<R>::default());
    records.resize(sorted.len());
    second.resize(sorted.len());
    records.fill(|i| {
        let (fixed, x) = (set.get(i), frame.in_supports(sorted[i]));
        let u = [0, 1, 2].map(|c| R::coordinate(fixed[c] / 64, x[c] / 64.0));
        let x = [0, 1, 2].map(|c| R::coordinate(fixed[c], x[c]));
        [x[0], x[1], x[2], R::pack(SPACING.powi(3)), u[0], u[1], u[2], R::pack(1e3)]
    });
    second.fill(|i| [0, 1, 2, 3, 4, 5, 6, 7].map(|k| R::pack(1e3 * ((i + k) % 7) as f64)));
    let gather = Gather {
        frame: &frame,
        own: &records,
        other: &records,
        own_second: Some(&second),
        other_second: Some(&second),
    };
    for isa in Isa::available() {
        let mut rows = Rows::default();
        rows.build(isa, &frame, (&set, &sorted), &set, &grid, true);
        group.bench_function(BenchmarkId::new("strain", isa.name()), |b| {
            b.iter(|| all_rows(isa, &strain::DisplacementGradient, black_box(&gather), &rows));
        });
        group.bench_function(BenchmarkId::new("damped-strain", isa.name()), |b| {
            b.iter(|| all_rows(isa, &strain::DampedGradient, black_box(&gather), &rows));
        });
        group.bench_function(BenchmarkId::new("force", isa.name()), |b| {
            b.iter(|| all_rows(isa, &force::Force { hourglass: 1e4 }, black_box(&gather), &rows));
        });
    }
    group.finish();
}

fn substeps<R: Real>(criterion: &mut Criterion, position: &[DVec3]) {
    let mut group = criterion.benchmark_group(format!("solid-substep-{}", R::PRECISION));
    group.throughput(Throughput::Elements((STEPS * position.len()) as u64));
    let volume = vec![SPACING.powi(3); position.len()];
    let material = Material::NeoHookean(NeoHookean::new(4e5, 0.45).expect("in range"));
    let usual = Numbers::new(1120.0, SPACING);
    let undamped = Numbers { damping: 0.0, ..usual };
    for (name, numbers) in [("usual", usual), ("undamped", undamped)] {
        for isa in Isa::available() {
            let particles = Particles { position, volume: &volume, ..Particles::default() };
            let mut solid = Solid::<R>::new(&particles, material, numbers, isa).expect("a sound body");
            for (v, x) in solid.state.velocity.iter_mut().zip(solid.state.reference_position.iter()) {
                *v = 0.1 * DVec3::new((300.0 * x.y).sin(), (200.0 * x.z).sin(), (100.0 * x.x).sin());
            }
            let dt = STEPS as f64 * solid.stable_step();
            group.bench_function(BenchmarkId::new(name, isa.name()), |b| {
                b.iter(|| solid.advance_in(dt, STEPS).expect("a gentle motion"));
            });
        }
    }
    group.finish();
}

fn benches(criterion: &mut Criterion) {
    // One core: the figures are to be compared with those of a single loop.
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("nothing has started threads yet");
    let position = cube();
    loops::<f32>(criterion, &position);
    loops::<f64>(criterion, &position);
    substeps::<f32>(criterion, &position);
    substeps::<f64>(criterion, &position);
}

criterion_group! {
    name = solid;
    config = Criterion::default().sample_size(10);
    targets = benches
}
criterion_main!(solid);
