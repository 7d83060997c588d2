//! The ledger of effects: what each costs in time and memory, on and off, by turns in one run.
//!
//! `cargo bench -p vaso-benches --bench effects -- --write` writes `docs/effects.md`; `--test` takes one turn and writes nothing.

use std::fmt::Write;
use vaso_benches::processor;
use vaso_benches::speed::root;
use vaso_driver::kind::{AnyFlow, Standing, any_flow};
use vaso_driver::{Case, Plan, world};

/// Advective steps before the clock runs, and of a turn.
const WARM: usize = 3;
const STEPS: usize = 4;
/// Turns; of each flow the fastest counts, as what others take away only adds.
const TURNS: usize = 8;

/// A scene beside the first, and what is different in it.
struct Scene {
    effect: &'static str,
    change: &'static str,
    set: &'static [(&'static str, &'static str)],
}

/// What a wall that deforms is made of.
const TISSUE: [(&str, &str); 4] = [
    ("wall.thickness", "0.6 mm"),
    ("wall.density", "1060 kg/m^3"),
    ("wall.young_modulus", "1.106 MPa"),
    ("wall.poisson_ratio", "0.45"),
];

/// The first is what the others are compared with.
const SCENES: &[Scene] = &[
    Scene { effect: "all below as in the case", change: "`cases/carotid`, rigid", set: &[] },
    Scene {
        effect: "blood.density_blend",
        change: "off: `numerics.density_blend = 0`",
        set: &[("numerics.density_blend", "0")],
    },
    Scene {
        effect: "blood.gradient_correction",
        change: "off: `numerics.gradient_correction = false`",
        set: &[("numerics.gradient_correction", "false")],
    },
    Scene {
        effect: "blood.transport_velocity",
        change: "off: `numerics.transport_velocity = false`",
        set: &[("numerics.transport_velocity", "false")],
    },
    Scene {
        effect: "blood.shear_thinning",
        change: "on: `blood.viscosity = { model = \"carreau-yasuda\" }`",
        set: &[("blood.viscosity", "{ model = \"carreau-yasuda\" }")],
    },
    Scene {
        effect: "wall.rigid_shell",
        change: "in place of `wall.rigid`: `wall.model = \"rigid-shell\"`",
        set: &[("wall.model", "rigid-shell")],
    },
    Scene {
        effect: "wall.shell, wall.coupling",
        change: "in place of `wall.rigid`: `wall.model = \"shell\"`",
        set: &[("wall.model", "shell")],
    },
    Scene {
        effect: "wall.solid, wall.coupling",
        change: "in place of `wall.rigid`: `wall.model = \"solid\"`, two layers",
        set: &[("wall.model", "solid"), ("wall.spacing", "0.3 mm")],
    },
    Scene {
        effect: "double precision",
        change: "`numerics.precision = \"double\"`",
        set: &[("numerics.precision", "double")],
    },
];

/// Takes one turn; returns processor time \[s\] a particle and acoustic step.
fn turn(flow: &mut dyn AnyFlow) -> f64 {
    let (start, before) = (processor(), flow.standing().particle_substeps);
    // On the worker, as the program runs: from outside every parallel loop would be handed over.
    rayon::scope(|_| {
        for _ in 0..STEPS {
            flow.step(f64::INFINITY).unwrap_or_else(|e| panic!("{e}"));
        }
    });
    (processor() - start) / (flow.standing().particle_substeps - before) as f64
}

fn flow(scene: &Scene) -> Box<dyn AnyFlow> {
    let named = |key: &str| scene.set.iter().find(|(k, _)| *k == key).map(|(_, value)| *value);
    let deforms = matches!(named("wall.model"), Some("shell" | "solid"));
    let tissue = if deforms { &TISSUE[..] } else { &[] };
    let set = [("particles.spacing", "0.6 mm")].iter().chain(scene.set).chain(tissue);
    let set: Vec<(String, String)> = set.map(|(k, v)| ((*k).to_owned(), (*v).to_owned())).collect();
    let mut case = Case::load(&root().join("cases/carotid"), &set).unwrap_or_else(|e| panic!("{e}"));
    case.cache = Some(root().join("target/ladder"));
    let plan = Plan::new(&case).unwrap_or_else(|e| panic!("{e}"));
    let bodies = world::Bodies::make(&case, |_, _, _| {}).unwrap_or_else(|e| panic!("{e}"));
    any_flow(&case, &plan, bodies).unwrap_or_else(|e| panic!("{e}"))
}

const HEAD: &str = "\
# What each effect costs

Made by `cargo bench -p vaso-benches --bench effects -- --write`; do not edit. The carotid of the demo at 0.6 mm and the same with
one effect on or off, a few advective steps of each by turns on one thread; of each the fastest turn counts, as what others do on
the machine only adds. Differences of a few per cent are within its noise. What a run itself spent on each effect is in its
`summary.json` and report. Memory is that of the bodies over the particles of the blood.

An effect that is off has no stage and no columns, and none of these scenes allocates in a step but for lists of neighbours that grow (`crates/driver/tests/allocations.rs`). A flow in
a rigid vessel is of a type for which no wall that deforms can be made: nothing of solids and shells is compiled into it. Two exceptions: without the correction of the gradients their moments are
still summed, as the fluid finds by them where it ends; the blend of the density reads sums that are needed anyway.

Walls that deform want steps as short as their waves are fast, which is most of what they cost: the last column has both.

| effect | change | ns a particle and acoustic step | over the first | bytes a particle of blood | acoustic steps a ms of flow | time a ms of flow, over the first |
|---|---|---|---|---|---|---|
";

fn main() {
    let asked = |flag: &str| std::env::args().any(|a| a == flag);
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("nothing has started threads yet");
    let mut flows: Vec<Box<dyn AnyFlow>> = SCENES.iter().map(flow).collect();
    let mut fastest = vec![f64::INFINITY; flows.len()];
    for round in 0..if asked("--test") { 1 } else { WARM + TURNS } {
        for (flow, fastest) in flows.iter_mut().zip(&mut fastest) {
            let seconds = turn(&mut **flow);
            if round >= WARM || asked("--test") {
                *fastest = fastest.min(seconds);
            }
        }
    }
    let mut page = HEAD.to_owned();
    let mut first = None;
    for ((scene, flow), seconds) in SCENES.iter().zip(&mut flows).zip(&fastest) {
        let Standing { particles, acoustic_steps, time, .. } = flow.standing();
        let steps = acoustic_steps as f64 / (1e3 * time);
        let first = *first.get_or_insert(seconds * steps);
        let _ = writeln!(
            page,
            "| {} | {} | {:.0} | {:.2} | {:.0} | {:.0} | {:.1} |",
            scene.effect,
            scene.change,
            1e9 * seconds,
            seconds / fastest[0],
            flow.bytes() as f64 / particles as f64,
            steps,
            seconds * steps / first
        );
    }
    println!("{page}");
    if asked("--write") {
        std::fs::write(root().join("docs/effects.md"), page).expect("the page can be written");
    }
}
