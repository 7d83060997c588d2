//! What `docs/figures.md` says: the pipe against its formula, and the speed on this machine.

use crate::{case, flow, poiseuille};
use std::time::Instant;
use vaso_driver::Stage;
use vaso_fluid::{Isa, Real};

/// Runs pipes with as many particles across as `ladder` says and the demo, and prints the page as it goes.
pub fn print(ladder: &[f64]) {
    println!("# Figures\n");
    println!("Made by `cargo run --release -p vaso-tests --example figures`; do not edit.\n");
    println!("## Pipe at Reynolds number 100\n");
    println!(
        "Parabolic inlet, pressure outlet, five diameters long, 1.2 s from rest, mean of the last quarter, mixed\n\
         precision. Velocity errors are root mean squares over the middle fifth, of the peak velocity. The pressure\n\
         gradient is fitted between one diameter from each end.\n"
    );
    println!(
        "| D/dp | velocity | transverse | flow | pressure gradient | in minus out | density | escaped | time |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    for &across in ladder {
        let start = Instant::now();
        let e = poiseuille::run::<f32>(across);
        println!(
            "| {across} | {:.2} % | {:.2} % | {:+.2} % | {:+.1} % | {:+.2} % | {:.2} % | {} | {:.0} s |",
            100.0 * e.velocity,
            100.0 * e.transverse,
            100.0 * e.flow,
            100.0 * e.gradient,
            100.0 * e.balance,
            100.0 * e.density,
            e.escaped,
            start.elapsed().as_secs_f64()
        );
    }
    println!("\n## Speed\n");
    println!(
        "`cases/carotid` at 0.3 mm, {} threads, instruction set {}; wall time of the loop, files left out. The\n\
         figures are those of a shared machine and vary by a factor of two from hour to hour.\n",
        rayon::current_num_threads(),
        Isa::detect().name()
    );
    println!(
        "| precision | fluid particles | M particle acoustic steps/s | per thread | bytes a fluid particle |"
    );
    println!("|---|---|---|---|---|");
    let (mixed, double) = (speed::<f32>(), speed::<f64>());
    println!("\n| stage | mixed, ns a particle and acoustic step | double |");
    println!("|---|---|---|");
    for (k, stage) in Stage::ALL.iter().enumerate().filter(|(_, s)| **s != Stage::Output) {
        println!("| {} | {:.1} | {:.1} |", stage.name(), mixed[k], double[k]);
    }
}

/// Times the demo case, prints its row, and returns the nanoseconds of each stage in order.
fn speed<R: Real>() -> Vec<f64> {
    let case = case("carotid", &[("particles.spacing", "0.3 mm")]);
    let (mut flow, _) = flow::<R>(&case);
    // The first steps fill memory; they are not the speed of a run.
    for _ in 0..5 {
        flow.step(1.0).unwrap_or_else(|e| panic!("{e}"));
    }
    flow.ledger = vaso_driver::Ledger::default();
    let before = flow.particle_substeps;
    for _ in 0..60 {
        flow.step(1.0).unwrap_or_else(|e| panic!("{e}"));
    }
    let done = (flow.particle_substeps - before) as f64;
    let rate = 1e-6 * done / flow.ledger.total();
    let n = flow.fluid.state.len();
    println!(
        "| {} | {n} | {rate:.2} | {:.2} | {} |",
        R::PRECISION,
        rate / rayon::current_num_threads() as f64,
        flow.fluid.bytes() / n
    );
    Stage::ALL.iter().map(|&stage| 1e9 * flow.ledger.seconds(stage) / done).collect()
}
