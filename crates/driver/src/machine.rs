//! How fast this machine is: a short measurement, so that what a run will take can be told beforehand.

use glam::DVec3;
use rayon::prelude::*;
use std::hint::black_box;
use std::sync::OnceLock;
use std::time::{Duration, Instant};
use vaso_fluid::law::pressure::{FLUID_SUMS, FluidPressure};
use vaso_kernels::{
    CHUNK, CellGrid, Frame, Gather, Isa, PairStore, Real, Records, Rows, SearchSet, Store, Wendland, sweep,
};

/// Particles along an edge of the box.
const EDGE: usize = 24;
/// Time the measurement may take; the best of its goes counts, as what others do on the machine only slows it.
const BUDGET: Duration = Duration::from_millis(250);
/// Time of a particle where the constants of the cost were fitted \[s\]: two threads of a server of 2023 with AVX-512.
const FITTED: f64 = 73.4e-9;

/// Time that all threads together take here for a particle, over that where the constants of the cost were fitted. Measured once.
pub(crate) fn slowness() -> f64 {
    static FOUND: OnceLock<f64> = OnceLock::new();
    *FOUND.get_or_init(|| measure() / FITTED)
}

/// Time of a core for the pair loop of the momentum, mixed precision \[s a particle\], with all threads at work.
fn measure() -> f64 {
    let isa = Isa::detect();
    let unsorted: Vec<DVec3> = (0..EDGE * EDGE * EDGE)
        .map(|k| DVec3::new((k % EDGE) as f64, (k / EDGE % EDGE) as f64, (k / EDGE / EDGE) as f64))
        .collect();
    let bounds = (DVec3::ZERO, DVec3::splat(EDGE as f64));
    let support = Wendland::new(1.3).support();
    let (frame, mut grid) = (Frame::new(bounds, support), CellGrid::new(bounds, support));
    let mut order = Vec::new();
    grid.sort(&unsorted, &mut order);
    let position: Vec<DVec3> = order.iter().map(|&k| unsorted[k as usize]).collect();
    let mut set = SearchSet::default();
    set.fill(&frame, &position);
    let mut rows = Rows::default();
    rows.build(isa, &frame, (&set, &position), &set, &grid, true);
    let mut records = Records::<f32>::default();
    records.resize(position.len());
    records.fill(|i| {
        let (fixed, x) = (set.get(i), frame.in_supports(position[i]));
        let place = [0, 1, 2].map(|k| f32::coordinate(fixed[k], x[k]));
        let wave = (i as f32).sin();
        [place[0], place[1], place[2], 1.0, wave, -wave, 0.5 * wave, 1.0 + wave]
    });
    let gather =
        Gather { frame: &frame, own: &records, other: &records, own_second: None, other_second: None };
    let mut offsets = PairStore::default();
    offsets.resize_for(rows.chunks());
    let law = FluidPressure::<false> { limiter: 4.0, sound_speed: 10.0, rest_density: 1.0 };
    let began = Instant::now();
    let mut best = f64::INFINITY;
    while began.elapsed() < BUDGET {
        let start = Instant::now();
        rows.chunks().par_iter().zip(offsets.chunks()).enumerate().for_each(|(c, (row, offsets))| {
            let mut sums = [[0.0; FLUID_SUMS]; CHUNK];
            sweep(isa, &law, &gather, (row, c * CHUNK), Store::Read(offsets), &mut sums);
            black_box(sums[0][0]);
        });
        best = best.min(start.elapsed().as_secs_f64());
    }
    best * rayon::current_num_threads() as f64 / position.len() as f64
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_machine_is_neither_a_hundred_times_as_fast_nor_as_slow() {
        let slowness = super::slowness();
        println!("{slowness:.3} times as slow as where the costs were fitted");
        assert!((0.01..100.0).contains(&slowness), "{slowness}");
        assert_eq!(slowness, super::slowness());
    }
}
