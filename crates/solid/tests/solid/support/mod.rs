//! Bodies for tests: lattices and rings.

#![allow(dead_code)] // each test file uses some of it

use glam::DVec3;
use std::f64::consts::TAU;
use vaso_solid::Particles;

/// Positions and volumes of a body.
#[derive(Clone, Default)]
pub(crate) struct Body {
    pub(crate) position: Vec<DVec3>,
    pub(crate) volume: Vec<f64>,
}

impl Body {
    pub(crate) fn particles(&self) -> Particles<'_> {
        Particles { position: &self.position, volume: &self.volume, ..Particles::default() }
    }

    /// Numbers of the particles for which `is_in` holds.
    pub(crate) fn select(&self, is_in: impl Fn(DVec3) -> bool) -> Vec<u32> {
        (0..self.position.len() as u32).filter(|&i| is_in(self.position[i as usize])).collect()
    }

    /// Moves every particle by up to `share` of `spacing` along each axis.
    pub(crate) fn jittered(mut self, share: f64, spacing: f64) -> Self {
        let mut state = 5_u64;
        let mut next = move || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
        };
        for x in &mut self.position {
            *x += share * spacing * DVec3::new(next(), next(), next());
        }
        self
    }
}

/// Lattice of `n` cells of edge `spacing` from the corner `low` on.
pub(crate) fn lattice(low: DVec3, n: [usize; 3], spacing: f64) -> Body {
    let mut body = Body::default();
    for i in 0..n[0] {
        for j in 0..n[1] {
            for k in 0..n[2] {
                body.position
                    .push(low + spacing * (DVec3::new(i as f64, j as f64, k as f64) + DVec3::splat(0.5)));
                body.volume.push(spacing.powi(3));
            }
        }
    }
    body
}

/// Folder of validation data; says so where there is none.
pub(crate) fn data() -> Option<std::path::PathBuf> {
    let folder = std::env::var_os("VASO_DATA").map(Into::into);
    if folder.is_none() {
        println!("skipped: VASO_DATA is not set");
    }
    folder
}

/// Numbers of a CSV file below a line of names, row by row.
pub(crate) fn table(path: &std::path::Path) -> Vec<Vec<f64>> {
    let text = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let row = |line: &str| {
        line.split(',').map(|cell| cell.trim().parse().expect("tables hold numbers")).collect::<Vec<f64>>()
    };
    text.lines().skip(1).filter(|line| !line.trim().is_empty()).map(row).collect()
}

/// Value of column `k` of a table at `time`, which is its first column.
pub(crate) fn at_time(table: &[Vec<f64>], k: usize, time: f64) -> f64 {
    let next = table.iter().position(|row| row[0] > time).unwrap_or(table.len() - 1).max(1);
    let (a, b) = (&table[next - 1], &table[next]);
    a[k] + (time - a[0]) / (b[0] - a[0]) * (b[k] - a[k])
}

/// One layer in z of rings between two radii, `layers` of them, staggered; particles at the middle of their cells.
pub(crate) fn rings(inner: f64, outer: f64, layers: usize) -> Body {
    let spacing = (outer - inner) / layers as f64;
    let mut body = Body::default();
    for l in 0..layers {
        let r = inner + (l as f64 + 0.5) * spacing;
        let n = (TAU * r / spacing).round() as usize;
        for k in 0..n {
            let angle = TAU / n as f64 * (k as f64 + 0.5 * (l % 2) as f64);
            body.position.push(DVec3::new(r * angle.cos(), r * angle.sin(), 0.0));
            body.volume.push(TAU * r * spacing * spacing / n as f64);
        }
    }
    body
}
