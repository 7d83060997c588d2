//! What a frame of a particle series costs: time and bytes, frame by frame.
//!
//! `cargo run --release -p vaso-io --example series_cost -- FOLDER [FRAMES] [PARTICLES]`

use glam::DVec3;
use std::path::PathBuf;
use std::time::Instant;
use vaso_io::{Frame, SeriesWriter};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = PathBuf::from(arguments.next().ok_or("usage: series_cost FOLDER [FRAMES] [PARTICLES]")?);
    let frames: usize = arguments.next().map_or(Ok(100), |text| text.parse())?;
    let particles: usize = arguments.next().map_or(Ok(50_000), |text| text.parse())?;

    let path = folder.join("cost.vtkhdf");
    let mut series = SeriesWriter::create(&path);
    let mut seconds = Vec::new();
    for step in 0..frames {
        let count = particles + (step * 37) % (particles / 10).max(1);
        let cloud = Cloud::new(count, step);
        let start = Instant::now();
        series.append(&cloud.frame(step as f64 * 1e-2))?;
        seconds.push(start.elapsed().as_secs_f64());
    }
    let megabytes = std::fs::metadata(&path)?.len() as f64 / 1e6;
    let median = |slice: &[f64]| {
        let mut sorted = slice.to_vec();
        sorted.sort_by(f64::total_cmp);
        sorted[sorted.len() / 2]
    };
    let tenth = (frames / 10).max(1);
    println!(
        "{frames} frames of {particles} to {} particles: median {:.1} ms a frame (first tenth {:.1}, last tenth {:.1}), \
         {megabytes:.1} MB, {:.1} bytes a particle and frame",
        particles + particles / 10,
        1e3 * median(&seconds),
        1e3 * median(&seconds[..tenth]),
        1e3 * median(&seconds[frames - tenth..]),
        megabytes * 1e6 / (frames * particles) as f64
    );
    drop(series);
    std::fs::remove_file(path)?;
    Ok(())
}

/// Particles in a tube with noise in the low bits, as a simulation has it.
struct Cloud {
    position: Vec<DVec3>,
    velocity: Vec<DVec3>,
    pressure: Vec<f64>,
    density: Vec<f64>,
    ids: Vec<u64>,
}

impl Cloud {
    fn new(count: usize, step: usize) -> Self {
        let mut state = step as u64 + 1;
        let mut noise = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        };
        let spacing = 5e-4;
        let position: Vec<DVec3> = (0..count)
            .map(|i| {
                let lattice = DVec3::new((i % 12) as f64, (i / 12 % 12) as f64, (i / 144) as f64);
                (lattice + 0.3 * DVec3::new(noise(), noise(), noise())) * spacing
            })
            .collect();
        let velocity =
            position.iter().map(|x| DVec3::new(0.0, 0.0, 0.3 - x.x * 10.0) + 1e-3 * noise()).collect();
        let pressure: Vec<f64> = position.iter().map(|x| 1e4 - 1e4 * x.z + 10.0 * noise()).collect();
        let density = pressure.iter().map(|p| 1060.0 + p / 144.0).collect();
        let ids = (0..count as u64).map(|i| i * 7919 % count as u64).collect();
        Self { position, velocity, pressure, density, ids }
    }

    fn frame(&self, time: f64) -> Frame<'_> {
        Frame {
            time,
            position: &self.position,
            scalars: vec![("Pressure", &self.pressure), ("Density", &self.density)],
            vectors: vec![("Velocity", &self.velocity)],
            ids: Some(&self.ids),
        }
    }
}
