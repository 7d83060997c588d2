//! The highest frequency of a shell at rest, which bounds its step.

use crate::error::ShellError;
use crate::forces::{Forces, across};
use crate::numbers::Numbers;
use crate::state::ShellState;
use glam::DVec3;
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Real};

/// Steps of the power iteration: frequencies that far apart that it matters are told apart by then.
const STEPS: usize = 80;

/// Displacement in spacings and change of directors: small for the strain, large for the fixed-point coordinates.
const SIZE: f64 = 1e-4;

/// What the power iteration may still be short of, and of what is linear in it.
const MARGIN: f64 = 1.03;

/// Highest frequency \[rad/s\] of the shell, free and at rest, by power iteration from noise.
///
/// It is measured, not estimated: one particle with bad neighbours at an edge may be what bounds the step.
pub(crate) fn highest_frequency<R: Real>(
    forces: &mut Forces<R>,
    rest: &ShellState,
    numbers: &Numbers,
) -> Result<f64, ShellError> {
    let mut state = rest.clone();
    let undamped = Numbers { damping: 0.0, ..*numbers };
    let mut seed = 1_u64;
    let mut next = || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
    };
    for i in 0..state.len() {
        state.acceleration[i] = numbers.spacing * DVec3::new(next(), next(), next());
        let turn = DVec3::new(next(), next(), next());
        state.director_acceleration[i] = across(turn, rest.director[i]);
    }
    let mut square = 0.0;
    for _ in 0..STEPS {
        // The accelerations of one step are the displacements of the next.
        let factor = SIZE / size(&state, numbers.spacing);
        for i in 0..state.len() {
            state.displacement[i] = factor * state.acceleration[i];
            state.director[i] = (rest.director[i]
                + factor * across(state.director_acceleration[i], rest.director[i]))
            .normalize();
        }
        forces.accelerate(&mut state, &undamped, 0.0)?;
        // Rayleigh quotient of the stiffness with the masses as the metric.
        let [force, work] = sums(&state, rest);
        if work == 0.0 {
            return Ok(0.0);
        }
        square = force / work;
    }
    Ok(MARGIN * square.sqrt())
}

/// Largest displacement in spacings or change of a director, as the accelerations tell it.
fn size(state: &ShellState, spacing: f64) -> f64 {
    let top = |v: &[DVec3]| v.iter().map(|v| v.length()).fold(0.0, f64::max);
    (top(&state.acceleration) / spacing).max(top(&state.director_acceleration))
}

/// `a M a` and `- a M u` of accelerations `a` and displacements `u`, those of directors with them.
fn sums(state: &ShellState, rest: &ShellState) -> [f64; 2] {
    let n = state.len();
    let chunks: Vec<[f64; 2]> = (0..n.div_ceil(CHUNK))
        .into_par_iter()
        .map(|c| {
            let mut sum = [0.0; 2];
            for i in c * CHUNK..n.min((c + 1) * CHUNK) {
                let (a, turning) = (state.acceleration[i], state.director_acceleration[i]);
                let (u, turn) = (state.displacement[i], state.director[i] - rest.director[i]);
                let (mass, inertia) = (state.mass[i], state.rotary_inertia[i]);
                sum[0] += mass * a.length_squared() + inertia * turning.length_squared();
                sum[1] -= mass * a.dot(u) + inertia * turning.dot(turn);
            }
            sum
        })
        .collect();
    chunks.iter().fold([0.0; 2], |sum, part| [sum[0] + part[0], sum[1] + part[1]])
}
