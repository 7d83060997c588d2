//! The stable step against the highest frequency.

mod support;

use support::{highest_frequency, tube};
use vaso_shell::{Isa, Material, Model, Numbers, Shell};

const SPACING: f64 = 1e-3;

fn limit(ratio: f64, jitter: f64, model: Model) -> f64 {
    let (around, along) = (31, 20);
    let radius = around as f64 * SPACING / std::f64::consts::TAU;
    let body = tube((radius, along as f64 * SPACING, ratio * SPACING), around, along, jitter);
    let numbers = Numbers { damping: 0.0, ..Numbers::new(1100.0, SPACING) };
    let material = Material::new(1e6, 0.45, model).expect("in range");
    let mut shell = Shell::new(&body.particles(), material, numbers, Isa::detect()).expect("sound");
    shell.refresh().expect("at rest");
    2.0 / highest_frequency(&mut shell) / (numbers.expected_step(&material, ratio*SPACING) / numbers.courant)
}

#[test]
fn limits() {
    for ratio in [0.05, 0.2, 0.5, 1.0, 2.0, 4.0] {
        let l = [0.0, 0.15].map(|j| limit(ratio, j, Model::Resultant));
        let g = limit(ratio, 0.15, Model::NeoHookean{points: 3});
        println!("t/dp {ratio}: limit / step {:.3} {:.3}  {g:.3}", l[0], l[1]);
    }
}
