//! What is seen of a tube that is blown up: its middle fifth, and means over time.

use vaso_driver::Flow;
use vaso_driver::deforming::Deforming;
use vaso_solid::Solid;

use crate::pipe::Pipe;

/// Whether a place along the axis \[m\] is in the middle fifth.
pub(super) fn is_middle(z: f64, pipe: &Pipe) -> bool {
    (z - 0.5 * pipe.length).abs() < 0.1 * pipe.length
}

/// Mean pressure of the blood in the middle fifth \[Pa\].
pub(super) fn pressure<W: Deforming>(flow: &Flow<f32, W>, pipe: &Pipe) -> f64 {
    let state = &flow.fluid.state;
    let within = (0..state.len()).filter(|&i| is_middle(state.position[i].z, pipe));
    let (sum, n) = within.fold((0.0, 0.0), |(sum, n), i| (sum + state.pressure[i], n + 1.0));
    sum / n
}

/// Distance from the axis before, and displacement away from it \[m\], of each particle of the innermost layer in the middle fifth.
pub(super) fn innermost(flow: &Flow<f32, Solid<f32>>, pipe: &Pipe) -> Vec<[f64; 2]> {
    let solid = &flow.wall.as_ref().expect("the wall deforms").wall;
    let state = &solid.state;
    let all = (0..state.len()).map(|i| (state.reference_position[i], state.displacement[i]));
    all.map(|(x, u)| (x.z, x.x.hypot(x.y), u.x * x.x + u.y * x.y))
        .filter(|&(z, r, _)| is_middle(z, pipe) && r < pipe.radius() + solid.numbers().spacing)
        .map(|(_, r, product)| [r, product / r])
        .collect()
}

/// Runs a flow to the second of two times \[s\]; means of what is seen of it, from the first on.
///
/// # Panics
/// When the flow breaks down, or loses a particle.
pub(super) fn means<W: Deforming, const N: usize>(
    flow: &mut Flow<f32, W>,
    [from, to]: [f64; 2],
    see: impl Fn(&Flow<f32, W>) -> [f64; N],
) -> [f64; N] {
    let mut sums = [0.0; N];
    while flow.time < to {
        let before = flow.time;
        flow.step(to).unwrap_or_else(|e| panic!("{e}"));
        if before >= from {
            let share = (flow.time - before) / (to - from);
            sums.iter_mut().zip(see(flow)).for_each(|(sum, value)| *sum += share * value);
        }
    }
    assert_eq!(flow.watch.escaped, 0);
    sums
}
