//! The stable step against the highest frequency.

use crate::support;

use std::f64::consts::TAU;
use support::{highest_frequency, tube};
use vaso_shell::{Isa, Material, Model, Numbers, Shell};

const SPACING: f64 = 1e-3;

/// Largest stable step of a free tube of `ratio` spacings thickness, by the one the shell takes and by the one expected.
fn limit(ratio: f64, jitter: f64, model: Model) -> [f64; 2] {
    let (around, along) = (31, 20);
    let radius = around as f64 * SPACING / TAU;
    let body = tube((radius, along as f64 * SPACING, ratio * SPACING), around, along, jitter);
    let numbers = Numbers { damping: 0.0, ..Numbers::new(1100.0, SPACING) };
    let material = Material::new(1e6, 0.45, model).expect("in range");
    let mut shell = Shell::new(&body.particles(), material, numbers, Isa::detect()).expect("a sound body");
    shell.refresh().expect("at rest");
    let limit = 2.0 / highest_frequency(&mut shell);
    let expected = numbers.expected_step(&material, ratio * SPACING);
    [shell.stable_step(), expected].map(|step| limit / (step / numbers.courant))
}

/// The shell measures its own limit, whatever its disorder; the formula holds for regular particles.
#[test]
fn the_step_is_safe_and_not_much_smaller_than_it_could_be() {
    for ratio in [0.05, 0.2, 0.5, 1.0, 2.0, 4.0] {
        for (jitter, model) in
            [(0.0, Model::Resultant), (0.15, Model::Resultant), (0.15, Model::NeoHookean { points: 3 })]
        {
            let [taken, expected] = limit(ratio, jitter, model);
            println!(
                "t/dp {ratio}, jitter {jitter}: limit by step taken {taken:.3}, by step expected {expected:.3}"
            );
            assert!((1.0..1.06).contains(&taken), "{taken}");
            assert!(jitter > 0.0 || (0.9..1.25).contains(&expected), "{expected}");
        }
    }
}
