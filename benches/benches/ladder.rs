//! Whole flows from coarse to fine, against a plain loop timed in the same run.
//!
//! `cargo bench -p vaso-benches --bench ladder -- --write` runs all rungs, keeps them and writes `docs/speed.md`; `--page` only writes
//! the page; `--test` runs the first rung, and fails where it is slower than what is kept by more than noise.

use glam::DVec3;
use std::hint::black_box;
use std::time::Instant;
use vaso_benches::speed::{Ladder, Loop, Machine, Rung, root};
use vaso_benches::{Cube, processor};
use vaso_coupling::{NoWall, ShellWall};
use vaso_driver::deforming::Deforming;
use vaso_driver::{Case, Flow, Plan, Stage, world};
use vaso_fluid::law::{density, pressure};
use vaso_kernels::{CHUNK, Gather, Isa, Lanes, Own, Pair, PairLaw, PairStore, Real, Store, sweep};

/// Particles along an edge of the box.
const EDGE: usize = 58;
/// How much slower against the reference a rung may be than what is kept.
const SLOWER: f64 = 1.3;
/// Advective steps of a rung: before the clock runs, and while it does.
const WARM: usize = 3;
const STEPS: usize = 12;

/// Least processor time of `work` in `times` goes \[s\]: what others take away only adds.
fn least(times: usize, mut work: impl FnMut()) -> f64 {
    (0..times)
        .map(|_| {
            let start = processor();
            work();
            processor() - start
        })
        .fold(f64::INFINITY, f64::min)
}

/// Both pair loops of an acoustic step on a box \[ns a particle\], and the pairs of a particle.
fn both_loops<R: Real>(cube: &Cube, isa: Isa) -> (f64, f64) {
    let (records, rows) = (cube.records::<R>(), cube.rows(isa));
    let gather =
        Gather { frame: &cube.frame, own: &records, other: &records, own_second: None, other_second: None };
    let mut offsets = PairStore::default();
    offsets.resize_for(rows.chunks());
    let momentum = pressure::FluidPressure::<false> { limiter: 4.0, sound_speed: 1.0, rest_density: 1000.0 };
    let seconds = least(5, || {
        for (c, row) in rows.chunks().iter().enumerate() {
            let (mut force, mut divergence) = ([[0.0; 7]; CHUNK], [[0.0; 1]; CHUNK]);
            let stored = Store::Read(&offsets.chunks()[c]);
            sweep(isa, &momentum, &gather, (row, c * CHUNK), stored, &mut force);
            sweep(isa, &density::Divergence, &gather, (row, c * CHUNK), Store::None, &mut divergence);
            black_box((force[0][0], divergence[0][0]));
        }
    });
    let n = cube.position.len() as f64;
    (1e9 * seconds / n, rows.n_pairs() as f64 / n)
}

/// The same as plainly as it can be written, in double precision: columns of vectors, a list of neighbours, one pair after the other
/// \[ns a particle\].
fn plain_loops(cube: &Cube) -> f64 {
    let rows = cube.rows(Isa::scalar());
    let n = cube.position.len();
    let lists: Vec<Vec<u32>> = (0..n).map(|i| rows.row(i).map(|j| j as u32).collect()).collect();
    let wave = |i: usize| 600.0 * cube.position[i];
    let velocity: Vec<DVec3> = (0..n).map(|i| wave(i).map(f64::sin)).collect();
    let pressure: Vec<f64> = (0..n).map(|i| wave(i).y.cos()).collect();
    let volume = vec![vaso_benches::SPACING.powi(3); n];
    let offset: Vec<Vec<f64>> = lists.iter().map(|list| vec![0.0; list.len()]).collect();
    let (support, speed, density) = (cube.frame.support(), 1.0, 1000.0);
    let mut force = vec![DVec3::ZERO; n];
    let mut rate = vec![0.0; n];
    let seconds = least(3, || {
        for i in 0..n {
            let (mut push, mut dissipation, mut diffusion) = (DVec3::ZERO, DVec3::ZERO, 0.0);
            for (k, &j) in lists[i].iter().enumerate() {
                let j = j as usize;
                let d = (cube.position[i] - cube.position[j]) / support;
                let r = d.length();
                let u = (1.0 - r).max(0.0);
                let g = u * u * u * volume[j];
                let approach = (offset[i][k] - (velocity[i] - velocity[j]).dot(d) / r).max(0.0);
                let q = (100.0 * approach / speed).min(1.0) * density * speed * approach;
                push += (g * pressure[j]) * d;
                dissipation += (g * q) * d;
                diffusion += g * r * (pressure[i] - pressure[j]);
            }
            force[i] = push + dissipation;
            rate[i] = diffusion;
        }
        for i in 0..n {
            let mut divergence = 0.0;
            for &j in &lists[i] {
                let j = j as usize;
                let d = (cube.position[i] - cube.position[j]) / support;
                let u = (1.0 - d.length()).max(0.0);
                divergence += u * u * u * volume[j] * (velocity[i] - velocity[j]).dot(d);
            }
            rate[i] += divergence;
        }
        black_box((force[n / 2], rate[n / 2]));
    });
    1e9 * seconds / n as f64
}

/// Many multiply-adds a pair, in chains that do not wait for each other.
struct Busy;
const CHAINS: usize = 8;
const ROUNDS: usize = 64;

impl<R: Real> PairLaw<R, CHAINS> for Busy {
    type Constants<L: Lanes<Elem = R>> = ();

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), _: &Own<L>, p: &Pair<L>, sums: &mut [L; CHAINS]) {
        for _ in 0..ROUNDS {
            for sum in sums.iter_mut() {
                *sum = sum.fma(p.u, p.r);
            }
        }
    }
}

/// Multiply-adds of one core \[1e9 a second\].
fn multiply_adds<R: Real>(cube: &Cube, isa: Isa) -> f64 {
    let (records, rows) = (cube.records::<R>(), cube.rows(isa));
    let gather =
        Gather { frame: &cube.frame, own: &records, other: &records, own_second: None, other_second: None };
    let row = &rows.chunks()[0];
    let entries = row.n_entries() as f64;
    let seconds = least(20, || {
        let mut sums = [[0.0; CHAINS]; CHUNK];
        sweep(isa, &Busy, &gather, (row, 0), Store::None, &mut sums);
        black_box(sums[0][0]);
    });
    1e-9 * entries * (CHAINS * ROUNDS) as f64 / seconds
}

/// What one core streams \[GB/s\]: two arrays read, one written.
fn triad() -> f64 {
    let n = 8 << 20;
    let (b, c) = (vec![1.0_f64; n], vec![2.0_f64; n]);
    let mut a = vec![0.0_f64; n];
    let seconds = least(5, || {
        for ((a, b), c) in a.iter_mut().zip(&b).zip(&c) {
            *a = b + 3.0 * c;
        }
        black_box(a[n / 2]);
    });
    1e-9 * 24.0 * n as f64 / seconds
}

/// The carotid with a wall at a spacing \[mm\].
fn case(wall: &str, precision: &str, spacing_mm: f64) -> Case {
    let mut set = vec![
        ("particles.spacing".to_owned(), format!("{spacing_mm} mm")),
        ("numerics.precision".to_owned(), precision.to_owned()),
        ("wall.model".to_owned(), wall.to_owned()),
    ];
    if wall != "rigid" {
        let keys = [
            ("thickness", "0.6 mm"),
            ("density", "1060 kg/m^3"),
            ("young_modulus", "1.106 MPa"),
            ("poisson_ratio", if wall == "solid" { "0.45" } else { "0.49" }),
        ];
        set.extend(keys.map(|(key, value)| (format!("wall.{key}"), value.to_owned())));
    }
    let mut case = Case::load(&root().join("cases/carotid"), &set).unwrap_or_else(|e| panic!("{e}"));
    case.cache = Some(root().join("target/ladder"));
    case
}

/// Times a flow on one thread and on all.
fn rung<R: Real, W: Deforming + Send>(wall: &str, spacing_mm: f64, with_threads: bool) -> Rung {
    let case = case(wall, R::PRECISION, spacing_mm);
    let plan = Plan::new(&case).unwrap_or_else(|e| panic!("{e}"));
    let bodies = world::Bodies::make(&case, |_, _, _| {}).unwrap_or_else(|e| panic!("{e}"));
    let n_wall = bodies.wall.len();
    let mut flow: Flow<R, W> = world::build_flow_in(&case, &plan, bodies).unwrap_or_else(|e| panic!("{e}"));
    let pool = |n: usize| rayon::ThreadPoolBuilder::new().num_threads(n).build().expect("threads can be had");
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let (single, all) = (pool(1), pool(threads));
    let go = |flow: &mut Flow<R, W>, steps: usize| {
        for _ in 0..steps {
            flow.step(f64::INFINITY).unwrap_or_else(|e| panic!("{e}"));
        }
    };
    single.install(|| go(&mut flow, WARM));
    let (mut cpu, mut wall_clock, mut shared) = (0.0, 0.0, 0.0);
    let (mut particle_steps, mut steps, mut time) = (0, 0, 0.0);
    let before = Stage::ALL.map(|s| flow.ledger.seconds(s));
    let mut booked = [0.0; Stage::ALL.len()];
    let sub_steps = |flow: &Flow<R, W>| flow.wall.as_ref().map_or((0, 0), |w| (w.substeps, w.steps));
    let (substeps_before, steps_before) = sub_steps(&flow);
    let (mut advective, mut apart) = (0, before);
    // By turns, so that what others do on the machine meets both.
    for _ in 0..3 {
        let (substeps, acoustic, at) = (flow.particle_substeps, flow.acoustic_steps, flow.time);
        let (start, began) = (processor(), Instant::now());
        single.install(|| go(&mut flow, STEPS / 3));
        cpu += processor() - start;
        wall_clock += began.elapsed().as_secs_f64() / (flow.particle_substeps - substeps) as f64;
        particle_steps += flow.particle_substeps - substeps;
        steps += flow.acoustic_steps - acoustic;
        time += flow.time - at;
        advective += STEPS / 3;
        let now = Stage::ALL.map(|s| flow.ledger.seconds(s));
        booked.iter_mut().zip(now).zip(apart).for_each(|((booked, now), before)| *booked += now - before);
        if with_threads {
            let (substeps, began) = (flow.particle_substeps, Instant::now());
            all.install(|| go(&mut flow, STEPS / 3));
            shared += began.elapsed().as_secs_f64() / (flow.particle_substeps - substeps) as f64;
        }
        apart = Stage::ALL.map(|s| flow.ledger.seconds(s));
    }
    let total: f64 = booked.iter().sum();
    let stages = Stage::ALL.iter().zip(booked).filter(|(_, seconds)| *seconds > 0.0);
    let n = flow.fluid.state.len();
    let wall_bytes = flow.wall.as_mut().map_or(0, |w| w.wall.bytes() + w.bytes());
    let (substeps, all_steps) = sub_steps(&flow);
    Rung {
        wall: wall.to_owned(),
        precision: R::PRECISION.to_owned(),
        spacing_mm,
        particles: [n, n_wall],
        sound_speed: plan.numbers.sound_speed,
        step_s: time / steps as f64,
        acoustic_per_advective: steps as f64 / advective as f64,
        wall_substeps: (substeps - substeps_before) as f64 / (all_steps - steps_before).max(1) as f64,
        ns: 1e9 * cpu / particle_steps as f64,
        efficiency: if with_threads { wall_clock / shared / threads as f64 } else { 1.0 },
        bytes: [flow.fluid.bytes() as f64 / n as f64, wall_bytes as f64 / n_wall as f64],
        stages: stages.map(|(stage, seconds)| (stage.name().to_owned(), seconds / total)).collect(),
    }
}

fn say(ladder_reference: f64, r: &Rung) {
    println!(
        "{:<6} {:<6} {} mm: {} + {} particles, {:.0} ns a step ({:.2} M/s/core), reference over it {:.2}, threads {:.0} %, bytes {:.0}, wall sub-step {:.0} ns",
        r.wall,
        r.precision,
        r.spacing_mm,
        r.particles[0],
        r.particles[1],
        r.ns,
        r.rate(),
        ladder_reference / r.ns,
        100.0 * r.efficiency,
        r.bytes[0],
        r.wall_ns().unwrap_or(0.0)
    );
    for (stage, share) in &r.stages {
        println!("         {stage:<20} {:6.1} ns", r.ns * share);
    }
}

fn smoke(cube: &Cube) {
    let reference = plain_loops(cube);
    let found = rung::<f32, NoWall>("rigid", 0.6, false);
    say(reference, &found);
    let kept = Ladder::kept();
    let before = kept.rung("rigid", "mixed", 0.6).expect("it is the first rung");
    let slower = (found.ns / reference) / (before.ns / kept.reference_ns);
    println!("against the reference {slower:.2} times as slow as what is kept");
    let comparable = kept.machine.isa == Isa::detect().name();
    assert!(slower < SLOWER || !comparable, "slower than what is kept by more than {SLOWER}");
}

fn main() {
    let asked = |flag: &str| std::env::args().any(|a| a == flag);
    if asked("--page") {
        return Ladder::kept().keep();
    }
    let cube = Cube::new(EDGE);
    if asked("--test") {
        return smoke(&cube);
    }
    let isa = Isa::detect();
    let machine = Machine {
        isa: isa.name().to_owned(),
        threads: std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
        multiply_adds: [multiply_adds::<f32>(&cube, isa), multiply_adds::<f64>(&cube, isa)],
        triad_gb_s: triad(),
    };
    let reference_ns = plain_loops(&cube);
    let of = |precision: &str, (ns, pairs): (f64, f64)| Loop { precision: precision.to_owned(), ns, pairs };
    let loops = vec![of("mixed", both_loops::<f32>(&cube, isa)), of("double", both_loops::<f64>(&cube, isa))];
    println!("{machine:?}\nreference {reference_ns:.0} ns\n{loops:?}");
    let mut ladder = Ladder { machine, reference_ns, loops, rungs: Vec::new() };
    for spacing in [0.6, 0.4, 0.3, 0.2] {
        ladder.rungs.push(rung::<f32, NoWall>("rigid", spacing, true));
        say(reference_ns, &ladder.rungs[ladder.rungs.len() - 1]);
    }
    ladder.rungs.push(rung::<f64, NoWall>("rigid", 0.3, true));
    say(reference_ns, &ladder.rungs[ladder.rungs.len() - 1]);
    for spacing in [0.6, 0.4, 0.3] {
        ladder.rungs.push(rung::<f32, ShellWall<f32>>("shell", spacing, true));
        say(reference_ns, &ladder.rungs[ladder.rungs.len() - 1]);
    }
    if asked("--write") {
        ladder.keep();
    }
}
