//! Sub-steps of a shell on one core.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;
use std::f64::consts::TAU;
use vaso_shell::{Isa, Material, Model, Numbers, Particles, Real, Shell};

const SPACING: f64 = 0.4e-3;
const AROUND: usize = 64;
const ALONG: usize = 128;
/// Sub-steps an iteration, so that the ends of a step do not count.
const STEPS: usize = 10;

/// A tube with disorder.
fn tube() -> (Vec<DVec3>, Vec<DVec3>) {
    let mut state = 1_u64;
    let mut next = move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let radius = AROUND as f64 * SPACING / TAU;
    (0..AROUND * ALONG)
        .map(|k| {
            let angle = TAU * ((k % AROUND) as f64 + 0.2 * next()) / AROUND as f64;
            let z = SPACING * ((k / AROUND) as f64 + 0.2 * next());
            let normal = DVec3::new(angle.cos(), angle.sin(), 0.0);
            (radius * normal + z * DVec3::Z, normal)
        })
        .unzip()
}

fn substeps<R: Real>(criterion: &mut Criterion, (position, normal): &(Vec<DVec3>, Vec<DVec3>)) {
    let mut group = criterion.benchmark_group(format!("shell-substep-{}", R::PRECISION));
    group.throughput(Throughput::Elements((STEPS * position.len()) as u64));
    let (area, thickness) = (vec![SPACING * SPACING; position.len()], vec![0.6e-3; position.len()]);
    let particles = Particles { position, normal, area: &area, thickness: &thickness };
    let usual = Numbers::new(1120.0, SPACING);
    let undamped = Numbers { damping: 0.0, ..usual };
    let layers = Model::NeoHookean { points: 3 };
    for (name, model, numbers) in [
        ("resultant", Model::Resultant, usual),
        ("resultant-undamped", Model::Resultant, undamped),
        ("neo-hookean", layers, usual),
    ] {
        let material = Material::new(1.1e6, 0.45, model).expect("in range");
        for isa in Isa::available() {
            group.bench_function(BenchmarkId::new(name, isa.name()), |b| {
                let mut shell = Shell::<R>::new(&particles, material, numbers, isa).expect("a sound body");
                for (v, x) in shell.state.velocity.iter_mut().zip(shell.state.reference_position.iter()) {
                    *v = 0.05 * DVec3::new((300.0 * x.y).sin(), (200.0 * x.z).sin(), (100.0 * x.x).sin());
                }
                let dt = STEPS as f64 * shell.stable_step();
                b.iter(|| shell.advance_in(dt, STEPS).expect("a gentle motion"));
            });
        }
    }
    group.finish();
}

fn benches(criterion: &mut Criterion) {
    // One core: the figures are to be compared with those of a single loop.
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("nothing has started threads yet");
    let tube = tube();
    substeps::<f32>(criterion, &tube);
    substeps::<f64>(criterion, &tube);
}

criterion_group! {
    name = shell;
    config = Criterion::default().sample_size(10);
    targets = benches
}
criterion_main!(shell);
