//! Pair loops and the list build, one core, each instruction set and precision.
//!
//! `cargo bench -p vaso-benches --bench pairs`; the time a particle is criterion's time over the
//! number of elements it prints.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use vaso_benches::Cube;
use vaso_fluid::law::{density, moments, pressure, viscosity};
use vaso_kernels::{CHUNK, Gather, Isa, PairLaw, PairStore, Real, Rows, Store, sweep};

/// Particles along an edge: 2e5 in all, more than the caches hold.
const EDGE: usize = 58;

fn all_rows<R: Real, P: PairLaw<R, K>, const K: usize>(
    isa: Isa,
    law: &P,
    gather: &Gather<R>,
    rows: &Rows,
    store: Option<&PairStore<R>>,
) -> f64 {
    let mut check = 0.0;
    for (c, row) in rows.chunks().iter().enumerate() {
        let mut sums = [[0.0; K]; CHUNK];
        let stored = store.map_or(Store::None, |s| Store::Read(&s.chunks()[c]));
        sweep(isa, law, gather, (row, c * CHUNK), stored, &mut sums);
        check += sums[0][0];
    }
    check
}

fn laws<R: Real>(criterion: &mut Criterion, cube: &Cube) {
    let mut group = criterion.benchmark_group(format!("pairs-{}", R::PRECISION));
    group.throughput(Throughput::Elements(cube.position.len() as u64));
    let (records, matrices) = (cube.records::<R>(), cube.matrices::<R>());
    let gather = Gather {
        frame: &cube.frame,
        own: &records,
        other: &records,
        own_second: Some(&matrices),
        other_second: Some(&matrices),
    };
    let law = pressure::FluidPressure::<false> { limiter: 4.0, sound_speed: 1.0, rest_density: 1000.0 };
    for isa in Isa::available() {
        let rows = cube.rows(isa);
        let mut offsets = PairStore::default();
        offsets.resize_for(rows.chunks());
        group.bench_function(BenchmarkId::new("momentum", isa.name()), |b| {
            b.iter(|| all_rows(isa, &law, black_box(&gather), &rows, Some(&offsets)));
        });
        group.bench_function(BenchmarkId::new("continuity", isa.name()), |b| {
            b.iter(|| all_rows(isa, &density::Divergence, black_box(&gather), &rows, None));
        });
        group.bench_function(BenchmarkId::new("moments", isa.name()), |b| {
            b.iter(|| all_rows(isa, &moments::Moments, black_box(&gather), &rows, None));
        });
        group.bench_function(BenchmarkId::new("viscosity", isa.name()), |b| {
            b.iter(|| all_rows(isa, &viscosity::FluidViscosity, black_box(&gather), &rows, None));
        });
    }
    group.finish();
}

fn search(criterion: &mut Criterion, cube: &Cube) {
    let mut group = criterion.benchmark_group("rows");
    group.throughput(Throughput::Elements(cube.position.len() as u64));
    for isa in Isa::available() {
        let mut rows = cube.rows(isa);
        group
            .bench_function(BenchmarkId::new("build", isa.name()), |b| b.iter(|| cube.build(isa, &mut rows)));
    }
    group.finish();
}

fn benches(criterion: &mut Criterion) {
    // One core: the figures are to be compared with those of a single loop.
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("nothing has started threads yet");
    let cube = Cube::new(EDGE);
    search(criterion, &cube);
    laws::<f32>(criterion, &cube);
    laws::<f64>(criterion, &cube);
}

criterion_group! {
    name = pairs;
    config = Criterion::default().sample_size(10);
    targets = benches
}
criterion_main!(pairs);
